#include "devices/plcopen/axis_values.hpp"

#include <array>

#include "devices/cards.hpp"

namespace drycut::devices::plcopen {
namespace {

// 0.1 um in a mm, 0.0001 deg in a deg.
constexpr double increments = 10'000;

double coupling_phase(const Axis& axis) {
  return axis.coupling() == nullptr ? 0 : 1 + static_cast<double>(axis.coupling()->phase());
}

constexpr std::array value_rows{
    AxisValue{"set_position", AxisQuantity::position,
              [](const Axis& axis) { return axis.set().position.part / increments; }, nullptr, 0, 0,
              "commanded position, of a modulo axis in its turn"},
    AxisValue{"actual_position", AxisQuantity::position,
              [](const Axis& axis) { return axis.actual().part / increments; }, nullptr, 0, 0,
              "position by the encoder"},
    AxisValue{"set_velocity", AxisQuantity::velocity,
              [](const Axis& axis) { return axis.set().velocity / increments; }, nullptr, 0, 0,
              "commanded speed"},
    AxisValue{"actual_velocity", AxisQuantity::velocity,
              [](const Axis& axis) { return axis.actual_velocity() / increments; }, nullptr, 0, 0,
              "speed by the encoder"},
    AxisValue{"set_acceleration", AxisQuantity::acceleration,
              [](const Axis& axis) { return axis.set().acceleration / increments; }, nullptr, 0, 0,
              "commanded acceleration"},
    AxisValue{"set_jerk", AxisQuantity::jerk, [](const Axis& axis) { return axis.set_jerk() / increments; },
              nullptr, 0, 0, "change of the commanded acceleration in a cycle, over the cycle's time"},
    AxisValue{"following_error", AxisQuantity::position,
              [](const Axis& axis) { return axis.following_error() / increments; }, nullptr, 0, 0,
              "commanded less actual position"},
    AxisValue{"state", AxisQuantity::number,
              [](const Axis& axis) { return static_cast<double>(axis.state()); }, nullptr, 0, 0,
              "0 Disabled, 1 Standstill, 2 Homing, 3 Stopping, 4 DiscreteMotion, 5 ContinuousMotion, "
              "6 SynchronizedMotion, 7 Errorstop"},
    AxisValue{"error", AxisQuantity::number,
              [](const Axis& axis) { return static_cast<double>(axis.error()); }, nullptr, 0, 0,
              "why the axis is in Errorstop; 0 = it is not"},
    AxisValue{"coupling_phase", AxisQuantity::number, coupling_phase, nullptr, 0, 0,
              "0 not coupled, 1 to the speed of the law, 2 in the speed window, 3 to its position, "
              "4 waits for the cam's zero, 5 coupled"},
    AxisValue{"powered", AxisQuantity::number, [](const Axis& axis) { return axis.powered() ? 1.0 : 0.0; },
              nullptr, 0, 0, "MC_Power has switched it on"},
    AxisValue{"homed", AxisQuantity::number, [](const Axis& axis) { return axis.homed() ? 1.0 : 0.0; },
              nullptr, 0, 0, "its zero is known"},
    AxisValue{
        "reference", AxisQuantity::volts,
        [](const Axis& axis) { return axis.outputs().reference * (dac_full_scale_volts / dac_full_scale); },
        nullptr, 0, 0, "speed reference for the drive"},
    AxisValue{"enable", AxisQuantity::number,
              [](const Axis& axis) { return axis.outputs().enable ? 1.0 : 0.0; }, nullptr, 0, 0,
              "the axis regulates"},
    AxisValue{"override", AxisQuantity::percent,
              [](const Axis& axis) { return axis.control.override_percent; },
              [](Axis& axis, double value) { axis.control.override_percent = value; }, 0, 100,
              "slows movements down that are not coupled"},
    AxisValue{"ready", AxisQuantity::number, [](const Axis& axis) { return axis.drive.ready ? 1.0 : 0.0; },
              [](Axis& axis, double value) { axis.drive.ready = value != 0; }, 0, 1,
              "of the drive; can be set where it is not wired"},
    AxisValue{"emergency_stop", AxisQuantity::number,
              [](const Axis& axis) { return axis.drive.emergency_stop ? 1.0 : 0.0; },
              [](Axis& axis, double value) { axis.drive.emergency_stop = value != 0; }, 0, 1,
              "can be set where it is not wired"},
    AxisValue{"feed_enable", AxisQuantity::number,
              [](const Axis& axis) { return axis.control.feed_enable ? 1.0 : 0.0; },
              [](Axis& axis, double value) { axis.control.feed_enable = value != 0; }, 0, 1,
              "can be set where it is not wired"},
    AxisValue{"feed_hold", AxisQuantity::number,
              [](const Axis& axis) { return axis.control.feed_hold ? 1.0 : 0.0; },
              [](Axis& axis, double value) { axis.control.feed_hold = value != 0; }, 0, 1,
              "can be set where it is not wired"},
};

}  // namespace

std::string_view unit_of(AxisQuantity quantity, Measure measure) {
  const bool length = measure == Measure::length;
  switch (quantity) {
    case AxisQuantity::number:
      return "";
    case AxisQuantity::position:
      return length ? "mm" : "deg";
    case AxisQuantity::velocity:
      return length ? "mm/s" : "deg/s";
    case AxisQuantity::acceleration:
      return length ? "mm/s2" : "deg/s2";
    case AxisQuantity::jerk:
      return length ? "mm/s3" : "deg/s3";
    case AxisQuantity::volts:
      return "V";
    case AxisQuantity::percent:
      return "%";
  }
  return "";
}

std::span<const AxisValue> axis_value_table() { return value_rows; }

}  // namespace drycut::devices::plcopen
