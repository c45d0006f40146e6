// What is wrong with a scenario, where, and what would be right: every message of the reader.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "devices/controller.hpp"
#include "tests/loop/scenario/fake_plants.hpp"

namespace drycut::sim::scenario {
namespace {

using fakes::problems_of;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

struct Case {
  std::string text;
  std::vector<std::string> problems;
};
void expect_problems(const std::vector<Case>& cases) {
  for (const auto& one : cases) EXPECT_EQ(problems_of(one.text), one.problems) << one.text.substr(0, 300);
}

TEST(ScenarioProblems, Text) {
  const std::string sections =
      "1:1: the scenario is empty; its sections are: extends, variables, scene, plants, fitted, controller, "
      "wiring, "
      "filters, panel, timeline, disturbances, inputs, record, drives, checks, faults, pictures, opcua "
      "[scenario.needs-another]";
  expect_problems({
      {"", {sections}},
      {"# only a comment\n", {sections}},
      {"---\n", {sections}},
      {"hello",
       {"1:1: a scenario must be a map, not a single value; write key: value, or {key: value} "
        "[scenario.wrong-kind]"}},
      {"- scene\n",
       {"1:1: a scenario must be a map, not a list; write key: value, or {key: value} "
        "[scenario.wrong-kind]"}},
      {std::string("scene: {}\nab\0c", 14),
       {"2:3: byte 0x00 is no text; a scenario is a YAML text in UTF-8 [scenario.yaml-syntax]"}},
      {"scene: {title: \xFF}",
       {"1:16: byte 0xff is no text; a scenario is a YAML text in UTF-8 [scenario.yaml-syntax]"}},
      {"scene: \xE2\x89",
       {"1:8: byte 0xe2 is no text; a scenario is a YAML text in UTF-8 [scenario.yaml-syntax]"}},
      {std::string(10'000'000, 'a'),  // NOLINT(bugprone-string-constructor)
       {"1:1: the text has 10000000 bytes; a scenario has at most 1048576 [scenario.yaml-not-taken]"}},
  });
}

TEST(ScenarioProblems, Yaml) {
  const std::string deep = "nested more than 100 levels deep; nest less";
  std::string spread;
  for (int i = 0; i < 200; ++i) spread += std::string(static_cast<std::size_t>(i), ' ') + "a:\n";
  expect_problems({
      {"scene: {step: 1 ms\n",
       {"2:1: the map opened at line 1, column 8 is not closed; write } or a comma here "
        "[scenario.yaml-syntax]"}},
      {"record: {channels: [a, b\nscene: {}\n",
       {"2:6: the list opened at line 1, column 20 is not closed; write ] or a comma here "
        "[scenario.yaml-syntax]"}},
      {"scene:\n\tstep: 1 ms\n",
       {"2:1: a tab in the indentation; indent with spaces [scenario.yaml-syntax]"}},
      {"scene: {title: @b}\n",
       {"1:16: no YAML text begins like this; put the text into quotes [scenario.yaml-syntax]"}},
      {"scene: a: b\n",
       {"1:9: a second ': ' behind a key; a text with a colon in it stands in quotes: title: \"saw: test\" "
        "[scenario.yaml-syntax]"}},
      {"scene: {title: \"abc}\nseed: 1\n",
       {"1:16: this quotation is not closed; end the text with the same quote [scenario.yaml-syntax]",
        "3:1: the map opened at line 1, column 8 is not closed; write } or a comma here "
        "[scenario.yaml-syntax]"}},
      {"scene: &x {title: *x}\n",
       {"1:8: anchors (&name) are not used in scenarios; write the value out [scenario.yaml-not-taken]",
        "1:19: aliases (*name) are not used in scenarios; write the value out [scenario.yaml-not-taken]"}},
      {"scene: {title: *x}\n",
       {"1:16: aliases (*name) are not used in scenarios; write the value out [scenario.yaml-not-taken]"}},
      {"scene: {title: !!str 4}\n",
       {"1:16: tags (!name) are not used in scenarios; write the value alone [scenario.yaml-not-taken]"}},
      {"scene: {}\n<<: {scene: {}}\n",
       {"2:1: unknown key '<<'; known: extends, variables, scene, plants, fitted, controller, wiring, "
        "filters, "
        "panel, timeline, disturbances, inputs, record, drives, checks, faults, pictures, opcua "
        "[scenario.unknown-key]"}},
      {"scene: {}\n---\nscene: {}\n",
       {"3:1: something stands after the end of the document; one document a file, and nothing after its "
        "closing bracket [scenario.yaml-not-taken]"}},
      {"{scene: {}} x\n",
       {"1:13: something stands after the end of the document; one document a file, and nothing after its "
        "closing bracket [scenario.yaml-not-taken]"}},
      {"? [scene]\n: {}\n", {"1:3: a list cannot be a key; write key: value [scenario.yaml-syntax]"}},
  });
  EXPECT_THAT(problems_of(std::string(10000, '[')), ElementsAre(HasSubstr(deep)));
  EXPECT_THAT(problems_of(std::string(10000, '{')), ElementsAre(HasSubstr(deep)));
  EXPECT_THAT(problems_of(spread), ElementsAre(HasSubstr(deep)));
  std::string dashes;
  for (int i = 0; i < 3000; ++i) dashes += "- ";
  EXPECT_THAT(problems_of(dashes), ElementsAre(HasSubstr(deep)));
}

TEST(ScenarioProblems, Keys) {
  expect_problems({
      {"sceen: {}\n", {"1:1: unknown key 'sceen'; did you mean scene? [scenario.unknown-key]"}},
      {"plant: {w: {type: web, sped: 1 m/s}}\n",
       {"1:1: unknown key 'plant'; did you mean plants? [scenario.unknown-key]",
        "1:24: unknown key 'sped' in plants.w; did you mean speed? [scenario.unknown-key]"}},
      {"scene: {step: 1 ms, step: 2 ms}\n",
       {"1:21: 'step' is given twice in scene; keep one; the first is at line 1 [scenario.twice]"}},
      {"scene: {}\nrecord: {}\nscene: {}\n",
       {"3:1: 'scene' is given twice in the file; keep one; the first is at line 1 [scenario.twice]"}},
      {"scene: {colour: red}\n",
       {"1:9: unknown key 'colour' in scene; known: title, step, duration, seed [scenario.unknown-key]"}},
      {"scene: 5\n",
       {"1:8: scene must be a map, not a single value; write key: value, or {key: value} "
        "[scenario.wrong-kind]"}},
      {"checks: {a: b}\n",
       {"1:9: checks must be a list, not a map; write [first, second], or a line '- ...' for each "
        "[scenario.wrong-kind]"}},
      {"scene: {title: [a]}\n",
       {"1:16: scene.title must be a single value, not a list; write one value [scenario.wrong-kind]"}},
      {"scene:\nrecord: {}\n",
       {"1:1: scene has no value; give it one, or leave the key out [scenario.no-value]"}},
      {"scene: {title: }\n",
       {"1:9: scene.title has no value; give it one, or leave the key out [scenario.no-value]"}},
      {"record: {channels: [a, [b]]}\n",
       {"1:24: record.channels.1 must be a single value, not a list; write one value [scenario.wrong-kind]"}},
  });
}

TEST(ScenarioProblems, Times) {
  expect_problems({
      {"scene: {step: 0.3 ns}\n",
       {"1:15: scene.step: 0.3 ns is no whole number of nanoseconds; the nearest is 1 ns "
        "[scenario.not-a-number]"}},
      {"scene: {step: 1e-16 s}\n",
       {"1:15: scene.step: 1e-16 s is no whole number of nanoseconds; the nearest is 1 ns "
        "[scenario.not-a-number]"}},
      {"record: {every: 1e-16 s}\npictures: {frames: {every: 1e-20 s}}\n",
       {"1:17: record.every: 1e-16 s is no whole number of nanoseconds; the nearest is 1 ns "
        "[scenario.not-a-number]",
        "2:28: pictures.frames.every: 1e-20 s is no whole number of nanoseconds; the nearest is 1 ns "
        "[scenario.not-a-number]"}},
      {"controller: {qmove: {configuration: a.cnf, cycle: 1e-16 s}}\n",
       {"1:51: controller.qmove.cycle: 1e-16 s is no whole number of nanoseconds; the nearest is 1 ns "
        "[scenario.not-a-number]"}},
      {"controller: {lx3vp: {program: a.il, scan: 1e-16 s}}\n",
       {"1:43: controller.lx3vp.scan: 1e-16 s is no whole number of nanoseconds; the nearest is 1 ns "
        "[scenario.not-a-number]"}},
      {"controller: {plcopen: {program: a.st, cycle: 1e-16 s, task_cycle: 1e-17 s}}\n",
       {"1:46: controller.plcopen.cycle: 1e-16 s is no whole number of nanoseconds; the nearest is 1 ns "
        "[scenario.not-a-number]",
        "1:67: controller.plcopen.task_cycle: 1e-17 s is no whole number of nanoseconds; the nearest is 1 ns "
        "[scenario.not-a-number]"}},
      {"timeline: [{at: 1e-16 s, power: off}]\n",
       {"1:17: timeline.0.at: 1e-16 s is no whole number of nanoseconds; the nearest is 1 ns "
        "[scenario.not-a-number]"}},
      {"scene: {step: 1 ns, duration: 1e8 s}\n",
       {"1:15: scene.duration 100000000 s takes 100000000000000000 steps of 1 ns; at most 9007199254740992 "
        "steps: a longer step or a shorter duration [scenario.time-grid]"}},
      {"scene: {step: 1.2345 us}\n",
       {"1:15: scene.step: 1.2345 us is no whole number of nanoseconds; the nearest is 1.235 us "
        "[scenario.not-a-number]"}},
      {"scene: {step: 5}\n",
       {"1:15: scene.step: '5' has no unit, but this is a time; write 5 s if that is meant "
        "[scenario.wrong-unit]"}},
      {"scene: {step: 5 mm}\n",
       {"1:17: scene.step is a time, not a length (mm); for example 1 s [scenario.wrong-unit]"}},
      {"scene: {step: 0 s}\n",
       {"1:15: scene.step is 0 s; it must be longer than 0; for example 2 ms [scenario.out-of-range]"}},
      {"scene: {duration: -1 s}\n",
       {"1:19: scene.duration is -1 s; it must be longer than 0; for example 2 ms [scenario.out-of-range]"}},
      {"scene: {duration: 1e10 s}\n",
       {"1:19: scene.duration is 1e10 s; the clock ends at 1e9 s; give a shorter time "
        "[scenario.out-of-range]"}},
      {"scene: {duration: soon}\n",
       {"1:19: scene.duration: 'soon' is not a number; write a number, with its unit if it has one: 0.5, 60 "
        "m/min [scenario.not-a-number]"}},
      {"scene: {duration: 10 sek}\n",
       {"1:22: scene.duration: unknown unit 'sek'; units are written like mm, m/min, N m, kg m^2, rpm, deg, "
        "% [scenario.unknown-unit]"}},
      {"checks: [{name: a, never: b, from: -1 s}]\n",
       {"1:36: checks.a.from is -1 s; it must not be negative; for example 0 s [scenario.out-of-range]"}},
      {"scene: {seed: -1}\n",
       {"1:15: scene.seed: '-1' is not a whole number; 0 to 18446744073709551615 [scenario.not-a-number]"}},
  });
}

TEST(ScenarioProblems, PeriodsThatDoNotFitTheStep) {
  expect_problems({
      {"scene: {step: 1 ms}\nrecord: {every: 2.5 ms}\n",
       {"2:17: record.every 2.5 ms is not a whole multiple of scene.step 1 ms; for example 2 ms or 3 ms "
        "[scenario.time-grid]"}},
      {"scene: {step: 3 ms}\nrecord: {channels: []}\n",
       {"2:9: record.every 2 ms is not a whole multiple of scene.step 3 ms; for example 3 ms "
        "[scenario.time-grid]"}},
      {"scene: {step: 3 ms, duration: 3 s}\n",
       {"1:1: record.every 2 ms is not a whole multiple of scene.step 3 ms; for example 3 ms "
        "[scenario.time-grid]"}},
      {"scene: {step: 2 ms}\npictures: {frames: {every: 33 ms}}\n",
       {"2:28: pictures.frames.every 33 ms is not a whole multiple of scene.step 2 ms; for example 32 ms or "
        "34 ms [scenario.time-grid]"}},
      {"scene: {step: 2 ms}\ncontroller: {qmove: {configuration: a.cnf, cycle: 5 ms}}\n",
       {"2:51: controller.qmove.cycle 5 ms is not a whole multiple of scene.step 2 ms; for example 4 ms or 6 "
        "ms [scenario.time-grid]"}},
      {"scene: {step: 2 ms, duration: 1 ms}\n",
       {"1:31: scene.duration 1 ms is shorter than scene.step 2 ms; let it last at least one step "
        "[scenario.time-grid]"}},
  });
}

TEST(ScenarioProblems, Plants) {
  const std::string lists = "; 'drycut plants web' lists its parameters [scenario.unknown-key]";
  expect_problems({
      {"plants: {k: {type: rotary_nife}}\n",
       {"1:20: unknown plant type 'rotary_nife'; did you mean rotary_knife? [plant.unknown-type]"}},
      {"plants: {k: {}}\n",
       {"1:10: plants.k.type is missing; known: axis, rotary_knife, web [scenario.missing-key]"}},
      {"plants: {k: {type: }}\n",
       {"1:10: plants.k.type is missing; known: axis, rotary_knife, web [scenario.missing-key]"}},
      {"plants: {k: {type: [web]}}\n",
       {"1:20: plants.k.type must be a single value, not a list; write one value [scenario.wrong-kind]"}},
      {"plants: {k: web}\n",
       {"1:13: plants.k must be a map, not a single value; write key: value, or {key: value} "
        "[scenario.wrong-kind]"}},
      {"plants: {k: }\n",
       {"1:10: plants.k must be a map, not nothing; write key: value, or {key: value} "
        "[scenario.wrong-kind]"}},
      {"plants: {a.b: {type: web}}\n",
       {"1:10: 'a.b' cannot name a plant; letters, digits and underscores; panel is the operator's panel "
        "[scenario.bad-name]"}},
      {"plants: {panel: {type: web}}\n",
       {"1:10: 'panel' cannot name a plant; letters, digits and underscores; panel is the operator's panel "
        "[scenario.bad-name]"}},
      {"plants:\n  a: {type: web}\n  a: {type: web}\n",
       {"3:3: 'a' is given twice in plants; keep one; the first is at line 2 [scenario.twice]"}},
      {"plants: {w: {type: web, sped: 3 m/s}}\n",
       {"1:25: unknown key 'sped' in plants.w; did you mean speed? [scenario.unknown-key]"}},
      {"plants: {w: {type: web, colour: red}}\n", {"1:25: unknown key 'colour' in plants.w" + lists}},
      {"plants: {w: {type: web, speed: 3 m/s, speed: 4 m/s}}\n",
       {"1:39: 'speed' is given twice in plants.w; keep one; the first is at line 1 [scenario.twice]"}},
      {"plants: {w: {type: web, type: web}}\n",
       {"1:25: 'type' is given twice in plants.w; keep one; the first is at line 1 [scenario.twice]"}},
  });
}

// `text` stands in the parameters of a rotary knife, from column 3 of line 3.
Case knife(const std::string& text, const std::string& problem) {
  return {"plants:\n web: {type: web}\n k: {type: rotary_knife,\n  " + text + "}\n", {problem}};
}

TEST(ScenarioProblems, Parameters) {
  expect_problems({
      knife("circumference: 600 mmm",
            "4:22: plants.k.circumference: unknown unit 'mmm'; did you mean mm? [scenario.unknown-unit]"),
      knife("circumference: 600 furz",
            "4:22: plants.k.circumference: unknown unit 'furz'; units are written like mm, m/min, N m, kg "
            "m^2, rpm, deg, % [scenario.unknown-unit]"),
      knife("circumference: 600 ms",
            "4:22: plants.k.circumference is a length, not a time (ms); for example 1 mm "
            "[scenario.wrong-unit]"),
      knife("circumference: 600",
            "4:18: plants.k.circumference: '600' has no unit, but this is a length; write 600 mm if that is "
            "meant [scenario.wrong-unit]"),
      knife("angle: 0.5",
            "4:10: plants.k.angle: '0.5' has no unit, but this is an angle; write 0.5 deg if that is meant "
            "[scenario.wrong-unit]"),
      knife(
          "angle: 50 %",
          "4:13: plants.k.angle is an angle, not a percentage (%); for example 1 deg [scenario.wrong-unit]"),
      knife("servo: {rated_speed: 1500 1/min}",
            "4:29: plants.k.servo.rated_speed is a rotational speed, not a frequency (1/min); for example 1 "
            "rpm [scenario.wrong-unit]"),
      knife(
          "circumference: 6 m",
          "4:18: plants.k.circumference is 6000 mm, out of range; 100 mm to 5000 mm [scenario.out-of-range]"),
      knife("angle: -180.5 deg",
            "4:10: plants.k.angle is -180.5 deg, out of range; -180 deg to 180 deg [scenario.out-of-range]"),
      knife("circumference: nan mm",
            "4:18: plants.k.circumference: 'nan mm' is not a number; write a number, with its unit if it has "
            "one: 0.5, 60 m/min [scenario.not-a-number]"),
      knife("circumference: [600 mm]",
            "4:18: plants.k.circumference must be a single value, not a list; write one value "
            "[scenario.wrong-kind]"),
      knife(
          "circumference: ",
          "4:3: plants.k.circumference has no value; give it one, or leave the key out [scenario.no-value]"),
      knife("servo: 3",
            "4:10: plants.k.servo must be a map, not a single value; write key: value, or {key: value} "
            "[scenario.wrong-kind]"),
      knife("servo: {rated_torq: 3 N m}",
            "4:11: unknown key 'rated_torq' in plants.k.servo; did you mean rated_torque? "
            "[scenario.unknown-key]"),
      knife("rated_torque: 3 N m",
            "4:3: unknown key 'rated_torque' in plants.k; did you mean servo.rated_torque? "
            "[scenario.unknown-key]"),
      knife("servo.rated_torque: 3 N m, servo: {rated_torque: 3 N m}",
            "4:38: plants.k.servo.rated_torque is given twice; keep one; the first is at line 4 "
            "[scenario.twice]"),
      knife("encoder: {mounting: lad}",
            "4:23: plants.k.encoder.mounting: unknown choice 'lad'; did you mean load? "
            "[scenario.unknown-choice]"),
      knife("encoder: {mounting: roof}",
            "4:23: plants.k.encoder.mounting: unknown choice 'roof'; known: motor, load "
            "[scenario.unknown-choice]"),
      knife("web: wep", "4:8: plants.k.web: there is no plant 'wep'; name one of: web [plant.unknown-plant]"),
      knife("web: k",
            "4:8: plants.k.web: k is a rotary_knife, not a web; name one of: web [plant.wrong-reference]"),
      {"plants: {w: {type: web, friction: 2 mm}}\n",
       {"1:37: plants.w.friction is a pure number, not a length (mm); write a number without unit "
        "[scenario.wrong-unit]"}},
      {"plants: {w: {type: web, slip: 3}}\n",
       {"1:31: plants.w.slip: '3' has no unit, but this is a percentage; write 3 % if that is meant "
        "[scenario.wrong-unit]"}},
      {"plants: {w: {type: web, lines: 2.5}}\n",
       {"1:32: plants.w.lines is 2.5, not a whole number; 1 to 100000 [scenario.out-of-range]"}},
      {"plants: {w: {type: web, lines: 0}}\n",
       {"1:32: plants.w.lines is 0, out of range; 1 to 100000 [scenario.out-of-range]"}},
      {"plants: {w: {type: web, lines: 1e99}}\n",
       {"1:32: plants.w.lines is 1e+99, out of range; 1 to 100000 [scenario.out-of-range]"}},
      {"plants: {w: {type: web, brake: yes}}\n",
       {"1:32: plants.w.brake: 'yes' is not a switch position; write on or off (or true, false) "
        "[scenario.unknown-choice]"}},
  });
}

TEST(ScenarioProblems, PlantsTakenTogether) {
  expect_problems({
      {"plants: {w: {type: web, mass: 600 kg, brake: on}}\n",
       {"1:31: w.mass: too heavy for the brake; at most 500 kg with a brake [plant.parameters-contradict]"}},
      {"plants: {k: {type: rotary_knife}}\n",
       {"1:10: plants.k.web: there is no plant 'web'; add a plant of type web [plant.unknown-plant]"}},
      {"plants: {a: {type: axis}}\n",
       {"1:10: plants.a.master names no plant; name one of: a [plant.unknown-plant]"}},
      {"plants: {a: {type: axis, master: b}, b: {type: axis, master: a}}\n",
       {"1:10: plants.a refers to itself in a circle; let one of the plants stand alone "
        "[plant.reference-circle]",
        "1:38: plants.b refers to itself in a circle; let one of the plants stand alone "
        "[plant.reference-circle]"}},
      {"plants: {a: {type: axis, master: a}}\n",
       {"1:10: plants.a refers to itself in a circle; let one of the plants stand alone "
        "[plant.reference-circle]"}},
  });
}

TEST(ScenarioProblems, Controller) {
  expect_problems({
      {"controller: {s7: {program: a.il}}\n",
       {"1:14: unknown controller 's7'; known: qmove, lx3vp, plcopen [controller.unknown-kind]"}},
      {"controller: {}\n",
       {"1:13: controller names none; write controller: {qmove: {configuration: ...}}, {lx3vp: {program: "
        "...}} or {plcopen: {program: ...}} [scenario.needs-another]"}},
      {"controller: {lx3vp: {}, qmove: {configuration: a.cnf}}\n",
       {"1:21: controller.lx3vp.program is missing; add program: programs/saw.il [scenario.missing-key]",
        "1:25: a second controller, after lx3vp; keep one [scenario.twice]"}},
      {"scene: {step: 200 us}\ncontroller: {lx3vp: {program: a.il, scan: 500 us, regs: a.csv}}\n",
       {"2:43: controller.lx3vp.scan 500 us is not a whole multiple of scene.step 200 us; for example 400 us "
        "or 600 us [scenario.time-grid]",
        "2:51: unknown key 'regs' in controller.lx3vp; known: program, registers, scan, step_time, "
        "retentive, set [scenario.unknown-key]"}},
      {"controller: {qmove: {tasks: [a.mod]}}\n",
       {"1:21: controller.qmove.configuration is missing; add configuration: programs/line.cnf "
        "[scenario.missing-key]"}},
      {"controller: {qmove: {configuration: a.cnf, tasks: a.mod}}\n",
       {"1:51: controller.qmove.tasks must be a list, not a single value; write [first, second], or a line "
        "'- ...' for each [scenario.wrong-kind]"}},
      {"controller: {qmove: {configuration: a.cnf, set: {a: 5 mm, b: x, c: [1], a: 3}}}\n",
       {"1:55: controller.qmove.set.a is a pure number, not a length (mm); write a number without unit "
        "[scenario.wrong-unit]",
        "1:62: controller.qmove.set.b: 'x' is not a number; write a number, with its unit if it has one: "
        "0.5, 60 m/min [scenario.not-a-number]",
        "1:68: controller.qmove.set.c must be a single value, not a list; write one value "
        "[scenario.wrong-kind]",
        "1:73: 'a' is given twice in controller.qmove.set; keep one; the first is at line 1 "
        "[scenario.twice]"}},
      {"controller: {qmove: {configuration: a.cnf}, qmove: {configuration: b.cnf}}\n",
       {"1:45: 'qmove' is given twice in controller; keep one; the first is at line 1 [scenario.twice]"}},
  });
}

TEST(ScenarioProblems, WiringAndRecord) {
  expect_problems({
      {"wiring: {2.CNT01: a.b, 2.CNT01: c.d}\n",
       {"1:24: '2.CNT01' is given twice in wiring; keep one; the first is at line 1 [scenario.twice]"}},
      {"wiring: {2.CNT01: }\n",
       {"1:10: wiring.2.CNT01 leads to nothing; write terminal: plant.plug, or terminal: panel.switch "
        "[scenario.needs-another]"}},
      {"wiring: {2.CNT01: [a.b]}\n",
       {"1:19: wiring.2.CNT01 must be a single value, not a list; write one value [scenario.wrong-kind]"}},
      {"record: {channels: [a.b, c, a.b]}\n",
       {"1:29: channel a.b is recorded twice; keep one [scenario.twice]"}},
  });
}

TEST(ScenarioProblems, Timeline) {
  expect_problems({
      {"timeline: [{set: {a: 1}}]\n",
       {"1:12: timeline.0 does not say when; add at: 0.5 s, or when: \"...\" [scenario.missing-key]"}},
      {"timeline: [{at: 1 s}]\n",
       {"1:12: timeline.0 does nothing; add set, ramp, fault or power [scenario.missing-key]"}},
      {"timeline: [5]\n",
       {"1:12: timeline.0 must be a map, not a single value; write key: value, or {key: value} "
        "[scenario.wrong-kind]"}},
      {"timeline: [{at: 1 s, ramp: {a: 1}}]\n",
       {"1:22: timeline.0.ramp has no duration; add over: 1 s [scenario.needs-another]"}},
      {"timeline: [{at: 1 s, set: {a: 1}, over: 1 s}]\n",
       {"1:35: timeline.0.over stands without ramp; write ramp instead of set, or leave over out "
        "[scenario.needs-another]"}},
      {"timeline: [{at: 1 s, every: 0 s, set: {a: 1}}]\n",
       {"1:29: timeline.0.every is 0 s; it must be longer than 0; for example 2 ms [scenario.out-of-range]"}},
      {"timeline: [{at: 1 s, set: {a: x, b: [1], c: , d: 5 mis}}]\n",
       {"1:31: timeline.0.set.a: 'x' is not a number; write a number, with its unit if it has one: 0.5, 60 "
        "m/min [scenario.not-a-number]",
        "1:37: timeline.0.set.b must be a single value, not a list; write one value [scenario.wrong-kind]",
        "1:42: timeline.0.set.c has no value; write the value to set [scenario.needs-another]",
        "1:52: timeline.0.set.d: unknown unit 'mis'; did you mean ms? [scenario.unknown-unit]"}},
      {"timeline: [{at: 1 s, fault: {knife.encoder: stuck}}]\n",
       {"1:30: timeline.0.fault.knife.encoder names no fault; write knife.encoder: {fault: value}; 'drycut "
        "plants' lists the faults [scenario.needs-another]"}},
      {"timeline: [{at: 1 s, power: maybe}]\n",
       {"1:29: timeline.0.power: 'maybe' is not a switch position; write on or off (or true, false) "
        "[scenario.unknown-choice]"}},
      {"timeline: [{when: \"a =\", set: {a: 1}}]\n",
       {"1:22: '=' does not compare; write == [expression.syntax]"}},
      {"timeline: [{att: 1 s, set: {a: 1}}]\n",
       {"1:13: unknown key 'att' in timeline.0; did you mean at? [scenario.unknown-key]"}},
      {"timeline: [{at: 1 s, when: \"a == 1\", set: {a: 1}}]\n",
       {"1:13: timeline.0 has both at and when; keep one; from: is the time before which `when` is not "
        "looked at [scenario.does-not-go-together]"}},
      {"timeline: [{at: 1 s, from: 1 s, set: {a: 1}}]\n",
       {"1:22: timeline.0.from stands without when; write at for a time [scenario.needs-another]"}},
      {"timeline: [{when: \"a == 1\", from: 1 s, set: {a: 1}}]\n", {}},
  });
}

TEST(ScenarioProblems, Checks) {
  expect_problems({
      {"checks: [{name: a}]\n",
       {"1:10: checks.a does not say what it checks; add one of each, all, always, eventually, never "
        "[scenario.missing-key]"}},
      {"checks: [{never: tear}]\n",
       {"1:10: checks.0.name is missing; a check needs a name of its own [scenario.missing-key]"}},
      {"checks: [{name: a, each: cut}]\n",
       {"1:10: checks.a.expect is missing; add expect: \"abs(length - 500) <= 0.2\" or the like "
        "[scenario.missing-key]"}},
      {"checks: [{name: a, always: x < 1, never: tear}]\n",
       {"1:35: checks.a is both always and never; make two checks of it [scenario.does-not-go-together]"}},
      {"checks: [{name: a, never: tear, expect: x < 1}]\n",
       {"1:33: checks.a.expect does not go with this kind of check; expect belongs to each and all "
        "[scenario.needs-another]"}},
      {"checks: [{name: a, never: tear, within: 1 s}]\n",
       {"1:33: checks.a.within does not go with this kind of check; within belongs to eventually "
        "[scenario.needs-another]"}},
      {"checks: [{name: a, eventually: x < 1, until: 1 s}]\n",
       {"1:39: checks.a.until does not go with this kind of check; until belongs to each, all, always and "
        "never [scenario.needs-another]"}},
      {"checks: [{name: a, always: x < 1, at_least: 3}]\n",
       {"1:35: checks.a.at_least does not go with this kind of check; at_least belongs to each and all "
        "[scenario.needs-another]"}},
      {"checks: [{name: a, each: cut, expect: x < 1, at_least: -1}]\n",
       {"1:56: checks.a.at_least is -1, out of range; 0 to 2147483647 [scenario.out-of-range]"}},
      {"checks: [{name: a, each: cut, expect: x < 1, at_least: few}]\n",
       {"1:56: checks.a.at_least: 'few' is not a whole number; 0 to 2147483647 [scenario.not-a-number]"}},
      {"checks: [{name: a, never: b, from: 2 s, until: 2 s}]\n",
       {"1:41: checks.a.until is not after from; let until be later than from [scenario.order]"}},
      {"checks: [{name: a, never: b, every: 1 s}]\n",
       {"1:30: checks.a.every does not go with this kind of check; every belongs to always and eventually "
        "[scenario.needs-another]"}},
      {"checks: [{name: a, always: x < 1, every: 1 s}]\n",
       {"1:35: checks.a.every stands without a statistic; write a statistic, such as "
        "rms(knife.motor.torque), or leave every out [scenario.needs-another]"}},
      {"checks: [{name: a, eventually: rms(x) < 1}]\n",
       {"1:20: checks.a has statistics and no period; add every: 0.8 s, or write always "
        "[scenario.needs-another]"}},
      {"checks: [{name: a, always: rms(x) < 1, every: 1 ms}]\n",
       {"1:28: the period of the check 'a' is shorter than record.every; every: 2 ms at least "
        "[scenario.order]"}},
      {"checks: [{name: a, always: rms(max(x)) < 1}]\n",
       {"1:32: max inside rms; a term looks at channels or event values [expression.not-here]"}},
      {"checks:\n - {name: a, never: b}\n - {name: a, never: c}\n",
       {"3:11: there are two checks named 'a'; rename one; the first is at line 2 [scenario.twice]"}},
      {"checks: [{name: a, each: cut, expect: \"abs(length - 500 <= 0.2\"}]\n",
       {"1:43: this ( is not closed; add ) [expression.syntax]"}},
      {"checks: [{name: a, always: max(x, y) < 1}]\n",
       {"1:31: this ( is not closed; add ) [expression.syntax]",
        "1:35: unknown key 'y) < 1' in checks.a; an expression with a comma in it stands in quotes "
        "[scenario.unknown-key]"}},
      {"checks: [{name: a, always: sqr(x) < 1}]\n",
       {"1:28: unknown function 'sqr'; did you mean sqrt? [expression.unknown-name]"}},
  });
}

TEST(ScenarioProblems, AllOfAFileComeInOneRunInItsOrder) {
  EXPECT_THAT(problems_of("checks: [{name: a, never: b, within: 1 s}]\n"
                          "record: {evry: 2 ms}\n"
                          "plants:\n"
                          "  knife: {type: rotary_knife, web: wep, angle: 1}\n"
                          "scene: {step: 1 mm, stop: 3}\n"),
              ElementsAre(HasSubstr("1:30: checks.a.within"), HasSubstr("2:10: unknown key 'evry'"),
                          HasSubstr("4:36: plants.knife.web"), HasSubstr("4:48: plants.knife.angle"),
                          HasSubstr("5:17: scene.step"), HasSubstr("5:21: unknown key 'stop'")));
}

TEST(ScenarioProblems, BuildableSaysWhetherTheMachineCanBeBuilt) {
  const auto buildable = [](std::string_view text) {
    std::vector<std::string> problems;
    return fakes::read(text, problems).buildable;
  };
  EXPECT_TRUE(buildable("plants: {w: {type: web}}\nchecks: [{}]\n"));
  EXPECT_FALSE(buildable("plants: {w: {type: wep}}\n"));
  EXPECT_FALSE(buildable("plants: {w: {type: web, speed: 1}}\n"));
  EXPECT_FALSE(buildable("controller: {qmove: {}}\n"));
  EXPECT_FALSE(buildable(""));
  EXPECT_FALSE(buildable("plants: {"));
}

}  // namespace
}  // namespace drycut::sim::scenario
