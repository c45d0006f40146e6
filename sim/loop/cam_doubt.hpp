#pragma once
#include <functional>
#include <vector>

#include "base/problem.hpp"

namespace drycut::sim::loop {

struct PlayedCam;

/// What speaks against a cam that a run played.
struct CamDoubt {
  Finding what;          ///< "cam of AxisX, sector 4: ..."
  bool is_slip = false;  ///< the device stops or passes a limit, however slow the master is
};

/// A cycle of a cam that a run played.
struct CamCycle {
  std::string axis;
  double length = 0;  ///< of its master, in `unit`
  std::string unit;   ///< "mm", "pulses"
};

struct CamJudgement {
  std::vector<CamDoubt> doubts;
  std::vector<CamCycle> cycles;  ///< of cams whose law goes on for ever as it is
};

/// Who judges cams: the rooms above the loop do.
using CamJudge = std::function<CamJudgement(const std::vector<PlayedCam>& played)>;

}  // namespace drycut::sim::loop
