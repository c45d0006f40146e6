#pragma once
#include <algorithm>
#include <cmath>

namespace drycut::plants {

/// Coulomb, static and viscous friction of a guided body; in N m and N m s/rad for a shaft, N and N s/m for a
/// slide.
struct Friction {
  double coulomb = 0;    ///< dry friction while it moves
  double viscous = 0;    ///< per unit of speed
  double breakaway = 0;  ///< what dry friction at standstill is above `coulomb` (Stribeck)
  double stribeck_speed =
      0;  ///< speed at which 1/e of `breakaway` is left [rad/s or m/s], > 0 with breakaway
};

/// What else resists the motion like dry friction, in one direction only: a blade in the material.
struct DryResistance {
  double forward = 0;   ///< against positive motion, >= 0
  double backward = 0;  ///< against negative motion, >= 0
};

/// The effort that friction and dry resistance exert on a body of `inertia` in the coming step of `h`
/// seconds, when all other efforts on it sum up to `effort`: call it last. Dry friction is as large as stops
/// the body within the step, up to its limit: it holds at standstill and never reverses a motion.
[[nodiscard]] inline double friction_effort(const Friction& friction, double speed, double effort,
                                            double inertia, double h, DryResistance extra = {}) {
  const double viscous = -friction.viscous * speed;
  double dry = friction.coulomb;
  if (friction.breakaway > 0) {
    const double ratio = speed / friction.stribeck_speed;
    dry += friction.breakaway * std::exp(-ratio * ratio);
  }
  const double stopping = -(speed * inertia / h + effort + viscous);
  return viscous + std::clamp(stopping, -(dry + extra.forward), dry + extra.backward);
}

}  // namespace drycut::plants
