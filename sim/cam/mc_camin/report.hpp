#pragma once
#include <string>

#include "renders/plots.hpp"
#include "sim/cam/mc_camin/run.hpp"
#include "sim/cam/study.hpp"

namespace drycut::sim {

/// The pieces of the cam, its knots and its totals, in words.
CamText cam_in_text(const CamInRun& run);

/// Position, velocity, acceleration and jerk against the master, in deg or mm; against time too if the
/// master's speed is known.
CamDrawing cam_in_plot(const CamInRun& run, const CamDuty& duty, const std::string& name);

/// What the segments of one turn do; of many, equal neighbours are one stretch.
std::vector<CamZone> zones_of(const CamInRun& run);

}  // namespace drycut::sim
