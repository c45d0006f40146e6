#pragma once
#include <string>
#include <vector>

#include "sim/cams/camming4/run.hpp"
#include "sim/cams/findings.hpp"

namespace drycut::sim::cams {

/// Everything wrong or noteworthy, each once, in the order of running; remarks come last.
std::vector<CamFinding> judge(const CammingTable& table, const CamDuty& duty, const CamRun& run);

/// "132 AZM"; "999" for a code that does not exist.
std::string code_text(int code);

}  // namespace drycut::sim::cams
