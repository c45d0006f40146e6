#include "sim/cli/file_kinds.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "base/problem.hpp"
#include "base/text.hpp"
#include "devices/lx3vp/il_lines.hpp"
#include "devices/lx3vp/register_file.hpp"
#include "sim/cli/commands.hpp"
#include "sim/file.hpp"
#include "sim/live/session.hpp"
#include "sim/recordings/recording_file.hpp"
#include "sim/report/results.hpp"

namespace drycut::sim::cli {

namespace fs = std::filesystem;

namespace {

struct KindRow {
  FileKind kind;
  std::string_view what;
  std::string_view use;      ///< who takes it
  std::string_view endings;  ///< that files of this kind have, of several kinds the first is meant
};

constexpr std::array file_kinds = {
    KindRow{FileKind::scenario, "a scenario", "drycut run takes it", ".yaml .yml"},
    KindRow{FileKind::comparison, "a scene that compares runs", "drycut run takes it", ""},
    KindRow{FileKind::recording, "a recording of a machine", "drycut check takes it", ""},
    KindRow{FileKind::session, "a recorded session",
            "drycut replay runs it again, drycut live --from goes on from it", ""},
    KindRow{FileKind::configuration, "a QMOVE configuration",
            "drycut check takes it; a scenario names it as controller.qmove.configuration", ".cnf"},
    KindRow{FileKind::module, "a QCL module",
            "drycut check takes it behind its .cnf; a scenario names it in controller.qmove.tasks",
            ".mod .qcl"},
    KindRow{FileKind::instruction_list, "an instruction list",
            "drycut check takes it; a scenario names it as controller.lx3vp.program", ".il"},
    KindRow{FileKind::structured_text, "Structured Text",
            "drycut check takes it; a scenario names it as controller.plcopen.program", ".st"},
    KindRow{FileKind::cam_table, "a cam table",
            "drycut cam takes it; a scenario names it where its controller is set up", ".csv .tab"},
    KindRow{FileKind::registers, "a file of registers",
            "drycut check takes it; a scenario names it as controller.lx3vp.registers", ""},
    KindRow{FileKind::program_table, "an instruction list as a table",
            "drycut check takes it; a scenario names it as controller.lx3vp.program", ""},
    KindRow{FileKind::trace, "the trace of a run", "drycut convert takes it, drycut compare its folder", ""},
    KindRow{FileKind::events, "the events of a run", "drycut convert and drycut compare take its folder", ""},
    KindRow{FileKind::checks, "a file of JSON", "if a run wrote it, drycut compare takes its folder",
            ".json"},
    KindRow{FileKind::hdf5, "a record in HDF5", "drycut convert takes it", ".h5 .hdf5"},
    KindRow{FileKind::mcap, "a record in MCAP", "Foxglove and PlotJuggler show it", ".mcap"},
    KindRow{FileKind::fmu, "an FMU",
            "drycut plants lists its variables; a scenario has it as a plant, {type: fmu, file: ...}",
            ".fmu"},
    KindRow{FileKind::report, "a report", "a browser shows it", ".html .htm"},
    KindRow{FileKind::junit, "a file of XML", "if a run wrote it, it is for CI", ".xml"},
    KindRow{FileKind::model, "a model in 3-D", "a scenario names it in pictures.meshes; viewers show it",
            ".stl .obj .ply .off .dae .gltf .glb"},
    KindRow{FileKind::picture, "a picture", "any viewer shows it", ".png .jpg .jpeg .svg"},
    KindRow{FileKind::film, "a film", "a browser plays it", ".mp4 .webm"},
    KindRow{FileKind::run_folder, "the folder of a run", "drycut compare and drycut convert take it", ""},
    KindRow{FileKind::session_folder, "the folder of a recorded session",
            "drycut replay runs it again, drycut live --from goes on from it", ""},
    KindRow{FileKind::folder, "a folder", "name a file", ""},
};

const KindRow* row_of(FileKind kind) {
  const auto* const found =
      std::ranges::find_if(file_kinds, [&](const auto& row) { return row.kind == kind; });
  return found == file_kinds.end() ? nullptr : found;
}

FileKind kind_of_folder(const fs::path& folder) {
  std::error_code ignored;
  if (fs::exists(folder / live::session_file, ignored)) return FileKind::session_folder;
  if (fs::exists(folder / report::checks_file, ignored)) return FileKind::run_folder;
  return files_in(folder, ".st").empty() ? FileKind::folder : FileKind::structured_text;
}

FileKind kind_of_yaml(const fs::path& file, std::string_view text) {
  if (live::is_session(file)) return FileKind::session;
  if (recordings::is_recording(text)) return FileKind::recording;
  const bool compares = text.starts_with("compare:") || text.find("\ncompare:") != std::string_view::npos;
  return compares ? FileKind::comparison : FileKind::scenario;
}

FileKind kind_of_csv(const std::string& text) {
  if (text.starts_with("time [s],source,event")) return FileKind::events;
  if (text.starts_with("time [s],")) return FileKind::trace;
  if (devices::lx3vp::il::is_table(text)) return FileKind::program_table;
  return devices::lx3vp::is_register_file(text, ',') ? FileKind::registers : FileKind::cam_table;
}

/// "name a file in it: a.yaml, b.yaml"
std::string remedy_for(const KindRow& found, const fs::path& file) {
  std::string names;
  if (found.kind == FileKind::folder)
    for (const auto& one : files_in(file, ".yaml")) names += (names.empty() ? "" : ", ") + one.string();
  return names.empty() ? std::string(found.use) : "name a file in it: " + names;
}

}  // namespace

FileKind kind_of(const fs::path& file) {
  std::error_code ignored;
  if (fs::is_directory(file, ignored)) return kind_of_folder(file);
  const auto ending = lower(file.extension().string());
  const auto* const row = std::ranges::find_if(file_kinds, [&](const KindRow& kind) {
    const auto endings = split_words(kind.endings, {}, " ");
    return std::ranges::any_of(endings, [&](const auto& one) { return one.text == ending; });
  });
  if (ending.empty() || row == file_kinds.end()) return FileKind::unknown;
  const bool is_yaml = row->kind == FileKind::scenario;
  if (!is_yaml && ending != ".csv") return row->kind;
  Problems told_by_the_reader;
  const auto text = read_file(file, told_by_the_reader);
  // A trace may be longer than what is read.
  if (!text && !is_yaml && fs::is_regular_file(file, ignored) && fs::file_size(file, ignored) > largest_input)
    return FileKind::trace;
  if (!text) return row->kind;
  return is_yaml ? kind_of_yaml(file, *text) : kind_of_csv(*text);
}

std::string_view name_of(FileKind kind) {
  const auto* row = row_of(kind);
  return row == nullptr ? "" : row->what;
}

void refuse_wrong_kinds(const Takes& takes, const std::vector<std::string>& files) {
  Problems problems;
  for (const auto& file : files) {
    const auto* found = row_of(kind_of(file));
    if (found == nullptr || std::ranges::find(takes.kinds, found->kind) != takes.kinds.end()) continue;
    // Where Structured Text is taken a folder of it is, too.
    const bool lacks_texts = found->kind == FileKind::folder &&
                             std::ranges::find(takes.kinds, FileKind::structured_text) != takes.kinds.end();
    problems.push_back({"file.other-kind"_code, file, 1, 1,
                        fmt::format("this is {}{}, not {}", found->what,
                                    lacks_texts ? " without .st files" : "", name_of(takes.kinds.front())),
                        remedy_for(*found, file)});
  }
  if (problems.empty()) return;
  print_problems(problems);
  throw CLI::RuntimeError(bad_input);
}

}  // namespace drycut::sim::cli
