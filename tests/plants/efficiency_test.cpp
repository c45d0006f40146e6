#include "plants/efficiency.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "plants/flying_saw.hpp"
#include "plants/linear_axis.hpp"
#include "plants/rotary_axis.hpp"
#include "plants/rotary_knife.hpp"
#include "plants/vertical_press.hpp"
#include "tests/plants/plants_lookup.hpp"

namespace drycut::plants {
namespace {

/// Mean of a motor's torque and of its acceleration over a stretch of an even ramp, once what the ramp's
/// begin shook up has died out.
struct Ramp {
  double torque = 0;        ///< [N m]
  double acceleration = 0;  ///< [rad/s2]

  /// From `from` to `to` volts of the reference within `seconds`.
  Ramp(Machine& machine, Shaft& rotor, double from, double to, double seconds) {
    const auto steps = static_cast<int>(seconds / h);
    const int settled = steps / 2;
    double before = 0;
    for (int i = 0; i < steps; ++i) {
      machine.reference(from + (to - from) * i / steps);
      machine.run(h);
      if (i == settled) before = rotor.speed;
      if (i > settled) torque += machine.read("motor.torque") / (steps - 1 - settled);
    }
    acceleration = (rotor.speed - before) / ((steps - 1 - settled) * h);
  }
};

/// What a motor that accelerates and brakes its load has to give, by M = J a / efficiency, to 0.1 %.
/// `own` turns before the losses, `load` behind them, both seen at the motor [kg m2].
void expect_torques(Machine& machine, Shaft& rotor, double own, double load, const Efficiency& through) {
  const Ramp up(machine, rotor, 0, 4, 1);
  EXPECT_NEAR(up.torque / ((own + load / through.driving) * up.acceleration), 1, 1e-3);
  const Ramp down(machine, rotor, 4, 0, 1);
  EXPECT_LT(down.acceleration, 0);
  EXPECT_NEAR(down.torque / ((own + load * through.driven) * down.acceleration), 1, 1e-3);
  // The other way round it is the same.
  const Ramp back(machine, rotor, 0, -2, 1);
  EXPECT_NEAR(back.torque / ((own + load / through.driving) * back.acceleration), 1, 1e-3);
}

TEST(Efficiency, OfGearAndScrewTakesTorqueWhereTheMotorDrivesAndSavesItWhereItBrakes) {
  LinearAxisDefinition axis;
  axis.data.mass = 200;
  axis.data.travel_min = -10;
  axis.data.travel_max = 10;
  axis.data.motor_friction = axis.data.guide_friction = {};
  axis.data.gear = {2, 1000, 0.5, 0};
  axis.data.gear.efficiency = {0.94, 0.92};
  axis.data.efficiency = {0.9, 0.8};
  Machine machine(axis);
  const double arm = 0.02 / turn / 2;  // of the carriage at the motor [m]
  expect_torques(machine, static_cast<LinearAxis&>(*machine.plant).rotor(),
                 axis.data.drive.servo.rotor_inertia + axis.data.screw_inertia / 4, 200 * arm * arm,
                 {0.94 * 0.9, 0.92 * 0.8});
}

TEST(Efficiency, OfTheKnifesGear) {
  RotaryKnifeDefinition knife;
  knife.data.coupling = 0;
  knife.data.motor_friction = knife.data.drum_friction = {};
  knife.data.gear.efficiency = {0.9, 0.85};
  WebDefinition web;
  web.data.shear_strength = 0;
  Machine machine(knife, &web);
  expect_torques(machine, static_cast<RotaryKnife&>(*machine.plant).rotor(),
                 knife.data.drive.servo.rotor_inertia, knife.data.drum_inertia / 25, {0.9, 0.85});
}

TEST(Efficiency, OfATablesGear) {
  RotaryAxisDefinition axis;
  axis.data.motor_friction = axis.data.friction = {};
  axis.data.gear.efficiency = {0.9, 0.85};
  Machine machine(axis);
  expect_torques(machine, static_cast<RotaryAxis&>(*machine.plant).rotor(),
                 axis.data.drive.servo.rotor_inertia, axis.data.inertia / 100, {0.9, 0.85});
}

TEST(Efficiency, OfARackUnderTheSaw) {
  FlyingSawDefinition saw;
  saw.data.travel_min = -50;
  saw.data.travel_max = 50;
  saw.data.motor_friction = saw.data.guide_friction = {};
  saw.data.efficiency = {0.9, 0.88};
  WebDefinition web;
  Machine machine(saw, &web);
  const auto& data = saw.data;
  const double arm = data.lead / turn / data.gear.ratio;
  expect_torques(machine, static_cast<FlyingSaw&>(*machine.plant).rotor(),
                 motor_inertia(data, data.drive.servo.rotor_inertia), data.mass * arm * arm, {0.9, 0.88});
}

// A trapezoidal screw holds what hangs on it without motor and brake, a ball screw lets it down.
TEST(Efficiency, OfAScrewThatLocksItselfHoldsItsLoad) {
  for (const bool locks : {true, false}) {
    LinearAxisDefinition axis;
    axis.data.inclination = pi / 2;
    axis.data.motor_friction = axis.data.guide_friction = {};
    axis.data.efficiency = locks ? Efficiency{0.35, 2 - 1 / 0.35} : Efficiency{0.9, 0.8};
    Machine machine(axis);
    machine.command("servo.enable", false);
    machine.run(0.2);
    if (locks)
      EXPECT_NEAR(machine.read("motor.speed"), 0, 1e-9);
    else
      EXPECT_LT(machine.read("motor.speed"), -100);
  }
}

// Seen through a screw that locks itself a gear takes more, not less.
TEST(Efficiency, InSeries) {
  const Efficiency two = in_series({0.9, 0.8}, {0.5, 0.25});
  EXPECT_DOUBLE_EQ(two.driving, 0.45);
  EXPECT_DOUBLE_EQ(two.driven, 0.2);
  EXPECT_DOUBLE_EQ(in_series({0.9, 0.8}, {0.4, -0.5}).driven, -0.5 / 0.9);
}

TEST(Efficiency, BackwardsNeedsTheFrictionThatThereIsForwards) {
  EXPECT_TRUE(efficiency_objections({0.9, 0.8}, "").empty());
  EXPECT_TRUE(efficiency_objections({0.35, -0.86}, "").empty());
  const auto found = efficiency_objections({0.35, 0.8}, "gear.");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].parameter, "gear.back_efficiency");
  EXPECT_THAT(found[0].remedy, testing::HasSubstr("-0.857"));
}

// What a sheet says forwards is enough.
TEST(Efficiency, BackwardsFollowsUnlessItIsGiven) {
  EXPECT_EQ(Efficiency().backwards(), 1);
  EXPECT_NEAR((Efficiency{.driving = 0.9}).backwards(), 2 - 1 / 0.9, 1e-12);
  EXPECT_NEAR((Efficiency{0.9, 0.8}).backwards(), 0.8, 1e-12);
  EXPECT_NEAR(in_series({.driving = 0.9}, {.driving = 0.35}).driven, (2 - 1 / 0.35) / 0.9, 1e-12);
  EXPECT_TRUE(efficiency_objections({.driving = 0.05}, "").empty());
}

// What a word stands for is in its table.
TEST(Efficiency, KindsStandForValuesOfTheTable) {
  LinearAxisDefinition axis;
  const auto rows = axis.parameters();
  for (const auto* kinds : {&gear_types(), &slide_types()})
    for (const Preset& kind : *kinds)
      for (const auto& value : kind.values)
        EXPECT_EQ(std::ranges::count(rows, value.parameter, &Parameter::name), 1) << value.parameter;
}

}  // namespace
}  // namespace drycut::plants
