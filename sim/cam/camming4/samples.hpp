#pragma once
#include <vector>

#include "sim/cam/camming4/run.hpp"
#include "sim/cam/points.hpp"

namespace drycut::sim {

/// 1000 points a pass, evenly spaced, and every boundary of sectors and of the phases inside them; where the
/// velocity steps, before and after. With `both_sides`, for drawing, before and after at every boundary and
/// at least 64 points a sector.
std::vector<CamPoint> sample_cam(const CamRun& run, bool both_sides = false);

/// At the given positions, each 0 .. run.master_total, in the order of running; a boundary belongs to the
/// sector that it begins.
std::vector<CamPoint> sample_cam_at(const CamRun& run, std::vector<double> masters);

}  // namespace drycut::sim
