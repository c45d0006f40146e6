// --set path=value on scenarios that leave the way to the path out.
#include <gmock/gmock.h>

#include "sim/scenario/scenario.hpp"

namespace drycut::sim::scenario {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const char* const scenario =
    "scene: {duration: 1 s}\nplants:\n  axis: {type: ideal_axis}\n"
    "controller: {qmove: {configuration: a.cnf, tasks: [a.mod]}}\nwiring: {2.CNT01: axis.encoder}\n"
    "record: {channels: [axis.position]}\n";

Scenario read(const std::string& text, const std::vector<Override>& overrides,
              std::vector<std::string>& problems) {
  Problems found;
  auto made = read_scenario_text(text, "x.yaml", overrides, found);
  for (const auto& problem : found) problems.push_back(to_string(problem));
  return made;
}

TEST(Override, APlantWithoutItsSectionIsToldWhereItStands) {
  std::vector<std::string> problems;
  read(scenario, {{"axis.resolution", "1 um"}}, problems);
  EXPECT_THAT(problems, ElementsAre(HasSubstr("there is no 'axis' in the scenario; it is a plant: --set "
                                              "plants.axis.resolution=1 um")));
}

TEST(Override, MakesTheMapsOnItsWay) {
  std::vector<std::string> problems;
  const auto made = read(scenario,
                         {{"controller.qmove.set.AxisX.pgain", "12"},
                          {"controller.qmove.set.slLength", "7"},
                          {"pictures.frames.every", "20 ms"}},
                         problems);
  EXPECT_THAT(problems, testing::IsEmpty());
  const auto& set = made.controller->set;
  ASSERT_EQ(set.size(), 2U);
  EXPECT_EQ(set[0].first.text, "AxisX.pgain");
  EXPECT_EQ(set[0].second, 12);
  EXPECT_EQ(set[1].second, 7);
  EXPECT_EQ(made.pictures.every, 20 * millisecond);
}

TEST(Override, FillsAKeyThatStandsWithoutAValue) {
  std::string text = scenario;
  text.replace(text.find("tasks: [a.mod]"), 14, "tasks: [a.mod], set: ");
  std::vector<std::string> problems;
  const auto made = read(text, {{"controller.qmove.set.AxisX.pgain", "12"}}, problems);
  EXPECT_THAT(problems, testing::IsEmpty());
  EXPECT_EQ(made.controller->set.size(), 1U);
}

TEST(Override, ABareNumberIsNoQuantityWhereTheScenarioHasAUnit) {
  const std::string text =
      "variables: {speed: 60 m/min, count: 3}\n"
      "scene: {duration: 1 s}\nplants:\n  axis: {type: ideal_axis, speed_at_10v: 500 mm/s}\n"
      "timeline:\n  - {at: 0.1 s, set: {axis.x: \"${speed}\", axis.n: \"${count}\"}}\n";
  std::vector<std::string> problems;
  (void)read(text,
             {{"plants.axis.speed_at_10v", "700"},
              {"timeline.0.set.axis.x", "70"},
              {"timeline.0.set.axis.n", "4"},
              {"scene.duration", "2"},
              {"plants.axis.speed_at_10v", "0.7 m/s"}},
             problems);
  ASSERT_EQ(problems.size(), 3U);
  EXPECT_THAT(problems[0],
              HasSubstr("plants.axis.speed_at_10v has a unit in the scenario (500 mm/s, x.yaml:4:42), and "
                        "700 has none; write 700 mm/s if that is meant"));
  EXPECT_THAT(problems[1], HasSubstr("write 70 m/min if that is meant"));
  EXPECT_THAT(problems[2], HasSubstr("write 2 s if that is meant"));
}

TEST(Override, WhatItMadeUpIsRefusedByTheReaders) {
  std::vector<std::string> problems;
  (void)read(scenario,
             {{"controller.qmove.sett.AxisX.pgain", "1"},
              {"pictures.frame.every", "20 ms"},
              {"plants.axs.speed", "1 m/s"},
              {"plant.axis.speed", "1 m/s"}},
             problems);
  EXPECT_THAT(problems, ElementsAre(HasSubstr("unknown key 'sett' in controller.qmove; did you mean set?"),
                                    HasSubstr("unknown key 'frame' in pictures; did you mean frames?"),
                                    HasSubstr("there is no 'axs' in plants; did you mean axis?"),
                                    HasSubstr("there is no 'plant' in the scenario; did you mean plants?")));
}

}  // namespace
}  // namespace drycut::sim::scenario
