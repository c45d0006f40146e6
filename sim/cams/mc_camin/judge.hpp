#pragma once
#include <array>
#include <string>
#include <vector>

#include "devices/plcopen/tab_file.hpp"
#include "sim/cams/kinds.hpp"

namespace drycut::sim::cams {

/// Increments in a deg (0.0001 deg) or in a mm (0.1 um).
inline constexpr double increments_per_unit = 10'000;
/// "0.0001 deg" of "deg", "0.1 um" of "mm".
std::string increments_of(const std::string& unit);

/// Where one segment gives over to the next, the last one to the first of the next turn.
struct CamKnot {
  int row = 0;                    ///< of the table
  double master = 0;              ///< 0..modulo
  bool closes = false;            ///< the table begins again here
  std::array<double, 4> jumps{};  ///< of position, velocity, acceleration, jerk with respect to the master
  int smooth = -1;                ///< up to which derivative nothing jumps, 3 at most; -1: the position does
};
/// A cam of MC_CamIn behind a master that runs evenly through its turns from 0, the scalings 1 and the
/// offsets 0. Lengths in increments.
struct CamInRun : CamCourse {
  CamFile cam;
  std::vector<devices::plcopen::CamRefusal> refused;  ///< what MC_CamIn would refuse; nothing runs then
  std::int64_t turns = 0;                             ///< of the slave in one of the master
  std::vector<CamKnot> knots;                         ///< in the order of the table's rows
};

CamInRun run_cam_in(const CamFile& cam, const CamDuty& duty, int loops);

/// Everything wrong or noteworthy, each once: what MC_CamIn would refuse with its error id; else limits,
/// jumps, what the slave does beyond its rows, remarks.
std::vector<CamFinding> judge_cam_in(const CamInRun& run, const CamDuty& duty);

/// The motion in the kernel's words.
CamMotionWords motion_of(const CamInRun& run, const CamDuty& duty);

/// The slave's limits in force: those of the options before those of the file [deg or mm, s].
devices::plcopen::CamFileLimits limits_of(const CamInRun& run, const CamDuty& duty);

}  // namespace drycut::sim::cams
