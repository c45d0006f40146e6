#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "plants/random.hpp"
#include "sim/studies/fit/solve.hpp"

namespace drycut::sim::studies {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Eigen::Index size = 400;

/// Columns that have nothing to do with each other.
MatrixXd random_columns(Eigen::Index columns) {
  plants::Random random(3, "columns");
  MatrixXd all(size, columns);
  for (double& one : all.reshaped()) one = random.gaussian();
  return all;
}

VectorXd noise(double deviation, std::uint64_t seed) {
  plants::Random random(seed, "noise");
  VectorXd all(size);
  for (double& one : all) one = deviation * random.gaussian();
  return all;
}

FitSolution solved(const MatrixXd& columns, const VectorXd& measured, const std::vector<double>& starts) {
  std::vector<FitUnknown> unknowns;
  for (const double start : starts) unknowns.push_back({start, -1e3, 1e3});
  const auto residuals = [&](const std::vector<std::vector<double>>& sets) {
    std::vector<Residuals> all;
    for (const auto& set : sets)
      all.push_back({columns * Eigen::Map<const VectorXd>(set.data(), std::ssize(set)) - measured});
    return all;
  };
  return solve_fit(unknowns, residuals, measured.norm());
}

TEST(FitSolve, IsLeastSquaresOfAStraightProblem) {
  const MatrixXd columns = random_columns(3);
  const VectorXd measured = columns * Eigen::Vector3d(2, -1, 0.5) + noise(0.1, 1);
  const auto found = solved(columns, measured, {1, 1, 1});
  const VectorXd exact = columns.colPivHouseholderQr().solve(measured);
  for (int i = 0; i < 3; ++i) {
    const auto& one = found.estimates[static_cast<std::size_t>(i)];
    EXPECT_NEAR(one.value, exact[i], 1e-6);
    EXPECT_EQ(one.known, FitKnown::yes);
    // White noise: 2.27 deviations of 0.1 / |column|, and what Newey and West scatter by.
    const double half = (one.high - one.low) / 2;
    const double expected = 2.27 * 0.1 / columns.col(i).norm();
    EXPECT_GT(half, 0.5 * expected);
    EXPECT_LT(half, 1.6 * expected);
  }
  EXPECT_NEAR(found.norm, (columns * exact - measured).norm(), 1e-6);
}

TEST(FitSolve, LimitsOfResidualsThatGoTogetherAreWider) {
  const MatrixXd columns = MatrixXd::Ones(size, 1);
  VectorXd measured = VectorXd::Constant(size, 2);
  const VectorXd white = noise(0.1, 2);
  double slow = 0;
  for (Eigen::Index i = 0; i < size; ++i) measured[i] += slow = 0.9 * slow + white[i];
  const auto found = solved(columns, measured, {1});
  const double half = (found.estimates[0].high - found.estimates[0].low) / 2;
  // The mean of an autoregression: deviation / (1 - 0.9) / root n, ten times that of white noise.
  const double true_half = 1.96 * 0.1 / (1 - 0.9) / std::sqrt(static_cast<double>(size));
  EXPECT_GT(half, 0.5 * true_half);
  EXPECT_LT(half, 2 * true_half);
}

TEST(FitSolve, ColumnsThatAreOneAreJoined) {
  MatrixXd columns = random_columns(3);
  columns.col(2) = 2 * columns.col(0);
  const VectorXd measured = columns * Eigen::Vector3d(1, -1, 0.5) + noise(0.1, 4);
  const auto found = solved(columns, measured, {0.5, -0.5, 0.2});
  EXPECT_EQ(found.estimates[0].known, FitKnown::joined);
  EXPECT_EQ(found.estimates[0].with, std::vector<std::size_t>{2});
  EXPECT_EQ(found.estimates[1].known, FitKnown::yes);
  EXPECT_EQ(found.estimates[2].with, std::vector<std::size_t>{0});
  EXPECT_GT(found.condition, 1e6);
}

TEST(FitSolve, WhatNothingDependsOnIsNotKnown) {
  MatrixXd columns = random_columns(2);
  columns.col(1).setZero();
  const VectorXd measured = columns.col(0) + noise(0.1, 5);
  const auto found = solved(columns, measured, {0.5, 1});
  EXPECT_EQ(found.estimates[0].known, FitKnown::yes);
  EXPECT_EQ(found.estimates[1].known, FitKnown::no);
}

TEST(FitSolve, ValuesStayWithinTheirRange) {
  const MatrixXd columns = MatrixXd::Ones(size, 1);
  const VectorXd measured = VectorXd::Constant(size, -5) + noise(0.1, 6);
  const auto residuals = [&](const std::vector<std::vector<double>>& sets) {
    std::vector<Residuals> all;
    for (const auto& set : sets) {
      EXPECT_GE(set[0], 0);
      all.push_back({columns * set[0] - measured});
    }
    return all;
  };
  EXPECT_EQ(solve_fit({{1, 0, 10}}, residuals, measured.norm()).estimates[0].value, 0);
}

}  // namespace
}  // namespace drycut::sim::studies
