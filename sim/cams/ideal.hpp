#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/cams/course.hpp"

namespace drycut::sim::cams {

/// Master positions that a run of a cam came over.
struct MasterRange {
  double first = 0;
  double last = 0;
};

/// A cam by the exact laws of its table in double precision: what a run is compared with. Nothing of the
/// device's own arithmetic is in it. Positions in the table's unit.
struct IdealCam {
  std::string master_unit;  ///< to be shown: "Um", "pulses", "mm"
  std::string slave_unit;
  double shown = 1;             ///< of a shown unit in one of the table's
  std::string error_unit;       ///< in which errors are told: "bits x4", "pulses", "deg"
  double error_step = 1;        ///< the least that the device can count, in that unit
  double error_scale = 1;       ///< of them in one of the table's unit of the slave
  double speed_scale = 1;       ///< CamDuty::master_speed of one of the table's master units a second
  std::vector<double> cycles;   ///< where each cycle begins and the last one ends, ascending [master]
  std::vector<double> origins;  ///< where the slave counts a cycle from, one for each of `cycles` [slave]
  std::vector<CamZone> zones;   ///< of all these cycles, in order
  std::function<double(double master)> slave;  ///< not a number where the table alone does not say it
  std::string silence;                         ///< why it does not, "" if it always does

  [[nodiscard]] bool runs() const { return cycles.size() > 1; }
};

/// Fills in the cycles of a cam that goes on for ever, over `range`, in each of them `zones`, which are those
/// of the first one. After a million cycles the rest is left out.
void repeat(IdealCam& ideal, const CamCourse& course, MasterRange range, const std::vector<CamZone>& zones);

}  // namespace drycut::sim::cams
