#pragma once
#include <string>
#include <vector>

#include "devices/lx3vp/ecam_table.hpp"
#include "devices/lx3vp/ecamtbx.hpp"
#include "sim/cams/kinds.hpp"

namespace drycut::sim::cams {

/// The laws that ECAMTBX rounded to its rows, or the straight pieces between rows that were given. Nothing
/// runs if the table has no two rows in ascending order or ECAMTBX refused it. Of a time axis the master's
/// speed is always known [pulses/s].
CamCourse run_ecam(const EcamTable& table, const CamDuty& duty, int loops);

/// Everything wrong or noteworthy, each once.
std::vector<CamFinding> judge_ecam(const EcamTable& table, const CamDuty& duty, const CamCourse& run);

/// The motion in the device's words; `run` runs.
CamMotionWords motion_of(const EcamTable& table, const CamDuty& duty, const CamCourse& run);

/// The rows as a table that reads back, with the settings of `table`.
std::string ecam_rows_csv(const EcamTable& table);

/// What no type of table has: "P6L 7", "P6H 4" or both; "" if both are known.
std::string wrong_words(const EcamTable& table);
/// What a fault of ECAMTBX asks to be changed, with the list's own numbers.
CamRemedy remedy_of(devices::lx3vp::EcamError error, const EcamTable& table);
/// The largest P2 whose law and rows both keep to a speed [Hz], behind a master of `master_speed` [pulses/s].
CamRemedy top_speed_remedy(const EcamTable& table, double master_speed, double limit);

/// The P5 of a saw that keeps its law to a ratio, if there is one.
CamRemedy ratio_limit_remedy(const EcamTable& table, double limit);

}  // namespace drycut::sim::cams
