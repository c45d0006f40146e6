#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "plants/backlash_axis.hpp"
#include "tests/plants/screw_prediction.hpp"

namespace drycut::plants {
namespace {

TEST(LinearAxisDrives, InverterAndContactorsMoveTheCarriageAtTheirSpeeds) {
  for (const char* kind : {"inverter", "contactors"})
    for (const int direction : {1, -1}) {
      LinearAxisDefinition definition;
      definition.data.drive.kind = kind;
      definition.data.start = 0.5;
      Machine unit(definition);
      unit.command(direction, true);
      unit.run(1);
      const double field = unit.read("drive.field_speed");
      EXPECT_NEAR(std::abs(field), kind == std::string("inverter") ? 150 : 375, 1e-9);
      const double expected = (field - unit.read("drive.slip")) / 60 * 20;
      EXPECT_NEAR(unit.read("speed"), expected, 0.01);
      EXPECT_GT(expected * direction, 0);
      // Friction is all there is to carry.
      const double friction =
          0.1 + 0.0005 * std::abs(expected) / 20 * turn + (30 + 50 * std::abs(expected) / 1000) * 0.02 / turn;
      EXPECT_NEAR(unit.read("motor.torque"), direction * friction, 1e-3);
    }
}

TEST(LinearAxisDrives, WithoutABrakeItCoastsUntilFrictionHasTakenItsEnergy) {
  LinearAxisDefinition definition;
  auto& d = definition.data;
  d.drive.kind = "contactors";
  d.motor_friction.viscous = d.guide_friction.viscous = 0;
  Machine unit(definition);
  unit.command(1, true);
  unit.run(1);
  unit.command(0, true);
  while (unit.read("drive.state") != 0) unit.run(h);
  const double v = unit.read("speed") / 1000;
  const double from = unit.read("position");
  unit.run(3);
  const double r = d.lead / turn;
  const double mass = ScrewPrediction(d, d.drive.motor.rotor_inertia).total();
  const double force = 30 + 0.1 / r;
  EXPECT_NEAR((unit.read("position") - from) / 1000 / (mass * v * v / 2 / force), 1, 0.01);
  EXPECT_NEAR(unit.read("speed"), 0, 1e-9);
}

TEST(LinearAxisDrives, ABrakeOnTheMotorShortensThat) {
  LinearAxisDefinition definition;
  auto& d = definition.data;
  d.drive.kind = "contactors";
  d.drive.brake.torque = 20;
  d.drive.brake.engage_delay = 0;
  d.motor_friction = d.guide_friction = {};
  Machine unit(definition);
  unit.command(1, true);
  unit.run(1);
  unit.command(0, true);
  while (unit.read("drive.state") != 0) unit.run(h);
  const double v = unit.read("motor.speed") / 60 * turn;
  const double from = unit.read("motor.position");
  unit.run(0.005);
  const double r = d.lead / turn;
  unit.run(3);
  const double inertia = d.drive.motor.rotor_inertia + d.screw_inertia + d.mass * r * r;
  // The last step before the test saw the drive open has been braked already; the play of the spring is
  // small.
  EXPECT_NEAR((unit.read("motor.position") - from) / 1000 / (inertia * v * v / 2 / 20 * r), 1, 0.01);
}

TEST(LinearAxisDrives, TheBacklashAxisKeepsItsGapUnderContactors) {
  BacklashAxisDefinition definition;
  definition.axis.data.drive.kind = "contactors";
  definition.axis.data.start = 0.5;
  ASSERT_TRUE(definition.objections(1e-4).empty());
  Machine unit(definition);
  const auto ahead_after = [&](int direction) {
    unit.command(direction, true);
    unit.run(1);
    return unit.read("gear.ahead");
  };
  // On its flank the load hangs back by half the gap and by the give of the flank under friction.
  const double forwards = ahead_after(1);
  const double backwards = ahead_after(-1);
  EXPECT_NEAR(forwards, 0.5 + 160.0 / 1e8 * 1000, 1e-3);
  EXPECT_NEAR(backwards, -forwards, 1e-6);
}

TEST(LinearAxisDrives, ATripIsAnEvent) {
  LinearAxisDefinition definition;
  definition.data.drive.kind = "inverter";
  Machine unit(definition);
  unit.command(1, false);
  unit.run(0.3);
  unit.fault("drive", "phase_lost", 1);
  unit.run(0.1);
  unit.only("trip");
  EXPECT_NEAR(value(unit.events[0], "speed"), 870, 50);  // the ramp after 0.3 s less filter and slip
}

TEST(LinearAxisDrives, TheReflectedInertiaIsOfTheMotorThatIsChosen) {
  for (const char* kind : {"servo", "inverter"}) {
    LinearAxisDefinition definition;
    definition.data.drive.kind = kind;
    definition.data.drive.motor.rotor_inertia = 0.02;
    World world;
    const auto plant = definition.build(world, nullptr);
    EXPECT_EQ(static_cast<LinearAxis&>(*plant).rotor().inertia,
              (kind == std::string("servo") ? 46.8e-4 : 0.02) + 3e-4);
  }
}

}  // namespace
}  // namespace drycut::plants
