#include "sim/fmi/resolve.hpp"

#include <fmt/format.h>

#include <span>

#include "base/state_archive.hpp"
#include "sim/fmi/machine/built_machine.hpp"
#include "sim/scenario/units.hpp"

namespace drycut::sim::fmi {

std::string made_by(std::string_view binary) {
  return fmt::format("Drycut {}, library {:016x}", DRYCUT_VERSION,
                     StateArchive::sum_of(std::as_bytes(std::span(binary))));
}

ResolvedMachine resolve(const scenario::Scenario& scenario, std::string_view binary) {
  ResolvedMachine machine{made_by(binary), scenario.scene.step, scenario.scene.seed};
  for (const auto& plant : scenario.plants) {
    auto& values = machine.plants.emplace_back();
    values.name = plant.name.text;
    values.type = plant.type.text;
    for (const auto& row : plant.definition->parameters())
      std::visit(
          [&](const auto* value) {
            if constexpr (std::is_same_v<decltype(value), const std::string*>)
              values.parameters.emplace_back(row.name, *value);
            else
              values.parameters.emplace_back(row.name, static_cast<double>(*value));
          },
          row.value);
  }
  const BuiltMachine built(machine);
  for (const auto& variable : built.variables())
    if (variable.in_si && variable.ranged && !variable.unit.empty()) {
      const double offset = scenario::to_si(0, variable.unit);
      machine.units[variable.unit] = {scenario::to_si(1, variable.unit) - offset, offset};
    }
  return machine;
}

}  // namespace drycut::sim::fmi
