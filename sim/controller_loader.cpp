#include "sim/controller_loader.hpp"

#include <fmt/format.h>

#include "devices/catalogue.hpp"
#include "devices/lx3vp/lx3vp_controller.hpp"
#include "devices/qmove/cnf.hpp"
#include "devices/qmove/program.hpp"
#include "devices/qmove/qmove_controller.hpp"
#include "sim/file.hpp"

namespace drycut::sim {

namespace {

namespace qmove = devices::qmove;

namespace lx3vp = devices::lx3vp;

/// Values that the scenario sets before power-up.
void set_values(const std::vector<std::pair<Text, double>>& values, const Scenario& scenario,
                devices::Controller& controller, std::string_view what_there_is,
                devices::Problems& problems) {
  for (const auto& [name, number] : values) {
    const auto value = controller.find(name.text);
    if (value && value->write) {
      value->write(number);
      continue;
    }
    const auto near = devices::nearest(name.text, controller.names());
    problems.push_back(problem_at(
        scenario, name.place,
        value ? fmt::format("'{}' can only be read", name.text)
              : fmt::format("the controller has nothing called '{}'", name.text),
        near.empty() || value ? std::string(what_there_is) : fmt::format("did you mean {}?", near)));
  }
}

/// Puts the values of the retentive file back, if there is one.
template <typename Controller>
void restore(const Text& retentive, const Scenario& scenario, Controller& controller,
             devices::Problems& problems) {
  const auto file = retentive_file(scenario);
  if (!file || !std::filesystem::exists(*file)) return;
  const auto kept = read_file(*file, problems, problem_at(scenario, retentive.place, "", ""));
  if (kept) controller.restore(*kept, problems, file->string());
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
  restore(section.retentive, scenario, *controller, problems);
  set_values(section.set, scenario, *controller,
             "name a program variable or a device parameter (drycut devices)", problems);
  return controller;
}

/// A register takes only what it holds.
void check_registers(const Lx3vpSection& section, const Scenario& scenario, devices::Problems& problems) {
  for (const auto& [name, number] : section.set) {
    const auto named = lx3vp::parse_register(name.text);
    if (!named) continue;  // told by set_values
    if (auto fault = lx3vp::misfit(*named, number))
      problems.push_back(problem_at(scenario, name.place, std::move(fault->what), std::move(fault->remedy)));
  }
}

std::unique_ptr<devices::Controller> load_lx3vp(const Lx3vpSection& section, const Scenario& scenario,
                                                devices::Problems& problems) {
  const auto before = problems.size();
  const auto folder = scenario.file.parent_path();
  const auto path_of = [&](const Text& path) { return (folder / path.text).string(); };
  const auto read = [&](const Text& path) {
    return read_file(folder / path.text, problems, problem_at(scenario, path.place, "", ""));
  };
  lx3vp::il::Program program;
  if (const auto text = read(section.program))
    program = lx3vp::il::compile(*text, path_of(section.program), problems);
  std::vector<lx3vp::RegisterValue> registers;
  if (!section.registers.text.empty()) {
    if (const auto text = read(section.registers))
      registers = lx3vp::read_register_values(*text, path_of(section.registers), ',', problems);
  }
  if (problems.size() != before) return nullptr;
  auto controller = std::make_unique<lx3vp::Lx3vpController>(std::move(program), section.scan);
  for (const auto& entry : registers) lx3vp::write(controller->registers(), entry.name, entry.value);
  restore(section.retentive, scenario, *controller, problems);
  check_registers(section, scenario, problems);
  set_values(section.set, scenario, *controller,
             "name a register: D10, DD10 (32 bit), FD10 (float), D10.A, M0, S0, T0 or C0", problems);
  return controller;
}

}  // namespace

std::optional<std::filesystem::path> retentive_file(const Scenario& scenario) {
  const Text* path = nullptr;
  if (const auto* section = std::get_if<QmoveSection>(&scenario.controller)) path = &section->retentive;
  if (const auto* section = std::get_if<Lx3vpSection>(&scenario.controller)) path = &section->retentive;
  if (path == nullptr || path->text.empty()) return {};
  return scenario.file.parent_path() / path->text;
}

std::unique_ptr<devices::Controller> load_controller(const Scenario& scenario, devices::Problems& problems) {
  if (const auto* section = std::get_if<QmoveSection>(&scenario.controller))
    return load_qmove(*section, scenario, problems);
  if (const auto* section = std::get_if<Lx3vpSection>(&scenario.controller))
    return load_lx3vp(*section, scenario, problems);
  return nullptr;
}

}  // namespace drycut::sim
