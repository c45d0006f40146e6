#pragma once
#include <cstdint>

#include "devices/camming4/laws.hpp"

namespace drycut::devices::camming4 {

// The trigonometric sectors 170-175 (spec qem.md 8.6; 000 1.2.4). The master runs along the arc, so that s is
// the arc's abscissa; the start of the arc is the origin.

enum class Turn : bool { clockwise, counterclockwise };
enum class ArcAxis : unsigned char { x, y, tangent };

/// A circle arc from (0, 0) to (dX, dY).
struct Arc {
  double radius = 0;    ///< > 0 [Um]
  double centre_x = 0;  ///< [Um]
  double centre_y = 0;
  double start_angle = 0;  ///< of the start point, seen from the centre [rad]
  double sweep = 0;        ///< angle run through, > 0 [rad]
  double sense = 1;        ///< +1 counterclockwise, -1 clockwise
  double length = 0;       ///< radius*sweep [Um]
};

/// Error of an arc's data: 0, 50 (radius too small to join the points), 51 (no displacement but a radius).
/// Exact for all 32-bit values.
int arc_error(std::int32_t radius, std::int32_t dx, std::int32_t dy);
/// The arc of signed radius (+ short way, - long way). Requires arc_error() == 0 and a displacement.
Arc make_arc(std::int32_t radius, std::int32_t dx, std::int32_t dy, Turn turn);

/// Motion of one axis at arc length m. The tangent axis turns through `um_per_turn` Um a turn.
Motion at(const Arc& arc, ArcAxis axis, double m, double um_per_turn);
/// Largest |dv/dm| while |v| grows, or falls.
double peak_acceleration(const Arc& arc, ArcAxis axis);
double peak_deceleration(const Arc& arc, ArcAxis axis);

}  // namespace drycut::devices::camming4
