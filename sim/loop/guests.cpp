#include "sim/loop/guests.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace drycut::sim::loop {

const plants::GuestDefinition* guest_of(const scenario::PlantEntry& plant) {
  return dynamic_cast<const plants::GuestDefinition*>(plant.definition.get());
}

Problem problem_of_guest(Code code, const scenario::Scenario& scenario, const scenario::PlantEntry& plant,
                         const std::string& what, const std::string& remedy) {
  const auto file = std::ranges::find(plant.places, "file", &decltype(plant.places)::value_type::first);
  return scenario::problem_at(code, scenario, file == plant.places.end() ? plant.name.place : file->second,
                              what, remedy);
}

bool has_failed_guest(const std::vector<std::unique_ptr<plants::Plant>>& plants) {
  return std::ranges::any_of(plants, [](const auto& plant) {
    const auto* const guest = dynamic_cast<const plants::Guest*>(plant.get());
    return guest != nullptr && guest->has_failed();
  });
}

namespace {

// A wire from it to itself is no loop without a delay.
std::string own_wires(const scenario::Scenario& scenario, const scenario::PlantEntry& plant) {
  const auto prefix = plant.name.text + ".";
  std::string text;
  for (const auto& wire : scenario.wiring)
    if (wire.terminal.text.starts_with(prefix) && wire.plug.text.starts_with(prefix))
      text += fmt::format(". {} takes what {} was at the end of the step before", wire.terminal.text,
                          wire.plug.text);
  return text;
}

std::string given_units(const scenario::PlantEntry& plant) {
  std::string text;
  for (const auto& [variable, unit] : plant.units)
    text += fmt::format("{}{} in {}", text.empty() ? ". By the scenario's word it has " : ", ", variable.text,
                        unit.text);
  return text;
}

}  // namespace

std::vector<Finding> notes_of_guests(const scenario::Scenario& scenario) {
  std::vector<Finding> notes;
  for (const auto& plant : scenario.plants) {
    const auto* const guest = guest_of(plant);
    if (guest == nullptr || guest->type() == nullptr) continue;
    constexpr double milliseconds = 1e3;
    notes.emplace_back(
        "fmu.guest"_code,
        fmt::format(
            "{} is a guest beside the machine's bodies: the foreign FMU {} ({}), in a process of its own. It "
            "steps by {:g} ms, holds its inputs over each step and shows its outputs at the end of it{}{}{}",
            plant.name.text, guest->file(), guest->type()->origin(),
            guest->step(seconds(scenario.scene.step)) * milliseconds, own_wires(scenario, plant),
            given_units(plant), guest->type()->keeps_state() ? "" : ". Its state cannot be kept"));
  }
  return notes;
}

void refuse_guests_without_state(const scenario::Scenario& scenario, std::string_view otherwise,
                                 Problems& problems) {
  for (const auto& plant : scenario.plants) {
    const auto* const guest = guest_of(plant);
    if (guest == nullptr || guest->type() == nullptr || guest->type()->keeps_state()) continue;
    problems.push_back(problem_of_guest(
        "fmu.no-state"_code, scenario, plant,
        fmt::format("{}: its state cannot be kept, so no moment of this line can", guest->file()),
        fmt::format("take an FMU with canGetAndSetFMUState and canSerializeFMUState; {}", otherwise)));
  }
}

}  // namespace drycut::sim::loop
