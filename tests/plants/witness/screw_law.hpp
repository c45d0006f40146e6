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
///   (rotor + screw / n^2) w' = T with cogging and ripple - M / n - friction of the motor
/// A screw that turns with the part is mass, inertia q^2, that weighs nothing; one between the two springs of
/// gear and nut has an angle and a speed of its own, and what it loses is on its shaft.
///   mass v' = q M + steady force + force of the process + buffers - friction of the guides
/// Where gear and screw lose, that is dry friction on the motor: the part of M / n that it takes more to
/// drive, (1 / efficiency - 1), and less to be driven, (1 - back efficiency).
struct ScrewLaw : Equations {
  enum State { angle, speed, place, pace, turn, turning };
  static constexpr std::size_t servo_states = 6;  ///< the servo's begin there
  enum Switch { motor_slides, part_slides, screw_slides, torque_limit, first_buffer };

  Motion motion;
  Servo servo;
  TransmissionData gear;
  double per_metre;  ///< turn of the screw [rad/m]
  double motor_inertia;
  double mass;
  double begin;             ///< place of the part at the start [m]
  double begin_twist = 0;   ///< of the gear [rad]
  double steady_force = 0;  ///< along the slide: weight, counterbalance [N]
  bool own_screw;           ///< it turns by itself
  double screw_inertia;
  double nut_stiffness;
  double nut_damping;
  Efficiency efficiency;  ///< of what is before the screw's spring: gear and screw, or the gear
  Efficiency of_screw;    ///< of one that turns by itself
  Dry screw_friction;
  Dry motor_friction;
  Dry guide_friction;
  std::vector<Buffer> buffers;

  ScrewLaw(const ScrewDriveData& data, const ServoData& drive, Motion told)
      : motion(std::move(told)),
        servo{drive},
        gear(data.gear),
        per_metre(2 * std::numbers::pi / data.lead),
        motor_inertia(drive.rotor_inertia + (data.nut_rigid || data.nut_stiffness > 0
                                                 ? 0
                                                 : data.screw_inertia / std::pow(data.gear.ratio, 2))),
        mass(data.mass + (data.nut_rigid ? data.screw_inertia * per_metre * per_metre : 0)),
        begin(data.start),
        own_screw(data.nut_stiffness > 0),
        screw_inertia(data.screw_inertia),
        nut_stiffness(data.nut_stiffness),
        nut_damping(data.nut_damping),
        efficiency{data.gear.efficiency.driving * (own_screw ? 1 : data.efficiency.driving),
                   backwards(data.gear.efficiency) * (own_screw ? 1 : backwards(data.efficiency))},
        of_screw(data.efficiency),
        motor_friction{data.motor_friction},
        guide_friction{data.guide_friction},
        buffers{{data.stop, data.travel_min, -1}, {data.stop, data.travel_max, 1}} {}

  [[nodiscard]] std::vector<double> start() const override {
    std::vector<double> y = {begin * per_metre * gear.ratio, 0, begin, 0, begin * per_metre, 0};
    y.resize(servo_states + servo.states());
    return y;
  }
  void record(std::span<const double> y, Track& track) const {
    track.motor.push_back(y[angle] / gear.ratio / per_metre);
    track.load.push_back(y[place]);
  }

  /// All but the friction.
  struct Efforts {
    double motor;  ///< [N m]
    double screw;  ///< [N m]
    double part;   ///< [N]
    DryResistance losses;
    DryResistance screw_losses;
  };
  [[nodiscard]] static DryResistance lost(const Efficiency& of, double torque) {
    const double more = std::abs(torque) * (1 / of.driving - 1);
    const double less = std::abs(torque) * (1 - backwards(of));
    return torque > 0 ? DryResistance{more, less} : DryResistance{less, more};
  }
  [[nodiscard]] Efforts efforts(std::span<const double> y) const {
    const double behind = own_screw ? y[turn] : y[place] * per_metre;
    const double behind_speed = own_screw ? y[turning] : y[pace] * per_metre;
    const double twist = begin_twist + y[angle] / gear.ratio - behind;
    const double screw = gear_torque(gear, twist, y[speed] / gear.ratio - behind_speed);
    const double nut =
        nut_stiffness * (y[turn] / per_metre - y[place]) + nut_damping * (y[turning] / per_metre - y[pace]);
    const double force = own_screw ? nut : screw * per_metre;
    Efforts sum{servo.on_rotor(y[angle], y.subspan(servo_states)) - screw / gear.ratio,
                screw - force / per_metre, force + steady_force + motion.force(),
                lost(efficiency, screw / gear.ratio), lost(of_screw, force / per_metre)};
    for (const Buffer& buffer : buffers) sum.part += buffer.force(y[place], y[pace]);
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
    dy[turn] = own_screw ? y[turning] : 0;
    dy[turning] =
        own_screw ? screw_friction.acceleration(screw_inertia, y[turning], sum.screw, sum.screw_losses) : 0;
    servo.slope(in, y.subspan(servo_states), dy.subspan(servo_states));
  }
  [[nodiscard]] int switches() const override { return first_buffer + static_cast<int>(buffers.size()); }
  void watch(double t, std::span<const double> y, std::span<double> g) const override {
    const Efforts sum = efforts(y);
    g[motor_slides] = motor_friction.watch(y[speed], sum.motor, sum.losses);
    g[part_slides] = guide_friction.watch(y[pace], sum.part, {});
    g[screw_slides] = own_screw ? screw_friction.watch(y[turning], sum.screw, sum.screw_losses) : -1;
    g[torque_limit] = servo.watch(input(t, y, sum), y.subspan(servo_states));
    for (std::size_t i = 0; i < buffers.size(); ++i) g[first_buffer + i] = buffers[i].watch(y[place]);
  }
  void act(double t, std::span<double> y, int which) override {
    const Efforts sum = efforts(y);
    if (which == motor_slides)
      motor_friction.act(y[speed], sum.motor, sum.losses);
    else if (which == part_slides)
      guide_friction.act(y[pace], sum.part, {});
    else if (which == screw_slides)
      screw_friction.act(y[turning], sum.screw, sum.screw_losses);
    else if (which == torque_limit)
      servo.act(input(t, y, sum), y.subspan(servo_states));
    else
      buffers[static_cast<std::size_t>(which) - first_buffer].act();
  }
};

}  // namespace drycut::plants::witness
