#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "tests/devices/qmove/support.hpp"

// The schedule of tasks and devices, and the barrier between programs and devices.
namespace drycut::devices::qmove {
namespace {

using testing::Bench;
using testing::text_of;
using testing::usual_cnf;

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

// --- a read waits for what was posted before it, never for more ---

const std::string writes_every_scan =  // the start-up loop of 000 1.1.1.1, with the puppet's names
    "INIT Axis\nWAIT Axis:st_init\nMAIN:\nIF Axis:st_int\nAxis:gain = 2\nELSE\nAxis:gain = 1\nENDIF\n"
    "slB = slB + 1\nWAIT 1\nJUMP MAIN\nEND\n";
const std::string reads_every_scan =
    "WAIT Axis:st_init\nMAIN:\nslR = Axis:posit\nslR = slR + Axis:gain\nslA = slA + 1\nWAIT 1\nJUMP "
    "MAIN\nEND\n";

std::string cnf_of_period(int milliseconds) {
  std::string cnf(usual_cnf);
  cnf.replace(cnf.find("PUPPET 4"), 8, "PUPPET " + std::to_string(milliseconds));
  return cnf;
}

// TCamp and cycle 2 ms: 500 rounds a second, less the one of INIT.
TEST(QmoveBarrier, AWriterOfEveryScanCostsAReaderNoTurnInEitherOrder) {
  for (const bool writer_first : {true, false}) {
    Bench bench(writer_first ? std::vector{writes_every_scan, reads_every_scan}
                             : std::vector{reads_every_scan, writes_every_scan},
                2, cnf_of_period(2));
    ASSERT_TRUE(bench.controller) << text_of(bench.problems);
    bench.run(1000);
    EXPECT_GE(bench["slB"], 497) << writer_first;
    EXPECT_GE(bench["slA"], 497) << writer_first;
    EXPECT_LE(bench["slA"], 500) << writer_first;
    EXPECT_EQ(bench["slR"], 1) << writer_first;
    EXPECT_TRUE(bench.controller->take_events().empty()) << writer_first;
  }
}

// Each read waits for one sample; that another task posts again before each costs no second one.
TEST(QmoveBarrier, LaterPostsOfOthersNeverProlongAWait) {
  Bench bench({to_1000 + "MAIN:\nAxis:gain = 7\nWAIT 1\nJUMP MAIN\nEND\n",
               "WAIT Axis:st_init\nWAIT 1\nDELCNT Axis\nslR = Axis:posit\nslA = 1\nEND\n"});
  // Samples every 4 ms: 4 INIT, 8 what task0 posted before task1 read st_init, 12 DELCNT.
  bench.run(12);
  EXPECT_EQ(bench["slA"], 0);
  bench.run(1);
  EXPECT_EQ(bench["slA"], 1);
  EXPECT_EQ(bench["slR"], 900);
}

// A read sees what another task posted before, with a flag in memory beside it to say so.
TEST(QmoveBarrier, AReadSeesWhatAnotherTaskPostedBefore) {
  for (const int cycle : {1, 2, 4, 5}) {
    Bench bench({"INIT Axis\nWAIT Axis:st_init\nAxis:gain = 9\ngfDone = 1\nEND\n",
                 "WAIT gfDone\nslR = Axis:gain\nEND\n"},
                cycle);
    bench.run(40);
    EXPECT_EQ(bench["slR"], 9) << cycle;
  }
}

TEST(QmoveBarrier, AStatementThatReadsTwoDevicesWaitsForBoth) {
  std::string cnf(usual_cnf);
  cnf.insert(cnf.find("END\n", cnf.find("INTDEVICE")), "Slow PUPPET 6 2.CNT01 X X.X X.X X.X\n");
  Bench bench({"INIT Axis\nINIT Slow\nWAIT Axis:st_init AND Slow:st_init\nAxis:gain = 3\nSlow:gain = 4\n"
               "slR = Axis:gain * 10 + Slow:gain\nEND\n",
               "MAIN:\nAxis:word = 1\nSlow:word = 1\nWAIT 1\nJUMP MAIN\nEND\n"},
              1, cnf);
  ASSERT_TRUE(bench.controller) << text_of(bench.problems);
  bench.run(20);
  EXPECT_EQ(bench["slR"], 34);
}

// --- a task that comes to no WAIT ---

TEST(QmoveBarrier, ATaskHeldUpForASecondIsToldOnceWithDeviceAndLine) {
  Bench bench({"INIT Axis\nWAIT Axis:st_init\nMAIN:\nAxis:gain = 1\nslR = Axis:gain\nJUMP MAIN\nEND\n"});
  bench.run(1000);
  EXPECT_TRUE(bench.controller->take_events().empty());
  bench.run(3000);
  EXPECT_EQ(
      testing::events(bench),
      (std::vector<std::string>{
          "task0 held_up task0.mod:5: no WAIT and no END for 1 s: this statement reads Axis and waits until "
          "it has taken what the task wrote before, as each read does; put a WAIT into the loop"}));
  EXPECT_EQ(bench["QMOS.oserr"], 0);
}

TEST(QmoveBarrier, AWaitThatIsFalseForLongIsATurnEachScan) {
  Bench bench({"INIT Axis\nWAIT Axis:st_init\nWAIT NOT Axis:st_still\nEND\n",
               "MAIN:\nAxis:gain = 1\nWAIT 1\nJUMP MAIN\nEND\n"});
  bench.run(5000);
  EXPECT_TRUE(bench.controller->take_events().empty());
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

}  // namespace
}  // namespace drycut::devices::qmove
