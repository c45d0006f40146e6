#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "sim/cli/arguments.hpp"
#include "sim/cli/commands.hpp"

namespace drycut::sim::cli {

/// What drycut sweep and drycut envelope have in common.
struct StudyOptions {
  std::vector<std::string> over;     ///< "variables.length=500..3000 mm:26"
  std::vector<std::string> figures;  ///< "peak=max(abs(knife.motor.torque))"
  std::vector<std::string> set;      ///< "plants.web.speed=80 m/min", before everything else
  int jobs = 1;                      ///< runs at the same time; the result is the same
  std::filesystem::path out;
  ClusterOptions cluster;
};
struct SweepOptions : StudyOptions {
  std::filesystem::path scenario;
  std::string sample;  ///< "sobol:1000" in place of the grid
};
/// An --over, --find-max or --find-min that begins with NAME: is for the scenarios whose files' names begin
/// so, in place of those without: "flying_saw:variables.length=1..6 m:11".
struct EnvelopeOptions : StudyOptions {
  std::vector<std::filesystem::path> scenarios;
  std::vector<std::string> find_max = {};  ///< "plants.web.speed=20..300 m/min:1", one of both a scenario
  std::vector<std::string> find_min = {};  ///< "variables.length=400..2000 mm:5"
};

/// drycut sweep, drycut envelope: 0 all points have been looked at, whatever came of them, 2 bad input, 3
/// nothing could be simulated or written
int sweep_scenario(const SweepOptions& options);
int envelope_scenario(const EnvelopeOptions& options);

}  // namespace drycut::sim::cli
