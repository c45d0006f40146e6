#pragma once
#include <filesystem>
#include <list>
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
#include "sim/report/run_folder.hpp"
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
  std::optional<report::RunFolder> folder;
  report::RunLeft left;
  std::optional<loop::KeptMoment> from;            ///< it goes on from there
  bool branches = false;                           ///< with other values
  std::vector<scenario::Stimulus> then;            ///< which are set there
  std::vector<Finding> notes;                      ///< of what was read
  std::string inputs;                              ///< all that determines its results, with --cache
  std::optional<std::vector<Finding>> kept_notes;  ///< it was not run: its results are those of a cache
  std::string trouble;                             ///< a result could not be written
  double took = 0;                                 ///< [s] of the clock, to the last picture
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

/// A scenario that is not run: its input is wrong.
struct Refused {
  report::RunResult result;
  Problems problems;
};

/// What is to be run: scenarios, and those of scenes that compare.
struct Work {
  std::optional<OutputFolder> folder;
  std::list<OutputFolder> between;  ///< between that and those of scenarios whose files have one name
  std::vector<std::unique_ptr<Job>> jobs;
  std::vector<Group> groups;
  std::vector<Refused> refused;
};

/// Reads the options of a run that goes on: those of --resume become those of the run that it was.
void read_again(RunOptions& options, Problems& problems);
/// Takes the moment that a job goes on from; a problem if it does not fit.
void go_on(Job& job, const RunOptions& options, Problems& problems);
/// Reads and puts together all scenarios. One whose input is wrong is refused, the others stand; `problems`
/// are those of the call itself.
Work prepare(const RunOptions& options, Problems& problems);
/// What the results of each scenario are called, from the folder of all results on: its file's name without
/// extension, and before it as many of its folders as tell it from others of that name.
std::vector<std::string> result_names(const std::vector<std::filesystem::path>& scenarios);

// What the terminal is told.
void print_result(const Job& job, Say say);
void print_group(const Group& group, Say say);
void print_refused(const Refused& refused);

}  // namespace drycut::sim::cli
