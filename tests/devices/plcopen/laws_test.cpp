#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "devices/plcopen/cam_table.hpp"
#include "tests/devices/plcopen/covers.hpp"

namespace drycut::devices::plcopen {
namespace {

constexpr double turn = 3'600'000;

McCamTable slaves(std::vector<double> values) {
  return {.file = {}, .name = {}, .id = 1, .type = 3, .values = std::move(values)};
}
McCamTable pairs(std::vector<double> values) {
  return {.file = {}, .name = {}, .id = 1, .type = 7, .values = std::move(values)};
}

CamCurve curve(const McCamTable& table, Interpolation type, Endless endless = Endless::no) {
  return curve_of(table, type, turn, turn, endless);
}

/// The curve over several turns, unwrapped.
double position(const CamCurve& cam, double x) {
  const double turns = std::floor(x / cam.master_length);
  return at(cam, x - turns * cam.master_length).position + turns * cam.slave_length;
}

/// Velocity, acceleration and jerk are the derivatives of the position inside every segment.
void expect_consistent(const CamCurve& cam) {
  for (const CamPiece& segment : cam.pieces) {
    const double h = segment.length * 1e-4;
    for (const double u : {0.13, 0.5, 0.77}) {
      const double x = segment.master + u * segment.length;
      if (x < h || x + h >= cam.master_length) continue;
      const CamMotion before = at(cam, x - h);
      const CamMotion here = at(cam, x);
      const CamMotion after = at(cam, x + h);
      const double scale = 1 + std::abs(here.velocity);
      EXPECT_NEAR((after.position - before.position) / (2 * h), here.velocity, 1e-6 * scale);
      EXPECT_NEAR((after.velocity - before.velocity) / (2 * h) * segment.length,
                  here.acceleration * segment.length, 1e-6 * scale);
      EXPECT_NEAR((after.acceleration - before.acceleration) / (2 * h) * segment.length * segment.length,
                  here.jerk * segment.length * segment.length, 1e-4 * scale);
    }
  }
}

TEST(PlcopenLaws, StepDirectHoldsTheIntervalsValue) {
  const CamCurve cam = curve(slaves({10, 20, 40, 30}), Interpolation::step_direct);
  for (const double u : {0.0, 0.3, 0.999}) EXPECT_EQ(at(cam, (2 + u) * turn / 4).position, 40);
  EXPECT_EQ(at(cam, turn - 1).position, 30);
  EXPECT_EQ(at(cam, 0).position, 10);
  EXPECT_EQ(at(cam, turn / 3).velocity, 0);
  covers({"STEP_DIRECT"});
}

TEST(PlcopenLaws, LinearIsTheChordAndClosesToItsStart) {
  const CamCurve cam = curve(slaves({0, 900, 300}), Interpolation::linear);
  EXPECT_EQ(at(cam, 400'000).position, 300);
  EXPECT_EQ(at(cam, 1'200'000).position, 900);
  EXPECT_EQ(at(cam, 1'800'000).position, 600);
  EXPECT_EQ(at(cam, 3'000'000).position, 150);
  EXPECT_DOUBLE_EQ(at(cam, 100).velocity, 900 / 1.2e6);
  EXPECT_EQ(cam.turns, 0);
  covers({"LINEAR"});
}

TEST(PlcopenLaws, PolynomThreeIsTheBezierOfFourNeighbours) {
  const std::vector<double> s{0, 100, 500, 300, 250, 80};
  const CamCurve cam = curve(slaves(s), Interpolation::polynom_3);
  const double h = turn / 6;
  for (std::size_t i = 0; i < 6; ++i) {
    const double before = s[(i + 5) % 6];
    const double here = s[i];
    const double next = s[(i + 1) % 6];
    const double after = s[(i + 2) % 6];
    EXPECT_EQ(at(cam, static_cast<double>(i) * h).position, here);
    // The middle by De Casteljau of b0, b1 = here + (next-before)/6, b2 = next - (after-here)/6, b3.
    EXPECT_NEAR(at(cam, (static_cast<double>(i) + 0.5) * h).position,
                (9 * (here + next) - before - after) / 16, 1e-9);
    EXPECT_NEAR(at(cam, static_cast<double>(i) * h).velocity, (next - before) / (2 * h), 1e-15);
  }
  expect_consistent(cam);
  covers({"POLYNOM_3"});
}

TEST(PlcopenLaws, PolynomThreeIsNoNaturalSpline) {
  // It is C1 only: at its knots the acceleration jumps, which no spline's does; and a far point does not
  // reach an interval.
  const CamCurve cam = curve(slaves({0, 0, 1000, 0, 0, 0, 0, 0}), Interpolation::polynom_3);
  const double h = turn / 8;
  const double left = cam.pieces[0].end().acceleration;
  const double right = cam.pieces[1].begin().acceleration;

  EXPECT_NEAR((right - left) * h * h, 2000, 1e-9);
  EXPECT_NEAR(cam.pieces[0].end().velocity, cam.pieces[1].begin().velocity, 1e-15);
  EXPECT_EQ(at(cam, 5.5 * h).position, 0);
  EXPECT_NE(at(cam, 3.5 * h).position, 0);
}

TEST(PlcopenLaws, CoefficientsAreOfTheLocalShare) {
  McCamTable table{.file = {}, .name = {}, .id = 1, .type = 5, .values = {1, 2, 3, 4, 10, 0, 0, -5}};
  const CamCurve cam = curve(table, Interpolation::polynom_3_koeff);
  EXPECT_EQ(at(cam, 0).position, 1);
  EXPECT_DOUBLE_EQ(at(cam, turn / 4).position, 1 + 2 * 0.5 + 3 * 0.25 + 4 * 0.125);
  EXPECT_EQ(at(cam, turn / 2).position, 10);
  EXPECT_DOUBLE_EQ(at(cam, 0.75 * turn).position, 10 - 5 * 0.125);
  EXPECT_DOUBLE_EQ(at(cam, 0).velocity, 2 / (turn / 2));
  expect_consistent(cam);
  covers({"POLYNOM_3_KOEFF"});
}

TEST(PlcopenLaws, Poly5LineArrivesAtTheFirstPointWithTheQuintic) {
  // Lines in [P0,P1] and [P2,P3], quintics in [P1,P2] and [P3,P0].
  const std::vector<double> table{100'000, 0, 1'000'000, 0, 1'900'000, 900'000, 2'800'000, 900'000};
  const CamCurve cam = curve(pairs(table), Interpolation::poly5_line);
  EXPECT_EQ(at(cam, 500'000).position, 0);
  EXPECT_EQ(at(cam, 500'000).velocity, 0);
  EXPECT_EQ(at(cam, 2'500'000).position, 900'000);
  // Rest to rest: the 3-4-5 polynomial, half-way at the middle, with 15/8 of the mean slope.
  EXPECT_NEAR(at(cam, 1'450'000).position, 450'000, 1e-6);
  EXPECT_NEAR(at(cam, 1'450'000).velocity, 15.0 / 8, 1e-12);
  const CamCurve other = curve(pairs(table), Interpolation::line_poly5);
  EXPECT_NEAR(at(other, 1'450'000).velocity, 1, 1e-12);
  EXPECT_NEAR(at(other, 3'250'000).velocity, -1, 1e-12);
  EXPECT_NE(at(other, 300'000).position, 0);
  covers({"POLY5_LINE", "LINE_POLY5"});
}

TEST(PlcopenLaws, TheQuinticBetweenTwoLinesMeetsTheHandCheck) {
  const CamCurve cam = curve(pairs({0, 0, 600'000, 300'000, 1'800'000, 2'000'000, 3'000'000, 1'700'000}),
                             Interpolation::poly5_line);
  const double v0 = 0.5;
  const double v1 = -0.25;
  const double h = 1'200'000;
  const CamMotion middle = at(cam, 1'200'000);
  EXPECT_NEAR(middle.position, (300'000 + 2'000'000) / 2.0 - 5 * (v1 - v0) * h / 32, 1e-6);
  EXPECT_NEAR(middle.velocity, 15 * 1'700'000 / (8 * h) - 7 * (v0 + v1) / 16, 1e-12);
  // Twice continuously differentiable at both ends, with acceleration 0.
  EXPECT_NEAR(cam.pieces[1].begin().velocity, v0, 1e-12);
  EXPECT_NEAR(cam.pieces[1].end().velocity, v1, 1e-12);
  EXPECT_EQ(cam.pieces[1].begin().acceleration, 0);
  EXPECT_NEAR(cam.pieces[1].end().acceleration * h * h, 0, 1e-6);
  expect_consistent(cam);
}

TEST(PlcopenLaws, EveryLawIsContinuousAsItsClassSaysAlsoOverTheWrap) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> share(0, 1);
  for (int round = 0; round < 200; ++round) {
    std::vector<double> values(static_cast<std::size_t>(2 + 2 * (round % 9)));
    for (double& value : values) value = turn * share(random);
    std::vector<double> points;
    const double gap = turn / static_cast<double>(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      points.push_back(std::round((static_cast<double>(i) + 0.8 * share(random)) * gap));
      points.push_back(std::round(values[i]));
    }
    const auto endless = static_cast<Endless>(round % 3 - 1);
    for (const auto& [cam, order] :
         {std::pair{curve(slaves(values), Interpolation::linear, endless), 0},
          std::pair{curve(slaves(values), Interpolation::polynom_3, endless), 1},
          std::pair{curve(pairs(points), Interpolation::line_poly5, endless), 2},
          std::pair{curve(pairs(points), Interpolation::poly5_line, endless), 2}}) {
      for (std::size_t i = 0; i < cam.pieces.size(); ++i) {
        const bool wrap = i + 1 == cam.pieces.size();
        // A table whose first master is not 0 begins with the end of the last segment, met in the middle.
        if (wrap && cam.pieces.front().master < 0) continue;
        CamPiece next = cam.pieces[wrap ? 0 : i + 1];
        if (wrap) next.slave += static_cast<double>(cam.turns) * turn;
        const CamMotion end = cam.pieces[i].end();
        const CamMotion start = next.begin();
        EXPECT_NEAR(end.position, start.position, 1e-6);
        if (order >= 1) {
          EXPECT_NEAR(end.velocity, start.velocity, 1e-9 * (1 + std::abs(end.velocity)));
        }
        if (order >= 2) {
          EXPECT_NEAR(end.acceleration * gap, start.acceleration * gap, 1e-6 * (1 + std::abs(end.velocity)));
        }
      }
      // Just before and at the turn of the master, unwrapped.
      EXPECT_NEAR(position(cam, turn - 0.01), position(cam, turn),
                  0.02 * (1 + std::abs(at(cam, turn - 0.01).velocity)));
    }
    if (HasFailure()) break;
  }
}

TEST(PlcopenLaws, EndlessTurnsAStepAgainstItsDirectionOverTheTurn) {
  const std::vector<double> s{0, 1'200'000, 2'400'000};
  const CamCurve positive = curve(slaves(s), Interpolation::linear, Endless::positive);
  EXPECT_EQ(positive.turns, 1);
  EXPECT_EQ(at(positive, 3'000'000).position, 3'000'000);
  const CamCurve none = curve(slaves(s), Interpolation::linear);
  EXPECT_EQ(none.turns, 0);
  EXPECT_EQ(at(none, 3'000'000).position, 1'200'000);
  const CamCurve negative =
      curve(slaves({0, 2'400'000, 1'200'000}), Interpolation::linear, Endless::negative);
  EXPECT_EQ(negative.turns, -1);
  EXPECT_EQ(at(negative, 600'000).position, -600'000);
  EXPECT_EQ(at(negative, 1'200'000).position, -1'200'000);
  // A small step back is one, and entries outside the turn are taken as they stand.
  std::int64_t turns = 0;
  EXPECT_EQ(unwrapped({100, 50, 3'000'000}, turn, Endless::positive, turns),
            (std::vector<double>{100, 50, 3'000'000, 100 + turn}));
  EXPECT_EQ(unwrapped({0, 3'700'000, 10}, turn, Endless::positive, turns),
            (std::vector<double>{0, 3'700'000, 10, turn}));
  // One that ends in a dwell at its start's place is closed already.
  EXPECT_EQ(unwrapped({0, 3'000'000, 0}, turn, Endless::positive, turns),
            (std::vector<double>{0, 3'000'000, turn, turn}));
  EXPECT_EQ(turns, 1);
  EXPECT_EQ(unwrapped({500}, turn, Endless::positive, turns), (std::vector<double>{500, 500}));
}

TEST(PlcopenLaws, EndlessCoefficientsGoOnInTheTurnInWhichTheyEnd) {
  McCamTable table{.file = {}, .name = {}, .id = 1, .type = 5, .values = {0, turn, 0, 0}};
  EXPECT_EQ(curve(table, Interpolation::polynom_3_koeff, Endless::positive).turns, 1);
  EXPECT_EQ(curve(table, Interpolation::polynom_3_koeff).turns, 0);
}

TEST(PlcopenLaws, OneLineIsOnePlace) {
  for (const Interpolation type :
       {Interpolation::step_direct, Interpolation::linear, Interpolation::polynom_3}) {
    const CamCurve cam = curve(slaves({123}), type);
    EXPECT_EQ(at(cam, 0).position, 123);
    EXPECT_EQ(at(cam, turn / 3).position, 123);
    EXPECT_EQ(at(cam, turn / 3).velocity, 0);
  }
}

}  // namespace
}  // namespace drycut::devices::plcopen
