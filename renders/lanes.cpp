#include "renders/lanes.hpp"

#include <algorithm>
#include <cmath>

namespace drycut::renders {

std::vector<LaneState> lane_states(const Lane& lane) {
  std::vector<LaneState> states;
  bool open = false;
  for (std::size_t i = 0; i < lane.x.size(); ++i) {
    if (open) states.back().until = lane.x[i];
    if (!std::isfinite(lane.y[i])) {
      open = false;
      continue;
    }
    if (open && states.back().value == lane.y[i]) continue;
    states.push_back({lane.x[i], lane.x[i], lane.y[i]});
    open = true;
  }
  return states;
}

bool is_digital(const Lane& lane) {
  return std::all_of(lane.y.begin(), lane.y.end(),
                     [](double y) { return !std::isfinite(y) || y == 0 || y == 1; });
}

std::vector<LaneState> high_states(const std::vector<LaneState>& states, double pixel) {
  std::vector<LaneState> high;
  for (const LaneState& state : states) {
    if (state.value == 0) continue;
    const double until = std::max(state.until, state.from + pixel);
    if (!high.empty() && state.from - high.back().until < pixel) {
      high.back().until = until;
    } else {
      high.push_back({state.from, until, state.value});
    }
  }
  return high;
}

std::vector<LaneState> told_apart(const std::vector<LaneState>& states, double pixel) {
  std::vector<LaneState> apart;
  for (const LaneState& state : states) {
    const bool narrow = state.until - state.from < pixel;
    const bool beside = !apart.empty() && apart.back().until == state.from;
    if (narrow && beside && apart.back().mixed) {
      apart.back().until = state.until;
    } else {
      apart.push_back({state.from, state.until, state.value, narrow});
    }
  }
  return apart;
}

}  // namespace drycut::renders
