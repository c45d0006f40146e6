// A scenario with a PLCopen controller: reading, writing back, putting together, running a cam.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "sim/controllers/kinds.hpp"
#include "sim/loop/controller_loader.hpp"
#include "sim/loop/simulation.hpp"
#include "sim/scenario/axis_units.hpp"
#include "sim/scenario/scenario.hpp"
#include "tests/findings.hpp"
#include "tests/loop/scenario/folder.hpp"

namespace drycut::sim::loop {
namespace {

namespace plcopen = devices::plcopen;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

struct PlcopenScenario : scenario::ScenarioFolder {
  PlcopenScenario() {
    write("line.st", program);
    write("cam.csv", "# interpolation: POLYNOM_3\n# endless: positive\nslave\n0\n700000\n1800000\n2900000\n");
  }
  /// A scenario with these lines under `plcopen:`.
  static std::string with(const std::string& lines) {
    return "scene: {step: 500 us, duration: 1 s}\ncontroller:\n  plcopen:\n" + lines;
  }
  static const controllers::PlcopenSection& section(scenario::Scenario&&) = delete;  // it would not last
  static const controllers::PlcopenSection& section(const scenario::Scenario& scenario) {
    return *controllers::controller_of<controllers::PlcopenSection>(scenario);
  }
  std::vector<std::string> build(const std::string& text) {
    const auto scenario = read(text);
    if (scenario.buildable) Simulation simulation(scenario, problems);
    return told();
  }

  // A virtual line shaft that the knife follows by a cam.
  static constexpr const char* program = R"(PROGRAM line
VAR_EXTERNAL Line : AXIS_REF; Knife : AXIS_REF; END_VAR
VAR
  start AT %IX0.0 : BOOL;
  locked AT %QX0.0 : BOOL;
  speed : LREAL := 100000.0;
  cam : MC_CAM_REF := (File := 'cam.csv');
  PowerLine : MC_Power;
  PowerKnife : MC_Power;
  Home : MC_Home;
  Run : MC_MoveVelocity;
  Select : MC_CamTableSelect;
  CamIn : MC_CamIn;
END_VAR
VAR RETAIN starts : DINT; END_VAR
PowerLine(Axis := Line, Enable := TRUE);
PowerKnife(Axis := Knife, Enable := start);
Home(Axis := Knife, Execute := PowerKnife.Status);
Run(Axis := Line, Execute := Home.Done, Velocity := speed);
Select(Master := Line, Slave := Knife, CamTable := cam, Execute := Home.Done);
CamIn(Master := Line, Slave := Knife, Execute := Run.InVelocity AND Select.Done, CamTableID := Select.CamTableID,
      StartMode := HLI_CI_F_PERIODIC OR HLI_CI_ENDLESS_POSITIVE, InSync => locked);
IF PowerKnife.Status AND starts = 0 THEN starts := 1; END_IF
END_PROGRAM
)";
  static constexpr const char* line = R"(scene: {title: Cam, step: 500 us, duration: 8 s}
plants:
  knife: {type: ideal_axis, speed_at_10v: 1000 mm/s, resolution: 0.1 mm}
controller:
  plcopen:
    program: line.st
    cycle: 2 ms
    axes:
      Line: {kind: virtual, cam_gear.is_master: on}
      Knife:
        path: [360 deg, 10000]
        antr.v_at_10v: 360 deg/s
        dynamik: {vb_max: 1000 deg/s, a_max: 5000 deg/s2, tr_min: 10 ms}
        cam_gear: {v_phasing: 50 deg/s, a_phasing: 500 deg/s2, d_phasing: 500 deg/s2, j_phasing: 5000 deg/s3,
                   j_vel_sync: 5000 deg/s3}
    tables: [cam.csv]
    retentive: kept.txt
wiring: {Knife.encoder: knife.encoder, Knife.reference: knife.reference, IX0.0: panel.start, QX0.0: panel.locked}
timeline:
  - {at: 0.2 s, set: {panel.start: 1}}
record: {every: 10 ms, channels: [Knife.set_position, Knife.following_error, CamIn.InSync, Knife.coupling_phase]}
checks:
  - {name: locks on, eventually: "panel.locked == 1", within: 6 s}
  - {name: coupled, always: "CamIn.InSync == 0 || Knife.coupling_phase == 5"}
  - {name: follows, always: "abs(Knife.following_error) < 0.5", from: 1 s}
  - {name: no stop, always: "Knife.state != 7 && CamIn.Error == 0"}
)";
};

