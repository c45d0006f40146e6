// Recorded channels that drive a line.
#include "sim/loop/inputs.hpp"

#include <gmock/gmock.h>

#include <memory>
#include <string>
#include <vector>

#include "base/state_archive.hpp"
#include "sim/loop/bus.hpp"
#include "sim/loop/disturbances.hpp"
#include "sim/loop/fingerprint.hpp"
#include "sim/loop/simulation.hpp"
#include "sim/loop/timeline.hpp"
#include "sim/scenario/archive.hpp"
#include "tests/loop/fakes.hpp"
#include "tests/test_folder.hpp"

namespace drycut::sim {
namespace {

using fakes::text;
using scenario::RecordedInput;
using testing::ElementsAre;
using testing::HasSubstr;

/// A plant with a live parameter that counts how often it is set.
class DrivenPlant : public fakes::FakePlant {
 public:
  std::vector<plants::Setting> settings() override {
    auto all = FakePlant::settings();
    all.push_back(
        {"count", "", [this](double v) { count = v; }, [this] { return count; }, "", plants::in_counts});
    return all;
  }
  plants::Parameters live_parameters() override {
    return {plants::live(plants::row("mass", "kg", "", mass, 1, 100, ""))};
  }
  void parameters_changed() override { ++changes; }
  double mass = 20;
  double count = 0;
  int changes = 0;
};

struct InputsTest : testing::Test {
  InputsTest() {
    scenario.file = folder / "line.yaml";
    scenario.sources = {"line.yaml"};
    scenario.scene.step = millisecond;
    panel.switches["start"];
    controller.values["slLength"] = 800;
    // It begins at 5 ms; speed has no sample before 10 ms.
    folder.file("r.csv", "t;v;m;on;x\n5;;20;0;1\n10;60;20;2.5;2\n15;120;30;0;-9\n25;60;30;0;4\n");
    folder.file("r.yaml", R"(file: r.csv
separator: semicolon
time: {column: t, unit: ms}
channels:
  web.speed: {column: v, unit: m/min}
  web.mass: {column: m, unit: kg}
  on: {column: on, unit: ""}
  volts: {column: x, unit: V, clipped: -9}
)");
  }
  RecordedInput& add(const std::string& name, const std::string& channel) {
    scenario.inputs.push_back({text(name, 3, 4), text("r.yaml", 5, 6), text(channel, 7, 8)});
    return scenario.inputs.back();
  }
  RecordedInput& hold(const std::string& name, const std::string& channel) {
    auto& input = add(name, channel);
    input.interpolate = RecordedInput::Between::hold;
    return input;
  }
  void make() {
    names.emplace(std::vector<loop::NamedPlant>{{"web", &plant}}, &controller, panel);
    inputs.emplace(scenario, std::vector<loop::NamedPlant>{{"web", &plant}}, *names, problems, notes);
  }
  /// What `read` says in each step.
  template <typename Read>
  std::vector<double> each_step(Time duration, Read read) {
    make();
    EXPECT_TRUE(problems.empty()) << to_string(problems.front());
    std::vector<double> all;
    for (Time now = 0; now < duration; now += scenario.scene.step) {
      inputs->run(now);
      all.push_back(read());
    }
    return all;
  }
  std::vector<std::string> told() {
    make();
    std::vector<std::string> all;
    for (const auto& problem : problems) all.push_back(to_string(problem));
    return all;
  }

