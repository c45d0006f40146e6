#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/cli/run_command.hpp"
#include "sim/file.hpp"
#include "sim/loop/simulation.hpp"
#include "sim/output_folder.hpp"
#include "sim/report/film.hpp"
#include "sim/report/results.hpp"
#include "sim/studies/compare/scene_run.hpp"

namespace drycut::sim::cli {

inline constexpr auto* junit_file = "junit.xml";

/// One scenario on its way from file to report.
struct Job {
  FileSet files;  ///< that it was read from
  scenario::Scenario scenario;
  std::optional<scenario::Scenario> half;  ///< the same at half its step, with --verify-step
  std::unique_ptr<loop::Simulation> simulation;
  report::PartMeshes meshes;
  report::RunResult result;
  std::optional<OutputFolder> folder;
  std::vector<std::string> notes;                      ///< of what was read
  std::string inputs;                                  ///< all that determines its results, with --cache
  std::optional<std::vector<std::string>> kept_notes;  ///< it was not run: its results are those of a cache
  std::string trouble;                                 ///< a result could not be written
  std::string left_out;         ///< because a helper program is missing, and what to install
  std::filesystem::path scene;  ///< the glTF file, "" = none
  double simulating = 0;        ///< [s] of the clock, the run alone
  double took = 0;              ///< [s] of the clock, to the last picture
};

/// A scene that compares some of the jobs.
struct Group {
  studies::ComparisonScene scene;
  std::vector<Job*> members;
  std::vector<studies::MemberNames> names;
  report::RunResult result;
  std::optional<OutputFolder> folder;
  std::string trouble;
};

/// What is to be run: scenarios, and those of scenes that compare.
struct Work {
  std::optional<OutputFolder> folder;
  std::vector<std::unique_ptr<Job>> jobs;
  std::vector<Group> groups;
};

/// Reads and puts together all scenarios; problems of all of them are told before anything runs.
Work prepare(const RunOptions& options, Problems& problems);

// What the terminal is told.
void print_result(const Job& job, Say say);
void print_group(const Group& group, Say say);

}  // namespace drycut::sim::cli
