#pragma once
#include "sim/cam/camming4/run.hpp"
#include "sim/cam/study.hpp"

namespace drycut::sim {

/// The sectors in the order of running and the totals, in words.
CamText cam_text(const CamTable& table, const CamDuty& duty, const CamRun& run);

}  // namespace drycut::sim
