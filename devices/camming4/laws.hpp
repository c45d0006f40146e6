#pragma once
#include <array>
#include <cstdint>

#include "devices/cam/law.hpp"

namespace drycut::devices::camming4 {

// The motion laws of the cam's sectors (spec qem.md 8.4, 8.5; 000 1.2.1-1.2.3) as plain values. Master
// positions m are in master Um from the start of the sector, slave positions in slave Um from the same point;
// speeds are slave Um per master Um (1 = as fast as the master), accelerations and jerks their derivatives
// with respect to the master.

/// A sector's law: up to three ramps one after the other.
struct Law {
  std::array<CamRamp, 3> ramps{};
  int count = 0;
  double length = 0;      ///< master space
  double mid_speed = 0;   ///< at the middle of the speed change
  double exit_speed = 0;  ///< at the end of the sector; of a softened exit: without the softening

  void visit(StateArchive& archive);
};
CamMotion at(const Law& law, double m);
/// Largest |dv/dm| while the speed's magnitude grows, or falls; 0 if it never does.
double peak_acceleration(const Law& law);
double peak_deceleration(const Law& law);

enum class Shape : bool { straight, cycloidal };

/// One speed over the whole master space (NVS).
Law constant(double master, double speed);
/// One ramp from `v0`; the slave space fixes the end speed 2S/M - v0 (AZL, RSC).
Law single_ramp(double master, double slave, double v0, Shape shape);
/// Two ramps that meet at half the master space, with speed 2S/M - (v0+v1)/2 (RCC, DZC).
Law two_phase(double master, double slave, double v0, double v1, Shape shape);
/// End speeds and space all given (AZM, AZMS, NVSR): one ramp if the space is M(v0+v1)/2 to within
/// `tolerance`, else two phases.
Law fitted(double master, double slave, double v0, double v1, double tolerance, Shape shape);
/// `second` after `first`, which takes `first_slave`; three ramps in all at most (AZMC, DZMC).
Law joined(const Law& first, double first_slave, const Law& second);

/// One side of a softened change of ratio: a ramp of length 2*half_width centred on the boundary.
struct Softening {
  double half_width = 0;  ///< [master Um], 0 = none
  double change = 0;      ///< speed after less speed before the boundary
  Shape shape = Shape::straight;

  void visit(StateArchive& archive);
};
/// One speed with a softened entry and exit. Position and space are relative to the unsoftened law: the
/// slave passes the boundaries off it by change*half_width/4 (straight), and is back on it after the ramp.
Law softened(double master, double speed, const Softening& entry, const Softening& exit);

// The trigonometric sectors 170-175 (spec qem.md 8.6; 000 1.2.4). The master runs along the arc, so that s is
// the arc's abscissa; the start of the arc is the origin.

enum class Turn : bool { clockwise, counterclockwise };
/// Error of an arc's data: 0, 50 (radius too small to join the points), 51 (no displacement but a radius).
/// Exact for all 32-bit values.
int arc_error(std::int32_t radius, std::int32_t dx, std::int32_t dy);
/// The arc of signed radius (+ short way, - long way). Requires arc_error() == 0 and a displacement.
Arc make_arc(std::int32_t radius, std::int32_t dx, std::int32_t dy, Turn turn);

/// Largest |dv/dm| while |v| grows, or falls.
double peak_acceleration(const Arc& arc, ArcAxis axis);
double peak_deceleration(const Arc& arc, ArcAxis axis);

}  // namespace drycut::devices::camming4
