#include <gmock/gmock.h>

#include "tests/devices/camming4/covers.hpp"
#include "tests/devices/camming4/fixture.hpp"

namespace drycut::devices::camming4 {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;

using Camming4Motion = Camming4Test;

TEST_F(Camming4Motion, DoesNothingBeforeInit) {
  order("LOOPON");
  tick();
  EXPECT_EQ(get("st_loopon"), 0);
  EXPECT_EQ(get("st_still"), 1);
  slave().count = 500;
  tick();
  EXPECT_EQ(get("posit"), 0);
  EXPECT_EQ(get("st_warning"), 0);
}

TEST_F(Camming4Motion, StartsUpAsTheManualShows) {
  // 000 1.1.1.1: commands whose effect already holds are no refusals [D16].
  for (const char* name :
       {"INIT", "LOOPON", "CALOFF", "CNTUNLOCK", "CNTDIR", "CNTUNLOCKM", "CNTDIRM", "REGON"})
    command(name);
  for (const char* name : {"st_cal", "st_cntlock", "st_cntrev", "st_cntlockm", "st_cntrevm", "st_regoff",
                           "st_warning", "st_emrg"})
    EXPECT_EQ(get(name), 0) << name;
  EXPECT_EQ(get("st_init"), 1);
  EXPECT_EQ(get("st_loopon"), 1);
  EXPECT_THAT(diagnostics(), IsEmpty());
  covers({"INIT accepted", "LOOPON accepted", "st_init", "st_loopon"});
}

TEST_F(Camming4Motion, JogsWithOneVoltAtATenthOfMaxvel) {
  start();
  write("setvel", 5000);
  command("MANFW");
  EXPECT_EQ(get("st_still"), 0);
  EXPECT_EQ(get("st_acc"), 1);
  ticks(60);  // the ramp takes 0.1 s
  EXPECT_EQ(get("st_vconst"), 1);
  EXPECT_EQ(get("ffwdreg"), 3277);
  EXPECT_NEAR(word(), 3277, 0.02 * 3277);
  EXPECT_EQ(get("vout"), 10);
  EXPECT_EQ(get("st_movdir"), 0);
  command("STOP");
  EXPECT_EQ(get("st_dec"), 1);
  EXPECT_TRUE(wait("st_still", 1, 60));
  ticks(100);
  EXPECT_LE(get("follerr"), 1);
  command("MANBW");
  ticks(60);
  EXPECT_EQ(get("ffwdreg"), -3277);
  EXPECT_EQ(get("st_movdir"), 1);
  command("STOP");
  ASSERT_TRUE(wait("st_still", 1));
  ticks(5);
  EXPECT_EQ(get("st_movdir"), 1);  // of the last movement
  covers({"MANFW accepted", "MANBW accepted", "STOP accepted", "st_acc", "st_vconst", "st_dec", "st_movdir",
          "ffwdreg"});
}

TEST_F(Camming4Motion, PlacesTheAxisExactly) {
  start();
  for (const int target : {1000, -2000, -1999, 0}) {
    write("setpos", target);
    command("START");
    EXPECT_EQ(get("st_toll"), 0);
    ASSERT_TRUE(wait("st_still", 1));
    ticks(200);
    EXPECT_NEAR(get("posit"), target, 1);
    EXPECT_EQ(get("st_toll"), 1);
    EXPECT_EQ(get("st_tpos"), 1);
  }
  covers({"START accepted", "setpos", "st_toll", "st_tpos"});
}

TEST_F(Camming4Motion, APlacementTakesItsClosedFormTime) {
  start();
  // 5000 Um/s, a = d = 50000 Um/s2: 0.1 s each ramp, 500 Um in ramps, 500 Um at speed.
  write("setpos", 1000);
  order("START");
  const long before = samples;
  tick();
  ASSERT_TRUE(wait("st_still", 1));
  EXPECT_EQ(samples - before, 150);  // 0.3 s
}

TEST_F(Camming4Motion, TheToleranceOfAQuotaNeedsAPlacement) {
  start();
  write("setpos", 0);
  sample();
  EXPECT_EQ(get("st_tpos"), 1);
  EXPECT_EQ(get("st_toll"), 0);
  write("setpos", 3);
  sample();
  EXPECT_EQ(get("st_tpos"), 0);
  write("setpos", 2);
  sample();
  EXPECT_EQ(get("st_tpos"), 1);
}

TEST_F(Camming4Motion, AStoppedPlacementIsNotInTolerance) {
  start();
  write("setpos", 1000);
  command("START");
  ticks(80);
  command("STOP");
  ASSERT_TRUE(wait("st_still", 1));
  ticks(50);
  EXPECT_EQ(get("st_toll"), 0);
  EXPECT_LT(get("posit"), 999);
}

TEST_F(Camming4Motion, HoldsTheSoftwareLimits) {
  set({{"minpos", -300}, {"maxpos", 500}});
  start();
  write("setpos", 900);
  sample();
  diagnostics();
  command("START");
  EXPECT_THAT(diagnostics(),
              ElementsAre("START: setpos 900 is outside minpos..maxpos, the axis goes to 500"));
  ASSERT_TRUE(wait("st_still", 1));
  ticks(200);
  EXPECT_NEAR(get("posit"), 500, 1);
  write("posit", 500);
  command("MANFW");
  EXPECT_EQ(get("st_still"), 1);
  EXPECT_THAT(diagnostics(), ElementsAre("MANFW: posit 500 is already at maxpos 500"));
  command("MANBW");
  ASSERT_TRUE(wait("st_still", 1));
  ticks(200);
  EXPECT_NEAR(get("posit"), -300, 1);
  covers({"minpos", "maxpos"});
}

TEST_F(Camming4Motion, ChangesSpeedAndTargetOnTheFly) {
  start();
  write("setpos", 5000);
  command("START");
  ticks(60);
  EXPECT_EQ(get("st_chvel"), 1);
  set({{"setvel", 2500}, {"setpos", 4000}});
  ticks(60);
  EXPECT_EQ(get("ffwdreg"), 1638);
  ASSERT_TRUE(wait("st_dec", 1));
  EXPECT_EQ(get("st_chvel"), 0);
  ASSERT_TRUE(wait("st_still", 1));
  ticks(200);
  EXPECT_NEAR(get("posit"), 4000, 1);
  EXPECT_EQ(get("st_toll"), 1);
  covers({"st_chvel", "setvel", "setpos"});
}

TEST_F(Camming4Motion, ATargetBehindIsStoredOnly) {
  start();
  write("setpos", 2000);
  command("START");
  ticks(100);
  write("setpos", 100);
  ASSERT_TRUE(wait("st_still", 1));
  ticks(200);
  EXPECT_NEAR(get("posit"), 2000, 1);
  EXPECT_EQ(get("setpos"), 100);
  EXPECT_EQ(get("st_toll"), 1);
  EXPECT_EQ(get("st_tpos"), 0);
}

TEST_F(Camming4Motion, WhatTheRunningMovementCannotTakeIsSaid) {
  start();
  write("setpos", 3000);
  command("START");
  ticks(150);
  diagnostics();
  write("setpos", 100);
  tick();
  EXPECT_THAT(diagnostics(),
              ElementsAre("setpos: kept for the next movement, the running one cannot take it any more"));
  write("setpos", 4000);
  tick();
  EXPECT_THAT(diagnostics(), IsEmpty());
  ASSERT_TRUE(wait("st_dec", 1));
  set({{"setvel", 900}, {"tdec", 50}});
  tick();
  EXPECT_THAT(diagnostics(),
              ElementsAre("setvel: kept for the next movement, the running one cannot take it any more",
                          "tdec: kept for the next movement, the running one cannot take it any more"));
  EXPECT_EQ(get("setvel"), 900);
  ASSERT_TRUE(wait("st_still", 1));
  write("setpos", 9000);
  command("START");
  ticks(100);
  diagnostics();
  write("posit", 20000);  // beyond the quota
  tick();
  EXPECT_THAT(diagnostics(),
              ElementsAre("posit: the running movement cannot reach its quota any more and stops"));
}

TEST_F(Camming4Motion, AnOpenLoopStartsWhereTheAxisStands) {
  // 000 1.1.11: moved by hand, posit 0, minpos 0, maxpos the stroke, START without the position loop.
  command("INIT");
  slave().count += 300;
  ticks(2);
  set({{"posit", 0}, {"minpos", 0}, {"maxpos", 1000}, {"setpos", 1000}});
  command("START");
  ASSERT_TRUE(wait("st_still", 1));
  EXPECT_NEAR(get("posit"), 1000, 2);
  slave().count -= 700;
  ticks(2);
  command("MANFW");
  ASSERT_TRUE(wait("st_still", 1));
  EXPECT_NEAR(get("posit"), 1000, 2);
  slave().count -= 700;
  ticks(2);
  row(1, {154, 1000, 1000});
  row(2, {137, 1});
  tick();
  command("STARTCAM");
  EXPECT_EQ(get("follerr"), 0);
  EXPECT_EQ(get("st_sync"), 1);
  EXPECT_NEAR(get("posit"), 300, 2);
}

TEST_F(Camming4Motion, MovesForEverWhenPositIsWrittenBack) {
  write("maxpos", 2000);
  start();
  command("MANFW");
  ticks(60);
  for (int i = 0; i < 20; ++i) {
    ticks(50);
    write("posit", 0);
    tick();
    EXPECT_EQ(get("ffwdreg"), 3277);
  }
  EXPECT_GT(slave().count, 10000);
  ASSERT_TRUE(wait("st_still", 1));
  ticks(200);
  EXPECT_NEAR(get("posit"), 2000, 1);
}

TEST_F(Camming4Motion, EpicycloidalRampsPlaceInTheSameTime) {
  write("ramptype", 1);
  start();
  write("setpos", 1000);
  order("START");
  const long before = samples;
  tick();
  ASSERT_TRUE(wait("st_still", 1));
  EXPECT_EQ(samples - before, 150);
  ticks(200);
  EXPECT_NEAR(get("posit"), 1000, 1);
}

TEST_F(Camming4Motion, RefusesWhatItsConditionsForbid) {
  start();
  struct Case {
    const char* command;
    const char* reason;
  };
  for (const auto& [name, reason] :
       {Case{"STOP", "STOP: st_still is 1, must be 0"}, Case{"STOPCAM", "STOPCAM: st_camex is 0, must be 1"},
        Case{"INIT", "INIT: st_init is 1, must be 0"}, Case{"INTDSBL", "INTDSBL: needs intcapt > 0"}}) {
    command("RSWRN");
    diagnostics();
    command(name);
    EXPECT_THAT(diagnostics(), Contains(reason));
    EXPECT_EQ(get("wrncode"), 11) << name;
  }
  command("MANFW");
  ticks(10);
  diagnostics();
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
    tick();
    EXPECT_EQ(get(name), before) << name;
  }
}

