#include "devices/axis/profile.hpp"

#include <cmath>
#include <numbers>

namespace drycut::devices::axis {

double ramp_speed(RampShape shape, const Ramp& ramp, double t) {
  if (ramp.duration <= 0) return ramp.to;
  constexpr double turn = 2 * std::numbers::pi;
  const double p = t / ramp.duration;
  const double share = shape == RampShape::trapezoidal ? p : p - std::sin(turn * p) / turn;
  return ramp.from + (ramp.to - ramp.from) * share;
}

double ramp_space(RampShape shape, const Ramp& ramp, double t) {
  if (ramp.duration <= 0) return 0;
  constexpr double turn = 2 * std::numbers::pi;
  const double p = t / ramp.duration;
  double share = p * p / 2;
  if (shape == RampShape::epicycloidal) share -= (1 - std::cos(turn * p)) / (turn * turn);
  return ramp.duration * (ramp.from * p + (ramp.to - ramp.from) * share);
}

}  // namespace drycut::devices::axis
