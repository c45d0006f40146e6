#include "devices/oopos2/movement.hpp"
#include "tests/devices/oopos2/fixture.hpp"

namespace drycut::devices::oopos2 {
namespace {

// The phases of a placement, to the sample (001 1.2.2; spec 9.3). A sample is 1/100 s.
class Oopos2Phases : public Oopos2Test {
 protected:
  Oopos2Phases() {
    does("setpos=1000 tbrake=3 slowdly=4 toldly=5 iner01=100");
    coast = 10;
    does("INIT");
  }
};

TEST_F(Oopos2Phases, ForwardAsInTheManualsPicture) {
  covers({"START accepted", "st_movfwd", "st_movslow", "OutAva", "OutMov", "OutRal", "setpos", "slowpos",
          "slowdly", "tbrake", "toldly", "bklashmode 0", "slowtype 0", "breaktype 0", "INIT accepted",
          "st_init"});
  shows("on=F still");
  does("START!");
  // 20 a sample from sample 4 on: 800 in 43; then 4 a sample from 48 on: 990 and over (992) in 95.
  switches("", 100, {"0 ", "3 AM", "43 ", "45 R", "47 AMR", "95 "});
  shows("posit=1002");  // it coasted 10
  shows("!still !toll");
  switches("", 3, {"0 F"});  // toldly after 95
  shows("still toll silent");
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
    does("START!");
    do {
      does("+1");
      agree();
    } while (get("st_still") == 0);
  }
}

TEST_F(Oopos2Phases, BackwardIsTheMirror) {
  switches("setpos=-1000 START!", 100, {"0 ", "3 IDM", "43 D", "45 DR", "47 IDMR", "95 D"});
  shows("posit=-1002");
  switches("", 3, {"0 DF"});
  shows("toll movdir");
}

TEST_F(Oopos2Phases, WithoutTimesPhasesFollowInOneSample) {
  switches("tbrake=0 slowdly=0 toldly=0 START!", 100, {"0 AM", "40 AMR", "88 F"});
  shows("still posit=1002");
}

TEST_F(Oopos2Phases, InsideTheSlowRangeItGoesSlowAtOnce) {
  does("setpos=150 START!");
  // Both outputs together after tbrake; 4 a sample from 4 on, 140 in 38.
  switches("", 50, {"0 ", "3 AMR", "38 ", "43 F"});
}

TEST_F(Oopos2Phases, InsideTheInertiaRangeNothingIsSwitchedOn) {
  place(-500);
  place(0);  // the last one was driven
  switches("posit=0 setpos=8 inertmode=2 tolln=0 START!", 20, {"0 ", "8 F"});
  shows("!toll iner01=100");  // it has not coasted: nothing is learnt
  says({"setpos: no output was switched on, the quota 8 is within the inertia range"});
}

TEST_F(Oopos2Phases, TheGapIsPassedAtHalfOfAnOddTime) {
  switches("slowdly=5 START!", 60, {"0 ", "3 AM", "43 ", "46 R", "48 AMR"});
}

TEST_F(Oopos2Phases, TheInertiaRangeEndsTheGapToo) {
  coast_fast = 300;
  does("slowdly=100 START!");
  // It coasts 5 a sample from 800 on: 990 after 38 samples, in the gap's first half.
  switches("", 90, {"0 ", "3 AM", "43 ", "86 F"});
  shows("posit=1030");
}

TEST_F(Oopos2Phases, BreaktypeOneIsOnWhileTheBrakeIsOff) {
  covers({"breaktype", "breaktype 1"});
  after("breaktype=1 +1", "on=");
  switches("START!", 110, {"0 F", "3 AMF", "43 F", "45 RF", "47 AMRF", "95 F", "100 "});
  shows("!brake");
}

TEST_F(Oopos2Phases, StopSwitchesOffAtOnce) {
  does("inertmode=2 setpos=1000 START! +50");  // slow
  shows("on=AMR");
  after("STOP", "on=");
  switches("", 10, {"4 F"});
  shows("still !toll iner01=100");
}

TEST_F(Oopos2Phases, AStopInAnyPhaseEndsIt) {
  for (const int when : {1, 10, 44, 46, 50, 97}) {
    does("count=0 +1 posit=0 +1 START!");
    ticks(when);
    does("STOP");
    EXPECT_EQ(on(), "") << when;
    EXPECT_EQ(get("st_still"), 0) << when;
    ASSERT_TRUE(wait("st_still", 1, 6)) << when;
    EXPECT_EQ(get("st_toll"), 0) << when;
  }
}

TEST_F(Oopos2Phases, AStopWhileItCoastsDoesNotPutOffTheEnd) {
  after("START! +98", "on=");
  switches("STOP!", 5, {"2 F"});
  shows("!toll");  // no placement any more
}

TEST_F(Oopos2Phases, StopBeatsStartInOneSample) {
  after("START! STOP! +1", "!still");  // STOP first, at rest without effect; then START
  after("+20 forget START! STOP! +1", "on=");
  says({"START: st_still is 0, must be 1"});
}

TEST_F(Oopos2Phases, TheNextStartIsAsTheFirst) {
  after("START! +101", "still");
  does("setpos=2002 enstol=1 START!");
  EXPECT_EQ(record(101).front(), "0 ");
  shows("posit=2004");
}

// A period that is no divisor of the times: a timer is out in the first sample that is late enough.
class Oopos2Period : public Oopos2Test {
 protected:
  Oopos2Period() : Oopos2Test(7) { does("setpos=1000 tbrake=3 slowdly=4 toldly=5 INIT"); }
};

TEST_F(Oopos2Period, TimersRunOutInTheFirstSampleAfterThem) {
  does("START!");
  // 30 ms: 5 samples of 7 ms. 20 a sample: 800 in 45. 20 ms of 40: 3 samples, 40 ms: 6 samples. 4 a sample:
  // 1000 in 101. 50 ms: 8 samples.
  switches("", 120, {"0 ", "5 AM", "45 ", "48 R", "51 AMR", "101 ", "109 F"});
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
