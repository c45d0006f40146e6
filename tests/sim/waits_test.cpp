// Why a run failed, where nothing told it but the machine that stands or goes the wrong way.
#include "sim/loop/waits.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>

#include "base/text.hpp"
#include "sim/cams/judged.hpp"
#include "sim/loop/simulation.hpp"
#include "tests/findings.hpp"
#include "tests/sim/studies/tune/bench.hpp"
#include "tests/test_folder.hpp"

namespace drycut::sim::loop {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

record::Outcome outcome_of(const std::filesystem::path& file,
                           const std::vector<scenario::Override>& set = {}) {
  Problems problems;
  const auto scenario = scenario::read_scenario(file, set, problems);
  if (problems.empty()) {
    Simulation simulation(scenario, problems);
    if (problems.empty()) return simulation.run();
  }
  for (const auto& problem : problems) ADD_FAILURE() << to_string(problem);
  return {};
}

/// What a program of an ideal axis comes to that should reach 400 mm.
std::string cause_of(const std::string& program, const std::string& line = studies::tuning::scenario) {
  TestFolder folder;
  folder.file("axis.cnf", studies::tuning::configuration);
  folder.file("axis.mod", program);
  const auto outcome = outcome_of(
      folder.file("line.yaml", line + "checks:\n  - {name: there, eventually: axis.position > 399}\n"));
  EXPECT_FALSE(outcome.passed());
  return outcome.cause();
}

TEST(WhyItFailed, AProgramThatWaitsIsNamedWithItsLineAndSinceWhen) {
  const auto program = replaced(studies::tuning::program, "CNTDIR AxisX\n",
                                "CNTREV AxisX\nWAIT NOT AxisX:st_cntrev  ; never\n");
  EXPECT_THAT(cause_of(program),
              ContainsRegex("^because axis.mod stands at line 15, WAIT NOT AxisX:st_cntrev "
                            "[(]AxisX.st_cntrev=1[)], since 0.0[0-9]+ s$"));
}

TEST(WhyItFailed, AProgramThatCameToItsEndIsNamed) {
  const auto program = replaced(studies::tuning::program, "START AxisX\nMAIN:\nWAIT 1\nJUMP MAIN\n", "");
  EXPECT_THAT(cause_of(program),
              ContainsRegex("^because axis.mod came to its end, line 19, at 0.0[0-9]+ s$"));
}

TEST(WhyItFailed, AValueThatDoesNotFitItsVariableIsTold) {
  const auto program = replaced(studies::tuning::program, "START AxisX\n",
                                "AxisX:setpos = 300\ngbPhase = AxisX:setpos\nSTART AxisX\n");
  EXPECT_THAT(cause_of(program), AllOf(HasSubstr("axis.mod:20: 300 does not fit into a variable of size B "
                                                 "(-128..127), which keeps 44")));
}

// A loop's own pause is no waiting, however long it goes on.
TEST(WhyItFailed, AnAxisWithoutLooponIsNamed) {
  const auto program =
      replaced(studies::tuning::program, "LOOPON AxisX\nWAIT AxisX:st_loopon\n", "; LOOPON AxisX\n");
  EXPECT_EQ(cause_of(program), "because AxisX is without LOOPON: no program closes its position loop");
}

TEST(WhyItFailed, AnAxisWithoutLooponComesBeforeItsWarnings) {
  TestFolder folder;
  std::ifstream shipped(std::filesystem::path(DRYCUT_SOURCE_DIR) / "scenes/programs/flying_saw.mod");
  const std::string program(std::istreambuf_iterator<char>(shipped), {});
  folder.file("saw.mod", replaced(program, "LOOPON AxisX\nWAIT AxisX:st_loopon\n", ""));
  const auto line = std::filesystem::path(DRYCUT_SOURCE_DIR) / "scenes/new/flying_saw_qmove.yaml";
  const auto file = folder.file("line.yaml", "extends: " + line.string() +
                                                 "\nscene: {duration: 9 s}\n"
                                                 "controller: {qmove: {tasks: [saw.mod]}}\n");
  EXPECT_THAT(outcome_of(file).cause(),
              StartsWith("because AxisX is without LOOPON: no program closes its position loop"));
}

TEST(WhyItFailed, AStateThatStandsIsNamed) {
  const auto program =
      replaced(studies::tuning::program, "START AxisX\n", "gbPhase = 1\nWAIT AxisX:st_still\ngbPhase = 3\n");
  const auto cause = cause_of(replaced(program, "WAIT 1\n", "IF gbPhase EQ 2\nSTART AxisX\nENDIF\nWAIT 1\n"),
                              replaced(replaced(studies::tuning::scenario, "duration: 1 s", "duration: 2 s"),
                                       "axis.position]", "axis.position, gbPhase]"));
  EXPECT_THAT(cause,
              ContainsRegex(
                  "^because 2.CNT01 .axis.encoder. counted nothing; gbPhase stands at 3 since 0.0[0-9]+ s$"));
}

TEST(WhyItFailed, PositiveFeedbackIsToldFromTheFirstSecond) {
  const auto cause = cause_of(replaced(studies::tuning::program, "CNTDIR AxisX\n", "CNTREV AxisX\n"));
  EXPECT_THAT(cause, ContainsRegex("^because AxisX went 1[0-9]+ counts against its drive from 0.0[0-9]+ s to "
                                   "0.0[0-9]+ s: positive feedback, it counts or turns the wrong way "
                                   "[(]CNTREV AxisX or CNTDIR AxisX[)]$"));
}

const auto lines = std::filesystem::path(DRYCUT_SOURCE_DIR) / "scenes/new";

TEST(WhyItFailed, TenVoltsThatAreAnotherSpeedForTheAxisAreTold) {
  const auto slow = replaced(studies::tuning::scenario, "speed_at_10v: 1000 mm/s", "speed_at_10v: 500 mm/s");
  EXPECT_EQ(
      cause_of(studies::tuning::program, slow),
      "because AxisX: by its parameters 10 V are 400000 counts/s (maxvel, unitvel, decpt, counts a unit), by "
      "axis.reference and axis.encoder 200000");
}

TEST(WhyItFailed, AnOffsetOfTheDriveIsTold) {
  const auto outcome = outcome_of(lines / "flying_saw_qmove.yaml", {{"plants.saw.servo.offset", "500 mV"}});
  EXPECT_THAT(outcome.cause(),
              ContainsRegex("^because AxisX stands from [0-9.]+ s on though its reference is "
                            "-?0.[45][0-9]* V: its drive has an offset or a dead band"));
}

// 4 times the lines: a unit of the master is a quarter of 0.1 mm.
TEST(WhyItFailed, AWheelWithOtherLinesThanTheProgramTakesIsTold) {
  const auto outcome = outcome_of(lines / "rotary_knife_qmove.yaml",
                                  {{"plants.web.wheel.lines", "10000"}, {"scene.duration", "8 s"}});
  EXPECT_THAT(outcome.cause(),
              StartsWith("because AxisX: measurem, pulsem: a unit is 0.025 mm by web.wheel"));
}

TEST(WhyItFailed, AParameterThatHardlyAnAxisHasIsTold) {
  EXPECT_THAT(cause_of(replaced(studies::tuning::program, "AxisX:setvel = 30000\n",
                                "AxisX:setvel = 30000\nAxisX:feedfw = 90\n")),
              HasSubstr("AxisX.feedfw is 90: 1000 is feed forward of the whole speed"));
}

TEST(WhyItFailed, ALowGainIsTold) {
  const auto soft = replaced(studies::tuning::scenario, "AxisX.pgain: 0", "AxisX.pgain: 10");
  EXPECT_THAT(cause_of(studies::tuning::program, replaced(soft, "feedfw: 900", "feedfw: 0")),
              HasSubstr("AxisX.pgain is 10, every 2 ms: a gain of 5 1/s"));
}

TEST(WhyItFailed, WithoutFeedForwardTheFollowingErrorIsToldLast) {
  const auto stiff = replaced(studies::tuning::scenario, "AxisX.pgain: 0", "AxisX.pgain: 18");
  EXPECT_THAT(cause_of(studies::tuning::program, replaced(stiff, "feedfw: 900", "feedfw: 0")),
              HasSubstr("AxisX.feedfw is 0: the following error grows with the speed"));
}

// A timer that elapses soon lets its program go on.
TEST(WhyItFailed, AProgramAtARunningTimerDoesNotStand) {
  const auto waits = [](const std::string& time) {
    TestFolder folder;
    folder.file("axis.cnf", replaced(studies::tuning::configuration, "BUS\n", "TIMER\ntmRest\nBUS\n"));
    folder.file("axis.mod", replaced(studies::tuning::program, "START AxisX\n",
                                     "REST:\ntmRest = " + time + "\nWAIT tmRest\nJUMP REST\nSTART AxisX\n"));
    return outcome_of(folder.file("line.yaml",
                                  replaced(studies::tuning::scenario, "duration: 1 s", "duration: 20 s") +
                                      "checks:\n  - {name: there, eventually: "
                                      "axis.position > 399}\n"))
        .cause();
  };
  EXPECT_THAT(waits("4000"), Not(HasSubstr("WAIT tmRest")));
  EXPECT_THAT(waits("90000"), HasSubstr("WAIT tmRest"));
  EXPECT_THAT(waits("90000"), HasSubstr("until its timer elapses at 9"));
}

/// Why a saw of the line's file fails with a program in which a text is another one.
std::string cause_of_saw(const std::string& line, const std::string& program, const std::string& from,
                         const std::string& to, const std::string& more) {
  TestFolder folder;
  std::ifstream shipped(lines.parent_path() / "programs" / program);
  folder.file(program, replaced(std::string(std::istreambuf_iterator<char>(shipped), {}), from, to));
  return outcome_of(folder.file("line.yaml", "extends: " + (lines / line).string() + "\n" + more)).cause();
}

/// What a line comes to without one of its wires, in 9 s.
record::Outcome outcome_without(const std::string& wire, const std::string& name) {
  TestFolder folder;
  std::ifstream shipped(lines / name);
  auto line = replaced(std::string(std::istreambuf_iterator<char>(shipped), {}), "  " + wire + "\n", "");
  for (const std::string of : {" ../", "[../", " cams/"})  // what it names lies beside the shipped one
    for (auto at = line.find(of); at != std::string::npos; at = line.find(of, at))
      line.insert(at + 1, lines.string() + "/");
  return outcome_of(folder.file("line.yaml", line), {{"scene.duration", "9 s"}});
}

TEST(WhyItFailed, AZeroPulseThatIsNotWiredIsTold) {
  EXPECT_THAT(outcome_without("INT1: saw.encoder.index", "flying_saw_qmove.yaml").cause(),
              StartsWith("because INT1 is the zero pulse that PRESET of AxisX seeks (prsmode 1), and nothing "
                         "is wired to it"));
}

TEST(WhyItFailed, ASearchThatMeetsTheStopBeforeItsSwitchIsTold) {
  EXPECT_THAT(
      cause_of_saw("flying_saw_lx3vp.yaml", "flying_saw.il", "DPLSV   K-2500", "DPLSV   K2500",
                   "controller: {lx3vp: {program: flying_saw.il}}\n"),
      ContainsRegex("^because saw at 1[0-9.]+ s: it ran into its end stop at [0-9.]+ mm/s, and saw.home "
                    "[(]X10[)] was never on: the search went the other way"));
}

TEST(WhyItFailed, ADecamThatNeverStartsIsTold) {
  EXPECT_THAT(cause_of_saw("flying_saw_lx3vp.yaml", "flying_saw.il", "MOV     K1 D1005            ; cyclic",
                           "MOV     K0 D1005",
                           "scene: {duration: 9 s}\ncontroller: {lx3vp: {program: flying_saw.il}}\n"),
              AllOf(HasSubstr("flying_saw.il stands at line 51, DECAM"),
                    HasSubstr("its word 5, D1005, was never 1 or 2")));
}

TEST(WhyItFailed, TheLineThatSwitchedALampOnIsTold) {
  EXPECT_THAT(
      outcome_of(lines / "flying_saw_qmove.yaml",
                 {{"controller.qmove.set.slTravel", "700"}, {"scene.duration", "10 s"}})
          .cause(),
      ContainsRegex("panel.too_long is on since [0-9.]+ s, by flying_saw.mod:66, ofTooLong = slTravel GT 0"));
}

// Each terminal has the name of the other's plug in the program.
TEST(WhyItFailed, CrossedWiresAreAWarningAndTheCause) {
  const auto outcome = outcome_of(
      lines / "flying_saw_plcopen.yaml",
      {{"wiring.QX0.0", "saw.head.plunge"}, {"wiring.QX0.1", "saw.clamp"}, {"scene.duration", "9 s"}});
  const auto told = HasSubstr(
      "QX0.0, which the program calls clampValve, is wired to saw.head.plunge, and "
      "QX0.1, headValve, to saw.clamp");
  EXPECT_THAT(sentences(outcome.warnings()), testing::Contains(told));
  EXPECT_THAT(outcome.cause(), AllOf(StartsWith("because QX0.0"), told));
}

TEST(WhyItFailed, ADriveThatIsAlwaysOnIsAWarning) {
  EXPECT_THAT(
      sentences(outcome_without("Saw.enable: saw.servo.enable", "flying_saw_plcopen.yaml").warnings()),
      testing::Contains(HasSubstr("Saw.enable is not wired: saw.servo.enable is on always")));
}

TEST(WhyItFailed, ACycleThatIsTooLongForItsAxesIsAWarningAndTheCause) {
  const auto outcome = outcome_of(lines / "flying_saw_plcopen.yaml",
                                  {{"controller.plcopen.cycle", "1 s"}, {"scene.duration", "9 s"}});
  EXPECT_THAT(codes(outcome.warnings()), testing::Contains("loop.rarely-sampled"));
  EXPECT_THAT(outcome.cause(), StartsWith("because cycle is 1 s, far too long for a position loop"));
}

TEST(WhyItFailed, AnAccelerationInTheWrongUnitIsTold) {
  EXPECT_THAT(
      outcome_of(lines / "flying_saw_plcopen.yaml",
                 {{"controller.plcopen.axes.Saw.dynamik.a_max", "15 mm/s2"}, {"scene.duration", "12 s"}})
          .cause(),
      HasSubstr("Saw.dynamik.a_max is 15: in mm/s2"));
}

TEST(WhyItFailed, AProbeThatABlockLooksAtAndNothingGivesIsAWarning) {
  const auto outcome = outcome_without("Saw.probe: saw.home", "flying_saw_plcopen.yaml");
  EXPECT_THAT(sentences(outcome.warnings()),
              testing::Contains("Saw.probe is what MC_TouchProbe looks at, and nothing is wired to it"));
}

TEST(WhyItFailed, ALampThatADeviceNeverLitIsANote) {
  TestFolder folder;
  std::ifstream shipped(lines.parent_path() / "programs/flying_saw.mod");
  folder.file("flying_saw.mod", replaced(std::string(std::istreambuf_iterator<char>(shipped), {}),
                                         "AxisX:funOut   = 7", "AxisX:funOut   = 1"));
  const auto file = folder.file("line.yaml", "extends: " + (lines / "flying_saw_qmove.yaml").string() +
                                                 "\nscene: {duration: 9 s}\ncontroller: {qmove: {tasks: "
                                                 "[flying_saw.mod]}}\n");
  Problems problems;
  const auto scenario = scenario::read_scenario(file, {}, problems);
  Simulation simulation(scenario, problems);
  ASSERT_TRUE(problems.empty()) << to_string(problems.front());
  simulation.run();
  EXPECT_THAT(sentences(simulation.notes()),
              testing::Contains(HasSubstr("never seen on: panel.in_sync (2.OUT01)")));
}

TEST(WhyItFailed, WhoToldTheClampsToCloseIsTold) {
  EXPECT_THAT(cause_of_saw("flying_saw_lx3vp.yaml", "flying_saw.il", "LDP     D1001.A", "LDF     D1001.A",
                           "scene: {duration: 9 s}\ncontroller: {lx3vp: {program: flying_saw.il}}\n"),
              ContainsRegex("the clamps took hold of material.*; saw.clamp [(]Y10[)] is switched on, by "
                            "flying_saw.il:[0-9]+"));
}

TEST(WhyItFailed, AFaultWhereNothingIsWiredIsAWarning) {
  TestFolder folder;
  const auto saw = folder.file("line.yaml", "extends: " + (lines / "flying_saw_lx3vp.yaml").string() +
                                                "\nscene: {duration: 9 s}\ntimeline:\n  - {at: 1 s, fault: "
                                                "{saw.encoder: {stuck: 1}, tube.wheel: {stuck: 1}}}\n");
  const auto told = codes(outcome_of(saw).warnings());
  EXPECT_EQ(std::count(told.begin(), told.end(), "wiring.fault-of-nothing"), 1);
}

// Nobody looks at the mains monitor; who has wired it knows.
TEST(WhyItFailed, MainsThatWereMissingAreAWarning) {
  TestFolder folder;
  const auto knife = folder.file("line.yaml", "extends: " + (lines / "rotary_knife_qmove.yaml").string() +
                                                  "\nscene: {duration: 9 s}\ntimeline:\n  - {at: 1 s, fault: "
                                                  "{knife.mains: {phase_lost: 1}}}\n");
  EXPECT_THAT(sentences(outcome_of(knife).warnings()),
              testing::Contains(HasSubstr("and nothing is wired to knife.servo.mains_ok")));
  EXPECT_THAT(
      sentences(outcome_of(lines / "rotary_knife_qmove.yaml", {{"scene.duration", "9 s"}}).warnings()),
      testing::Each(Not(HasSubstr("mains_ok"))));
}

TEST(WhyItFailed, AMasterThatCountsBackwardsIsTold) {
  EXPECT_THAT(cause_of_saw("flying_saw_qmove.yaml", "flying_saw.mod", "CNTDIRM AxisX", "CNTREVM AxisX",
                           "scene: {duration: 9 s}\ncontroller: {qmove: {tasks: [flying_saw.mod]}}\n"),
              StartsWith("because AxisX counts its master backwards (st_cntrevm 1, tube.wheel)"));
}

TEST(WhyItFailed, AnEntryThatIsDueBehindTheEndIsTold) {
  TestFolder folder;
  const auto saw =
      folder.file("line.yaml", "extends: " + (lines / "flying_saw_qmove.yaml").string() +
                                   "\nscene: {duration: 9 s}\ntimeline:\n  - {when: gbPhase == 2, "
                                   "after: 100 s, set: {panel.start: 1}}\n");
  EXPECT_THAT(outcome_of(saw).cause(),
              ContainsRegex("'gbPhase == 2' of line [0-9]+ came true and is due at 103"));
}

TEST(WhyItFailed, ForwardAndBackwardSwappedAreTold) {
  TestFolder folder;
  const auto press = (lines / "vertical_press_qmove.yaml").string();
  const auto swapped = folder.file("swapped.yaml", "extends: " + press +
                                                       "\nvariables: {tours: 1}\nscene: {duration: 6 s}\n"
                                                       "wiring: {2.OUT01: press.drive.backward, "
                                                       "2.OUT02: press.drive.forward}\n");
  EXPECT_THAT(outcome_of(swapped).cause(),
              AllOf(StartsWith("because Axis went 1"), HasSubstr(" counts against its drive from "),
                    HasSubstr(": its forward output 2.OUT01 is wired to press.drive.backward")));
}

record::Outcome outcome_of_line(const std::string& name, const std::vector<scenario::Override>& set) {
  return outcome_of(lines / name, set);
}

TEST(WhyItFailed, WhereNothingCutsWhatStandsIsToldFirst) {
  EXPECT_THAT(outcome_of_line("flying_saw_qmove.yaml",
                              {{"controller.qmove.set.slTravel", "700"}, {"scene.duration", "10 s"}})
                  .cause(),
              AllOf(StartsWith("while "), HasSubstr("panel.too_long is on since "),
                    HasSubstr("never seen on: saw.clamp (2.OUT02), saw.head.plunge (2.OUT03)")));
}

TEST(WhyItFailed, OfAMachineThatWorksNothingStands) {
  const auto outcome = outcome_of_line("flying_saw_qmove.yaml",
                                       {{"checks.cut length.at_least", "20"}, {"scene.duration", "12 s"}});
  EXPECT_FALSE(outcome.passed());
  EXPECT_EQ(outcome.cause(), "while nothing but check 'cut length' is amiss");
}

std::string code_of_cause(const record::Outcome& outcome) {
  for (const auto& finding : outcome.findings)
    if (finding.role == Finding::Role::cause) return finding.code;
  return "";
}

TEST(WhyItFailed, WhatStandsOnlySinceACheckWasGivenUpIsNoCause) {
  const auto outcome = outcome_of_line("vertical_press_inverter_qmove.yaml",
                                       {{"variables.tours", "2"}, {"checks.all tours done.within", "11 s"}});
  EXPECT_EQ(code_of_cause(outcome), "check.alone-fails") << outcome.cause();
  const auto failed = std::ranges::find(outcome.checks, false, &record::CheckResult::passed);
  ASSERT_NE(failed, outcome.checks.end());
  EXPECT_TRUE(failed->deadline);
  EXPECT_EQ(failed->failed_at, 11);
}

TEST(WhyItFailed, WhereNothingTellsWhyWhatFailedFirstIsNamed) {
  const auto outcome =
      outcome_of(lines.parent_path() / "backlash_load_encoder.yaml", {{"plants.axis.gap", "10 mm"}});
  EXPECT_EQ(code_of_cause(outcome), "check.first-fails") << outcome.cause();
  EXPECT_THAT(outcome.cause(), ContainsRegex("^check 'follows' first, at 0[.][01][0-9]+ s$"));
}

// The table's own limits count in a run, too, though the kernel does not know them.
TEST(WhyItFailed, ACamThatLeavesTheLimitsOfItsFileIsTold) {
  TestFolder folder;
  std::ifstream shipped(lines / "cams/saw.csv");
  const std::string cam(std::istreambuf_iterator<char>(shipped), {});
  const auto line = lines / "flying_saw_plcopen.yaml";
  const auto warned = [&](const char* from, const char* to) {
    folder.file("saw.csv", replaced(cam, from, to));
    const auto file =
        folder.file("line.yaml", "extends: " + line.string() +
                                     "\ncontroller: {plcopen: {tables: [{file: saw.csv, id: 1}]}}\n");
    Problems problems;
    const auto scenario = scenario::read_scenario(file, {{"scene.duration", "6 s"}}, problems);
    Simulation simulation(scenario, problems);
    simulation.follow_cams(cams::cam_judgement, false);
    auto told = codes(simulation.run().findings);
    for (const auto& problem : problems) ADD_FAILURE() << to_string(problem);
    return told;
  };
  EXPECT_THAT(warned("# maxvel: 1200", "# maxvel: 1100"), Not(testing::Contains(StartsWith("cam."))));
  EXPECT_THAT(warned("# maxpos: 3500000", "# maxpos: 350000"), testing::Contains("cam.travel"));
  EXPECT_THAT(warned("# maxvel: 1200", "# maxvel: 120"), testing::Contains("cam.limit"));
}

TEST(WhyItFailed, AnAxisThatCountsAnotherWayThanTheMachineGoesIsTold) {
  const std::vector<scenario::Override> one = {{"variables.tours", "1"}, {"scene.duration", "6 s"}};
  auto scale = one;
  scale.push_back({"plants.press.encoder.lines", "1000"});
  EXPECT_THAT(outcome_of_line("vertical_press_qmove.yaml", scale).cause(),
              ContainsRegex("^because press at [0-9.]+ s: pulled_out: .*; Axis counted [0-9.]+ where "
                            "press.position went [0-9.]+ mm$"));
  auto place = one;
  place.push_back({"plants.press.start", "500 mm"});
  EXPECT_THAT(
      outcome_of_line("vertical_press_qmove.yaml", place).cause(),
      ContainsRegex("^because press at [0-9.]+ s: pulled_out: .*; Axis stood at 300 when it was driven "
                    "first, and press.position at 5[0-9.]+ mm$"));
}

/// Notes of the QMOVE saw with a program in which a text is another one.
std::vector<std::string> notes_of_saw(const std::string& from, const std::string& to) {
  TestFolder folder;
  std::ifstream shipped(lines.parent_path() / "programs/flying_saw.mod");
  folder.file("saw.mod", replaced(std::string(std::istreambuf_iterator<char>(shipped), {}), from, to));
  const auto file = folder.file("line.yaml", "extends: " + (lines / "flying_saw_qmove.yaml").string() +
                                                 "\nscene: {duration: 9 s}\n"
                                                 "controller: {qmove: {tasks: [saw.mod]}}\n");
  Problems problems;
  const auto scenario = scenario::read_scenario(file, {}, problems);
  Simulation simulation(scenario, problems);
  for (const auto& problem : problems) ADD_FAILURE() << to_string(problem);
  simulation.run();
  return sentences(simulation.notes());
}

TEST(WhyItFailed, AnotherZeroIsANote) {
  EXPECT_THAT(notes_of_saw("AxisX:prspos   = 500 ", "AxisX:prspos   = 50 "),
              testing::Contains(
                  ContainsRegex("^AxisX is at -?[0-9.]+ where saw.position is [0-9.]+ mm: another zero$")));
  EXPECT_THAT(notes_of_saw("AxisX:prspos   = 500 ", "AxisX:prspos   = 500 "),
              testing::Each(Not(testing::AnyOf(HasSubstr("another zero"), HasSubstr("never seen on")))));
}

TEST(WhyItFailed, AnAxisThatHuntsIsTold) {
  const auto file = lines.parent_path() / "backlash_motor_encoder.yaml";
  EXPECT_THAT(
      outcome_of(file, {{"controller.qmove.set.Axis.integt", "1"}}).cause(),
      ContainsRegex("^because Axis hunts from [0-9.]+ s on: it swings by [0-9]+ bits x4, [0-9.]+ times a "
                    "second"));
}

std::vector<std::string> warnings_of_watch(bool jumps) {
  TestFolder folder;
  std::ifstream shipped(std::filesystem::path(DRYCUT_SOURCE_DIR) / "scenes/programs/press_watch.mod");
  std::string program(std::istreambuf_iterator<char>(shipped), {});
  folder.file("watch.mod", jumps ? program : replaced(program, "JUMP LOOK\n", ""));
  const auto press = std::filesystem::path(DRYCUT_SOURCE_DIR) / "scenes/programs/press.mod";
  return sentences(
      outcome_of(folder.file("line.yaml", "extends: " + (lines / "vertical_press_qmove.yaml").string() +
                                              "\nvariables: {tours: 1}\nscene: {duration: 4 s}\nchecks: []\n"
                                              "controller: {qmove: {tasks: [" +
                                              press.string() + ", watch.mod]}}\n"))
          .warnings());
}

TEST(WhyItFailed, ATaskThatEndsWhereItShouldGoOnIsAWarning) {
  EXPECT_THAT(
      warnings_of_watch(false),
      testing::Contains(ContainsRegex("^watch.mod came to its end at 0.[0-9]+ s, line [0-9]+, and looks "
                                      "after 2.INP03 .press.limit_min. no more$")));
  EXPECT_THAT(warnings_of_watch(true), Not(testing::Contains(HasSubstr("watch.mod"))));
}

TEST(WhyItFailed, AZeroPulseOfAnotherEncoderIsAWarning) {
  const auto warnings = [](const char* plug) {
    return sentences(
        outcome_of_line("flying_saw_qmove.yaml", {{"wiring.INT1", plug}, {"scene.duration", "8.1 s"}})
            .warnings());
  };
  EXPECT_THAT(
      warnings("tube.wheel.index"),
      testing::Contains("AxisX takes its zero pulse from tube.wheel.index (INT1), and counts saw.encoder "
                        "(2.CNT01)"));
  EXPECT_THAT(warnings("saw.encoder.index"), Not(testing::Contains(HasSubstr("zero pulse"))));
}

TEST(WhyItFailed, ALineThatIsRightGoesNowhereAstray) {
  for (const auto* name : {"vertical_press_qmove.yaml", "rotary_knife_qmove.yaml",
                           "rotary_knife_plcopen.yaml", "flying_saw_qmove.yaml", "flying_saw_plcopen.yaml",
                           "length_stop_qmove.yaml", "vertical_press_inverter_qmove.yaml"}) {
    Problems problems;
    const auto scenario = scenario::read_scenario(lines / name, {{"scene.duration", "4 s"}}, problems);
    Simulation simulation(scenario, problems);
    for (const auto& problem : problems) ADD_FAILURE() << to_string(problem);
    simulation.run();
    for (const auto& note : sentences(simulation.notes()))
      EXPECT_THAT(note, Not(HasSubstr("against its drive"))) << name;
  }
}

TEST(WhyItFailed, ABlockWhoseCommandNeverComesIsNamed) {
  TestFolder folder;
  std::ifstream shipped(std::filesystem::path(DRYCUT_SOURCE_DIR) / "scenes/programs/rotary_knife.st");
  std::string program(std::istreambuf_iterator<char>(shipped), {});
  const auto call = program.find("CamIn(");
  ASSERT_NE(call, std::string::npos);
  const auto execute = program.find("Execute := ", call) + std::string("Execute := ").size();
  program.replace(execute, program.find(',', execute) - execute, "FALSE");
  const auto before = program.substr(0, execute);
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  folder.file("knife.st", program);
  const auto file = folder.file("line.yaml", "extends: " + (lines / "rotary_knife_plcopen.yaml").string() +
                                                 "\nscene: {duration: 8 s}\n"
                                                 "controller: {plcopen: {program: knife.st}}\n");
  EXPECT_THAT(outcome_of(file).cause(),
              AllOf(HasSubstr("knife.st stands at line " + std::to_string(line) + ", "),
                    HasSubstr("CamIn.Execute=0"), HasSubstr("since 0.0 s")));
}

}  // namespace
}  // namespace drycut::sim::loop
