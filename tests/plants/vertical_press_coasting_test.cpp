// How far the ram coasts, against a model of its own: one mass, its equation solved for the acceleration,
// integrated by Runge-Kutta of fourth order in steps of 2 us.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/plants/drive_stand.hpp"
#include "tests/plants/screw_prediction.hpp"
#include "tests/plants/vertical_press_unit.hpp"

namespace drycut::plants {
namespace {

struct Model {
  double mass, net;  // [kg], weight less counterbalance [N]
  double inertia;    // of the motor with the screw [kg m2]
  double r;          // travel for a radian of the motor [m]
  double up, down;   // efficiency driving and driven
  double motor_dry, motor_viscous, guide_dry, guide_viscous;

  explicit Model(const VerticalPressData& d)
      : mass(d.mass + d.load),
        net((d.mass + d.load) * gravity - d.counterbalance),
        inertia(d.drive.motor.rotor_inertia + d.screw_inertia / (d.gear.ratio * d.gear.ratio)),
        r(d.lead / turn / d.gear.ratio),
        up(d.efficiency.driving),
        down(d.efficiency.backwards()),
        motor_dry(d.motor_friction.coulomb),
        motor_viscous(d.motor_friction.viscous),
        guide_dry(d.guide_friction.coulomb),
        guide_viscous(d.guide_friction.viscous) {}

