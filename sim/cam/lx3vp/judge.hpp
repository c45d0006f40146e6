#pragma once
#include <vector>

#include "sim/cam/findings.hpp"
#include "sim/cam/lx3vp/table.hpp"

namespace drycut::sim {

/// Everything wrong or noteworthy, each once, in the order of the rows; what is of the whole cam comes last.
std::vector<CamFinding> judge_ecam(const EcamTable& table, const CamDuty& duty, const CamCourse& run);

}  // namespace drycut::sim