TEST_F(Camming4Motion, ReportsRangesThatDependOnOtherParameters) {
  set({{"maxpos", 100}, {"minpos", -100}});
  diagnostics();
  set({{"setvel", 50001}, {"setpos", 101}, {"sprsvel", 5001}, {"setvel", 50000}, {"prspos", -100}});
  EXPECT_THAT(diagnostics(), ElementsAre("setvel: 50001 is outside 0..50000 (maxvel), taken anyway",
                                         "setpos: 101 is outside -100..100 (maxpos), taken anyway",
                                         "sprsvel: 5001 is outside 0..5000 (prsvel), taken anyway"));
  EXPECT_EQ(get("setpos"), 101);
}

TEST_F(Camming4Motion, ReportsAResolutionOutOfRange) {
  set({{"measure", 2}, {"pulse", 1}, {"measurem", 934}, {"pulsem", 999999}});
  command("INIT");
  EXPECT_THAT(diagnostics(), ElementsAre("measure: 2 * 4 / 1 is outside 0.00374..4, taken anyway"));
}

TEST_F(Camming4Motion, SaysWhatUnsetParametersActAs) {
  set({{"measure", 0}, {"pulse", 0}, {"measurem", -3}, {"pulsem", 0}, {"maxvel", 0}, {"setpos", 10}});
  diagnostics();
  command("INIT");
  EXPECT_THAT(diagnostics(), ElementsAre("measure: 0 acts as 1", "pulse: 0 acts as 1",
                                         "measurem: -3 acts as 1", "pulsem: 0 acts as 1"));
  row(1, {154, 1000, 1000});
  for (const char* name : {"START", "MANFW", "PRESET", "STARTCAM"}) {
    command(name);
    EXPECT_THAT(diagnostics(),
                Contains("maxvel: 0 is no speed: ramps take no time, and the output is offset alone"))
        << name;
    command("EMRG");
    command("RESUME");
  }
  set({{"measure", 5}, {"pulse", 2147483647}});
  tick();
  EXPECT_THAT(diagnostics(), ElementsAre("pulse: 2147483647 is outside 1..999999, taken anyway",
                                         "pulse: 2147483647 acts as 1073741824"));
}

