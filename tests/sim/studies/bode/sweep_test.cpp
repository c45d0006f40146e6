#include "sim/studies/bode/sweep.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "tests/sim/studies/bode/axis.hpp"

namespace drycut::sim::studies {
namespace {

using std::numbers::pi;

struct BodeSweep : testing::Test {
  /// Measures the axis of `yaml` with pgain.
  Sweep sweep(const std::string& yaml, int pgain, double amplitude, const std::vector<TestTone>& tones,
              const std::string& speed = "axis.speed") {
    Problems problems;
    const auto scenario =
        scenario::read_scenario_text(yaml, folder.path / "axis.yaml",
                                     {{"controller.qmove.set.Axis.pgain", std::to_string(pgain)}}, problems);
    loop::Simulation excited(scenario, problems);
    loop::Simulation still(scenario, problems);
    EXPECT_TRUE(problems.empty()) << to_string(problems.front());
    SweepPlan plan;
    plan.speed = speed;
    plan.at = 300 * millisecond;
    plan.step = scenario.scene.step;
    plan.sampling = excited.output_period(excited.bus().analogue_wires().front().terminal);
    EXPECT_EQ(plan.sampling, sampling);
    plan.amplitude = amplitude;
    plan.settle = 0.5;
    plan.tones = tones;
    return measure(excited, still, plan);
  }

  static constexpr Time sampling = 4 * millisecond;
  bode_axis::Folder folder;
  std::string ideal = bode_axis::Folder::scenario("");
};

// The whole closed form: L(z) = pgain / 1000 / (z - 1), speed 100 mm/s a volt without delay.
TEST_F(BodeSweep, IdealAxisIsTheSampledIntegrator) {
  const auto result = sweep(ideal, 100, 1, plan_tones(0.5, 100, 15, sampling, 2));
  ASSERT_EQ(result.loop, Sweep::Loop::closed);
  ASSERT_EQ(result.points.size(), 15U);
  for (const auto& point : result.points) {
    const auto z = std::polar(1.0, 2 * pi * point.frequency * seconds(sampling));
    const auto exact = 0.1 / (z - 1.0);
    EXPECT_NEAR(std::abs(point.open_loop / exact - 1.0), 0, 0.02) << point.frequency;
    EXPECT_NEAR(std::abs(*point.speed / 100.0 - 1.0), 0, 1e-3) << point.frequency;
    EXPECT_LT(point.error, 0.01);
    EXPECT_FALSE(point.saturated);
  }
  const auto margins = margins_of(result.points);
  ASSERT_TRUE(margins.phase);
  // |z - 1| = 0.1 at the crossover; there the phase is that of an integrator and half a sampling of delay.
  const double crossover = 2 * std::asin(0.05) / seconds(sampling);
  EXPECT_NEAR(margins.phase->frequency, crossover / (2 * pi), 0.01 * crossover / (2 * pi));
  EXPECT_NEAR(margins.phase->value, 90 - crossover * seconds(sampling) / 2 * 180 / pi, 0.5);
}

TEST_F(BodeSweep, GainMarginOfTheIdealAxisIsAFactorOfTwoThousand) {
  const auto tones = plan_tones(5, 125, 12, sampling, 2);
  const auto result = sweep(ideal, 1000, 1, tones);
  ASSERT_EQ(result.loop, Sweep::Loop::closed);
  const auto margins = margins_of(result.points);
  ASSERT_TRUE(margins.gain);
  EXPECT_NEAR(std::pow(10, margins.gain->value / 20), 2, 0.04);
  EXPECT_NEAR(margins.gain->frequency, 125, 0.1);
  EXPECT_EQ(sweep(ideal, 1800, 1, {}).loop, Sweep::Loop::closed);
  EXPECT_EQ(sweep(ideal, 2200, 1, tones).loop, Sweep::Loop::unstable);
}

// A motor with speed loop, current lag and filter: what the margin says at one gain holds at another.
TEST_F(BodeSweep, GainMarginPredictsWhereTheServoBecomesUnstable) {
  const auto yaml = bode_axis::Folder::screw();
  const auto result = sweep(yaml, 200, 0.1, plan_tones(2, 100, 25, sampling, 2), "axis.motor.speed");
  ASSERT_EQ(result.loop, Sweep::Loop::closed);
  const auto margins = margins_of(result.points);
  ASSERT_TRUE(margins.gain && margins.phase && margins.speed_bandwidth);
  const double limit = 200 * std::pow(10, margins.gain->value / 20);
  EXPECT_GT(limit, 400);
  EXPECT_EQ(sweep(yaml, static_cast<int>(limit * 0.9), 0.1, {}).loop, Sweep::Loop::closed);
  EXPECT_EQ(sweep(yaml, static_cast<int>(limit * 1.1), 0.1, {}).loop, Sweep::Loop::unstable);
}

TEST_F(BodeSweep, AnAxisInMotionMeasuresAsOneAtRest) {
  const auto tones = plan_tones(1, 60, 8, sampling, 2);
  const auto moving = bode_axis::Folder::scenario(
      "timeline: [{at: 200 ms, set: {Axis.feedfw: 1000, Axis.setvel: 1000, Axis.setpos: 900000}}]\n");
  folder.file("axis.mod",
              bode_axis::Folder::program("LOOPON Axis\nWAIT Axis:setpos EQ 900000\nSTART Axis\n"));
  const auto runs = sweep(moving, 100, 1, tones);
  ASSERT_EQ(runs.loop, Sweep::Loop::closed);
  ASSERT_EQ(runs.points.size(), tones.size());
  for (const auto& point : runs.points) {
    const auto z = std::polar(1.0, 2 * pi * point.frequency * seconds(sampling));
    EXPECT_NEAR(std::abs(point.open_loop * (z - 1.0) / 0.1 - 1.0), 0, 0.02) << point.frequency;
  }
}

TEST_F(BodeSweep, TellsAnOpenLoop) {
  folder.file("axis.mod", bode_axis::Folder::program("LOOPOFF Axis\n"));
  const auto result = sweep(ideal, 100, 1, plan_tones(1, 100, 3, sampling, 2));
  EXPECT_EQ(result.loop, Sweep::Loop::open);
  EXPECT_TRUE(result.points.empty());
}

TEST_F(BodeSweep, TellsASaturatedOutput) {
  const auto result = sweep(ideal, 1000, 10, plan_tones(100, 125, 2, sampling, 2));
  ASSERT_EQ(result.points.size(), 2U);
  EXPECT_TRUE(result.points.back().saturated);
}

TEST_F(BodeSweep, IsTheSameTwice) {
  const auto tones = plan_tones(1, 100, 5, sampling, 2);
  const auto first = sweep(ideal, 100, 0.2, tones);
  const auto second = sweep(ideal, 100, 0.2, tones);
  ASSERT_EQ(first.points.size(), second.points.size());
  for (std::size_t i = 0; i < first.points.size(); ++i)
    EXPECT_EQ(first.points[i].open_loop, second.points[i].open_loop);
}

}  // namespace
}  // namespace drycut::sim::studies
