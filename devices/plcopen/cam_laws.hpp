#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "devices/plcopen/cam_table.hpp"

namespace drycut::devices::plcopen {

// The cam as a function of the master (004 "table_fkt_type"): segments of polynomials of the fifth degree at
// most, one after the other round the master's turn, exact at the points of the table. Master and slave in
// 0.1 um or 0.0001 deg; velocity, acceleration and jerk are derivatives with respect to the master.

/// Direction in which a cam of an endlessly turning slave passes its turn (StartMode).
enum class Endless : std::int8_t { negative = -1, no = 0, positive = 1 };

/// Slave motion at one master position.
struct CamMotion {
  double position = 0;
  double velocity = 0;
  double acceleration = 0;
  double jerk = 0;
};

/// One interval: y = sum c[k] u^k, u = 0..1 over `length` of the master.
struct CamSegment {
  double start = 0;
  double length = 0;
  std::array<double, 6> c{};
  bool step = false;  ///< STEP_DIRECT: holds its value
};

/// The whole cam. The slave's positions are unwrapped: a cam that turns the slave on ends `turns` of its
/// turns from where it began.
struct CamCurve {
  double modulo = 0;       ///< of the master
  double first = 0;        ///< master of the first segment's start, in 0..modulo
  bool even = true;        ///< intervals of one length, from master 0
  std::int64_t turns = 0;  ///< of the slave in one turn of the master
  double slave_modulo = 0;
  std::vector<CamSegment> segments;
};

/// The curve of a table that `check` finds sound. `slave_modulo`: 0 for a linear slave, whose cam cannot
/// be endless.
CamCurve curve_of(const CamTable& table, Interpolation interpolation, double modulo, double slave_modulo,
                  Endless endless);

/// Number of the segment in force at master `x`, 0 <= x < modulo.
std::size_t segment_at(const CamCurve& curve, double x);
/// The slave at master `x`, 0 <= x < modulo, unwrapped from the position at master 0 onwards.
CamMotion at(const CamCurve& curve, double x);
/// One segment at u = 0..1.
CamMotion at(const CamSegment& segment, double u);

/// Slave positions of consecutive points, unwrapped: an inner step between two positions inside the turn that
/// goes against the endless direction by more than half a turn is one over the turn's end. The last value
/// is where the cam closes: at the first, or `turns` turns from it in the endless direction.
std::vector<double> unwrapped(const std::vector<double>& positions, double slave_modulo, Endless endless,
                              std::int64_t& turns);

}  // namespace drycut::devices::plcopen
