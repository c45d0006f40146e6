// Programs that take time, from the scenario on: the key of each controller, its default, and what it does.
#include <gmock/gmock.h>

#include <filesystem>
#include <string>

#include "sim/controllers/kinds.hpp"
#include "sim/loop/names.hpp"
#include "sim/loop/simulation.hpp"
#include "sim/scenario/scenario.hpp"
#include "tests/findings.hpp"

namespace drycut::sim {
namespace {

using testing::Contains;
using testing::HasSubstr;

const auto scenes = std::filesystem::path(DRYCUT_SOURCE_DIR) / "scenes";

struct ScanKind {
  std::string scene;
  std::string path;    ///< of the key
  std::string others;  ///< a key of another kind
};
const std::vector<ScanKind> kinds = {
    {"rotary_knife.yaml", "controller.qmove.statement_time", "controller.qmove.step_time"},
    {"rotary_knife_lx3vp.yaml", "controller.lx3vp.step_time", "controller.lx3vp.statement_time"},
    {"rotary_knife_mc_camin.yaml", "controller.plcopen.statement_time", "controller.plcopen.step_time"},
};

Time of(const scenario::Scenario& scenario) {
  if (const auto* qmove = controllers::controller_of<controllers::QmoveSection>(scenario))
    return qmove->statement_time;
  if (const auto* lx3vp = controllers::controller_of<controllers::Lx3vpSection>(scenario))
    return lx3vp->step_time;
  return controllers::controller_of<controllers::PlcopenSection>(scenario)->statement_time;
}

TEST(ComputingTime, IsNoneUnlessTheScenarioGivesIt) {
  for (const ScanKind& kind : kinds) {
    SCOPED_TRACE(kind.scene);
    Problems problems;
    const auto plain = scenario::read_scenario(scenes / kind.scene, {}, problems);
    EXPECT_EQ(of(plain), 0);
    const auto key = kind.path.substr(kind.path.rfind('.') + 1);
    EXPECT_THAT(scenario::expand(plain), HasSubstr("    " + key + ": 0 s\n"));
    // It need not be a multiple of the step.
    const auto timed = scenario::read_scenario(scenes / kind.scene, {{kind.path, "1.5 us"}}, problems);
    ASSERT_TRUE(problems.empty()) << to_string(problems[0]);
    EXPECT_EQ(of(timed), 1500);
    EXPECT_THAT(scenario::expand(timed), HasSubstr("    " + key + ": 1.5 us\n"));
    scenario::read_scenario(scenes / kind.scene, {{kind.path, "-1 us"}}, problems);
    ASSERT_EQ(problems.size(), 1U);
    EXPECT_THAT(problems[0].what, HasSubstr(key));
    problems.clear();
    scenario::read_scenario(scenes / kind.scene, {{kind.others, "1 us"}}, problems);
    ASSERT_EQ(problems.size(), 1U);
    EXPECT_THAT(problems[0].what, HasSubstr("unknown key"));
  }
}

/// When a channel first changes, in a run with a key set [s].
double first_change(const ScanKind& kind, const std::string& time, const std::string& channel) {
  Problems problems;
  const auto scenario = scenario::read_scenario(scenes / kind.scene, {{kind.path, time}}, problems);
  loop::Simulation simulation(scenario, problems);
  EXPECT_TRUE(problems.empty()) << to_string(problems.at(0));
  simulation.keep_nothing();
  const auto reading = simulation.names().reading(channel).value();
  const double before = reading.read();
  while (simulation.time() < scenario.scene.duration && reading.read() == before)
    EXPECT_TRUE(simulation.advance());
  return seconds(simulation.time());
}

TEST(ComputingTime, DelaysWhatTheProgramDoesFirst) {
  const ScanKind& qmove = kinds[0];
  // The program's first device command is INIT: the assignments before it take their time.
  const double at_once = first_change(qmove, "0 s", "AxisX.st_init");
  const double slow = first_change(qmove, "1 ms", "AxisX.st_init");
  const double slower = first_change(qmove, "2 ms", "AxisX.st_init");
  EXPECT_GT(slow, at_once + 0.01);
  EXPECT_NEAR(slower - slow, slow - at_once, 0.005);
}

TEST(ComputingTime, AnOverrunIsToldOfTheRun) {
  Problems problems;
  const auto scenario = scenario::read_scenario(
      scenes / kinds[2].scene, {{kinds[2].path, "1 ms"}, {"scene.duration", "200 ms"}}, problems);
  loop::Simulation simulation(scenario, problems);
  ASSERT_TRUE(problems.empty());
  simulation.run();
  EXPECT_THAT(sentences(simulation.notes()), Contains(HasSubstr(": overrun: due every ")));
}

// With room to spare in the cycle the shipped lines do their job all the same.
TEST(ComputingTime, TheLinesBearWhatARealControllerTakes) {
  for (const auto& [kind, time] : {std::pair{0, "5 us"}, std::pair{1, "200 ns"}, std::pair{2, "1 us"}}) {
    const ScanKind& line = kinds[static_cast<std::size_t>(kind)];
    Problems problems;
    const auto scenario = scenario::read_scenario(scenes / line.scene, {{line.path, time}}, problems);
    loop::Simulation simulation(scenario, problems);
    ASSERT_TRUE(problems.empty());
    simulation.keep_nothing();
    for (const auto& check : simulation.run().checks)
      EXPECT_TRUE(check.passed) << line.scene << ": " << check.name << ": " << check.detail;
  }
}

}  // namespace
}  // namespace drycut::sim
