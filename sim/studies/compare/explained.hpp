#pragma once
#include <string>
#include <vector>

#include "base/table.hpp"
#include "sim/studies/compare/measured.hpp"

namespace drycut::sim::studies {

// Which single value would explain most of what a run leaves of a channel: the residual beside what that
// value would change, by least squares, both through one zero-phase filter. Of the motor's torque these are
// the terms of the inverse dynamics; of every other channel its clock, its scale and its zero. It is a hint
// where to look, of a motion that is nearly the recorded one; values with limits are those of drycut fit.

struct Explanation {
  std::string channel;
  std::string value;   ///< "inertia or mass"
  std::string rows{};  ///< of a plant that it may be, for --vary; "" where it is in the recording
  double amount = 0;   ///< by which the simulated has too much of it
  std::string unit;
  double share = 0;  ///< of the residual's rms that is gone without it, 0..1
};

/// Those of a channel that explain something, the one that explains most first.
std::vector<Explanation> explain(const MeasuredChannel& channel);

/// The best of each channel, of those that explain at least a tenth of it.
Table explained_table(const MeasuredRun& measured);

}  // namespace drycut::sim::studies
