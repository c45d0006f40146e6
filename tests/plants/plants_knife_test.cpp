#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "plants/rotary_knife.hpp"
#include "tests/plants/plants_lookup.hpp"

namespace drycut::plants {
namespace {

/// The default line: web and knife, built from their definitions.
struct KnifeLine {
  World world;
  std::unique_ptr<Plant> web;
  std::unique_ptr<Plant> knife;
  std::vector<Event> events;
  std::vector<double> times;
  std::int64_t steps = 0;
  explicit KnifeLine(RotaryKnifeDefinition knife_definition = {}, WebDefinition web_definition = {},
                     std::uint64_t seed = 1)
      : world(seed), web(web_definition.build(world, nullptr)) {
    knife = knife_definition.build(world, [this](std::string_view) { return web.get(); });
  }
  RotaryKnife& drum() { return static_cast<RotaryKnife&>(*knife); }
  ReferencePort& reference() { return plug<ReferencePort>(*knife, "servo.reference"); }
  void run(double seconds) {
    for (int i = 0; i < std::lround(seconds / h); ++i) {
      web->drive(h);
      knife->drive(h);
      world.step(h);
      web->sense(h);
      knife->sense(h);
      for (Event& event : knife->take_events()) {
        times.push_back((static_cast<double>(steps) + event.fraction) * h);
        events.push_back(std::move(event));
      }
      ++steps;
    }
    ASSERT_EQ(world.failure(), "");
  }
};

TEST(RotaryKnife, CutsTheCircumferenceAtWebSpeed) {
  KnifeLine line;
  line.reference().volts = 2.5;  // 500 rpm, drum 100 rpm: 60 m/min
  line.run(6);
  ASSERT_GE(line.events.size(), 9U);
  for (std::size_t i = 0; i < line.events.size(); ++i) {
    const Event& cut = line.events[i];
    EXPECT_EQ(cut.name, "cut");
    EXPECT_EQ(value(cut, "number"), static_cast<double>(i + 1));
    if (i < 2) continue;  // the run-up
    EXPECT_NEAR(value(cut, "length"), 600, 1e-5);
    EXPECT_NEAR(value(cut, "mismatch"), 1000 * 1e-3 / line.drum().radius(), 1);
    EXPECT_NEAR(value(cut, "force"), 1500, 2);
  }
  EXPECT_EQ(channel(*line.knife, "cut.number"), static_cast<double>(line.events.size()));
  EXPECT_NEAR(channel(*line.knife, "cut.length"), 600, 1e-5);
  EXPECT_NEAR(channel(*line.knife, "blade.speed"), 60, 1e-2);
  EXPECT_NEAR(channel(*line.knife, "blade.ratio"), 1, 1e-3);
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
  line.reference().volts = 1.75 * 1.013;
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
  plug<CommandPort>(*line.knife, "servo.enable").level = false;
  line.drum().drum().speed = 10.4;
  line.drum().rotor().speed = 10.4 * definition.data.gear.ratio;
  const auto energy = [&] {
    const Shaft& d = line.drum().drum();
    const Shaft& m = line.drum().rotor();
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
  line.reference().volts = 1;
  line.run(1);
  EXPECT_TRUE(line.events.empty() || line.events[0].name == "buckle");
  EXPECT_EQ(channel(*line.knife, "cut.number"), 0);
  EXPECT_NEAR(channel(*line.knife, "speed"), 0, 1e-6);
  EXPECT_NEAR(channel(*line.knife, "angle.total"), -0.1 * 180 / std::numbers::pi, 1);
}

TEST(RotaryKnife, FastDrumTearsAndSlowDrumBuckles) {
  for (const double factor : {1.3, 0.7}) {
    KnifeLine line;
    line.reference().volts = 2.5 * factor;
    line.run(2.5);
    int cuts = 0;
    int faults = 0;
    for (const Event& event : line.events) {
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
  line.reference().volts = 2.5;
  line.run(3);
  ASSERT_GE(line.events.size(), 8U);
  EXPECT_NEAR(value(line.events.back(), "length"), 300, 0.05);
}

TEST(RotaryKnife, EncoderCountsTheMotorAndItsIndexComesFiveTimesADrumTurn) {
  KnifeLine line;
  line.reference().volts = 2.5;
  const EncoderPort& encoder = plug<EncoderPort>(*line.knife, "encoder");
  const SignalPort& index = plug<SignalPort>(*line.knife, "encoder.index");
  int pulses = 0;
  for (int i = 0; i < 20000; ++i) {
    line.run(h);
    if (index.edges.empty()) continue;
    ++pulses;
    // The drum starts at half a turn, the motor at 2.5 turns.
    EXPECT_EQ((encoder.count_at(index.edges[0].fraction) - 4096) % 8192, 0);
  }
  EXPECT_EQ(encoder.count,
            static_cast<std::int64_t>(std::floor((line.drum().rotor().revolutions() - 2.5) * 8192 + 0.5)));
  EXPECT_EQ(pulses, static_cast<int>(std::floor(line.drum().rotor().revolutions())) - 2);
  EXPECT_GT(pulses, 10);
}

TEST(RotaryKnife, EncoderMayBeOnTheDrum) {
  RotaryKnifeDefinition definition;
  definition.data.encoder_on_drum = true;
  KnifeLine line(definition);
  line.reference().volts = 2.5;
  line.run(2);
  EXPECT_EQ(plug<EncoderPort>(*line.knife, "encoder").count,
            static_cast<std::int64_t>(std::floor((line.drum().drum().revolutions() - 0.5) * 8192 + 0.5)));
}

TEST(RotaryKnife, HomeSwitchIsOnAroundItsAngle) {
  KnifeLine line;
  EXPECT_EQ(channel(*line.knife, "home"), 1);  // starts at 180 deg, on the target
  line.reference().volts = 1;
  const SignalPort& home = plug<SignalPort>(*line.knife, "home");
  int rising = 0;
  for (int i = 0; i < 40000; ++i) {
    line.run(h);
    const double angle = channel(*line.knife, "angle");
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
  fault(line.knife->faults(), "servo", "offset", 0.5);
  line.run(1);
  EXPECT_NEAR(channel(*line.knife, "motor.speed"), 100, 1);
  fault(line.knife->faults(), "encoder", "stuck", 1);
  const std::int64_t held = plug<EncoderPort>(*line.knife, "encoder").count;
  line.run(0.1);
  EXPECT_EQ(plug<EncoderPort>(*line.knife, "encoder").count, held);
  fault(line.knife->faults(), "servo", "disabled", 1);
  line.run(3);
  EXPECT_NEAR(channel(*line.knife, "motor.speed"), 0, 1e-9);
}

TEST(RotaryKnife, RunsAreEqualToTheBit) {
  const auto run = [](std::uint64_t seed) {
    KnifeLine line({}, {}, seed);
    fault(line.knife->faults(), "servo", "noise", 0.05);
    line.reference().volts = 2.5;
    line.run(3);
    std::vector<double> values;
    for (const Channel& c : line.knife->channels()) values.push_back(c.read());
    for (const Channel& c : line.web->channels()) values.push_back(c.read());
    for (const Event& e : line.events)
      for (const Event::Value& v : e.values) values.push_back(v.number);
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
  const std::vector<Part> parts = line.knife->parts();
  std::vector<PartPose> poses;
  line.knife->poses(poses);
  ASSERT_EQ(poses.size(), parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Pose& pose = poses[i].pose;
    double norm = 0;
    for (const double q : pose.rotation) norm += q * q;
    EXPECT_NEAR(norm, 1, 1e-12) << parts[i].name;
    if (parts[i].name == "blade 1") {
      EXPECT_NEAR(pose.position[1] - parts[i].size[1] / 2, 0, 1e-12);
    }
    if (parts[i].name == "blade 2") {
      EXPECT_NEAR(pose.position[1] + parts[i].size[1] / 2, 2 * line.drum().radius(), 1e-12);
    }
  }
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
  const auto objections = [](auto change) {
    RotaryKnifeDefinition d;
    change(d.data);
    std::vector<std::string> names;
    for (const auto& o : d.objections(1e-4)) {
      names.push_back(o.parameter);
      EXPECT_FALSE(o.what.empty());
      EXPECT_FALSE(o.remedy.empty());
    }
    return names;
  };
  using testing::ElementsAre;
  EXPECT_THAT(objections([](RotaryKnifeData&) {}), ElementsAre());
  EXPECT_THAT(objections([](RotaryKnifeData& d) { d.drum_inertia = 1e-5; }),
              ElementsAre("gear.damping", "drum_friction.viscous"));
  EXPECT_THAT(objections([](RotaryKnifeData& d) { d.drum_friction.viscous = 5000; }),
              ElementsAre("drum_friction.viscous"));
  EXPECT_THAT(objections([](RotaryKnifeData& d) { d.motor_friction.viscous = 90; }),
              ElementsAre("motor_friction.viscous"));
  EXPECT_THAT(objections([](RotaryKnifeData& d) { d.drive.servo.max_speed = 100; }),
              ElementsAre("servo.max_speed"));
  EXPECT_THAT(objections([](RotaryKnifeData& d) { d.drive.servo.rated_torque = 30; }),
              ElementsAre("servo.peak_torque"));
  EXPECT_THAT(objections([](RotaryKnifeData& d) { d.drive.servo.torque_at_max_speed = 30; }),
              ElementsAre("servo.torque_at_max_speed"));
  EXPECT_THAT(objections([](RotaryKnifeData& d) { d.home.width = 6.28; }), ElementsAre("home.width"));
}

}  // namespace
}  // namespace drycut::plants
