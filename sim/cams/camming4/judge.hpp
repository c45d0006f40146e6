#pragma once
#include <string>
#include <vector>

#include "sim/cams/camming4/run.hpp"
#include "sim/cams/report.hpp"

namespace drycut::sim::cams {

/// Everything wrong or noteworthy, each once, in the order of running; remarks come last.
std::vector<CamFinding> judge(const CammingTable& table, const CamDuty& duty, const CamRun& run);

/// The motion in the device's words.
CamMotionWords motion_of(const CammingTable& table, const CamDuty& duty, const CamRun& run);

/// "132 AZM"; "999" for a code that does not exist.
std::string code_text(int code);

/// What went wrong and what would be right, with the sector's own numbers.
struct CamAdvice {
  std::string text;
  CamRemedy remedy;
};
/// Of an error or a warning of the engine (000 1.3, 1.4). `visit` is the sector it came in, nullptr if that
/// was never entered; `row_before` the row of the visit before.
CamAdvice advice_on(const CamEngineEvent& event, const CamVisit* visit, int row_before,
                    const CammingTable& table, const CamDuty& duty);

/// The column that holds a row's master space, and what of the space it does not hold; nullptr for an arc,
/// which has none.
struct MasterColumn {
  const char* name = nullptr;
  std::int32_t other = 0;  ///< [Um]
};
MasterColumn master_column(const devices::camming4::Row& row);
/// The least master space that is no error 4 [Um]: of the count, and of the sampling if the speed is given.
double least_master_space(const CammingTable& table, const CamDuty& duty, bool gearing);
/// Of a gradient of the slave that is too large by `peak` [1/Um], `most` allowed [Um/s2].
CamRemedy gradient_remedy(const CamVisit& visit, const CammingTable& table, double peak, double most);

}  // namespace drycut::sim::cams
