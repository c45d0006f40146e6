#pragma once
#include <cstdint>
#include <span>
#include <string_view>

#include "devices/plcopen/axis.hpp"

namespace drycut::devices::plcopen {

enum class AxisQuantity : std::uint8_t { number, position, velocity, acceleration, jerk, volts, percent };
/// "mm/s", "deg/s", ... "" for a number.
std::string_view unit_of(AxisQuantity quantity, Measure measure);

/// A value of an axis that people record, check and set, in mm or deg and seconds.
struct AxisValue {
  std::string_view name;
  AxisQuantity quantity = AxisQuantity::number;
  std::string_view meaning;
  double (*read)(const Axis& axis) = nullptr;
  void (*write)(Axis& axis, double value) = nullptr;  ///< nullptr: can only be read
  double min = 0;                                     ///< of one that can be written
  double max = 0;
  bool in_turn = false;  ///< of a modulo axis: begins again with each turn
};
std::span<const AxisValue> axis_value_table();

}  // namespace drycut::devices::plcopen
