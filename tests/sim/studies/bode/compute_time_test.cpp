// A controller that computes for a while is a dead time in its loop, and nothing else.
#include <gmock/gmock.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <string>

#include "sim/studies/bode/loop.hpp"
#include "tests/sim/studies/bode/axis.hpp"

namespace drycut::sim::studies {
namespace {

using testing::HasSubstr;

scenario::Scenario axis(const bode_axis::Folder& folder, const std::string& compute_time,
                        Problems& problems) {
  return scenario::read_scenario(folder / "axis.yaml", {{"controller.qmove.compute_time", compute_time}},
                                 problems);
}

/// Phase margin [deg] of L(z) = k (1 - d + d / z) / (z - 1): of the speed that is held over a sampling, the
/// share d still goes with the sample before.
double margin(double k, double d) {
  const auto loop = [&](double angle) {
    const auto z = std::polar(1.0, angle);
    return k * (1 - d + d / z) / (z - 1.0);
  };
  double low = 1e-6;
  double high = std::numbers::pi;
  for (int i = 0; i < 100; ++i) (std::abs(loop((low + high) / 2)) > 1 ? low : high) = (low + high) / 2;
  return 180 + std::arg(loop(low)) * 180 / std::numbers::pi;
}

TEST(ComputeTime, TakesItsDeadTimeOffThePhaseMargin) {
  const bode_axis::Folder folder;
  for (const int steps : {4, 8}) {  // of 8 steps in a sampling
    SCOPED_TRACE(steps);
    Problems problems;
    auto scenario = axis(folder, std::to_string(steps * 500) + " us", problems);
    ASSERT_TRUE(problems.empty());
    LoopRequest request;
    request.points = 30;
    const auto result = measure_both(scenario, request, problems);
    ASSERT_TRUE(problems.empty());
    ASSERT_TRUE(result && result->without_computing && result->margins.phase);
    EXPECT_EQ(scenario.controller->compute_time, steps * millisecond / 2);
    EXPECT_NEAR(result->without_computing->phase.value().value, margin(0.1, 0), 0.2);
    EXPECT_NEAR(result->margins.phase->value, margin(0.1, steps / 8.0), 0.2);
  }
}

TEST(ComputeTime, IsAWholeMultipleOfTheStepAndAtMostTheSamplingTime) {
  const bode_axis::Folder folder;
  Problems problems;
  axis(folder, "250 us", problems);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_THAT(to_string(problems[0]), HasSubstr("compute_time 250 us is not a whole multiple of scene.step"));
  problems.clear();
  const auto scenario = axis(folder, "5 ms", problems);
  ASSERT_TRUE(problems.empty());
  loop::Simulation simulation(scenario, problems);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_THAT(to_string(problems[0]),
              HasSubstr("compute_time of 5 ms is longer than the sampling time 4 ms"));
}

}  // namespace
}  // namespace drycut::sim::studies
