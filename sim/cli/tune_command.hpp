#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "sim/cli/commands.hpp"
#include "sim/studies/bode/loop.hpp"

namespace drycut::sim::cli {

struct TuneOptions {
  std::vector<std::filesystem::path> scenarios;
  std::vector<std::string> vary;         ///< "controller.qmove.set.AxisX.pgain=1..100"
  std::string minimise;                  ///< "rms(AxisX.follerr)"
  std::vector<std::string> constraints;  ///< "max(abs(knife.motor.torque)) <= 20", "phase_margin >= 45"
  studies::LoopRequest loop;             ///< how stability margins in the constraints are measured
  std::string from = "0 s";              ///< metric and constraints look from here on
  bool ignore_checks = false;            ///< failed checks of the scenarios do not count
  int budget = 100;                 ///< simulated runs of the search, those that measure margins included
  int jobs = 1;                     ///< runs at the same time; the result is the same
  std::uint64_t seed = 1;           ///< of the search and the spread
  std::vector<std::string> spread;  ///< "plants.knife.inertia=±30%"
  int spread_runs = 20;
  std::vector<std::string> set;  ///< "plants.web.speed=80 m/min", before everything else
  std::filesystem::path out = "out/tune";
  bool pictures = true;
};
/// drycut tune: 0 the tuned values keep all limits, 1 no values were found that do, 2 bad input, 3 nothing
/// could be simulated or written
int tune_scenarios(const TuneOptions& options);

}  // namespace drycut::sim::cli
