#pragma once
#include <cstdint>
#include <optional>
#include <string_view>

#include "devices/plcopen/st/types.hpp"

namespace drycut::devices::plcopen::st {

// What stands behind TIME#, TOD#, DATE#, DT# and the long ones; nothing if it is written otherwise.

/// Of a TIME.
std::optional<double> milliseconds(std::string_view text);
/// The parts of an LTIME, exactly; `fits` is false if it is too long or too fine.
std::optional<std::int64_t> nanoseconds(std::string_view text, bool& fits);
/// Of TOD, DATE and DT as their types count.
std::optional<std::int64_t> clock_number(Basic basic, std::string_view text);
/// The same of LTOD, LDATE and LDT.
std::optional<std::int64_t> long_clock_number(Basic basic, std::string_view text);

}  // namespace drycut::devices::plcopen::st