  /// Acceleration in a motion in `direction` under a torque of the motor and a brake.
  [[nodiscard]] double acceleration(double v, double direction, double torque, double brake) const {
    const double carried = net + guide_viscous * v + direction * guide_dry;
    const double left = torque - direction * (motor_dry + brake) - motor_viscous * v / r;
    double a = 0;
    for (const double share : {1 / up, down}) {  // what the motor feels of the screw's force
      a = (left - share * r * carried) / (inertia / r + share * r * mass);
      const bool driving = (carried + mass * a) * direction > 0;
      if (driving == (share == 1 / up)) break;
    }
    return a;
  }
};

/// The way from the opening of the drive's contacts to rest, starting at `v`; the brake grips at `grip`.
double coast(const Model& m, double v, double grip, double brake) {
  constexpr double dt = 2e-6;
  double x = 0;
  for (long i = 0; i < 5'000'000; ++i) {
    const double torque = static_cast<double>(i) * dt < grip ? 0 : brake;
    double direction = v > 0 ? 1 : -1;
    if (v == 0) {  // rests, or falls if its weight overcomes the friction
      direction = m.net > 0 ? -1 : 1;
      if (m.acceleration(0, direction, 0, torque) * direction <= 0) {
        if (torque > 0) return x;
        continue;
      }
    }
    const auto a = [&](double speed) { return m.acceleration(speed, direction, 0, torque); };
    const double k1 = a(v);
    const double k2 = a(v + dt / 2 * k1);
    const double k3 = a(v + dt / 2 * k2);
    const double k4 = a(v + dt * k3);
    const double next = v + dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    x += dt * (v + dt / 6 * (k1 + k2 + k3));
    v = next * v < 0 ? 0 : next;
  }
  ADD_FAILURE() << "it never came to rest";
  return x;
}

struct Coasting {
  double speed;     // when the drive opens [m/s]
  double distance;  // from there to rest [m]
};

/// The press itself: to its speed, then all commands off.
Coasting measure(const VerticalPressDefinition& definition, int direction, bool slow, double run_up,
                 double dt = h) {
  Press press(definition);
  press.command(direction, slow);
  press.run(run_up, dt);
  press.command(0, false);
  while (press.read("drive.state") != 0) press.step(dt);
  // The step that found the drive off has moved the ram already.
  const Coasting start = {press.ram().speed_before, press.ram().position_before};
  press.run(3, dt);
  EXPECT_NEAR(press.ram().speed, 0, 1e-12);
  return {start.speed, press.ram().position - start.distance};
}

VerticalPressDefinition coasting_press(const char* kind) {
  VerticalPressDefinition definition;
  definition.data.drive.kind = kind;
  definition.data.drive.inverter.stop = "coast";
  return definition;
}

TEST(VerticalPressCoasting, AgreesWithTheIndependentModelWithinOnePercent) {
  for (const char* kind : {"inverter", "contactors"})
    for (const double load : {0.0, 300.0})
      for (const int direction : {1, -1})
        for (const bool slow : {false, true}) {
          auto definition = coasting_press(kind);
          definition.data.load = load;
          definition.data.start = direction > 0 ? 0.05 : 0.55;
          // The model is rigid: with the default screw its give, up to 10 um, shows in ways of 0.3 mm.
          definition.data.gear.stiffness = 5000;
          definition.data.gear.damping = 0.5;
          const Coasting press = measure(definition, direction, slow, 1);
          const double model = coast(Model(definition.data), press.speed, 40e-3, 25);
          EXPECT_NEAR(press.distance / model, 1, 0.01)
              << kind << (slow ? " slow" : " fast") << (direction > 0 ? " up" : " down") << " with " << load;
        }
}

TEST(VerticalPressCoasting, TheSpeedBeforeItFollowsFromSlipUnderLoad) {
  const auto definition = coasting_press("contactors");
  const Model m(definition.data);
  for (const int direction : {1, -1}) {
    auto mine = definition;
    mine.data.start = direction > 0 ? 0.05 : 0.55;
    const double v = measure(mine, direction, false, 1.5).speed;
    const WindingData winding;
    const double torque = kloss(winding, direction * winding.synchronous_speed - v / m.r);
    EXPECT_NEAR(m.acceleration(v, direction, torque, 0), 0, 1e-3);
  }
}

TEST(VerticalPressCoasting, UpAndDownDifferByWhatGravitySays) {
  // No losses, a brake at once: v^2 / 2a with a = (brake +- weight) / mass, all at the ram.
  auto definition = coasting_press("inverter");
  auto& d = definition.data;
  d.motor_friction = d.guide_friction = {};
  d.efficiency = {};
  d.drive.brake.engage_delay = 0;
  const double r = d.lead / turn;
  const double mass = ScrewPrediction(d, d.drive.motor.rotor_inertia).total();
  double deceleration[2] = {};
  for (const int direction : {1, -1}) {
    d.start = direction > 0 ? 0.05 : 0.55;
    const Coasting press = measure(definition, direction, false, 1);
    const double weight = d.mass * gravity - d.counterbalance;
    const double a = (25 / r + direction * weight) / mass;
    EXPECT_NEAR(std::abs(press.distance) / (press.speed * press.speed / (2 * a)), 1, 0.01);
    deceleration[direction > 0 ? 0 : 1] = press.speed * press.speed / (2 * std::abs(press.distance));
  }
  EXPECT_NEAR((deceleration[0] - deceleration[1]) / (2 * (d.mass * gravity - d.counterbalance) / mass), 1,
              0.01);
  // And with the weight balanced there is no difference.
  d.counterbalance = d.mass * gravity;
  d.start = 0.3;
  EXPECT_NEAR(measure(definition, 1, true, 0.5).distance / -measure(definition, -1, true, 0.5).distance, 1,
              1e-6);
}

TEST(VerticalPressCoasting, TheBrakeTakesSpeedAndWeight) {
  // Without losses: all that moves, and what the weight does over the way.
  auto definition = coasting_press("inverter");
  auto& d = definition.data;
  d.motor_friction = d.guide_friction = {};
  d.efficiency = {};
  d.drive.brake.engage_delay = 0;
  const double mass = ScrewPrediction(d, d.drive.motor.rotor_inertia).total();
  const double weight = d.mass * gravity - d.counterbalance;
  for (const int direction : {1, -1}) {
    d.start = direction > 0 ? 0.05 : 0.55;
    Press press(definition);
    press.command(direction, false);
    press.run(1);
    press.command(0, false);
    while (press.read("drive.state") != 0) press.step();
    const double speed = press.ram().speed_before;
    const double from = press.ram().position_before;
    press.run(3);
    const double energy = mass * speed * speed / 2 - weight * (press.ram().position - from);
    EXPECT_NEAR(press.read("brake.last_energy") / energy, 1, 5e-3) << direction;
    EXPECT_EQ(press.read("brake.engagements"), 1);
  }
}

TEST(VerticalPressCoasting, ScattersWithItsContactorsAndItsBrake) {
  // Balanced and without losses the way is the speed times the two delays in a row, and scatters as they do.
  const auto ways = [](double contactors, double brake, std::uint64_t seed) {
    auto definition = coasting_press("contactors");
    auto& d = definition.data;
    d.motor_friction = d.guide_friction = {};
    d.efficiency = {};
    d.counterbalance = d.mass * gravity;
    d.drive.contactors.scatter = contactors;
    d.drive.brake.scatter = brake;
    Press press(definition, seed);
    std::vector<int> all;  // [um]
    for (int i = 0; i < 60; ++i) {
      press.command(i % 2 == 0 ? 1 : -1, true);
      press.run(0.4);
      press.command(0, false);
      const double from = press.ram().position;
      press.run(0.4);
      all.push_back(static_cast<int>(std::lround(1e6 * std::abs(press.ram().position - from))));
    }
    return all;
  };
  const auto sound = ways(0, 0, 1);
  const auto scattered = ways(2e-3, 2e-3, 1);
  EXPECT_LT(deviation_of(sound), 5);
  EXPECT_NEAR(mean_of(scattered), mean_of(sound), 70);  // three standard errors
  EXPECT_NEAR(deviation_of(scattered), 62.5 * 2 * std::numbers::sqrt2, 50);
  EXPECT_EQ(ways(2e-3, 2e-3, 1), scattered);
  EXPECT_NE(ways(2e-3, 2e-3, 2), scattered);
}

TEST(VerticalPressCoasting, ConvergesWithTheStep) {
  auto definition = coasting_press("contactors");
  definition.data.start = 0.55;
  const auto distance = [&](double dt) { return measure(definition, -1, false, 1, dt).distance; };
  const double finest = distance(6.25e-6);
  double error = std::abs(distance(100e-6) - finest);
  EXPECT_LT(error, 5e-3 * std::abs(finest));
  for (const double dt : {50e-6, 25e-6}) {
    const double smaller = std::abs(distance(dt) - finest);
    EXPECT_LT(smaller, 0.65 * error) << dt;
    error = smaller;
  }
}

}  // namespace
}  // namespace drycut::plants
