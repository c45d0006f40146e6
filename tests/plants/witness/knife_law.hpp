#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "plants/rotary_knife.hpp"
#include "tests/plants/witness/cvode.hpp"
#include "tests/plants/witness/laws.hpp"

namespace drycut::plants::witness {

/// The rotary knife on a web that nothing drives; the plant's is plants/rotary_knife.cpp with cutting.cpp.
/// With the motor's angle a and speed w, the drum's d and W, gear n, radius R of the blade tips, web of speed
/// v and thickness s, b the angle of the blade from bottom dead centre:
///   twist = a / n - d,  M = gear torque of the twist and its rate
///   rotor w' = T - M / n - friction of the motor, to which belongs what the gear loses: of M / n the part
///   that it
///              takes more to drive, 1 / efficiency - 1, and less to be driven, 1 - back efficiency
///   drum W' = M - H R cos b - friction of the drum and, until the blade is through, F R |sin b|
///   web v' = H = coupling (W R cos b - v), at most the grip
/// F is the parabola of the cut over the depth s - R (1 - cos b): 4 peak p (1 - p), p the depth over s. H
/// acts while the blade is in the web; behind bottom dead centre the piece is off and the web only runs up.
/// A counter drum adds its inertia and friction through its gear, and its blades close in as fast: R is 2 R
/// in F. A helical blade is a row of points, each with its share of F and H; the sums are integrals over the
/// points in the web, those before and those behind bottom dead centre. H has R cos helix for R then.
struct KnifeLaw : Equations {
  enum State { angle, speed, drum, drum_speed, web_speed };
  static constexpr std::size_t servo_states = 5;  ///< the servo's begin there
  enum Switch { motor_slides, drum_slides, torque_limit, blade, all };

  Motion motion;
  Servo servo;
  RotaryKnifeData data;
  WebData web;
  double peak;  ///< of the cutting force [N]
  double radius;
  Dry motor_friction;
  Dry drum_friction;
  /// Of the blade that comes next; the motions here only go forward while it is in the web.
  enum class Blade { above, cuts, through } at = Blade::above;
  double helix;
  double closing;                        ///< radius in F [m]
  double inertia;                        ///< of drum and counter drum [kg m2]
  double bottom = 2 * std::numbers::pi;  ///< its dead centre, angle of the drum [rad]

  KnifeLaw(const RotaryKnifeData& knife, WebData strip, Motion told)
      : motion(std::move(told)),
        servo{knife.drive.servo},
        data(knife),
        web(std::move(strip)),
        peak(web.shear_strength * web.thickness * web.width),
        radius(knife.circumference / (2 * std::numbers::pi)),
        motor_friction{knife.motor_friction},
        drum_friction{knife.drum_friction},
        helix(knife.helix),
        closing(knife.counter.kind == "blades" ? 2 * radius : radius),
        inertia(knife.drum_inertia) {
    if (knife.counter.kind == "none") return;
    const double n = knife.counter.ratio;
    inertia += knife.counter.inertia * n * n;
    drum_friction.data.coulomb += knife.counter.friction.coulomb * n;
    drum_friction.data.viscous += knife.counter.friction.viscous * n * n;
  }

  [[nodiscard]] std::vector<double> start() const override {
    std::vector<double> y = {data.initial_angle * data.gear.ratio, 0, data.initial_angle, 0, web.drive.speed};
    y.resize(servo_states + servo.states());
    return y;
  }

  void record(std::span<const double> y, Track& track) const {
    track.motor.push_back(y[angle] / data.gear.ratio * radius);
    track.load.push_back(y[drum] * radius);
  }