TEST_F(Camming4Motion, PowerLossKeepsPositionsAndParameters) {
  start();
  write("posit", 1234);
  sample();
  command("MANFW");
  ticks(20);
  const int posit = get("posit");
  device.power_up();
  EXPECT_EQ(word(), 0);
  EXPECT_EQ(get("st_init"), 0);
  EXPECT_EQ(get("st_still"), 1);
  command("INIT");
  EXPECT_EQ(get("posit"), posit);
  EXPECT_EQ(get("maxvel"), 50000);
  ticks(10);
  EXPECT_EQ(word(), 0);
}

TEST_F(Camming4Motion, HostileParametersAreHarmless) {
  for (const Variable& variable : device.type().variables)
    for (const std::int32_t value : {0, -1, 2147483647, -2147483647 - 1}) {
      write(std::string(variable.name) + (variable.rows > 1 ? "1" : ""), value);
      order("INIT");
      tick(1000000);
      for (const char* name : {"LOOPON", "START", "MANFW", "STARTCAM", "PRESET", "STOP", "RSERR", "RESUME"}) {
        order(name);
        tick(-1000000);
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
  set({{"measurem", 1}, {"pulsem", 2}});
  command("INIT");
  slave().count = 10;
  sample();
  EXPECT_EQ(get("posit"), 10);
  EXPECT_EQ(get("positm"), 5);
}

}  // namespace
}  // namespace drycut::devices::camming4