  TestFolder folder;
  scenario::Scenario scenario;
  fakes::FakeController controller;
  DrivenPlant plant;
  loop::OperatorPanel panel;
  Problems problems;
  std::vector<Finding> notes;
  std::optional<loop::Names> names;
  std::optional<loop::Inputs> inputs;
};

// Its zero is the first sample of any channel, at 5 ms; speed is 60 until 5, 120 at 10, 60 from 20 ms on.
TEST_F(InputsTest, AreStraightBetweenSamplesAndHoldTheEnds) {
  add("web.speed", "web.speed");
  const auto all = each_step(30 * millisecond, [&] { return plant.speed * 60; });
  EXPECT_NEAR(all[0], 60, 1e-9);
  EXPECT_NEAR(all[5], 60, 1e-9);
  EXPECT_NEAR(all[7], 84, 1e-9);
  EXPECT_NEAR(all[10], 120, 1e-9);
  EXPECT_NEAR(all[15], 90, 1e-9);
  EXPECT_NEAR(all[20], 60, 1e-9);
  EXPECT_NEAR(all[29], 60, 1e-9);
  EXPECT_EQ(inputs->end().at, never);
}

TEST_F(InputsTest, HoldAsTheyWere) {
  hold("web.speed", "web.speed").after_end = RecordedInput::AfterEnd::stop;
  const auto all = each_step(30 * millisecond, [&] { return plant.speed * 60; });
  EXPECT_NEAR(all[9], 60, 1e-9);
  EXPECT_NEAR(all[10], 120, 1e-9);
  EXPECT_NEAR(all[19], 120, 1e-9);
  EXPECT_NEAR(all[20], 60, 1e-9);
  EXPECT_EQ(inputs->end().at, 20 * millisecond);
  EXPECT_EQ(inputs->end().of, "web.speed");
}

TEST_F(InputsTest, WorkSwitchesAndPlugsWithoutAWire) {
  hold("panel.start", "on");
  hold("web.enable", "on");
  add("web.reference", "volts");
  const auto start = each_step(25 * millisecond, [&] { return panel.switches["start"].level ? 1.0 : 0.0; });
  for (std::size_t i = 0; i < start.size(); ++i) EXPECT_EQ(start[i], i >= 5 && i < 10 ? 1 : 0) << i;
  EXPECT_EQ(panel.pressed.count("start"), 1U);
  const auto enable = each_step(25 * millisecond, [&] { return plant.enable.level ? 1.0 : 0.0; });
  EXPECT_EQ(enable, start);
  // 1 V, 2 V at 5 ms, the clipped one left out, 4 V at 20 ms.
  const auto volts = each_step(25 * millisecond, [&] { return plant.reference.volts; });
  EXPECT_NEAR(volts[5], 2, 1e-9);
  EXPECT_NEAR(volts[11], 2.8, 1e-9);
  EXPECT_NEAR(volts[20], 4, 1e-9);
}

// What costs something when it is set is set when it changes.
TEST_F(InputsTest, WriteWhatHasChangedOnly) {
  hold("web.mass", "web.mass");
  each_step(30 * millisecond, [] { return 0.0; });
  EXPECT_DOUBLE_EQ(plant.mass, 30);
  EXPECT_EQ(plant.changes, 2);
}

TEST_F(InputsTest, ADisturbanceIsAddedToThem) {
  add("web.speed", "web.speed");
  auto& step = scenario.disturbances.emplace_back();
  step.kind = scenario::Disturbance::Kind::step;
  step.at = text("web.speed");
  step.amplitude = {6, "m/min", {}};
  names.emplace(std::vector<loop::NamedPlant>{{"web", &plant}}, &controller, panel);
  loop::Disturbances disturbances(scenario, *names, problems);
  inputs.emplace(scenario, std::vector<loop::NamedPlant>{{"web", &plant}}, *names, problems, notes);
  ASSERT_TRUE(problems.empty());
  for (Time now = 0; now <= 7 * millisecond; now += millisecond) {
    inputs->run(now);
    disturbances.run(now);
  }
  EXPECT_NEAR(plant.speed * 60, 90, 1e-9);
}

TEST_F(InputsTest, GoOnFromAnyMoment) {
  hold("web.mass", "web.mass");
  add("web.speed", "web.speed");
  make();
  const auto run = [&](Time from, Time to) {
    for (Time now = from; now < to; now += millisecond) inputs->run(now);
  };
  run(0, 8 * millisecond);
  StateArchive::Bytes kept;
  StateArchive::save(kept, *inputs);
  plant.changes = 0;
  run(8 * millisecond, 13 * millisecond);
  const double speed = plant.speed;
  EXPECT_EQ(plant.changes, 1);
  run(13 * millisecond, 30 * millisecond);
  auto archive = StateArchive::restoring(kept.data(), kept.size());
  inputs->visit(archive);
  plant.changes = 0;
  inputs->run(8 * millisecond);
  EXPECT_EQ(plant.changes, 0) << "the mass of that moment is part of the plant's state";
  run(9 * millisecond, 13 * millisecond);
  EXPECT_EQ(plant.changes, 1);
  EXPECT_EQ(plant.speed, speed);
}

// Noise about standstill is no reason to refuse a recording.
TEST_F(InputsTest, BeyondTheRangeTheyStayAtTheLimitAndSaySo) {
  folder.file("r.csv", "t;v;m;on;x\n5;-0.2;20;0;1\n10;60;20;0;2\n15;301;30;0;3\n");
  add("web.speed", "web.speed");
  const auto all = each_step(12 * millisecond, [&] { return plant.speed * 60; });
  EXPECT_EQ(all.front(), 0);
  EXPECT_NEAR(all.back(), 300, 1e-9);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes.front().code, "input.beyond-range");
  EXPECT_THAT(notes.front().text, HasSubstr("2 samples"));
  EXPECT_THAT(notes.front().text, HasSubstr("-0.2 m/min at 0 s"));
}

TEST_F(InputsTest, NothingElseSetsWhatIsDriven) {
  add("web.speed", "web.speed");
  auto& set = scenario.timeline.emplace_back();
  set.at = 0;
  set.set = {{text("web.speed", 9, 10), {3, "m/s", {9, 20}}}};
  make();
  loop::Timeline timeline(scenario, *names, &controller, problems);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(
      to_string(problems.front()),
      "line.yaml:9:10: web.speed is driven by a recording: what is set here would not last; leave it out "
      "here, or what drives it [input.driven-twice]");
}

TEST_F(InputsTest, WhatDoesNotFitIsToldWithItsPlace) {
  scenario.wiring.push_back({text("1.AN01"), text("web.reference")});
  add("web.sped", "web.speed");
  add("web.speed", "web.spee");
  add("web.speed", "web.mass");
  add("slLength", "web.speed");
  add("web.reference", "volts");
  add("panel.start", "on");
  add("web.count", "on");
  hold("web.count", "on");
  add("web.encoder", "on");
  EXPECT_THAT(
      told(),
      ElementsAre(
          "line.yaml:3:4: nothing called 'web.sped' can be driven; did you mean web.speed? "
          "[timeline.nothing-to-set]",
          "line.yaml:7:8: r.yaml has no channel 'web.spee'; did you mean web.speed? [input.no-channel]",
          "line.yaml:7:8: web.speed is a speed (m/min), the channel web.mass is a mass (kg); name another "
          "channel, or give its column in m/min [scenario.wrong-unit]",
          "line.yaml:7:8: slLength is a pure number, the channel web.speed is a speed (m/s); name another "
          "channel, or give its column in the recording's YAML the unit \"\" [scenario.wrong-unit]",
          "line.yaml:3:4: web.reference is wired to 1.AN01, which drives it; leave the wire out, or this "
          "input "
          "[input.driven-twice]",
          "line.yaml:3:4: panel.start is on or off: there is nothing between two samples; add interpolate: "
          "hold [scenario.does-not-go-together]",
          "line.yaml:3:4: web.count takes whole numbers: there is nothing between two samples; add "
          "interpolate: hold [scenario.does-not-go-together]",
          "line.yaml:7:8: web.count takes whole numbers, on has 2.5 at 0.005 s; give its column another "
          "unit, "
          "of or scale in the recording's YAML [scenario.not-a-number]",
          HasSubstr("line.yaml:3:4: nothing called 'web.encoder' can be driven")));
}

TEST_F(InputsTest, WhatCannotBeReadIsToldOnceWhereItIs) {
  add("web.speed", "web.speed");
  add("web.mass", "web.mass");
  folder.file("r.yaml", "file: none.csv\nchannels:\n  web.speed: {column: v, unit: m/min}\n");
  auto all = told();
  ASSERT_EQ(all.size(), 1U);
  EXPECT_THAT(all.front(), HasSubstr("r.yaml:1:7: there is no file"));
  problems.clear();
  std::filesystem::remove(folder / "r.yaml");
  all = told();
  ASSERT_EQ(all.size(), 1U);
  EXPECT_THAT(all.front(), HasSubstr("line.yaml:5:6: there is no file"));
}

/// A line of the reader's, with its recording beside it.
struct DrivenLine : InputsTest {
  scenario::Scenario read(const std::string& inputs) {
    return scenario::read_scenario_text(
        "scene: {step: 1 ms, duration: 100 ms}\nplants: {web: {type: web, drive: {acceleration: 1000 "
        "m/s2}}}\n"
        "inputs:\n  " +
            inputs + "\nrecord: {every: 1 ms, channels: [web.speed]}\n",
        folder / "line.yaml", {}, problems);
  }
};

TEST_F(DrivenLine, ReadsWritesAndEndsWithItsRecording) {
  const auto line = read("web.speed: {recording: r.yaml, after_end: stop}");
  ASSERT_TRUE(problems.empty()) << to_string(problems.front());
  EXPECT_EQ(line.inputs.front().channel.text, "web.speed");
  EXPECT_THAT(scenario::expand(line),
              HasSubstr("inputs:\n  web.speed: {recording: r.yaml, channel: web.speed, interpolate: linear, "
                        "after_end: stop}\n"));
  loop::Simulation simulation(line, problems);
  ASSERT_TRUE(problems.empty()) << to_string(problems.front());
  const auto outcome = simulation.run();
  EXPECT_EQ(outcome.end, 20 * millisecond);
  const auto said = simulation.notes();
  EXPECT_TRUE(std::ranges::any_of(said, [](const Finding& note) { return note.code == "input.over"; }));
  // Its mass takes a while to follow.
  const auto& speeds = simulation.recording().column("web.speed")->values;
  EXPECT_NEAR(speeds[5], 60, 1e-6);
  EXPECT_GT(speeds[12], 75);
}

TEST_F(DrivenLine, TellsKeysAndWords) {
  const auto codes = [&](const std::string& inputs) {
    problems.clear();
    read(inputs);
    std::vector<std::string> all;
    for (const auto& problem : problems) all.emplace_back(problem.code.text());
    return all;
  };
  EXPECT_THAT(codes("web.speed: {recordin: r.yaml, interpolate: cubic}"),
              testing::UnorderedElementsAre("scenario.unknown-key", "scenario.unknown-choice"));
  EXPECT_THAT(codes("web.speed: {after_end: stop}"), ElementsAre("scenario.missing-key"));
  EXPECT_THAT(codes("{web.speed: {recording: r.yaml}, web.speed: {recording: r.yaml}}"),
              ElementsAre("scenario.twice"))
      << "two drives of one target";
}

TEST_F(DrivenLine, IsAnotherOneWithAnotherRecording) {
  const auto value = [&] {
    const auto line = read("web.speed: {recording: r.yaml}");
    loop::Fingerprint hash;
    hash.add(line);
    return hash.value();
  };
  const auto before = value();
  EXPECT_EQ(before, value());
  folder.file("r.csv", "t;v;m;on;x\n5;;20;0;1\n10;60;20;2.5;2\n15;120;30;0;-9\n25;61;30;0;4\n");
  const auto another_export = value();
  EXPECT_NE(before, another_export);
  folder.file("r.yaml", "file: r.csv\nchannels:\n  web.speed: {column: v, unit: km/h}\n");
  EXPECT_NE(another_export, value());
}

TEST_F(DrivenLine, GoesOnFromAnyMoment) {
  const auto line = read("web.speed: {recording: r.yaml}");
  loop::Simulation whole(line, problems);
  loop::Simulation again(line, problems);
  ASSERT_TRUE(problems.empty()) << to_string(problems.front());
  for (auto* one : {&whole, &again}) one->keep_nothing();
  const auto run_to = [](loop::Simulation& one, Time time) {
    while (one.time() < time && one.advance()) continue;
  };
  run_to(whole, 8 * millisecond);
  const auto kept = whole.save();
  run_to(whole, 14 * millisecond);
  run_to(again, 30 * millisecond);
  again.restore(kept);
  run_to(again, 14 * millisecond);
  EXPECT_EQ(whole.save(), again.save());
}

}  // namespace
}  // namespace drycut::sim
