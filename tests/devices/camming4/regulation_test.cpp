#include <gmock/gmock.h>

#include "tests/devices/camming4/covers.hpp"
#include "tests/devices/camming4/fixture.hpp"

namespace drycut::devices::camming4 {
namespace {

using testing::ElementsAre;

using Camming4Regulation = Camming4Test;

TEST_F(Camming4Regulation, OpenLoopMovesOnFeedForwardOnly) {
  command("INIT");
  write("setpos", 1000);
  command("START");
  ASSERT_TRUE(wait("st_still", 1));
  EXPECT_EQ(get("propreg"), 0);
  EXPECT_EQ(word(), 0);
  EXPECT_NEAR(get("posit"), 1000, 30);
  command("LOOPON");
  EXPECT_EQ(get("follerr"), 0);
}

TEST_F(Camming4Regulation, EmergencyStopsWithoutRampAndResumeReactsOnTheSpot) {
  start();
  command("MANFW");
  ticks(60);
  command("EMRG");
  EXPECT_EQ(word(), 0);
  EXPECT_EQ(get("st_emrg"), 1);
  EXPECT_EQ(get("st_still"), 1);
  EXPECT_EQ(get("st_loopon"), 1);
  slave().count += 777;
  sample();
  EXPECT_EQ(word(), 0);
  for (const char* name : {"START", "MANFW", "STARTCAM", "PRESET"}) command(name);
  EXPECT_EQ(get("st_still"), 1);
  EXPECT_EQ(get("wrncode"), 11);
  command("RESUME");
  EXPECT_EQ(get("st_emrg"), 0);
  EXPECT_EQ(get("follerr"), 0);
  EXPECT_EQ(word(), 0);
  slave().count += 10;
  sample();
  EXPECT_EQ(get("propreg"), -655);  // pgain 200: 0.2 * 10/100 of 32767
  covers({"EMRG accepted", "RESUME accepted", "st_emrg"});
}

TEST_F(Camming4Regulation, CalibrationIsAVoltageSource) {
  start();
  write("offset", 7);
  write("vout", 50);
  sample();
  EXPECT_THAT(diagnostics(), ElementsAre("vout: st_cal is 0, must be 1"));
  command("CALON");
  EXPECT_EQ(word(), 7);
  write("vout", -25);
  sample();
  EXPECT_EQ(word(), -8192 + 7);
  EXPECT_EQ(get("vout"), -25);
  slave().count -= 4000;
  sample();
  command("CALOFF");
  EXPECT_EQ(get("follerr"), 0);
  EXPECT_EQ(word(), 7);
  covers({"CALON accepted", "CALOFF accepted", "st_cal", "vout", "offset"});
}

TEST_F(Camming4Regulation, RegulationOffFreezesTheOutput) {
  start();
  slave_blocked = true;
  slave().count = -20;
  sample();
  const int before = word();
  EXPECT_EQ(before, 1311);  // 0.2 * 20/100 of 32767
  command("REGOFF");
  slave().count = 300;
  sample();
  EXPECT_EQ(word(), before);
  EXPECT_EQ(get("posit"), 300);
  command("START");
  EXPECT_EQ(get("wrncode"), 11);
  command("REGON");
  EXPECT_EQ(word(), 0);
  covers({"REGOFF accepted", "REGON accepted", "st_regoff"});
}

TEST_F(Camming4Regulation, RegulatesByItsClosedForms) {
  set({{"pgain", 1000}, {"feedfw", 0}});
  start();
  slave_blocked = true;
  slave().count = -100;  // the way of one period at maxvel
  sample();
  EXPECT_EQ(word(), 32767);
  EXPECT_EQ(get("propreg"), 32767);
  EXPECT_EQ(get("follerr"), 100);
  EXPECT_EQ(get("st_warning"), 0);
  slave().count = 50;
  set({{"offset", -100}});
  sample();
  EXPECT_EQ(word(), -16384 - 100);
  covers({"pgain", "propreg", "follerr"});
}

TEST_F(Camming4Regulation, SaturationIsAWarning) {
  write("pgain", 1000);
  start();
  slave_blocked = true;
  slave().count = -101;
  sample();
  EXPECT_EQ(word(), 32767);
  EXPECT_EQ(get("wrncode"), 3);
  slave().count = 101;
  sample();
  EXPECT_EQ(word(), -32767);
  EXPECT_EQ(get("wrncode"), 3);  // 4 is of lower priority
  command("RSWRN");
  EXPECT_EQ(get("wrncode"), 4);  // and comes back at once
}

TEST_F(Camming4Regulation, FollowingErrorIsHeldForHalfASecond) {
  write("maxfollerr", 40);
  start();
  slave_blocked = true;
  slave().count = 41;
  sample();
  EXPECT_EQ(get("st_foller"), 1);
  slave().count = 40;
  for (int ms = period; ms < 500; ms += period) {
    sample();
    ASSERT_EQ(get("st_foller"), 1) << ms;
  }
  sample();
  EXPECT_EQ(get("st_foller"), 0);
}

TEST_F(Camming4Regulation, MeasuresFrequencyAndSpeed) {
  set({{"tbf", 2}, {"tbfm", 2}});
  command("INIT");
  for (int i = 0; i < 12; ++i) {
    slave().count -= 8;
    tick(20);
  }
  EXPECT_EQ(get("frq"), 1000);
  EXPECT_EQ(get("vel"), 4000);
  EXPECT_EQ(get("frqm"), 2500);
}

TEST_F(Camming4Regulation, LocksAndReversesItsCounts) {
  command("INIT");
  command("CNTREV");
  slave().count += 10;
  sample();
  EXPECT_EQ(get("posit"), -10);
  command("CNTLOCK");
  slave().count += 10;
  sample();
  EXPECT_EQ(get("posit"), -10);
  command("CNTUNLOCK");
  command("CNTDIR");
  slave().count += 3;
  tick(4);
  EXPECT_EQ(get("posit"), -7);
  command("CNTREVM");
  tick(1);
  EXPECT_EQ(get("positm"), 3);
  command("CNTLOCKM");
  tick(100);
  EXPECT_EQ(get("encoderm"), 3);
}

TEST_F(Camming4Regulation, DelCntKeepsTheRemainder) {
  set({{"measure", 1}, {"pulse", 10}});
  command("INIT");
  slave().count = 23;
  sample();
  EXPECT_EQ(get("posit"), 2);
  write("delta1", 2);
  command("DELCNT");
  slave().count += 7;
  sample();
  EXPECT_EQ(get("posit"), 5);  // 4.3 + 0.7
  slave().count += 3;
  sample();
  write("posit", 5);
  sample();
  slave().count += 9;
  sample();
  EXPECT_EQ(get("posit"), 5);
  covers({"DELCNT accepted", "delta1"});
}

TEST_F(Camming4Regulation, TwoDelCntBetweenSamplesAreOne) {
  command("INIT");
  set({{"posit", 1000}, {"delta1", -100}});
  order("DELCNT");
  order("DELCNT");
  sample();
  EXPECT_EQ(get("posit"), 900);
  command("DELCNT");
  EXPECT_EQ(get("posit"), 800);
}

TEST_F(Camming4Regulation, ConvertsByTheRatioOfMeasureAndPulse) {
  set({{"measure", 220}, {"pulse", 4096}});
  command("INIT");
  slave().count = 62296;
  sample();
  EXPECT_EQ(get("posit"), 3345);
  write("encoder", -4096);
  sample();
  EXPECT_EQ(get("posit"), -220);
}

TEST_F(Camming4Regulation, ChangesTheMasterWithoutAJump) {
  command("INIT");
  master().count = 100;
  master_b().count = 5000;
  sample();
  write("mtype", 1);
  sample();
  EXPECT_EQ(get("positm"), 100);
  master().count = 300;
  master_b().count = 5007;
  sample();
  EXPECT_EQ(get("positm"), 107);
  write("mtype", 0);
  sample();
  master().count = 301;
  sample();
  EXPECT_EQ(get("positm"), 108);
  covers({"mtype"});
}

}  // namespace
}  // namespace drycut::devices::camming4
