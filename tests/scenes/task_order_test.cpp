// The order of a controller's tasks is nobody's business: every permutation gives the same verdicts.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <numeric>

#include "sim/controllers/kinds.hpp"
#include "sim/loop/simulation.hpp"
#include "sim/studies/compare/scene.hpp"
#include "tests/test_folder.hpp"

namespace drycut::sim {
namespace {

namespace fs = std::filesystem;

/// Runs `scenario` to its end; a line for each check: its name and verdict.
std::vector<std::string> verdicts(scenario::Scenario& scenario) {
  scenario.pictures.frames = false;
  Problems problems;
  loop::Simulation simulation(scenario, problems);
  EXPECT_EQ(lines_of(problems), "");
  if (!problems.empty()) return {};
  std::vector<std::string> lines;
  for (const auto& check : simulation.run().checks)
    lines.push_back(check.name + (check.passed ? ": passed" : ": failed, " + check.detail));
  return lines;
}

/// All orders of 0..count-1, that of the scenario first.
std::vector<std::vector<std::size_t>> orders(std::size_t count) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::vector<std::vector<std::size_t>> all;
  do all.push_back(order);
  while (std::ranges::next_permutation(order).found);
  return all;
}

std::vector<std::string> scenes_of_several_tasks() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(source_root / "scenes")) {
    Problems problems;
    if (entry.path().extension() != ".yaml" || studies::read_comparison(entry.path(), problems)) continue;
    const scenario::Scenario scenario = scenario::read_scenario(entry.path(), {}, problems);
    const auto* qmove = controllers::controller_of<controllers::QmoveSection>(scenario);
    if (qmove && qmove->tasks.size() > 1) names.push_back(entry.path().stem().string());
  }
  std::ranges::sort(names);
  return names;
}

class TaskOrder : public ::testing::TestWithParam<std::string> {};

TEST_P(TaskOrder, OfAShippedSceneChangesNoVerdict) {
  Problems problems;
  scenario::Scenario scenario =
      scenario::read_scenario(source_root / "scenes" / (GetParam() + ".yaml"), {}, problems);
  ASSERT_EQ(lines_of(problems), "");
  auto& tasks = dynamic_cast<controllers::QmoveSection&>(*scenario.controller).tasks;
  const auto as_shipped = tasks;
  std::vector<std::string> expected;
  for (const auto& order : orders(tasks.size())) {
    for (std::size_t i = 0; i < order.size(); ++i) tasks[i] = as_shipped[order[i]];
    const auto found = verdicts(scenario);
    ASSERT_FALSE(found.empty());
    if (expected.empty()) expected = found;
    EXPECT_EQ(found, expected) << tasks.front().text << " first";
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, TaskOrder, ::testing::ValuesIn(scenes_of_several_tasks()),
                         [](const auto& scene) { return scene.param; });

// --- a flying saw of three tasks: control, the manual's start-up loop, an HMI ---

/// 000 1.1.1.1: writes funOut every scan.
const std::string lamp =
    "WAIT AxisX:st_init\nMAIN:\nIF AxisX:st_int\nAxisX:funOut = 2\nELSE\nAxisX:funOut = 1\nENDIF\n"
    "glLamp = glLamp + 1\nWAIT 1\nJUMP MAIN\nEND\n";
const std::string hmi =
    "WAIT AxisX:st_init\nMAIN:\nglShown = AxisX:posit\nglHmi = glHmi + 1\nWAIT 1\nJUMP MAIN\nEND\n";

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const auto at = text.find(what);
  if (at == std::string::npos) {
    ADD_FAILURE() << "no '" << what << "'";
    return text;
  }
  return text.replace(at, what.size(), by);
}

/// scenes/flying_saw.yaml for 8 s, with `tasks` in a folder of the test's own beside its configuration.
scenario::Scenario saw(const TestFolder& folder, const std::vector<std::string>& tasks) {
  const fs::path programs = source_root / "scenes/programs";
  folder.file("saw.cnf", replaced(content(programs / "flying_saw.cnf"), "GLOBAL\n",
                                  "GLOBAL\nglShown L\nglHmi L\nglLamp L\n"));
  folder.file("control.mod", content(programs / "flying_saw.mod"));
  folder.file("lamp.mod", lamp);
  folder.file("hmi.mod", hmi);
  std::string text = content(source_root / "scenes/flying_saw.yaml");
  text = replaced(text, "duration: 16 s", "duration: 8 s");
  text = replaced(text, "programs/flying_saw.cnf", "saw.cnf");
  std::string list;
  for (const auto& task : tasks) list += (list.empty() ? "" : ", ") + task + ".mod";
  text = replaced(text, "programs/flying_saw.mod", list);
  text = replaced(text, "at_least: 10", "at_least: 3");
  // 500 rounds a second; the cut is at up to 34 m/min, 5.7 Um a ms.
  text = replaced(text, "checks:\n",
                  "checks:\n"
                  "  - {name: the HMI has 490 turns a second, eventually: glHmi >= 3920, within: 8 s}\n"
                  "  - {name: the lamp has 490 turns a second, eventually: glLamp >= 3920, within: 8 s}\n"
                  "  - {name: the HMI is fresh, always: abs(glShown - AxisX.posit) <= 40, from: 100 ms}\n");
  Problems problems;
  scenario::Scenario scenario = scenario::read_scenario(folder.file("saw.yaml", text), {}, problems);
  EXPECT_EQ(lines_of(problems), "");
  return scenario;
}

TEST(FlyingSawOfThreeTasks, WorksInEveryOrder) {
  const std::vector<std::string> names = {"control", "lamp", "hmi"};
  for (const auto& order : orders(names.size())) {
    const TestFolder folder;
    const std::vector<std::string> tasks = {names[order[0]], names[order[1]], names[order[2]]};
    scenario::Scenario scenario = saw(folder, tasks);
    const auto found = verdicts(scenario);
    EXPECT_GE(found.size(), 11U);
    EXPECT_THAT(found, ::testing::Each(::testing::EndsWith(": passed"))) << tasks[0] << " " << tasks[1];
  }
}

}  // namespace
}  // namespace drycut::sim
