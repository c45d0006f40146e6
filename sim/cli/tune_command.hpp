#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "sim/cli/arguments.hpp"
#include "sim/cli/commands.hpp"
#include "sim/studies/tune/plan.hpp"

namespace drycut::sim::cli {

struct TuneOptions : studies::TuneRequest {
  std::vector<std::string> set;  ///< "plants.web.speed=80 m/min", before everything else
  std::filesystem::path out = "out/tune";
  ClusterOptions cluster;
};
/// drycut tune: 0 the tuned values keep all limits, 1 no values were found that do, 2 bad input, 3 nothing
/// could be simulated or written
int tune_scenarios(const TuneOptions& options);

}  // namespace drycut::sim::cli
