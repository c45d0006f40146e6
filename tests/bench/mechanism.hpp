#pragma once
#include <cstdint>

namespace drycut::bench {

/// The bare mechanism of the default line as other engines step it: motor, drum and web, guided by the
/// engine's own hinges and slider, motor and drum coupled by the gear's stiffness, a constant motor torque
/// against friction.
struct Mechanism {
  double step = 100e-6;            ///< [s]
  double motor_inertia = 46.8e-4;  ///< [kg m2]
  double drum_inertia = 0.41;      ///< [kg m2]
  double web_mass = 20;            ///< [kg]
  double ratio = 5;                ///< turns of the motor for one of the drum
  double stiffness = 52000;        ///< at the drum [N m/rad]
  double damping = 7;              ///< at the drum [N m s/rad]
  double torque = 1;               ///< of the motor [N m]
  double friction = 0.4;           ///< of the drum, viscous [N m s/rad]
};

/// Steps the mechanism `steps` times and returns the drum's final speed [rad/s], so that engines can be
/// compared.
double run_bullet(const Mechanism& mechanism, std::int64_t steps);
double run_mujoco(const Mechanism& mechanism, std::int64_t steps);

/// What a run of the floor came to.
struct Followed {
  double turns = 0;  ///< of the motor
  double error = 0;  ///< largest of blade against cam in the second half of the run [m]
};
/// The line's knife as one straight loop, the least that a step can be: motor and drum, gear, servo,
/// friction, encoder, and every 2 ms cam, position loop and DAC.
Followed run_floor(const Mechanism& mechanism, std::int64_t steps);

}  // namespace drycut::bench
