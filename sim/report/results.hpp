#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/json.hpp"
#include "sim/loop/simulation.hpp"
#include "sim/record/json.hpp"
#include "sim/record/verdict.hpp"

namespace drycut::sim::report {

/// How services of repositories name a file: from the current folder on where it is in there, without "..".
std::string path_from_here(const std::filesystem::path& file);

/// Where a check stands.
struct FilePlace {
  std::string file;
  int line = 1;
  int column = 1;
};

/// One scenario's outcome among others, for junit.xml and the closing lines.
struct RunResult {
  std::string name;  ///< the scenario's file name without extension
  std::filesystem::path scenario;
  std::filesystem::path directory;  ///< where its files are
  record::Outcome outcome;
  bool has_report = false;
  bool ran = true;                         ///< false: it was refused, or interrupted before
  std::string title = {};                  ///< of the scene
  std::optional<std::uint64_t> seed = {};  ///< absent: it compares runs
  /// Of the checks, in their order; a check of the program's own has none.
  std::vector<FilePlace> places = {};
  /// Of checks that ran one after the other, as tests do, what each took; empty: they share one run.
  std::vector<Time> took = {};

  /// Of a check, else the beginning of the scenario.
  [[nodiscard]] FilePlace place_of(std::size_t check) const;
};
/// The places of a scenario's checks, or of a comparing scene's, by its sources; what an override states has
/// the scenario's beginning.
template <typename Scene>
std::vector<FilePlace> places_of_checks(const Scene& scene) {
  std::vector<FilePlace> places;
  for (const auto& check : scene.checks) {
    const auto& [line, column, source] = check.name.place;
    const auto& file = scene.sources.at(static_cast<std::size_t>(source));
    places.push_back(file.starts_with("--set") ? FilePlace{scene.file.string()}
                                               : FilePlace{file, line, column});
  }
  return places;
}

/// checks.json: the version and the outcome as it is visited; with --verify-step also, beside each check,
/// what it came to at half the step.
void write_checks(const record::Outcome& outcome, const std::filesystem::path& file);

/// The files of a run that a comparison reads.
inline constexpr auto* trace_file = "trace.csv";
inline constexpr auto* events_file = "events.csv";
inline constexpr auto* hdf5_file = "trace.h5";  ///< in place of both with record.format: hdf5
using record::checks_file;
inline constexpr auto* scenario_file = "scenario.yaml";

/// What an outcome says as long as its run has not come to its end.
record::Outcome outcome_to_come();

/// scenario.yaml: the scenario as it ran, with every default and override in force, to be compared with other
/// runs' and kept. Paths in it are relative to the scenario's own file.
std::string scenario_text(const scenario::Scenario& scenario);
void write_scenario(const scenario::Scenario& scenario, const std::filesystem::path& file);

/// junit.xml over all scenarios: a suite a scenario, a case a check with its place; a run that stopped is an
/// error, a check that judged nothing is skipped. Times are the machine's: the same run has the same bytes.
/// Where all checks are judged in one run its time is shared out among them, so that sums are right. A report
/// is attached to its suite and to what failed.
void write_junit(const std::vector<RunResult>& results, const std::filesystem::path& file);

/// "0.0530 mm left, at 7.2040 s"; "" where there is no margin to tell. Then what else
/// people are told of a check (Check::told): terminal, junit.xml, annotations, summary, pages have it from
/// here.
std::string margin_text(const record::CheckResult& check);
/// Members of a visited value (record::json_of) as they stand: "cuts 15; late by 0.25"; what is none is left
/// out.
std::string told_of(const Json& visited, const std::vector<std::string_view>& keys);

/// The check of a run with --strict that has warnings: it fails.
record::CheckResult no_warnings(const record::Outcome& outcome);

/// "all 5 checks passed", "2 of 5 checks failed, 1 warning", "the simulation stopped: ...".
std::string verdict_text(const record::Outcome& outcome);

}  // namespace drycut::sim::report
