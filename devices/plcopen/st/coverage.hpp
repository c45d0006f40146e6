#pragma once
#include <span>
#include <string>

#include "devices/coverage.hpp"
#include "devices/plcopen/st/code.hpp"

namespace drycut::devices::plcopen::st {

/// What the counts of a program's instructions say of its text; `files` names its files. A line that holds
/// the condition of an IF or a loop counts its looks at it.
Coverage coverage_of(const Compiled& code, const Counts& counts, std::span<const std::string> files);

}  // namespace drycut::devices::plcopen::st