TEST_F(PlcopenScenario, ACamLocksOnBehindALineShaft) {
  const auto scenario = read(line);
  ASSERT_THAT(told(), IsEmpty());
  Simulation simulation(scenario, problems);
  ASSERT_THAT(told(), IsEmpty());
  const auto outcome = simulation.run();
  EXPECT_EQ(outcome.failure, "");
  for (const auto& check : outcome.checks) EXPECT_TRUE(check.passed) << check.name << ": " << check.detail;
  EXPECT_THAT(simulation.notes(), IsEmpty()) << "everything is wired, nothing was refused";
  EXPECT_THAT(simulation.retentive_state(), HasSubstr("starts = 1"));
}

TEST_F(PlcopenScenario, ChecksMayNameWhatTheControllerReports) {
  auto text = std::string(line);
  text.replace(text.find("timeline:\n"), 10, "timeline:\n  - {at: 4 s, set: {Knife.emergency_stop: 1}}\n");
  text.resize(text.find("checks:"));
  text +=
      "checks:\n  - {name: no stop, never: errorstop}\n  - {name: no complaint, never: block_error, until: 3 "
      "s}\n";
  const auto scenario = read(text);
  Simulation simulation(scenario, problems);
  ASSERT_THAT(told(), IsEmpty());
  const auto outcome = simulation.run();
  ASSERT_EQ(outcome.checks.size(), 3U);  // the last: the program runs
  EXPECT_FALSE(outcome.checks[0].passed);
  EXPECT_TRUE(outcome.checks[1].passed) << outcome.checks[1].detail;
}

