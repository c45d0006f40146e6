#include "devices/plcopen/axis.hpp"

#include <array>

#include "devices/cards.hpp"

namespace drycut::devices::plcopen {
namespace {

// 0.1 um in a mm, 0.0001 deg in a deg.
constexpr double increments = 10'000;

double coupling_phase(const Axis& axis) {
  return axis.coupling() == nullptr ? 0 : 1 + static_cast<double>(axis.coupling()->phase());
}

/// What a terminal tells the axis; it can be set where that is not wired.
template <auto part, auto member>
constexpr AxisValue input(std::string_view name, std::string_view meaning) {
  return {name,
          AxisQuantity::number,
          meaning,
          [](const Axis& axis) { return axis.*part.*member ? 1.0 : 0.0; },
          [](Axis& axis, double value) { axis.*part.*member = value != 0; },
          0,
          1};
}

constexpr std::array value_rows{
    AxisValue{"set_position", AxisQuantity::position, "commanded position, of a modulo axis in its turn",
              [](const Axis& axis) { return axis.set().position.part / increments; }, nullptr, 0, 0, true},
    AxisValue{"actual_position", AxisQuantity::position, "position by the encoder",
              [](const Axis& axis) { return axis.actual().part / increments; }, nullptr, 0, 0, true},
    AxisValue{"set_velocity", AxisQuantity::velocity, "commanded speed",
              [](const Axis& axis) { return axis.set().velocity / increments; }},
    AxisValue{"actual_velocity", AxisQuantity::velocity, "speed by the encoder",
              [](const Axis& axis) { return axis.actual_velocity() / increments; }},
    AxisValue{"set_acceleration", AxisQuantity::acceleration, "commanded acceleration",
              [](const Axis& axis) { return axis.set().acceleration / increments; }},
    AxisValue{"set_jerk", AxisQuantity::jerk,
              "change of the commanded acceleration in a cycle, over the cycle's time",
              [](const Axis& axis) { return axis.set_jerk() / increments; }},
    AxisValue{"following_error", AxisQuantity::position, "commanded less actual position",
              [](const Axis& axis) { return axis.following_error() / increments; }},
    AxisValue{"state", AxisQuantity::number,
              "0 Disabled, 1 Standstill, 2 Homing, 3 Stopping, 4 DiscreteMotion, 5 ContinuousMotion, 6 "
              "SynchronizedMotion, 7 Errorstop",
              [](const Axis& axis) { return static_cast<double>(axis.state()); }},
    AxisValue{"error", AxisQuantity::number, "why the axis is in Errorstop; 0 = it is not",
              [](const Axis& axis) { return static_cast<double>(axis.error()); }},
    AxisValue{"coupling_phase", AxisQuantity::number,
              "0 not coupled, 1 to the speed of the law, 2 in the speed window, 3 to its position, 4 waits "
              "for the cam's zero, 5 coupled",
              coupling_phase},
    AxisValue{"powered", AxisQuantity::number, "MC_Power has switched it on",
              [](const Axis& axis) { return axis.powered() ? 1.0 : 0.0; }},
    AxisValue{"homed", AxisQuantity::number, "its zero is known",
              [](const Axis& axis) { return axis.homed() ? 1.0 : 0.0; }},
    AxisValue{
        "reference", AxisQuantity::volts, "speed reference for the drive",
        [](const Axis& axis) { return axis.outputs().reference * (dac_full_scale_volts / dac_full_scale); }},
    AxisValue{"enable", AxisQuantity::number, "the axis regulates",
              [](const Axis& axis) { return axis.outputs().enable ? 1.0 : 0.0; }},
    AxisValue{"override", AxisQuantity::percent, "slows movements down that are not coupled",
              [](const Axis& axis) { return axis.control.override_percent; },
              [](Axis& axis, double value) { axis.control.override_percent = value; }, 0, 100},
    input<&Axis::drive, &DriveInputs::ready>("ready", "of the drive; can be set where it is not wired"),
    input<&Axis::drive, &DriveInputs::emergency_stop>("emergency_stop", "can be set where it is not wired"),
    input<&Axis::control, &AxisControl::feed_enable>("feed_enable", "can be set where it is not wired"),
    input<&Axis::control, &AxisControl::feed_hold>("feed_hold", "can be set where it is not wired"),
};

}  // namespace

std::string_view unit_of(AxisQuantity quantity, Measure measure) {
  // In the order of AxisQuantity.
  constexpr std::array<std::string_view, 7> of_length{"", "mm", "mm/s", "mm/s2", "mm/s3", "V", "%"};
  constexpr std::array<std::string_view, 7> of_angle{"", "deg", "deg/s", "deg/s2", "deg/s3", "V", "%"};
  return (measure == Measure::length ? of_length : of_angle).at(static_cast<std::size_t>(quantity));
}

std::span<const AxisValue> axis_value_table() { return value_rows; }

}  // namespace drycut::devices::plcopen
