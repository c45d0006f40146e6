#include "sim/loop/overwritten.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text.hpp"
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
bool is_assignment(const devices::ProgramText& program, const std::string& line, const std::string& spelt) {
  auto code = lower(line);
  code = code.substr(0, code.find(program.language == "st" ? "//" : ";"));
  const auto text = trimmed(code);
  if (!text.starts_with(spelt)) return false;
  const auto rest = trimmed(text.substr(spelt.size()));
  const std::string_view sign = program.language == "st" ? ":=" : "=";
  return rest.starts_with(sign) && rest.find(spelt) == std::string_view::npos;
}

}  // namespace

std::optional<std::string> written_first(devices::Controller& controller, const std::string& name) {
  const auto value = controller.find(name);
  if (!value) return {};
  std::optional<std::string> written;
  for (const auto& program : controller.programs()) {
    if (program.language != "qcl" && program.language != "st") continue;
    const auto lines = split_lines(program.text);
    for (const auto& [number, names] : program.values) {
      if (std::find(names.begin(), names.end(), value->name) == names.end()) continue;
      const auto line = std::string(lines[static_cast<std::size_t>(number) - 1]);
      if (!is_assignment(program, line, spelling(program, value->name))) return {};
      if (!written) written = fmt::format("{}:{}", program.file, number);
      break;
    }
  }
  return written;
}

std::vector<std::string> overwritten(const scenario::Scenario& scenario, devices::Controller& controller) {
  std::vector<std::string> found;
  if (!scenario.controller) return found;
  for (const auto& [name, number] : scenario.controller->set) {
    const auto value = controller.find(name.text);
    constexpr double rounding = 1e-6;
    if (!value || std::abs(value->read() - number) <= rounding * std::abs(number)) continue;
    if (const auto place = written_first(controller, name.text))
      found.push_back(fmt::format("controller.{}.set.{} = {:g} has no effect: the program writes {:g} at {}",
                                  scenario.controller->kind(), name.text, number, value->read(), *place));
  }
  return found;
}

std::string overwritten(const scenario::Scenario& scenario, const std::string& name) {
  Problems problems;
  if (!scenario.buildable || !scenario.controller) return "";
  Simulation simulation(scenario, problems);
  if (!problems.empty() || simulation.controller() == nullptr ||
      !written_first(*simulation.controller(), name))
    return "";
  simulation.keep_nothing();
  simulation.run();
  const auto wanted = fmt::format(".set.{} = ", name);
  for (auto& text : overwritten(scenario, *simulation.controller()))
    if (text.find(wanted) != std::string::npos) return text;
  return "";
}

}  // namespace drycut::sim::loop
