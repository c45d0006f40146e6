#include "sim/cli/convert_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "base/output_file.hpp"
#include "base/plain_text.hpp"
#include "base/text.hpp"
#include "sim/cli/arguments.hpp"
#include "sim/cli/verb.hpp"
#include "sim/record/own_file.hpp"
#include "sim/record/trace_files.hpp"
#include "sim/studies/compare/run_folder.hpp"
#include "sim/studies/convert.hpp"

namespace drycut::sim::cli {

namespace {

namespace fs = std::filesystem;

const std::vector<std::string> formats = {"csv", "hdf5", "mcap"};  // as studies::RecordFormat
constexpr std::array endings = {".csv", ".h5", ".mcap"};

/// out/rotary_knife.mcap for the folder out/rotary_knife, x/trace.mcap for x/trace.csv.
fs::path file_beside(const fs::path& run, const char* ending) {
  std::error_code ignored;
  if (!fs::is_directory(run, ignored)) return fs::path(run).replace_extension(ending);
  auto folder = (run / "").lexically_normal().parent_path();
  if (folder.empty() || folder == "." || folder.filename() == "..") folder = fs::canonical(run, ignored);
  return folder.parent_path() / (folder.filename().string() + ending);
}

/// The files that are written: none is in the way, and none is what is read.
void check_files(const ConvertOptions& options, const std::vector<fs::path>& files, Problems& problems) {
  std::error_code ignored;
  // Anybody's trace may begin with its time; drycut's is the one that has its events beside it.
  const auto& events = files.back();
  const bool is_own_trace = files.size() > 1 && record::is_own_file(events, record::events_header);
  const auto header = is_own_trace ? record::trace_header : record::events_header;
  for (const auto& file : files) {
    if (options.out.empty() && fs::exists(file, ignored))
      problems.push_back({"file.not-ours"_code, file.string(), 1, 1, "there is such a file already",
                          "name the file with --out: one that drycut wrote is replaced then"});
    else
      check_output("--out", file.string(), {options.run, "record"},
                   {options.force, &file == &events ? record::events_header : header}, problems);
  }
}

}  // namespace

int convert_run(const ConvertOptions& options) {
  Problems problems;
  const auto chosen = std::find(formats.begin(), formats.end(), options.to);
  if (chosen == formats.end())
    problems.push_back({"option.unknown-choice"_code, "--to", 1, 1,
                        fmt::format("there is no format {}", in_quotes(options.to)),
                        did_you_mean(options.to, formats)});
  std::error_code ignored;
  if (!fs::exists(options.run, ignored))
    problems.push_back({"record.no-run"_code, options.run.string(), 1, 1, "there is no such run",
                        "name a folder that drycut run made of a scenario, or its trace.csv or trace.h5"});
  if (problems.empty()) {
    const auto format = static_cast<studies::RecordFormat>(chosen - formats.begin());
    const auto out = options.out.empty()
                         ? file_beside(options.run, endings.at(static_cast<std::size_t>(format)))
                         : options.out;
    std::vector<fs::path> files = {out};
    if (format == studies::RecordFormat::csv) files.push_back(record::events_beside(out));
    check_files(options, files, problems);
    auto record = problems.empty() ? studies::read_record(options.run, problems) : record::Record{};
    if (format == studies::RecordFormat::hdf5) studies::check_names(record, options.run, problems);
    if (problems.empty()) {
      try {
        studies::write_record(record, format, out);
      } catch (const std::exception& error) {
        return print_failure(drycut::words_of(error));
      }
      std::string names;
      for (const auto& file : files) names += (names.empty() ? "" : ", ") + file.string();
      if (!record.outcome.failure.empty())
        fmt::print("note: the run did not come to its end: {}\n", printable(record.outcome.failure));
      fmt::print("{} rows of {} channels, {} events: {}\n", record.recording.times().size(),
                 record.recording.columns().size(), record.recording.events().size(), names);
      return all_passed;
    }
  }
  print_problems(problems);
  return bad_input;
}

namespace {

void convert_options(CLI::App& convert, int& status) {
  const auto chosen = std::make_shared<ConvertOptions>();
  auto& options = *chosen;
  convert.add_option("run", options.run, "Folder that drycut run made, or trace.csv or trace.h5 of one")
      ->required();
  convert.add_option("--to", options.to, "csv, hdf5, mcap")->required();
  convert.add_option(
      "--out", options.out,
      "The file, which is replaced if drycut wrote it; else the run's name with .csv, .h5, .mcap");
  add_force(convert, options.force);
  convert.callback([chosen, &status] { status = convert_run(*chosen); });
}

}  // namespace

Verb convert_verb() {
  return {"convert",
          "Write what a run recorded into a file of another format: csv, two files for channels and events;\n"
          "hdf5 for Python, Octave, MATLAB; mcap for Foxglove and PlotJuggler.\n"
          "Exit status: 0 converted, 2 bad input, 3 the file could not be written",
          {"drycut convert out/rotary_knife --to hdf5"},
          {"run", {FileKind::run_folder, FileKind::trace, FileKind::hdf5, FileKind::folder}},
          convert_options};
}

}  // namespace drycut::sim::cli
