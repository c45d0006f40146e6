#include "sim/loop/quantities.hpp"

#include <fmt/format.h>

#include <utility>

#include "sim/scenario/units.hpp"

namespace drycut::sim::loop {

std::optional<double> in_si(const scenario::Scenario& scenario, Problems& problems, const std::string& name,
                            std::string_view unit, const scenario::Quantity& quantity,
                            const std::string& bare) {
  const auto refuse = [&](Code code, std::string what, std::string remedy) {
    problems.push_back(
        scenario::problem_at(code, scenario, quantity.place, std::move(what), std::move(remedy)));
    return std::optional<double>();
  };
  if (unit.empty()) {
    if (quantity.unit.empty()) return quantity.number;
    return refuse("scenario.wrong-unit"_code,
                  fmt::format("{} takes a plain number, not '{}'", name, quantity.unit), bare);
  }
  if (quantity.unit.empty())
    return refuse("scenario.wrong-unit"_code, fmt::format("{} needs a unit", name),
                  fmt::format("write for example {} {}", quantity.number, unit));
  if (!scenario::is_unit(quantity.unit) || !scenario::same_dimension(quantity.unit, unit))
    return refuse("scenario.wrong-unit"_code,
                  fmt::format("{} is {}, '{}' is not", name, scenario::dimension_name(unit), quantity.unit),
                  fmt::format("give it in {}", unit));
  return scenario::to_si(quantity.number, quantity.unit);
}

}  // namespace drycut::sim::loop
