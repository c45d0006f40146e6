#include "sim/studies/fit/machine.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "sim/loop/simulation.hpp"
#include "sim/studies/bode/loop.hpp"

namespace drycut::sim::studies {

namespace {

scenario::PlantEntry* entry_of(scenario::Scenario& scenario, const std::string& plant) {
  const auto found = std::ranges::find(scenario.plants, plant, [](const auto& one) { return one.name.text; });
  return found == scenario.plants.end() ? nullptr : &*found;
}

}  // namespace

std::optional<FitPath> fit_path(const std::string& text) {
  constexpr std::string_view begin = "plants.";
  if (!text.starts_with(begin)) return {};
  const auto dot = text.find('.', begin.size());
  if (dot == std::string::npos || dot == begin.size() || dot + 1 == text.size()) return {};
  return FitPath{text.substr(begin.size(), dot - begin.size()), text.substr(dot + 1)};
}

const plants::Parameter* quantity_at(scenario::Scenario& scenario, const FitPath& path,
                                     plants::Parameters& rows) {
  auto* entry = entry_of(scenario, path.plant);
  if (entry == nullptr) return nullptr;
  rows = entry->definition->parameters();
  const auto found = std::ranges::find(rows, path.row, &plants::Parameter::name);
  return found != rows.end() && std::holds_alternative<double*>(found->value) ? &*found : nullptr;
}

bool set_quantity(scenario::Scenario& scenario, const FitPath& path, double si) {
  plants::Parameters rows;
  const auto* row = quantity_at(scenario, path, rows);
  if (row == nullptr) return false;
  *std::get<double*>(row->value) = si;
  return true;
}

void strip_onlookers(scenario::Scenario& scenario) {
  scenario.record.channels.clear();
  scenario.checks.clear();
  scenario.pictures = {};
  scenario.opcua = {};
  scenario.faults = {};
}

void strip(scenario::Scenario& scenario) {
  strip_onlookers(scenario);
  scenario.controller.reset();
  scenario.wiring.clear();
  scenario.filters.clear();
  scenario.panel = {};
  scenario.timeline.clear();
  scenario.disturbances.clear();
  scenario.inputs.clear();
}

namespace {

/// The plant has a servo, and it is the drive that is chosen.
bool has_servo(scenario::Scenario& scenario, const std::string& plant) {
  auto* entry = entry_of(scenario, plant);
  if (entry == nullptr) return false;
  const auto rows = entry->definition->parameters();
  const auto drive = std::ranges::find(rows, "drive", &plants::Parameter::name);
  if (drive == rows.end()) return true;
  const auto& chosen = *std::get<std::string*>(drive->value);
  return chosen == "servo" || chosen == "pulses";
}

}  // namespace

bool make_source_of_torque(scenario::Scenario& scenario, const std::string& plant) {
  if (!has_servo(scenario, plant)) return false;
  // No speed loop, no lag, no filter, and current for any torque: test_torque is the motor's.
  constexpr double any = 1e9;
  constexpr std::array<std::pair<std::string_view, double>, 14> values = {{{"speed_gain", 0},
                                                                           {"current_lag", 0},
                                                                           {"torque_forward", 0},
                                                                           {"torque_filter", 0},
                                                                           {"notch1.frequency", 0},
                                                                           {"notch2.frequency", 0},
                                                                           {"rated_current", 0},
                                                                           {"stall_current", 0},
                                                                           {"peak_current", 0},
                                                                           {"amplifier_current", 0},
                                                                           {"amplifier_peak_current", 0},
                                                                           {"peak_torque", any},
                                                                           {"torque_at_max_speed", any},
                                                                           {"max_speed", any}}};
  return std::ranges::all_of(values, [&](const auto& one) {
    return set_quantity(scenario, {plant, "servo." + std::string(one.first)}, one.second);
  });
}

void make_rigid(scenario::Scenario& scenario, const std::string& plant) {
  const FitPath stiffness{plant, "gear.stiffness"};
  plants::Parameters rows;
  const auto* row = quantity_at(scenario, stiffness, rows);
  if (row == nullptr || *std::get<double*>(row->value) > 0) return;
  constexpr double stiffest = 1e9;
  constexpr double softer = 0.7;
  constexpr double softest = 1;
  // Of an oscillation of 0.6 rad a step, a twelfth of the step's stiffness is a twentieth of critical.
  const double damped = seconds(scenario.scene.step) / 6;
  double k = stiffest;
  while (k > softest) {
    set_quantity(scenario, stiffness, k);
    set_quantity(scenario, {plant, "gear.damping"}, k * damped);
    if (is_sound(scenario)) return;
    k *= softer;
  }
}

bool is_sound(const scenario::Scenario& scenario) {
  const double h = seconds(scenario.scene.step);
  return std::ranges::all_of(scenario.plants, [&](const auto& one) {
    return std::ranges::none_of(one.definition->objections(h), [](const auto& objection) {
      return objection.parameter.starts_with("gear.") || objection.parameter.starts_with("nut.") ||
             objection.parameter.find("friction.") != std::string::npos;
    });
  });
}

std::unique_ptr<loop::Simulation> machine_of(const scenario::Scenario& scenario, bool closed) {
  Problems problems;
  auto simulation = std::make_unique<loop::Simulation>(scenario, problems);
  if (!problems.empty()) throw std::runtime_error(problems.front().what);
  simulation->keep_nothing();
  if (!closed) disarm(*simulation);
  return simulation;
}

}  // namespace drycut::sim::studies