TEST_F(PlcopenScenario, QuantitiesAreConvertedAndBareNumbersAreTheKernels) {
  const auto scenario =
      read(with("    program: line.st\n    axes:\n"
                "      Web: {kind: encoder, modulo: 0.8 m, path: [500 mm, 10000], dynamik.vb_max: "
                "60 m/min, dynamik.a_max: 20 m/s2, dynamik.tr_min: 50 ms, kv: 12.5 1/s, "
                "feed_forward: 98 %, cam_gear.j_phasing: 3 m/s^3, cam_gear.filter_cycles: 4}\n"
                "      Knife: {modulo: 1 rev, path_increments: 3600000, dynamik.vb_max: 90 rpm}\n"
                "      Shaft: {modulo: 0}\n"
                "      Bare: {dynamik.vb_max: 1234.5, cam_gear: {is_master: 1, v_phasing: 7}}\n"));
  ASSERT_THAT(told(), IsEmpty());
  const auto& axes = section(scenario).axes;
  ASSERT_EQ(axes.size(), 4U);
  const auto& web = axes[0].configuration;
  EXPECT_EQ(web.measure, plcopen::Measure::length);
  EXPECT_EQ(web.parameters.kind, plcopen::AxisKind::encoder);
  EXPECT_EQ(web.parameters.modulo, 8'000'000);
  EXPECT_EQ(web.parameters.path_increments, 5'000'000);
  EXPECT_EQ(web.parameters.path_counts, 10'000);
  EXPECT_EQ(web.parameters.vb_max, 1'000'000);
  EXPECT_EQ(web.parameters.a_max, 20'000);
  EXPECT_EQ(web.parameters.tr_min, 50'000);
  EXPECT_EQ(web.parameters.kv, 1'250);
  EXPECT_EQ(web.parameters.feed_forward, 980);
  EXPECT_EQ(web.parameters.j_phasing, 3'000);
  EXPECT_EQ(web.parameters.filter_cycles, 4);
  EXPECT_EQ(axes[1].configuration.measure, plcopen::Measure::angle);
  EXPECT_EQ(axes[1].configuration.parameters.modulo, 3'600'000);
  EXPECT_EQ(axes[1].configuration.parameters.vb_max, 540'000);
  EXPECT_EQ(axes[2].configuration.measure, plcopen::Measure::length) << "a linear axis";
  EXPECT_EQ(axes[3].configuration.measure, plcopen::Measure::angle);
  EXPECT_EQ(axes[3].configuration.parameters.vb_max, 1234.5);
  EXPECT_EQ(axes[3].configuration.parameters.is_master, 1);
  EXPECT_EQ(axes[3].configuration.parameters.v_phasing, 7);
  EXPECT_EQ(section(scenario).cycle, 2 * millisecond);
  EXPECT_EQ(section(scenario).task_cycle, 2 * millisecond);
}

TEST_F(PlcopenScenario, EveryParameterWithAUnitTellsWhichOne) {
  for (const auto& row : plcopen::axis_parameter_table()) {
    const auto length = scenario::axis_unit(row, plcopen::Measure::length);
    const auto angle = scenario::axis_unit(row, plcopen::Measure::angle);
    const bool bare = row.unit.empty() || row.unit == "counts x4" || row.unit == "cycles";
    EXPECT_EQ(length.unit.empty(), bare) << row.name << " is in " << row.unit;
    EXPECT_EQ(angle.unit.empty(), bare) << row.name;
  }
}

TEST_F(PlcopenScenario, FaultsOfTheAxesAreToldAllAtOnce) {
  read(
      with("    program: line.st\n    axes:\n"
           "      Web: {kind: servo, path: 500 mm, modulo: 800 mm, dynamik.vb_max: 10 deg/s}\n"
           "      web: {}\n"
           "      2x: {}\n"
           "      Knife:\n"
           "        v_phasing: 1\n"
           "        kw: 5\n"
           "        dynamik: {vb_max: 0 mm/s, tr_min: 5 mm, a_mx: 1}\n"
           "        dynamik.vb_max: 5 mm/s\n"
           "        cam_gear.filter_cycles: 1.5\n"
           "        cam_gear.is_master: yes\n"
           "        kv:\n"
           "        path_counts: 10 mm\n"
           "        modulo: 0.00001 mm\n"
           "      Other: 5\n"));
  EXPECT_THAT(
      told(),
      ElementsAre(
          "line.yaml:6:19: controller.plcopen.axes.Web.kind: unknown choice 'servo'; known: drive, virtual, "
          "encoder [scenario.unknown-choice]",
          "line.yaml:6:32: controller.plcopen.axes.Web.path is not a way and its counts; write [500 mm, "
          "10000]: the "
          "way of so many counts (x4) of the encoder [controller.axis-value]",
          "line.yaml:6:75: controller.plcopen.axes.Web.dynamik.vb_max is a rotational speed, but modulo is a "
          "length; "
          "an axis measures lengths or angles: give all its quantities in one of them "
          "[controller.axis-value]",
          "line.yaml:7:7: axis web is Web already: names are the same in any case; keep one "
          "[controller.twice]",
          "line.yaml:8:7: '2x' is no name of an axis; letters, digits and underscores, as the program's "
          "VAR_EXTERNAL "
          "spells it [controller.bad-name]",
          "line.yaml:10:9: unknown key 'v_phasing' in controller.plcopen.axes.Knife; did you mean "
          "cam_gear.v_phasing? [scenario.unknown-key]",
          "line.yaml:11:9: unknown key 'kw' in controller.plcopen.axes.Knife; did you mean kv? "
          "[scenario.unknown-key]",
          "line.yaml:12:27: controller.plcopen.axes.Knife.dynamik.vb_max is 0 mm/s, out of range; 0.001 mm/s "
          "to "
          "2147483.647 mm/s [controller.axis-value]",
          "line.yaml:12:45: controller.plcopen.axes.Knife.dynamik.tr_min is a time, not a length (mm); for "
          "example 1 "
          "us [controller.axis-value]",
          "line.yaml:12:49: unknown key 'a_mx' in controller.plcopen.axes.Knife.dynamik; did you mean "
          "dynamik.a_max? [scenario.unknown-key]",
          "line.yaml:13:9: controller.plcopen.axes.Knife.dynamik.vb_max is given twice; keep one; the first "
          "is at line 12 [scenario.twice]",
          "line.yaml:14:33: controller.plcopen.axes.Knife.cam_gear.filter_cycles is 1.5, not a whole number "
          "of "
          "cycles; 1 to 1000 [controller.axis-value]",
          "line.yaml:15:29: controller.plcopen.axes.Knife.cam_gear.is_master: 'yes' is not a switch "
          "position; write "
          "on or off (or true, false) [scenario.unknown-choice]",
          "line.yaml:16:9: controller.plcopen.axes.Knife.kv has no value; give it one, or leave the key out "
          "[scenario.no-value]",
          "line.yaml:17:25: controller.plcopen.axes.Knife.path_counts is a pure number, not a length (mm); "
          "write a "
          "number without unit [controller.axis-value]",
          "line.yaml:18:17: controller.plcopen.axes.Knife.modulo is 0.00001 mm, not a whole number of 0.1 "
          "um, 0.0001 "
          "deg; 0 mm to 214748.3647 mm [controller.axis-value]",
          HasSubstr("line.yaml:19:14: controller.plcopen.axes.Other")));
}

TEST_F(PlcopenScenario, FaultsOfTheSectionAreToldAllAtOnce) {
  read(
      with("    cycle: 700 us\n    task_cycle: 1 ms\n    tables: [{id: 70000}, {file: a.tab, name: x}]\n"
           "    programm: a.st\n"));
  EXPECT_THAT(
      told(),
      ElementsAre(
          "line.yaml:4:12: controller.plcopen.cycle 700 us is not a whole multiple of scene.step 500 "
          "us; for example 500 us or 1 ms [scenario.time-grid]",
          "line.yaml:5:5: controller.plcopen.task_cycle 1 ms is not a whole multiple of the cycle 700 "
          "us; for example 700 us [scenario.time-grid]",
          "line.yaml:6:14: controller.plcopen.tables.0.file is missing; add file: cams/knife.tab "
          "[scenario.missing-key]",
          HasSubstr("line.yaml:6:19: controller.plcopen.tables.0.id is 70000, out of range"),
          HasSubstr("unknown key 'name' in controller.plcopen.tables.x"),
          "line.yaml:7:5: unknown key 'programm' in controller.plcopen; did you mean program? "
          "[scenario.unknown-key]"));
}

TEST_F(PlcopenScenario, WrittenBackItIsTheSame) {
  auto text = std::string(line);
  text.replace(text.find("tables: [cam.csv]"), 17, "tables: [{file: cam.csv, id: 3}]");
  text.replace(text.find("vb_max: 1000 deg/s"), 18, "vb_max: 1234.56789");
  text.replace(text.find("    cycle: 2 ms"), 15,
               "    cycle: 2 ms\n    tasks: {slow: {cycle: 20 ms, priority: 3, programs: [line]}}");
  const auto scenario = read(text, {{"controller.plcopen.set.speed", "5"}});
  ASSERT_THAT(told(), IsEmpty());
  const auto expanded = scenario::expand(scenario);
  EXPECT_THAT(expanded,
              HasSubstr("    axes:\n      Line:\n        kind: virtual\n        modulo: 360 deg\n"));
  EXPECT_THAT(expanded, HasSubstr("        cam_gear.v_phasing: 50 deg/s\n"));
  EXPECT_THAT(expanded, HasSubstr("    tables: [{file: cam.csv, id: 3}]\n    compute_time: 0 s\n    "
                                  "retentive: kept.txt\n    set: {speed: 5}"));
  EXPECT_THAT(expanded, HasSubstr("    tasks:\n      slow: {cycle: 20 ms, priority: 3, programs: [line]}\n"));
  const auto again = read(expanded);
  ASSERT_THAT(told(), IsEmpty());
  EXPECT_EQ(scenario::expand(again), expanded);
  for (const auto& row : plcopen::axis_parameter_table())
    for (std::size_t i = 0; i < 2; ++i)
      EXPECT_EQ(row.value(section(again).axes[i].configuration.parameters),
                row.value(section(scenario).axes[i].configuration.parameters))
          << row.name;
}

TEST_F(PlcopenScenario, OverridesReachParametersOfAxesAndValues) {
  const auto scenario = read(line, {{"controller.plcopen.axes.Knife.kv", "30 1/s"},
                                    {"controller.plcopen.axes.Knife.cam_gear.v_phasing", "60 deg/s"},
                                    {"controller.plcopen.axes.Line.dynamik.a_max", "300"},
                                    {"controller.plcopen.set.Knife.kv", "4000"}});
  ASSERT_THAT(told(), IsEmpty());
  EXPECT_EQ(section(scenario).axes[1].configuration.parameters.kv, 3'000);
  EXPECT_EQ(section(scenario).axes[1].configuration.parameters.v_phasing, 60'000);
  EXPECT_EQ(section(scenario).axes[0].configuration.parameters.a_max, 300);
  const auto controller = load_controller(scenario, problems);
  ASSERT_TRUE(controller);
  EXPECT_EQ(controller->find("Knife.kv")->read(), 4'000);
}

TEST_F(PlcopenScenario, WhatTheProgramNamesMustBeThere) {
  EXPECT_THAT(
      build(with("    program: line.st\n    axes: {Line: {kind: virtual}, Knive: {}}\n    tables: []\n")),
      ElementsAre("line.st:2:31: the scenario has no axis 'Knife'; did you mean Knive? Else add it to "
                  "controller.plcopen.axes [controller.unknown-name]",
                  HasSubstr("the scenario has no cam table 'cam.csv'; add it to controller.plcopen.tables")));
}

TEST_F(PlcopenScenario, SeveralProgramsHaveTasks) {
  const auto built = [&](const std::string& text) {
    problems.clear();
    return build(text);
  };
  write("two.st", "PROGRAM Main END_PROGRAM\nPROGRAM Hmi END_PROGRAM");
  EXPECT_THAT(built(with("    program: two.st\n    tasks:\n      fast: {cycle: 2 ms, programs: [Main]}\n"
                         "      slow: {cycle: 20 ms, priority: 3, programs: [hmi]}\n")),
              IsEmpty());
  EXPECT_THAT(
      built(with("    program: two.st\n")),
      ElementsAre(HasSubstr("two.st:2:9: a second PROGRAM, 'Hmi', without a task; CONFIGURATION ... TASK")));
  EXPECT_THAT(
      built(with("    program: two.st\n    tasks:\n      fast: {cycle: 3 ms, programs: [Main]}\n"
                 "      slow: {cycle: 20 ms, programs: [main, Hmi]}\n      none: {}\n")),
      ElementsAre(
          HasSubstr(
              ":6:14: controller.plcopen.tasks.fast.cycle 3 ms is not a whole multiple of the cycle 2 ms"),
          HasSubstr(":7:39: main runs in fast already; a program has one task"),
          HasSubstr("controller.plcopen.tasks.none.programs")));
  EXPECT_THAT(built(with("    program: two.st\n    tasks: {fast: {programs: [Mian, Hmi]}}\n")),
              ElementsAre(HasSubstr(":5:31: there is no PROGRAM 'Mian'; did you mean Main?")));
  write("three.st",
        "PROGRAM Main END_PROGRAM\nCONFIGURATION c\nTASK t(INTERVAL := T#3ms);\nPROGRAM m WITH t : "
        "Main;\nEND_CONFIGURATION");
  EXPECT_THAT(
      built(with("    program: three.st\n    tasks: {fast: {programs: [Main]}}\n")),
      ElementsAre(
          HasSubstr("three.st:3:6: the task t runs every 3 ms, not a whole multiple of the cycle 2 ms"),
          HasSubstr(":5:13: the program's CONFIGURATION has the tasks")));
}

TEST_F(PlcopenScenario, TablesAreReadAndHaveNamesAndIdsOfTheirOwn) {
  std::filesystem::create_directories(folder / "other");
  write("b.csv", "slave\n0\n1\n");
  write("other/cam.csv", "slave\n0\n1\n");
  write("wrong.tab", "Tablename = x\n");
  EXPECT_THAT(
      build(
          with("    program: line.st\n    axes: {Line: {kind: virtual}, Knife: {}}\n"
               "    tables: [cam.csv, b.csv, {file: other/cam.csv, id: 7}, cam.txt, gone.tab, wrong.tab]\n")),
      testing::AllOf(
          Contains("line.yaml:6:23: b.csv has id 1, as cam.csv has; give one an id of its own: {file: b.csv, "
                   "id: 2} [controller.twice]"),
          Contains("line.yaml:6:37: two tables are called cam.csv; programs find them by name: rename one "
                   "[controller.twice]"),
          Contains("line.yaml:6:60: 'cam.txt' is no kind of cam table that is known; give a table of the "
                   "kernel (.tab) or a cam as CSV (.csv) [controller.cam-kind]"),
          Contains(HasSubstr("line.yaml:6:69: ")), Contains(HasSubstr("wrong.tab:"))));
}

TEST_F(PlcopenScenario, AVirtualAxisIsHomedUnlessTheScenarioSaysOtherwise) {
  const auto homed = [&](const std::string& more) {
    const auto scenario = read(with("    program: line.st\n    axes: {Line: {kind: virtual" + more +
                                    "}, Knife: {}}\n    tables: [cam.csv]\n"));
    EXPECT_THAT(told(), IsEmpty());
    const auto controller = load_controller(scenario, problems);
    return controller->find("Line.homed")->read();
  };
  EXPECT_EQ(homed(""), 1);
  EXPECT_EQ(homed(", homed_at_start: on"), 1);
  EXPECT_EQ(homed(", homed_at_start: off"), 0);
}

TEST_F(PlcopenScenario, ACamWithoutMasterModuloIsJudgedByTheSceneOwnMaster) {
  write("cam.csv", "master,slave\n0,0\n5000000,1800000\n");
  const auto axes = [&](const std::string& modulo) {
    return build(with(
        "    program: line.st\n    axes: {Line: {kind: virtual, cam_gear.is_master: on, modulo: " + modulo +
        "}, Knife: {}}\n    tables: [cam.csv]\n"));
  };
  EXPECT_THAT(axes("800 mm"), IsEmpty());
  EXPECT_THAT(axes("400 mm"),
              ElementsAre(HasSubstr("cam.csv:3:1: error 60260 behind Line, whose turn is 4000000: ")));
}

TEST_F(PlcopenScenario, ValuesBeforePowerUpAreChecked) {
  EXPECT_THAT(
      build(with(
          "    program: line.st\n    axes: {Line: {kind: virtual}, Knife: {}}\n    tables: [cam.csv]\n"
          "    set: {Knife.kv: 1e9, spede: 1, CamIn.InSync: 1, Knife.state: 1, speed: 5, Knife.override: "
          "50}\n")),
      ElementsAre(
          HasSubstr("line.yaml:7:11: Knife.kv does not hold 1000000000; write 0 to 100000 0.01/s"),
          "line.yaml:7:26: the controller has nothing called 'spede'; did you mean speed? "
          "[controller.unknown-name]",
          "line.yaml:7:36: 'CamIn.InSync' can only be read; name a variable of the program, or a value "
          "or parameter of an axis (drycut devices AXIS) [controller.unknown-name]",
          HasSubstr("line.yaml:7:53: 'Knife.state' can only be read")));
}

TEST_F(PlcopenScenario, WiresAreCheckedByWhatTheControllerHas) {
  auto text = std::string(line);
  const auto wiring = text.find("wiring:");
  text.replace(
      wiring, text.find('\n', wiring) - wiring,
      "wiring: {Knife.encoder: knife.reference, Knif.encoder: knife.encoder, 2.AN01: knife.reference, "
      "QX0.0: panel.locked, IX0.0: panel.start, Knife.ready: knife.switch1}");
  const auto problems_told = build(text);
  EXPECT_THAT(
      problems_told,
      ElementsAre(HasSubstr("Knife.encoder is a counter, knife.reference is a reference; wire it to one of: "
                            "knife.encoder"),
                  HasSubstr("'Knif.encoder' is no terminal: there is no axis 'Knif'; did you mean Knife?"),
                  HasSubstr("'2.AN01' is no terminal: there is no axis '2'; axes: Line, Knife")));
}

TEST_F(PlcopenScenario, WhatADriveNeedsAndNothingIsWiredToIsAWarning) {
  auto text = std::string(line);
  text.replace(text.find("Knife.encoder: knife.encoder, "), 30, "");
  text.replace(text.find("Knife.reference: knife.reference, "), 34, "");
  const auto scenario = read(text);
  Simulation simulation(scenario, problems);
  ASSERT_THAT(told(), IsEmpty());
  EXPECT_THAT(sentences(simulation.warnings()),
              ElementsAre("Knife.encoder is counted, and nothing is wired to it",
                          "Knife.reference gives a reference, and nothing is wired to it"));
}

TEST_F(PlcopenScenario, AnOutputThatACallOrAnotherFileWorksIsNotIdle) {
  /// With `locked` declared and given so, and a second file.
  const auto warned = [&](const std::string& declared, const std::string& given,
                          const std::string& more = "") {
    std::string text = program;
    const std::string declaration = "  locked AT %QX0.0 : BOOL;\n";
    text.replace(text.find(declaration), declaration.size(), declared);
    text.replace(text.find(", InSync => locked"), 18, given);
    write("line.st", text);
    auto scene = std::string(line);
    if (!more.empty()) {
      write("more.st", more);
      scene.replace(scene.find("line.st"), 7, "[line.st, more.st]");
    }
    problems.clear();
    const auto scenario = read(scene);
    Simulation simulation(scenario, problems);
    EXPECT_THAT(told(), IsEmpty());
    return sentences(simulation.warnings());
  };
  const std::string idle = "QX0.0 is wired to panel.locked, and no program works it";
  // The place itself; a declaration on the line of its VAR; a variable of another file.
  EXPECT_THAT(warned("", ", InSync\n => %QX0.0"), Not(Contains(idle)));
  EXPECT_THAT(warned("END_VAR VAR locked AT %QX0.0 : BOOL;\n", ", InSync => locked"), Not(Contains(idle)));
  EXPECT_THAT(warned("", ", InSync => locked", "VAR_GLOBAL locked AT %QX0.0 : BOOL; END_VAR\n"),
              Not(Contains(idle)));
  // Its declaration alone works nothing.
  EXPECT_THAT(warned("END_VAR VAR locked AT %QX0.0 : BOOL;\n", ""), Contains(idle));
}

TEST_F(PlcopenScenario, ASlaveThatWouldCreepToItsCamIsNoted) {
  const auto notes = [&](const std::string& axes, const std::string& more = "") {
    problems.clear();
    const auto scenario = read(
        "scene: {step: 500 us, duration: 1 s}\ncontroller:\n  plcopen:\n    program: "
        "line.st\n    tables: [cam.csv]\n" +
        more + "    axes:\n      Line: {kind: virtual, cam_gear.is_master: on}\n" + axes);
    Simulation simulation(scenario, problems);
    EXPECT_THAT(told(), IsEmpty());
    EXPECT_THAT(simulation.notes(), testing::IsSupersetOf(simulation.notes_of_setup()));
    const auto again = read(scenario::expand(scenario));
    EXPECT_EQ(Simulation(again, problems).notes(), simulation.notes()) << "as it is written back";
    return sentences(simulation.notes_of_setup());
  };
  const std::string told_of =
      ".cam_gear.v_phasing is at its default, 0.001 deg/s: MC_CamIn will hardly reach its cam; give "
      "v_phasing, "
      "a_phasing, d_phasing and j_phasing";
  EXPECT_THAT(notes("      Knife: {}\n"), ElementsAre("Knife" + told_of));
  EXPECT_THAT(notes("      Knife: {kind: virtual}\n      Count: {kind: encoder}\n"),
              ElementsAre("Knife" + told_of));
  EXPECT_THAT(notes("      Knife: {modulo: 0}\n"), ElementsAre(HasSubstr("default, 0.001 mm/s: ")));
  EXPECT_THAT(notes("      Knife: {cam_gear.v_phasing: 5 deg/s}\n"), IsEmpty());
  EXPECT_THAT(notes("      Knife: {}\n", "    set: {knife.cam_gear.v_phasing: 5000}\n"), IsEmpty());
  EXPECT_THAT(notes("      Knife: {}\n" + std::string("timeline: [{at: 0 s, set: {Knife.cam_gear.v_phasing: "
                                                      "5000}}]\n")),
              IsEmpty());
  write("line.st",
        "PROGRAM line\nVAR_EXTERNAL Line, Knife : AXIS_REF; END_VAR\nVAR Gear : MC_GearIn; END_VAR\n"
        "Gear(Master := Line, Slave := Knife);\nEND_PROGRAM\n");
  EXPECT_THAT(notes("      Knife: {}\n"), IsEmpty()) << "no cam";
}

TEST_F(PlcopenScenario, SoftwareLimitsAreInOrder) {
  const auto told_of = [&](const std::string& limits) {
    problems.clear();
    read(with("    program: line.st\n    axes:\n      Saw: {modulo: 0, " + limits + "}\n"));
    return told();
  };
  const std::string remedy =
      "give the lower limit as kenngr.swe_neg; equal limits are none [controller.axis-value]";
  EXPECT_THAT(told_of("kenngr: {swe_pos: -10 mm, swe_neg: 10 mm}"),
              ElementsAre("line.yaml:6:33: controller.plcopen.axes.Saw: kenngr.swe_neg 10 mm is above "
                          "kenngr.swe_pos -10 mm; " +
                          remedy));
  EXPECT_THAT(told_of("kenngr.swe_neg: 1"),
              ElementsAre("line.yaml:6:24: controller.plcopen.axes.Saw: kenngr.swe_neg 0.0001 mm is above "
                          "kenngr.swe_pos 0 mm; " +
                          remedy));
  EXPECT_THAT(told_of("kenngr: {swe_neg: 10 mm, swe_pos: 10 mm}"), IsEmpty());
  EXPECT_THAT(told_of("kenngr: {swe_neg: -10 mm, swe_pos: 10 mm}"), IsEmpty());
  EXPECT_THAT(told_of("kenngr: {swe_neg: 1e9 m, swe_pos: -1 mm}"), ElementsAre(HasSubstr("out of range")));
}

TEST_F(PlcopenScenario, ATimelineSetsParametersInTheKernelsUnits) {
  auto text = std::string(line);
  text.replace(text.find("timeline:\n"), 10,
               "timeline:\n  - {at: 4 s, set: {Knife.cam_gear.v_phasing: 90 deg/s}}\n");
  EXPECT_THAT(build(text),
              ElementsAre(HasSubstr("Knife.cam_gear.v_phasing takes a plain number, not 'deg/s'; "
                                    "write the number of 0.001 deg/s without the unit")));
}

TEST_F(PlcopenScenario, AProgramThatDoesNotLoadMakesNoSwitchOrLampOfThePanelUnknown) {
  auto text = std::string(line);
  text.replace(text.find("program: line.st"), 16, "program: gone.st");
  const auto all = build(text);
  ASSERT_EQ(all.size(), 1U) << all.back();
  EXPECT_THAT(all.front(), HasSubstr("gone.st"));
}

TEST_F(PlcopenScenario, ItsFilesAreThoseOfTheScenario) {
  const auto scenario = read(line);
  std::vector<std::string> names;
  for (const auto& file : controller_files(scenario)) names.push_back(file.text);
  EXPECT_THAT(names, ElementsAre("line.st", "cam.csv", "kept.txt"));
  EXPECT_EQ(retentive_file(scenario)->filename(), "kept.txt");
}

TEST_F(PlcopenScenario, RetainVariablesComeFromTheirFile) {
  write("kept.txt", "starts = 12\n");
  const auto scenario = read(line);
  auto controller = load_controller(scenario, problems);
  ASSERT_THAT(told(), IsEmpty());
  EXPECT_EQ(controller->find("starts")->read(), 12);
  write("kept.txt", "stars = 12\n");
  load_controller(scenario, problems);
  EXPECT_THAT(told(), ElementsAre("kept.txt:1:1: the program has no RETAIN variable 'stars'; remove the line "
                                  "[controller.unknown-retained]"));
}

struct PlcopenModbus : PlcopenScenario {
  PlcopenModbus() {
    write("hmi.st",
          "PROGRAM p\nVAR speed : LREAL; batch AT %MW4 : INT; go : BOOL; END_VAR\ngo := speed > "
          "0;\nEND_PROGRAM\n");
  }
  static std::string map(const std::string& lines) {
    return with("    program: hmi.st\n    modbus:\n" + lines);
  }
};

TEST_F(PlcopenModbus, IsReadAndWrittenBack) {
  const auto text =
      map("      coils: {7: go}\n"
          "      holding_registers: {0: batch, 6: {value: speed, type: real32, words: high_first}}\n");
  EXPECT_THAT(build(text), IsEmpty());
  const auto scenario = read(text);
  const auto again = scenario::expand(scenario);
  EXPECT_THAT(again, HasSubstr("coils"));
  const auto back = read(again);
  const auto& modbus = section(back).modbus;
  ASSERT_EQ(modbus.holding_registers.size(), 2U);
  EXPECT_EQ(modbus.coils.at(0).address.text, "7");
  EXPECT_EQ(modbus.holding_registers[0].value.text, "batch");
  EXPECT_EQ(modbus.holding_registers[1].value.text, "speed");
  EXPECT_EQ(modbus.holding_registers[1].type, devices::ModbusFormat::real32);
  EXPECT_EQ(modbus.holding_registers[1].order, controllers::PlcopenSection::WordOrder::high_first);
  EXPECT_THAT(scenario::expand(read(with("    program: hmi.st\n"))), Not(HasSubstr("modbus")));
}

TEST_F(PlcopenModbus, SaysWhatDoesNotFit) {
  EXPECT_THAT(
      build(map(
          "      coils: {65536: go, x: go, 1: goo}\n"
          "      holding_registers: {4: speed, 3: {value: speed, type: int32}, 65535: {value: speed, type: "
          "real32}}\n"
          "      input_registers: {8: {value: speed, type: real64}, 11: batch}\n")),
      ElementsAre(
          HasSubstr("line.yaml:6:15: '65536' is no address; 0 to 65535"),
          HasSubstr("line.yaml:6:26: 'x' is no address"),
          HasSubstr("line.yaml:6:36: the controller has nothing called 'goo'; did you mean go?"),
          HasSubstr("line.yaml:7:27: batch stands at address 4 already"),
          HasSubstr("line.yaml:7:37: batch stands at address 3 already; give each addresses of its own: "
                    "this one takes 2"),
          HasSubstr("line.yaml:7:69: '65535' is no address; 0 to 65534"),
          HasSubstr("line.yaml:8:58: speed stands at address 11 already")));
  problems.clear();
  EXPECT_THAT(
      build(map("      coils: {1: {value: go}}\n      holding_registers: {1: {value: speed, type: int8}, 2: "
                "{type: int16}, 3: {value: speed, word: low_first}}\n      coil: {}\n")),
      Contains(HasSubstr("line.yaml:6:")));
  EXPECT_GE(problems.size(), 5U);
}

}  // namespace
}  // namespace drycut::sim::loop
