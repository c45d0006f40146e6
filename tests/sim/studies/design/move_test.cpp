// The best moves against what the calculus of variations says of them.
#include "sim/studies/design/move.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace drycut::sim::studies {
namespace {

/// What a move comes to, in the measures of moves of any size.
struct Measured {
  double squares = 0;   // integral of a^2, times way^3/distance^2
  double gradient = 0;  // times way^2/distance
  double jerk = 0;      // times way^3/distance
  double step = 0;      // of the gradient between two steps
  double low = 1e9;     // ratio
  double high = -1e9;
  double farthest = 0;
  double slave = 0;  // at the end
};

Measured measured(const MoveProblem& problem, const Move& move) {
  Measured m;
  const double width = problem.way / static_cast<double>(move.steps.size());
  const double d = std::abs(problem.distance);
  double ratio = problem.ratio;
  double before = 0;
  for (const auto& [begin, end] : move.steps) {
    m.step = std::max(m.step, std::abs(begin - before) * std::pow(problem.way, 2) / d);
    before = end;
    m.squares += width * (begin * begin + begin * end + end * end) / 3 * std::pow(problem.way, 3) / (d * d);
    m.gradient = std::max({m.gradient, std::abs(begin) * std::pow(problem.way, 2) / d,
                           std::abs(end) * std::pow(problem.way, 2) / d});
    m.jerk = std::max(m.jerk, std::abs(end - begin) / width * std::pow(problem.way, 3) / d);
    m.slave += width * (ratio + width * (begin / 3 + end / 6));
    m.farthest = std::max(m.farthest, m.slave);
    for (int i = 0; i <= 8; ++i) {
      const double u = i / 8.0;
      const double v = ratio + width * u * (begin + (end - begin) * u / 2);
      m.low = std::min(m.low, v);
      m.high = std::max(m.high, v);
    }
    ratio += width * (begin + end) / 2;
  }
  return m;
}

MoveProblem knife(MoveGoal goal, double length = 0.8) {
  MoveProblem problem;
  problem.way = length - 0.12;
  problem.distance = 0.6 - length;
  problem.ratio = 1;
  problem.goal = goal;
  problem.steps = 100;
  return problem;
}

Measured best(const MoveProblem& problem) {
  const auto move = best_move(problem);
  EXPECT_TRUE(move);
  if (!move) return {};
  const auto m = measured(problem, *move);
  EXPECT_NEAR(m.slave, problem.ratio * problem.way + problem.distance, 1e-7);
  return m;
}

TEST(DesignMove, ClosedFormsWithoutLimits) {
  for (const double length : {0.3, 0.5, 0.8, 2.0}) {
    const auto rms = best(knife(MoveGoal::rms, length));
    EXPECT_NEAR(rms.squares, 12, 1e-4);
    EXPECT_NEAR(rms.gradient, 6, 1e-2);
    const auto peak = best(knife(MoveGoal::peak, length));
    EXPECT_NEAR(peak.squares, 16, 1e-3);
    EXPECT_NEAR(peak.gradient, 4, 1e-4);
    const auto jerk = best(knife(MoveGoal::jerk, length));
    EXPECT_NEAR(jerk.jerk, 32, 1e-2);
    EXPECT_NEAR(jerk.gradient, 8, 1e-2);
    EXPECT_LT(jerk.step, 1e-6);
  }
}

// With W the most that the ratio may leave its beginning, in mean departures: parabolas over 3/2 (1 - 1/W) of
// the way together; ramps over 1 - 1/W; S-curves over 1 - 1/W each.
TEST(DesignMove, ClosedFormsUnderALimitOfSpeed) {
  const double w = 1.2;
  auto problem = knife(MoveGoal::rms, 3);
  problem.limits.no_reverse = true;
  ASSERT_NEAR(problem.way / -problem.distance, w, 1e-9);
  const double rms_part = 1.5 * (1 - 1 / w);
  const double part = 1 - 1 / w;
  const auto rms = best(problem);
  EXPECT_NEAR(rms.squares, 8.0 / 3 * w * w / rms_part, 2e-3 * rms.squares);
  EXPECT_GE(rms.low, -1e-6);
  problem.goal = MoveGoal::peak;
  const auto peak = best(problem);
  EXPECT_NEAR(peak.gradient, w / part, 2e-3 * peak.gradient);
  EXPECT_GE(peak.low, -1e-6);
  problem.goal = MoveGoal::jerk;
  const auto jerk = best(problem);
  EXPECT_NEAR(jerk.jerk, 4 * w / (part * part), 5e-3 * jerk.jerk);
  EXPECT_GE(jerk.low, -1e-6);
}

TEST(DesignMove, ALimitOfSpeedIsKeptEitherWay) {
  auto problem = knife(MoveGoal::rms, 0.4);
  problem.limits.ratio = 1.9;
  const auto forward = best(problem);
  EXPECT_NEAR(forward.high, 1.9, 1e-4);
  EXPECT_LE(forward.high, 1.9 + 1e-7);
  problem.distance = -0.66;
  problem.way = 0.47;
  problem.limits.ratio = 1.05;
  const auto back = best(problem);
  EXPECT_NEAR(back.low, -1.05, 1e-4);
  EXPECT_GE(back.low, -1.05 - 1e-7);
}

// Where |a| may not pass A: A first, then a straight line through 0 in the middle. With u the part at A:
// distance 1 = A (1/4 - (1/2 - u)^2 / 3).
TEST(DesignMove, ClosedFormUnderALimitOfAcceleration) {
  auto problem = knife(MoveGoal::rms);
  const double a = 4.5;
  problem.limits.gradient = a * std::abs(problem.distance) / std::pow(problem.way, 2);
  const double left = std::sqrt(3 * (0.25 - 1 / a));
  const double squares = a * a * (1 - 2 * left) + 2 * a * a * left / 3;
  const auto m = best(problem);
  EXPECT_NEAR(m.squares, squares, 1e-3 * squares);
  EXPECT_LE(m.gradient, a * (1 + 1e-7));
}

// w'' = k^2 w - c: w = 1 - cosh(k (s - 1/2)) / cosh(k/2) but for its size.
TEST(DesignMove, ClosedFormWithViscousFriction) {
  auto problem = knife(MoveGoal::energy);
  const double k = 6;
  problem.friction.viscous = k / problem.way;
  const double half = k / 2;
  const double area = 1 - std::tanh(half) / half;
  const double squares =
      k * k / std::pow(std::cosh(half), 2) * (std::sinh(k) / (2 * k) - 0.5) / (area * area);
  const auto m = best(problem);
  EXPECT_NEAR(m.squares, squares, 1e-3 * squares);
  EXPECT_GT(m.squares, 12.2);
}

// With dry friction beside it going back costs more than standing.
TEST(DesignMove, DryFrictionKeepsItFromGoingBack) {
  auto problem = knife(MoveGoal::energy, 3);
  problem.friction.viscous = 1;
  const auto without = best(problem);
  problem.friction.coulomb = 20;
  const auto with = best(problem);
  EXPECT_LT(without.low, -0.1);
  EXPECT_GT(with.low, -0.02);
}

TEST(DesignMove, TravelIsKept) {
  auto problem = knife(MoveGoal::rms);
  problem.distance = -2;
  problem.way = 1.81;
  const auto free = best(problem);
  EXPECT_GT(free.farthest, 0.15);
  problem.limits.excursion = 0.06;
  const auto kept = best(problem);
  EXPECT_LE(kept.farthest, 0.06 * (1 + 1e-6));
  EXPECT_GT(kept.squares, free.squares);
}

TEST(DesignMove, StandsAtTheStepThatIsAskedFor) {
  auto problem = knife(MoveGoal::rms);
  problem.distance = -0.66;
  problem.way = 0.47;
  problem.still = 30;
  const auto move = best_move(problem);
  ASSERT_TRUE(move);
  const double width = problem.way / static_cast<double>(move->steps.size());
  double ratio = 1;
  for (int i = 0; i < 30; ++i) ratio += width * (move->steps[i].begin + move->steps[i].end) / 2;
  EXPECT_NEAR(ratio, 0, 1e-8);
}

// What an impossible job would need: 4 d/w^2 of acceleration; of speed the mean departure.
TEST(DesignMove, LeastLimits) {
  auto problem = knife(MoveGoal::gradient, 0.4);
  EXPECT_NEAR(best_move(problem)->value, 4 * 0.2 / (0.28 * 0.28), 1e-4);
  problem.goal = MoveGoal::ratio;
  EXPECT_NEAR(best_move(problem)->value, 1 + 0.2 / 0.28, 0.01);
  problem.goal = MoveGoal::violation;
  problem.limits.ratio = 1.5;
  EXPECT_NEAR(best_move(problem)->value, (1 + 0.2 / 0.28) / 1.5 - 1, 0.01);
  problem.limits.ratio = 1.9;
  EXPECT_LT(best_move(problem)->value, 1e-6);
}

TEST(DesignMove, ThereMayBeNone) {
  auto problem = knife(MoveGoal::rms, 0.4);
  problem.limits.ratio = 1.5;
  EXPECT_FALSE(best_move(problem));
}

}  // namespace
}  // namespace drycut::sim::studies
