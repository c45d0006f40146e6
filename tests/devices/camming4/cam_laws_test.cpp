#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "devices/camming4/laws.hpp"

namespace drycut::devices::camming4 {
namespace {

/// Simpson's rule over an even number of pieces: independent of the laws' own integrals.
double integral(const std::function<double(double)>& f, double a, double b, int pieces = 2000) {
  const double h = (b - a) / pieces;
  double sum = f(a) + f(b);
  for (int i = 1; i < pieces; ++i) sum += (i % 2 == 1 ? 4 : 2) * f(a + i * h);
  return sum * h / 3;
}

/// Velocity, acceleration and jerk are the derivatives of the position, at inner points of every ramp.
void expect_consistent(const Law& law) {
  for (int i = 0; i < law.count; ++i) {
    const double from = law.ramps[static_cast<std::size_t>(i)].from;
    const double to = i + 1 < law.count ? law.ramps[static_cast<std::size_t>(i + 1)].from : law.length;
    for (const double u : {0.1, 0.37, 0.5, 0.83}) {
      const double m = from + u * (to - from);
      const double h = (to - from) * 1e-4;
      const CamMotion before = at(law, m - h);
      const CamMotion here = at(law, m);
      const CamMotion after = at(law, m + h);
      EXPECT_NEAR((after.position - before.position) / (2 * h), here.velocity, 1e-5);
      EXPECT_NEAR((after.velocity - before.velocity) / (2 * h), here.acceleration, 1e-5);
      EXPECT_NEAR((after.acceleration - before.acceleration) / (2 * h), here.jerk, 1e-5);
    }
  }
}

void expect_area(const Law& law, double slave) {
  EXPECT_NEAR(at(law, law.length).position, slave, tolerance);
  // Piece by piece, so that a corner of the speed lies on a node.
  double area = 0;
  for (int i = 0; i < law.count; ++i) {
    const double from = law.ramps[static_cast<std::size_t>(i)].from;
    const double to = i + 1 < law.count ? law.ramps[static_cast<std::size_t>(i + 1)].from : law.length;
    area +=
        integral([&](double m) { return at(law.ramps[static_cast<std::size_t>(i)], m).velocity; }, from, to);
  }
  EXPECT_NEAR(area, slave, tolerance);
}

TEST(CamLaws, SingleRampIsTheParabolaOfItsSpaces) {
  // v = v0 + 2(S/M - v0)u, s = M(v0 u + (S/M - v0)u2), written down from the two conditions s(0)=0, s(M)=S.
  const double M = 160;
  const double S = 130;
  for (const double v0 : {0.0, 0.5, -0.75, 1.625}) {
    const Law law = single_ramp(M, S, v0, Shape::straight);
    for (const double u : {0.0, 0.1, 0.5, 0.9, 1.0}) {
      const CamMotion motion = at(law, u * M);
      EXPECT_NEAR(motion.position, v0 * u * M + (S - v0 * M) * u * u, tolerance);
      EXPECT_NEAR(motion.velocity, v0 + 2 * (S / M - v0) * u, tolerance);
      EXPECT_NEAR(motion.acceleration, 2 * (S / M - v0) / M, tolerance);
      EXPECT_EQ(motion.jerk, 0);
    }
    EXPECT_NEAR(law.exit_speed, 2 * S / M - v0, tolerance);
    EXPECT_NEAR(law.mid_speed, S / M, tolerance);
    expect_area(law, S);
  }
}

TEST(CamLaws, TwoPhasesMeetAtHalfTheMasterSpace) {
  // The speed in the middle from the area of the two trapezia: M/4 (v0 + vm) + M/4 (vm + v1) = S.
  const double M = 200;
  for (const double S : {120.0, 340.0, -50.0})
    for (const double v0 : {0.0, 1.0, -0.4})
      for (const double v1 : {0.0, 1.0, 2.5}) {
        const Law law = two_phase(M, S, v0, v1, Shape::straight);
        const double middle = (4 * S / M - v0 - v1) / 2;
        EXPECT_NEAR(law.mid_speed, middle, tolerance);
        EXPECT_NEAR(at(law, 0).velocity, v0, tolerance);
        EXPECT_NEAR(at(law, M / 4).velocity, (v0 + middle) / 2, tolerance);
        EXPECT_NEAR(at(law, M / 4).position, M / 4 * (v0 + (v0 + middle) / 2) / 2, tolerance);
        EXPECT_NEAR(at(law, M / 2).velocity, middle, tolerance);
        EXPECT_NEAR(at(law, M / 2).position, M / 4 * (v0 + middle), tolerance);
        EXPECT_NEAR(at(law, 3 * M / 4).velocity, (v1 + middle) / 2, tolerance);
        EXPECT_NEAR(at(law, 3 * M / 4).position, S - M / 4 * (v1 + (v1 + middle) / 2) / 2, tolerance);
        EXPECT_NEAR(at(law, M).velocity, v1, tolerance);
        EXPECT_NEAR(at(law, 0.6 * M).acceleration, (v1 - middle) / (M / 2), tolerance);
        expect_area(law, S);
        expect_consistent(law);
      }
}

TEST(CamLaws, CycloidTakesTheRampsMasterAndSlaveSpaceWithTwiceThePeak) {
  for (const double v0 : {0.0, 0.3, 1.2}) {
    const Law straight = single_ramp(90, 60, v0, Shape::straight);
    const Law cycloid = single_ramp(90, 60, v0, Shape::cycloidal);
    EXPECT_NEAR(at(cycloid, 90).position, 60, tolerance);
    EXPECT_NEAR(cycloid.exit_speed, straight.exit_speed, tolerance);
    EXPECT_NEAR(at(cycloid, 90).velocity, straight.exit_speed, tolerance);
    EXPECT_NEAR(at(cycloid, 45).velocity, at(straight, 45).velocity, tolerance);
    EXPECT_NEAR(at(cycloid, 45).acceleration, 2 * at(straight, 45).acceleration, tolerance);
    EXPECT_NEAR(at(cycloid, 0).acceleration, 0, tolerance);
    EXPECT_NEAR(at(cycloid, 90).acceleration, 0, tolerance);
    expect_area(cycloid, 60);
    expect_consistent(cycloid);
  }
}

TEST(CamLaws, CycloidIsRaisedCosineAcceleration) {
  // a = dv/M (1 - cos 2 pi u), integrated numerically, twice.
  const Law law = single_ramp(50, 40, 0.5, Shape::cycloidal);
  const double change = law.exit_speed - 0.5;
  const auto acceleration = [&](double m) {
    return change / 50 * (1 - std::cos(2 * std::numbers::pi * m / 50));
  };
  const auto velocity = [&](double m) { return 0.5 + integral(acceleration, 0, m, 400); };
  for (const double m : {5.0, 12.5, 25.0, 33.0, 49.0}) {
    EXPECT_NEAR(at(law, m).acceleration, acceleration(m), tolerance);
    EXPECT_NEAR(at(law, m).velocity, velocity(m), tolerance);
    EXPECT_NEAR(at(law, m).position, integral(velocity, 0, m, 400), tolerance);
    EXPECT_NEAR(at(law, m).jerk,
                change / 50 * 2 * std::numbers::pi / 50 * std::sin(2 * std::numbers::pi * m / 50), tolerance);
  }
}

TEST(CamLaws, TwoCycloidsKeepSpacesAndEndSpeeds) {
  const Law law = two_phase(200, 120, 1, 0, Shape::cycloidal);
  expect_area(law, 120);
  expect_consistent(law);
  EXPECT_NEAR(at(law, 100).velocity, 2 * 120 / 200.0 - 0.5, tolerance);
  EXPECT_NEAR(at(law, 100).acceleration, 0, tolerance);
  EXPECT_NEAR(at(law, 50).acceleration, 2 * (0.7 - 1) / 100, tolerance);
}

TEST(CamLaws, FittedIsOneRampWhenTheSpaceMatches) {
  EXPECT_EQ(fitted(100, 50, 0, 1, 0.1, Shape::straight).count, 1);
  EXPECT_EQ(fitted(100, 50, 0, 1, 0.1, Shape::cycloidal).count, 1);
  EXPECT_EQ(fitted(100, 51, 0, 1, 0.1, Shape::cycloidal).count, 2);
  EXPECT_EQ(fitted(100, 51, 0, 1, 0.1, Shape::straight).count, 2);
}

TEST(CamLaws, CycloidWithinToleranceStillEndsOnItsSpaceAndSpeed) {
  const Law law = fitted(100, 50.08, 0, 1, 0.1, Shape::cycloidal);
  ASSERT_EQ(law.count, 1);
  expect_area(law, 50.08);
  expect_consistent(law);
  EXPECT_NEAR(at(law, 0).velocity, 0, tolerance);
  EXPECT_NEAR(at(law, 100).velocity, 1, tolerance);
  EXPECT_NEAR(at(law, 0).acceleration, 0, tolerance);
  EXPECT_NEAR(at(law, 100).acceleration, 0, tolerance);
}

TEST(CamLaws, JoinedLawGoesOnWhereTheFirstEnds) {
  const Law law = joined(two_phase(40, 30, 0, 2, Shape::straight), 30, constant(60, 2));
  EXPECT_NEAR(at(law, 40).position, 30, tolerance);
  EXPECT_NEAR(at(law, 70).position, 30 + 60, tolerance);
  EXPECT_NEAR(law.length, 100, tolerance);
  expect_area(law, 30 + 120);
}

TEST(CamLaws, SofteningIsOneRampAcrossTheBoundary) {
  for (const Shape shape : {Shape::straight, Shape::cycloidal}) {
    const Softening change{20, 1.5, shape};
    const Law before = softened(100, 0.5, {}, change);
    const Law after = softened(80, 2, change, {});
    EXPECT_NEAR(at(before, 80).position, 40, tolerance);
    EXPECT_NEAR(at(before, 80).velocity, 0.5, tolerance);
    EXPECT_NEAR(at(before, 100).velocity, 1.25, tolerance);
    EXPECT_NEAR(at(after, 0).velocity, 1.25, tolerance);
    EXPECT_NEAR(at(before, 100).position - 50, at(after, 0).position, tolerance);
    EXPECT_NEAR(at(after, 20).velocity, 2, tolerance);
    EXPECT_NEAR(at(after, 20).position, 40, tolerance);
    EXPECT_NEAR(at(after, 80).position, 160, tolerance);
    expect_consistent(before);
    expect_consistent(after);
  }
  // Straight: the area between ramp and step is a triangle of width w and height change/2.
  EXPECT_NEAR(at(softened(100, 0.5, {}, {20, 1.5, Shape::straight}), 100).position - 50, 20 * 0.75 / 2,
              tolerance);
}

TEST(CamLaws, PeaksTellGrowingFromFallingSpeed) {
  const Law up = single_ramp(100, 50, 0, Shape::straight);
  EXPECT_NEAR(peak_acceleration(up), 0.01, tolerance);
  EXPECT_EQ(peak_deceleration(up), 0);
  const Law down = single_ramp(100, 50, 1, Shape::cycloidal);
  EXPECT_EQ(peak_acceleration(down), 0);
  EXPECT_NEAR(peak_deceleration(down), 0.02, tolerance);
  const Law backwards = single_ramp(100, -50, 0, Shape::straight);
  EXPECT_NEAR(peak_acceleration(backwards), 0.01, tolerance);
}

TEST(CamLaws, PeaksOfACycloidThroughZeroAreThoseOfItsTwoParts) {
  const Law law = single_ramp(100, 40, -0.6, Shape::cycloidal);  // -0.6 .. 1.4
  double growing = 0;
  double falling = 0;
  for (int i = 0; i <= 100000; ++i) {
    const CamMotion motion = at(law, i * 1e-3);
    double& most = motion.velocity * motion.acceleration > 0 ? growing : falling;
    most = std::max(most, std::abs(motion.acceleration));
  }
  EXPECT_NEAR(peak_acceleration(law), growing, 1e-6);
  EXPECT_NEAR(peak_deceleration(law), falling, 1e-5);
  EXPECT_LT(falling, growing);
}

TEST(CamLaws, RoundingOfSpeedsDoesNotSurviveASector) {
  const double third = 1.0 / 3;
  EXPECT_EQ(single_ramp(3, 1, third * (1 + 1e-15), Shape::straight).exit_speed, third);
  EXPECT_EQ(single_ramp(100, 15, 0.1 + 0.2, Shape::straight).exit_speed, 0);
}

}  // namespace
}  // namespace drycut::devices::camming4
