#pragma once
#include <string>
#include <vector>

#include "sim/cams/kinds.hpp"

namespace drycut::sim::cams {

/// The laws that ECAMTBX rounded to its rows, or the straight pieces between rows that were given. Nothing
/// runs if the table has no two rows in ascending order or ECAMTBX refused it. Of a time axis the master's
/// speed is always known [pulses/s].
CamCourse run_ecam(const EcamTable& table, const CamDuty& duty, int loops);

/// Everything wrong or noteworthy, each once.
std::vector<CamFinding> judge_ecam(const EcamTable& table, const CamDuty& duty, const CamCourse& run);

/// The rows as a table that reads back, with the settings of `table`.
std::string ecam_rows_csv(const EcamTable& table);

}  // namespace drycut::sim::cams
