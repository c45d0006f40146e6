#include "plants/backlash_axis.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/plants/screw_prediction.hpp"

namespace drycut::plants {
namespace {

struct Coupled : Machine {
  explicit Coupled(BacklashAxisDefinition definition, bool enabled = false) : Machine(definition) {
    command("servo.enable", enabled);
  }
  LinearAxis& axis() { return static_cast<LinearAxis&>(*plant); }
  Slide& load() { return axis().carriage(); }
  Shaft& motor() { return axis().rotor(); }
  /// How far the motor is ahead of the load [m].
  double lead_off() { return axis().twist() * 0.02 / turn; }
  /// Speed of the load relative to the motor [m/s].
  double apart() { return load().speed - motor().speed * 0.02 / turn; }
};

BacklashAxisDefinition frictionless_coupling() {
  BacklashAxisDefinition definition;
  definition.axis.data.motor_friction = {};
  definition.axis.data.guide_friction = {};
  return definition;
}

TEST(BacklashAxis, DampingRatioAndRestitutionAreInverse) {
  EXPECT_DOUBLE_EQ(restitution_of(0), 1);
  EXPECT_EQ(damping_ratio_for(1), 0);
  for (const double e : {0.3, 0.4, 0.5, 0.7, 0.9, 0.99})
    EXPECT_NEAR(restitution_of(damping_ratio_for(e)), e, 1e-12);
  // A light damper takes pi zeta, as in any free oscillation over half a period.
  EXPECT_NEAR(restitution_of(1e-4), 1 - std::numbers::pi * 1e-4, 1e-6);
  for (double zeta = 0.01; zeta < 0.95; zeta += 0.01)
    EXPECT_LT(restitution_of(zeta + 0.01), restitution_of(zeta));
}

/// Nut and flanks as the picture has them, along the axis from the middle of the carriage [m].
struct ShownPlay {
  double nut, below, above;
  bool below_red, above_red;
  Callout words;
};
ShownPlay shown_play(Coupled& unit) {
  const auto along = [&](const char* part) {
    return pose_of(*unit.plant, part).pose.position[0] - pose_of(*unit.plant, "carriage").pose.position[0];
  };
  std::vector<Callout> words;
  unit.plant->callouts(words);
  EXPECT_EQ(words.size(), 1U);
  return {along("nut"),
          along("flank 1"),
          along("flank 2"),
          pose_of(*unit.plant, "pushed flank 1").visible,
          pose_of(*unit.plant, "pushed flank 2").visible,
          words.at(0)};
}

TEST(BacklashAxis, ThePictureShowsThePlayAsMuchLargerAsItSays) {
  struct Case {
    double gap;
    const char* words;
    double scale;
  };
  // Within half of the carriage of 200 mm.
  for (const auto& [gap, words, scale] :
       {Case{1e-3, "play 1 mm, drawn x100", 100}, Case{0.4e-3, "play 0.4 mm, drawn x200", 200},
        Case{45e-3, "play 45 mm, drawn x2", 2}, Case{80e-3, "play 80 mm, to scale", 1}}) {
    auto definition = frictionless_coupling();
    definition.flanks.gap = gap;
    Coupled unit(definition);
    const auto middle = shown_play(unit);
    EXPECT_EQ(middle.words.text, words);
    EXPECT_NEAR(middle.nut, 0, 1e-12) << "it starts in the middle";
    EXPECT_FALSE(middle.below_red || middle.above_red);
    const auto shift = [&](double way) {  // of the motor, ahead of the load
      unit.load().speed = -way / h;
      unit.step();
      unit.load().speed = unit.motor().speed = 0;
    };
    shift(gap / 4);
    const auto ahead = shown_play(unit);
    EXPECT_NEAR(ahead.nut, scale * gap / 4, 1e-9) << words;
    // What is free between nut and flanks: their middles, less half a nut and half a flank on either side.
    const double solid = (0.05 + 0.018) * 0.2 / 0.16;
    EXPECT_NEAR(ahead.above - ahead.below - solid, scale * gap, 1e-9) << words;
    EXPECT_NEAR(ahead.words.to[0] - ahead.words.at[0], scale * gap + 0.05 * 0.2 / 0.16, 1e-9);
    shift(0.3 * gap);
    EXPECT_TRUE(shown_play(unit).above_red) << "it pushes that flank";
    EXPECT_FALSE(shown_play(unit).below_red);
    shift(-1.2 * gap);
    EXPECT_TRUE(shown_play(unit).below_red);
    EXPECT_NEAR(shown_play(unit).nut, -scale * gap / 2, 1e-9) << "no further than the flank";
  }
}

TEST(BacklashAxis, TheLoadIsFreeWithinTheGap) {
  const auto definition = frictionless_coupling();
  for (const double speed : {-0.05, 0.05}) {
    Coupled unit(definition);
    unit.load().speed = speed;
    // It starts in the middle: half a millimetre at 50 mm/s.
    const int free = 100;
    for (int i = 0; i < free; ++i) {
      unit.step();
      EXPECT_EQ(unit.load().speed, speed) << i;
      EXPECT_EQ(unit.motor().speed, 0) << i;
    }
    for (int i = 0; i < 5; ++i) unit.step();
    EXPECT_LT(std::abs(unit.load().speed), std::abs(speed));
    EXPECT_GT(unit.motor().speed * speed, 0);
  }
}

TEST(BacklashAxis, TheImpactHasItsRestitutionAndKeepsTheMomentum) {
  for (const double restitution : {0.3, 0.5, 0.8, 1.0})
    for (const double speed : {0.01, 0.2}) {
      auto definition = frictionless_coupling();
      definition.flanks.restitution = restitution;
      definition.flanks.stiffness = 1e6;  // a light contact, many steps long
      Coupled unit(definition);
      unit.load().speed = speed;
      const ScrewPrediction screw(definition.axis.data, 46.8e-4);
      double before = 0;
      for (int i = 0; i < 5000 && unit.apart() >= 0; ++i) {
        before = std::max(before, unit.apart());
        unit.step();
      }
      while (unit.lead_off() < -0.5e-3) unit.step();
      EXPECT_EQ(before, speed);
      EXPECT_NEAR(-unit.apart() / before / restitution, 1, 0.01) << restitution << " at " << speed;
      EXPECT_NEAR(screw.momentum(unit.load(), unit.motor()) / (100 * speed), 1, 1e-9);
    }
}

TEST(BacklashAxis, TheDefaultContactKeepsItsRestitutionInStepsOf100us) {
  Coupled unit(frictionless_coupling());
  unit.load().speed = 0.05;
  while (unit.apart() >= 0 && unit.steps < 1000) unit.step();
  while (unit.lead_off() < -0.5e-3 && unit.steps < 1000) unit.step();
  EXPECT_NEAR(-unit.apart() / 0.05, 0.5, 0.005);
}

TEST(BacklashAxis, StictionHoldsUpToTheBreakawayForceAndMotionNeedsLess) {
  BacklashAxisDefinition definition;  // 150 N in motion, 50 N more from rest
  definition.flanks.gap = 0.1;        // the motor is far away
  Coupled unit(definition);
  unit.set("force", 199.9);
  unit.run(0.2);
  EXPECT_EQ(unit.load().position, 0.1);
  EXPECT_EQ(unit.load().speed, 0);
  unit.set("force", 200.1);
  unit.step();
  EXPECT_NEAR(unit.load().speed, 0.1 / 100 * h, 1e-15);

  unit.load().speed = 0.03;  // three times the Stribeck speed
  unit.set("force", 160);
  unit.step();
  EXPECT_NEAR((unit.load().speed - 0.03) / h, (160 - 150 - 50 * std::exp(-9.0) - 100 * 0.03) / 100, 1e-9);
  unit.set("force", 0);
  unit.run(0.1);
  EXPECT_EQ(unit.load().speed, 0);
}

TEST(BacklashAxis, TheLoadCreepsThroughTheGapOnASlope) {
  auto definition = frictionless_coupling();
  definition.axis.data.inclination = std::numbers::pi / 6;
  definition.flanks.gap = 0.02;
  definition.axis.data.motor_friction.coulomb = 20;  // holds the motor
  Coupled unit(definition);
  const double seconds = 0.05;
  unit.run(seconds);
  const Uniform fall = {-gravity / 2, seconds};
  EXPECT_NEAR(unit.load().speed, fall.speed(), 1e-9);
  EXPECT_NEAR(unit.load().position - 0.1, fall.way(), 1e-9);
  unit.run(2);  // then it lies on the lower flank, pressed by its weight
  EXPECT_NEAR(unit.read("gear.force"), 100 * gravity / 2, 1);
  EXPECT_NEAR(unit.read("motor.position") - unit.read("position"), 10, 0.01);
}

TEST(BacklashAxis, TheEndStopStopsTheLoadAndNotTheMotorAtOnce) {
  auto definition = frictionless_coupling();
  definition.axis.data.start = 1.049;
  definition.flanks.gap = 0.2;
  definition.axis.data.stop.damping = 0;
  Coupled unit(definition);
  unit.load().speed = 0.5;
  unit.motor().speed = 0.5 * turn / 0.02;
  while (unit.events.empty() && unit.steps < 2000) unit.step();
  ASSERT_EQ(unit.events.size(), 1U);
  EXPECT_EQ(value(unit.events[0], "side"), 1);
  EXPECT_NEAR(value(unit.events[0], "impulse"), 100 * 0.5, 0.01);  // of the load alone
  EXPECT_EQ(unit.motor().speed, 0.5 * turn / 0.02);
  // The motor crosses the gap and presses the load into the stop again; it never gets far.
  double deepest = 0;
  for (int i = 0; i < 20000; ++i) {
    unit.step();
    deepest = std::max(deepest, unit.load().position - 1.05);
  }
  const double motor_mass = unit.motor().inertia * std::pow(turn / 0.02, 2);
  EXPECT_LT(deepest, std::sqrt((100 + motor_mass) / 2e6));  // all its energy at 1 m/s in the spring
  EXPECT_LT(unit.load().speed, 0);                          // thrown back
}

TEST(BacklashAxis, TheEncoderOnTheMotorSeesTheGapTheScaleDoesNot) {
  for (const double gap : {0.2e-3, 1e-3, 3e-3}) {
    BacklashAxisDefinition definition;
    definition.flanks.gap = gap;
    Coupled unit(definition, true);
    auto& volts = unit.plug<ReferencePort>("servo.reference").volts;
    // Epicycloidal ramps of 60 mm/s in 0.3 s: at most 0.4 m/s2, less than the friction's 1.5, so that the
    // load stays on its flank; a corner in the reference would let the motor swing back.
    const auto ramp = [](double p) { return p - std::sin(turn * p) / turn; };
    const auto stop_after = [&](double reference) {
      for (int i = 0; i < 3000; ++i) volts = reference * ramp(i / 3000.0), unit.step();
      for (int i = 0; i < 3000; ++i) volts = reference * ramp(1 - i / 3000.0), unit.step();
      volts = 0;
      unit.run(0.3);
      return unit.read("encoder.count") * 0.002 - unit.read("scale.count") * 0.001;
    };
    const double upward = stop_after(0.9);
    const double downward = stop_after(-0.9);
    // The flanks give way by 1.5 um under the friction; a count of the encoder is 2 um.
    EXPECT_NEAR(upward - downward, gap * 1000, std::max(0.01 * gap * 1000, 0.006));
    EXPECT_NEAR(unit.read("motor.position") - unit.read("position"), -gap * 500, 0.003);
  }
}

TEST(BacklashAxis, SwitchesSeeTheLoadAfterTheirDelay) {
  auto definition = frictionless_coupling();
  definition.flanks.gap = 0.1;  // the motor does not follow
  definition.axis.data.sensors.home.delay = 20e-3;
  definition.axis.data.sensors.limit_delay = 10e-3;
  for (const bool upward : {false, true}) {
    definition.axis.data.start = upward ? 1.0 : 0.04;
    Coupled unit(definition);
    unit.load().speed = upward ? 0.1 : -0.1;
    const auto& signal = unit.plug<SignalPort>(upward ? "limit_max" : "home");
    while (!signal.level && unit.steps < 10000) unit.step();
    // The upper limit at 1030 mm, the home switch's target up to 10 mm: 0.3 s on the way.
    EXPECT_NEAR(unit.steps * h, upward ? 0.31 : 0.32, 1.5 * h);
    EXPECT_EQ(unit.motor().speed, 0);
  }
}

TEST(BacklashAxis, TheTableSpeaksOfTheGapAndNotOfTheGear) {
  BacklashAxisDefinition definition;
  std::vector<std::string> names;
  for (const Parameter& p : definition.parameters()) names.push_back(p.name);
  EXPECT_THAT(names, ::testing::IsSupersetOf({"gap", "contact.stiffness", "contact.restitution", "mass",
                                              "gear.ratio", "inclination", "home.delay"}));
  for (const char* gone : {"gear.stiffness", "gear.damping", "gear.backlash", "carrier"})
    EXPECT_THAT(names, ::testing::Not(::testing::Contains(gone)));
}

TEST(BacklashAxis, WhatCannotBeBuiltIsRefused) {
  BacklashAxisDefinition definition;
  EXPECT_TRUE(definition.objections(1e-4).empty());
  definition.flanks.stiffness = 1e11;
  const auto objections = definition.objections(1e-4);
  ASSERT_EQ(objections.size(), 1U);
  EXPECT_EQ(objections[0].parameter, "contact.stiffness");
  EXPECT_THAT(objections[0].what, ::testing::HasSubstr("motor and carriage settle in 44.1 us"));
  EXPECT_EQ(objections[0].remedy, "scene.step of at most 5 us, or softer, less damped, heavier parts");
}

}  // namespace
}  // namespace drycut::plants
