#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "devices/camming4/laws.hpp"
#include "tests/devices/camming4/cam_bench.hpp"

namespace drycut::devices::camming4 {
namespace {

struct Trajectory {
  const char* name;
  int radius;
  Turn turn;
};
// 000 1.2.4.1: R 26, dX 15, dY -33.
constexpr Trajectory trajectories[] = {{"I", -26, Turn::counterclockwise},
                                       {"II", 26, Turn::counterclockwise},
                                       {"III", 26, Turn::clockwise},
                                       {"IV", -26, Turn::clockwise}};

TEST(CamArc, FourTrajectoriesOfTheManualJoinThePointsOnTheRadius) {
  for (const Trajectory& trajectory : trajectories) {
    SCOPED_TRACE(trajectory.name);
    const Arc arc = make_arc(trajectory.radius, 15, -33, trajectory.turn);
    EXPECT_NEAR(at(arc, ArcAxis::x, 0, 0).position, 0, tolerance);
    EXPECT_NEAR(at(arc, ArcAxis::y, 0, 0).position, 0, tolerance);
    EXPECT_NEAR(at(arc, ArcAxis::x, arc.length, 0).position, 15, tolerance);
    EXPECT_NEAR(at(arc, ArcAxis::y, arc.length, 0).position, -33, tolerance);
    for (int i = 0; i <= 10; ++i) {
      const CamMotion x = at(arc, ArcAxis::x, arc.length * i / 10, 0);
      const CamMotion y = at(arc, ArcAxis::y, arc.length * i / 10, 0);
      EXPECT_NEAR(std::hypot(x.position - arc.centre_x, y.position - arc.centre_y), 26, tolerance);
      EXPECT_NEAR(std::hypot(x.velocity, y.velocity), 1, tolerance);
      // Left turns are counterclockwise.
      const double turning = x.velocity * y.acceleration - y.velocity * x.acceleration;
      EXPECT_NEAR(turning, (trajectory.turn == Turn::counterclockwise ? 1 : -1) / 26.0, tolerance);
    }
  }
}

TEST(CamArc, SignOfTheRadiusChoosesTheShortOrTheLongWay) {
  const double chord = std::hypot(15.0, 33.0);
  const double least = 2 * std::asin(chord / 52);
  for (const Trajectory& trajectory : trajectories) {
    const Arc arc = make_arc(trajectory.radius, 15, -33, trajectory.turn);
    EXPECT_NEAR(arc.sweep, trajectory.radius > 0 ? least : 2 * pi - least, tolerance);
    EXPECT_NEAR(arc.length, 26 * arc.sweep, tolerance);
  }
}

TEST(CamArc, TwoCirclesCarryTheFourTrajectories) {
  const auto centre = [](int radius, Turn turn) { return make_arc(radius, 15, -33, turn).centre_x; };
  EXPECT_NEAR(centre(26, Turn::counterclockwise), centre(-26, Turn::clockwise), tolerance);
  EXPECT_NEAR(centre(-26, Turn::counterclockwise), centre(26, Turn::clockwise), tolerance);
  EXPECT_GT(std::abs(centre(26, Turn::counterclockwise) - centre(26, Turn::clockwise)), 1);
}

TEST(CamArc, QuarterCircleInClosedForm) {
  // From the lowest point of the unit of 100 about (0, 100), to the right: x = R sin a, y = R (1 - cos a).
  const Arc arc = make_arc(100, 100, 100, Turn::counterclockwise);
  EXPECT_NEAR(arc.length, 50 * pi, tolerance);
  for (const double a : {0.0, 0.3, 1.0, pi / 2}) {
    EXPECT_NEAR(at(arc, ArcAxis::x, 100 * a, 0).position, 100 * std::sin(a), tolerance);
    EXPECT_NEAR(at(arc, ArcAxis::y, 100 * a, 0).position, 100 * (1 - std::cos(a)), tolerance);
    EXPECT_NEAR(at(arc, ArcAxis::x, 100 * a, 0).velocity, std::cos(a), tolerance);
    EXPECT_NEAR(at(arc, ArcAxis::y, 100 * a, 0).velocity, std::sin(a), tolerance);
    EXPECT_NEAR(at(arc, ArcAxis::x, 100 * a, 0).acceleration, -std::sin(a) / 100, tolerance);
    EXPECT_NEAR(at(arc, ArcAxis::x, 100 * a, 0).jerk, -std::cos(a) / 1e4, tolerance);
    EXPECT_NEAR(at(arc, ArcAxis::y, 100 * a, 0).jerk, -std::sin(a) / 1e4, tolerance);
  }
}

TEST(CamArc, TangentAxisTurnsThroughTheSweep) {
  const Arc quarter = make_arc(100, 100, 100, Turn::clockwise);
  EXPECT_NEAR(at(quarter, ArcAxis::tangent, quarter.length, 3600).position, -900, tolerance);
  EXPECT_NEAR(at(quarter, ArcAxis::tangent, 0, 3600).velocity, -3600 / (2 * pi * 100), tolerance);
  const Arc rest = make_arc(-100, 100, 100, Turn::counterclockwise);
  EXPECT_NEAR(at(rest, ArcAxis::tangent, rest.length, 360).position, 270, tolerance);
}

TEST(CamArc, ErrorsAreDecidedExactly) {
  EXPECT_EQ(arc_error(5, 6, 8), 0);   // chord 10 = 2R
  EXPECT_EQ(arc_error(5, 6, 9), 50);  // just longer
  EXPECT_EQ(arc_error(-5, -6, 8), 0);
  EXPECT_EQ(arc_error(159154, 318308, 0), 0);
  EXPECT_EQ(arc_error(159154, 318308, 1), 50);
  EXPECT_EQ(arc_error(0, 1, 0), 50);
  EXPECT_EQ(arc_error(1, 0, 0), 51);
  EXPECT_EQ(arc_error(-1, 0, 0), 51);
  EXPECT_EQ(arc_error(0, 0, 0), 0);
  constexpr int least = std::numeric_limits<std::int32_t>::min();
  EXPECT_EQ(arc_error(least, least, least), 0);
  EXPECT_EQ(arc_error(1, least, least), 50);
}

TEST(CamArc, PeaksAreThoseOfTheSampledSpeed) {
  for (const Trajectory& trajectory : trajectories)
    for (const ArcAxis axis : {ArcAxis::x, ArcAxis::y}) {
      const Arc arc = make_arc(trajectory.radius, 15, -33, trajectory.turn);
      double growing = 0;
      double falling = 0;
      for (int i = 0; i <= 20000; ++i) {
        const CamMotion motion = at(arc, axis, arc.length * i / 20000, 0);
        double& most = motion.velocity * motion.acceleration > 0 ? growing : falling;
        most = std::max(most, std::abs(motion.acceleration));
      }
      EXPECT_NEAR(peak_acceleration(arc, axis), growing, 1e-4) << trajectory.name;
      EXPECT_NEAR(peak_deceleration(arc, axis), falling, 1e-4) << trajectory.name;
    }
}

}  // namespace
}  // namespace drycut::devices::camming4
