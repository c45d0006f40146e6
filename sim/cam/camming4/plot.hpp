#pragma once
#include <string>

#include "sim/cam/camming4/run.hpp"
#include "sim/cam/motion_plot.hpp"

namespace drycut::sim {

/// Position, velocity, acceleration and jerk against the master, the sectors as bands, limits drawn where
/// they are given; in time units, and against time too, if the master's speed is.
CamDrawing cam_plot(const CamTable& table, const CamDuty& duty, const CamRun& run, const std::string& name);

/// The sectors as they ran, with row, code and what they do.
std::vector<CamZone> zones_of(const CamTable& table, const CamRun& run);

}  // namespace drycut::sim
