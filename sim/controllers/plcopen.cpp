#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/text.hpp"
#include "devices/plcopen/controller/controller.hpp"
#include "devices/plcopen/tab_file.hpp"
#include "sim/controllers/kinds.hpp"
#include "sim/controllers/plcopen_scales.hpp"
#include "sim/controllers/program_files.hpp"
#include "sim/file.hpp"
#include "sim/scenario/archive.hpp"
#include "sim/scenario/axis_units.hpp"
#include "sim/scenario/format.hpp"

namespace drycut::sim::controllers {

namespace plcopen = devices::plcopen;

namespace {

void check_multiple(scenario::MapReader& reader, std::string_view key, Time time, Time cycle) {
  if (time % cycle == 0) return;
  reader.refuse(
      "scenario.time-grid"_code, key,
      fmt::format("{} {} is not a whole multiple of the cycle {}", reader.full(key),
                  scenario::format_time(time), scenario::format_time(cycle)),
      fmt::format("for example {}", scenario::format_time(std::max<Time>(1, time / cycle) * cycle)));
}

scenario::Form dialect_form(std::optional<plcopen::st::StDialect>& dialect) {
  auto form = scenario::choice_form(
      {plcopen::st::dialect_names.begin(), plcopen::st::dialect_names.end()},
      [&dialect] { return static_cast<std::size_t>(*dialect); },
      [&dialect](std::size_t number) { dialect = static_cast<plcopen::st::StDialect>(number); });
  form.write = [&dialect, write = form.write] { return dialect ? write() : ""; };
  return form;
}

// tasks: {fast: {cycle: 2 ms, priority: 1, programs: [Main]}}
void visit_task(scenario::Archive& archive, PlcopenSection& section, std::size_t number) {
  constexpr int last_priority = 65535;
  auto& task = section.tasks[number];
  archive.in_line();
  archive.value({"cycle", "a whole multiple of the axes' cycle"},
                scenario::form(task.cycle, scenario::Sign::positive));
  archive.value({"priority", "0 runs first"}, scenario::form(task.priority, 0, last_priority));
  archive.value({"programs", "its PROGRAMs, in the order in which they run"}, scenario::form(task.programs));
  archive.judge([&section, number](scenario::MapReader& reader) {
    const auto& judged = section.tasks[number];
    if (judged.programs.empty()) reader.missing("programs", "name its PROGRAMs: programs: [Main]");
    check_multiple(reader, "cycle", judged.cycle, section.cycle);
    for (std::size_t i = 0; i < number; ++i)
      for (const auto& program : section.tasks[i].programs)
        for (const auto& again : judged.programs)
          if (same_word(program.text, again.text))
            reader.findings().add(
                "controller.twice"_code, again.place,
                fmt::format("{} runs in {} already", again.text, section.tasks[i].name.text),
                "a program has one task");
  });
}

void judge_axis_names(const std::vector<PlcopenSection::Axis>& axes, scenario::Findings& findings) {
  for (auto axis = axes.begin(); axis != axes.end(); ++axis) {
    const auto& name = axis->name;
    const auto same = std::find_if(axes.begin(), axis, [&](const PlcopenSection::Axis& other) {
      return same_word(other.name.text, name.text);
    });
    if (!is_identifier(name.text) || name.text == "panel")
      findings.add("controller.bad-name"_code, name.place,
                   fmt::format("'{}' is no name of an axis", name.text),
                   "letters, digits and underscores, as the program's VAR_EXTERNAL spells it");
    else if (same != axis)
      findings.add(
          "controller.twice"_code, name.place,
          fmt::format("axis {} is {} already: names are the same in any case", name.text, same->name.text),
          "keep one");
  }
}

/// The cam tables, each under its file's name and its own id.
std::vector<plcopen::McCamTable> load_tables(const PlcopenSection& section,
                                             const std::vector<plcopen::AxisConfiguration>& axes,
                                             const scenario::Scenario& scenario, Problems& problems) {
  std::vector<plcopen::McCamTable> tables;
  std::vector<plcopen::MasterTurn> masters;
  for (const auto& [name, parameters, measure] : axes)
    if (parameters.is_master && parameters.modulo > 0) masters.push_back({name, parameters.modulo});
  for (const auto& entry : section.tables) {
    const auto path = scenario.file.parent_path() / entry.file.text;
    const auto complain = [&](Code code, std::string what, std::string remedy) {
      problems.push_back(
          scenario::problem_at(code, scenario, entry.file.place, std::move(what), std::move(remedy)));
    };
    if (path.extension() != ".tab" && path.extension() != ".csv") {
      complain("controller.cam-kind"_code,
               fmt::format("'{}' is no kind of cam table that is known", entry.file.text),
               "give a table of the kernel (.tab) or a cam as CSV (.csv)");
      continue;
    }
    const auto text = read_named_table(entry.file, scenario, problems);
    if (!text) continue;
    std::optional<plcopen::McCamTable> table;
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
        complain("controller.twice"_code,
                 fmt::format("{} has id {}, as {} has", table->file, table->id, other.file),
                 fmt::format("give one an id of its own: {{file: {}, id: {}}}", entry.file.text,
                             tables.size() + 1));
      else if (other.file == table->file)
        complain("controller.twice"_code, fmt::format("two tables are called {}", table->file),
                 "programs find them by name: rename one");
    }
    tables.push_back(std::move(*table));
  }
  return tables;
}

/// What the program names must be there: axes and tables.
void check_names(const plcopen::st::Program& program, const plcopen::PlcopenConfiguration& configuration,
                 Problems& problems) {
  const auto check = [&](const std::vector<plcopen::st::Program::Name>& wanted,
                         const std::vector<std::string>& there, bool any_case, std::string_view what,
                         std::string_view section) {
    for (const auto& name : wanted) {
      const auto same = [&](const std::string& other) {
        return any_case ? same_word(other, name.name) : other == name.name;
      };
      if (std::any_of(there.begin(), there.end(), same)) continue;
      const auto near = nearest(name.name, there);
      problems.push_back(program.problem_at(
          "controller.unknown-name"_code, name.line, name.column,
          fmt::format("the scenario has no {} '{}'", what, name.name),
          near.empty()
              ? fmt::format("add it to controller.plcopen.{}", section)
              : fmt::format("did you mean {}? Else add it to controller.plcopen.{}", near, section)));
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
void check_tasks(const plcopen::st::Program& program, const PlcopenSection& section,
                 const scenario::Scenario& scenario, Problems& problems) {
  for (const auto& task : program.tasks())
    if (task.interval_ns % section.cycle != 0)
      problems.push_back(program.problem_at(
          "scenario.time-grid"_code, task.line, task.column,
          fmt::format("the task {} runs every {}, not a whole multiple of the cycle {}", task.name,
                      scenario::format_time(task.interval_ns), scenario::format_time(section.cycle)),
          "change INTERVAL or controller.plcopen.cycle"));
  if (section.tasks.empty()) {
    if (program.has_configuration() || program.instances().size() < 2) return;
    const auto& second = program.instances()[1];
    problems.push_back(program.problem_at(
        "controller.twice"_code, second.line, second.column,
        fmt::format("a second PROGRAM, '{}', without a task", second.name),
        fmt::format("CONFIGURATION ... TASK says when it runs, or the scenario: controller.plcopen.tasks: "
                    "{{slow: {{cycle: 20 ms, programs: [{}]}}}}",
                    second.name)));
    return;
  }
  if (program.has_configuration()) {
    problems.push_back(scenario::problem_at("scenario.does-not-go-together"_code, scenario,
                                            section.tasks.front().name.place,
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
        problems.push_back(scenario::problem_at("controller.unknown-name"_code, scenario, wanted.place,
                                                fmt::format("there is no PROGRAM '{}'", wanted.text),
                                                did_you_mean(wanted.text, names)));
}

/// The kernel's own v_phasing is so slow that a slave seems to hang on its way to the cam. MC_GearIn does not
/// need it: a gear has no place to go to.
void note_slow_phasing(const plcopen::st::Program& program, const PlcopenSection& section,
                       const scenario::Scenario& scenario, std::vector<Finding>& notes) {
  if (!program.has_motion_block("MC_CamIn")) return;
  const auto& phasing = *plcopen::find_axis_parameter("cam_gear.v_phasing");
  for (const auto& axis : section.axes) {
    const auto& parameters = axis.configuration.parameters;
    const bool encoder = parameters.kind == plcopen::AxisKind::encoder;
    if (encoder || parameters.is_master) continue;  // masters
    const auto name = fmt::format("{}.{}", axis.name.text, phasing.name);
    if (parameters.v_phasing != plcopen::AxisParameters{}.v_phasing || scenario::sets(scenario, name))
      continue;
    notes.emplace_back(
        "controller.slow-phasing"_code,
        fmt::format(
            "{} is at its default, {}: MC_CamIn will hardly reach its cam; give v_phasing, a_phasing, "
            "d_phasing and j_phasing",
            name, scenario::axis_value_text(phasing, parameters, axis.configuration.measure)));
  }
}

}  // namespace

// tables: [cams/knife.tab, {file: cams/eject.csv, id: 2}]
void visit(scenario::Archive& archive, PlcopenSection::Table& table) {
  constexpr int last_id = 65535;
  if (archive.instead(table.id == 0, scenario::path_form(table.file))) return;
  archive.in_line();
  archive.value({"file", "a table of the kernel (.tab) or a cam as CSV"}, scenario::path_form(table.file));
  archive.value({"id", "in place of the file's own"}, scenario::form(table.id, 1, last_id));
  archive.require("file", "add file: cams/knife.tab");
}

void PlcopenSection::visit(scenario::Archive& archive) {
  archive.value({"program", "Structured Text: a file, a folder for its *.st, or a list of both"},
                scenario::paths_form(program));
  archive.require("program", "add program: programs/knife.st");
  archive.value({"dialect", "of the program, where IEC 61131-3 and CODESYS differ: 'drycut devices ST'"},
                dialect_form(dialect));
  archive.value({"cycle", "of the axes"}, scenario::form(cycle, scenario::Sign::positive));
  if (archive.reads()) task_cycle = cycle;
  archive.value({"task_cycle", "of the program, a whole multiple of cycle"},
                scenario::form(task_cycle, scenario::Sign::positive));
  archive.value({"statement_time",
                 "what a statement of the program takes: a task gives its outputs at its end; 0: statements "
                 "take no time"},
                scenario::form(statement_time, scenario::Sign::not_negative));
  archive.names({"tasks", "of several PROGRAMs"},
                {tasks.size(), [this](std::size_t i) { return tasks[i].name.text; },
                 [this](const scenario::Text& name) {
                   tasks.push_back({name, task_cycle, 0, {}});
                 },
                 [this] { tasks.pop_back(); },
                 [this](scenario::Archive& inner, std::size_t i) { visit_task(inner, *this, i); }});
  archive.names({"axes", "by the names that the program has for them; 'drycut devices AXIS'"}, axes,
                &Axis::name, true);
  archive.list({"tables", "cam tables: a path, or a path and an id"}, tables, true);
  if (archive.reads()) std::erase_if(tables, [](const Table& table) { return table.file.text.empty(); });
  const bool maps = !(modbus.coils.empty() && modbus.discrete_inputs.empty() &&
                      modbus.holding_registers.empty() && modbus.input_registers.empty());
  archive.section({"modbus", "what an HMI finds at which address, beside variables AT %M", maps},
                  [this](scenario::Archive& inner) { visit_modbus(inner); });
  visit_compute_time(archive, *this);
  visit_memory(archive, *this);
  archive.judge([this](scenario::MapReader& reader) {
    find_program_files(reader.findings());
    check_multiple(reader, "task_cycle", task_cycle, cycle);
    judge_axis_names(axes, reader.findings());
  });
}

/// Of a folder its *.st by name, not those below it.
void PlcopenSection::find_program_files(scenario::Findings& findings) {
  const std::filesystem::path scene(findings.sources().front());
  program_files.clear();
  for (const auto& entry : program) {
    if (!folder_exists(scene.parent_path() / entry.text)) {
      program_files.push_back(entry);
      continue;
    }
    const auto found = files_in(scene.parent_path() / entry.text, ".st");
    if (found.empty())
      findings.add("file.missing"_code, entry.place, fmt::format("there is no *.st in {}", entry.text),
                   "name a file, or the folder that has them");
    for (const auto& file : found)
      program_files.push_back(
          {(std::filesystem::path(entry.text) / file.filename()).lexically_normal().string(), entry.place});
  }
  for (auto file = program_files.begin(); file != program_files.end(); ++file)
    if (std::any_of(program_files.begin(), file, [&](const auto& other) { return other.text == file->text; }))
      findings.add("controller.twice"_code, file->place, fmt::format("{} is named twice", file->text),
                   "once is enough");
}

std::vector<scenario::Text> PlcopenSection::files() const {
  std::vector<scenario::Text> files = program_files;
  for (const auto& table : tables) files.push_back(table.file);
  return files;
}

std::string_view PlcopenSection::settable() const {
  return "name a variable of the program, or a value or parameter of an axis (drycut devices AXIS)";
}

std::vector<Finding> PlcopenSection::contradictions(const scenario::Scenario& scenario,
                                                    const ScaleOf& scale_of) const {
  auto found = contradicting_scales(*this, scenario, scale_of);
  std::vector<plcopen::AxisConfiguration> configurations;
  for (const auto& axis : axes) configurations.push_back(axis.configuration);
  Problems told;  // by load()
  const auto cams = load_tables(*this, configurations, scenario, told);
  for (const auto& file : program_files) {
    const auto text = read_named(file, scenario, told);
    if (!text || text->find("Scaling") != std::string::npos)
      return found;  // the program makes another cam of it
  }
  for (auto& note : contradicting_cams(*this, cams, scenario)) found.push_back(std::move(note));
  return found;
}

std::unique_ptr<devices::Controller> PlcopenSection::load(const scenario::Scenario& scenario,
                                                          Problems& problems,
                                                          std::vector<Finding>* notes) const {
  const auto before = problems.size();
  plcopen::PlcopenConfiguration configuration;
  configuration.cycle_ns = cycle;
  configuration.task_ns = task_cycle;
  configuration.statement_ns = statement_time;
  for (const auto& axis : axes) configuration.axes.push_back(axis.configuration);
  for (const auto& task : tasks) {
    configuration.tasks.push_back({task.name.text, 0, 0, task.cycle, task.priority, {}});
    for (const auto& name : task.programs) configuration.tasks.back().programs.push_back(name.text);
  }
  configuration.tables = load_tables(*this, configuration.axes, scenario, problems);
  const bool tables_sound = problems.size() == before;
  plcopen::st::Program compiled;
  std::vector<SourceFile> sources;
  std::vector<std::string> names;
  for (const auto& file : program_files) {
    auto text = read_program("plcopen.program", file, scenario, problems);
    if (!text) continue;
    sources.push_back({(scenario.file.parent_path() / file.text).string(), std::move(*text)});
    names.push_back(file.text);
  }
  if (!sources.empty() && sources.size() == program_files.size()) {
    compiled = plcopen::st::compile(sources, {.dialect = dialect}, problems);
    // A table that could not be read is not missing.
    if (tables_sound) check_names(compiled, configuration, problems);
    if (problems.size() == before) check_tasks(compiled, *this, scenario, problems);
  }
  if (problems.size() != before) return nullptr;
  if (notes != nullptr) {
    for (const auto& axis : axes) notes->insert(notes->end(), axis.notes.begin(), axis.notes.end());
    note_slow_phasing(compiled, *this, scenario, *notes);
  }
  auto controller = std::make_unique<plcopen::PlcopenController>(std::move(compiled), std::move(names),
                                                                 std::move(configuration));
  fill_modbus(*controller, scenario, problems);
  if (problems.size() != before) return nullptr;
  return controller;
}

}  // namespace drycut::sim::controllers
