// The tuning that the README shows, from the manual's example gains (pgain 10, feedfw 1000: 002 example
// program) and with fewer frequencies: a third of the following error at most, limits kept, few runs, the
// same answer for any number of jobs.
#include <gmock/gmock.h>

#include <filesystem>
#include <sstream>

#include "sim/cli/tune_command.hpp"
#include "tests/test_folder.hpp"

namespace drycut::sim {
namespace {

namespace fs = std::filesystem;

struct Line {
  const char* scene;
  const char* axis;
  const char* torque;
  const char* from;  ///< after homing
};
void PrintTo(const Line& line, std::ostream* out) { *out << line.scene; }

struct TuneScenes : testing::TestWithParam<Line> {
  TuneScenes() {
    const std::string set = std::string("controller.qmove.set.") + GetParam().axis + ".";
    options.scenarios = {fs::path(DRYCUT_SOURCE_DIR) / "scenes" / GetParam().scene};
    options.set = {set + "pgain=10", set + "feedfw=1000"};
    options.vary = {set + "pgain=1..400", set + "feedfw=900..1100"};
    options.minimise = std::string("rms(") + GetParam().axis + ".follerr)";
    options.constraints = {GetParam().torque, "phase_margin >= 60", "gain_margin >= 8"};
    options.from = GetParam().from;
    options.ignore_checks = true;
    options.budget = 130;
    options.pictures = false;
    options.loop.points = 12;
    options.loop.to = 100;
    options.loop.settle = 0.2;
  }
  std::string run(int jobs) {
    options.jobs = jobs;
    options.out = folder / std::to_string(jobs);
    testing::internal::CaptureStdout();
    EXPECT_EQ(cli::tune_scenarios(options), cli::all_passed);
    return testing::internal::GetCapturedStdout();
  }
  /// Number `column` of the row of the summary that begins with `name`.
  static double number(const std::string& text, const std::string& name, int column) {
    std::istringstream rest(text.substr(text.find(name) + name.size()));
    std::string word;
    for (int i = 0; i <= column; ++i) rest >> word;
    return std::stod(word);
  }

  TestFolder folder;
  cli::TuneOptions options;
};

TEST_P(TuneScenes, AThirdOfTheFollowingErrorAtMostWithinTheLimits) {
  const auto text = run(1);
  const auto row = "\n  " + options.minimise + " [bits x4]";
  ASSERT_NE(text.find(row), std::string::npos) << text;
  EXPECT_LE(number(text, row, 1) * 3, number(text, row, 0)) << text;
  EXPECT_LE(number(text, "simulated runs:", 0), options.budget);
  run(2);
  for (const auto* name : {"evaluations.csv", "patch.txt"})
    EXPECT_EQ(content(folder.path / "1" / name), content(folder.path / "2" / name)) << name;
}

const auto name_of_scene = [](const auto& line) { return fs::path(line.param.scene).stem().string(); };
INSTANTIATE_TEST_SUITE_P(Lines, TuneScenes,
                         testing::Values(Line{"backlash_motor_encoder.yaml", "Axis",
                                              "max(abs(axis.motor.torque)) <= 9.5", "200 ms"}),
                         name_of_scene);
INSTANTIATE_TEST_SUITE_P(DISABLED_Lines, TuneScenes,  // a minute
                         testing::Values(Line{"rotary_knife.yaml", "AxisX",
                                              "max(abs(knife.motor.torque)) <= 20", "3 s"}),
                         name_of_scene);

}  // namespace
}  // namespace drycut::sim
