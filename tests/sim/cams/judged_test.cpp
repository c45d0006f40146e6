// The cam of a run, judged in the run: a row that stands twice makes its speed jump.
#include "sim/cams/judged.hpp"

#include <gmock/gmock.h>

#include <fmt/format.h>

#include <filesystem>

#include "base/text.hpp"
#include "sim/file.hpp"
#include "sim/loop/simulation.hpp"
#include "tests/test_folder.hpp"

namespace drycut::sim::cams {
namespace {

record::Outcome outcome_with(const std::string& table) {
  TestFolder folder;
  const auto shipped = std::filesystem::path(DRYCUT_SOURCE_DIR) / "scenes/flying_saw_mc_camin.yaml";
  const auto cam = folder.file("saw.csv", table);
  const auto file = folder.file(
      "line.yaml", fmt::format("extends: {}\ncontroller: {{plcopen: {{tables: [{{file: {}, id: 1}}]}}}}\n"
                               "scene: {{duration: 5 s}}\n",
                               shipped.string(), cam.string()));
  Problems problems;
  const auto scenario = scenario::read_scenario(file, {}, problems);
  loop::Simulation simulation(scenario, problems);
  EXPECT_TRUE(problems.empty()) << (problems.empty() ? "" : to_string(problems.front()));
  if (!problems.empty()) return {};
  simulation.follow_cams(cam_judgement);
  return simulation.run();
}

TEST(JudgedCams, ARowThatStandsTwiceIsAWarningAndTheCause) {
  Problems problems;
  const auto text =
      read_file(std::filesystem::path(DRYCUT_SOURCE_DIR) / "scenes/cams/mc_flying_saw.csv", problems);
  ASSERT_TRUE(text);
  EXPECT_THAT(outcome_with(*text).warnings(), testing::IsEmpty());
  const std::string row = "11111.111111111,16666.666666667,8333.333333333,0\n";
  const auto at = text->find(row);
  ASSERT_NE(at, std::string::npos);
  auto twice = *text;
  twice.insert(at, row);
  // Of the user's own file, its remarks counted.
  const auto line = 1 + std::count(text->begin(), text->begin() + static_cast<std::ptrdiff_t>(at), '\n') + 1;
  const auto place = fmt::format("cam of Saw (saw.csv), row 4 (line {})", line);
  const auto outcome = outcome_with(twice);
  EXPECT_THAT(record::texts_of(outcome.warnings()), testing::Contains(testing::StartsWith(place)));
  EXPECT_THAT(outcome.cause(), testing::StartsWith("because " + place));
}

std::string cause_of_line(const std::string& line, const std::string& path, const std::string& value) {
  Problems problems;
  const auto scenario =
      scenario::read_scenario(std::filesystem::path(DRYCUT_SOURCE_DIR) / "scenes/new" / line,
                              {{path, value}, {"scene.duration", "9 s"}}, problems);
  loop::Simulation simulation(scenario, problems);
  EXPECT_TRUE(problems.empty()) << (problems.empty() ? "" : to_string(problems.front()));
  simulation.follow_cams(cam_judgement);
  return simulation.run().cause();
}

TEST(JudgedCams, ACycleThatIsNoPieceIsTheCause) {
  EXPECT_THAT(cause_of_line("flying_saw_plcopen.yaml", "controller.plcopen.axes.Tube.modulo", "660 mm"),
              testing::StartsWith("because a cycle of the cam of Saw is 660 mm of material, and check 'cut "
                                  "length' wants 1000 mm"));
}

}  // namespace
}  // namespace drycut::sim::cams
