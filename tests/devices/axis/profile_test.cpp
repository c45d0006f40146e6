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

TEST(AxisProfile, AStopBrakesAtOnceOrAfterTheRamp) {
  const Demand wanted = demand(2000, 100, 50, RampShape::epicycloidal);
  Profile at_once;
  at_once.move(1e5, wanted);
  for (int i = 0; i < 50; ++i) at_once.step(period);
  const double speed = at_once.speed();
  EXPECT_NEAR(speed, 1000, 1e-6);
  at_once.stop(false, wanted);
  Course run = run_to_end(at_once);
  EXPECT_NEAR(run.seconds, 0.05, period);
  EXPECT_NEAR(run.space, speed * 0.05 / 2, 1e-6);

  Profile after;
  after.move(1e5, wanted);
  for (int i = 0; i < 50; ++i) after.step(period);
  const double done = 0.2 * 2000 * (0.125 - 2 / (4 * std::numbers::pi * std::numbers::pi));
  after.stop(true, wanted);
  run = run_to_end(after);
  EXPECT_NEAR(run.peak, 2000, 1e-6);
  EXPECT_NEAR(run.space, 200 - done + 100, 1e-6);
}

TEST(AxisProfile, ATrapezoidStopsAtOnceWhateverStoptSays) {
  Profile profile;
  const Demand wanted = demand(2000, 100, 50);
  profile.move(-1e5, wanted);
  for (int i = 0; i < 50; ++i) profile.step(period);
  profile.stop(true, wanted);
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
