#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "sim/cli/commands.hpp"

namespace drycut::sim::cli {

struct CompareOptions {
  std::vector<std::filesystem::path> runs;  ///< folders that drycut run made of scenarios, two or more
  std::filesystem::path out = "out/compare";
  std::string from = {};            ///< "4 s": figures look from here on; "" = as the runs' plots say
  bool fail_on_difference = false;  ///< exit status 1 where the runs differ
  /// "length=0.01mm", "1e-6": exit status 1 where the runs differ by more, parameters aside
  std::vector<std::string> tolerances = {};
  std::vector<std::string> without = {};  ///< channels that are left out, "Axis.*" for all that begin so
  std::string align = {};  ///< event or channel whose happenings lay the runs over each other, "" = the clock
  bool pictures = true;
};
/// drycut compare: 0 compared, 1 different and --fail-on-difference or --tolerance, 2 bad input, 3 cannot be
/// written
int compare_runs(const CompareOptions& options);

}  // namespace drycut::sim::cli
