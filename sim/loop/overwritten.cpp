#include "sim/loop/overwritten.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "sim/loop/program_words.hpp"
#include "sim/loop/simulation.hpp"

namespace drycut::sim::loop {

namespace {

/// The program's own spelling, in small letters: "axisx:toll" in QCL.
std::string spelling(const devices::ProgramText& program, const std::string& name) {
  auto spelt = lower(name);
  if (program.language == "qcl") std::replace(spelt.begin(), spelt.end(), '.', ':');
  return spelt;
}

/// "axisx:toll = 5", and not "x = axisx:toll", "if axisx:toll eq 0", "toll = toll + 1", "toll : INT := 5".
bool is_assignment(const devices::ProgramText& program, int line, const std::string& spelt) {
  const auto code = lower(code_of(program, line));
  if (!code.starts_with(spelt)) return false;
  const auto rest = trimmed(std::string_view(code).substr(spelt.size()));
  const std::string_view sign = program.language == "st" ? ":=" : "=";
  return rest.starts_with(sign) && rest.find(spelt) == std::string_view::npos;
}

/// What a run left nothing of; nothing = it stands, or something reads it first.
std::optional<Finding> told_of(const scenario::Scenario& scenario, devices::Controller& controller,
                               const std::string& name, double number) {
  const auto value = controller.find(name);
  constexpr double rounding = 1e-6;
  if (!value || std::abs(value->read() - number) <= rounding * std::abs(number)) return {};
  const auto place = written_first(controller, name);
  if (!place) return {};
  return Finding{"controller.value-overwritten"_code,
                 fmt::format("controller.{}.set.{} = {:g} has no effect: the program writes {:g} at {}",
                             scenario.controller->kind(), name, number, value->read(), *place)};
}

}  // namespace

std::optional<std::string> written_first(devices::Controller& controller, const std::string& name) {
  const auto value = controller.find(name);
  if (!value) return {};
  std::optional<std::string> written;
  for (const auto& program : controller.programs()) {
    if (program.language != "qcl" && program.language != "st") continue;
    for (const auto& [number, names] : program.values) {
      if (std::find(names.begin(), names.end(), value->name) == names.end()) continue;
      if (!is_assignment(program, number, spelling(program, value->name))) return {};
      if (!written) written = fmt::format("{}:{}", program.file, number);
      break;
    }
  }
  return written;
}

std::vector<Finding> overwritten(const scenario::Scenario& scenario, devices::Controller& controller) {
  std::vector<Finding> found;
  if (!scenario.controller) return found;
  for (const auto& [name, number] : scenario.controller->set)
    if (auto told = told_of(scenario, controller, name.text, number)) found.push_back(std::move(*told));
  return found;
}

std::optional<Finding> overwritten(const scenario::Scenario& scenario, const std::string& name) {
  Problems problems;
  if (!scenario.buildable || !scenario.controller) return {};
  Simulation simulation(scenario, problems);
  if (!problems.empty() || simulation.controller() == nullptr ||
      !written_first(*simulation.controller(), name))
    return {};
  simulation.keep_nothing();
  simulation.run();
  for (const auto& [set, number] : scenario.controller->set)
    if (set.text == name) return told_of(scenario, *simulation.controller(), name, number);
  return {};
}

}  // namespace drycut::sim::loop
