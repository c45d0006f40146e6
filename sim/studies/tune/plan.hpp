#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/problem.hpp"
#include "sim/output_folder.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/studies/bode/loop.hpp"
#include "sim/studies/cluster/workers.hpp"
#include "sim/studies/tune/present.hpp"
#include "sim/studies/tune/report.hpp"
#include "sim/studies/tune/trials.hpp"

namespace drycut::sim::studies {

/// A tuning as it is asked for.
struct TuneRequest {
  std::vector<std::filesystem::path> scenarios;
  std::vector<std::string> vary;         ///< "controller.qmove.set.AxisX.pgain=1..100"
  std::string minimise;                  ///< "rms(AxisX.follerr)"
  std::vector<std::string> constraints;  ///< "max(abs(knife.motor.torque)) <= 20", "phase_margin >= 45"
  LoopRequest loop;                      ///< how stability margins in the constraints are measured
  std::string from = "0 s";              ///< metric and constraints look from here on
  bool ignore_checks = false;            ///< failed checks of the scenarios do not count
  int budget = 200;        ///< simulated runs of all parts together, those that measure margins included
  int jobs = 1;            ///< runs at the same time; the result is the same
  std::uint64_t seed = 1;  ///< of the search and the spread
  std::vector<std::string> spread;  ///< "plants.knife.inertia=±30%", "out/fit/fit.json"
  int spread_runs = 20;             ///< fewer where the budget has not room for them
  bool pictures = true;
};

/// The request, read and found sound.
struct TunePlan {
  Study study;
  TunedParameters vary;
  TunedParameters spread;
  std::vector<PresentValue> present;  ///< of `vary`
};

/// How many simulated runs each part of a tuning may take; together no more than the budget.
struct RunSplit {
  int present = 0;  ///< of the present values
  int search = 0;
  int around = 0;  ///< of the surroundings of the optimum
  int spread = 0;
  int pictures = 0;  ///< before and after

  [[nodiscard]] int sum() const { return present + search + around + spread + pictures; }
};
/// A fifth of what is left after present values and pictures goes to the surroundings, three tenths to the
/// spread, the rest to the search. Where the sum is above the budget, that is too small.
RunSplit split_of(const TuneRequest& request, const TunePlan& plan);

/// `set` applies before what is tuned. What is wrong is told by the command line's options.
TunePlan plan_tuning(const TuneRequest& request, std::vector<scenario::Override> set, Problems& problems);

/// The files of a tuning. The first two go on where they ended.
inline constexpr auto* evaluations_file = "evaluations.csv";
inline constexpr auto* spread_file = "spread.csv";
inline constexpr auto* patch_file = "patch.txt";
inline const std::vector<std::string> tuning_files = {evaluations_file, spread_file, patch_file,
                                                      "report.html",    "plots/",    record::verdict_file};

/// A tuning carried out.
struct Tuned {
  std::unique_ptr<Trials> trials;
  std::unique_ptr<Trials> spread;  ///< none if nothing is spread
  bool has_report = false;
  Tuning found;  ///< refers to the plan and to the trials above
  int exit = 0;  ///< status, as its verdict has it
  /// Why each run that was lost was.
  [[nodiscard]] std::vector<std::string> lost() const;
};
/// Tells what is being done and which share of it is.
using TuneProgress = std::function<void(const char* doing, double share)>;
/// Searches on `workers`, tries the surroundings and the spread, writes the files into `folder`; the report
/// only where a run with the best values can be shown. Ends at the first loop of which nothing can be told.
/// Throws std::runtime_error if something cannot be written.
Tuned tune(const TunePlan& plan, const TuneRequest& request, const cluster::Workers& workers,
           OutputFolder& folder, const TuneProgress& progress);

}  // namespace drycut::sim::studies
