#include "sim/loop/timeline.hpp"

#include <gmock/gmock.h>

#include "sim/loop/bus.hpp"
#include "tests/findings.hpp"
#include "tests/loop/fakes.hpp"

namespace drycut::sim::loop {
namespace {

using fakes::text;

struct TimelineTest : testing::Test {
  TimelineTest() {
    scenario.file = "line.yaml";
    scenario.sources = {"line.yaml"};
    scenario.scene.step = 100 * microsecond;
    controller.values["slLength"] = 800;
    panel.switches["start"];
  }
  Timeline make() { return {scenario, names, &controller, problems}; }
  scenario::Stimulus& at(Time time) {
    scenario.timeline.emplace_back().at = time;
    return scenario.timeline.back();
  }
  static scenario::Quantity quantity(double number, std::string unit = "") {
    return {number, std::move(unit), {7, 9}};
  }
  /// Runs the timeline over [from, until) in steps.
  void run(Timeline& timeline, Time from, Time until) {
    for (Time now = from; now < until; now += scenario.scene.step) timeline.run(now, recording);
  }

  scenario::Scenario scenario;
  fakes::FakeController controller;
  fakes::FakePlant plant;
  OperatorPanel panel;
  Names names{{{"web", &plant}}, &controller, panel};
  Problems problems;
  record::Recording recording;
};

TEST_F(TimelineTest, SetsAtItsTimeAndNotBefore) {
  at(2 * millisecond).set = {{text("web.speed"), quantity(90, "m/min")},
                             {text("slLength"), quantity(500)},
                             {text("panel.start"), quantity(1)}};
  auto timeline = make();
  ASSERT_TRUE(problems.empty());
  run(timeline, 0, 2 * millisecond);
  EXPECT_DOUBLE_EQ(plant.speed, 1.0);
  EXPECT_FALSE(panel.switches["start"].level);
  run(timeline, 2 * millisecond, 3 * millisecond);
  EXPECT_DOUBLE_EQ(plant.speed, 1.5);
  EXPECT_DOUBLE_EQ(controller.values["slLength"], 500);
  EXPECT_TRUE(panel.switches["start"].level);
  ASSERT_EQ(recording.events().size(), 3U);
  EXPECT_EQ(recording.events()[0].text, "web.speed = 90 m/min");
  EXPECT_EQ(recording.events()[0].time, 2 * millisecond);
}

TEST_F(TimelineTest, RampIsLinearAndEndsExactly) {
  auto& stimulus = at(millisecond);
  stimulus.ramp = {{text("web.speed"), quantity(120, "m/min")}};
  stimulus.over = 10 * millisecond;
  auto timeline = make();
  run(timeline, 0, 6 * millisecond + scenario.scene.step);
  EXPECT_DOUBLE_EQ(plant.speed, 1.5);
  run(timeline, 6 * millisecond + scenario.scene.step, 20 * millisecond);
  EXPECT_DOUBLE_EQ(plant.speed, 2.0);
}

TEST_F(TimelineTest, SetEndsARampOfTheSameTarget) {
  auto& ramp = at(0);
  ramp.ramp = {{text("web.speed"), quantity(120, "m/min")}};
  ramp.over = 10 * millisecond;
  at(5 * millisecond).set = {{text("web.speed"), quantity(30, "m/min")}};
  auto timeline = make();
  run(timeline, 0, 20 * millisecond);
  EXPECT_DOUBLE_EQ(plant.speed, 0.5);
}

TEST_F(TimelineTest, ConditionFiresOnceAfterItsDelay) {
  auto& stimulus = scenario.timeline.emplace_back();
  stimulus.when = text("slLength > 900");
  stimulus.after = 3 * millisecond;
  stimulus.faults = {{text("web.encoder"), text("lose_counts"), quantity(200)}};
  auto timeline = make();
  ASSERT_TRUE(problems.empty());
  run(timeline, 0, 10 * millisecond);
  EXPECT_EQ(plant.lost, 0);
  controller.values["slLength"] = 901;
  run(timeline, 10 * millisecond, 12 * millisecond);
  EXPECT_EQ(plant.lost, 0);
  run(timeline, 12 * millisecond, 40 * millisecond);
  EXPECT_EQ(plant.lost, 200);
}

// A fault that never came proves nothing: who looks for it in a green run is told.
TEST_F(TimelineTest, ConditionsHaveNumbersWithUnits) {
  auto& stimulus = scenario.timeline.emplace_back();
  stimulus.when = text("web.speed > 1.5 m/s");
  stimulus.set = {{text("slLength"), quantity(700)}};
  plant.speed = 1.4;
  auto timeline = make();
  ASSERT_TRUE(problems.empty());
  run(timeline, 0, 2 * millisecond);
  EXPECT_DOUBLE_EQ(controller.values["slLength"], 800);
  plant.speed = 1.6;
  run(timeline, 2 * millisecond, 4 * millisecond);
  EXPECT_DOUBLE_EQ(controller.values["slLength"], 700);
  stimulus.when = text("web.speed > 1.5 N", 3, 9);
  make();
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(to_string(problems[0]),
            "line.yaml:3:21: '1.5 N' is a force, but 'web.speed' is a speed; write it in m/min "
            "[expression.unit]");
}

TEST_F(TimelineTest, WhatNeverHappensIsTold) {
  at(50 * millisecond).set = {{text("slLength"), quantity(500)}};
  auto& late = scenario.timeline.emplace_back();
  late.when = text("slLength > 900");
  late.after = 20 * millisecond;
  late.power = false;
  auto& vain = scenario.timeline.emplace_back();
  vain.when = text("slLength > 2000");
  vain.power = false;
  at(2 * millisecond).set = {{text("slLength"), quantity(901)}};
  for (int i = 0; i < 4; ++i) scenario.timeline[static_cast<std::size_t>(i)].place = {10 + i, 5};
  auto timeline = make();
  ASSERT_TRUE(problems.empty());
  run(timeline, 0, 10 * millisecond);
  EXPECT_THAT(
      sentences(timeline.left_undone(10 * millisecond)),
      testing::ElementsAre("the timeline's entry of line 10 never happened: it is due at 0.05 s, the "
                           "run ended at 0.01 s",
                           "the timeline's entry of line 11 never happened: it is due at 0.023 s, the "
                           "run ended at 0.01 s",
                           "the timeline's entry of line 12 never happened: its `when` did not come "
                           "true in 0.01 s"));
}

TEST_F(TimelineTest, EveryRepeats) {
  auto& stimulus = at(millisecond);
  stimulus.every = 2 * millisecond;
  stimulus.faults = {{text("web.encoder"), text("lose_counts"), quantity(1)}};
  auto timeline = make();
  run(timeline, 0, 10 * millisecond);  // at 1, 3, 5, 7, 9 ms
  EXPECT_EQ(plant.lost, 5);
}

TEST_F(TimelineTest, SwitchesThePower) {
  at(millisecond).power = false;
  auto timeline = make();
  run(timeline, 0, 2 * millisecond);
  EXPECT_FALSE(controller.powered);
}

TEST_F(TimelineTest, NothingIsSetBeyondItsRange) {
  auto& wrong = at(0);
  wrong.set = {
      {text("web.speed"), {-1e5, "m/min", {1, 20}}}, {text("web.speed"), {5, "m/s", {2, 20}}},  // 300 m/min
      {text("web.speed"), {5.001, "m/s", {3, 20}}},  {text("slLength"), {2.7, "", {4, 20}}},
      {text("slLength"), {5e9, "", {5, 20}}},        {text("panel.start"), {70000, "", {6, 20}}}};
  wrong.ramp = {{text("web.speed"), {1e308, "m/min", {7, 20}}}};
  wrong.over = millisecond;
  wrong.faults = {{text("web.encoder"), text("lose_counts"), {1e308, "", {8, 20}}},
                  {text("web.encoder"), text("lose_counts"), {0.5, "", {9, 20}}}};
  make();
  std::vector<std::string> all;
  for (const auto& problem : problems) all.push_back(to_string(problem));
  EXPECT_THAT(
      all,
      testing::ElementsAre(
          "line.yaml:1:20: web.speed does not hold -100000; write 0 to 300 m/min [controller.value-range]",
          "line.yaml:3:20: web.speed does not hold 300.06; write 0 to 300 m/min [controller.value-range]",
          "line.yaml:4:20: slLength holds whole numbers, not 2.7; write a whole number "
          "[controller.value-range]",
          "line.yaml:5:20: slLength does not hold 5000000000; write -2147483648 to 2147483647 "
          "[controller.value-range]",
          "line.yaml:6:20: panel.start does not hold 70000; write 0 to 1 [controller.value-range]",
          "line.yaml:7:20: web.speed does not hold 1e+308; write 0 to 300 m/min [controller.value-range]",
          "line.yaml:8:20: web.encoder.lose_counts does not hold 1e+308; write -2147483648 to "
          "2147483647 [controller.value-range]",
          "line.yaml:9:20: web.encoder.lose_counts holds whole numbers, not 0.5; write a whole "
          "number [controller.value-range]"));
}

TEST_F(TimelineTest, SaysWhatDoesNotFit) {
  auto& wrong = at(0);
  wrong.set = {{text("web.sped", 1, 5), quantity(1, "m/min")},  {text("web.speed", 2, 5), quantity(1)},
               {text("web.speed", 3, 5), quantity(1, "kg")},    {text("slLength", 4, 5), quantity(1, "mm")},
               {text("panel.start", 4, 20), quantity(1, "mm")}, {text("panel.stop", 5, 5), quantity(1)}};
  wrong.faults = {{text("web.encoder", 6, 5), text("explode", 6, 20), quantity(1)},
                  {text("web.motor", 8, 5), text("stuck", 8, 20), quantity(1)}};
  make();
  std::vector<std::string> all;
  for (const auto& problem : problems) all.push_back(to_string(problem));
  EXPECT_THAT(all,
              testing::ElementsAre(
                  "line.yaml:1:5: nothing called 'web.sped' can be set; did you mean web.speed? "
                  "[timeline.nothing-to-set]",
                  "line.yaml:7:9: web.speed needs a unit; write for example 1 m/min [scenario.wrong-unit]",
                  "line.yaml:7:9: web.speed is a speed, 'kg' is not; give it in m/min [scenario.wrong-unit]",
                  "line.yaml:7:9: slLength takes a plain number, not 'mm'; write the number of Um without "
                  "the unit [scenario.wrong-unit]",
                  "line.yaml:7:9: panel.start takes a plain number, not 'mm'; leave the unit away "
                  "[scenario.wrong-unit]",
                  "line.yaml:5:5: nothing called 'panel.stop' can be set; wire an input to panel.stop first; "
                  "switches: panel.start [timeline.nothing-to-set]",
                  "line.yaml:6:20: web.encoder offers no fault 'explode'; web.encoder offers: lose_counts "
                  "[timeline.no-such-fault]",
                  "line.yaml:8:20: web.motor offers no fault 'stuck'; components with faults: web.encoder "
                  "[timeline.no-such-fault]"));
}

}  // namespace
}  // namespace drycut::sim::loop
