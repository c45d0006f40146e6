#include "sim/scenario/axis_units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/scenario/units.hpp"

namespace drycut::sim::scenario {

using devices::plcopen::AxisParameter;
using devices::plcopen::AxisParameters;
using devices::plcopen::Measure;

namespace {

struct UnitRow {
  std::string_view kernel;  ///< as axis_parameter_table writes it
  std::string_view length;
  std::string_view angle;
  double factor;
};
constexpr std::array rows{
    UnitRow{"0.1 um, 0.0001 deg", "mm", "deg", 10'000},
    UnitRow{"0.1 um", "mm", "deg", 10'000},
    UnitRow{"um/s, 0.001 deg/s", "mm/s", "deg/s", 1'000},
    UnitRow{"mm/s2, deg/s2", "mm/s^2", "deg/s^2", 1},
    UnitRow{"mm/s3, deg/s3", "mm/s^3", "deg/s^3", 1},
    UnitRow{"us", "us", "us", 1},
    UnitRow{"0.01/s", "1/s", "1/s", 100},
    UnitRow{"0.1 %", "%", "%", 10},
};

}  // namespace

AxisUnit axis_unit(const AxisParameter& parameter, Measure measure) {
  for (const UnitRow& row : rows)
    if (row.kernel == parameter.unit)
      return {measure == Measure::length ? row.length : row.angle, row.factor};
  return {};
}

const std::vector<std::string>& axis_kinds() {
  static const std::vector<std::string> names = {"drive", "virtual", "encoder"};
  return names;
}

const std::string& axis_kind_text(devices::plcopen::AxisKind kind) {
  return axis_kinds().at(static_cast<std::size_t>(kind));
}

std::string axis_value_text(const AxisParameter& parameter, const AxisParameters& parameters,
                            Measure measure) {
  if (parameter.is(&AxisParameters::kind)) return axis_kind_text(parameters.kind);
  const double value = parameter.value(parameters);
  const AxisUnit people = axis_unit(parameter, measure);
  if (people.unit.empty()) return fmt::format("{}", value);
  for (const int digits : {15, 16, 17}) {
    const auto text = fmt::format("{:.{}g} {}", value / people.factor, digits, people.unit);
    if (to_kernel(parse_quantity(text)->number, people.unit, people) == value) return text;
  }
  return fmt::format("{}", value);
}

double to_kernel(double number, std::string_view unit, const AxisUnit& people) {
  const double exact =
      (unit == people.unit ? number : from_si(to_si(number, unit), people.unit)) * people.factor;
  constexpr double rounding = 1e-12;
  const double whole = std::round(exact);
  return std::abs(exact - whole) <= rounding * std::max(1.0, std::abs(exact)) ? whole : exact;
}

}  // namespace drycut::sim::scenario
