#include "devices/oopos2/movement.hpp"
#include "tests/devices/oopos2/fixture.hpp"

namespace drycut::devices::oopos2 {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// The phases of a placement, to the sample (001 1.2.2; spec 9.3). A sample is 1/100 s.
class Oopos2Phases : public Oopos2Test {
 protected:
  Oopos2Phases() {
    set({{"setpos", 1000}, {"tbrake", 3}, {"slowdly", 4}, {"toldly", 5}, {"iner01", 100}});
    coast = 10;
    command("INIT");
  }
};

TEST_F(Oopos2Phases, ForwardAsInTheManualsPicture) {
  covers({"START accepted", "st_movfwd", "st_movslow", "st_still", "st_toll", "OutAva", "OutMov", "OutRal",
          "setpos", "slowpos", "slowdly", "tbrake", "toldly", "bklashmode 0", "slowtype 0", "breaktype 0",
          "INIT accepted", "st_init"});
  EXPECT_EQ(on(), "F");
  EXPECT_EQ(get("st_still"), 1);
  order("START");
  // 20 a sample from sample 4 on: 800 in 43; then 4 a sample from 48 on: 990 and over (992) in 95.
  EXPECT_THAT(record(100), ElementsAre("0 ", "3 AM", "43 ", "45 R", "47 AMR", "95 "));
  EXPECT_EQ(get("posit"), 1002);  // it coasted 10
  EXPECT_EQ(get("st_still"), 0);
  EXPECT_EQ(get("st_toll"), 0);
  EXPECT_THAT(record(3), ElementsAre("0 F"));  // toldly after 95
  EXPECT_EQ(get("st_still"), 1);
  EXPECT_EQ(get("st_toll"), 1);
  EXPECT_THAT(diagnostics(), IsEmpty());
}

TEST_F(Oopos2Phases, TheStatesAreThoseOfTheOutputs) {
  covers({"st_movbwd", "st_movdir", "st_brake", "OutInd", "OutDir", "OutFre"});
  const auto agree = [&] {
    EXPECT_EQ(get("st_movfwd"), output(1));
    EXPECT_EQ(get("st_movbwd"), output(2));
    EXPECT_EQ(get("st_movdir"), output(3));
    EXPECT_EQ(get("st_movfwd") + get("st_movbwd"), output(4));
    EXPECT_EQ(get("st_movslow"), output(5));
    EXPECT_EQ(get("st_brake"), output(6));
  };
  for (const int quota : {1000, -500, 300}) {
    write("setpos", quota);
    order("START");
    do {
      tick();
      agree();
    } while (get("st_still") == 0);
  }
}

TEST_F(Oopos2Phases, BackwardIsTheMirror) {
  write("setpos", -1000);
  order("START");
  EXPECT_THAT(record(100), ElementsAre("0 ", "3 IDM", "43 D", "45 DR", "47 IDMR", "95 D"));
  EXPECT_EQ(get("posit"), -1002);
  EXPECT_THAT(record(3), ElementsAre("0 DF"));
  EXPECT_EQ(get("st_toll"), 1);
  EXPECT_EQ(get("st_movdir"), 1);
}

TEST_F(Oopos2Phases, WithoutTimesPhasesFollowInOneSample) {
  set({{"tbrake", 0}, {"slowdly", 0}, {"toldly", 0}});
  order("START");
  EXPECT_THAT(record(100), ElementsAre("0 AM", "40 AMR", "88 F"));
  EXPECT_EQ(get("st_still"), 1);
  EXPECT_EQ(get("posit"), 1002);
}

TEST_F(Oopos2Phases, InsideTheSlowRangeItGoesSlowAtOnce) {
  write("setpos", 150);
  order("START");
  // Both outputs together after tbrake; 4 a sample from 4 on, 140 in 38.
  EXPECT_THAT(record(50), ElementsAre("0 ", "3 AMR", "38 ", "43 F"));
}

TEST_F(Oopos2Phases, InsideTheInertiaRangeNothingIsSwitchedOn) {
  place(-500);
  place(0);  // the last one was driven
  write("posit", 0);
  set({{"setpos", 8}, {"inertmode", 2}, {"tolln", 0}});
  order("START");
  EXPECT_THAT(record(20), ElementsAre("0 ", "8 F"));
  EXPECT_EQ(get("st_toll"), 0);
  EXPECT_EQ(get("iner01"), 100);  // it has not coasted: nothing is learnt
  EXPECT_THAT(diagnostics(),
              ElementsAre("setpos: no output was switched on, the quota 8 is within the inertia range"));
}

TEST_F(Oopos2Phases, TheGapIsPassedAtHalfOfAnOddTime) {
  write("slowdly", 5);
  order("START");
  EXPECT_THAT(record(60), ElementsAre("0 ", "3 AM", "43 ", "46 R", "48 AMR"));
}

TEST_F(Oopos2Phases, TheInertiaRangeEndsTheGapToo) {
  coast_fast = 300;
  write("slowdly", 100);
  order("START");
  // It coasts 5 a sample from 800 on: 990 after 38 samples, in the gap's first half.
  EXPECT_THAT(record(90), ElementsAre("0 ", "3 AM", "43 ", "86 F"));
  EXPECT_EQ(get("posit"), 1030);
}

TEST_F(Oopos2Phases, BreaktypeOneIsOnWhileTheBrakeIsOff) {
  covers({"breaktype", "breaktype 1"});
  write("breaktype", 1);
  tick();
  EXPECT_EQ(on(), "");
  order("START");
  EXPECT_THAT(record(110), ElementsAre("0 F", "3 AMF", "43 F", "45 RF", "47 AMRF", "95 F", "100 "));
  EXPECT_EQ(get("st_brake"), 0);
}

TEST_F(Oopos2Phases, StopSwitchesOffAtOnce) {
  covers({"STOP accepted"});
  set({{"inertmode", 2}, {"setpos", 1000}});
  order("START");
  ticks(50);  // slow
  ASSERT_EQ(on(), "AMR");
  command("STOP");
  EXPECT_EQ(on(), "");
  EXPECT_THAT(record(10), ElementsAre("4 F"));
  EXPECT_EQ(get("st_still"), 1);
  EXPECT_EQ(get("st_toll"), 0);
  EXPECT_EQ(get("iner01"), 100);
}

TEST_F(Oopos2Phases, AStopInAnyPhaseEndsIt) {
  for (const int when : {1, 10, 44, 46, 50, 97}) {
    count() = 0;
    tick();
    write("posit", 0);
    tick();
    order("START");
    ticks(when);
    command("STOP");
    EXPECT_EQ(on(), "") << when;
    EXPECT_EQ(get("st_still"), 0) << when;
    ASSERT_TRUE(wait("st_still", 1, 6)) << when;
    EXPECT_EQ(get("st_toll"), 0) << when;
  }
}

TEST_F(Oopos2Phases, AStopWhileItCoastsDoesNotPutOffTheEnd) {
  order("START");
  ticks(98);
  ASSERT_EQ(on(), "");
  order("STOP");
  EXPECT_THAT(record(5), ElementsAre("2 F"));
  EXPECT_EQ(get("st_toll"), 0);  // no placement any more
}

TEST_F(Oopos2Phases, StopBeatsStartInOneSample) {
  order("START");
  order("STOP");
  tick();
  EXPECT_EQ(get("st_still"), 0);  // STOP first, at rest without effect; then START
  ticks(20);
  diagnostics();
  order("START");
  order("STOP");
  tick();
  EXPECT_EQ(on(), "");
  EXPECT_THAT(diagnostics(), ElementsAre("START: st_still is 0, must be 1"));
}

TEST_F(Oopos2Phases, TheNextStartIsAsTheFirst) {
  order("START");
  ticks(101);
  ASSERT_EQ(get("st_still"), 1);
  set({{"setpos", 2002}, {"enstol", 1}});
  order("START");
  EXPECT_EQ(record(101).front(), "0 ");
  EXPECT_EQ(get("posit"), 2004);
}

// A period that is no divisor of the times: a timer is out in the first sample that is late enough.
class Oopos2Period : public Oopos2Test {
 protected:
  Oopos2Period() : Oopos2Test(7) {
    set({{"setpos", 1000}, {"tbrake", 3}, {"slowdly", 4}, {"toldly", 5}});
    command("INIT");
  }
};

TEST_F(Oopos2Period, TimersRunOutInTheFirstSampleAfterThem) {
  order("START");
  // 30 ms: 5 samples of 7 ms. 20 a sample: 800 in 45. 20 ms of 40: 3 samples, 40 ms: 6 samples. 4 a sample:
  // 1000 in 101. 50 ms: 8 samples.
  EXPECT_THAT(record(120), ElementsAre("0 ", "5 AM", "45 ", "48 R", "51 AMR", "101 ", "109 F"));
}

TEST(Oopos2Movement, TimersAreNeverNegative) {
  Movement movement;
  movement.times = {30, 0, 0, 50};
  movement.run({false, false, false, std::nullopt, 0});
  movement.tick(1000);
  EXPECT_EQ(movement.timer_ms(), 0);
  movement.step(0, 0);
  EXPECT_TRUE(movement.running());
}

}  // namespace
}  // namespace drycut::devices::oopos2
