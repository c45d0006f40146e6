// The cams of MC_CamIn against closed forms: polynomials, knots, samples.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "tests/sim/cams/camin_bench.hpp"

namespace drycut::sim::cams {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

TEST(CamInPolynomials, TheirZerosAreFoundWhereverTheyLie) {
  // (u - 0.2)(u - 0.5)(u - 0.9)
  const auto zeros = devices::zeros_of({-0.09, 0.73, -1.6, 1, 0, 0});
  ASSERT_THAT(zeros, SizeIs(3));
  EXPECT_NEAR(zeros[0], 0.2, 1e-12);
  EXPECT_NEAR(zeros[1], 0.5, 1e-12);
  EXPECT_NEAR(zeros[2], 0.9, 1e-12);
  EXPECT_THAT(devices::zeros_of({0, 1, 0, 0, 0, 0}), ElementsAre(0));
  EXPECT_THAT(devices::zeros_of({-1, 1, 0, 0, 0, 0}), ElementsAre(1));
  EXPECT_THAT(devices::zeros_of({1, 0, 1, 0, 0, 0}), IsEmpty());
  EXPECT_THAT(devices::zeros_of({5, 0, 0, 0, 0, 0}), IsEmpty());
  EXPECT_THAT(devices::zeros_of({}), IsEmpty());
}

TEST(CamInPolynomials, PeaksAreThoseOfTheFifthDegreeLaw) {
  // 10 u3 - 15 u4 + 6 u5 over a length of 2: the constants of VDI 2143.
  const devices::CamPiece segment{0, 2, 0, 1, devices::CamPolynomial{{0, 0, 0, 10, -15, 6}}};
  const auto velocity = segment.extremes(devices::CamOrder::velocity);
  EXPECT_NEAR(velocity.high, 1.875 / 2, 1e-12);
  EXPECT_EQ(velocity.low, 0);
  const auto acceleration = segment.extremes(devices::CamOrder::acceleration);
  EXPECT_NEAR(acceleration.high, 10 / std::sqrt(3.0) / 4, 1e-12);
  EXPECT_NEAR(acceleration.low, -10 / std::sqrt(3.0) / 4, 1e-12);
  EXPECT_NEAR(segment.extremes(devices::CamOrder::jerk).high, 60.0 / 8, 1e-12);
  EXPECT_NEAR(segment.extremes(devices::CamOrder::jerk).low, -30.0 / 8, 1e-12);
  EXPECT_EQ(segment.extremes(devices::CamOrder::position).high, 1);
}

TEST(CamInKnots, EachLawIsAsSmoothAsItIs) {
  const auto smooth = [](const std::string& text) {
    std::vector<int> found;
    for (const auto& knot : camin::knots(text)) found.push_back(knot.smooth);
    return found;
  };
  const std::string rows = "slave\n0\n100000\n300000\n";
  EXPECT_THAT(smooth("# interpolation: STEP_DIRECT\n" + rows), ElementsAre(-1, -1, -1));
  EXPECT_THAT(smooth("# interpolation: LINEAR\n" + rows), ElementsAre(0, 0, 0));
  EXPECT_THAT(smooth("# interpolation: POLYNOM_3\n" + rows), ElementsAre(1, 1, 1));
  EXPECT_THAT(smooth(camin::knife()), ElementsAre(2, 2));
  // A steady turn, and a table of one row.
  EXPECT_THAT(smooth("# endless: positive\nslave\n0\n900000\n1800000\n2700000\n"), ElementsAre(3, 3, 3, 3));
  EXPECT_THAT(smooth("slave\n5\n"), ElementsAre(3));
}

TEST(CamInKnots, TheJumpsAreThoseOfTheTable) {
  const auto lines = camin::knots("slave\n0\n900000\n");  // up at 1/2, down at 1/2
  ASSERT_THAT(lines, SizeIs(2));
  EXPECT_DOUBLE_EQ(lines[0].jumps[1], 1);
  EXPECT_DOUBLE_EQ(lines[1].jumps[1], -1);
  EXPECT_TRUE(lines[0].closes);
  EXPECT_FALSE(lines[1].closes);
  EXPECT_EQ(lines[1].master, 1'800'000);
  const auto steps = camin::knots("# interpolation: STEP_DIRECT\nslave\n100\n350\n");
  EXPECT_EQ(steps[0].jumps[0], -250);
  EXPECT_EQ(steps[1].jumps[0], 250);
  // The quintic's jerk at its ends, the line's is 0: D = 0, E = 0 would be a line.
  const auto knife = camin::knots(camin::knife());
  const double h = 6'800'000;
  const double d = 2'880'000 - 0.6 * h;
  EXPECT_NEAR(knife[1].jumps[3] / (60 * d / (h * h * h)), 1, 1e-12);
  EXPECT_NEAR(knife[0].jumps[3] / (-60 * d / (h * h * h)), 1, 1e-9);
}

TEST(CamInKnots, ATableThatBeginsLaterHasNoKnotAtTheTurnsEnd) {
  const auto run = run_cam_in(
      camin::table(
          "# interpolation: LINE_POLY5\n# endless: positive\nmaster,slave\n600000,0\n3000000,1800000\n"),
      {}, 1);
  const auto knots = run.knots;
  ASSERT_THAT(knots, SizeIs(2));
  EXPECT_EQ(knots[0].row, 1);
  EXPECT_EQ(knots[0].master, 600'000);
  EXPECT_EQ(knots[0].smooth, 2);
  EXPECT_EQ(knots[1].row, 2);
  EXPECT_EQ(run.law.pieces[0].row, 2);
  EXPECT_EQ(run.law.pieces[1].row, 1);
  EXPECT_EQ(run.law.pieces[2].row, 2);
  EXPECT_EQ(run.begin_of(0), 0);
  EXPECT_EQ(run.end_of(2), 3'600'000);
}

TEST(CamInSamples, TheKnifeAtItsKnotsInsideAndAcrossTheWrap) {
  const auto run = run_cam_in(camin::table(camin::knife()), {}, 2);
  const double h = 6'800'000;
  const double middle = 1'200'000 + h / 2;
  const auto points = sample_cam_at(
      run, {0, 600'000, 1'200'000, middle, 8'000'000, 8'600'000, 8'000'000 + middle, 16'000'000});
  ASSERT_THAT(points, SizeIs(8));
  const auto expect = [&](std::size_t i, double slave, double velocity, double acceleration, int row) {
    EXPECT_NEAR(points[i].position, slave, 1e-6) << i;
    EXPECT_NEAR(points[i].velocity, velocity, 1e-12) << i;
    EXPECT_NEAR(points[i].acceleration, acceleration, 1e-18) << i;
    EXPECT_EQ(points[i].row, row) << i;
  };
  // Half way: y = (y0 + y1)/2 where both slopes are one, y' = 15 (y1 - y0)/(8h) - 7/8 v.
  const double slowest = 15 * 2'880'000 / (8 * h) - 7 * 1.2 / 16;
  expect(0, 0, 0.6, 0, 1);
  expect(1, 360'000, 0.6, 0, 1);
  expect(2, 720'000, 0.6, 0, 2);
  expect(3, 2'160'000, slowest, 0, 2);
  expect(4, 3'600'000, 0.6, 0, 1);
  expect(5, 3'960'000, 0.6, 0, 1);
  expect(6, 5'760'000, slowest, 0, 2);
  expect(7, 7'200'000, 0.6, 0, 2);
}

TEST(CamInSamples, ACubicThroughACosineIsTheCatmullRomSpline) {
  std::string text = "# interpolation: POLYNOM_3\n# slave_modulo: 0\nslave\n";
  std::vector<double> y;
  for (int i = 0; i < 12; ++i) {
    y.push_back(std::round(1e6 * (1 - std::cos(2 * std::numbers::pi * i / 12))));
    text += std::to_string(y.back()) + "\n";
  }
  const auto run = run_cam_in(camin::table(text), {}, 1);
  for (std::size_t i = 0; i < 12; ++i) {
    const double before = y[(i + 11) % 12];
    const double next = y[(i + 1) % 12];
    const double after = y[(i + 2) % 12];
    const double x = 300'000 * static_cast<double>(i);
    const auto points = sample_cam_at(run, {x, x + 150'000});
    EXPECT_NEAR(points[0].position, y[i], 1e-9);
    EXPECT_NEAR(points[0].velocity, (next - before) / 2 / 300'000, 1e-12);
    EXPECT_NEAR(points[1].position, (9 * (y[i] + next) - before - after) / 16, 1e-8);
    EXPECT_EQ(points[0].row, static_cast<int>(i) + 1);
  }
}

TEST(CamInSamples, ByThemselvesAreEvenWithEveryBoundaryAndBothSidesOfAJump) {
  const auto smooth = sample_cam(run_cam_in(camin::table(camin::knife()), {}, 1));
  // 1000 points and the knot at 1200000, which lies between two of them.
  EXPECT_THAT(smooth, SizeIs(1001));
  EXPECT_EQ(smooth.front().master, 0);
  EXPECT_EQ(smooth.back().master, 8'000'000);
  for (std::size_t i = 1; i < smooth.size(); ++i) EXPECT_GT(smooth[i].master, smooth[i - 1].master);
  const auto steps =
      sample_cam(run_cam_in(camin::table("# interpolation: STEP_DIRECT\nslave\n100\n350\n"), {}, 2));
  std::vector<std::pair<double, double>> twice;
  for (std::size_t i = 1; i < steps.size(); ++i)
    if (steps[i].master == steps[i - 1].master) twice.emplace_back(steps[i - 1].position, steps[i].position);
  EXPECT_THAT(twice, ElementsAre(std::pair{100.0, 350.0}, std::pair{350.0, 100.0}, std::pair{100.0, 350.0},
                                 std::pair{350.0, 100.0}));
}

// A row of STEP_DIRECT is held up to the next one: at the end of a turn that is the first of the next turn.
TEST(CamInSamples, TheEndOfAStepIsWhereTheNextTurnBegins) {
  const auto run = run_cam_in(camin::table("# interpolation: STEP_DIRECT\nslave\n100\n350\n"), {}, 1);
  const auto points = sample_cam_at(run, {1'800'000 - 1.0, 1'800'000, 3'600'000 - 1.0, 3'600'000});
  std::vector<double> slaves;
  for (const auto& point : points) slaves.push_back(point.position);
  EXPECT_THAT(slaves, ElementsAre(100, 350, 350, 100));
  EXPECT_EQ(points.back().master, 3'600'000);
  EXPECT_EQ(sample_cam(run).back().position, 100);
}

TEST(CamInSamples, CoefficientsAreTheLawThatTheySay) {
  const auto run = run_cam_in(
      camin::table("# interpolation: POLYNOM_3_KOEFF\na0,a1,a2,a3\n5,0,0,0\n5,1,2,3\n11,0,0,0\n11,-6,0,0\n"),
      {}, 1);
  const auto points = sample_cam_at(run, {900'000, 900'000 + 450'000, 3'600'000});
  EXPECT_EQ(points[0].position, 5);
  EXPECT_DOUBLE_EQ(points[1].position, 5 + 0.5 + 0.5 + 3.0 / 8);
  EXPECT_DOUBLE_EQ(points[1].velocity * 900'000, 1 + 2 + 9.0 / 4);
  EXPECT_DOUBLE_EQ(points[1].acceleration * 900'000 * 900'000, 4 + 9);
  EXPECT_EQ(points[2].position, 5);
}

}  // namespace
}  // namespace drycut::sim::cams
