#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/devices/qmove_support.hpp"

// The controller as the simulation sees it: schedule, barrier, errors, power, values, events.
namespace drycut::devices::qmove {
namespace {

using testing::Bench;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using testing::text_of;
using testing::usual_cnf;

std::vector<std::string> events(const Bench& bench) {
  std::vector<std::string> texts;
  for (const ControllerEvent& event : bench.controller->take_events())
    texts.push_back(event.source + " " + event.event + " " + event.text);
  return texts;
}

// --- schedule (spec D9) ---

TEST(QmoveSchedule, WaitYieldsOnceAndEachTaskHasOneTurnARound) {
  Bench bench({"MAIN:\nglI = glI * 10 + 1\nWAIT 1\nJUMP MAIN\nEND\n",
               "MAIN:\nglI = glI * 10 + 2\nWAIT 1\nJUMP MAIN\nEND\n"});
  bench.run(3);
  EXPECT_EQ(bench["glI"], 121212);
}

TEST(QmoveSchedule, RoundsBeginEveryCycle) {
  Bench bench({"MAIN:\nglI = glI + 1\nWAIT 1\nJUMP MAIN\nEND\n"}, 4);
  bench.run(1);
  EXPECT_EQ(bench["glI"], 1);  // at 0 ms
  bench.run(3);
  EXPECT_EQ(bench["glI"], 1);
  bench.run(1);  // at 4 ms
  EXPECT_EQ(bench["glI"], 2);
}

TEST(QmoveSchedule, WaitIsEvaluatedAtTheNextTurnFirst) {
  Bench bench({"gfDone = 1\nWAIT gfDone\nslR = 1\nEND\n", "gfDone = 0\nEND\n"});
  bench.run(5);
  EXPECT_EQ(bench["slR"], 0);  // true when the task came to it, but no longer at its next turn
  bench.set("gfDone", 1);
  bench.run(1);
  EXPECT_EQ(bench["slR"], 1);
}

TEST(QmoveSchedule, DevicesAreSampledAtMultiplesOfTheirPeriod) {
  std::string cnf(usual_cnf);
  cnf.insert(cnf.find("END\n", cnf.find("INTDEVICE")), "Slow PUPPET 6 2.CNT01 X X.X X.X X.X\n");
  Bench bench({"END\n"}, 1, cnf);
  ASSERT_TRUE(bench.controller) << text_of(bench.problems);
  for (int ms = 0; ms < 24; ++ms) {
    bench.controller->cards().counters.at({Kind::counter, 2, 1}).count = 100 + ms;
    bench.step();
    EXPECT_EQ(bench["Axis.reading"], 100 + ms / 4 * 4) << ms;
    EXPECT_EQ(bench["Slow.reading"], 100 + ms / 6 * 6) << ms;
  }
}

TEST(QmoveSchedule, PeriodsAreNamed) {
  const Bench bench({"END\n"}, 2);
  const auto periods = bench.controller->periods();
  ASSERT_EQ(periods.size(), 2U);
  EXPECT_EQ(periods[0].name, "Axis TCamp");
  EXPECT_EQ(periods[0].ns, 4'000'000);
  EXPECT_EQ(periods[1].name, "task cycle");
  EXPECT_EQ(periods[1].ns, 2'000'000);
}

// --- barrier (spec §2, D2) ---

const std::string to_1000 = "INIT Axis\nWAIT Axis:st_init\nAxis:posit = 1000\nAxis:delta = - 100\n";

// Two identical commands between samples are one.
TEST(QmoveBarrier, DelcntTwiceInOneSampleIsOne) {
  Bench bench({to_1000 + "DELCNT Axis\nDELCNT Axis\nEND\n"});
  bench.run(20);
  EXPECT_EQ(bench["Axis.posit"], 900);
}

TEST(QmoveBarrier, AReadBetweenMakesThemTwoWhateverThePeriods) {
  for (const int cycle : {1, 2, 3, 4, 7, 9}) {
    Bench bench({to_1000 + "DELCNT Axis\nWAIT Axis:st_init\nslA = Axis:posit\nDELCNT Axis\nWAIT "
                           "Axis:st_init\nslB = Axis:posit\nEND\n"},
                cycle);
    bench.run(100);
    EXPECT_EQ(bench["slA"], 900) << cycle;
    EXPECT_EQ(bench["slB"], 800) << cycle;
  }
}

// A plain read waits as WAIT does, and its statement then runs as a whole.
TEST(QmoveBarrier, AnyReadSuspendsItsStatement) {
  Bench bench({to_1000 + "DELCNT Axis\nslR = Axis:posit\nslA = 1\nEND\n",
               "MAIN:\nslB = slB + 1\nWAIT 1\nJUMP MAIN\nEND\n"});
  bench.run(2);  // 0: INIT is given, 1: not yet initialised
  EXPECT_EQ(bench["slA"], 0);
  bench.run(5);  // the sample at 4 ms executes INIT, the turn at 4 ms goes on to the read
  EXPECT_EQ(bench["slA"], 0);
  EXPECT_EQ(bench["slR"], 0);
  bench.run(2);  // the sample at 8 ms settles the device
  EXPECT_EQ(bench["slR"], 900);
  EXPECT_EQ(bench["slA"], 1);
  EXPECT_EQ(bench["slB"], 9);  // the other task never waited
}

TEST(QmoveBarrier, AnUninitialisedDeviceIsReadAtOnce) {
  Bench bench({"Axis:gain = 321\nslR = Axis:gain\nEND\n"});
  bench.run(1);
  EXPECT_EQ(bench["slR"], 321);
}

TEST(QmoveBarrier, IfWhileForAndIndexesWaitToo) {
  for (const std::string& statement :
       {std::string("IF Axis:posit EQ 900\nslR = 1\nENDIF\n"),
        std::string("WHILE Axis:posit EQ 900 AND slR EQ 0\nslR = 1\nENDWHILE\n"),
        std::string("FOR (glI = Axis:posit, glI EQ 900, 1)\nslR = 1\nNEXT\n"),
        std::string("asKept[Axis:posit - 898] = 1\nslR = asKept[2]\n")}) {
    Bench bench({to_1000 + "DELCNT Axis\n" + statement + "END\n"});
    bench.run(30);
    EXPECT_EQ(bench["slR"], 1) << statement;
    EXPECT_EQ(bench["QMOS.oserr"], 0) << statement;
  }
}

// --- run-time errors (spec 4.5) ---

struct RunFault {
  std::string statement;
  int number;
  std::string text;
};

TEST(QmoveRunTime, ErrorsStopAllTasksAndNameTheirPlace) {
  const std::vector<RunFault> cases = {
      {"slR = agTemp[0]", 3, "index out of bound"},
      {"slR = agTemp[6]", 3, "index out of bound"},
      {"agTemp[-1] = 2", 3, "index out of bound"},
      {"slR = ddlHead[3]", 4, "datagroup recipe out of range"},
      {"ddlHead[0] = 1", 4, "datagroup recipe out of range"},
      {"slR = ddbCode[3, 1]", 4, "datagroup recipe out of range"},
      {"slR = ddbCode[1, 4]", 5, "datagroup step out of range"},
      {"ddbCode[2, 0] = 1", 5, "datagroup step out of range"},
      {"slR = 1 / glI", 6, "division by zero"},
      {"slR = 1 % glI", 6, "division by zero"},
      {"slR = 1.0 / glI", 6, "division by zero"},
  };
  for (const RunFault& c : cases) {
    Bench bench(
        {"WAIT 1\n" + c.statement + "\nslA = 1\nEND\n", "MAIN:\nslB = slB + 1\nWAIT 1\nJUMP MAIN\nEND\n"});
    ASSERT_TRUE(bench.controller) << c.statement << text_of(bench.problems);
    bench.run(1);
    EXPECT_EQ(bench["QMOS.osmode"], 3);
    bench.run(9);
    EXPECT_EQ(bench["QMOS.oserr"], c.number) << c.statement;
    EXPECT_EQ(bench["QMOS.osmode"], 5) << c.statement;
    EXPECT_EQ(bench["slA"], 0) << c.statement;
    EXPECT_EQ(bench["slB"], 1) << c.statement;
    EXPECT_EQ(events(bench),
              (std::vector<std::string>{"task0 error task0.mod:2: error " + std::to_string(c.number) + ": " +
                                        c.text + "; all tasks stop"}));
  }
}

TEST(QmoveRunTime, ALoopWithoutWaitTripsTheWatchdog) {
  Bench bench({"MAIN:\nslA = slA + 1\nJUMP MAIN\nEND\n"});
  bench.run(1);
  EXPECT_EQ(bench["QMOS.oserr"], 8);
  EXPECT_GT(bench["slA"], 100'000);
  EXPECT_THAT(events(bench), ::testing::ElementsAre(HasSubstr("task0 error task0.mod:")));
}

TEST(QmoveRunTime, CallsThatNestTooDeepAreAStackError) {
  Bench bench({"CALL a\nEND\nSUB a\nslR = slR + 1\nCALL a\nENDSUB\n"});
  bench.run(1);
  EXPECT_EQ(bench["QMOS.oserr"], 9);
  EXPECT_EQ(bench["slR"], max_calls);
}

TEST(QmoveRunTime, JumpingIntoASubroutineIsAStackError) {
  Bench bench({"JUMP in\nEND\nSUB a\nin:\nslR = 1\nENDSUB\n"});
  bench.run(1);
  EXPECT_EQ(bench["QMOS.oserr"], 9);
}

TEST(QmoveRunTime, DevicesGoOnAndOutputsStay) {
  Bench bench(
      {"SETOUT ofLamp\nINIT Axis\nWAIT Axis:st_init\nAxis:word = 1000\nWAIT Axis:st_init\nslR = 1 / "
       "glI\nEND\n"});
  bench.run(20);
  EXPECT_EQ(bench["QMOS.osmode"], 5);
  EXPECT_EQ(bench["2.OUT01"], 1);
  EXPECT_EQ(bench.controller->cards().analogue_outputs.at({Kind::analogue, 2, 1}).word, 1000);
  bench.set("Axis.word", 2000);
  bench.run(5);
  EXPECT_EQ(bench.controller->cards().analogue_outputs.at({Kind::analogue, 2, 1}).word, 2000);
}

// --- power ---

const std::string powered_module =
    "glI = glI + 1\nslA = slA + 1\nagTemp[1] = agTemp[1] + 1\nasKept[1] = asKept[1] + 1\n"
    "ddbCode[1, 1] = ddbCode[1, 1] + 1\ntmWait = 10000\nSETOUT ofLamp\nINIT Axis\nWAIT Axis:st_init\n"
    "Axis:posit = 5\nAxis:kept = Axis:kept + 7\nLOCK Axis\nAxis:word = 3000\nWAIT 1\nslR = slR + 1\nWAIT "
    "0\nEND\n";

TEST(QmovePower, OffSwitchesOutputsOffAndStopsEverything) {
  Bench bench({powered_module});
  bench.run(20);
  EXPECT_EQ(bench["2.OUT01"], 1);
  EXPECT_NE(bench["2.AN01"], 0);
  const double reading = bench["Axis.reading"];
  bench.controller->power(false);
  bench.controller->cards().counters.at({Kind::counter, 2, 1}).count = 555;
  bench.controller->interrupt(5, true);
  bench.run(20);
  EXPECT_EQ(bench["2.OUT01"], 0);
  EXPECT_EQ(bench["2.AN01"], 0);
  EXPECT_EQ(bench["Axis.reading"], reading);
  EXPECT_EQ(bench["QMOS.osmode"], 0);
  EXPECT_EQ(bench["slR"], 1);
}

TEST(QmovePower, OnKeepsWhatIsRetentiveAndStartsAfresh) {
  Bench bench({powered_module});
  bench.run(20);
  bench.controller->power(false);
  bench.run(3);
  bench.controller->power(true);
  EXPECT_EQ(bench["glI"], 0);
  EXPECT_EQ(bench["agTemp[1]"], 0);
  EXPECT_EQ(bench["tmWait"], 1);
  EXPECT_EQ(bench["slA"], 1);
  EXPECT_EQ(bench["asKept[1]"], 1);
  EXPECT_EQ(bench["ddbCode[1,1]"], 1);
  EXPECT_EQ(bench["Axis.st_init"], 0);
  EXPECT_EQ(bench["Axis.posit"], 0);
  EXPECT_EQ(bench["Axis.kept"], 7);
  EXPECT_EQ(bench["Axis.st_locked"], 1);
  bench.run(20);
  EXPECT_EQ(bench["glI"], 1);
  EXPECT_EQ(bench["slA"], 2);
  EXPECT_EQ(bench["Axis.kept"], 14);
}

TEST(QmovePower, OnClearsAnError) {
  Bench bench({"IF slA EQ 0\nslR = 1 / slA\nENDIF\nslR = 5\nEND\n"});
  bench.run(2);
  EXPECT_EQ(bench["QMOS.oserr"], 6);
  bench.set("slA", 1);
  bench.controller->power(false);
  bench.controller->power(true);
  bench.run(2);
  EXPECT_EQ(bench["QMOS.oserr"], 0);
  EXPECT_EQ(bench["slR"], 5);
}

TEST(QmovePower, WritesToDevicesWithoutPowerAreRefused) {
  Bench bench({"END\n"});
  bench.controller->power(false);
  bench.set("Axis.gain", 5);
  EXPECT_EQ(bench["Axis.gain"], 0);
  EXPECT_THAT(events(bench), ::testing::ElementsAre("Axis refused gain: the controller is off"));
}

// --- interrupts ---

TEST(QmoveInterrupt, ReachesDevicesAndTheLine) {
  Bench bench({"END\n"});
  bench.controller->interrupt(5, true);
  EXPECT_EQ(bench["INT5"], 1);
  EXPECT_EQ(bench["Axis.st_int"], 1);
  bench.controller->interrupt(5, false);
  EXPECT_EQ(bench["INT5"], 0);
  EXPECT_EQ(bench["Axis.st_int"], 0);
}

// --- values ---

TEST(QmoveValues, AreFoundByNameInAnyCase) {
  Bench bench({"END\n"});
  for (const std::string name :
       {"SLR",           "glI",        "gfdone",       "agtemp[5]",  "asKept [ 3 ]", "ddlHead[2]",
        "ddbcode[2, 3]", "tmWait",     "ifStart",      "ofLamp",     "axis.POSIT",   "Axis:posit",
        "Axis.quota",    "Axis.code4", "Axis.st_init", "2.CNT01",    "2.inp1",       "2.INP08",
        "2.OUT08",       "2.AN01",     "INT5",         "qmos.oserr", "QMOS.osmode"})
    EXPECT_TRUE(bench.controller->find(name)) << name;
  for (const std::string name : {"",
                                 "slX",
                                 "agTemp",
                                 "agTemp[0]",
                                 "agTemp[6]",
                                 "agTemp[1,1]",
                                 "agTemp[",
                                 "agTemp[]",
                                 "agTemp[1",
                                 "agTemp[x]",
                                 "slR[1]",
                                 "ddbCode[1]",
                                 "ddbCode[3,1]",
                                 "ddbCode[1,4]",
                                 "ddlHead[1,1]",
                                 "dgCam",
                                 "cTen",
                                 "Axis",
                                 "Axis.",
                                 ".posit",
                                 "Axis.nope",
                                 "Axis.code5",
                                 "slR.posit",
                                 "QMOS.taskmedtime",
                                 "2.AN02",
                                 "INT4",
                                 "[1]"})
    EXPECT_FALSE(bench.controller->find(name)) << name;
}

TEST(QmoveValues, HaveTheDeclaredNameAndTheUnitOfTheTable) {
  Bench bench({"END\n"});
  EXPECT_EQ(bench.controller->find("AXIS:QUOTA")->name, "Axis.posit");
  EXPECT_EQ(bench.controller->find("axis.code3")->name, "Axis.code3");
  EXPECT_EQ(bench.controller->find("AGTEMP[ 2 ]")->name, "agTemp[2]");
  EXPECT_EQ(bench.controller->find("Axis.posit")->unit, "Um");
  EXPECT_EQ(bench.controller->find("2.AN01")->unit, "V");
  EXPECT_EQ(bench.controller->find("2.CNT01")->unit, "counts");
}

TEST(QmoveValues, AreReadOnlyWhereProgramsOnlyRead) {
  Bench bench({"END\n"});
  for (const std::string name :
       {"ifStart", "ofLamp", "Axis.reading", "Axis.st_still", "2.AN01", "2.CNT01", "2.OUT01", "QMOS.oserr"})
    EXPECT_FALSE(bench.controller->find(name)->write) << name;
}

TEST(QmoveValues, AreWrittenAsProgramsStore) {
  Bench bench({"END\n"});
  bench.set("sbKept", 132);
  EXPECT_EQ(bench["sbKept"], -124);
  bench.set("gfDone", 0.5);
  EXPECT_EQ(bench["gfDone"], 1);
  bench.set("slR", 12.9);
  EXPECT_EQ(bench["slR"], 12);
  bench.set("slR", 16777217);  // a long that no single holds
  EXPECT_EQ(bench["slR"], 16777217);
  bench.set("ssR", 0.25);
  EXPECT_EQ(bench["ssR"], 0.25);
  bench.set("slR", 1e300);
  bench.set("ssR", 1e300);
  EXPECT_TRUE(std::isfinite(bench["ssR"]));
  bench.set("ddbCode[2,3]", 7);
  EXPECT_EQ(bench["ddbCode[2,3]"], 7);
  EXPECT_EQ(bench["ddbCode[2,2]"], 0);
}

TEST(QmoveValues, DeviceWritesGoThroughTheMailbox) {
  Bench bench({"INIT Axis\nEND\n"});
  bench.run(6);  // initialised at 4 ms
  bench.set("Axis.gain", 5);
  EXPECT_EQ(bench["Axis.gain"], 0);
  bench.run(3);  // the sample at 8 ms
  EXPECT_EQ(bench["Axis.gain"], 5);
}

TEST(QmoveValues, AnalogueOutputsReadInVolts) {
  Bench bench({"END\n"});
  bench.controller->cards().analogue_outputs.at({Kind::analogue, 2, 1}).word = -32767;
  EXPECT_EQ(bench["2.AN01"], -10);
}

TEST(QmoveValues, NamesAreThoseThatAreFound) {
  Bench bench({"END\n"});
  const std::vector<std::string> names = bench.controller->names();
  for (const std::string& name : names) EXPECT_TRUE(bench.controller->find(name)) << name;
  for (const std::string name : {"slR", "agTemp[1]", "ddbCode[1,1]", "Axis.posit", "Axis.st_init", "2.AN01",
                                 "INT5", "ifStop", "QMOS.oserr"})
    EXPECT_THAT(names, Contains(name));
  EXPECT_THAT(names, Not(Contains("cTen")));
}

TEST(QmoveCards, HoldEveryTerminalOfTheConfiguration) {
  const Bench bench({"END\n"});
  const Cards& cards = bench.controller->cards();
  EXPECT_TRUE(cards.counters.contains({Kind::counter, 2, 1}));
  EXPECT_TRUE(cards.inputs.contains({Kind::input, 2, 1}));
  EXPECT_TRUE(cards.inputs.contains({Kind::input, 2, 8}));
  EXPECT_TRUE(cards.outputs.contains({Kind::output, 2, 2}));
  EXPECT_TRUE(cards.outputs.contains({Kind::output, 2, 8}));
  EXPECT_TRUE(cards.analogue_outputs.contains({Kind::analogue, 2, 1}));
  EXPECT_TRUE(cards.interrupt_lines.contains(5));
}

// --- events ---

TEST(QmoveEvents, RefusalsAreSaidOnceAPowerUp) {
  Bench bench(
      {"INIT Axis\nWAIT Axis:st_init\nGO Axis\nWAIT NOT Axis:st_still\nMAIN:\nGO Axis\nAxis:gain = "
       "2000\nWAIT 1\nJUMP MAIN\nEND\n"});
  bench.run(100);
  const std::vector<std::string> first = events(bench);
  ASSERT_EQ(first.size(), 2U) << ::testing::PrintToString(first);
  EXPECT_THAT(first, Contains(HasSubstr("Axis refused GO: st_still is 0, must be 1")));
  EXPECT_THAT(first, Contains(HasSubstr("Axis out_of_range gain: 2000")));
  EXPECT_FALSE(bench.controller->has_events());
  bench.run(100);
  EXPECT_THAT(events(bench), IsEmpty());
  bench.controller->power(false);
  bench.controller->power(true);
  bench.run(100);
  EXPECT_EQ(events(bench).size(), 2U);
}

// --- retentive state ---

TEST(QmoveRetentive, SurvivesARoundTrip) {
  Bench bench({powered_module});
  bench.set("ssR", 0.1);
  bench.set("asReal[2]", -1e30);
  bench.set("ddsReal[2,3]", 1.5);
  bench.set("ddlHead[2]", -7);
  bench.set("sbKept", -128);
  bench.set("slB", -2147483648.0);
  bench.run(30);
  const std::string kept = bench.controller->retentive_state();

  Bench fresh({powered_module});
  fresh.set("asKept[3]", 99);  // not in the text: becomes 0
  Problems problems;
  ASSERT_TRUE(fresh.controller->restore(kept, problems)) << text_of(problems);
  EXPECT_EQ(fresh.controller->retentive_state(), kept);
  EXPECT_EQ(static_cast<float>(fresh["ssR"]), 0.1F);
  EXPECT_EQ(fresh["slA"], 1);
  EXPECT_EQ(fresh["asKept[3]"], 0);
  EXPECT_EQ(fresh["ddlHead[2]"], -7);
  EXPECT_EQ(fresh["Axis.kept"], 7);
  EXPECT_EQ(fresh["Axis.st_locked"], 1);
  EXPECT_EQ(fresh["glI"], 0);
}

TEST(QmoveRetentive, TextIsReadable) {
  Bench bench({"END\n"});
  bench.set("slA", 12);
  bench.set("ddbCode[2,1]", -124);
  const std::string text = bench.controller->retentive_state();
  EXPECT_THAT(text, HasSubstr("\nslA = 12\n"));
  EXPECT_THAT(text, HasSubstr("\nddbCode[2,1] = -124\n"));
  EXPECT_THAT(text, HasSubstr("\nAxis:kept = 0\n"));
  EXPECT_THAT(text, Not(HasSubstr("glI")));
  EXPECT_THAT(text, Not(HasSubstr("posit")));
}

TEST(QmoveRetentive, FaultsOfTheTextChangeNothing) {
  Bench bench({"END\n"});
  bench.set("slA", 3);
  Problems problems;
  EXPECT_FALSE(bench.controller->restore(
      "; comment\nslA = 5 ; fine\n slRR = 1\nglI = 2\nslB 4\nslB =\nsbKept = 132\nslB = 1.5\nslB = x\n"
      "slA = 6\nAxis:posit = 1\nddbCode[3,1] = 1\nAxis.st_locked = 2147483648\nssR = 1e999\n",
      problems, "kept.txt"));
  EXPECT_EQ(
      text_of(problems),
      "kept.txt:3:2: unknown name 'slRR'; did you mean 'slR'?\n"
      "kept.txt:4:1: 'glI' is not retentive; remove the line, it is set at each start\n"
      "kept.txt:5:1: no '=' in 'slB 4'; write: name = value\n"
      "kept.txt:6:1: a name or value is missing; write: name = value\n"
      "kept.txt:7:10: 'sbKept' cannot be '132'; write a whole number from -128 to 127\n"
      "kept.txt:8:7: 'slB' cannot be '1.5'; write a whole number from -2147483648 to 2147483647\n"
      "kept.txt:9:1: 'slB' is given twice; remove one of the lines\n"
      "kept.txt:10:1: 'slA' is given twice; remove one of the lines\n"
      "kept.txt:11:1: 'Axis:posit' is not retentive; remove the line, it is set at each start\n"
      "kept.txt:12:1: unknown name 'ddbCode[3,1]'; did you mean 'ddbCode[1,1]'?\n"
      "kept.txt:13:18: 'Axis.st_locked' cannot be '2147483648'; write a whole number from -2147483648 to "
      "2147483647\n"
      "kept.txt:14:7: 'ssR' cannot be '1e999'; write a number from -3.402823466e+38 to 3.402823466e+38\n");
  EXPECT_EQ(bench["slA"], 3);
}

TEST(QmoveRetentive, IsRefusedOnceADeviceIsInitialised) {
  Bench bench({"INIT Axis\nEND\n"});
  bench.run(10);
  Problems problems;
  EXPECT_FALSE(bench.controller->restore("Axis:kept = 1\n", problems));
  EXPECT_THAT(text_of(problems),
              HasSubstr("retentive state:1:1: the device of 'Axis:kept' is initialised already"));
}

TEST(QmoveController, RunsTheSameWayTwice) {
  const auto run = [] {
    Bench bench({powered_module, "MAIN:\nslB = slB * 3 + tmWait + Axis:kept\nWAIT 1\nJUMP MAIN\nEND\n"}, 3);
    bench.run(200);
    std::string text = bench.controller->retentive_state();
    for (const ControllerEvent& event : bench.controller->take_events()) text += event.text;
    return text;
  };
  EXPECT_EQ(run(), run());
}

}  // namespace
}  // namespace drycut::devices::qmove
