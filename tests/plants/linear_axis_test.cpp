#include "plants/linear_axis.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/plants/screw_prediction.hpp"

namespace drycut::plants {
namespace {

/// The default unit without friction, a servo that may be off.
struct Unit : Machine {
  explicit Unit(LinearAxisDefinition definition, bool enabled = false) : Machine(definition) {
    command("servo.enable", enabled);
  }
  LinearAxis& axis() { return static_cast<LinearAxis&>(*plant); }
  Slide& carriage() { return axis().carriage(); }
  Shaft& rotor() { return axis().rotor(); }
  /// Carriage and motor together at `speed` [m/s].
  void launch(double speed, const LinearAxisData& data) {
    carriage().speed = speed;
    rotor().speed = speed * turn / data.lead * data.gear.ratio;
  }
};

LinearAxisDefinition frictionless() {
  LinearAxisDefinition definition;
  definition.data.motor_friction = {};
  definition.data.guide_friction = {};
  return definition;
}

ScrewPrediction predicted(const LinearAxisData& data) { return {data, data.drive.servo.rotor_inertia}; }

TEST(LinearAxis, FreeMotionKeepsItsSpeed) {
  const auto definition = frictionless();
  Unit unit(definition);
  unit.launch(0.3, definition.data);
  unit.run(2);
  EXPECT_NEAR(unit.read("speed"), 300, 1e-9);
  EXPECT_NEAR(unit.read("position"), 700, 1e-6);
  EXPECT_NEAR(unit.read("motor.speed"), 0.3 / 0.02 * 60, 1e-9);
  EXPECT_NEAR(unit.read("encoder.count"), 10000 * 0.6 / 0.02, 1);
  EXPECT_NEAR(unit.read("scale.count"), 600000, 1);
}

TEST(LinearAxis, AnOuterForceAcceleratesCarriageAndMotorTogether) {
  auto definition = frictionless();
  definition.data.gear.ratio = 2;
  Unit unit(definition);
  unit.set("force", 500);
  unit.run(0.5);
  const Uniform motion = {500 / predicted(definition.data).total(), 0.5};
  // The spring stretches by the force that moves the motor; its oscillation dies out by its damper.
  EXPECT_NEAR(unit.read("speed") / (1000 * motion.speed()), 1, 1e-2);
  EXPECT_NEAR(unit.read("position"), 100 + 1000 * motion.way(), 0.05);
  unit.set("force", 0);
  const double before = unit.read("speed");
  unit.run(0.2);
  EXPECT_NEAR(unit.read("speed"), before, before * 1e-2);
}

TEST(LinearAxis, ConservesMomentumAndLosesEnergyOnlyInTheDamper) {
  auto definition = frictionless();
  const auto& data = definition.data;
  const auto run = [&](double damping) {
    definition.data.gear.damping = damping;
    Unit unit(definition);
    unit.carriage().speed = 0.2;  // the motor stands: the screw is wound up
    const ScrewPrediction screw = predicted(data);
    const auto momentum = [&] { return screw.momentum(unit.carriage(), unit.rotor()); };
    const auto energy = [&] {
      return screw.energy(unit.carriage(), unit.rotor(), unit.axis().twist() * data.lead / turn);
    };
    const double p = momentum();
    const double e = energy();
    unit.run(0.5);
    EXPECT_NEAR(momentum() / p, 1, 1e-10);
    return energy() / e;
  };
  // Without the damper symplectic Euler lets the energy swing by about w h / 2.
  const double w = std::sqrt(1000 / (20 * std::pow(0.02 / turn, 2)));
  EXPECT_NEAR(run(0), 1, w * h);
  const double end = data.mass / predicted(data).total();  // both at the common speed
  EXPECT_NEAR(run(0.05), end, 0.01 * end);
}

/// Angular frequency at which a unit's twist swings after a push of its carriage [rad/s].
double swing_of(const LinearAxisDefinition& definition) {
  Unit unit(definition);
  unit.carriage().speed = 0.05;
  std::vector<double> crossings;
  double before = 0;
  const double fine = 1e-5;
  for (int i = 0; i < 20000; ++i) {
    unit.step(fine);
    const double now = unit.axis().twist();
    if (before < 0 && now >= 0) crossings.push_back((i + before / (before - now)) * fine);
    before = now;
  }
  EXPECT_GT(crossings.size(), 20U);
  return turn * static_cast<double>(crossings.size() - 1) / (crossings.back() - crossings.front());
}

TEST(LinearAxis, OscillatesAtTheTwoMassResonance) {
  auto definition = frictionless();
  definition.data.gear.damping = 0;
  EXPECT_NEAR(swing_of(definition) / predicted(definition.data).resonance(), 1, 1e-3);
}

// A screw behind its coupling is the load's: resonance, and antiresonance with a motor that does not give
// way.
TEST(LinearAxis, ItsScrewMayTurnWithTheCarriage) {
  auto definition = frictionless();
  auto& data = definition.data;
  data.nut_rigid = true;
  data.screw_inertia = 2e-3;
  data.gear = {2, 3000, 0, 0};
  const double metre = data.lead / turn;
  const double load = data.screw_inertia + data.mass * metre * metre;
  const double motor = data.drive.servo.rotor_inertia * 4;
  EXPECT_NEAR(swing_of(definition) / std::sqrt(3000 * (1 / load + 1 / motor)), 1, 1e-3);
  data.drive.servo.rotor_inertia = 1e3;
  EXPECT_NEAR(swing_of(definition) / std::sqrt(3000 / load), 1, 1e-3);
}

// On a slope it weighs no more for it.
TEST(LinearAxis, AScrewThatTurnsWithTheCarriageWeighsNothingOnASlope) {
  for (const bool rigid : {false, true}) {
    auto definition = frictionless();
    definition.data.inclination = 0.5;
    definition.data.nut_rigid = rigid;
    definition.data.screw_inertia = 2e-3;
    Unit unit(definition, true);
    unit.run(2);
    EXPECT_NEAR(unit.read("gear.force"), 20 * gravity * std::sin(0.5), 1e-3 * 20 * gravity);
  }
}

// Without a stiffness of its own any axis swings at 200 Hz.
TEST(LinearAxis, AStiffnessThatIsNotKnownFollowsTheInertias) {
  for (const double mass : {1.0, 2000.0}) {
    auto definition = frictionless();
    definition.data.mass = mass;
    definition.data.gear.stiffness = 0;
    EXPECT_TRUE(definition.objections(h).empty()) << mass;
    const double damped = std::sqrt(1 - 0.05 * 0.05);
    EXPECT_NEAR(swing_of(definition) / (turn * 200 * damped), 1, 2e-3) << mass;
  }
}

// Rolling guides on a slope: what lies on them counts, and only what slides.
TEST(LinearAxis, FrictionByACoefficientGrowsWithTheWeightOnTheGuides) {
  auto definition = frictionless();
  auto& data = definition.data;
  data.inclination = 0.5;
  data.guide_coefficient = 0.2;
  data.guide_friction.backward = 0.5;
  Unit unit(definition, true);
  const auto torque_at = [&](double volts) {
    unit.reference(volts);
    unit.run(0.3);
    return unit.read("motor.torque");
  };
  const double arm = data.lead / turn;
  const double weight = 20 * gravity * std::sin(0.5);
  const double rubs = 0.2 * 20 * gravity * std::cos(0.5);
  EXPECT_NEAR(torque_at(1), (weight + rubs) * arm, 1e-3 * weight * arm);
  EXPECT_NEAR(torque_at(-1), (weight - rubs / 2) * arm, 1e-3 * weight * arm);
}

TEST(LinearAxis, EndStopTakesTheMomentumOfAFreeCarriage) {
  for (const double side : {-1.0, 1.0}) {
    auto definition = frictionless();
    definition.data.gear.stiffness = 1e-12;  // the motor holds nothing
    definition.data.gear.damping = 0;
    definition.data.stop.damping = 0;
    definition.data.start = side > 0 ? 1.0 : 0.0;
    Unit unit(definition);
    unit.carriage().speed = side * 0.5;
    while (unit.events.empty() && unit.steps < 20000) unit.step(1e-5);
    const MachineEvent& hit = unit.only("end_stop");
    EXPECT_EQ(value(hit, "side"), side);
    const double speed = value(hit, "speed") / 1000;
    EXPECT_NEAR(speed, 0.5, 1e-9);
    EXPECT_NEAR(value(hit, "impulse"), 20 * 0.5, 1e-6);
    EXPECT_NEAR(value(hit, "force") / (speed * std::sqrt(2e6 * 20)), 1, 2e-3);
    // A quarter of the contact's period after the touch.
    EXPECT_NEAR(unit.times[0], 0.05 / 0.5 + turn / 4 / std::sqrt(2e6 / 20), 3e-5);
  }
}

TEST(LinearAxis, PressingOnTheStopIsOneHit) {
  auto definition = frictionless();
  definition.data.start = 1.04;
  definition.data.stop.damping = 2e4;  // over-damped with the motor: no rebound
  Unit unit(definition);
  unit.set("force", 200);
  unit.run(3);
  ASSERT_GE(unit.events.size(), 1U);
  EXPECT_EQ(value(unit.events[0], "side"), 1);
  const auto hits = unit.events.size();
  unit.run(1);
  EXPECT_EQ(unit.events.size(), hits);
  EXPECT_NEAR(unit.read("stop.force"), 200, 0.1);
  EXPECT_NEAR(unit.read("position"), 1050 + 200 / 2e6 * 1000, 1e-3);
}

TEST(LinearAxis, WeightActsAlongAnInclinedAxis) {
  auto definition = frictionless();
  definition.data.inclination = std::numbers::pi / 6;
  definition.data.start = 0.9;
  Unit unit(definition);
  unit.run(0.3);
  const double a = definition.data.mass * gravity * 0.5 / predicted(definition.data).total();
  EXPECT_NEAR(unit.read("speed") / (-1000 * a * 0.3), 1, 1e-2);
}

TEST(LinearAxis, FrictionHoldsTheCarriageOnASlope) {
  LinearAxisDefinition definition;
  definition.data.inclination = 5 * std::numbers::pi / 180;  // 17 N of weight, 30 N of friction
  Unit unit(definition);
  unit.run(0.5);
  EXPECT_EQ(unit.read("position"), 100);
  EXPECT_EQ(unit.read("speed"), 0);
}

TEST(LinearAxis, TheServoCarriesTheWeight) {
  LinearAxisDefinition definition;
  definition.data.inclination = std::numbers::pi / 2;
  Unit unit(definition, true);
  unit.run(1);
  EXPECT_NEAR(unit.read("speed"), 0, 1e-3);
  EXPECT_NEAR(unit.read("gear.force"), 20 * gravity, 31);  // friction may take 30 N of it
  EXPECT_GT(unit.read("position"), 99);
}

TEST(LinearAxis, TheReferenceIsASpeed) {
  LinearAxisDefinition definition;
  Unit unit(definition, true);
  unit.reference(3);
  unit.run(1);
  EXPECT_NEAR(unit.read("motor.speed"), 600, 0.5);
  EXPECT_NEAR(unit.read("speed"), 200, 0.2);
  EXPECT_NEAR(unit.read("gear.force"), 30 + 50 * 0.2, 0.5);
}

TEST(LinearAxis, SwitchesAndZeroPulsesAreWhereTheyAreSet) {
  auto definition = frictionless();
  definition.data.start = -0.04;
  Unit unit(definition);
  unit.launch(0.1, definition.data);
  const auto& home = unit.plug<SignalPort>("home");
  const auto& low = unit.plug<SignalPort>("limit_min");
  const auto& high = unit.plug<SignalPort>("limit_max");
  const auto& index = unit.plug<SignalPort>("encoder.index");
  const auto& counter = unit.plug<EncoderPort>("encoder");
  EXPECT_TRUE(low.level);
  EXPECT_FALSE(home.level);
  int pulses = 0;
  double home_on = 0;
  double home_off = 0;
  for (int i = 0; i < 6000; ++i) {
    const bool was = home.level;
    unit.step();
    const double at = unit.carriage().position;
    if (!was && home.level) home_on = at;
    if (was && !home.level) home_off = at;
    if (index.edges.empty()) continue;
    // At whole turns of the motor: multiples of 20 mm, exact to the count.
    EXPECT_EQ((counter.count_at(index.edges[0].fraction) - 20000) % 10000, 0);
    ++pulses;
  }
  EXPECT_NEAR(home_on, -0.01 + 0.5e-3 * 0.1, 2e-5);
  EXPECT_NEAR(home_off, 0.0105 + 0.5e-3 * 0.1, 2e-5);
  EXPECT_EQ(pulses, 2);  // 0 mm and ... the run ends just before 20 mm
  EXPECT_FALSE(low.level);
  EXPECT_FALSE(high.level);
}

TEST(LinearAxis, BacklashLetsTheCarriageStandWhileTheMotorTurnsBack) {
  LinearAxisDefinition definition;
  definition.data.gear.backlash = 3.6 * std::numbers::pi / 180;  // 0.2 mm at the carriage
  Unit unit(definition, true);
  auto& volts = unit.plug<ReferencePort>("servo.reference").volts;
  volts = 0.5;
  unit.run(0.5);
  for (; volts > 0; volts -= 1e-4) unit.step();  // gently, so that the carriage stays on its flank
  volts = 0;
  unit.run(0.3);
  const double position = unit.read("position");
  const double angle = unit.rotor().revolutions();
  volts = -0.05;  // 10 rpm: the play of 1 % of a turn takes 60 ms
  while (unit.read("position") > position - 1e-3 && unit.steps < 20000) unit.step();
  EXPECT_NEAR(angle - unit.rotor().revolutions(), 0.01, 1.5e-3);
}

TEST(LinearAxis, Faults) {
  LinearAxisDefinition definition;
  Unit unit(definition, true);
  unit.reference(1);
  unit.run(0.2);
  unit.fault("encoder", "stuck", 1);
  unit.fault("scale", "lose_counts", 100);
  unit.fault("home", "dead", 1);
  unit.fault("limit_min", "stuck", 1);
  unit.fault("limit_max", "stuck", 1);
  const double count = unit.read("encoder.count");
  unit.run(0.2);
  EXPECT_EQ(unit.read("encoder.count"), count);
  EXPECT_NEAR(unit.read("scale.count"), unit.read("position") * 1000 - 100000 - 100, 2);
  unit.fault("servo", "disabled", 1);
  unit.run(2);
  EXPECT_EQ(unit.read("speed"), 0);
  EXPECT_EQ(unit.read("home"), 0);
}

TEST(LinearAxis, WhatCannotBeBuiltIsRefused) {
  expect_refusals<LinearAxisDefinition>({
      {[](auto& d) { d.gear.stiffness = 1e6; }, {"gear.stiffness: "}},
      {[](auto& d) { d.stop.damping = 1e6; }, {"stop.damping: "}},
      {[](auto& d) { d.motor_friction.viscous = 99; }, {"motor_friction.viscous: "}},
      {[](auto& d) { d.guide_friction.viscous = 9e5; }, {"carriage_friction.viscous: "}},
      {[](auto& d) { d.travel_max = -1; }, {"travel_max: "}},
      {[](auto& d) { d.start = 2; }, {"start: "}},
      {[](auto& d) { d.sensors.limit_max = -1; }, {"limit_max: "}},
      {[](auto& d) { d.drive.servo.max_speed = 1; }, {"servo.max_speed: "}},
      {[](auto& d) { d.drive.servo.peak_torque = 1; },
       {"servo.peak_torque: ", "servo.torque_at_max_speed: "}},
  });
}

TEST(LinearAxis, TheCarrierMustBeOne) {
  LinearAxisDefinition definition;
  definition.data.carrier = "web";
  World world;
  EXPECT_THAT([&] { definition.build(world, [](std::string_view) { return nullptr; }); },
              ::testing::ThrowsMessage<std::invalid_argument>(
                  ::testing::HasSubstr("'web' is no plant of type linear_axis")));
}

TEST(LinearAxis, TheCarriedAxisRidesAlongWithWhateverToolItHas) {
  for (const char* tool : {"none", "guide", "blade", "pen"}) {
    LinearAxisDefinition lower;
    LinearAxisDefinition upper;
    upper.data.inclination = std::numbers::pi / 2;
    upper.data.carrier = "x";
    upper.data.tool = tool;
    World world;
    const auto x = lower.build(world, nullptr);
    const auto y = upper.build(world, [&](std::string_view) { return x.get(); });
    for (const Part& part : y->parts()) {
      if (part.name == "sheet" || part.name.starts_with("ink")) continue;  // they lie where they are
      const Pose before = part.now().pose;
      static_cast<LinearAxis&>(*x).carriage().position += 0.25;
      const Pose after = part.now().pose;
      EXPECT_NEAR(after.position[0] - before.position[0], 0.25, 1e-12) << part.name;
      EXPECT_NEAR(after.position[1], before.position[1], 1e-12) << part.name;
    }
  }
}

TEST(LinearAxis, ThePenLeavesInkOnlyWhileItIsDown) {
  auto definition = frictionless();
  definition.data.tool = "pen";
  Unit unit(definition);
  unit.launch(0.1, definition.data);
  const auto parts = unit.plant->parts();
  const auto visible = [&] {
    return std::count_if(parts.begin(), parts.end(), [](const Part& p) { return p.now().visible; });
  };
  const auto blank = visible();
  unit.run(0.1);
  EXPECT_EQ(visible(), blank);
  unit.command("tool", true);
  unit.run(0.1);  // 10 mm, a dot every 1.2 mm
  EXPECT_NEAR(static_cast<double>(visible() - blank), 9, 1);
  unit.run(8);
  EXPECT_LE(visible() - blank, 600);
}

}  // namespace
}  // namespace drycut::plants
