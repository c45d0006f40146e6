#include "sim/controller_loader.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.hpp"
#include "devices/catalogue.hpp"
#include "devices/lx3vp/lx3vp_controller.hpp"
#include "devices/plcopen/controller.hpp"
#include "devices/plcopen/tab_file.hpp"
#include "devices/qmove/cnf.hpp"
#include "devices/qmove/program.hpp"
#include "devices/qmove/qmove_controller.hpp"
#include "sim/file.hpp"
#include "sim/scenario/axis_units.hpp"
#include "sim/scenario/format.hpp"
#include "sim/scenario/yaml_reader.hpp"

namespace drycut::sim {

namespace {

namespace qmove = devices::qmove;

namespace lx3vp = devices::lx3vp;

namespace plcopen = devices::plcopen;

/// Values that the scenario sets before power-up.
void set_values(const std::vector<std::pair<Text, double>>& values, const Scenario& scenario,
                devices::Controller& controller, std::string_view what_there_is, Problems& problems) {
  for (const auto& [name, number] : values) {
    const auto value = controller.find(name.text);
    if (value && value->write) {
      const auto fault =
          value->range ? devices::misfit(value->name, *value->range, number, value->unit) : std::nullopt;
      if (fault) problems.push_back(problem_at(scenario, name.place, fault->what, fault->remedy));
      if (!fault) value->write(number);
      continue;
    }
    const auto near = nearest(name.text, controller.names());
    problems.push_back(problem_at(
        scenario, name.place,
        value ? fmt::format("'{}' can only be read", name.text)
              : fmt::format("the controller has nothing called '{}'", name.text),
        near.empty() || value ? std::string(what_there_is) : fmt::format("did you mean {}?", near)));
  }
}

/// Puts the values of the retentive file back, if there is one. It must be possible to write it at the end.
template <typename Controller>
void restore(const Text& retentive, const Scenario& scenario, Controller& controller, Problems& problems) {
  const auto file = retentive_file(scenario);
  if (!file) return;
  const auto refuse = [&](const std::string& what, const std::string& remedy) {
    problems.push_back(problem_at(scenario, retentive.place, what, remedy));
  };
  std::error_code ignored;
  const auto folder = file->has_parent_path() ? file->parent_path() : std::filesystem::path(".");
  if (!std::filesystem::is_directory(folder, ignored)) {
    refuse(fmt::format("there is no directory {}", folder.string()), "make it first, or name another file");
    return;
  }
  if (const auto why = hindrance(*file); !why.empty()) {
    refuse(fmt::format("{} cannot be written at the end of the run: {}", file->string(), why),
           "name another file");
    return;
  }
  if (!std::filesystem::exists(*file)) return;
  const auto kept = read_file(*file, problems, problem_at(scenario, retentive.place, "", ""));
  if (kept) controller.restore(*kept, problems, file->string());
}

std::unique_ptr<devices::Controller> load_qmove(const QmoveSection& section, const Scenario& scenario,
                                                Problems& problems, std::vector<std::string>* notes) {
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
  if (notes != nullptr)
    for (const auto& program : programs)
      notes->insert(notes->end(), program.notes.begin(), program.notes.end());
  auto controller = std::make_unique<qmove::QmoveController>(std::move(configuration), std::move(programs),
                                                             devices::catalogue(), section.cycle);
  restore(section.retentive, scenario, *controller, problems);
  set_values(section.set, scenario, *controller,
             "name a program variable or a device parameter (drycut devices)", problems);
  return controller;
}

std::unique_ptr<devices::Controller> load_lx3vp(const Lx3vpSection& section, const Scenario& scenario,
                                                Problems& problems) {
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
  set_values(section.set, scenario, *controller,
             "name a register: D10, DD10 (32 bit), FD10 (float), D10.A, M0, S0, T0 or C0", problems);
  return controller;
}

/// The cam tables, each under its file's name and its own id.
std::vector<plcopen::CamTable> read_tables(const PlcopenSection& section,
                                           const std::vector<plcopen::AxisConfiguration>& axes,
                                           const Scenario& scenario, Problems& problems) {
  std::vector<plcopen::CamTable> tables;
  std::vector<plcopen::MasterTurn> masters;
  for (const auto& [name, parameters, measure] : axes)
    if (parameters.is_master != 0 && parameters.modulo > 0) masters.push_back({name, parameters.modulo});
  for (const auto& entry : section.tables) {
    const auto path = scenario.file.parent_path() / entry.file.text;
    const auto complain = [&](std::string what, std::string remedy) {
      problems.push_back(problem_at(scenario, entry.file.place, std::move(what), std::move(remedy)));
    };
    if (path.extension() != ".tab" && path.extension() != ".csv") {
      complain(fmt::format("'{}' is no kind of cam table that is known", entry.file.text),
               "give a table of the kernel (.tab) or a cam as CSV (.csv)");
      continue;
    }
    const auto text = read_file(path, problems, problem_at(scenario, entry.file.place, "", ""));
    if (!text) continue;
    std::optional<plcopen::CamTable> table;
    if (path.extension() == ".tab") {
      table = plcopen::parse_tab(*text, path.string(), problems);
    } else if (auto cam = plcopen::parse_cam_csv(*text, path.string(), problems, masters)) {
      table = std::move(cam->table);
    }
    if (!table) continue;
    table->file = path.filename().string();
    if (entry.id != 0) table->id = static_cast<std::uint16_t>(entry.id);
    for (const auto& other : tables) {
      if (other.id == table->id)
        complain(fmt::format("{} has id {}, as {} has", table->file, table->id, other.file),
                 fmt::format("give one an id of its own: {{file: {}, id: {}}}", entry.file.text,
                             tables.size() + 1));
      else if (other.file == table->file)
        complain(fmt::format("two tables are called {}", table->file),
                 "programs find them by name: rename one");
    }
    tables.push_back(std::move(*table));
  }
  return tables;
}

/// What the program names must be there: axes and tables.
void check_names(const plcopen::st::Program& program, const std::string& file,
                 const plcopen::Configuration& configuration, Problems& problems) {
  const auto check = [&](const std::vector<plcopen::st::Program::Name>& wanted,
                         const std::vector<std::string>& there, bool any_case, std::string_view what,
                         std::string_view section) {
    for (const auto& name : wanted) {
      const auto same = [&](const std::string& other) {
        return any_case ? same_word(other, name.name) : other == name.name;
      };
      if (std::any_of(there.begin(), there.end(), same)) continue;
      const auto near = nearest(name.name, there);
      problems.push_back(
          {file, name.line, name.column, fmt::format("the scenario has no {} '{}'", what, name.name),
           near.empty()
               ? fmt::format("add it to controller.plcopen.{}", section)
               : fmt::format("did you mean {}? Else add it to controller.plcopen.{}", near, section)});
    }
  };
  std::vector<std::string> axes;
  std::vector<std::string> tables;
  for (const auto& axis : configuration.axes) axes.push_back(axis.name);
  for (const auto& table : configuration.tables) tables.push_back(table.file);
  check(program.externals(), axes, true, "axis", "axes");
  check(program.tables(), tables, false, "cam table", "tables");
}

/// The scenario's tasks name programs that are there; several programs need tasks, the CONFIGURATION's own
/// fit the axes' cycle.
void check_tasks(const plcopen::st::Program& program, const std::string& file, const PlcopenSection& section,
                 const Scenario& scenario, Problems& problems) {
  for (const auto& task : program.tasks())
    if (task.interval_ns % section.cycle != 0)
      problems.push_back({file, task.line, task.column,
                          fmt::format("the task {} runs every {}, not a whole multiple of the cycle {}",
                                      task.name, format_time(task.interval_ns), format_time(section.cycle)),
                          "change INTERVAL or controller.plcopen.cycle"});
  if (section.tasks.empty()) {
    if (program.has_configuration() || program.instances().size() < 2) return;
    const auto& second = program.instances()[1];
    problems.push_back(
        {file, second.line, second.column, fmt::format("a second PROGRAM, '{}', without a task", second.name),
         fmt::format("CONFIGURATION ... TASK says when it runs, or the scenario: controller.plcopen.tasks: "
                     "{{slow: {{cycle: 20 ms, programs: [{}]}}}}",
                     second.name)});
    return;
  }
  if (program.has_configuration()) {
    problems.push_back(problem_at(scenario, section.tasks.front().name.place,
                                  "the program's CONFIGURATION has the tasks",
                                  "leave out controller.plcopen.tasks, or the CONFIGURATION"));
    return;
  }
  std::vector<std::string> names;
  for (const auto& instance : program.instances()) names.push_back(instance.name);
  for (const auto& task : section.tasks)
    for (const auto& wanted : task.programs)
      if (std::none_of(names.begin(), names.end(),
                       [&](const std::string& name) { return same_word(name, wanted.text); }))
        problems.push_back(problem_at(scenario, wanted.place,
                                      fmt::format("there is no PROGRAM '{}'", wanted.text),
                                      did_you_mean(wanted.text, names)));
}

/// True if the scenario sets the value, before power-up or in its timeline.
bool sets(const Scenario& scenario, const PlcopenSection& section, const std::string& value) {
  const auto names_it = [&](const auto& list) {
    return std::any_of(list.begin(), list.end(),
                       [&](const auto& entry) { return same_word(entry.first.text, value); });
  };
  return names_it(section.set) ||
         std::any_of(scenario.timeline.begin(), scenario.timeline.end(), [&](const Stimulus& stimulus) {
           return names_it(stimulus.set) || names_it(stimulus.ramp);
         });
}

/// The kernel's own v_phasing is so slow that a slave seems to hang on its way to the cam. MC_GearIn does not
/// need it: a gear has no place to go to.
void note_slow_phasing(const plcopen::st::Program& program, const PlcopenSection& section,
                       const Scenario& scenario, std::vector<std::string>& notes) {
  if (!program.has_motion_block("MC_CamIn")) return;
  const auto& phasing = *plcopen::find_axis_parameter("cam_gear.v_phasing");
  for (const auto& axis : section.axes) {
    const auto& parameters = axis.configuration.parameters;
    const bool encoder = parameters.kind == static_cast<double>(plcopen::AxisKind::encoder);
    if (encoder || parameters.is_master != 0) continue;  // masters
    const auto name = fmt::format("{}.{}", axis.name.text, phasing.name);
    if (parameters.v_phasing != plcopen::AxisParameters{}.v_phasing || sets(scenario, section, name))
      continue;
    notes.push_back(fmt::format(
        "{} is at its default, {}: MC_CamIn will hardly reach its cam; give v_phasing, a_phasing, "
        "d_phasing and j_phasing",
        name, axis_value_text(phasing, parameters.v_phasing, axis.configuration.measure)));
  }
}

std::unique_ptr<devices::Controller> load_plcopen(const PlcopenSection& section, const Scenario& scenario,
                                                  Problems& problems, std::vector<std::string>* notes) {
  const auto before = problems.size();
  const auto file = (scenario.file.parent_path() / section.program.text).string();
  plcopen::Configuration configuration;
  configuration.cycle_ns = section.cycle;
  configuration.task_ns = section.task_cycle;
  for (const auto& axis : section.axes) configuration.axes.push_back(axis.configuration);
  for (const auto& task : section.tasks) {
    configuration.tasks.push_back({task.name.text, 0, 0, task.cycle, task.priority, {}});
    for (const auto& name : task.programs) configuration.tasks.back().programs.push_back(name.text);
  }
  configuration.tables = read_tables(section, configuration.axes, scenario, problems);
  const bool tables_sound = problems.size() == before;
  plcopen::st::Program program;
  if (const auto text = read_file(file, problems, problem_at(scenario, section.program.place, "", ""))) {
    program = plcopen::st::compile(*text, file, problems);
    // A table that could not be read is not missing.
    if (tables_sound) check_names(program, file, configuration, problems);
    if (problems.size() == before) check_tasks(program, file, section, scenario, problems);
  }
  if (problems.size() != before) return nullptr;
  if (notes != nullptr) note_slow_phasing(program, section, scenario, *notes);
  auto controller =
      std::make_unique<plcopen::PlcopenController>(std::move(program), file, std::move(configuration));
  restore(section.retentive, scenario, *controller, problems);
  set_values(section.set, scenario, *controller,
             "name a variable of the program, or a value or parameter of an axis (drycut devices AXIS)",
             problems);
  return controller;
}

/// nullptr if the scenario names none.
const Text* retentive_text(const Scenario& scenario) {
  const Text* path = nullptr;
  if (const auto* section = std::get_if<QmoveSection>(&scenario.controller)) path = &section->retentive;
  if (const auto* section = std::get_if<Lx3vpSection>(&scenario.controller)) path = &section->retentive;
  if (const auto* section = std::get_if<PlcopenSection>(&scenario.controller)) path = &section->retentive;
  return path == nullptr || path->text.empty() ? nullptr : path;
}

}  // namespace

std::vector<Text> controller_files(const Scenario& scenario) {
  std::vector<Text> files;
  if (const auto* qmove = std::get_if<QmoveSection>(&scenario.controller)) {
    files = qmove->tasks;
    files.push_back(qmove->configuration);
  }
  if (const auto* lx3vp = std::get_if<Lx3vpSection>(&scenario.controller)) {
    files.push_back(lx3vp->program);
    if (!lx3vp->registers.text.empty()) files.push_back(lx3vp->registers);
  }
  if (const auto* plcopen = std::get_if<PlcopenSection>(&scenario.controller)) {
    files.push_back(plcopen->program);
    for (const auto& table : plcopen->tables) files.push_back(table.file);
  }
  if (const auto* retentive = retentive_text(scenario)) files.push_back(*retentive);
  return files;
}

std::optional<std::filesystem::path> retentive_file(const Scenario& scenario) {
  const auto* path = retentive_text(scenario);
  if (path == nullptr) return {};
  return scenario.file.parent_path() / path->text;
}

std::unique_ptr<devices::Controller> load_controller(const Scenario& scenario, Problems& problems,
                                                     std::vector<std::string>* notes) {
  if (const auto* section = std::get_if<QmoveSection>(&scenario.controller))
    return load_qmove(*section, scenario, problems, notes);
  if (const auto* section = std::get_if<Lx3vpSection>(&scenario.controller))
    return load_lx3vp(*section, scenario, problems);
  if (const auto* section = std::get_if<PlcopenSection>(&scenario.controller))
    return load_plcopen(*section, scenario, problems, notes);
  return nullptr;
}

}  // namespace drycut::sim
