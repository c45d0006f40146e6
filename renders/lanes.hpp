#pragma once
#include <vector>

#include "renders/plots.hpp"

namespace drycut::renders {

/// A lane's state from `from` to `until`.
struct LaneState {
  double from = 0;
  double until = 0;
  double value = 0;
  bool mixed = false;  ///< several states, each too short to be told from the next
};

/// The states of a lane, one after the other, from its first sample to its last. Samples that are not finite
/// are a gap.
std::vector<LaneState> lane_states(const Lane& lane);

/// True if no sample is anything but 0 or 1.
bool is_digital(const Lane& lane);

/// Where a digital lane is high, no narrower than `pixel` [units of x]: a short pulse is not lost, and pulses
/// that are closer than that join.
std::vector<LaneState> high_states(const std::vector<LaneState>& states, double pixel);

/// The states with those shorter than `pixel` [units of x] joined into mixed ones.
std::vector<LaneState> told_apart(const std::vector<LaneState>& states, double pixel);

}  // namespace drycut::renders
