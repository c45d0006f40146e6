#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "tests/devices/qmove_support.hpp"

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