  /// All but the friction.
  struct Efforts {
    double motor;  ///< [N m]
    double drum;   ///< [N m]
    double web;    ///< [N]
    DryResistance cut;
    DryResistance losses;  ///< of the gear, at the motor
  };
  [[nodiscard]] Efforts efforts(std::span<const double> y) const {
    const double twist = y[angle] / data.gear.ratio - y[drum];
    const double rate = y[speed] / data.gear.ratio - y[drum_speed];
    const double gear = gear_torque(data.gear, twist, rate);
    Efforts sum{servo.on_rotor(y[angle], y.subspan(servo_states)) - gear / data.gear.ratio,
                gear * data.motors,
                0,
                {},
                {}};
    const double more = std::abs(gear / data.gear.ratio) * (1 / data.gear.efficiency.driving - 1);
    const double less = std::abs(gear / data.gear.ratio) * (1 - backwards(data.gear.efficiency));
    sum.losses = gear > 0 ? DryResistance{more, less} : DryResistance{less, more};
    if (at == Blade::above) return sum;
    const double behind = y[drum] - bottom;
    if (helix > 0) {
      add_points(behind, y[drum_speed], y[web_speed], sum);
      return sum;
    }
    const double arm = radius * std::cos(behind);
    const double push = data.coupling * (y[drum_speed] * arm - y[web_speed]);
    sum.web = std::clamp(at == Blade::through ? std::min(0.0, push) : push, -data.grip, data.grip);
    sum.drum -= sum.web * arm;
    if (at == Blade::cuts) sum.cut.forward = cutting_torque(behind);
    return sum;
  }
  /// Of a straight blade.
  [[nodiscard]] double cutting_torque(double behind) const {
    const double p = 1 - closing * (1 - std::cos(behind)) / web.thickness;
    return 4 * peak * p * (1 - p) * closing * std::abs(std::sin(behind));
  }
  /// Angle at which a point is on the web's surface, and what all of them take of the drum's turn.
  [[nodiscard]] double touch() const { return std::acos(1 - web.thickness / closing); }
  [[nodiscard]] double lag() const { return web.width * std::tan(helix) / (radius * std::cos(helix)); }
  void add_points(double behind, double omega, double v, Efforts& sum) const {
    const double from = std::max(behind - lag() / 2, -touch());
    const double to = std::min(behind + lag() / 2, touch());
    const auto mean = [&](double a, double b, auto&& value) {  // Simpson, times the share of the points
      if (b <= a) return 0.0;
      constexpr int n = 32;
      double total = value(a) + value(b);
      for (int i = 1; i < n; ++i) total += (i % 2 == 0 ? 2 : 4) * value(a + (b - a) * i / n);
      return total * (b - a) / (3 * n) / lag();
    };
    sum.cut.forward = mean(from, std::min(to, 0.0), [&](double b) { return cutting_torque(b); });
    const auto push = [&](double a, double b, double most) {
      const double share = mean(a, b, [](double) { return 1.0; });
      if (share == 0) return;
      const double arm = mean(a, b, [&](double c) { return radius * std::cos(helix) * std::cos(c); }) / share;
      const double force = share * std::clamp(data.coupling * (omega * arm - v), -data.grip, most);
      sum.web += force;
      sum.drum -= force * arm;
    };
    push(from, std::min(to, 0.0), data.grip);
    push(std::max(from, 0.0), to, 0);
  }

  [[nodiscard]] Servo::Input input(double t, std::span<const double> y, const Efforts& sum) const {
    return {motion.volts(t), y[speed],
            motor_friction.acceleration(servo.data.rotor_inertia, y[speed], sum.motor, sum.losses)};
  }
  void slope(double t, std::span<const double> y, std::span<double> dy) const override {
    const Efforts sum = efforts(y);
    const Servo::Input in = input(t, y, sum);
    dy[angle] = y[speed];
    dy[speed] = in.acceleration;
    dy[drum] = y[drum_speed];
    dy[drum_speed] = drum_friction.acceleration(inertia, y[drum_speed], sum.drum, sum.cut);
    dy[web_speed] = sum.web / web.mass;
    servo.slope(in, y.subspan(servo_states), dy.subspan(servo_states));
  }
  [[nodiscard]] int switches() const override { return all; }
  void watch(double t, std::span<const double> y, std::span<double> g) const override {
    const Efforts sum = efforts(y);
    g[motor_slides] = motor_friction.watch(y[speed], sum.motor, sum.losses);
    g[drum_slides] = drum_friction.watch(y[drum_speed], sum.drum, sum.cut);
    g[torque_limit] = servo.watch(input(t, y, sum), y.subspan(servo_states));
    const double behind = y[drum] - bottom;
    const double half = lag() / 2;
    g[blade] = at == Blade::above  ? behind + touch() + half
               : at == Blade::cuts ? behind - half
                                   : behind - touch() - half;
  }
  void act(double t, std::span<double> y, int which) override {
    const Efforts sum = efforts(y);
    if (which == motor_slides)
      motor_friction.act(y[speed], sum.motor, sum.losses);
    else if (which == drum_slides)
      drum_friction.act(y[drum_speed], sum.drum, sum.cut);
    else if (which == torque_limit)
      servo.act(input(t, y, sum), y.subspan(servo_states));
    else
      move_blade();
  }

 private:
  void move_blade() {
    if (at == Blade::above) {
      at = Blade::cuts;
    } else if (at == Blade::cuts) {
      at = Blade::through;
    } else {
      at = Blade::above;
      bottom += 2 * std::numbers::pi / data.blade_count;
    }
  }
};

}  // namespace drycut::plants::witness
