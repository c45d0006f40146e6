#pragma once
#include "devices/plcopen/st/code.hpp"

namespace drycut::devices::plcopen::st {

/// The result of an operation without effects, Op::add to Op::maximum_real, in its type. Whole numbers wrap
/// in their width, REALs are rounded to single precision. Divisions of whole numbers by 0 are the caller's to
/// refuse.
Cell apply(Op op, Basic basic, Cell a, Cell b);
inline bool is_pure(Op op) { return op >= Op::add && op <= Op::maximum_real; }
inline bool divides_whole(Op op) { return op == Op::divide || op == Op::modulo; }

}  // namespace drycut::devices::plcopen::st
