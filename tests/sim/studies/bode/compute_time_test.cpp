// A controller that computes for a while is a dead time in its loop, and nothing else.
#include <gmock/gmock.h>

#include <filesystem>
#include <string>

#include "sim/studies/bode/loop.hpp"

namespace drycut::sim::studies {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const auto scenes = std::filesystem::path(DRYCUT_SOURCE_DIR) / "scenes";

scenario::Scenario line(const std::string& compute_time, Problems& problems) {
  return scenario::read_scenario(scenes / "commissioning_first_move.yaml",
                                 {{"controller.qmove.compute_time", compute_time}}, problems);
}

TEST(ComputeTime, TakesItsDeadTimeOffThePhaseMargin) {
  Problems problems;
  auto scenario = scenario::read_scenario(scenes / "rotary_knife_short.yaml",
                                          {{"controller.qmove.compute_time", "1 ms"}}, problems);
  ASSERT_TRUE(problems.empty());
  LoopRequest request;
  request.at = "2 s";
  request.points = 12;
  request.from = 2;
  request.to = 40;
  const auto result = measure_both(scenario, request, problems);
  ASSERT_TRUE(problems.empty());
  ASSERT_TRUE(result && result->without_computing && result->margins.phase);
  const auto& with = *result->margins.phase;
  const auto& without = result->without_computing->phase.value();
  EXPECT_EQ(scenario.controller->compute_time, millisecond);
  // A dead time of 1 ms leaves the gain, and so the crossover, as they are.
  EXPECT_NEAR(with.frequency, without.frequency, 0.01 * without.frequency);
  EXPECT_NEAR(without.value - with.value, 360 * with.frequency * 1e-3, 0.05 * 360 * with.frequency * 1e-3);
}

TEST(ComputeTime, IsAWholeMultipleOfTheStepAndAtMostTheSamplingTime) {
  Problems problems;
  line("250 us", problems);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_THAT(to_string(problems[0]), HasSubstr("compute_time 250 us is not a whole multiple of scene.step"));
  problems.clear();
  const auto scenario = line("300 ms", problems);
  ASSERT_TRUE(problems.empty());
  loop::Simulation simulation(scenario, problems);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_THAT(to_string(problems[0]), HasSubstr("compute_time of 300 ms is longer than the sampling time"));
}

}  // namespace
}  // namespace drycut::sim::studies
