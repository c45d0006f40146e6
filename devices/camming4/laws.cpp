#include "devices/camming4/laws.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace drycut::devices::camming4 {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;

/// Share of a cycloidal ramp's change that is done at p = 0..1 of its length.
double cycloid(double p) { return p - std::sin(two_pi * p) / two_pi; }

/// Where the cycloid has done `share` of its change.
double inverse_cycloid(double share) {
  double low = 0;
  double high = 1;
  for (int i = 0; i < 52; ++i) {
    const double middle = (low + high) / 2;
    (cycloid(middle) < share ? low : high) = middle;
  }
  return (low + high) / 2;
}

/// Largest |dv/dm| of a ramp while |v| grows (`growing`) or falls.
double peak(const CamRamp& ramp, bool growing) {
  const double change = std::abs(ramp.v1 - ramp.v0);
  const double most = (ramp.cycloidal ? 2 : 1) * change / ramp.length;
  if (ramp.v0 * ramp.v1 >= 0) return (std::abs(ramp.v1) > std::abs(ramp.v0)) == growing ? most : 0;
  // The speed falls to zero, then grows: a cycloid's peak, at half-way, belongs to the longer of the two.
  const double zero = std::abs(ramp.v0) / change;
  if (!ramp.cycloidal || (zero <= 0.5) == growing) return most;
  return change / ramp.length * (1 - std::cos(two_pi * inverse_cycloid(zero)));
}

double peak(const Law& law, bool growing) {
  double most = 0;
  for (int i = 0; i < law.count; ++i) most = std::max(most, peak(law.ramps[i], growing));
  return most;
}

void append(Law& law, const CamRamp& ramp) { law.ramps[law.count++] = ramp; }

}  // namespace

CamMotion at(const Law& law, double m) {
  int i = law.count - 1;
  while (i > 0 && m < law.ramps[i].from) --i;
  return at(law.ramps[i], m);
}

double peak_acceleration(const Law& law) { return peak(law, true); }
double peak_deceleration(const Law& law) { return peak(law, false); }

Law constant(double master, double speed) {
  Law law{.length = master, .mid_speed = speed, .exit_speed = speed};
  append(law, {.length = master, .v0 = speed, .v1 = speed});
  return law;
}

Law single_ramp(double master, double slave, double v0, Shape shape) {
  const double mean = slave / master;
  double v1 = 2 * mean - v0;
  // Rounding of the speeds before must neither grow from sector to sector nor leave a stopped slave moving.
  constexpr double rounding = 1e-12;
  if (std::abs(v1 - v0) <= rounding * std::abs(mean)) v1 = mean;
  if (std::abs(v1) <= rounding * std::abs(v0)) v1 = 0;
  Law law{.length = master, .mid_speed = mean, .exit_speed = v1};
  append(law, {.length = master, .v0 = v0, .v1 = v1, .cycloidal = shape == Shape::cycloidal});
  return law;
}

Law two_phase(double master, double slave, double v0, double v1, Shape shape) {
  const bool cycloidal = shape == Shape::cycloidal;
  const double middle = 2 * slave / master - (v0 + v1) / 2;
  const double half = master / 2;
  Law law{.length = master, .mid_speed = middle, .exit_speed = v1};
  append(law, {.length = half, .v0 = v0, .v1 = middle, .cycloidal = cycloidal});
  append(law, {.from = half,
               .start = half,
               .length = half,
               .position = space(law.ramps[0]),
               .v0 = middle,
               .v1 = v1,
               .cycloidal = cycloidal});
  return law;
}

Law fitted(double master, double slave, double v0, double v1, double tolerance, Shape shape) {
  const double excess = slave - master * (v0 + v1) / 2;
  const bool cycloidal = shape == Shape::cycloidal;
  // Two straight phases of nearly the same slope are one ramp already; two cycloids never are.
  if (std::abs(excess) > (cycloidal ? tolerance : 0)) return two_phase(master, slave, v0, v1, shape);
  Law law{.length = master, .mid_speed = (v0 + v1) / 2, .exit_speed = v1};
  append(law, {.length = master, .v0 = v0, .v1 = v1, .excess = excess, .cycloidal = cycloidal});
  return law;
}

Law joined(const Law& first, double first_slave, const Law& second) {
  Law law = first;
  for (int i = 0; i < second.count && law.count < static_cast<int>(law.ramps.size()); ++i) {
    CamRamp ramp = second.ramps[i];
    ramp.from += first.length;
    ramp.start += first.length;
    ramp.position += first_slave;
    append(law, ramp);
  }
  law.length = first.length + second.length;
  law.exit_speed = second.exit_speed;
  return law;
}

Law softened(double master, double speed, const Softening& entry, const Softening& exit) {
  Law law{.length = master, .mid_speed = speed, .exit_speed = speed};
  if (entry.half_width > 0) {
    CamRamp ramp{.start = -entry.half_width,
                 .length = 2 * entry.half_width,
                 .v0 = speed - entry.change,
                 .v1 = speed,
                 .cycloidal = entry.shape == Shape::cycloidal};
    ramp.position = speed * entry.half_width - space(ramp);
    append(law, ramp);
  }
  append(law, {.from = entry.half_width, .length = master, .v0 = speed, .v1 = speed});
  if (exit.half_width > 0) {
    const double start = master - exit.half_width;
    append(law, {.from = start,
                 .start = start,
                 .length = 2 * exit.half_width,
                 .position = speed * start,
                 .v0 = speed,
                 .v1 = speed + exit.change,
                 .cycloidal = exit.shape == Shape::cycloidal});
  }
  return law;
}

}  // namespace drycut::devices::camming4
