#pragma once
#include <string>

#include "renders/plots.hpp"
#include "sim/cam/camming4/samples.hpp"

namespace drycut::sim {

/// Position, velocity, acceleration and jerk against the master, the sectors marked, limits drawn where they
/// are given; in time units if the master's speed is.
renders::Plot cam_plot(const CamTable& table, const CamDuty& duty, const CamRun& run,
                       const std::string& name);

}  // namespace drycut::sim
