// The encoder on the motor: the load stops off by the gap, before the quota or behind it as it came from
// below or from above.
#include <gmock/gmock.h>

#include <filesystem>

#include "sim/loop/simulation.hpp"

namespace drycut::sim {
namespace {

class BacklashGap : public testing::TestWithParam<const char*> {};

TEST_P(BacklashGap, IsTheDifferenceOfTheTwoDirectionsWithinAPercent) {
  Problems problems;
  auto scenario =
      scenario::read_scenario(std::filesystem::path(DRYCUT_SOURCE_DIR) / "scenes/backlash_motor_encoder.yaml",
                              {{"plants.axis.gap", std::string(GetParam()) + " mm"}}, problems);
  scenario.pictures.frames = false;
  scenario.checks.clear();
  loop::Simulation simulation(scenario, problems);
  ASSERT_TRUE(problems.empty()) << to_string(problems.front());
  ASSERT_EQ(simulation.run().failure, "");
  const auto& step = simulation.recording().column("gbStep")->values;
  const auto& position = simulation.recording().column("axis.position")->values;
  // Where the load was last while the program waited at the quota.
  const auto rest = [&](double wanted) {
    double last = 0;
    for (std::size_t i = 0; i < step.size(); ++i)
      if (step[i] == wanted) last = position[i];
    return last;
  };
  const double gap = std::stod(GetParam());
  EXPECT_NEAR(rest(5) - rest(2), gap, 0.01 * gap);
  EXPECT_NEAR(150 - rest(2), gap / 2, 0.01 * gap);
  EXPECT_NEAR(rest(8), rest(2), 0.01 * gap);
}

INSTANTIATE_TEST_SUITE_P(Gaps, BacklashGap, testing::Values("1", "2", "5"), [](const auto& gap) {
  return gap.index == 0 ? "one" : gap.index == 1 ? "two" : "five";
});

}  // namespace
}  // namespace drycut::sim
