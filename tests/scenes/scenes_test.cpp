// Every scenario in scenes/ passes its own checks, every one in tests/scenes/failing fails one; a new file
// there is tested without a list to keep.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "sim/cli/run_command.hpp"
#include "sim/loop/simulation.hpp"
#include "sim/record/recording.hpp"
#include "sim/studies/compare/scene.hpp"
#include "tests/test_folder.hpp"

namespace drycut::sim {
namespace {

namespace fs = std::filesystem;

/// The scenarios of a folder, or the scenes there that compare some.
std::vector<std::string> scenarios(const fs::path& folder, bool comparing = false) {
  std::vector<std::string> names;
  Problems ignored;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".yaml" &&
        studies::read_comparison(entry.path(), ignored).has_value() == comparing)
      names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

/// A run to the end; the pictures are left out.
struct Played {
  Problems problems;
  scenario::Scenario scenario;
  std::unique_ptr<loop::Simulation> simulation;
  record::Outcome outcome;
  explicit Played(const fs::path& file, const fs::path& out = "")
      : scenario(scenario::read_scenario(file, {}, problems)) {
    scenario.pictures.frames = false;
    if (!problems.empty()) return;
    simulation = std::make_unique<loop::Simulation>(scenario, problems);
    if (!problems.empty()) return;
    if (!out.empty()) simulation->write_to(out / "trace.csv", out / "events.csv");
    outcome = simulation->run();
  }
};

class Scenes : public ::testing::TestWithParam<std::string> {};

void expect_passed(const Played& run) {
  ASSERT_EQ(lines_of(run.problems), "");
  EXPECT_EQ(run.outcome.failure, "");
  EXPECT_EQ(run.outcome.end, run.scenario.scene.duration);
  EXPECT_FALSE(run.outcome.checks.empty());
  for (const auto& check : run.outcome.checks)
    EXPECT_TRUE(check.passed) << check.name << ": " << check.detail;
}

TEST_P(Scenes, PassTheirChecks) { expect_passed(Played(source_root / "scenes" / (GetParam() + ".yaml"))); }

/// A program as a user writes it: recipes, orders, alarms, in three files.
TEST(Programs, OfSeveralFilesRunAMachine) {
  const Played run(source_root / "tests/scenes/drill_table/drill_table.yaml");
  expect_passed(run);
  for (const auto& warning : run.simulation->warnings()) ADD_FAILURE() << warning.text;
}

class ComparingScenes : public ::testing::TestWithParam<std::string> {};

TEST_P(ComparingScenes, PassTheirChecks) {
  const fs::path out = fs::path(::testing::TempDir()) / ("drycut_comparing_" + GetParam());
  cli::RunOptions options;
  options.scenarios = {source_root / "scenes" / (GetParam() + ".yaml")};
  options.out = out;
  options.pictures = false;
  EXPECT_EQ(cli::run_scenarios(options), cli::all_passed);
  EXPECT_TRUE(fs::exists(out / GetParam() / "comparison.csv"));
  fs::remove_all(out);
}

class FailingScenes : public ::testing::TestWithParam<std::string> {};

TEST_P(FailingScenes, FailACheckAndNothingElse) {
  const Played run(source_root / "tests/scenes/failing" / (GetParam() + ".yaml"));
  ASSERT_EQ(lines_of(run.problems), "");
  EXPECT_EQ(run.outcome.failure, "");
  EXPECT_FALSE(run.outcome.passed());
}

const auto own_name = [](const auto& info) { return info.param; };
INSTANTIATE_TEST_SUITE_P(All, Scenes, ::testing::ValuesIn(scenarios(source_root / "scenes")), own_name);
INSTANTIATE_TEST_SUITE_P(All, ComparingScenes, ::testing::ValuesIn(scenarios(source_root / "scenes", true)),
                         own_name);
INSTANTIATE_TEST_SUITE_P(All, FailingScenes,
                         ::testing::ValuesIn(scenarios(source_root / "tests/scenes/failing")), own_name);

std::string bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::stringstream buffer;
  buffer << stream.rdbuf();
  return buffer.str();
}

TEST(Determinism, TwoRunsLeaveTheSameBytes) {
  const fs::path folder = fs::path(::testing::TempDir()) / "drycut_determinism";
  fs::create_directories(folder);
  std::vector<std::string> traces;
  std::vector<std::string> events;
  for (int i = 0; i < 2; ++i) {
    const Played run(source_root / "scenes/rotary_knife_short.yaml", folder);
    ASSERT_EQ(lines_of(run.problems), "");
    traces.push_back(bytes_of(folder / "trace.csv"));
    events.push_back(bytes_of(folder / "events.csv"));
  }
  fs::remove_all(folder);
  EXPECT_GT(traces[0].size(), 100000U);
  EXPECT_TRUE(traces[0] == traces[1]);  // not EXPECT_EQ: nobody reads a difference of megabytes
  EXPECT_EQ(events[0], events[1]);
}

}  // namespace
}  // namespace drycut::sim
