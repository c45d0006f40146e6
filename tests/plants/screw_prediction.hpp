#pragma once
#include <cmath>

#include "plants/screw_drive.hpp"
#include "tests/plants/plants_lookup.hpp"

namespace drycut::plants {

/// What closed forms say of a screw drive without friction: two masses on a spring, all seen at the part.
struct ScrewPrediction {
  double per_metre;  ///< turn of the motor per travel [rad/m]
  double part;       ///< [kg]
  double motor;      ///< what turns with the motor [kg]
  double stiffness;  ///< [N/m]
  ScrewPrediction(const ScrewDriveData& data, double rotor_inertia)
      : per_metre(turn / data.lead * data.gear.ratio),
        part(data.mass),
        motor(motor_inertia(data, rotor_inertia) * per_metre * per_metre),
        stiffness(data.gear.stiffness * std::pow(turn / data.lead, 2)) {}

  [[nodiscard]] double total() const { return part + motor; }
  /// Angular frequency of the two masses against each other [rad/s].
  [[nodiscard]] double resonance() const { return std::sqrt(stiffness * (1 / part + 1 / motor)); }
  [[nodiscard]] double momentum(const Slide& slide, const Shaft& rotor) const {
    return part * slide.speed + motor * rotor.speed / per_metre;
  }
  /// `ahead`: the motor ahead of the part [m].
  [[nodiscard]] double energy(const Slide& slide, const Shaft& rotor, double ahead) const {
    return (part * std::pow(slide.speed, 2) + motor * std::pow(rotor.speed / per_metre, 2) +
            stiffness * ahead * ahead) /
           2;
  }
};

/// Uniform acceleration from rest, as symplectic Euler has it: the way is ahead by a t h / 2.
struct Uniform {
  double a;  ///< [m/s2]
  double t;  ///< [s]
  double dt = h;
  [[nodiscard]] double speed() const { return a * t; }
  [[nodiscard]] double way() const { return a * t * (t + dt) / 2; }
};

}  // namespace drycut::plants
