// What a scenario without problems says, down to the places.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <numbers>

#include "sim/controllers/kinds.hpp"
#include "tests/loop/scenario/fake_plants.hpp"

namespace drycut::sim::scenario {
namespace {

using fakes::FakeKnife;
using fakes::FakeWeb;
using fakes::problems_of;
using fakes::read;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Pair;

// Reads a text in which nothing is wrong.
Scenario sound(std::string_view text, const std::vector<Override>& overrides = {}) {
  std::vector<std::string> problems;
  auto scenario = read(text, problems, overrides);
  EXPECT_THAT(problems, IsEmpty());
  EXPECT_TRUE(scenario.buildable);
  return scenario;
}

std::vector<std::string> words(const std::vector<Text>& texts) {
  std::vector<std::string> words;
  for (const auto& text : texts) words.push_back(text.text);
  return words;
}

TEST(ScenarioRead, LeavesDefaultsWhereNothingIsSaid) {
  const auto scenario = sound("scene: {}\n");
  EXPECT_EQ(scenario.scene.step, 100 * microsecond);
  EXPECT_EQ(scenario.scene.duration, 10 * second);
  EXPECT_EQ(scenario.scene.seed, 1U);
  EXPECT_EQ(scenario.record.every, 2 * millisecond);
  EXPECT_FALSE(scenario.pictures.frames);
  EXPECT_TRUE(scenario.controller == nullptr);
}

TEST(ScenarioRead, Scene) {
  const auto scenario = sound(
      "scene: {title: \"A: b\", step: 0.25 ms, duration: 1.5 min,\n"
      "  seed: 18446744073709551615}\n");
  EXPECT_EQ(scenario.scene.title, "A: b");
  EXPECT_EQ(scenario.scene.step, 250 * microsecond);
  EXPECT_EQ(scenario.scene.duration, 90 * second);
  EXPECT_EQ(scenario.scene.seed, 18446744073709551615U);
  EXPECT_EQ(scenario.scene.step_place.line, 1);
  EXPECT_EQ(scenario.scene.step_place.column, 30);
}

TEST(ScenarioRead, PlantParametersGoToTheirMembersInSi) {
  const auto scenario = sound(R"(plants:
  knife:
    type: rotary_knife
    circumference: 0.8 m
    angle: 0.25 turn
    servo: {rated_torque: 12 Nm, loop: {gain: 3}}
    servo.rated_speed: 3000 rpm
    encoder: {mounting: load}
  web: {type: web, speed: 1 m/s, slip: 2 %, lines: 1000 lines, brake: on}
)");
  ASSERT_EQ(scenario.plants.size(), 2U);
  EXPECT_EQ(scenario.plants[0].name.text, "web");  // before the knife, which refers to it
  EXPECT_EQ(scenario.plants[1].name.text, "knife");
  const auto& knife = dynamic_cast<FakeKnife&>(*scenario.plants[1].definition);
  EXPECT_EQ(knife.circumference, 0.8);
  EXPECT_DOUBLE_EQ(knife.angle, std::numbers::pi / 2);
  EXPECT_EQ(knife.rated_torque, 12);
  EXPECT_DOUBLE_EQ(knife.rated_speed, 100 * std::numbers::pi);
  EXPECT_EQ(knife.gain, 3);
  EXPECT_EQ(knife.mounting, "load");
  EXPECT_EQ(knife.stiffness, 4000);  // not given
  EXPECT_EQ(knife.web, "web");
  const auto& web = dynamic_cast<FakeWeb&>(*scenario.plants[0].definition);
  EXPECT_EQ(web.speed, 1);
  EXPECT_EQ(web.lines, 1000);
  EXPECT_TRUE(web.brake);
}

TEST(ScenarioRead, ParametersKeepTheirPlaces) {
  const auto scenario = sound("plants:\n  web: {type: web, speed: 1 m/s}\n");
  ASSERT_EQ(scenario.plants[0].places.size(), 1U);
  EXPECT_EQ(scenario.plants[0].places[0].first, "speed");
  EXPECT_EQ(scenario.plants[0].places[0].second.line, 2);
  EXPECT_EQ(scenario.plants[0].places[0].second.column, 27);
}

TEST(ScenarioRead, LimitsOfARangeAreInsideInEveryUnit) {
  sound("plants: {web: {type: web, speed: 300 m/min}}");
  sound("plants: {web: {type: web, speed: 5 m/s}}");
  sound("plants: {web: {type: web, speed: 5000 mm/s, mass: 100 g}}");
  sound("plants: {k: {type: rotary_knife, angle: 0.5 turn}, web: {type: web}}");
}

TEST(ScenarioRead, PlantsFollowThoseTheyReferTo) {
  const auto scenario = sound(R"(plants:
  b: {type: rotary_knife, web: lower}
  first: {type: web}
  a: {type: rotary_knife, web: first}
  lower: {type: web}
)");
  std::vector<std::string> order;
  for (const auto& plant : scenario.plants) order.push_back(plant.name.text);
  EXPECT_THAT(order, ElementsAre("first", "a", "lower", "b"));
}

TEST(ScenarioRead, Controller) {
  const auto scenario = sound(R"(controller:
  qmove:
    configuration: programs/knife.cnf
    tasks: [programs/a.mod, programs/b.mod]
    cycle: 4 ms
    retentive: knife.state
    set: {slLength: 8000, AxisX.pgain: -5.5}
)");
  const auto& qmove = *controllers::controller_of<controllers::QmoveSection>(scenario);
  EXPECT_EQ(qmove.configuration.text, "programs/knife.cnf");
  EXPECT_EQ(qmove.configuration.place.line, 3);
  EXPECT_EQ(qmove.configuration.place.column, 20);
  EXPECT_THAT(words(qmove.tasks), ElementsAre("programs/a.mod", "programs/b.mod"));
  EXPECT_EQ(qmove.cycle, 4 * millisecond);
  EXPECT_EQ(qmove.retentive.text, "knife.state");
  ASSERT_EQ(qmove.set.size(), 2U);
  EXPECT_EQ(qmove.set[1].first.text, "AxisX.pgain");
  EXPECT_EQ(qmove.set[1].second, -5.5);
}

TEST(ScenarioRead, WiringKeepsTheOrderOfTheFile) {
  const auto scenario = sound("wiring: {2.CNT02: web.wheel, 2.CNT01: knife.encoder}\n");
  ASSERT_EQ(scenario.wiring.size(), 2U);
  EXPECT_EQ(scenario.wiring[0].terminal.text, "2.CNT02");
  EXPECT_EQ(scenario.wiring[0].plug.text, "web.wheel");
  EXPECT_EQ(scenario.wiring[1].plug.place.column, 39);
}

TEST(ScenarioRead, Timeline) {
  const auto scenario = sound(R"(timeline:
  - {at: 0.5 s, set: {panel.start: on, web.speed: 80 m/min}}
  - {when: "AxisX.st_sync == 1", after: 2 s, fault: {knife.encoder: {lose_counts: 200, stuck: true}}}
  - {at: 3 s, every: 1 s, ramp: {web.speed: 0 m/min}, over: 250 ms}
  - {at: 9 s, power: off}
)");
  ASSERT_EQ(scenario.timeline.size(), 4U);
  const auto& first = scenario.timeline[0];
  EXPECT_EQ(first.at, 500 * millisecond);
  EXPECT_FALSE(first.when);
  ASSERT_EQ(first.set.size(), 2U);
  EXPECT_EQ(first.set[0].second.number, 1);
  EXPECT_EQ(first.set[0].second.unit, "");
  EXPECT_EQ(first.set[1].second.number, 80);
  EXPECT_EQ(first.set[1].second.unit, "m/min");
  EXPECT_EQ(first.place.line, 2);
  const auto& second = scenario.timeline[1];
  EXPECT_EQ(second.when->text, "AxisX.st_sync == 1");
  EXPECT_EQ(second.when->place.column, 13);  // behind the quote
  EXPECT_EQ(second.after, 2 * sim::second);
  ASSERT_EQ(second.faults.size(), 2U);
  EXPECT_EQ(second.faults[0].component.text, "knife.encoder");
  EXPECT_EQ(second.faults[0].fault.text, "lose_counts");
  EXPECT_EQ(second.faults[0].value.number, 200);
  EXPECT_EQ(second.faults[1].value.number, 1);
  EXPECT_EQ(scenario.timeline[2].every, sim::second);
  EXPECT_EQ(scenario.timeline[2].over, 250 * millisecond);
  EXPECT_EQ(scenario.timeline[2].ramp[0].first.text, "web.speed");
  EXPECT_EQ(scenario.timeline[3].power, false);
}

TEST(ScenarioRead, Checks) {
  const auto scenario = sound(R"(checks:
  - {name: cut length, each: cut, from: 3 s, until: 8 s, expect: abs(length - 500) <= 0.2, at_least: 5}
  - {name: spread, all: knife.cut, expect: "sd_length < 0.05"}
  - {name: follows, always: "abs(AxisX.follerr) < 400", from: 2 s}
  - {name: locks on, eventually: "AxisX.st_sync == 1", within: 1.5 s}
  - {name: whole, never: tear}
  - {name: warm, always: rms(knife.motor.torque) <= 9.5 N m, every: 800 ms}
)");
  ASSERT_EQ(scenario.checks.size(), 6U);
  const auto& each = scenario.checks[0];
  EXPECT_EQ(each.kind, CheckRequest::Kind::each);
  EXPECT_EQ(each.name.text, "cut length");
  EXPECT_EQ(each.event.text, "cut");
  EXPECT_EQ(each.expression.text, "abs(length - 500) <= 0.2");
  EXPECT_EQ(each.from, 3 * second);
  EXPECT_EQ(each.until, 8 * second);
  EXPECT_EQ(each.at_least, 5);
  EXPECT_EQ(scenario.checks[1].kind, CheckRequest::Kind::all);
  EXPECT_EQ(scenario.checks[1].event.text, "knife.cut");
  EXPECT_EQ(scenario.checks[2].kind, CheckRequest::Kind::always);
  EXPECT_EQ(scenario.checks[2].expression.text, "abs(AxisX.follerr) < 400");
  EXPECT_EQ(scenario.checks[3].kind, CheckRequest::Kind::eventually);
  EXPECT_EQ(scenario.checks[3].within, 1500 * millisecond);
  EXPECT_EQ(scenario.checks[4].kind, CheckRequest::Kind::never);
  EXPECT_EQ(scenario.checks[4].event.text, "tear");
  EXPECT_EQ(scenario.checks[5].expression.text, "rms(knife.motor.torque) <= 9.5 N m");
  EXPECT_EQ(scenario.checks[5].every, 800 * millisecond);
}

TEST(ScenarioRead, RecordAndPictures) {
  const auto scenario = sound(R"(record: {every: 1 ms, channels: [AxisX.posit, 2.AN01]}
pictures:
  frames: {every: 20 ms, from: 1 s, until: 4 s, camera: close_up, size: 1920x1080}
  caption: [web.speed]
  plots:
    - name: follow
      panels:
        - {title: error, channels: [AxisX.follerr], limits: [-0.5, 400]}
        - {title: drive, channels: [2.AN01, knife.torque]}
      from: 1 s
      until: 2 s
    - {name: cuts, title: Cut length, against: number, panels: [{event: cut, values: [length, force]}]}
)");
  EXPECT_EQ(scenario.record.every, millisecond);
  EXPECT_THAT(words(scenario.record.channels), ElementsAre("AxisX.posit", "2.AN01"));
  const auto& pictures = scenario.pictures;
  EXPECT_TRUE(pictures.frames);
  EXPECT_EQ(pictures.every, 20 * millisecond);
  EXPECT_EQ(pictures.from, second);
  EXPECT_EQ(pictures.until, 4 * second);
  EXPECT_EQ(pictures.camera.shows.text, "close_up");
  EXPECT_EQ(pictures.width, 1920);
  EXPECT_EQ(pictures.height, 1080);
  EXPECT_THAT(words(pictures.caption), ElementsAre("web.speed"));
  ASSERT_EQ(pictures.plots.size(), 2U);
  const auto& follow = pictures.plots[0];
  EXPECT_EQ(follow.title, "follow");  // the name, for want of a title
  EXPECT_EQ(follow.from, second);
  EXPECT_FALSE(follow.against_number);
  ASSERT_EQ(follow.panels.size(), 2U);
  EXPECT_THAT(*follow.panels[0].limits, Pair(-0.5, 400));
  EXPECT_THAT(words(follow.panels[1].channels), ElementsAre("2.AN01", "knife.torque"));
  const auto& cuts = pictures.plots[1];
  EXPECT_EQ(cuts.title, "Cut length");
  EXPECT_TRUE(cuts.against_number);
  EXPECT_EQ(cuts.panels[0].event.text, "cut");
  EXPECT_THAT(words(cuts.panels[0].values), ElementsAre("length", "force"));
}

TEST(ScenarioRead, CarriageReturnsAreNoMatter) {
  const auto scenario = sound("scene: {title: x}\r\nrecord: {every: 4 ms}\r\n");
  EXPECT_EQ(scenario.scene.title, "x");
  EXPECT_EQ(scenario.record.place.line, 2);
  EXPECT_EQ(scenario.record.place.column, 9);
}

TEST(ScenarioRead, EveryByteOfATextKnowsItsPlace) {
  const auto scenario = sound(
      "checks:\n"
      "- {name: a, always: \"x < 1 &&\n"
      "     y\\u0020> 2 && z < 3\"}\n"
      "- {name: b, always: 'x < 1   \n"
      "    && y > 2'}\n"
      "- name: c\n"
      "  always: x < 1 &&\n"
      "    y > 2\n"
      "- name: d\n"
      "  always: |\n"
      "    x < 1 &&\n"
      "    y > 2\n");
  const auto place = [&](std::size_t check, std::string_view what) {
    const auto& text = scenario.checks.at(check).expression;
    const auto at = text.at(text.text.find(what));
    return std::make_pair(at.line, at.column);
  };
  EXPECT_THAT(place(0, "x"), Pair(2, 22));
  EXPECT_THAT(place(0, "&&"), Pair(2, 28));
  EXPECT_THAT(place(0, "y"), Pair(3, 6));
  EXPECT_THAT(place(0, ">"), Pair(3, 13));
  EXPECT_THAT(place(0, "z"), Pair(3, 20));
  EXPECT_THAT(place(1, "&&"), Pair(5, 5));
  EXPECT_THAT(place(1, "y"), Pair(5, 8));
  EXPECT_THAT(place(2, "&&"), Pair(7, 17));
  EXPECT_THAT(place(2, "y"), Pair(8, 5));
  EXPECT_THAT(place(3, "x"), Pair(11, 5));
  EXPECT_THAT(place(3, "y"), Pair(12, 5));
}

TEST(ScenarioRead, ColumnsCountCharacters) {
  EXPECT_THAT(problems_of("scene: {title: \"L\xC3\xA4nge \xE2\x89\xA4 5\", stepp: 1 ms}\n"),
              ElementsAre("1:29: unknown key 'stepp' in scene; did you mean step? [scenario.unknown-key]"));
}

TEST(ScenarioRead, ReadsAFile) {
  const auto file = std::filesystem::path(::testing::TempDir()) / "scenario_read_test.yaml";
  std::ofstream(file) << "scene: {title: from a file, stp: 1 ms}\n";
  Problems problems;
  const auto scenario = read_scenario(file, {}, problems, fakes::fake_types);
  EXPECT_EQ(scenario.scene.title, "from a file");
  EXPECT_EQ(scenario.file, file);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(to_string(problems[0]),
            file.string() + ":1:29: unknown key 'stp' in scene; did you mean step? [scenario.unknown-key]");
  std::filesystem::remove(file);
}

TEST(ScenarioRead, MissingFileAndFolderAreProblems) {
  Problems problems;
  const auto nowhere = read_scenario("/nowhere/line.yaml", {}, problems, fakes::fake_types);
  EXPECT_FALSE(nowhere.buildable);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].file, "/nowhere/line.yaml");
  EXPECT_EQ(problems[0].line, 1);
  problems.clear();
  read_scenario(::testing::TempDir(), {}, problems, fakes::fake_types);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_NE(problems[0].what.find("not a regular file"), std::string::npos);
}

}  // namespace
}  // namespace drycut::sim::scenario
