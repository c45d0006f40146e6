#pragma once
#include <array>

namespace drycut::devices::camming4 {

// The motion laws of the cam's sectors (spec qem.md 8.4, 8.5; 000 1.2.1-1.2.3) as plain values. Master
// positions m are in master Um from the start of the sector, slave positions in slave Um from the same point;
// speeds are slave Um per master Um (1 = as fast as the master), accelerations and jerks their derivatives
// with respect to the master.

/// Slave motion at one master position.
struct Motion {
  double position = 0;      ///< [slave Um]
  double velocity = 0;      ///< ds/dm
  double acceleration = 0;  ///< d2s/dm2
  double jerk = 0;          ///< d3s/dm3
};

/// A change of speed over `length` of the master, straight or cycloidal. Both take the same space.
struct Ramp {
  double from = 0;      ///< master position from which the ramp is in force
  double start = 0;     ///< master position of its zero; a softening is entered half-way, at start + length/2
  double length = 0;    ///< > 0
  double position = 0;  ///< slave position at `start`
  double v0 = 0;
  double v1 = 0;
  double excess = 0;  ///< cycloidal: slave space beyond length*(v0+v1)/2, spread without touching the ends
  bool cycloidal = false;
};
/// The ramp's motion at m, start <= m <= start + length.
Motion at(const Ramp& ramp, double m);
/// Slave space of the whole ramp.
double space(const Ramp& ramp);

/// A sector's law: up to three ramps one after the other.
struct Law {
  std::array<Ramp, 3> ramps{};
  int count = 0;
  double length = 0;      ///< master space
  double mid_speed = 0;   ///< at the middle of the speed change
  double exit_speed = 0;  ///< at the end of the sector; of a softened exit: without the softening
};
Motion at(const Law& law, double m);
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
};
/// One speed with a softened entry and exit. Position and space are relative to the unsoftened law: the
/// slave passes the boundaries off it by change*half_width/4 (straight), and is back on it after the ramp.
Law softened(double master, double speed, const Softening& entry, const Softening& exit);

}  // namespace drycut::devices::camming4
