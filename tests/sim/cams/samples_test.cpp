
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "tests/sim/cams/bench.hpp"

namespace drycut::sim::cams {
namespace {

using cams::rows;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::vector<double> numbers_of(const std::string& line) {
  std::vector<double> numbers;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) numbers.push_back(std::stod(cell));
  return numbers;
}

TEST(CamSamples, AThousandPointsAndEveryBoundary) {
  const auto points = sample_cam(run_cam(cams::introduction(), {}, 1));
  // Boundaries 100, 300, 460, 610 and the middles of 3 and 5, at 380 and 655, are not on the grid of 700/999.
  EXPECT_EQ(points.size(), 1000U + 6);
  for (const double boundary : {0.0, 100.0, 300.0, 380.0, 460.0, 610.0, 655.0, 700.0})
    EXPECT_EQ(std::count_if(points.begin(), points.end(), [&](auto& p) { return p.master == boundary; }), 1)
        << boundary;
  for (std::size_t i = 1; i < points.size(); ++i) {
    EXPECT_GT(points[i].master, points[i - 1].master);
    EXPECT_LE(points[i].master - points[i - 1].master, 700.0 / 999 + 1e-9);
  }
  EXPECT_EQ(points.front().row, 1);
  EXPECT_EQ(points.back().row, 5);
  EXPECT_EQ(points.back().position, 565);
}

TEST(CamSamples, BoundariesOnTheGridAreNotSampledTwice) {
  const auto points =
      sample_cam(run_cam(rows("1,131,333,100\n2,133,333,200\n3,135,333,100\n4,136\n"), {}, 1));
  EXPECT_EQ(points.size(), 1000U + 1);  // the middle of 3 lies between two points
  for (std::size_t i = 1; i < points.size(); ++i) EXPECT_GT(points[i].master - points[i - 1].master, 1e-6);
}

TEST(CamSamples, AStepOfVelocityHasTwoSides) {
  const auto points = sample_cam(run_cam(rows("1,154,100,50\n2,154,100,100\n3,136\n"), {}, 1));
  const auto at_step = std::find_if(points.begin(), points.end(), [](auto& p) { return p.master == 100; });
  ASSERT_NE(at_step, points.end());
  EXPECT_EQ(at_step->velocity, 0.5);
  EXPECT_EQ(at_step->row, 1);
  EXPECT_EQ((at_step + 1)->master, 100);
  EXPECT_EQ((at_step + 1)->velocity, 1);
  EXPECT_EQ((at_step + 1)->row, 2);
  // 136 stops it dead: released, row 0.
  EXPECT_EQ(points[points.size() - 2].velocity, 1);
  EXPECT_EQ(points.back().master, 200);
  EXPECT_EQ(points.back().position, 150);
  EXPECT_EQ(points.back().velocity, 0);
  EXPECT_EQ(points.back().row, 0);
}

TEST(CamSamples, ForDrawingEveryBoundaryHasTwoSides) {
  const auto points = sample_cam(run_cam(cams::introduction(), {}, 1), true);
  const auto first = std::find_if(points.begin(), points.end(), [](auto& p) { return p.master == 100; });
  ASSERT_NE(first, points.end());
  EXPECT_NEAR(first->acceleration, 0.01, 1e-12);
  EXPECT_NEAR((first + 1)->acceleration, 0, 1e-12);
  EXPECT_TRUE(
      std::is_sorted(points.begin(), points.end(), [](auto& a, auto& b) { return a.master < b.master; }));
}

TEST(CamSamples, AtGivesTheAskedPositionsInTheOrderOfRunning) {
  const auto run = run_cam(cams::introduction(), {}, 1);
  const auto points = sample_cam_at(run, {700, 380, 0, 100, 100});
  ASSERT_EQ(points.size(), 5U);
  const double masters[] = {0, 100, 100, 380, 700};
  const int in_row[] = {1, 2, 2, 3, 5};
  const double slaves[] = {0, 50, 50, 310, 565};
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(points[i].master, masters[i]);
    EXPECT_EQ(points[i].row, in_row[i]);
    EXPECT_NEAR(points[i].position, slaves[i], 1e-9);
  }
}

TEST(CamSamples, DerivativesAreThoseOfThePosition) {
  const auto run = run_cam(
      rows("1,252,7,5,90,33\n2,254,80,50,2\n3,254,120,90\n4,234,100,90\n5,235,90,20\n6,136\n"), {}, 1);
  constexpr double h = 1e-3;
  for (const auto& visit : run.visits) {
    for (int i = 1; i < 40; ++i) {
      const double m = visit.master_length * i / 41;
      const auto at = cams::at(visit, m);
      EXPECT_NEAR((cams::at(visit, m + h).position - cams::at(visit, m - h).position) / (2 * h), at.velocity,
                  1e-6);
      EXPECT_NEAR((cams::at(visit, m + h).velocity - cams::at(visit, m - h).velocity) / (2 * h),
                  at.acceleration, 1e-6);
      EXPECT_NEAR((cams::at(visit, m + h).acceleration - cams::at(visit, m - h).acceleration) / (2 * h),
                  at.jerk, 1e-5);
    }
  }
}

TEST(CamSamples, TheCsvReadsBackToTheSameBits) {
  const auto run = run_cam(cams::table("# measurem: 7\n# pulsem: 30\n" + cams::header +
                                       "1,231,100,33\n2,171,100,-100,0,100\n3,235,60,-10\n4,138\n"),
                           {}, 2);
  const auto points = sample_cam(run);
  const auto lines = lines_of(cam_csv(points, {}));
  ASSERT_EQ(lines.size(), points.size() + 1);
  EXPECT_EQ(lines[0], "master,slave,velocity,acceleration,jerk,sector");
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& p = points[i];
    EXPECT_EQ(numbers_of(lines[i + 1]), (std::vector<double>{p.master, p.position, p.velocity, p.acceleration,
                                                             p.jerk, static_cast<double>(p.row)}));
  }
}

TEST(CamSamples, WithTheMastersSpeedAlsoInTime) {
  const auto points = sample_cam_at(run_cam(rows("1,231,100,50\n2,235,100,50\n3,136\n"), {}, 1), {25});
  const auto lines = lines_of(cam_csv(points, 200.0));
  EXPECT_EQ(lines[0], "master,slave,velocity,acceleration,jerk,sector,time,velocity_t,acceleration_t,jerk_t");
  const auto numbers = numbers_of(lines[1]);
  ASSERT_EQ(numbers.size(), 10U);
  EXPECT_EQ(numbers[6], 0.125);
  EXPECT_NEAR(numbers[7], numbers[2] * 200, 1e-9);
  EXPECT_NEAR(numbers[8], numbers[3] * 200 * 200, 1e-9);
  EXPECT_NEAR(numbers[9], numbers[4] * 200 * 200 * 200, 1e-6);
}

TEST(CamSamples, NoMinusZero) {
  EXPECT_EQ(lines_of(cam_csv({{{-0.0, -0.0, -0.0, -0.0}, -0.0, 1}}, 1.0))[1], "0,0,0,0,0,1,0,0,0,0");
}

}  // namespace
}  // namespace drycut::sim::cams
