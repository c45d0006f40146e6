#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "devices/cam/law.hpp"
#include "devices/plcopen/cam_table.hpp"

namespace drycut::devices::plcopen {

// The cam as a function of the master (004 "table_fkt_type"): segments of polynomials of the fifth degree at
// most, one after the other round the master's turn, exact at the points of the table. Master and slave in
// 0.1 um or 0.0001 deg; velocity, acceleration and jerk are derivatives with respect to the master.

/// Direction in which a cam of an endlessly turning slave passes its turn (StartMode).
enum class Endless : std::int8_t { negative = -1, no = 0, positive = 1 };

/// The whole cam, of polynomials; its pieces' rows are those of the table. The slave's positions are
/// unwrapped: a cam that turns the slave on ends `turns` of its turns from where it began. Where the first
/// point comes after master 0, the end of the last row's piece is the first one, which begins below 0.
struct CamCurve : CamLaw {
  std::int64_t turns = 0;  ///< of the slave in one turn of the master
};

/// The curve of a table that `check` finds sound. `slave_modulo`: 0 for a linear slave, whose cam cannot
/// be endless.
CamCurve curve_of(const CamTable& table, Interpolation interpolation, double modulo, double slave_modulo,
                  Endless endless);

/// Slave positions of consecutive points, unwrapped: an inner step between two positions inside the turn that
/// goes against the endless direction by more than half a turn is one over the turn's end. The last value
/// is where the cam closes: at the first, or `turns` turns from it in the endless direction.
std::vector<double> unwrapped(const std::vector<double>& positions, double slave_modulo, Endless endless,
                              std::int64_t& turns);

}  // namespace drycut::devices::plcopen
