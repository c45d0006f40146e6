#include "sim/cli/check_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>

#include "base/text.hpp"
#include "devices/lx3vp/il_program.hpp"
#include "devices/lx3vp/register_file.hpp"
#include "devices/plcopen/st/program.hpp"
#include "devices/qmove/catalogue.hpp"
#include "devices/qmove/cnf.hpp"
#include "devices/qmove/program.hpp"
#include "sim/cams/study.hpp"
#include "sim/cli/annotations.hpp"
#include "sim/cli/arguments.hpp"
#include "sim/cli/file_kinds.hpp"
#include "sim/cli/table_values.hpp"
#include "sim/cli/verb.hpp"
#include "sim/file.hpp"
#include "sim/loop/simulation.hpp"
#include "sim/recordings/recording.hpp"
#include "sim/report/part_meshes.hpp"
#include "sim/studies/compare/scene_run.hpp"

namespace drycut::sim::cli {

namespace {

namespace qmove = devices::qmove;

/// Checks files in the order given; a configuration stands for the modules after it.
class Checker {
 public:
  explicit Checker(const CheckOptions& options)
      : expand_(options.expand), overrides_(overrides_of(options.set, problems_)) {}

  void check(const std::filesystem::path& file) {
    switch (kind_of(file)) {
      case FileKind::scenario:
      case FileKind::comparison:
        return check_scenario(file);
      case FileKind::recording:
        return check_recording(file);
      case FileKind::configuration:
        return check_configuration(file);
      case FileKind::module:
        return check_module(file);
      case FileKind::instruction_list:
      case FileKind::program_table:
        if (const auto text = read_file(file, problems_))
          take_doubts(devices::lx3vp::il::compile(*text, file.string(), problems_));
        return;
      case FileKind::structured_text:
        return take_structured_text(file);
      case FileKind::registers:
        if (const auto text = read_file(file, problems_))
          devices::lx3vp::read_register_values(*text, file.string(), ',', problems_);
        return;
      case FileKind::cam_table:
        if (const auto text = read_file(file, problems_))
          cams::read_cam(lower(file.extension().string()) == ".tab" ? "mc_camin" : "",
                         with_values(*text, file, {}, problems_).text, file.string(), problems_);
        return;
      default:
        problems_.push_back(
            {"file.other-kind"_code, file.string(), 1, 1,
             fmt::format("'{}' is not a kind of file that is known", file.extension().string()),
             "give a scenario or recording (.yaml), a configuration (.cnf), a QCL module (.mod, .qcl), an "
             "instruction "
             "list (.il), Structured Text (.st), a cam table (.csv, .tab) or registers (.csv)"});
    }
  }

  /// When all files are known.
  void finish() { check_structured_text(); }

  [[nodiscard]] const Problems& problems() const { return problems_; }
  /// What is no fault and worth knowing.
  [[nodiscard]] const std::vector<Finding>& notes() const { return notes_; }
  /// What may be a slip.
  [[nodiscard]] const std::vector<Finding>& warnings() const { return warnings_; }

 private:
  /// A file, or all of a folder.
  void take_structured_text(const std::filesystem::path& file) {
    const auto files = folder_exists(file) ? files_in(file, ".st") : std::vector{file};
    for (const auto& one : files)
      if (auto text = read_file(one, problems_)) structured_text_.push_back({one.string(), std::move(*text)});
  }

  /// They are one program, unless each of them is one.
  void check_structured_text() {
    namespace st = devices::plcopen::st;
    if (structured_text_.empty()) return;
    constexpr st::CompileOptions library{.library = true};
    Problems together;
    auto notes = st::compile(structured_text_, library, together).notes();
    if (!together.empty()) {
      Problems alone;
      std::vector<Finding> of_each;
      for (const auto& [name, text] : structured_text_)
        for (auto& note : st::compile(text, name, alone, library).notes()) of_each.push_back(std::move(note));
      if (alone.empty())
        notes = std::move(of_each);
      else
        problems_.insert(problems_.end(), together.begin(), together.end());
    }
    notes_.insert(notes_.end(), notes.begin(), notes.end());
  }

  void take_doubts(const devices::lx3vp::il::IlProgram& program) {
    for (auto& doubt : devices::lx3vp::il::doubts(program)) notes_.push_back(std::move(doubt));
  }

  void take_notes(const std::string& of, const loop::Simulation& simulation) {
    const auto take = [&](const std::vector<Finding>& findings, std::vector<Finding>& kept) {
      for (const auto& finding : findings) kept.emplace_back(finding).text = of + ": " + finding.text;
    };
    take(simulation.warnings(), warnings_);
    take(simulation.notes_of_setup(), notes_);
  }

  /// A comparing scene: its members, then what it asks of them.
  void check_comparing(const studies::ComparisonScene& scene) {
    std::vector<studies::MemberNames> names;
    for (const auto& member : scene.members) {
      Problems own;
      const auto scenario = studies::read_member(scene, member, overrides_, own);
      if (scenario.buildable) {
        const loop::Simulation simulation(scenario, own);
        report::load_part_meshes(scenario, simulation.plants(), own);
        take_notes(member.name.text, simulation);
        if (own.empty()) names.push_back(studies::names_of(simulation));
      }
      studies::place_in_scene(scene, member, own);
      problems_.insert(problems_.end(), own.begin(), own.end());
    }
    if (names.size() == scene.members.size()) sim::studies::check_comparison(scene, names, problems_);
  }

