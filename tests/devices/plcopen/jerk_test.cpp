#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "devices/plcopen/coupling.hpp"

namespace drycut::devices::plcopen {
namespace {

constexpr JerkLimits limits{.velocity = 100, .acceleration = 400, .deceleration = 400, .jerk = 4000};

/// Runs through a profile and expects that it is smooth, ends where it says, and keeps what it must keep.
void expect_sound(const JerkProfile& profile, const JerkLimits& bounds, double scale = 1) {
  const MotionState& start = profile.start;
  const double most_a = std::max({bounds.acceleration, bounds.deceleration, std::abs(start.acceleration)});
  const double released =
      std::abs(start.velocity) + start.acceleration * start.acceleration / (2 * bounds.jerk);
  const double most_v = std::max(bounds.velocity, released);
  MotionState now = start;
  for (int i = 0; i < profile.count; ++i) {
    const JerkProfile::Phase& phase = profile.phases[static_cast<std::size_t>(i)];
    EXPECT_GT(phase.duration, 0);
    EXPECT_LE(std::abs(phase.jerk), bounds.jerk);
    for (const double u : {0.25, 0.5, 0.75, 1.0}) {
      const MotionState inside = moved(now, phase.jerk, u * phase.duration);
      EXPECT_LE(std::abs(inside.acceleration), most_a * (1 + 1e-9));
      EXPECT_LE(std::abs(inside.velocity), most_v * (1 + 1e-9));
    }
    now = moved(now, phase.jerk, phase.duration);
  }
  const double size = scale + std::abs(profile.end.position) + std::abs(start.position);
  // A ramp that begins as it ends is a root of a difference: half of the digits are left for its share.
  EXPECT_NEAR(now.position, profile.end.position, 1e-7 * size);
  EXPECT_NEAR(now.velocity, profile.end.velocity, 1e-6 * (1 + most_v));
  EXPECT_NEAR(now.acceleration, 0, 1e-6 * most_a);
  const MotionState after = at(profile, profile.duration + 1);
  EXPECT_EQ(after.velocity, profile.end.velocity);
  EXPECT_EQ(after.position,
            profile.end.position + profile.end.velocity * (profile.duration + 1 - profile.duration));
}

TEST(PlcopenJerk, AChangeOfSpeedFromRestTakesTwoRootsOfItsJerk) {
  // Without the acceleration limit T = 2 sqrt(dv/j) and the way is dv T/2.
  const JerkProfile profile = *to_velocity({}, 10, limits);
  EXPECT_NEAR(profile.duration, 2 * std::sqrt(10.0 / 4000), 1e-12);
  EXPECT_NEAR(profile.end.position, 10 * profile.duration / 2, 1e-12);
  EXPECT_EQ(profile.count, 2);
  expect_sound(profile, limits);
}

TEST(PlcopenJerk, WithTheAccelerationLimitItTakesSpeedByAccelerationAndARampTimeMore) {
  const JerkProfile profile = *to_velocity({}, 90, limits);
  EXPECT_NEAR(profile.duration, 90.0 / 400 + 400.0 / 4000, 1e-12);
  EXPECT_EQ(profile.count, 3);
  expect_sound(profile, limits);
}

TEST(PlcopenJerk, ARestToRestMoveIsTheSevenPhases) {
  // Long enough for the top speed: T = S/v + v/a + a/j.
  const JerkProfile profile = *to_position({5, 0, 0}, 505, limits);
  EXPECT_EQ(profile.count, 7);
  EXPECT_NEAR(profile.duration, 500.0 / 100 + 100.0 / 400 + 400.0 / 4000, 1e-9);
  EXPECT_NEAR(at(profile, profile.duration / 2).position, 255, 1e-9);
  EXPECT_NEAR(at(profile, profile.duration / 2).velocity, 100, 1e-9);
  expect_sound(profile, limits);
}

TEST(PlcopenJerk, ATinyMoveIsFourRampsOfJerk) {
  // S = 2 j t^3 with four ramps of t.
  const double way = 1e-3;
  const JerkProfile profile = *to_position({}, -way, limits);
  EXPECT_NEAR(profile.duration, 4 * std::cbrt(way / (2 * limits.jerk)), 1e-12);
  EXPECT_EQ(at(profile, profile.duration).position, -way);
  expect_sound(profile, limits);
}

TEST(PlcopenJerk, WhereItIsAlreadyThereIsNothingToDo) {
  EXPECT_EQ(to_position({7, 0, 0}, 7, limits)->count, 0);
  EXPECT_EQ(to_position({7, 0, 0}, 7, limits)->duration, 0);
  EXPECT_EQ(to_velocity({7, 30, 0}, 30, limits)->duration, 0);
  EXPECT_EQ(at(*to_position({7, 0, 0}, 7, limits), 3).position, 7);
}

TEST(PlcopenJerk, TooFastItSlowsDownFirst) {
  const JerkProfile profile = *to_position({0, 150, 0}, 400, limits);
  expect_sound(profile, limits);
  EXPECT_NEAR(at(profile, profile.duration).position, 400, 0);
  // At the limit for a while.
  EXPECT_NEAR(at(profile, 1.5).velocity, 100, 1e-9);
}

TEST(PlcopenJerk, ItComesBackWhereItCannotStopInTime) {
  const JerkProfile profile = *to_position({0, 80, 0}, 1, limits);
  expect_sound(profile, limits);
  double furthest = 0;
  for (double t = 0; t < profile.duration; t += 1e-3) furthest = std::max(furthest, at(profile, t).position);
  // It turns without letting go of its deceleration: v a/(2j) + v2/(2a), less what the onset a3/(24 j2)
  // saves.
  EXPECT_NEAR(furthest, 4 + 8 - 64e6 / (24 * 16e6), 1e-3);
  EXPECT_EQ(profile.end.position, 1);
}

TEST(PlcopenJerk, AccelerationAboveItsLimitComesDownFirst) {
  const JerkProfile up = *to_velocity({0, 0, 900}, 300, limits);
  expect_sound(up, {300, 400, 400, 4000});
  EXPECT_NEAR(at(up, 500.0 / 4000).acceleration, 400, 1e-9);
  expect_sound(*to_velocity({0, 0, 900}, -50, limits), limits);
}

TEST(PlcopenJerk, DecelerationHasALimitOfItsOwn) {
  const JerkLimits slow_stop{100, 400, 200, 4000};
  const JerkProfile profile = *to_position({}, 300, slow_stop);
  double most = 0;
  double least = 0;
  for (double t = 0; t < profile.duration; t += 1e-4) {
    most = std::max(most, at(profile, t).acceleration);
    least = std::min(least, at(profile, t).acceleration);
  }
  EXPECT_NEAR(most, 400, 1e-6);
  EXPECT_NEAR(least, -200, 1e-6);
  // Backwards it is the same way mirrored.
  const JerkProfile mirrored = *to_position({}, -300, slow_stop);
  EXPECT_EQ(mirrored.duration, profile.duration);
  EXPECT_EQ(at(mirrored, 1.0).position, -at(profile, 1.0).position);
}

TEST(PlcopenJerk, NoLimitMayBeZeroOrNoNumber) {
  const double nan = std::nan("");
  for (const double bad : {0.0, -1.0, nan, HUGE_VAL}) {
    EXPECT_FALSE(to_position({}, 1, {bad, 1, 1, 1}));
    EXPECT_FALSE(to_position({}, 1, {1, bad, 1, 1}));
    EXPECT_FALSE(to_position({}, 1, {1, 1, bad, 1}));
    EXPECT_FALSE(to_position({}, 1, {1, 1, 1, bad}));
    EXPECT_FALSE(to_velocity({}, 1, {1, 1, 1, bad}));
    EXPECT_FALSE(to_velocity({}, 1, bad, 1, 1));
    EXPECT_FALSE(to_velocity({}, 1, 1, bad, 1));
    EXPECT_FALSE(to_velocity({}, 1, 1, 1, bad));
  }
}

TEST(PlcopenJerk, FromAnyStateEveryProfileKeepsItsLimitsAndEndsExactly) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> share(-1, 1);
  for (int i = 0; i < 20'000; ++i) {
    const double scale = std::pow(10, 3 * share(random));
    JerkLimits bounds{100 * scale * std::pow(10, share(random)), 400 * scale * std::pow(10, share(random)), 0,
                      4000 * scale * std::pow(10, share(random))};
    bounds.deceleration = bounds.acceleration * (i % 3 == 0 ? std::pow(10, share(random)) : 1);
    const bool wild = i % 5 == 0;  // outside the limits
    const double reach = wild ? 2 : 1;
    MotionState start{100 * scale * share(random), reach * bounds.velocity * share(random),
                      reach * std::min(bounds.acceleration, bounds.deceleration) * share(random)};
    if (i % 7 == 0) start.acceleration = 0;
    const double target = start.position + scale * std::pow(10, 3 * share(random)) * share(random);
    SCOPED_TRACE(i);
    expect_sound(*to_position(start, target, bounds), bounds, scale * 1000);
    expect_sound(*to_velocity(start, bounds.velocity * share(random), bounds), bounds, scale * 1000);
    if (HasFailure()) break;
  }
}

TEST(PlcopenJerk, ReplanningOnTheWayLeadsToTheSameEnd) {
  // The best proof that a way is a fastest one: from each of its states the rest of it is planned again.
  for (const double way : {3.0, 25.0, 300.0}) {
    const JerkProfile profile = *to_position({}, way, limits);
    for (double t = 0.01; t < profile.duration; t += 0.013) {
      const JerkProfile rest = *to_position(at(profile, t), way, limits);
      EXPECT_NEAR(rest.duration, profile.duration - t, 2e-4) << way << " at " << t;
    }
  }
}

// Ways that pass their target at a speed (blending): the end is exact, no limit is passed on the way.
TEST(PlcopenJerk, AWayMayEndAtASpeed) {
  const JerkLimits bounds{1'000, 2'000, 1'500, 50'000};
  std::uint64_t seed = 7;
  const auto random = [&](double low, double high) {
    seed = seed * 6364136223846793005U + 1442695040888963407U;
    return low + (high - low) * static_cast<double>(seed >> 11U) / 9007199254740992.0;
  };
  int reached = 0;
  for (int i = 0; i < 20'000; ++i) {
    const double sign = i % 2 == 0 ? 1 : -1;
    const MotionState from{random(-100, 100), sign * random(0, 1'000), sign * random(-1'000, 1'000)};
    const double position = from.position + sign * random(1, 3'000);
    const double wanted = sign * random(0, 1'400);
    const JerkProfile profile = *to_position(from, position, bounds, wanted);
    ASSERT_EQ(profile.end.position, position);
    const MotionState before = at(profile, profile.duration * (1 - 1e-12));
    ASSERT_NEAR(before.position, position, 1e-3) << i;
    ASSERT_NEAR(before.velocity, profile.end.velocity, 1e-3) << i;
    ASSERT_NEAR(before.acceleration, 0, 1e-2) << i;
    ASSERT_LE(std::abs(profile.end.velocity), std::abs(wanted) * (1 + 1e-9)) << i;
    reached += profile.end.velocity == wanted ? 1 : 0;
    for (int k = 0; k <= 50; ++k) {
      const MotionState now = at(profile, profile.duration * k / 50);
      ASSERT_LE(std::abs(now.velocity), std::max({1'000.0 + 25, std::abs(wanted)}) + 1e-6) << i;
      ASSERT_LE(std::abs(now.acceleration), 2'000 * (1 + 1e-9)) << i;
    }
  }
  EXPECT_GT(reached, 10'000) << "short ways apart";
  // Straight up to the speed: the way of a ramp with jerk, v*v/2a + v*a/2j.
  const double ramp = 800 * 800 / (2 * 2'000.0) + 800 * 2'000.0 / (2 * 50'000.0);
  const JerkProfile up = *to_position({}, ramp, bounds, 800);
  EXPECT_NEAR(up.end.velocity, 800, 1e-6);
  EXPECT_NEAR(up.duration, 800 / 2'000.0 + 2'000.0 / 50'000.0, 1e-6);
  EXPECT_LT(to_position({}, ramp * 0.9, bounds, 800)->end.velocity, 800);
  EXPECT_GT(to_position({}, ramp * 0.9, bounds, 800)->end.velocity, 700);
}

}  // namespace
}  // namespace drycut::devices::plcopen
