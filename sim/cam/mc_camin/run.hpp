#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "devices/plcopen/tab_file.hpp"
#include "sim/cam/course.hpp"

namespace drycut::sim {

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
  devices::plcopen::CamFile cam;
  std::vector<devices::plcopen::CamRefusal> refused;  ///< what MC_CamIn would refuse; nothing runs then
  std::int64_t turns = 0;                             ///< of the slave in one of the master
  std::vector<CamKnot> knots;                         ///< in the order of the table's rows
};

CamInRun run_cam_in(const devices::plcopen::CamFile& cam, const CamDuty& duty, int loops);

}  // namespace drycut::sim
