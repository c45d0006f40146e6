#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/problem.hpp"
#include "sim/recordings/recording.hpp"
#include "sim/studies/compare/allowance.hpp"
#include "sim/studies/compare/run_folder.hpp"

namespace drycut::sim::studies {

// A recording of the real machine beside a run of its model. The recording's first sample is the run's time
// zero, as it is for the inputs of scenarios.

/// A channel with times of its own.
struct TimedChannel {
  std::string name;
  std::string unit;           ///< as a run has it: "mm"
  std::vector<double> times;  ///< in the run [s]
  std::vector<double> values;
  double period = 0;  ///< it begins again after so much; 0: it does not
};

/// A channel that both have, at the instants at which it was measured.
struct MeasuredChannel {
  std::string name;
  std::string unit;
  std::vector<double> times = {};  ///< [s]
  std::vector<double> measured = {};
  std::vector<double> simulated = {};  ///< between two recorded instants straight on
  std::vector<double> residual = {};   ///< simulated less measured
  double rms = 0;                      ///< of the residual, as all that follows
  double mean = 0;
  double worst = 0;
  double worst_at = 0;  ///< [s]
  double relative = 0;  ///< rms over that of the measured; infinite where that is 0
  /// What tells how its plant moves, of the recording if that has it; at `times`.
  struct Motion {
    std::string name;
    std::string unit;
    std::vector<double> values;
  };
  std::optional<Motion> speed = {};
  std::optional<Motion> position = {};
  // While its plant moves so, faster than a fiftieth of its fastest.
  std::optional<double> mean_forwards = {};
  std::optional<double> mean_backwards = {};
  std::optional<double> allowed = {};  ///< for `worst`, where a tolerance was given
  [[nodiscard]] bool is_kept() const { return !allowed || worst <= *allowed; }
};

/// Which way a plant moves: 1, -1, or 0 where it hardly does.
std::vector<int> directions_of(const MeasuredChannel::Motion& speed);

struct MeasuredRun {
  std::filesystem::path file;  ///< the recording's YAML
  ComparedRun run;
  std::vector<MeasuredChannel> channels;
  std::vector<std::string> only_measured;  ///< channels that the run does not have
  std::vector<Finding> findings;           ///< what is doubtful in the export
};

/// Reads both and lays them over each other, from `from` [s] on. `without`: channels that are left out.
/// Tolerances judge the channels that they name; one without a name judges the others. What is wrong goes to
/// `problems`, and then the result is not to be used.
MeasuredRun measure_run(const std::filesystem::path& recording, const std::filesystem::path& run, double from,
                        const std::vector<std::string>& without, const std::vector<std::string>& tolerances,
                        Problems& problems);

}  // namespace drycut::sim::studies
