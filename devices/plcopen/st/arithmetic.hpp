#pragma once
#include <optional>
#include <string>

#include "devices/plcopen/st/code.hpp"

namespace drycut::devices::plcopen::st {

/// The result of an operation without effects, Op::add to Op::maximum_real, in its type. Whole numbers wrap
/// in their width, REALs are rounded to single precision. What `no_result` tells is the caller's to refuse.
Cell apply(Op op, Basic basic, Cell a, Cell b);
inline bool is_pure(Op op) { return op >= Op::add && op <= Op::maximum_real; }

struct NoResult {
  std::string what;
  std::string remedy;
};
/// Why an operation without effects has no finite result where PLC run-times raise an exception: a division
/// by 0, SQRT, LN, LOG, ASIN, ACOS outside of what they take, a power or EXP beyond the type `basic`. Sums
/// and products of real numbers may become infinite.
std::optional<NoResult> no_result(Op op, Basic basic, Cell a, Cell b);

}  // namespace drycut::devices::plcopen::st
