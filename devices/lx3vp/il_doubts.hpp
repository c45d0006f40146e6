#pragma once
#include <string>
#include <vector>

#include "devices/lx3vp/il_program.hpp"

namespace drycut::devices::lx3vp::il {

/// What is no fault in a program and hardly meant, "file:line:column: ..." each: a coil with two
/// OUT, or with OUT and SET; a type of cam that ECAMTBX does not know.
std::vector<std::string> doubts(const Program& program);

/// A DECAM on another block than any ECAMTBX makes, where one makes a block that no DECAM runs; "" = none.
std::string strange_block(const Program& program);

}  // namespace drycut::devices::lx3vp::il
