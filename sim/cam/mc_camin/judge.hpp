#pragma once
#include <vector>

#include "sim/cam/findings.hpp"
#include "sim/cam/mc_camin/run.hpp"

namespace drycut::sim {

/// Everything wrong or noteworthy, each once: what MC_CamIn would refuse with its error id; else limits,
/// jumps, what the slave does beyond its rows, remarks.
std::vector<CamFinding> judge_cam_in(const CamInRun& run, const CamDuty& duty);

/// The slave's limits in force: those of the options before those of the file [deg or mm, s].
devices::plcopen::CamLimits limits_of(const CamInRun& run, const CamDuty& duty);

}  // namespace drycut::sim
