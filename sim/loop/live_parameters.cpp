#include "sim/loop/live_parameters.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>
#include <variant>
#include <vector>

namespace drycut::sim::loop {

namespace {

// A parameter in the definition of its plant.
struct FoundParameter {
  const scenario::PlantEntry* plant = nullptr;
  plants::Parameters all;
  plants::Parameters::const_iterator row;
};

std::optional<FoundParameter> find_parameter(const scenario::Scenario& scenario, const std::string& name) {
  const auto dot = name.find('.');
  if (dot == std::string::npos) return {};
  for (const auto& plant : scenario.plants) {
    if (name.compare(0, dot, plant.name.text) != 0) continue;
    FoundParameter found{&plant, plant.definition->parameters(), {}};
    found.row = std::find_if(found.all.cbegin(), found.all.cend(), [&](const plants::Parameter& parameter) {
      return name.compare(dot + 1, std::string::npos, parameter.name) == 0;
    });
    if (found.row == found.all.cend()) return {};
    return found;
  }
  return {};
}

}  // namespace

std::optional<devices::ValueFault> fixed_parameter(const scenario::Scenario& scenario,
                                                   const std::string& name) {
  const auto found = find_parameter(scenario, name);
  if (!found || found->row->live) return {};
  std::vector<std::string> live;
  for (const auto& parameter : found->all)
    if (parameter.live) live.push_back(parameter.name);
  const auto& plant = found->plant->name.text;
  const auto rest = live.empty() ? std::string("nothing of it changes in mid-run")
                                 : fmt::format("in mid-run it takes: {}", fmt::join(live, ", "));
  return devices::ValueFault{"timeline.fixed"_code, fmt::format("{} is fixed while the machine runs", name),
                             fmt::format("give it under plants.{}; {}", plant, rest)};
}

std::optional<devices::ValueFault> objection_to(const scenario::Scenario& scenario, const std::string& name,
                                                double si) {
  const auto found = find_parameter(scenario, name);
  if (!found || !found->row->live) return {};
  const auto definition = [&](std::string_view other) -> plants::PlantDefinition* {
    const auto plant =
        std::find_if(scenario.plants.begin(), scenario.plants.end(),
                     [&](const scenario::PlantEntry& entry) { return entry.name.text == other; });
    return plant == scenario.plants.end() ? nullptr : plant->definition.get();
  };
  const double h = seconds(scenario.scene.step);
  auto& value = *std::get<double*>(found->row->value);
  const double before = std::exchange(value, si);
  auto& judge = *found->plant->definition;
  auto objections = judge.objections(h);
  for (const auto& plant : scenario.plants) {
    auto more = plant.definition->objections_with(definition, h);
    objections.insert(objections.end(), more.begin(), more.end());
  }
  value = before;
  if (objections.empty()) return {};
  return devices::ValueFault{objections.front().code, fmt::format("{}: {}", name, objections.front().what),
                             objections.front().remedy};
}

}  // namespace drycut::sim::loop
