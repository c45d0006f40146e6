#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "devices/plcopen/axis_parameters.hpp"

namespace drycut::sim::scenario {

/// The unit in which people give a parameter of an axis: so many of the kernel's units are one of it.
struct AxisUnit {
  std::string_view unit;  ///< "" where only a bare number has a meaning
  double factor = 1;
};
AxisUnit axis_unit(const devices::plcopen::AxisParameter& parameter, devices::plcopen::Measure measure);

/// The words for AxisKind, in its order: "drive", "virtual", "encoder".
const std::vector<std::string>& axis_kinds();
const std::string& axis_kind_text(devices::plcopen::AxisKind kind);

/// The value as a scenario writes it: with its unit where that reads back as the very same value, else in the
/// kernel's units.
std::string axis_value_text(const devices::plcopen::AxisParameter& parameter,
                            const devices::plcopen::AxisParameters& parameters,
                            devices::plcopen::Measure measure);

/// `number` in `unit`, of the dimension of `people.unit`, in the kernel's units. What lies within rounding of
/// a whole number is one.
double to_kernel(double number, std::string_view unit, const AxisUnit& people);

}  // namespace drycut::sim::scenario
