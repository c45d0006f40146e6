#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/bench/mechanism.hpp"

namespace drycut::bench {

namespace {

constexpr double circumference = 0.6;  // of the blade's circle [m]
constexpr double length = 0.8;         // of the pieces [m]
constexpr double zone = 0.06;          // blade and web go together [m]
constexpr double web_speed = 1;        // [m/s]
constexpr double counts_per_turn = 8192;
constexpr double counts_per_metre = 20000;
constexpr int steps_per_sample = 20;

double friction(double coulomb, double viscous, double speed, double torque, double inertia, double h) {
  const double stopping = -(speed * inertia / h + torque - viscous * speed);
  return -viscous * speed + std::clamp(stopping, -coulomb, coulomb);
}

/// Where the blade is to be when the web has come so far [m].
double cam(double web) {
  const double pieces = std::floor(web / length);
  const double in_piece = web - pieces * length;
  const double turns = pieces * circumference;
  if (in_piece < zone) return turns + in_piece;
  const double rest = length - zone;
  const double share = (in_piece - zone) / rest;
  const double bend = share - std::sin(2 * std::numbers::pi * share) / (2 * std::numbers::pi);
  return turns + zone + rest * share + (circumference - length) * bend;
}

}  // namespace

Followed run_floor(const Mechanism& m, std::int64_t steps) {
  constexpr double turn = 2 * std::numbers::pi;
  const double h = m.step;
  // Of the defaults of rotary_knife: filter and loops of the servo, friction, torque limit.
  const double filter_share = -std::expm1(-h / 1e-3);
  const double lag_share = -std::expm1(-h / 0.5e-3);
  const double speed_at_10v = turn * 2000 / 60;
  const double gain = (1 + 3.5) * m.motor_inertia * 250;
  const double most_torque = 28.6;
  const double per_volt = speed_at_10v / 10;
  const double lsb = 20.0 / (1 << 14);
  const double per_metre = counts_per_turn * m.ratio / circumference;
  const double full_speed = speed_at_10v / m.ratio / turn * circumference;  // of the blade at 10 V [m/s]

  double motor_speed = 0, drum_speed = 0, motor_part = 0, twist = 0, web = 0;
  std::int64_t motor_turns = 0;
  double volts = 0, filtered = 0, integral = 0, torque = 0, set = 0;
  Followed followed;
  for (std::int64_t i = 0; i < steps; ++i) {
    if (i % steps_per_sample == 0) {
      const double before = set;
      set = cam(std::floor(web * counts_per_metre + 0.5) / counts_per_metre);
      const double count =
          std::floor((static_cast<double>(motor_turns) + motor_part) * counts_per_turn + 0.5);
      const double error = set - count / per_metre;
      const double speed = (set - before) / (h * steps_per_sample) + 50 * error;
      volts = std::nearbyint(std::clamp(speed / full_speed, -1.0, 1.0) * 32767) / 3276.7;
      if (2 * i >= steps) followed.error = std::max(followed.error, std::abs(error));
    }
    filtered += (lsb * std::nearbyint(volts / lsb) * per_volt - filtered) * filter_share;
    const double slow = filtered - motor_speed;
    const double wanted = gain * slow + integral;
    const double command = std::clamp(wanted, -most_torque, most_torque);
    if (command == wanted || wanted * slow < 0) integral += gain / 20e-3 * slow * h;
    torque += (command - torque) * lag_share;
    const double gear = m.stiffness * twist + m.damping * (motor_speed / m.ratio - drum_speed);
    double on_motor = torque - gear / m.ratio;
    double on_drum = gear;
    on_motor += friction(0.1, 1e-4, motor_speed, on_motor, m.motor_inertia, h);
    on_drum += friction(1, m.friction, drum_speed, on_drum, m.drum_inertia, h);
    motor_speed += on_motor / m.motor_inertia * h;
    drum_speed += on_drum / m.drum_inertia * h;
    twist += (motor_speed / m.ratio - drum_speed) * h;
    motor_part += motor_speed * h / turn;
    if (motor_part >= 1) {
      motor_part -= 1;
      ++motor_turns;
    } else if (motor_part < 0) {
      motor_part += 1;
      --motor_turns;
    }
    web += web_speed * h;
  }
  followed.turns = static_cast<double>(motor_turns) + motor_part;
  return followed;
}

}  // namespace drycut::bench
