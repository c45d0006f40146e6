#include "sim/scenario/parameter_text.hpp"

#include <fmt/format.h>

#include "sim/scenario/units.hpp"

namespace drycut::sim::scenario {

namespace {

std::string text_of(const plants::Parameter& parameter, double value) {
  return format_quantity(value, parameter.unit);
}
std::string text_of(const plants::Parameter& parameter, int value) {
  return parameter.unit.empty() ? fmt::format("{}", value) : fmt::format("{} {}", value, parameter.unit);
}
std::string text_of(const plants::Parameter&, bool value) { return value ? "true" : "false"; }
std::string text_of(const plants::Parameter&, const std::string& value) { return value; }

}  // namespace

std::string value_text(const plants::Parameter& parameter) {
  return std::visit([&](const auto* bound) { return text_of(parameter, *bound); }, parameter.value);
}

}  // namespace drycut::sim::scenario
