#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "plants/random.hpp"
#include "plants/world.hpp"
#include "tests/plants/plants_lookup.hpp"

namespace drycut::plants {
namespace {

/// Angle of a pose turned about z [rad], -pi..pi.
double angle_about_z(const Pose& pose) { return 2 * std::atan2(pose.rotation[2], pose.rotation[3]); }

TEST(World, FreeSpinUpFollowsTheClosedForm) {
  // Symplectic Euler: the speed is exact, the angle is ahead by 1/2 alpha T dt.
  for (const double h : {1e-3, 1e-4}) {
    World world;
    Shaft& shaft = world.add_shaft({.name = "shaft", .inertia = 0.41});
    const double alpha = 3.0 / 0.41;
    const int steps = static_cast<int>(std::lround(2 / h));
    for (int i = 0; i < steps; ++i) {
      shaft.add_torque(3);
      world.step(h);
    }
    EXPECT_NEAR(shaft.speed / (alpha * 2), 1, 1e-11);
    EXPECT_NEAR(shaft.angle() - 0.5 * alpha * 4, 0.5 * alpha * 2 * h, 1e-9);
  }
}

TEST(World, SlideFallsUnderGravity) {
  World world;
  Slide& up = world.add_slide({.name = "ram", .mass = 12, .axis = {0, 1, 0}, .gravity = true});
  Slide& ramp = world.add_slide({.name = "ramp", .mass = 7, .axis = {0.8, -0.6, 0}, .gravity = true});
  Slide& level = world.add_slide({.name = "level", .mass = 7, .gravity = true});
  for (int i = 0; i < 10000; ++i) world.step(1e-4);
  EXPECT_NEAR(up.speed, -9.80665, 1e-9);
  EXPECT_NEAR(up.position, -0.5 * 9.80665, 0.5 * 9.80665 * 1e-4 + 1e-9);
  EXPECT_NEAR(ramp.speed, 0.6 * 9.80665, 1e-9);
  EXPECT_EQ(level.speed, 0);
  const Pose pose = world.pose(ramp);
  EXPECT_NEAR(pose.position[0], 0.8 * ramp.position, 1e-12);
  EXPECT_NEAR(pose.position[1], -0.6 * ramp.position, 1e-12);
}

TEST(World, SlideThatHasTravelledADayAndAHalfDriftsByNothing) {
  // 36 h at 1 m/s: there a step of 0.1 mm alone is rounded to 1.5e-11 m, 5 nm short or long in each metre.
  constexpr double far = 129600;
  World world;
  Slide& web = world.add_slide({.name = "web", .position = far, .speed = 1});
  Slide& back = world.add_slide({.name = "back", .position = -far, .speed = -1});
  Slide& piece = world.add_slide({.name = "piece", .position = far, .speed = 0.7, .slow = true});
  double plain = far;
  for (int i = 0; i < 1000000; ++i) {
    world.step(1e-4);
    plain += 1 * 1e-4;
  }
  EXPECT_NEAR(web.position, far + 100, 2e-11);
  EXPECT_NEAR(back.position, -far - 100, 2e-11);
  EXPECT_NEAR(piece.position, far + 70, 2e-11);
  EXPECT_GT(std::abs(plain - far - 100), 1e-6) << "what adding alone makes of it";
}

// Bullet's pose is made when it is asked for, be it once in a million steps.
TEST(World, BulletsOrientationIsThatOfTheAngleWheneverItIsAsked) {
  for (const double per_step : {0.0037, 0.31, -0.011}) {  // [rad]
    World world;
    Shaft& shaft =
        world.add_shaft({.name = "shaft", .inertia = 1, .revolutions = 0.3, .speed = per_step / 1e-4});
    EXPECT_NEAR(std::remainder(angle_about_z(world.pose(shaft)) - 2 * pi * 0.3, 2 * pi), 0, 1e-14);
    for (int i = 0; i < 1000000; ++i) world.step(1e-4);
    EXPECT_NEAR(shaft.revolutions(), 0.3 + per_step * 1e6 / (2 * pi), 1e-7);
    const double difference = std::remainder(angle_about_z(world.pose(shaft)) - 2 * pi * shaft.part, 2 * pi);
    EXPECT_NEAR(difference, 0, 1e-14) << per_step;
    EXPECT_GE(shaft.part, 0);
    EXPECT_LT(shaft.part, 1);
  }
}

TEST(World, PartOfATurnStaysInsideTheTurnAroundZero) {
  World world;
  Shaft& shaft = world.add_shaft({.name = "shaft", .inertia = 1});
  shaft.speed = -1e-18;  // too little to be seen beside a whole turn
  world.step(1e-4);
  EXPECT_EQ(shaft.turns, 0);
  EXPECT_EQ(shaft.part, 0);
  shaft.speed = -100;
  world.step(1e-4);
  EXPECT_EQ(shaft.turns, -1);
  EXPECT_NEAR(shaft.revolutions(), -0.01 / (2 * pi), 1e-15);
}

TEST(World, RefusesASpeedThatBulletWouldClamp) {
  World world;
  Shaft& shaft = world.add_shaft({.name = "knife motor", .inertia = 1, .speed = 7800});
  world.step(1e-4);
  EXPECT_EQ(world.failure(), "");
  shaft.speed = 7900;  // 0.79 rad > pi/4 a step
  const double before = shaft.part;
  world.step(1e-4);
  EXPECT_THAT(world.failure(), testing::StartsWith("knife motor: a speed of 7900"));
  EXPECT_THAT(world.failure(), testing::HasSubstr("a step of 100 us"));
  world.step(1e-4);
  EXPECT_EQ(shaft.part, before);
}

TEST(World, ReportsABodyThatDiverges) {
  World world;
  world.add_slide({.name = "carriage", .mass = 1}).add_force(std::nan(""));
  world.step(1e-4);
  EXPECT_THAT(world.failure(), testing::StartsWith("carriage: a speed of nan"));
}

TEST(World, SlowBodiesMoveEveryTenthStepByTheWholeTime) {
  World world;
  Slide& piece = world.add_slide({.name = "piece", .mass = 1, .speed = 2, .slow = true});
  for (int i = 0; i < 9; ++i) world.step(1e-4);
  EXPECT_EQ(piece.position, 0);
  EXPECT_TRUE(world.slow_due());
  world.step(1e-4);
  EXPECT_DOUBLE_EQ(piece.position, 2e-3);
  EXPECT_FALSE(world.slow_due());
  piece.awake = false;
  for (int i = 0; i < 10; ++i) world.step(1e-4);
  EXPECT_DOUBLE_EQ(piece.position, 2e-3);
}

TEST(World, PositionWithinAStepIsTheParabolaOfItsSpeeds) {
  // Uniformly accelerated motion: exact at every fraction.
  const double a = 30;
  const double h = 1e-3;
  const auto x = [&](double t) { return 0.2 * t + 0.5 * a * t * t; };
  const auto v = [&](double t) { return 0.2 + a * t; };
  for (const double f : {0.0, 0.25, 0.5, 0.9, 1.0})
    EXPECT_NEAR(within_step(x(0.7), x(0.7 + h), v(0.7), v(0.7 + h), h, f), x(0.7 + f * h), 1e-14);
}

TEST(World, IsDeterministic) {
  const auto run = [] {
    World world(7);
    Random noise = world.random("load");
    Shaft& shaft = world.add_shaft({.name = "shaft", .inertia = 0.01});
    for (int i = 0; i < 20000; ++i) {
      shaft.add_torque(noise.gaussian());
      world.step(1e-4);
    }
    return std::pair(shaft.part, shaft.speed);
  };
  EXPECT_EQ(run(), run());
}

TEST(Random, FollowsFromSeedNameAndOccurrence) {
  World a(1);
  World b(1);
  World c(2);
  EXPECT_EQ(a.random("servo").uniform(), b.random("servo").uniform());
  EXPECT_NE(b.random("encoder").uniform(), a.random("wheel").uniform());
  EXPECT_NE(World(1).random("servo").uniform(), c.random("servo").uniform());
  World d(1);
  Random first = d.random("servo");
  Random second = d.random("servo");
  EXPECT_NE(first.uniform(), second.uniform());
}

TEST(Random, GaussianHasTheMomentsOfANormal) {
  Random random(3, "test");
  const int n = 200000;
  double mean = 0;
  double square = 0;
  double fourth = 0;
  for (int i = 0; i < n; ++i) {
    const double x = random.gaussian();
    mean += x / n;
    square += x * x / n;
    fourth += x * x * x * x / n;
  }
  EXPECT_NEAR(mean, 0, 0.01);  // 4.5 standard errors
  EXPECT_NEAR(square, 1, 0.015);
  EXPECT_NEAR(fourth, 3, 0.1);
}

}  // namespace
}  // namespace drycut::plants
