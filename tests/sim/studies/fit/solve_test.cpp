#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <vector>

#include "plants/random.hpp"
#include "sim/studies/fit/solve.hpp"

namespace drycut::sim::studies {
namespace {

using Eigen::VectorXd;
using Columns = std::vector<VectorXd>;

constexpr Eigen::Index size = 400;

/// Waves, which are orthogonal: least squares are their projections.
VectorXd wave(int periods) {
  VectorXd all(size);
  for (Eigen::Index i = 0; i < size; ++i)
    all[i] = std::sin(2 * std::numbers::pi * periods * static_cast<double>(i) / static_cast<double>(size));
  return all;
}

VectorXd noise(double deviation, std::uint64_t seed) {
  plants::Random random(seed, "noise");
  VectorXd all(size);
  for (Eigen::Index i = 0; i < size; ++i) all[i] = deviation * random.gaussian();
  return all;
}

VectorXd sum_of(const Columns& columns, const std::vector<double>& values) {
  VectorXd sum = VectorXd::Zero(size);
  for (std::size_t k = 0; k < columns.size(); ++k) sum += values[k] * columns[k];
  return sum;
}

FitSolution solved(const Columns& columns, const VectorXd& measured, const std::vector<double>& starts) {
  std::vector<FitUnknown> unknowns;
  for (const double start : starts) unknowns.push_back({start, -1e3, 1e3});
  const auto residuals = [&](const std::vector<std::vector<double>>& sets) {
    std::vector<Residuals> all;
    for (const auto& set : sets) all.push_back({sum_of(columns, set) - measured});
    return all;
  };
  return solve_fit(unknowns, residuals, measured.norm());
}

TEST(FitSolve, IsLeastSquaresOfAStraightProblem) {
  const Columns columns = {wave(1), wave(2), wave(3)};
  const VectorXd measured = sum_of(columns, {2, -1, 0.5}) + noise(0.1, 1);
  const auto found = solved(columns, measured, {1, 1, 1});
  std::vector<double> exact;
  for (const auto& column : columns) exact.push_back(column.dot(measured) / column.squaredNorm());
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& one = found.estimates[i];
    EXPECT_NEAR(one.value, exact[i], 1e-6);
    EXPECT_EQ(one.known, FitKnown::yes);
    // White noise: 2.27 deviations of 0.1 / |column|, and what Newey and West scatter by.
    const double half = (one.high - one.low) / 2;
    const double expected = 2.27 * 0.1 / columns[i].norm();
    EXPECT_GT(half, 0.5 * expected);
    EXPECT_LT(half, 1.6 * expected);
  }
  EXPECT_NEAR(found.norm, (sum_of(columns, exact) - measured).norm(), 1e-6);
}

TEST(FitSolve, LimitsOfResidualsThatGoTogetherAreWider) {
  const Columns columns = {VectorXd::Ones(size)};
  VectorXd measured = VectorXd::Constant(size, 2);
  const VectorXd white = noise(0.1, 2);
  double slow = 0;
  for (Eigen::Index i = 0; i < size; ++i) measured[i] += slow = 0.9 * slow + white[i];
  const auto found = solved(columns, measured, {1});
  const double half = (found.estimates[0].high - found.estimates[0].low) / 2;
  // The mean of an autoregression: deviation / (1 - 0.9) / root n, ten times that of white noise.
  const double true_half = 1.96 * 0.1 / (1 - 0.9) / std::sqrt(static_cast<double>(size));
  EXPECT_GT(half, 0.4 * true_half);
  EXPECT_LT(half, 2 * true_half);
}

TEST(FitSolve, ColumnsThatAreOneAreJoined) {
  const Columns columns = {wave(1), wave(2), 2 * wave(1)};
  const VectorXd measured = sum_of(columns, {1, -1, 0.5}) + noise(0.1, 4);
  const auto found = solved(columns, measured, {0.5, -0.5, 0.2});
  EXPECT_EQ(found.estimates[0].known, FitKnown::joined);
  EXPECT_EQ(found.estimates[0].with, std::vector<std::size_t>{2});
  EXPECT_EQ(found.estimates[1].known, FitKnown::yes);
  EXPECT_EQ(found.estimates[2].with, std::vector<std::size_t>{0});
  EXPECT_GT(found.condition, 1e6);
}

TEST(FitSolve, WhatNothingDependsOnIsNotKnown) {
  const Columns columns = {wave(1), VectorXd::Zero(size)};
  const VectorXd measured = columns[0] + noise(0.1, 5);
  const auto found = solved(columns, measured, {0.5, 1});
  EXPECT_EQ(found.estimates[0].known, FitKnown::yes);
  EXPECT_EQ(found.estimates[1].known, FitKnown::no);
}

TEST(FitSolve, ValuesStayWithinTheirRange) {
  const VectorXd column = VectorXd::Ones(size);
  const VectorXd measured = VectorXd::Constant(size, -5) + noise(0.1, 6);
  const auto residuals = [&](const std::vector<std::vector<double>>& sets) {
    std::vector<Residuals> all;
    for (const auto& set : sets) {
      EXPECT_GE(set[0], 0);
      all.push_back({column * set[0] - measured});
    }
    return all;
  };
  EXPECT_EQ(solve_fit({{1, 0, 10}}, residuals, measured.norm()).estimates[0].value, 0);
}

// What is held is no column: it makes no condition, and is as it was.
TEST(FitSolve, AHeldValueIsNoPartOfIt) {
  const Columns columns = {wave(1), wave(2), wave(3)};
  const VectorXd measured = sum_of(columns, {2, -1, 0.5}) + noise(0.01, 1);
  const auto residuals = [&](const std::vector<std::vector<double>>& sets) {
    std::vector<Residuals> all;
    for (const auto& set : sets) all.push_back({sum_of(columns, set) - measured});
    return all;
  };
  const auto found = solve_fit({{1, -10, 10}, {-1, -1, -1}, {1, -10, 10}}, residuals, measured.norm());
  EXPECT_NEAR(found.condition, 1, 1e-3);
  EXPECT_NEAR(found.estimates[0].value, 2, 0.01);
  EXPECT_EQ(found.estimates[1].value, -1);
  EXPECT_NEAR(found.estimates[2].value, 0.5, 0.01);
  const auto none = solve_fit({{2, 2, 2}, {-1, -1, -1}, {0.5, 0.5, 0.5}}, residuals, measured.norm());
  EXPECT_NEAR(none.norm, (sum_of(columns, {2, -1, 0.5}) - measured).norm(), 1e-9);
}

// A friction of 0.001 +- 0.01 is known to be small; a mass that wide is not known.
TEST(FitSolve, WhatIsNeverZeroNeedsLimitsNarrowerThanItself) {
  const Columns columns = {wave(1), 1e-3 * wave(2)};
  const VectorXd measured = sum_of(columns, {1, 0.5}) + noise(0.01, 1);
  const auto residuals = [&](const std::vector<std::vector<double>>& sets) {
    std::vector<Residuals> all;
    for (const auto& set : sets) all.push_back({sum_of(columns, set) - measured});
    return all;
  };
  const auto of = [&](bool never_zero) {
    return solve_fit({{1, 0, 10}, {1, 0, 10, never_zero}}, residuals, measured.norm()).estimates[1].known;
  };
  EXPECT_EQ(of(false), FitKnown::yes);
  EXPECT_EQ(of(true), FitKnown::no);
}

}  // namespace
}  // namespace drycut::sim::studies
