// What of a residual one value alone would explain: residuals made of one term of a known motion.
#include "sim/studies/compare/explained.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "base/units.hpp"

namespace drycut::sim::studies::comparing {
namespace {

constexpr double every = 1e-3;  // [s]

// The motor swings at two frequencies and goes on slowly besides [rad/s], [rad/s2], [rad].
double speed(double t) { return 20 * std::sin(5 * t) + 8 * std::sin(13 * t) + 3; }
double acceleration(double t) { return 100 * std::cos(5 * t) + 104 * std::cos(13 * t); }
double angle(double t) { return -4 * std::cos(5 * t) - 8.0 / 13 * std::cos(13 * t) + 3 * t; }
double torque(double t) { return 0.01 * acceleration(t) + 0.02 * speed(t) + 0.3; }

MeasuredChannel channel_of(const std::string& name, const std::function<double(double)>& residual) {
  MeasuredChannel made{name, "N m"};
  MeasuredChannel::Motion rpm{"axis.motor.speed", "rpm", {}};
  MeasuredChannel::Motion degrees{"axis.angle.total", "deg", {}};
  for (int i = 0; i < 4000; ++i) {
    const double t = i * every;
    made.times.push_back(t);
    made.measured.push_back(torque(t));
    made.residual.push_back(residual(t));
    made.simulated.push_back(torque(t) + residual(t));
    rpm.values.push_back(speed(t) * units::rpm);
    degrees.values.push_back(angle(t) * 180 / std::numbers::pi);
  }
  made.rms = 1;
  made.speed = rpm;
  made.position = degrees;
  return made;
}

Explanation best_of(const std::function<double(double)>& residual) {
  return explain(channel_of("axis.motor.torque", residual)).at(0);
}

TEST(CompareExplained, InertiaThatTheRunHasTooMuch) {
  const auto best = best_of([](double t) { return 0.002 * acceleration(t); });
  EXPECT_EQ(best.rows, "inertia, mass");
  EXPECT_EQ(best.unit, "kg m2");
  EXPECT_NEAR(best.amount, 0.002, 0.002 * 0.01);
  EXPECT_GT(best.share, 0.98);
}

TEST(CompareExplained, FrictionThatTheRunHasTooLittle) {
  const auto viscous = best_of([](double t) { return -0.004 * speed(t); });
  EXPECT_EQ(viscous.rows, "*.viscous");
  EXPECT_NEAR(viscous.amount, -0.004, 0.004 * 0.01);
  const auto dry = best_of([](double t) { return speed(t) > 0 ? -0.2 : 0.2; });
  EXPECT_EQ(dry.rows, "*.coulomb");
  EXPECT_NEAR(dry.amount, -0.2, 0.2 * 0.03);
}

TEST(CompareExplained, UnbalanceZeroAndDelay) {
  const auto unbalance = best_of([](double t) { return 0.5 * std::sin(angle(t) + 1); });
  EXPECT_EQ(unbalance.rows, "unbalance, unbalance_angle");
  EXPECT_NEAR(unbalance.amount, 0.5, 0.5 * 0.03);
  const auto zero = best_of([](double) { return 0.15; });
  EXPECT_EQ(zero.value, "zero of the channel");
  EXPECT_NEAR(zero.amount, 0.15, 0.15 * 0.001);
  // Simulated 1 ms earlier than measured.
  const auto early = best_of([](double t) { return torque(t + 1e-3) - torque(t); });
  EXPECT_EQ(early.value, "delay of the channel");
  EXPECT_NEAR(early.amount, 1e-3, 1e-5);
}

// Of a channel that is no torque a motion explains nothing.
TEST(CompareExplained, AnotherChannelHasClockScaleAndZeroOnly) {
  const auto all = explain(channel_of("axis.load", [](double t) { return 0.002 * acceleration(t); }));
  ASSERT_EQ(all.size(), 3U);
  for (const auto& one : all) EXPECT_EQ(one.rows, "") << one.value;
}

TEST(CompareExplained, NoResidualNeedsNoExplanation) {
  EXPECT_TRUE(explain(channel_of("axis.motor.torque", [](double) { return 0.0; })).empty());
}

}  // namespace
}  // namespace drycut::sim::studies::comparing
