#include "plants/vertical_press.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "tests/plants/vertical_press_unit.hpp"

namespace drycut::plants {
namespace {

TEST(VerticalPress, StandsOnItsBrakeFromTheFirstStep) {
  Press press;
  press.run(2);
  EXPECT_EQ(press.read("position"), 300);
  EXPECT_EQ(press.read("speed"), 0);
  EXPECT_EQ(press.read("brake.engaged"), 1);
  EXPECT_NEAR(press.read("screw.force"), 600 * gravity - 2000, 0.01);
  EXPECT_TRUE(press.events.empty());
}

// The screw gives way by 150 kg g / 100 N/um and swings; motor and brake hold.
TEST(VerticalPress, ARestingRamThatIsLoadedDoesNotSag) {
  Press press{VerticalPressDefinition()};
  press.run(1);
  const double before = press.read("position");
  press.set("load", 150);
  double fastest = 0;
  for (int i = 0; i < 1000; ++i) {
    press.step();
    fastest = std::min(fastest, press.read("speed"));
  }
  EXPECT_LT(fastest, -1.5) << "mm/s";
  EXPECT_NEAR(press.read("position") - before, -150 * gravity / 1e8 * 1000, 2e-3);
  EXPECT_TRUE(press.events.empty());
}

TEST(VerticalPress, GoesUpAndDownAtThePresetSpeeds) {
  for (const char* kind : {"inverter", "contactors"})
    for (const int direction : {1, -1})
      for (const bool slow : {false, true}) {
        VerticalPressDefinition definition;
        definition.data.drive.kind = kind;
        Press press(definition);
        press.command(direction, slow);
        press.run(1);
        const bool inverter = definition.data.drive.kind == "inverter";
        const double field = slow ? (inverter ? 150 : 375) : 1500;
        EXPECT_NEAR(press.read("drive.field_speed"), direction * field, 1e-9);
        const double slip = press.read("drive.slip");
        EXPECT_NEAR(press.read("speed"), (direction * field - slip) / 60 * 10, 0.05);
        // Going up the motor lifts, going down it is driven and brakes: slip in the same direction.
        EXPECT_GT(slip, 0) << kind << direction << slow;
        EXPECT_EQ(press.read("brake.engaged"), 0);
      }
}

TEST(VerticalPress, TheMotorFeelsTheLoadThroughTheEfficiencyOfTheScrew) {
  auto definition = frictionless_press();
  for (const double back : {0.8, 0.3, -0.5}) {
    definition.data.efficiency.driven = back;
    const double torque = (600 * gravity - 2000) * 0.01 / turn;  // at the screw without losses
    Press up(definition);
    up.command(1, true);
    up.run(1);
    EXPECT_NEAR(up.read("motor.torque"), torque / 0.9, 1e-3);
    Press down(definition);
    down.command(-1, true);
    down.run(1);
    EXPECT_NEAR(down.read("motor.torque"), torque * back, 1e-3);
  }
}

TEST(VerticalPress, WhatTheMotorGivesIsInTheRam) {
  auto definition = frictionless_press();
  definition.data.efficiency = {};
  definition.data.drive.brake.torque = 0;
  const double inertia = definition.data.drive.motor.rotor_inertia + definition.data.screw_inertia;
  for (const int direction : {1, -1}) {
    Press press(definition);
    press.command(direction, false);
    double work = 0;
    for (int i = 0; i < 8000; ++i) {
      const double before = press.rotor().speed;
      press.step();
      work += press.read("motor.torque") * (before + press.rotor().speed) / 2 * h;
    }
    const double energy = 600 * std::pow(press.ram().speed, 2) / 2 +
                          inertia * std::pow(press.rotor().speed, 2) / 2 +
                          (600 * gravity - 2000) * (press.ram().position - 0.3);
    EXPECT_NEAR(energy / work, 1, 5e-3) << direction;
  }
}

TEST(VerticalPress, ASelfLockingScrewHoldsWithoutABrake) {
  auto definition = frictionless_press();
  definition.data.drive.brake.torque = 0;
  definition.data.efficiency.driving = 0.4;
  definition.data.efficiency.driven = -0.5;
  Press locking(definition);
  locking.run(1);
  locking.set("load", 2000);
  locking.run(4);
  // Only the screw gives way: 2000 kg more on its 250 N m/rad.
  const double give = 2000 * gravity * std::pow(0.01 / turn, 2) / 250 * 1000;
  EXPECT_NEAR(locking.read("position"), 300 - give, 1e-3);
  EXPECT_EQ(locking.rotor().speed, 0);
  definition.data.efficiency.driven = 0.05;
  Press sinking(definition);
  sinking.run(1);
  EXPECT_LT(sinking.read("position"), 295);
}

TEST(VerticalPress, ADriveThatWorksAgainstItsBrakeIsTold) {
  for (const char* kind : {"inverter", "contactors"})
    for (const double held : {0.0, 0.15, 0.25}) {
      VerticalPressDefinition definition;
      definition.data.drive.kind = kind;
      definition.data.drive.brake.torque = 100;
      Press press(definition);
      press.command("brake.release", false);
      press.command(1, false);
      press.run(held);
      press.command("brake.release", true);
      press.run(1);
      const auto told =
          std::count_if(press.events.begin(), press.events.end(),
                        [](const MachineEvent& event) { return event.name == "against_brake"; });
      EXPECT_EQ(told, held > 0.2 ? 1 : 0) << kind << held;
    }
}

TEST(VerticalPress, WithoutABrakeItSagsAsItsWeightSays) {
  VerticalPressDefinition definition;
  auto& d = definition.data;
  d.motor_friction.viscous = d.guide_friction.viscous = 0;
  for (const double back : {1.0, 0.8}) {
    d.efficiency.driven = back;
    Press press(definition);
    press.run(0.1);
    press.fault("brake", "stuck_open", 1);
    const double seconds = 0.4;
    press.run(seconds);
    // One mass, falling: weight less counterbalance and guides on the ram; what arrives at the motor is
    // `back` of the screw's force; dry friction there.
    const double r = 0.01 / turn;
    const double j = d.drive.motor.rotor_inertia + d.screw_inertia;
    const double net = 600 * gravity - 2000 - 150;
    const double a = (back * net * r - 0.2) / (j / r + back * 600 * r);
    EXPECT_NEAR(press.read("speed") / (-1000 * a * seconds), 1, 0.01);
    EXPECT_NEAR((press.read("position") - 300) / (-500 * a * seconds * seconds), 1, 0.01);
    press.run(0.2);
    press.only("sag");
    EXPECT_NEAR(press.times[0], 0.5, 1.5 * h);  // it was told to hold from the start
    EXPECT_NEAR(value(press.events[0], "speed") / (-1000 * a * 0.4), 1, 0.01);
    press.run(6);  // into the lower stop and to rest
    EXPECT_EQ(press.events[1].name, "end_stop");
    EXPECT_EQ(value(press.events[1], "side"), -1);
    EXPECT_NEAR(press.read("position"), -10, 1);
    EXPECT_NEAR(press.read("speed"), 0, 1e-3);
  }
}

TEST(VerticalPress, AWornBrakeSlipsAboveItsTorque) {
  auto definition = frictionless_press();
  definition.data.efficiency = {};
  const double needed = (600 * gravity - 2000) * 0.01 / turn;
  for (const double share : {1.001, 0.999}) {
    Press press(definition);
    press.fault("brake", "worn", 1 - share * needed / 25);
    press.run(1);
    if (share > 1)
      EXPECT_EQ(press.read("position"), 300);
    else
      EXPECT_LT(press.read("position"), 299.9);
  }
}

TEST(VerticalPress, PressesWithTheTorqueLimitOfTheInverter) {
  VerticalPressDefinition definition;
  auto& d = definition.data;
  d.workpiece = {5e6, 5e3};
  d.start = 0.08;
  Press press(definition);
  press.command(-1, true);
  press.run(4);
  // At standstill friction may help or hinder.
  const double r = 0.01 / turn;
  const double ram = 600 * gravity - 2000;
  EXPECT_LE(press.read("press.force"), ram + 22 / r / 0.9 + 300);
  EXPECT_GE(press.read("press.force"), ram + (22 - 0.2) * 0.9 / r - 300);
  EXPECT_NEAR(press.read("motor.torque"), -22, 1e-6);
  EXPECT_NEAR(press.read("position"), 50 - press.read("press.force") / 5e6 * 1000, 1e-3);
  ASSERT_EQ(press.events.size(), 2U);
  EXPECT_EQ(press.events[0].name, "pressed");
  EXPECT_EQ(press.events[1].name, "pulled_out") << "it was told to go on";
  EXPECT_GT(value(press.events[0], "force"), 5000);
  EXPECT_NEAR(value(press.events[0], "speed"), 29, 1);  // 150 rpm and the slip of a motor that is driven
}

TEST(VerticalPress, TheWorkpieceStopsAFreeRamWithItsMomentum) {
  auto definition = frictionless_press();
  auto& d = definition.data;
  d.counterbalance = 600 * gravity;
  d.gear.stiffness = 1e-9;  // the motor holds nothing
  d.gear.damping = 0;
  d.workpiece = {5e6, 0};
  d.start = 0.06;
  Press press(definition);
  press.ram().speed = -0.2;
  while (press.events.empty() && press.steps < 20000) press.step(1e-5);
  ASSERT_EQ(press.events.size(), 1U);
  EXPECT_NEAR(value(press.events[0], "impulse"), 600 * 0.2, 0.01);
  EXPECT_NEAR(value(press.events[0], "force") / (0.2 * std::sqrt(5e6 * 600)), 1, 2e-3);
}

TEST(VerticalPress, TheLoadChangesMassAndWeight) {
  auto definition = frictionless_press();
  auto& d = definition.data;
  d.gear.stiffness = 1e-9;  // the motor holds nothing, the counterbalance all
  d.gear.damping = 0;
  d.counterbalance = 600 * gravity;
  Press press(definition);
  press.set("load", 400);
  EXPECT_EQ(press.read("mass"), 1000);
  press.run(0.05);
  const double speed = press.ram().speed;
  EXPECT_NEAR(speed, -400 * gravity / 1000 * 0.05, 1e-6);
  press.set("force", 400 * gravity);
  press.run(0.05);
  EXPECT_NEAR(press.ram().speed, speed, 1e-6);
  press.set("load", 0);
  EXPECT_EQ(press.read("mass"), 600);
  press.run(0.05);
  EXPECT_NEAR(press.ram().speed - speed, 400 * gravity / 600 * 0.05, 1e-6);
}

TEST(VerticalPress, EncoderScaleAndSwitchesFollowTheRam) {
  Press press;
  press.command(1, false);
  press.run(1.2);
  press.command(0, false);
  press.run(1);
  const double travel = press.read("position") - 300;
  EXPECT_GT(travel, 150);
  EXPECT_NEAR(press.read("scale.count"), travel / 0.005, 1);
  EXPECT_NEAR(press.read("encoder.count"), travel * 1000, 50);  // the screw gives by 0.04 mm
  EXPECT_EQ(press.read("home"), press.read("position") <= 520.5 ? 1 : 0);
  press.fault("encoder", "stuck", 1);
  const double count = press.read("encoder.count");
  press.command(-1, false);
  press.run(3);
  EXPECT_EQ(press.read("encoder.count"), count);
  EXPECT_EQ(press.read("limit_min"), 1);
  EXPECT_EQ(press.events.front().name, "end_stop");
}

TEST(VerticalPress, BothContactorsTripAndTheBrakeStopsTheRam) {
  VerticalPressDefinition definition;
  definition.data.drive.kind = "contactors";
  Press press(definition);
  press.command(1, true);
  press.run(0.5);
  press.fault("drive.backward", "stuck_on", 1);
  press.run(1);
  press.only("trip");
  EXPECT_NEAR(value(press.events[0], "speed"), press.read("motor.speed") + 330, 30);
  EXPECT_EQ(press.read("drive.state"), 3);
  EXPECT_NEAR(press.read("speed"), 0, 1e-9);
}

// Whatever fails and when: nothing diverges, the ram stays between its stops, and once the commands are gone
// it rests, runs on by a contact that is stuck, or has been reported.
TEST(VerticalPress, EveryFaultEndsInADefinedState) {
  struct Combination {
    int direction;
    bool slow;
  };
  for (const char* kind : {"inverter", "contactors"}) {
    VerticalPressDefinition definition;
    definition.data.drive.kind = kind;
    const Press listed(definition);
    for (const Fault& listed_fault : listed.plant->faults())
      for (const Combination& command : {Combination{1, false}, {-1, false}, {0, false}}) {
        Press press(definition);
        press.command(command.direction, command.slow);
        press.run(0.4);
        const double value = listed_fault.unit.empty() ? 1 : 2;  // 2 N m of torque limit
        press.fault(listed_fault.component, listed_fault.name, value);
        press.run(0.3);
        press.command(0, false);
        press.run(1.3);
        const std::string what = fmt::format("{}: {}.{} at {} {}", kind, listed_fault.component,
                                             listed_fault.name, command.direction, command.slow);
        const double position = press.read("position");
        EXPECT_GT(position, -30) << what;
        EXPECT_LT(position, 630) << what;
        const bool driven = press.read("drive.state") == 1;
        EXPECT_EQ(driven,
                  (listed_fault.component == "drive.forward" || listed_fault.component == "drive.backward") &&
                      listed_fault.name == "stuck_on" && press.read("drive.state") != 3)
            << what;
        const bool reported = !press.events.empty();
        if (std::abs(press.read("speed")) > 1) {
          EXPECT_TRUE(driven || reported) << what;
        }
      }
  }
}

TEST(VerticalPress, PartsOfTheRamGoWithItAndTheOthersStand) {
  VerticalPressDefinition definition;
  definition.data.workpiece.stiffness = 1e6;
  definition.data.load = 100;
  Press press(definition);
  const std::set<std::string> moving = {"ram", "tool", "screw"};
  const std::set<std::string> standing = {"crown", "motor"};
  for (const Part& part : press.plant->parts()) {
    const double before = part.now().pose.position[1];
    press.ram().position += 0.2;
    const PartPose after = part.now();
    press.ram().position -= 0.2;
    if (moving.contains(part.name) || standing.contains(part.name)) {
      EXPECT_NEAR(after.pose.position[1] - before, moving.contains(part.name) ? 0.2 : 0, 1e-12) << part.name;
    }
    EXPECT_EQ(after.visible, part.name != "lamp released") << part.name;  // it stands on its brake
  }
}

TEST(VerticalPress, ShowsTheQuotaAcrossTheRamAndHowFarItIs) {
  Press press;
  press.ram().position = 0.3;
  const auto far = press.plant->quota_line(0.31);
  ASSERT_TRUE(far);
  EXPECT_NEAR(far->miss, -0.01, 1e-12) << "it stands below";
  EXPECT_LT(far->left[0], far->right[0]);
  const double tool = pose_of(*press.plant, "tool").pose.position[1];
  press.ram().position = 0.31;
  const auto there = press.plant->quota_line(0.31);
  EXPECT_EQ(there->miss, 0);
  EXPECT_EQ(there->left, far->left) << "the line stands, whatever the ram does";
  EXPECT_NEAR(pose_of(*press.plant, "tool").pose.position[1] - tool, 0.01, 1e-12);
  EXPECT_NEAR(pose_of(*press.plant, "tool").pose.position[1] - there->left[1], 0.06, 1e-12)
      << "at the face of the tool, which is 120 mm high";
  EXPECT_EQ(there->left[1], there->right[1]) << "level";
}

TEST(VerticalPress, TheLampIsRedWhileTheBrakeHoldsAndGreenOnceItHasLetGo) {
  Press press;
  EXPECT_TRUE(pose_of(*press.plant, "lamp brake").visible);
  EXPECT_FALSE(pose_of(*press.plant, "lamp released").visible);
  press.command("brake.release", true);
  press.command(1, true);  // the drive releases it where it moves
  press.run(0.2);
  EXPECT_FALSE(pose_of(*press.plant, "lamp brake").visible);
  EXPECT_TRUE(pose_of(*press.plant, "lamp released").visible);
}

TEST(VerticalPress, WhatCannotBeBuiltIsRefused) {
  expect_refusals<VerticalPressDefinition>({
      {[](auto& d) { d.gear.stiffness = 1e6; }, {"gear.stiffness: motor and ram oscillate at"}},
      {[](auto& d) { d.stop.damping = 1e8; },
       {"stop.damping: ram and end stop settle in 6 us, steps of 100 us"}},
      {[](auto& d) { d.workpiece.stiffness = 1e12; },
       {"workpiece.stiffness: ram and workpiece oscillate at 6497 Hz"}},
      {[](auto& d) { d.motor_friction.viscous = 99; },
       {"motor_friction.viscous: motor and its friction settle in"}},
      {[](auto& d) { d.guide_friction.viscous = 9e7; }, {"ram_friction.viscous: "}},
      {[](auto& d) { d.travel_max = -1; }, {"travel_max: it is not above travel_min"}},
      {[](auto& d) { d.start = 2; }, {"start: the ram starts at 2000 mm, in an end stop"}},
      {[](auto& d) { d.sensors.limit_max = -1; }, {"limit_max: it is not above limit_min"}},
      {[](auto& d) {
         d.workpiece = {1e6, 0}, d.start = 0.02;
       },
       {"workpiece.height: the ram starts in the workpiece"}},
      {[](auto& d) { d.drive.inverter.fast = 60; }, {"inverter.fast: 60 Hz"}},
  });
}

TEST(World, ASlideOfAnotherWorldHasNoMassToSet) {
  World world;
  Slide stranger;
  EXPECT_THAT([&] { world.set_mass(stranger, 1); }, ::testing::Throws<std::invalid_argument>());
}

}  // namespace
}  // namespace drycut::plants
