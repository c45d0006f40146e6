#pragma once
#include <string>
#include <vector>

#include "sim/cam/findings.hpp"
#include "sim/cam/samples.hpp"

namespace drycut::sim {

/// What `drycut cam` prints: the sectors in the order of running, the findings, the totals.
std::string cam_report(const CamTable& table, const CamDuty& duty, const CamRun& run,
                       const std::vector<CamFinding>& findings);

/// The samples of `--at` as a table.
std::string cam_samples_text(const std::vector<CamPoint>& points);

}  // namespace drycut::sim
