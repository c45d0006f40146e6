#pragma once
#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "base/problem.hpp"
#include "sim/loop/names.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/time.hpp"

namespace drycut::sim::loop {

/// Recorded channels that drive a line: settings, live parameters, switches, values of the controller, plugs
/// without a wire. The recording's first sample, of whatever channel, is at time zero. Before its own first
/// one a channel has that one's value.
class Inputs {
 public:
  /// Reads the recordings and binds names; what does not fit is reported with its place in the scenario, the
  /// recording or the export, what is doubtful goes to `notes`. From now on `names` knows what is driven.
  Inputs(const scenario::Scenario& scenario, const std::vector<NamedPlant>& plants, Names& names,
         Problems& problems, std::vector<Finding>& notes);

  /// Gives what was recorded for `now`, once a step.
  void run(Time now) {
    if (now >= next_) work(now);
  }
  /// Where the first recording is over that ends the run with it, and what it drives.
  struct End {
    Time at = never;
    std::string of;
  };
  [[nodiscard]] const End& end() const { return end_; }
  void visit(StateArchive& archive);

 private:
  struct Source {
    std::function<void(double)> write;
    std::vector<Time> times;
    std::vector<double> values;  ///< in what `write` takes
    bool holds = false;
    std::size_t last = 0;  ///< the sample that was looked at last
    double written = std::numeric_limits<double>::quiet_NaN();

    double at(Time now);
    /// When its value may be another one, behind `now`.
    [[nodiscard]] Time next(Time now) const;
  };
  friend class InputBinder;
  void work(Time now);

  std::vector<Source> sources_;
  Time next_ = 0;
  End end_;
};

}  // namespace drycut::sim::loop
