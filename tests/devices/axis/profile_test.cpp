#include "devices/axis/profile.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace drycut::devices::axis {
namespace {

constexpr double period = 0.002;
constexpr double full_speed = 10000;  // [bits/s]

/// setvel [bits/s] with tacc, tdec [1/100 s] from rest to full speed.
Demand demand(double speed, double tacc, double tdec, RampShape shape = RampShape::trapezoidal,
              bool keep_gradient = true) {
  return {speed, tacc / 100 / full_speed, tdec / 100 / full_speed, shape, keep_gradient};
}

struct Course {
  double space = 0;
  double peak = 0;
  double seconds = 0;
  double peak_change = 0;  ///< of speed in a period
};

Course run_to_end(Profile& profile) {
  Course run;
  double last = profile.speed();
  while (profile.moving() && run.seconds < 1000) {
    run.space += profile.step(period);
    run.seconds += period;
    run.peak = std::max(run.peak, std::abs(profile.speed()));
    run.peak_change = std::max(run.peak_change, std::abs(profile.speed() - last));
    last = profile.speed();
  }
  return run;
}

TEST(AxisRamp, BothShapesCoverTheSameSpace) {
  const Ramp ramp{100, 700, 0.4};
  for (const RampShape shape : {RampShape::trapezoidal, RampShape::epicycloidal}) {
    EXPECT_NEAR(ramp_space(shape, ramp, 0.4), 0.4 * 400, 1e-9);
    EXPECT_NEAR(ramp_speed(shape, ramp, 0.2), 400, 1e-9);
    EXPECT_NEAR(ramp_speed(shape, ramp, 0.4), 700, 1e-9);
    EXPECT_EQ(ramp_space(shape, ramp, 0), 0);
  }
}

TEST(AxisRamp, EpicycloidalPeaksAtTwiceTheLinearGradient) {
  const Ramp ramp{0, 1000, 0.5};
  const double h = 1e-6;
  const auto gradient = [&](double t) {
    return (ramp_speed(RampShape::epicycloidal, ramp, t + h) - ramp_speed(RampShape::epicycloidal, ramp, t)) /
           h;
  };
  EXPECT_NEAR(gradient(0.25), 2 * 1000 / 0.5, 1e-3);
  EXPECT_NEAR(gradient(0), 0, 1e-3);
  EXPECT_NEAR(gradient(0.5 - h), 0, 1e-3);
  // Speed is the derivative of space.
  const double at = 0.17;
  EXPECT_NEAR((ramp_space(RampShape::epicycloidal, ramp, at + h) -
               ramp_space(RampShape::epicycloidal, ramp, at - h)) /
                  (2 * h),
              ramp_speed(RampShape::epicycloidal, ramp, at), 1e-6);
}

TEST(AxisPlan, TrapezoidHasItsClosedForm) {
  // a = 10000 bits/s2, d = 20000: vs 2000 covers 200 + 100 in ramps.
  const auto plan = plan_move(0, 1000, demand(2000, 100, 50));
  EXPECT_NEAR(plan->first.duration, 0.2, 1e-12);
  EXPECT_NEAR(plan->last.duration, 0.1, 1e-12);
  EXPECT_NEAR(plan->constant, 700.0 / 2000, 1e-12);
  EXPECT_NEAR(plan->space(), 1000, 1e-9);
}

TEST(AxisPlan, AShortTrapezoidPeaksLower) {
  const auto plan = plan_move(0, 30, demand(2000, 100, 50));
  const double a = 10000;
  const double d = 20000;
  EXPECT_NEAR(plan->first.to, std::sqrt(2 * 30 * a * d / (a + d)), 1e-9);
  EXPECT_NEAR(plan->space(), 30, 1e-9);
}

TEST(AxisPlan, ProfileReductionKeepsTimesOrGradients) {
  const auto times = plan_move(0, 30, demand(2000, 100, 50, RampShape::epicycloidal, false));
  EXPECT_NEAR(times->first.duration, 0.2, 1e-12);
  EXPECT_NEAR(times->last.duration, 0.1, 1e-12);
  EXPECT_NEAR(times->first.to, 2 * 30 / 0.3, 1e-9);
  EXPECT_NEAR(times->space(), 30, 1e-9);
  const auto gradients = plan_move(0, 30, demand(2000, 100, 50, RampShape::epicycloidal, true));
  const double peak = std::sqrt(2 * 30 * 10000.0 * 20000 / 30000);
  EXPECT_NEAR(gradients->first.to, peak, 1e-9);
  EXPECT_NEAR(gradients->first.duration, peak / 10000, 1e-12);
}

TEST(AxisPlan, KnowsWhatCannotBeReached) {
  // From 2000 bits/s at d = 20000 the axis needs 100 bits.
  EXPECT_FALSE(plan_move(2000, 99.9, demand(2000, 100, 50)));
  EXPECT_TRUE(plan_move(2000, 100, demand(2000, 100, 50)));
  EXPECT_TRUE(plan_move(0, 0, demand(2000, 100, 50)));
}

class AxisProfileShapes : public testing::TestWithParam<RampShape> {};
INSTANTIATE_TEST_SUITE_P(Both, AxisProfileShapes,
                         testing::Values(RampShape::trapezoidal, RampShape::epicycloidal));

TEST_P(AxisProfileShapes, ArrivesExactlyInTheClosedFormTime) {
  for (const double distance : {1000.0, -1000.0, 300.0, 17.3, 0.25}) {
    Profile profile;
    const Demand wanted = demand(2000, 100, 50, GetParam());
    profile.move(distance, wanted);
    const Course run = run_to_end(profile);
    EXPECT_NEAR(run.space, distance, 1e-9);
    EXPECT_NEAR(run.seconds, plan_move(0, std::abs(distance), wanted)->duration(), period);
    EXPECT_LE(run.peak, 2000 + 1e-9);
  }
}

TEST_P(AxisProfileShapes, WithoutRampTimesSpeedSteps) {
  Profile profile;
  profile.move(100, demand(5000, 0, 0, GetParam()));
  EXPECT_NEAR(profile.step(period), 10, 1e-9);
  const Course run = run_to_end(profile);
  EXPECT_NEAR(run.space, 90, 1e-9);
  EXPECT_NEAR(run.seconds, 0.018, 1e-9);
}

TEST_P(AxisProfileShapes, ANewSpeedKeepsTheTarget) {
  Profile profile;
  profile.move(2000, demand(2000, 100, 50, GetParam()));
  double space = 0;
  for (int i = 0; i < 150; ++i) space += profile.step(period);
  EXPECT_NEAR(profile.speed(), 2000, 1e-9);
  EXPECT_TRUE(profile.change(demand(500, 100, 50, GetParam())));
  for (int i = 0; i < 50; ++i) space += profile.step(period);
  EXPECT_NEAR(profile.speed(), 500, 1e-9);
  EXPECT_TRUE(profile.change(demand(3000, 100, 50, GetParam())));
  const Course run = run_to_end(profile);
  EXPECT_NEAR(run.peak, 3000, 1e-6);
  EXPECT_NEAR(space + run.space, 2000, 1e-9);
}

TEST_P(AxisProfileShapes, NothingChangesInTheLastRamp) {
  Profile profile;
  profile.move(1000, demand(2000, 100, 50, GetParam()));
  double space = 0;
  while (!profile.in_last_ramp()) space += profile.step(period);
  EXPECT_EQ(profile.phase(), Phase::decelerating);
  EXPECT_FALSE(profile.change(demand(100, 1, 1, GetParam())));
  EXPECT_FALSE(profile.retarget(5000));
  EXPECT_NEAR(space + run_to_end(profile).space, 1000, 1e-9);
}

TEST_P(AxisProfileShapes, TakesANewTargetAheadOnly) {
  Profile profile;
  profile.move(1000, demand(2000, 100, 50, GetParam()));
  double space = 0;
  for (int i = 0; i < 120; ++i) space += profile.step(period);
  EXPECT_FALSE(profile.retarget(-10));
  EXPECT_FALSE(profile.retarget(99));  // the axis cannot stop there
  EXPECT_TRUE(profile.retarget(3000 - space));
  EXPECT_NEAR(space + run_to_end(profile).space, 3000, 1e-9);
}

TEST_P(AxisProfileShapes, TakesANewTargetInTheFirstRamp) {
  Profile profile;
  profile.move(-1000, demand(2000, 100, 50, GetParam()));
  double space = 0;
  for (int i = 0; i < 40; ++i) space += profile.step(period);
  EXPECT_TRUE(profile.retarget(-2500 - space));
  const Course run = run_to_end(profile);
  EXPECT_NEAR(space + run.space, -2500, 1e-9);
  EXPECT_NEAR(run.peak, 2000, 1e-9);
}

TEST_P(AxisProfileShapes, ADemandThatIsRefusedLeavesTheOneInUse) {
  Profile profile;
  const Demand used = demand(2000, 100, 50, GetParam());
  profile.move(1000, used);
  for (int i = 0; i < 200; ++i) profile.step(period);                // 600 bits done
  EXPECT_FALSE(profile.change(demand(2000, 100, 400, GetParam())));  // 800 bits to stop
  EXPECT_EQ(profile.demand(), used);
  EXPECT_TRUE(profile.retarget(300));
  profile.stop(true);
  EXPECT_NEAR(run_to_end(profile).space, 100, 1e-9);
}

TEST_P(AxisProfileShapes, ADemandOfARampIsJudgedInIt) {
  Profile profile;
  profile.move(350, demand(2000, 100, 50, GetParam()));  // 200 up, 50 at speed, 100 down
  double space = 0;
  for (int i = 0; i < 50; ++i) space += profile.step(period);
  // Half the speed: a trapezoid can still stop in 250 bits there, an epicycloidal ramp ends in 800.
  const bool bends = GetParam() == RampShape::trapezoidal;
  EXPECT_EQ(profile.change(demand(2000, 100, 400, GetParam())), bends);
  EXPECT_TRUE(profile.change(demand(1500, 100, 50, GetParam())));
  const Course run = run_to_end(profile);
  EXPECT_NEAR(space + run.space, 350, 1e-9);
  EXPECT_LE(run.peak, 2000 + 1e-9);
}

TEST_P(AxisProfileShapes, AShortMoveMadeLongInItsRampReachesItsSpeed) {
  for (const bool keep_gradient : {false, true}) {
    Profile profile;
    profile.move(30, demand(2000, 100, 50, GetParam(), keep_gradient));
    double space = 0;
    for (int i = 0; i < 10; ++i) space += profile.step(period);
    EXPECT_TRUE(profile.retarget(3000 - space));
    const Course run = run_to_end(profile);
    EXPECT_NEAR(run.peak, 2000, 1e-9);
    EXPECT_LE(run.peak_change, 2 * 20000 * period);  // the gradient of tdec, epicycloidal twice
    EXPECT_NEAR(space + run.space, 3000, 1e-9);
  }
}

TEST_P(AxisProfileShapes, AStopNeverPassesTheTarget) {
  for (int after = 0; after < 40; ++after) {
    Profile profile;
    profile.move(1000, demand(2000, 100, 50, GetParam()));
    double space = 0;
    while (1000 - space - 4 > 100) space += profile.step(period);
    EXPECT_TRUE(profile.change(demand(500, 100, 50, GetParam())));  // 0.075 s down
    for (int i = 0; i < after; ++i) space += profile.step(period);
    profile.stop(false);
    EXPECT_LE(space + run_to_end(profile).space, 1000 + 1e-9) << after;
  }
}

TEST_P(AxisProfileShapes, GoesOnToItsTargetFromElsewhere) {
  for (const double off : {-60.0, -1.0, 0.0, 1.0, 40.0, 500.0}) {
    Profile profile;
    profile.move(-1000, demand(2000, 100, 50, GetParam()));
    double space = 0;
    while (!profile.in_last_ramp()) space += profile.step(period);
    for (int i = 0; i < 5; ++i) space += profile.step(period);
    const double left = -1000 - space - off;  // about 80 bits and those
    const double speed = profile.speed();
    EXPECT_TRUE(profile.resume(left)) << off;
    EXPECT_NEAR(profile.speed(), speed, 1e-9);
    EXPECT_NEAR(run_to_end(profile).space, left, 1e-9) << off;
  }
}

TEST_P(AxisProfileShapes, GoesOnToATargetThatItsRampWouldPass) {
  Profile profile;
  profile.move(1000, demand(2000, 100, 50, GetParam()));
  for (int i = 0; i < 25; ++i) profile.step(period);
  const double speed = profile.speed();
  EXPECT_TRUE(profile.resume(60));  // the ramp to 2000 takes more
  EXPECT_NEAR(profile.speed(), speed, 1e-9);
  const Course run = run_to_end(profile);
  EXPECT_NEAR(run.space, 60, 1e-9);
  EXPECT_LE(run.peak_change, 2 * 20000 * period);
}

TEST_P(AxisProfileShapes, StopsBehindATargetThatItHasPassed) {
  Profile profile;
  profile.move(1000, demand(2000, 100, 50, GetParam()));
  for (int i = 0; i < 150; ++i) profile.step(period);
  EXPECT_FALSE(profile.resume(-1));
  EXPECT_TRUE(profile.stopping());
  EXPECT_NEAR(run_to_end(profile).space, 100, 1e-9);
}

TEST_P(AxisProfileShapes, WhateverIsWrittenTheSpeedIsContinuousAndTheEndExact) {
  std::uint32_t state = 1;
  const auto draw = [&](int below) {
    state = state * 1664525 + 1013904223;
    return static_cast<int>((state >> 8) % static_cast<std::uint32_t>(below));
  };
  int taken = 0;
  for (int run = 0; run < 500; ++run) {
    Profile profile;
    double target = 1 + draw(2000);
    profile.move(target, demand(1 + draw(4000), 20 + draw(200), 20 + draw(200), GetParam(), draw(2) == 0));
    double space = 0;
    double last = 0;
    for (int i = 0; profile.moving() && i < 20000; ++i) {
      space += profile.step(period);
      ASSERT_LE(space, target + 1e-6) << run;
      // Twice the gradient of the shortest ramp time drawn.
      ASSERT_LE(std::abs(profile.speed() - last), 2 * full_speed / 0.2 * period + 1e-6) << run << ' ' << i;
      last = profile.speed();
      if (draw(15) != 0) continue;
      Demand wanted = profile.demand();
      switch (draw(4)) {
        case 0:
          wanted.speed = 1 + draw(4000);
          taken += profile.change(wanted) ? 1 : 0;
          break;
        case 1:
          wanted.seconds_per_speed_up = (20 + draw(200)) / 100.0 / full_speed;
          taken += profile.change(wanted) ? 1 : 0;
          break;
        case 2:
          wanted.seconds_per_speed_down = (20 + draw(200)) / 100.0 / full_speed;
          taken += profile.change(wanted) ? 1 : 0;
          break;
        default:
          if (const double other = space + draw(500) - 50; profile.retarget(other - space)) {
            target = other;
            ++taken;
          }
      }
    }
    ASSERT_FALSE(profile.moving()) << run;
    ASSERT_NEAR(space, target, 1e-6) << run;
  }
  EXPECT_GT(taken, 2000);
}

TEST(AxisProfile, LinearRampTimesActInsideTheRamp) {
  Profile profile;
  profile.move(1e6, demand(5000, 100, 100));
  for (int i = 0; i < 100; ++i) profile.step(period);
  EXPECT_NEAR(profile.speed(), 2000, 1e-6);
  EXPECT_TRUE(profile.change(demand(5000, 50, 100)));
  for (int i = 0; i < 50; ++i) profile.step(period);
  EXPECT_NEAR(profile.speed(), 2000 + 20000 * 0.1, 1e-6);
}

TEST(AxisProfile, EpicycloidalRampsAreNeverBent) {
  Profile profile;
  profile.move(1e5, demand(2000, 100, 100, RampShape::epicycloidal));
  for (int i = 0; i < 50; ++i) profile.step(period);  // mid ramp
  EXPECT_TRUE(profile.change(demand(4000, 100, 100, RampShape::epicycloidal)));
  for (int i = 0; i < 50; ++i) profile.step(period);
  EXPECT_NEAR(profile.speed(), 2000, 1e-6);
  const Course run = run_to_end(profile);
  EXPECT_NEAR(run.peak, 4000, 1e-6);
  EXPECT_LE(run.peak_change, 2 * 10000 * period + 1e-9);
}

TEST(AxisProfile, TheRampBehindAnEpicycloidalOneIsNotBentEither) {
  Profile profile;
  profile.move(1e5, demand(2000, 100, 100, RampShape::epicycloidal));
  double space = 0;
  const auto steps = [&](int number) {
    for (int i = 0; i < number; ++i) space += profile.step(period);
    return profile.speed();
  };
  steps(50);
  EXPECT_TRUE(profile.change(demand(4000, 100, 100, RampShape::epicycloidal)));
  EXPECT_NEAR(steps(100), 3000, 1e-6);  // the middle of the second ramp, which began at 0.2 s
  EXPECT_TRUE(profile.change(demand(1000, 100, 100, RampShape::epicycloidal)));
  EXPECT_NEAR(steps(50), 4000, 1e-6);
  EXPECT_EQ(profile.phase(), Phase::decelerating);
  EXPECT_NEAR(steps(150), 1000, 1e-6);
  EXPECT_EQ(profile.phase(), Phase::constant);
  EXPECT_NEAR(space + run_to_end(profile).space, 1e5, 1e-6);
}

TEST(AxisProfile, AStopBrakesAtOnceOrAfterTheRamp) {
  const Demand wanted = demand(2000, 100, 50, RampShape::epicycloidal);
  Profile at_once;
  at_once.move(1e5, wanted);
  for (int i = 0; i < 50; ++i) at_once.step(period);
  const double speed = at_once.speed();
  EXPECT_NEAR(speed, 1000, 1e-6);
  at_once.stop(false);
  Course run = run_to_end(at_once);
  EXPECT_NEAR(run.seconds, 0.05, period);
  EXPECT_NEAR(run.space, speed * 0.05 / 2, 1e-6);

  Profile after;
  after.move(1e5, wanted);
  for (int i = 0; i < 50; ++i) after.step(period);
  const double done = 0.2 * 2000 * (0.125 - 2 / (4 * std::numbers::pi * std::numbers::pi));
  after.stop(true);
  run = run_to_end(after);
  EXPECT_NEAR(run.peak, 2000, 1e-6);
  EXPECT_NEAR(run.space, 200 - done + 100, 1e-6);
}

TEST(AxisProfile, ATrapezoidStopsAtOnceWhateverStoptSays) {
  Profile profile;
  const Demand wanted = demand(2000, 100, 50);
  profile.move(-1e5, wanted);
  for (int i = 0; i < 50; ++i) profile.step(period);
  profile.stop(true);
  EXPECT_EQ(profile.phase(), Phase::decelerating);
  EXPECT_NEAR(run_to_end(profile).space, -1000 * 0.05 / 2, 1e-9);
}

TEST(AxisProfile, BrakesFromAGivenSpeed) {
  Profile profile;
  profile.brake(-2000, demand(0, 100, 50));
  EXPECT_TRUE(profile.backward());
  EXPECT_NEAR(run_to_end(profile).space, -100, 1e-9);
}

TEST(AxisProfile, WithoutSpeedItWaits) {
  Profile profile;
  profile.move(100, demand(0, 100, 50));
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(profile.step(period), 0);
  EXPECT_TRUE(profile.moving());
  EXPECT_TRUE(profile.change(demand(1000, 100, 50)));
  EXPECT_NEAR(run_to_end(profile).space, 100, 1e-9);
}

}  // namespace
}  // namespace drycut::devices::axis
