#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "devices/plcopen/tab_file.hpp"
#include "sim/cam/duty.hpp"
#include "sim/cam/mc_camin/polynomial.hpp"
#include "sim/cam/points.hpp"

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
struct CamInRun {
  devices::plcopen::CamFile cam;
  std::vector<devices::plcopen::CamRefusal> refused;  ///< what MC_CamIn would refuse
  devices::plcopen::CamCurve curve;                   ///< no segments if it refuses something
  std::vector<CamKnot> knots;                         ///< in the order of the table's rows
  int loops = 1;
  std::optional<double> master_speed;  ///< [increments/s]

  [[nodiscard]] bool runs() const { return !curve.segments.empty(); }
  [[nodiscard]] double master_total() const { return loops * curve.modulo; }
  /// The way that the slave comes on in one turn of the master.
  [[nodiscard]] double advance() const { return static_cast<double>(curve.turns) * curve.slave_modulo; }
  /// Row of the table, from 1, that begins a segment.
  [[nodiscard]] int row_of(std::size_t segment) const;
  /// Where a segment begins and ends in the master's turn: the piece before the first point is the end of the
  /// last one, which begins before 0.
  [[nodiscard]] double begin_of(std::size_t segment) const;
  [[nodiscard]] double end_of(std::size_t segment) const;
  /// Largest absolute value of a derivative, over the whole turn.
  [[nodiscard]] double peak(CamOrder order) const;
};

CamInRun run_cam_in(const devices::plcopen::CamFile& cam, const CamDuty& duty, int loops);

/// 1000 points a turn, evenly spaced, and every boundary; where something jumps, before and after. With
/// `both_sides`, for drawing, before and after at every boundary.
std::vector<CamPoint> sample_cam_in(const CamInRun& run, bool both_sides = false);
/// At the given positions of the master, each within the run, in the order of running.
std::vector<CamPoint> sample_cam_in_at(const CamInRun& run, std::vector<double> masters);

}  // namespace drycut::sim