  void check_scenario(const std::filesystem::path& file) {
    const auto before = problems_.size();
    if (const auto scene = studies::read_comparison(file, problems_)) {
      if (problems_.size() == before) check_comparing(*scene);
      if (expand_ && problems_.size() == before) fmt::print("{}", sim::studies::expand(*scene));
      return;
    }
    const auto scenario = scenario::read_scenario(file, overrides_, problems_);
    if (scenario.buildable) {
      const loop::Simulation simulation(scenario, problems_);
      report::load_part_meshes(scenario, simulation.plants(), problems_);
      take_notes(file.string(), simulation);
      // That there is a guest is of no use beside what is wrong.
      if (problems_.size() > before)
        std::erase_if(notes_, [](const Finding& note) { return note.code == "fmu.guest"_code.text(); });
    }
    if (expand_ && problems_.size() == before) fmt::print("{}", sim::scenario::expand(scenario));
  }

  /// The YAML and, if that is sound, the export that it names.
  void check_recording(const std::filesystem::path& file) {
    const auto before = problems_.size();
    const auto recording = recordings::read_recording_file(file, problems_);
    if (problems_.size() != before) return;
    std::vector<Finding> findings;
    recordings::load(recording, problems_, findings);
    for (auto& finding : findings)
      (finding.role == Finding::Role::warning ? warnings_ : notes_).push_back(std::move(finding));
    if (expand_ && problems_.size() == before) fmt::print("{}", recordings::write(recording));
  }

  void check_configuration(const std::filesystem::path& file) {
    configuration_.reset();
    configuration_given_ = true;
    const auto before = problems_.size();
    if (const auto text = read_file(file, problems_)) {
      configuration_ = qmove::parse_configuration(*text, file.string(), devices::catalogue(), problems_);
      notes_.insert(notes_.end(), configuration_->notes.begin(), configuration_->notes.end());
    }
    if (problems_.size() != before) configuration_.reset();
  }

  void check_module(const std::filesystem::path& file) {
    // Modules are not judged by a configuration that is not sound.
    if (!configuration_ && configuration_given_) return;
    if (!configuration_) {
      problems_.push_back({"qcl.no-configuration"_code, file.string(), 1, 1,
                           "a QCL module needs a configuration to be checked against",
                           "name its .cnf file before it"});
      return;
    }
    if (const auto text = read_file(file, problems_)) {
      auto program =
          qmove::compile_module(*text, file.string(), *configuration_, devices::catalogue(), problems_, true);
      notes_.insert(notes_.end(), program.notes.begin(), program.notes.end());
    }
  }

  bool expand_;
  std::vector<Finding> warnings_;
  std::vector<Finding> notes_;
  Problems problems_;
  std::vector<scenario::Override> overrides_;
  std::optional<qmove::Configuration> configuration_;
  std::vector<SourceFile> structured_text_;
  bool configuration_given_ = false;
};

}  // namespace

int check_files(const CheckOptions& options) {
  Checker checker(options);
  for (const auto& file : options.files) checker.check(file);
  checker.finish();
  auto problems = checker.problems();
  check_annotate(options.annotate, problems);
  print_problems(problems);
  annotate(options.annotate, annotations_of(problems));
  if (!problems.empty()) {
    for (const auto& note : checker.notes()) fmt::print(stderr, "note {}\n", to_string(note));
    fmt::print(stderr, "{} in {}\n", counted(problems.size(), "problem"),
               counted(options.files.size(), "file"));
    return bad_input;
  }
  if (options.expand) return all_passed;
  for (const auto& warning : checker.warnings()) fmt::print("warning {}\n", to_string(warning));
  for (const auto& note : checker.notes()) fmt::print("note {}\n", to_string(note));
  fmt::print("{} checked, no problem\n", counted(options.files.size(), "file"));
  const bool told = !checker.warnings().empty() || !checker.notes().empty();
  return options.strict && told ? check_failed : all_passed;
}

namespace {

void check_options(CLI::App& check, int& status) {
  const auto chosen = std::make_shared<CheckOptions>();
  auto& options = *chosen;
  auto* files = check.add_option(
      "files", options.files,
      "Scenarios and recordings (.yaml), configurations (.cnf), QCL modules (.mod) after "
      "their .cnf, instruction "
      "lists (.il), Structured Text (.st, or a folder of it), cam tables (.csv, .tab) and registers "
      "(.csv)");
  check.add_flag("--expand", options.expand, "Print scenarios with every default in force");
  add_set(check, options.set, "scenarios");
  add_annotate(check, options.annotate);
  check.add_flag("--strict", options.strict, "Warnings and notes fail it, too: exit status 1");
  check.add_flag("--schema", options.schema, "Print the JSON Schema of scenarios, for editors")
      ->excludes(files);
  check.callback([chosen, files, &status] {
    if (chosen->schema) return fmt::print("{}\n", studies::json_schema());
    if (chosen->files.empty()) throw CLI::RequiredError(files->get_name());
    status = check_files(*chosen);
  });
}

}  // namespace

Verb check_verb() {
  return {"check",
          "Parse and type-check files without running anything",
          {"drycut check my_line.yaml"},
          {"files",
           {FileKind::scenario, FileKind::comparison, FileKind::recording, FileKind::configuration,
            FileKind::module, FileKind::instruction_list, FileKind::structured_text, FileKind::registers,
            FileKind::program_table, FileKind::cam_table}},
          check_options};
}

}  // namespace drycut::sim::cli
