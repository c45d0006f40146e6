#include <gmock/gmock.h>

#include "tests/devices/camming4/covers.hpp"
#include "tests/devices/camming4/fixture.hpp"

namespace drycut::devices::camming4 {
namespace {

using testing::Contains;

using Camming4Motion = Camming4Test;

TEST_F(Camming4Motion, StartsUpAsTheManualShows) {
  // 000 1.1.1.1: commands whose effect already holds are no refusals [D16].
  after("INIT LOOPON CALOFF CNTUNLOCK CNTDIR CNTUNLOCKM CNTDIRM REGON",
        "!cal !cntlock !cntrev !cntlockm !cntrevm !regoff !warning !emrg init loopon silent");
}

TEST_F(Camming4Motion, JogsWithOneVoltAtATenthOfMaxvel) {
  after("INIT LOOPON setvel=5000 MANFW", "!still acc");
  does("+60");  // the ramp takes 0.1 s
  shows("vconst ffwdreg=3277");
  EXPECT_NEAR(word(), 3277, 0.02 * 3277);
  shows("vout=10 !movdir");
  after("STOP", "dec");
  after("until:still:60 +100", "follerr<2");
  after("MANBW +60", "ffwdreg=-3277 movdir");
  after("STOP until:still +5", "movdir");  // of the last movement
}

TEST_F(Camming4Motion, TheToleranceOfAQuotaNeedsAPlacement) {
  after("INIT LOOPON setpos=0 sample", "tpos !toll");
  after("setpos=3 sample", "!tpos");
  after("setpos=2 sample", "tpos");
}

TEST_F(Camming4Motion, AStoppedPlacementIsNotInTolerance) {
  after("INIT LOOPON setpos=1000 START +80 STOP until:still +50", "!toll posit<999");
}

// 000 1.9.2 toll: the placement, not the arrival in a cam.
TEST_F(Camming4Motion, ACamKeepsTheToleranceUntilItLeavesTheQuotaForGood) {
  does("INIT LOOPON");
  ASSERT_TRUE(place(1000));
  rows({{133, 100, 0}, {131, 100, 50}, {135, 100, 50}, {131, 100, -50}, {135, 100, -50}, {136}});
  after("STARTCAM +8*10", "camex toll");
  after("+20*10", "!toll");
  after("+40*10", "!camex posit=1000~2 !toll");
}

TEST_F(Camming4Motion, ChangesSpeedAndTargetOnTheFly) {
  after("INIT LOOPON setpos=5000 START +60", "chvel");
  after("setvel=2500 setpos=4000 +60", "ffwdreg=1638");
  after("until:dec", "!chvel");
  after("until:still +200", "posit=4000~1 toll tpos");
  covers({"setvel", "setpos"});
}

TEST_F(Camming4Motion, ATargetBehindIsStoredOnly) {
  after("INIT LOOPON setpos=2000 START +100 setpos=100 until:still +200",
        "posit=2000~1 setpos=100 toll !tpos");
}

TEST_F(Camming4Motion, WhatTheRunningMovementCannotTakeIsSaid) {
  says("INIT LOOPON setpos=3000 START +150 forget setpos=100 +1",
       {"setpos: kept for the next movement, the running one cannot take it any more"});
  after("setpos=4000 +1", "silent");
  says("until:dec setvel=900 tdec=50 +1",
       {"setvel: kept for the next movement, the running one cannot take it any more",
        "tdec: kept for the next movement, the running one cannot take it any more"});
  shows("setvel=900");
  does("until:still setpos=9000 START +100 forget posit=20000");  // beyond the quota
  says("+1", {"posit: the running movement cannot reach its quota any more and stops"});
}

TEST_F(Camming4Motion, ATimeThatWasRefusedActsNowhere) {
  // 000 1.9.3: in motion only if the quota can be reached. In use: 0.1 s and 250 Um to stop.
  const std::vector<std::string> kept = {
      "tdec: kept for the next movement, the running one cannot take it any more"};
  does("maxpos=4000 INIT LOOPON MANFW +350 forget");  // about 3250 Um
  says("tdec=999 +1", kept);
  EXPECT_EQ(duration("STOP"), 50);
  shows("posit<4000");
  does("posit=0 tdec=100 setpos=4000 START +350 forget");
  says("tdec=999 +1", kept);
  after("setvel=2500 +60", "ffwdreg=1638 silent");
  after("until:still +200", "posit=4000~1 toll silent");
}

TEST_F(Camming4Motion, AShortPlacementMadeLongInItsRampGoesAtSetvel) {
  after("ramptype=1 rtype=1 INIT LOOPON setpos=50 START +9 setpos=4000 +200", "vconst ffwdreg=3277");
  after("until:still +200", "posit=4000~1 toll");
}

TEST_F(Camming4Motion, LoopOnGoesOnToTheQuota) {
  // 000 1.1.6.4: without stopping the axis. With the loop open it has gone 3375 or 3787 Um where 3750 are
  // due, and has 625 or 212 Um left where the ramp takes 250.
  for (const int ramptype : {0, 1})
    for (const int feedfw : {900, 1010}) {
      SCOPED_TRACE(testing::Message() << ramptype << ' ' << feedfw);
      does("power INIT posit=0 sample forget");
      set({{"ramptype", ramptype}, {"feedfw", feedfw}});
      after("setpos=4000 START until:dec +1 LOOPON until:still +300", "posit=4000~1 toll silent");
    }
}

TEST_F(Camming4Motion, LoopOnBeyondTheQuotaStopsAndIsTold) {
  does("feedfw=1100 toll=500 INIT setpos=4000 START until:dec forget");  // at 4125 Um
  says("LOOPON", {"LOOPON: the running movement cannot reach its quota any more and stops"});
  after("until:still:51 +300", "posit=4375~15 toll");  // 250 Um on
}

TEST_F(Camming4Motion, AnOpenLoopStartsWhereTheAxisStands) {
  // 000 1.1.11: moved by hand, posit 0, minpos 0, maxpos the stroke, START without the position loop.
  after("INIT count+=300 +2 posit=0 minpos=0 maxpos=1000 setpos=1000 START until:still", "posit=1000~2");
  after("count+=-700 +2 MANFW until:still", "posit=1000~2");
  does("count+=-700 +2");
  rows({{154, 1000, 1000}, {137, 1}});
  after("+1 STARTCAM", "follerr=0 sync posit=300~2");
}

TEST_F(Camming4Motion, EpicycloidalRampsPlaceInTheSameTime) {
  does("ramptype=1 INIT LOOPON setpos=1000 START!");
  const long before = samples;
  does("+1 until:still");
  EXPECT_EQ(samples - before, 150);
  after("+200", "posit=1000~1");
}

TEST_F(Camming4Motion, RefusesWhatItsConditionsForbid) {
  does("INIT LOOPON");
  struct Case {
    const char* command;
    const char* reason;
  };
  for (const auto& [name, reason] :
       {Case{"STOP", "STOP: st_still is 1, must be 0"}, Case{"STOPCAM", "STOPCAM: st_camex is 0, must be 1"},
        Case{"INIT", "INIT: st_init is 1, must be 0"}, Case{"INTDSBL", "INTDSBL: needs intcapt > 0"}}) {
    does("RSWRN forget");
    command(name);
    EXPECT_THAT(diagnostics(), Contains(reason));
    EXPECT_EQ(get("wrncode"), 11) << name;
  }
  does("MANFW +10 forget");
  for (const auto& [name, reason] :
       {Case{"START", "START: st_still is 0, must be 1"}, Case{"MANBW", "MANBW: st_still is 0, must be 1"},
        Case{"STARTCAM", "STARTCAM: st_still is 0, must be 1"},
        Case{"REGOFF", "REGOFF: st_still is 0, must be 1"},
        Case{"PRESET", "PRESET: needs st_still = 1 or st_prson = 1"},
        Case{"DELCNT", "DELCNT: st_still is 0, must be 1"}}) {
    command(name);
    EXPECT_THAT(diagnostics(), Contains(reason));
  }
  for (const char* name : {"decpt", "measure", "maxvel", "maxpos", "prspos", "toll", "ramptype"}) {
    const std::int32_t before = get(name);
    write(name, before + 1);
    does("+1");
    EXPECT_EQ(get(name), before) << name;
  }
}

TEST_F(Camming4Motion, ReportsRangesThatDependOnOtherParameters) {
  says("maxpos=100 minpos=-100 forget setvel=50001 setpos=101 sprsvel=5001 setvel=50000 prspos=-100",
       {"setvel: 50001 is outside 0..50000 (maxvel), taken anyway",
        "setpos: 101 is outside -100..100 (maxpos), taken anyway",
        "sprsvel: 5001 is outside 0..5000 (prsvel), taken anyway"});
  shows("setpos=101");
}

TEST_F(Camming4Motion, ReportsAResolutionOutOfRange) {
  says("measure=2 pulse=1 measurem=934 pulsem=999999 INIT",
       {"measure: 2 * 4 / 1 is outside 0.00374..4, taken anyway"});
}

TEST_F(Camming4Motion, SaysWhatUnsetParametersActAs) {
  says("measure=0 pulse=0 measurem=-3 pulsem=0 maxvel=0 setpos=10 forget INIT",
       {"measure: 0 acts as 1", "pulse: 0 acts as 1", "measurem: -3 acts as 1", "pulsem: 0 acts as 1"});
  row(1, {154, 1000, 1000});
  for (const char* name : {"START", "MANFW", "PRESET", "STARTCAM"}) {
    command(name);
    EXPECT_THAT(diagnostics(),
                Contains("maxvel: 0 is no speed: ramps take no time, and the output is offset alone"))
        << name;
    does("EMRG RESUME");
  }
  says("measure=5 pulse=2147483647 +1",
       {"pulse: 2147483647 is outside 1..999999, taken anyway", "pulse: 2147483647 acts as 1073741824"});
}

TEST_F(Camming4Motion, HostileParametersAreHarmless) {
  for (const DeviceVariable& variable : device->type().variables)
    for (const std::int32_t value : {0, -1, 2147483647, -2147483647 - 1}) {
      write(std::string(variable.name) + (variable.rows > 1 ? "1" : ""), value);
      does("INIT! +1*1000000");
      for (const char* name : {"LOOPON", "START", "MANFW", "STARTCAM", "PRESET", "STOP", "RSERR", "RESUME"}) {
        order(name);
        does("+1*-1000000");
      }
    }
  EXPECT_LE(std::abs(word()), 32767);
}

/// The manual's own example names one counter for both axes.
class Camming4OneCounter : public Camming4Test {
 protected:
  Camming4OneCounter() : Camming4Test("2.CNT01", "2.CNT01") {}
};

TEST_F(Camming4OneCounter, CountsForSlaveAndMaster) {
  after("measurem=1 pulsem=2 INIT count=10 sample", "posit=10 positm=5");
}

}  // namespace
}  // namespace drycut::devices::camming4
