#pragma once
#include <cmath>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "plants/screw_drive.hpp"
#include "tests/plants/witness/cvode.hpp"
#include "tests/plants/witness/laws.hpp"

namespace drycut::plants::witness {

/// A part on a guided slide that a servo moves through gear and screw (or rack, or belt); the plants' are
/// plants/screw_drive.cpp with linear_axis.cpp, flying_saw.cpp, vertical_press.cpp. With q = 2 pi / lead
/// turns of the screw per travel [rad/m], n of the motor for one of the screw, angle a and speed w of the
/// motor:
///   twist = a / n - q x,  M = gear torque of the twist and its rate, at the screw
///   (rotor + screw / n^2) w' = T - M / n - friction of the motor
///   mass v' = q M + steady force + force of the process + buffers - friction of the guides
/// Where the screw loses, that is dry friction on the motor: the part of M / n that it takes more to drive,
/// (1 / efficiency - 1), and less to be driven, (1 - back efficiency).
struct ScrewLaw : Equations {
  enum State { angle, speed, place, pace };
  static constexpr std::size_t servo_states = 4;  ///< the servo's begin there
  enum Switch { motor_slides, part_slides, torque_limit, first_buffer };

  Motion motion;
  Servo servo;
  TransmissionData gear;
  double per_metre;  ///< turn of the screw [rad/m]
  double motor_inertia;
  double mass;
  double begin;             ///< place of the part at the start [m]
  double begin_twist = 0;   ///< of the gear [rad]
  double steady_force = 0;  ///< along the slide: weight, counterbalance [N]
  double efficiency = 1;
  double back_efficiency = 1;
  Dry motor_friction;
  Dry guide_friction;
  std::vector<Buffer> buffers;

  ScrewLaw(const ScrewDriveData& data, const ServoData& drive, Motion told)
      : motion(std::move(told)),
        servo{drive},
        gear(data.gear),
        per_metre(2 * std::numbers::pi / data.lead),
        motor_inertia(drive.rotor_inertia + data.screw_inertia / std::pow(data.gear.ratio, 2)),
        mass(data.mass),
        begin(data.start),
        motor_friction{data.motor_friction},
        guide_friction{data.guide_friction},
        buffers{{data.stop, data.travel_min, -1}, {data.stop, data.travel_max, 1}} {}

  [[nodiscard]] std::vector<double> start() const override {
    return {begin * per_metre * gear.ratio, 0, begin, 0, 0, 0, 0};
  }
  void record(std::span<const double> y, Track& track) const {
    track.motor.push_back(y[angle] / gear.ratio / per_metre);
    track.load.push_back(y[place]);
  }

  /// All but the friction.
  struct Efforts {
    double motor;  ///< [N m]
    double part;   ///< [N]
    DryResistance losses;
  };
  [[nodiscard]] Efforts efforts(std::span<const double> y) const {
    const double twist = begin_twist + y[angle] / gear.ratio - y[place] * per_metre;
    const double rate = y[speed] / gear.ratio - y[pace] * per_metre;
    const double screw = gear_torque(gear, twist, rate);
    Efforts sum{y[servo_states + Servo::torque] - screw / gear.ratio,
                screw * per_metre + steady_force + motion.force(),
                {}};
    for (const Buffer& buffer : buffers) sum.part += buffer.force(y[place], y[pace]);
    const double more = std::abs(screw / gear.ratio) * (1 / efficiency - 1);
    const double less = std::abs(screw / gear.ratio) * (1 - back_efficiency);
    sum.losses = screw > 0 ? DryResistance{more, less} : DryResistance{less, more};
    return sum;
  }

  [[nodiscard]] Servo::Input input(double t, std::span<const double> y, const Efforts& sum) const {
    return {motion.volts(t), y[speed],
            motor_friction.acceleration(motor_inertia, y[speed], sum.motor, sum.losses)};
  }
  void slope(double t, std::span<const double> y, std::span<double> dy) const override {
    const Efforts sum = efforts(y);
    const Servo::Input in = input(t, y, sum);
    dy[angle] = y[speed];
    dy[speed] = in.acceleration;
    dy[place] = y[pace];
    dy[pace] = guide_friction.acceleration(mass, y[pace], sum.part, {});
    servo.slope(in, y.subspan(servo_states), dy.subspan(servo_states));
  }
  [[nodiscard]] int switches() const override { return first_buffer + static_cast<int>(buffers.size()); }
  void watch(double t, std::span<const double> y, std::span<double> g) const override {
    const Efforts sum = efforts(y);
    g[motor_slides] = motor_friction.watch(y[speed], sum.motor, sum.losses);
    g[part_slides] = guide_friction.watch(y[pace], sum.part, {});
    g[torque_limit] = servo.watch(input(t, y, sum), y.subspan(servo_states));
    for (std::size_t i = 0; i < buffers.size(); ++i) g[first_buffer + i] = buffers[i].watch(y[place]);
  }
  void act(double t, std::span<double> y, int which) override {
    const Efforts sum = efforts(y);
    if (which == motor_slides)
      motor_friction.act(y[speed], sum.motor, sum.losses);
    else if (which == part_slides)
      guide_friction.act(y[pace], sum.part, {});
    else if (which == torque_limit)
      servo.act(input(t, y, sum), y.subspan(servo_states));
    else
      buffers[static_cast<std::size_t>(which) - first_buffer].act();
  }
};

}  // namespace drycut::plants::witness
