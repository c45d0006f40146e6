// A counter drum geared to the knife drum, and a motor on each.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "plants/pose_math.hpp"
#include "plants/rotary_knife.hpp"
#include "tests/plants/plants_lookup.hpp"

namespace drycut::plants {
namespace {

WebDefinition air() {
  WebDefinition web;
  web.data.shear_strength = 0;
  return web;
}

RotaryKnifeDefinition geared_knife(const char* kind, double ratio) {
  RotaryKnifeDefinition knife;
  knife.data.coupling = 0;
  knife.data.counter.kind = kind;
  knife.data.counter.inertia = 0.3;
  knife.data.counter.ratio = ratio;
  return knife;
}

TEST(CounterDrum, ItsInertiaAndFrictionAreOnTheKnifesShaft) {
  for (const char* kind : {"none", "smooth"})
    for (const double ratio : {0.5, 1.0, 2.0}) {
      SCOPED_TRACE(testing::Message() << kind << ratio);
      auto knife = geared_knife(kind, ratio);
      auto web = air();
      knife.data.motor_friction = {};
      knife.data.drum_friction = {2, 0.3, 0, 0};
      knife.data.counter.friction = {3, 0.2, 0, 0};
      knife.data.gear.damping = 0;
      Machine line(knife, &web);
      auto& machine = static_cast<RotaryKnife&>(*line.plant);
      line.command("servo.enable", false);
      machine.drum().speed = 20;
      machine.rotor().speed = 20 * knife.data.gear.ratio;
      const bool turns = std::string(kind) == "smooth";
      const double drums = 0.41 + (turns ? 0.3 * ratio * ratio : 0);
      const double inertia = drums + 46.8e-4 * 25;
      const double dry = 2 + (turns ? 3 * ratio : 0);
      const double viscous = 0.3 + (turns ? 0.2 * ratio * ratio : 0);
      line.run(0.5);
      // w' = -(dry + viscous w) / J
      const double wanted = (20 + dry / viscous) * std::exp(-viscous / inertia * 0.5) - dry / viscous;
      const double momentum = drums * machine.drum().speed + 46.8e-4 * 5 * machine.rotor().speed;
      EXPECT_NEAR(momentum / inertia, wanted, 2e-3);
      EXPECT_NEAR(machine.drum().inertia, drums, 1e-12);
      ASSERT_EQ(line.plant->drives().size(), 1U);
      EXPECT_NEAR(line.plant->drives()[0].load_inertia, drums / 25, 1e-12);
    }
}

TEST(CounterDrum, TakesAnotherInertiaAndFrictionInMidRun) {
  auto knife = geared_knife("smooth", 2);
  auto web = air();
  Machine line(knife, &web);
  auto& machine = static_cast<RotaryKnife&>(*line.plant);
  for (const auto& row : line.plant->live_parameters())
    if (row.name == "counter.inertia") *std::get<double*>(row.value) = 0.5;
  line.plant->parameters_changed();
  EXPECT_NEAR(machine.drum().inertia, 0.41 + 4 * 0.5, 1e-12);
  int rows = 0;
  for (const auto& row : line.plant->live_parameters()) rows += row.name.starts_with("counter.") ? 1 : 0;
  EXPECT_EQ(rows, 3);
}

// Two motors on a machine are one motor on half of it.
TEST(TwoMotors, EachHasHalfOfTheMachine) {
  const auto run = [](int motors) {
    auto knife = geared_knife("smooth", 1);
    auto web = air();
    knife.data.motors = motors;
    const double share = motors / 2.0;
    knife.data.drum_inertia *= share;
    knife.data.counter.inertia *= share;
    knife.data.drum_friction.coulomb *= share;
    knife.data.drum_friction.viscous *= share;
    knife.data.counter.friction.coulomb *= share;
    knife.data.counter.friction.viscous *= share;
    Machine line(knife, &web);
    line.reference(2.5);
    std::vector<double> speeds;
    for (int i = 0; i < 20; ++i) {
      line.run(0.05);
      speeds.push_back(line.read("motor.speed"));
      speeds.push_back(line.read("speed"));
      speeds.push_back(line.read("motor.torque"));
      speeds.push_back(line.read("gear.torque"));
    }
    speeds.push_back(line.plant->drives()[0].load_inertia);
    return speeds;
  };
  const auto one = run(1);
  const auto two = run(2);
  ASSERT_EQ(one.size(), two.size());
  for (std::size_t i = 0; i < one.size(); ++i)
    EXPECT_NEAR(one[i], two[i], 1e-6 * (1 + std::abs(one[i]))) << i;
}

TEST(CounterDrum, ObjectsToWhatDoesNotGoTogether) {
  const auto told = [](auto change) {
    RotaryKnifeDefinition knife;
    change(knife.data);
    return objections_of(knife);
  };
  using testing::ElementsAre;
  using testing::IsEmpty;
  using testing::StartsWith;
  EXPECT_THAT(told([](auto& d) {
                d.counter.kind = "blades";
                d.counter.ratio = 2;
              }),
              ElementsAre(StartsWith("counter.ratio: blades on both drums meet only where both turn alike")));
  EXPECT_THAT(told([](auto& d) {
                d.counter.ratio = 2;
                d.motors = 2;
              }),
              IsEmpty())
      << "no counter drum";
  EXPECT_THAT(
      told([](auto& d) {
        d.counter.kind = "smooth";
        d.counter.ratio = 2;
        d.motors = 2;
      }),
      ElementsAre(StartsWith("motors: the one on the counter drum would have to run 2 times as fast")));
  EXPECT_THAT(told([](auto& d) {
                d.counter.kind = "smooth";
                d.counter.friction.viscous = 5000;
              }),
              ElementsAre(StartsWith("counter.friction.viscous: ")));
  EXPECT_THAT(told([](auto& d) {
                d.counter.kind = "smooth";
                d.drum_friction.viscous = 5000;
              }),
              ElementsAre(StartsWith("drum_friction.viscous: ")));
  // Half a drum on each motor swings faster.
  EXPECT_THAT(told([](auto& d) {
                d.drum_inertia = 0.006;
                d.gear.stiffness = 2e5;
                d.gear.damping = 0;
                d.drum_friction.viscous = 0;
                d.motors = 2;
              }),
              ElementsAre(StartsWith("gear.stiffness: ")));
  EXPECT_THAT(told([](auto& d) {
                d.drum_inertia = 0.006;
                d.gear.stiffness = 2e5;
                d.gear.damping = 0;
                d.drum_friction.viscous = 0;
              }),
              IsEmpty());
}

TEST(CounterDrum, IsSeenUnderTheWebAndTurnsAgainstTheDrum) {
  auto knife = geared_knife("blades", 1);
  auto web = air();
  knife.data.initial_angle = 0;
  knife.data.motors = 2;
  knife.data.helix = 1.0 / 180 * pi;
  Machine line(knife, &web);
  const auto edge = [](const Part& part) { return (part.now().pose * at(0, -part.size[1] / 2, 0)).position; };
  int meet = 0;
  const auto parts = line.plant->parts();
  for (const Part& upper : parts) {
    if (!upper.name.starts_with("blade 1, piece")) continue;
    for (const Part& lower : parts) {
      if (lower.name != "counter " + upper.name) continue;
      // Mirrors of each other in the plane of the web.
      const auto above = edge(upper);
      const auto below = edge(lower);
      EXPECT_NEAR(above[0], below[0], 1e-12);
      EXPECT_NEAR(above[1], -below[1], 1e-12);
      EXPECT_NEAR(above[2], below[2], 1e-12);
      ++meet;
    }
  }
  EXPECT_GE(meet, 1);
  EXPECT_NEAR(pose_of(*line.plant, "counter drum").pose.position[1], -0.6 / (2 * pi), 1e-12);
  EXPECT_LT(pose_of(*line.plant, "motor 2").pose.position[1], 0);
  EXPECT_LT(pose_of(*line.plant, "motor 2").pose.position[2], -0.3) << "behind, as the other one";
}

}  // namespace
}  // namespace drycut::plants
