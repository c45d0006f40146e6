#include "sim/controller_loader.hpp"

#include <fmt/format.h>

#include "devices/catalogue.hpp"
#include "devices/qmove/cnf.hpp"
#include "devices/qmove/program.hpp"
#include "devices/qmove/qmove_controller.hpp"
#include "sim/file.hpp"

namespace drycut::sim {

namespace {

namespace qmove = devices::qmove;

/// Values that the scenario sets before power-up.
void set_values(const QmoveSection& section, const Scenario& scenario, devices::Controller& controller,
                devices::Problems& problems) {
  for (const auto& [name, number] : section.set) {
    const auto value = controller.find(name.text);
    if (value && value->write) {
      value->write(number);
      continue;
    }
    const auto near = devices::nearest(name.text, controller.names());
    problems.push_back(problem_at(scenario, name.place,
                                  value ? fmt::format("'{}' can only be read", name.text)
                                        : fmt::format("the controller has nothing called '{}'", name.text),
                                  near.empty() || value
                                      ? "name a program variable or a device parameter (drycut devices)"
                                      : fmt::format("did you mean {}?", near)));
  }
}

std::unique_ptr<devices::Controller> load_qmove(const QmoveSection& section, const Scenario& scenario,
                                                devices::Problems& problems) {
  const auto before = problems.size();
  const auto folder = scenario.file.parent_path();
  const auto read = [&](const Text& path) {
    return read_file(folder / path.text, problems, problem_at(scenario, path.place, "", ""));
  };
  const auto text = read(section.configuration);
  if (!text) return nullptr;
  const auto file = (folder / section.configuration.text).string();
  auto configuration = qmove::parse_configuration(*text, file, devices::catalogue(), problems);
  // Modules are not judged by a configuration that is not sound.
  if (problems.size() != before) return nullptr;
  std::vector<qmove::Program> programs;
  for (const auto& task : section.tasks) {
    const auto module = read(task);
    if (!module) continue;
    programs.push_back(qmove::compile_module(*module, (folder / task.text).string(), configuration,
                                             devices::catalogue(), problems));
  }
  if (problems.size() != before) return nullptr;
  auto controller = std::make_unique<qmove::QmoveController>(std::move(configuration), std::move(programs),
                                                             devices::catalogue(), section.cycle);
  const auto retentive = retentive_file(scenario);
  if (retentive && std::filesystem::exists(*retentive)) {
    const auto kept = read_file(*retentive, problems, problem_at(scenario, section.retentive.place, "", ""));
    if (kept) controller->restore(*kept, problems, retentive->string());
  }
  set_values(section, scenario, *controller, problems);
  return controller;
}

}  // namespace

std::optional<std::filesystem::path> retentive_file(const Scenario& scenario) {
  const auto* section = std::get_if<QmoveSection>(&scenario.controller);
  if (section == nullptr || section->retentive.text.empty()) return {};
  return scenario.file.parent_path() / section->retentive.text;
}

std::unique_ptr<devices::Controller> load_controller(const Scenario& scenario, devices::Problems& problems) {
  if (const auto* section = std::get_if<QmoveSection>(&scenario.controller))
    return load_qmove(*section, scenario, problems);
  return nullptr;
}

}  // namespace drycut::sim
