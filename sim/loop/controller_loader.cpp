#include "sim/loop/controller_loader.hpp"

#include <fmt/format.h>

#include "base/text.hpp"
#include "sim/file.hpp"

namespace drycut::sim::loop {

namespace {

/// Values that the scenario sets before power-up.
void set_values(const scenario::ControllerSection& section, const scenario::Scenario& scenario,
                devices::Controller& controller, Problems& problems) {
  for (const auto& [name, number] : section.set) {
    const auto value = controller.find(name.text);
    if (value && value->write) {
      const auto fault = value->misfit(number);
      if (fault)
        problems.push_back(
            scenario::problem_at(fault->code, scenario, name.place, fault->what, fault->remedy));
      if (!fault) value->write(number);
      continue;
    }
    problems.push_back(
        scenario::problem_at("controller.unknown-name"_code, scenario, name.place,
                             value ? fmt::format("'{}' can only be read", name.text)
                                   : fmt::format("the controller has nothing called '{}'", name.text),
                             did_you_mean(name.text, value ? std::vector<std::string>() : controller.names(),
                                          std::string(section.settable()))));
  }
}

/// Puts the values of the retentive file back, if there is one. Where the run keeps them it must be possible
/// to write it at the end.
void restore(const scenario::Text& retentive, const scenario::Scenario& scenario,
             devices::Controller& controller, Problems& problems) {
  const auto file = retentive_file(scenario);
  if (!file) return;
  const auto refuse = [&](Code code, const std::string& what, const std::string& remedy) {
    problems.push_back(scenario::problem_at(code, scenario, retentive.place, what, remedy));
  };
  const auto folder = file->has_parent_path() ? file->parent_path() : std::filesystem::path(".");
  if (file->has_parent_path() && !folder_exists(folder)) {
    refuse("file.not-writable"_code, fmt::format("there is no directory {}", folder.string()),
           "make it first, or name another file");
    return;
  }
  if (const auto why = hindrance(*file); scenario.controller->retains && !why.empty()) {
    refuse("file.not-writable"_code,
           fmt::format("{} cannot be written at the end of the run: {}", file->string(), why),
           "name another file");
    return;
  }
  if (!file_exists(*file)) return;
  const auto kept = read_file(*file, problems, scenario::named_at(scenario, retentive.place));
  if (kept) controller.restore(*kept, problems, file->string());
}

}  // namespace

std::vector<scenario::Text> controller_files(const scenario::Scenario& scenario) {
  if (!scenario.controller) return {};
  auto files = scenario.controller->files();
  if (const auto& retentive = scenario.controller->retentive; !retentive.text.empty())
    files.push_back(retentive);
  return files;
}

std::optional<std::filesystem::path> retentive_file(const scenario::Scenario& scenario) {
  if (!scenario.controller || scenario.controller->retentive.text.empty()) return {};
  return scenario.file.parent_path() / scenario.controller->retentive.text;
}

void keep_retentive(const scenario::Scenario& scenario, const std::string& state) {
  const auto file = retentive_file(scenario);
  if (file && scenario.controller->retains) write_file(*file, state);
}

std::unique_ptr<devices::Controller> load_controller(const scenario::Scenario& scenario, Problems& problems,
                                                     std::vector<Finding>* notes) {
  if (!scenario.controller) return nullptr;
  const auto& section = *scenario.controller;
  auto controller = section.load(scenario, problems, notes);
  if (!controller) return nullptr;
  restore(section.retentive, scenario, *controller, problems);
  set_values(section, scenario, *controller, problems);
  return controller;
}

}  // namespace drycut::sim::loop
