// Overrides, the scenario written back, and texts that nobody meant to write.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "sim/scenario/format.hpp"
#include "tests/loop/scenario/fake_plants.hpp"

namespace drycut::sim::scenario {
namespace {

using fakes::FakeKnife;
using fakes::FakeWeb;
using fakes::problems_of;
using fakes::read;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string line = R"(scene: {title: "Rotary: 800 mm", step: 100 us, duration: 12 s}
plants:
  knife:
    type: rotary_knife
    circumference: 23.622047 in
    servo: {rated_torque: 9.5 Nm, loop: {gain: 0.1}}
    angle: -90 deg
  web: {type: web, speed: 0.7 m/s, slip: 0.3 %}
controller:
  qmove: {configuration: programs/a.cnf, tasks: [programs/a.mod], set: {slLength: 8000}}
wiring: {2.CNT01: knife.encoder, 2.INP01: panel.start}
timeline:
  - {at: 0.5 s, set: {panel.start: on, web.speed: -0.1 m/min}}
  - {when: "AxisX.st_sync == 1", after: 2 s, fault: {knife.encoder: {lose_counts: 200, stuck: 1}}}
  - {at: 3 s, ramp: {web.speed: 80 m/min}, over: 1.0005 s}
  - {at: 5 s, every: 1 s, power: off}
record: {every: 2 ms, channels: [AxisX.posit, 2.AN01]}
checks:
  - {name: "cut: length", each: cut, from: 3 s, expect: "abs(length - 500) <= 0.2"}
  - {name: follows, always: "abs(AxisX.follerr) < 400", until: 2 s}
  - {name: locks on, eventually: "x == 1", within: 1.5 s}
  - {name: spread, all: cut, expect: "sd_length < 0.05", at_least: 10}
  - {name: whole, never: tear}
pictures:
  frames: {every: 40 ms, camera: overview, size: 640x480, until: 4 s}
  caption: [web.speed]
  plots:
    - {name: follow, panels: [{title: "err [counts] \"x\"", channels: [AxisX.follerr], limits: [-1, 0.1]}], from: 1 s}
    - {name: cuts, against: number, until: 3 s, panels: [{event: cut, values: [length]}]}
)";

TEST(ScenarioOverride, ReplacesWhatTheFileSays) {
  std::vector<std::string> problems;
  const auto scenario = read(line, problems,
                             {{"plants.web.speed", "80 m/min"},
                              {"plants.knife.servo.rated_torque", "5 N m"},
                              {"checks.0.expect", "abs(length - 800) <= 1"},
                              {"checks.locks on.within", "2 s"},
                              {"pictures.plots.cuts.until", "5 s"},
                              {"wiring.2.CNT01", "web.wheel"},
                              {"controller.qmove.set.slLength", "5000"},
                              {"timeline.0.set.panel.start", "off"},
                              {"record.channels", "[web.speed]"}});
  EXPECT_THAT(problems, IsEmpty());
  EXPECT_EQ(dynamic_cast<FakeWeb&>(*scenario.plants[0].definition).speed, 80 / 60.0);
  EXPECT_EQ(dynamic_cast<FakeKnife&>(*scenario.plants[1].definition).rated_torque, 5);
  EXPECT_EQ(scenario.checks[0].expression.text, "abs(length - 800) <= 1");
  EXPECT_EQ(scenario.checks[2].within, 2 * second);
  EXPECT_EQ(scenario.pictures.plots[1].until, 5 * second);
  EXPECT_EQ(scenario.wiring[0].plug.text, "web.wheel");
  EXPECT_EQ(scenario.controller->set[0].second, 5000);
  EXPECT_EQ(scenario.timeline[0].set[0].second.number, 0);
  ASSERT_EQ(scenario.record.channels.size(), 1U);
}

TEST(ScenarioOverride, AddsWhatTheFileLeavesAtItsDefault) {
  std::vector<std::string> problems;
  const auto scenario = read("plants: {k: {type: rotary_knife}, web: {type: web}}\n", problems,
                             {{"plants.k.gear.stiffness", "5 N m/rad"},
                              {"plants.web.mass", "7 kg"},
                              {"scene.seed", "9"},
                              {"wiring.2.INP01", "panel.start"},
                              {"pictures.frames", "{every: 20 ms}"},
                              {"pictures.frames.camera", "overview"},
                              {"checks", "[{name: a, never: tear}]"}});
  EXPECT_THAT(problems, IsEmpty());
  EXPECT_EQ(dynamic_cast<FakeKnife&>(*scenario.plants[1].definition).stiffness, 5);
  EXPECT_EQ(dynamic_cast<FakeWeb&>(*scenario.plants[0].definition).mass, 7);
  EXPECT_EQ(scenario.scene.seed, 9U);
  EXPECT_EQ(scenario.wiring.at(0).terminal.text, "2.INP01");
  EXPECT_EQ(scenario.pictures.every, 20 * millisecond);
  EXPECT_EQ(scenario.pictures.camera.shows.text, "overview");
  EXPECT_EQ(scenario.checks.size(), 1U);
}

TEST(ScenarioOverride, LastOneWins) {
  std::vector<std::string> problems;
  const auto scenario = read("scene: {seed: 1}\n", problems, {{"scene.seed", "2"}, {"scene.seed", "3"}});
  EXPECT_THAT(problems, IsEmpty());
  EXPECT_EQ(scenario.scene.seed, 3U);
}

TEST(ScenarioOverride, FaultsCarryItsName) {
  const struct {
    const char* path;
    const char* value;
    const char* problem;
  } cases[] = {
      {"plants.web.speed", "80 m/mim",
       "--set plants.web.speed:1:4: plants.web.speed: unknown unit 'm/mim'; did you mean m/min? "
       "[scenario.unknown-unit]"},
      {"plants.wbe.speed", "1 m/s",
       "--set plants.wbe.speed:1:1: there is no 'wbe' in plants; did you mean web? [option.set-path]"},
      {"plant.web.speed", "1 m/s",
       "--set plant.web.speed:1:1: there is no 'plant' in the scenario; did you mean plants? "
       "[option.set-path]"},
      {"scene.stp", "1 ms",
       "--set scene.stp:1:1: unknown key 'stp' in scene; did you mean step? [scenario.unknown-key]"},
      {"plants.web.sped", "1 m/s",
       "--set plants.web.sped:1:1: unknown key 'sped' in plants.web; did you mean speed? "
       "[scenario.unknown-key]"},
      {"scene.step.x", "1",
       "--set scene.step.x:1:1: scene.step is a single value; nothing is below it; --set scene.step=value "
       "[option.set-path]"},
      {"checks.9.name", "x",
       "--set checks.9.name:1:1: '9' is no entry of the list checks; 0 to 4, or cut: length, follows, locks "
       "on, spread, whole [option.set-path]"},
      {"timeline.one.at", "1 s",
       "--set timeline.one.at:1:1: 'one' is no entry of the list timeline; 0 to 3 [option.set-path]"},
      {"checks.cut lenght.from", "1 s",
       "--set checks.cut lenght.from:1:1: 'cut lenght' is no entry of the list checks; did you mean cut: "
       "length? [option.set-path]"},
      {"checks.0.expect", "length < ",
       "--set checks.0.expect:1:9: the expression ends where a value must follow; add a name or a number "
       "[expression.syntax]"},
      {"checks.0.", "x",
       "--set checks.0.:1:1: the path ends with a dot or is empty; write section.key=value "
       "[option.set-path]"},
      {"", "x",
       "--set :1:1: the path ends with a dot or is empty; write section.key=value [option.set-path]"},
      {"scene.title", "[a",
       "--set scene.title:1:1: the list opened at line 1, column 1 is not closed; write ] or "
       "a comma here [scenario.yaml-syntax]"},
      {"scene.title", "",
       "1:9: scene.title has no value; give it one, or leave the key out [scenario.no-value]"},
      {"scene.title", "@",
       "--set scene.title:1:1: no YAML text begins like this; put the text into quotes "
       "[scenario.yaml-syntax]"},
  };
  for (const auto& [path, value, problem] : cases) {
    EXPECT_THAT(problems_of(line, {{path, value}}), ElementsAre(problem)) << path << '=' << value;
  }
}

TEST(ScenarioOverride, FaultsOfTheFileComeFirst) {
  EXPECT_THAT(problems_of("scene: {sed: 3}\n", {{"scene.stp", "1"}, {"scene.seed", "x"}}),
              ElementsAre(HasSubstr("1:9: unknown key 'sed'"), HasSubstr("--set scene.stp:1:1:"),
                          HasSubstr("--set scene.seed:1:1:")));
}

TEST(ScenarioExpand, ReadsBackToTheSameScenario) {
  std::vector<std::string> problems;
  const auto scenario = read(line, problems);
  const auto text = expand(scenario);
  const auto again = read(text, problems);
  EXPECT_THAT(problems, IsEmpty());
  EXPECT_EQ(expand(again), text);
  for (std::size_t i = 0; i < scenario.plants.size(); ++i) {
    const auto before = scenario.plants[i].definition->parameters();
    const auto after = again.plants[i].definition->parameters();
    for (std::size_t j = 0; j < before.size(); ++j) {
      std::visit(
          [&](auto* value) {
            EXPECT_EQ(*value, *std::get<decltype(value)>(after[j].value)) << before[j].name;  // to the bit
          },
          before[j].value);
    }
  }
  EXPECT_EQ(again.timeline.size(), scenario.timeline.size());
  EXPECT_EQ(again.timeline[2].over, 1000500 * microsecond);
  EXPECT_EQ(again.timeline[0].set[1].second.number, -0.1);
  EXPECT_EQ(again.checks[0].name.text, "cut: length");
  EXPECT_EQ(again.pictures.plots[0].panels[0].title, "err [counts] \"x\"");
}

TEST(ScenarioExpand, SaysEveryDefaultInItsUnit) {
  std::vector<std::string> problems;
  const auto text = expand(read("plants: {web: {type: web}, k: {type: rotary_knife}}\n", problems));
  EXPECT_EQ(text,
            "scene:\n"
            "  title: \"\"\n"
            "  step: 100 us\n"
            "  duration: 10 s\n"
            "  seed: 1\n"
            "plants:\n"
            "  web:\n"
            "    type: web\n"
            "    speed: 60 m/min\n"
            "    slip: 2 %\n"
            "    friction: 0.3\n"
            "    mass: 5.5 kg\n"
            "    lines: 2500\n"
            "    brake: false\n"
            "  k:\n"
            "    type: rotary_knife\n"
            "    web: web\n"
            "    circumference: 600 mm\n"
            "    angle: 0 deg\n"
            "    servo:\n"
            "      rated_torque: 9.5 N m\n"
            "      rated_speed: 2000 rpm\n"
            "    encoder:\n"
            "      mounting: motor\n"
            "    gear:\n"
            "      stiffness: 4000 N m/rad\n"
            "    servo.loop.gain: 1\n"
            "record:\n"
            "  format: csv\n"
            "  every: 2 ms\n"
            "  channels: []\n"
            "drives:\n"
            "  cycle: 0 s\n"
            "  judge: on\n"
            "pictures:\n"
            "  caption: []\n"
            "  plots: []\n");
}

TEST(ScenarioExpand, TimesAreExactAndShort) {
  const struct {
    Time time;
    const char* text;
  } cases[] = {{0, "0 s"},
               {1, "1 ns"},
               {999, "999 ns"},
               {100 * microsecond, "100 us"},
               {2 * millisecond, "2 ms"},
               {1500 * microsecond, "1.5 ms"},
               {1001 * microsecond + 1, "1001.001 us"},
               {second, "1 s"},
               {12 * second + 50 * millisecond, "12.05 s"},
               {1001 * millisecond + 1, "1001000.001 us"},
               {second + microsecond, "1000.001 ms"}};
  for (const auto& [time, text] : cases) EXPECT_EQ(format_time(time), text);
}

TEST(ScenarioExpand, AnyTextReadsBackAsItself) {
  for (const std::string& text : std::vector<std::string>{
           "",      "plain",   "a: b",         "- a",  "-",   "null", "~",    "true",       "a # b",
           "#a",    "\"q\"",   "it's",         "a\\b", "[a]", "{a}",  "a, b", "two\nlines", "tab\there",
           " lead", "trail ",  "two  blanks",  "&a",   "*a",  "!a",   "%a",   "@a",         "|",
           ">",     "-0.5 mm", "L\xC3\xA4nge", "? a",  "a:",  ":a",   "...",  "---",        "100 %"}) {
    std::vector<std::string> problems;
    const auto scenario = read("scene: {title: " + yaml_text(text) + "}\n", problems);
    EXPECT_THAT(problems, IsEmpty()) << text;
    EXPECT_EQ(scenario.scene.title, text);
  }
}

// A seeded change of a sound text: characters struck out, doubled, exchanged, or lines moved.
std::string mutate(std::string text, std::mt19937_64& random) {
  static const std::string characters = "{}[]:,-\"'#&*!|>%@`~ \n\t\\.0aZ\xC3\xFF";
  for (auto n = random() % 4 + 1; n > 0 && !text.empty(); --n) {
    const auto at = random() % text.size();
    switch (random() % 5) {
      case 0:
        text.erase(at, random() % 20 + 1);
        break;
      case 1:
        text[at] = characters[random() % characters.size()];
        break;
      case 2:
        text.insert(at, 1, characters[random() % characters.size()]);
        break;
      case 3:
        text.insert(at, text.substr(random() % text.size(), random() % 40));
        break;
      default:
        text.resize(at);
    }
  }
  return text;
}

TEST(ScenarioExpand, NoTextCrashesTheReader) {
  std::mt19937_64 random(20240607);
  int sound = 0;
  for (int i = 0; i < 4000; ++i) {
    const auto text = mutate(line, random);
    std::vector<std::string> problems;
    const auto scenario = read(text, problems);
    for (const auto& problem : problems) {
      EXPECT_TRUE(problem[0] >= '1' && problem[0] <= '9') << problem;
      EXPECT_EQ(problem.find(":0:"), std::string::npos) << problem;
    }
    if (!problems.empty()) continue;
    ++sound;
    const auto once = expand(scenario);
    const auto twice = expand(read(once, problems));
    EXPECT_THAT(problems, IsEmpty()) << text;
    EXPECT_EQ(once, twice);
  }
  EXPECT_GT(sound, 20);
  EXPECT_LT(sound, 3000);
}

}  // namespace
}  // namespace drycut::sim::scenario
