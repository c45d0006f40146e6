#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "tests/devices/qmove/support.hpp"

// The controller as the simulation sees it: run-time errors, power, interrupts, events.
namespace drycut::devices::qmove {
namespace {

using testing::Bench;
using ::testing::Contains;
using testing::events;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::powered_module;
using testing::text_of;

// --- run-time errors (spec 4.5) ---

struct RunFault {
  std::string statement;
  int number;
  std::string text;
};

TEST(QmoveRunTime, ErrorsStopAllTasksAndNameTheirPlace) {
  const std::vector<RunFault> cases = {
      {"slR = agTemp[glI]", 3, "index out of bound"},
      {"slR = agTemp[glI + 6]", 3, "index out of bound"},
      {"agTemp[glI - 1] = 2", 3, "index out of bound"},
      {"slR = ddlHead[glI + 3]", 4, "datagroup recipe out of range"},
      {"ddlHead[glI] = 1", 4, "datagroup recipe out of range"},
      {"slR = ddbCode[glI + 3, 1]", 4, "datagroup recipe out of range"},
      {"slR = ddbCode[1, glI + 4]", 5, "datagroup step out of range"},
      {"ddbCode[2, glI] = 1", 5, "datagroup step out of range"},
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

// A write to a device is work for the device too: a hundred times an instruction's.
TEST(QmoveRunTime, WritesToDevicesCountAsTheWorkThatTheyAre) {
  for (const std::string& work : {std::string("Axis:gain = 1"), std::string("DELCNT Axis")}) {
    Bench bench({"INIT Axis\nWAIT Axis:st_init\nMAIN:\nslA = slA + 1\n" + work + "\nJUMP MAIN\nEND\n"});
    bench.run(20);
    EXPECT_EQ(bench["QMOS.oserr"], 8) << work;
    EXPECT_GT(bench["slA"], 9'000) << work;
    EXPECT_LT(bench["slA"], 10'000) << work;
    EXPECT_THAT(events(bench), Contains(HasSubstr("task0 error task0.mod:5: error 8: watchdog"))) << work;
  }
}

TEST(QmoveRunTime, ATableOfAllRowsFitsIntoOneTurn) {
  Bench bench(
      {"INIT Axis\nWAIT Axis:st_init\nFOR (glI = 0, glI LT 768, 1)\nAxis:gain = 1\nNEXT\nslR = 1\nEND\n"});
  bench.run(10);
  EXPECT_EQ(bench["slR"], 1);
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
