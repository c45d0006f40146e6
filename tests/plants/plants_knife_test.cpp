#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "plants/rotary_knife.hpp"
#include "tests/plants/plants_lookup.hpp"

namespace drycut::plants {
namespace {

/// The default line: web and knife, built from their definitions.
struct KnifeLine : Machine {
  explicit KnifeLine(RotaryKnifeDefinition knife = {}, WebDefinition web = {}, std::uint64_t seed = 1)
      : Machine(knife, &web, seed) {}
  RotaryKnife& knife() { return static_cast<RotaryKnife&>(*plant); }
  Shaft& drum() { return knife().drum(); }
  Shaft& rotor() { return knife().rotor(); }
};

TEST(RotaryKnife, CutsTheCircumferenceAtWebSpeed) {
  KnifeLine line;
  line.reference(2.5);  // 500 rpm, drum 100 rpm: 60 m/min
  line.run(6);
  ASSERT_GE(line.events.size(), 9U);
  for (std::size_t i = 0; i < line.events.size(); ++i) {
    const MachineEvent& cut = line.events[i];
    EXPECT_EQ(cut.name, "cut");
    EXPECT_EQ(value(cut, "number"), static_cast<double>(i + 1));
    if (i < 2) continue;  // the run-up
    EXPECT_NEAR(value(cut, "length"), 600, 1e-5);
    EXPECT_NEAR(value(cut, "mismatch"), 1000 * 1e-3 / line.knife().radius(), 1);
    EXPECT_NEAR(value(cut, "force"), 1500, 2);
  }
  EXPECT_EQ(line.read("cut.number"), static_cast<double>(line.events.size()));
  EXPECT_NEAR(line.read("cut.length"), 600, 1e-5);
  EXPECT_NEAR(line.read("blade.speed"), 60, 1e-2);
  EXPECT_NEAR(line.read("blade.ratio"), 1, 1e-3);
}

TEST(RotaryKnife, LengthIsWebTravelBetweenTheCutsToTheNanometre) {
  // The web runs at constant speed; nothing pulls at it (no coupling, no resistance), so length = v (t2 -
  // t1).
  RotaryKnifeDefinition knife;
  knife.data.coupling = 0;
  WebDefinition web;
  web.data.shear_strength = 0;
  web.data.drive.speed = 0.7;
  KnifeLine line(knife, web);
  line.reference(1.75 * 1.013);
  line.run(4);
  ASSERT_GE(line.events.size(), 4U);
  EXPECT_NEAR(value(line.events[0], "length"), 700 * line.times[0], 1e-6);
  for (std::size_t i = 1; i < line.events.size(); ++i)
    EXPECT_NEAR(value(line.events[i], "length"), 700 * (line.times[i] - line.times[i - 1]), 1e-6);
}

TEST(RotaryKnife, CuttingWorkSlowsTheFreeDrumByItsEnergy) {
  RotaryKnifeDefinition definition;
  definition.data.coupling = 0;
  definition.data.motor_friction = {};
  definition.data.drum_friction = {};
  KnifeLine line(definition);
  line.command("servo.enable", false);
  line.drum().speed = 10.4;
  line.rotor().speed = 10.4 * definition.data.gear.ratio;
  const auto energy = [&] {
    const Shaft& d = line.drum();
    const Shaft& m = line.rotor();
    return 0.5 * d.inertia * d.speed * d.speed + 0.5 * m.inertia * m.speed * m.speed;
  };
  const double before = energy();
  line.run(0.6);
  ASSERT_EQ(line.events.size(), 1U);
  EXPECT_NEAR(before - energy(), 2.0 / 3 * 1500 * 1e-3, 0.02);
}

TEST(RotaryKnife, StandingBladeStopsAtTheMaterialWithTooLittleTorque) {
  RotaryKnifeDefinition definition;
  definition.data.coupling = 0;
  definition.data.initial_angle = -0.1;  // in the web
  definition.data.drive.servo.peak_torque = 1;
  definition.data.drive.servo.rated_torque = 0.5;
  WebDefinition web;
  web.data.shear_strength = 50e6;
  KnifeLine line(definition, web);
  line.reference(1);
  line.run(1);
  EXPECT_TRUE(line.events.empty() || line.events[0].name == "buckle");
  EXPECT_EQ(line.read("cut.number"), 0);
  EXPECT_NEAR(line.read("speed"), 0, 1e-6);
  EXPECT_NEAR(line.read("angle.total"), -0.1 * 180 / std::numbers::pi, 1);
}

TEST(RotaryKnife, FastDrumTearsAndSlowDrumBuckles) {
  for (const double factor : {1.3, 0.7}) {
    KnifeLine line;
    line.reference(2.5 * factor);
    line.run(2.5);
    int cuts = 0;
    int faults = 0;
    for (const MachineEvent& event : line.events) {
      cuts += event.name == "cut" ? 1 : 0;
      faults += event.name == (factor > 1 ? "tear" : "buckle") ? 1 : 0;
      if (event.name != "cut") {
        EXPECT_GT(value(event, "mismatch"), 100);
      }
    }
    EXPECT_GE(cuts, 2);
    EXPECT_EQ(faults, cuts);
    EXPECT_EQ(faults + cuts, static_cast<int>(line.events.size()));
  }
}

TEST(RotaryKnife, TwoBladesHalveThePiece) {
  RotaryKnifeDefinition definition;
  definition.data.blade_count = 2;
  definition.data.initial_angle = std::numbers::pi / 2;
  KnifeLine line(definition);
  line.reference(2.5);
  line.run(3);
  ASSERT_GE(line.events.size(), 8U);
  EXPECT_NEAR(value(line.events.back(), "length"), 300, 0.05);
}

TEST(RotaryKnife, EncoderCountsTheMotorAndItsIndexComesFiveTimesADrumTurn) {
  KnifeLine line;
  line.reference(2.5);
  const EncoderPort& encoder = line.plug<EncoderPort>("encoder");
  const SignalPort& index = line.plug<SignalPort>("encoder.index");
  int pulses = 0;
  for (int i = 0; i < 20000; ++i) {
    line.run(h);
    if (index.edges.empty()) continue;
    ++pulses;
    // The drum starts at half a turn, the motor at 2.5 turns.
    EXPECT_EQ((encoder.count_at(index.edges[0].fraction) - 4096) % 8192, 0);
  }
  EXPECT_EQ(encoder.count,
            static_cast<std::int64_t>(std::floor((line.rotor().revolutions() - 2.5) * 8192 + 0.5)));
  EXPECT_EQ(pulses, static_cast<int>(std::floor(line.rotor().revolutions())) - 2);
  EXPECT_GT(pulses, 10);
}

TEST(RotaryKnife, EncoderMayBeOnTheDrum) {
  RotaryKnifeDefinition definition;
  definition.data.sensors.encoder_on_load = true;
  KnifeLine line(definition);
  line.reference(2.5);
  line.run(2);
  EXPECT_EQ(line.plug<EncoderPort>("encoder").count,
            static_cast<std::int64_t>(std::floor((line.drum().revolutions() - 0.5) * 8192 + 0.5)));
}

TEST(RotaryKnife, HomeSwitchIsOnAroundItsAngle) {
  KnifeLine line;
  EXPECT_EQ(line.read("home"), 1);  // starts at 180 deg, on the target
  line.reference(1);
  const SignalPort& home = line.plug<SignalPort>("home");
  int rising = 0;
  for (int i = 0; i < 40000; ++i) {
    line.run(h);
    const double angle = line.read("angle");
    if (std::abs(angle - 180) > 7) {
      EXPECT_FALSE(home.level) << angle;
    } else if (std::abs(angle - 180) < 4.5) {
      EXPECT_TRUE(home.level) << angle;
    }
    if (!home.edges.empty() && home.edges[0].rising) ++rising;
  }
  EXPECT_EQ(rising, 2);
}

TEST(RotaryKnife, FaultsActAtTheirComponents) {
  KnifeLine line;
  line.fault("servo", "offset", 0.5);
  line.run(1);
  EXPECT_NEAR(line.read("motor.speed"), 100, 1);
  line.fault("encoder", "stuck", 1);
  const std::int64_t held = line.plug<EncoderPort>("encoder").count;
  line.run(0.1);
  EXPECT_EQ(line.plug<EncoderPort>("encoder").count, held);
  line.fault("servo", "disabled", 1);
  line.run(3);
  EXPECT_NEAR(line.read("motor.speed"), 0, 1e-9);
}

TEST(RotaryKnife, RunsAreEqualToTheBit) {
  const auto run = [](std::uint64_t seed) {
    KnifeLine line({}, {}, seed);
    line.fault("servo", "noise", 0.05);
    line.reference(2.5);
    line.run(3);
    std::vector<double> values;
    for (const Channel& c : line.plant->channels()) values.push_back(c.read());
    for (const Channel& c : line.supply->channels()) values.push_back(c.read());
    for (const MachineEvent& e : line.events)
      for (const MachineEvent::Value& v : e.values) values.push_back(v.number);
    return values;
  };
  EXPECT_EQ(run(1), run(1));
  EXPECT_NE(run(1), run(2));
}

TEST(RotaryKnife, PartsHavePosesAndTheBladeIsAtTheAnvilAtAngleZero) {
  RotaryKnifeDefinition definition;
  definition.data.initial_angle = 0;
  definition.data.blade_count = 2;
  KnifeLine line(definition);
  for (const Part& part : line.plant->parts()) {
    const PartPose pose = part.now();
    double norm = 0;
    for (const double q : pose.pose.rotation) norm += q * q;
    EXPECT_NEAR(norm, 1, 1e-12) << part.name;
  }
  const double half_blade = 0.03 / 2;
  EXPECT_NEAR(pose_of(*line.plant, "blade 1").pose.position[1] - half_blade, 0, 1e-12);
  EXPECT_NEAR(pose_of(*line.plant, "blade 2").pose.position[1] + half_blade, 2 * line.knife().radius(),
              1e-12);
}

TEST(RotaryKnife, RefusesAWebThatItCannotCut) {
  const auto message = [](RotaryKnifeDefinition knife, WebDefinition web) -> std::string {
    try {
      KnifeLine line(knife, web);
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
    return "";
  };
  RotaryKnifeDefinition knife;
  WebDefinition web;
  web.data.thickness = 0.1;
  EXPECT_THAT(message(knife, web), testing::HasSubstr("thicker than the radius of 95.4"));
  web.data.thickness = 0.02;
  knife.data.blade_count = 12;
  EXPECT_THAT(message(knife, web), testing::HasSubstr("with 12 blades two are in the web of 20 mm at once"));
  World world;
  EXPECT_THROW(knife.build(world, [](std::string_view) -> Plant* { return nullptr; }), std::invalid_argument);
}

TEST(RotaryKnife, ObjectsToParametersThatDoNotGoTogether) {
  expect_refusals<RotaryKnifeDefinition>({
      {[](auto& d) { d.drum_inertia = 1e-5; }, {"gear.damping: ", "drum_friction.viscous: "}},
      {[](auto& d) { d.drum_friction.viscous = 5000; }, {"drum_friction.viscous: "}},
      {[](auto& d) { d.motor_friction.viscous = 90; }, {"motor_friction.viscous: "}},
      {[](auto& d) { d.drive.servo.max_speed = 100; }, {"servo.max_speed: "}},
      {[](auto& d) { d.drive.servo.rated_torque = 30; }, {"servo.peak_torque: "}},
      {[](auto& d) { d.drive.servo.torque_at_max_speed = 30; }, {"servo.torque_at_max_speed: "}},
      {[](auto& d) { d.sensors.home.width = 6.28; }, {"home.width: "}},
  });
}

}  // namespace
}  // namespace drycut::plants
