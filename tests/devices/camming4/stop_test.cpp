#include <gmock/gmock.h>

#include "tests/devices/camming4/covers.hpp"
#include "tests/devices/camming4/fixture.hpp"

namespace drycut::devices::camming4 {
namespace {

using testing::Contains;

/// Leaving a cam and being disturbed in it. Without gains and with the slave blocked the following error is
/// the theoretical way.
class Camming4Stop : public Camming4Test {
 protected:
  void blocked() {
    set({{"pgain", 0}, {"feedfw", 0}});
    slave_blocked = true;
  }
  void constant_ratio(int master, int slave) {
    row(1, {154, master, slave});
    row(2, {137, 1});
  }
  /// Way of the ramp after STOPCAM [bits].
  int stopping_way() {
    const int before = get("follerr");
    command("STOPCAM");
    EXPECT_TRUE(wait("st_still", 1, 3000));
    return get("follerr") - before;
  }
};

TEST_F(Camming4Stop, TheRampBeginsWithTheSpeedOfTheLaw) {
  // v2/2d from 5000 Um/s and 50000 Um/s2, less half the way of the first period.
  blocked();
  constant_ratio(1000, 1000);
  start();
  command("STARTCAM");
  ticks(100, 10);
  EXPECT_NEAR(stopping_way(), 250, 5);
  covers({"STOPCAM accepted", "st_still"});
}

TEST_F(Camming4Stop, ASlowMastersCountsAreNoSteps) {
  // One count of the master in three samples, 60 Um of slave each: 10000 Um/s on average, 0 or 30000 in a
  // sample. The ramp must begin near the average whichever sample STOPCAM meets.
  for (int phase = 0; phase < 3; ++phase) {
    SCOPED_TRACE(phase);
    device.power_up();
    blocked();
    constant_ratio(10000, 600000);
    start();
    command("STARTCAM");
    for (int i = 0; i < 300 + phase; ++i) tick(i % 3 == 0 ? 1 : 0);
    EXPECT_NEAR(stopping_way(), 1000, 300);  // 10000^2 / (2*50000), or 11250: 6 of 16 samples
  }
}

TEST_F(Camming4Stop, AMasterThatStandsStillStopsTheSlaveWithoutARamp) {
  blocked();
  constant_ratio(1000, 1000);
  start();
  command("STARTCAM");
  ticks(100, 10);
  ticks(3);  // the master has stopped dead
  EXPECT_EQ(stopping_way(), 0);
}

TEST_F(Camming4Stop, ARampInTheMiddleOfASectorBeginsWithItsSpeed) {
  blocked();
  row(1, {131, 1000, 1000});  // 0 to twice the master's speed
  row(2, {137, 2});
  start();
  command("STARTCAM");
  ticks(50, 10);  // at its middle: as fast as the master, 5000 Um/s
  EXPECT_NEAR(stopping_way(), 250, 8);
}

TEST_F(Camming4Stop, TheWayBackwardStopsBackward) {
  constant_ratio(1000, -1000);
  set({{"pgain", 1000}});
  start();
  command("STARTCAM");
  ticks(100, 10);
  const int posit = get("posit");
  command("STOPCAM");
  EXPECT_EQ(get("st_movdir"), 1);
  ASSERT_TRUE(wait("st_still", 1));
  ticks(200);
  EXPECT_NEAR(get("posit") - posit, -250, 15);
  covers({"st_movdir"});
}

TEST_F(Camming4Stop, LoopOnInACamGoesOnFromWhereTheAxisIs) {
  constant_ratio(1000, 1000);
  start();
  command("STARTCAM");
  ticks(100, 10);
  command("LOOPOFF");
  slave_blocked = true;  // a hand holds the axis for 30 samples
  ticks(30, 10);
  slave_blocked = false;
  ticks(20, 10);
  EXPECT_NEAR(get("follerr"), 310, 15);
  EXPECT_EQ(get("propreg"), 0);
  const int behind = get("positm") - get("posit");
  order("LOOPON");
  tick(10);
  EXPECT_EQ(get("follerr"), 0);
  EXPECT_EQ(get("ffwdreg"), 3277);  // no spike
  EXPECT_EQ(get("st_camex"), 1);
  EXPECT_EQ(get("st_sync"), 1);
  ticks(500, 10);
  EXPECT_LE(get("follerr"), 1);
  EXPECT_NEAR(get("positm") - get("posit"), behind, 2);  // it stays so far behind
  EXPECT_EQ(get("st_warning"), 1);                       // out of syncrange while it was held
  EXPECT_EQ(get("wrncode"), 12);
  covers({"LOOPON accepted", "LOOPOFF accepted", "st_sync", "warning 12"});
}

TEST_F(Camming4Stop, CountUpdatesAfterALoopOnMeetTheAxisWhereItIs) {
  row(1, {154, 1000, 1000});
  row(2, {141, 0, 500});
  row(3, {137, 1});
  set({{"pgain", 0}, {"feedfw", 0}});
  slave_blocked = true;
  command("INIT");
  command("STARTCAM");
  ticks(30, 10);
  slave().count = 250;  // 50 behind
  command("LOOPON");
  EXPECT_EQ(get("follerr"), 0);
  slave().count = 950;
  ticks(75, 10);  // at 1050: 50 beyond the boundary
  EXPECT_EQ(get("rowex"), 1);
  // When the table's boundary was reached the axis had to be at 950: that is 500 now.
  EXPECT_EQ(get("posit"), 500);
  EXPECT_EQ(get("follerr"), 50);
  covers({"sector 141"});
}

TEST_F(Camming4Stop, AnotherStartForgetsTheSlip) {
  constant_ratio(1000, 1000);
  command("INIT");
  slave_blocked = true;
  command("STARTCAM");
  ticks(30, 10);
  command("LOOPON");
  command("STOPCAM");
  ASSERT_TRUE(wait("st_still", 1));
  command("EMRG");
  command("RESUME");
  command("STARTCAM");
  EXPECT_EQ(get("follerr"), 0);
  ticks(20, 10);
  EXPECT_EQ(get("follerr"), 200);
}

TEST_F(Camming4Stop, ARecoveryThatTheEndCutsOffIsReported) {
  row(1, {154, 100, 100});
  row(2, {180, 0, 4000});
  row(3, {154, 100, 100});
  row(4, {136});
  set({{"setvel", 1000}});
  start();
  command("STARTCAM");
  ticks(60, 5);
  EXPECT_EQ(get("st_camex"), 0);
  EXPECT_THAT(diagnostics(), Contains("st_camex: the cam ended before the recovery of sector 180 was done"));
  covers({"sector 180"});
}

TEST_F(Camming4Stop, ARecoveryStopsWithTheCam) {
  blocked();
  row(1, {154, 100, 100});
  row(2, {180, 0, 40000});
  row(3, {154, 1000, 1000});
  row(4, {136});
  start();
  command("STARTCAM");
  ticks(51, 2);
  ticks(200);  // the master stands, the recovery runs at setvel
  EXPECT_NEAR(stopping_way(), 250, 15);
}

TEST_F(Camming4Stop, CountUpdatesAfterARecoveryMeetTheAxisWhereItIs) {
  blocked();
  row(1, {154, 100, 100});
  row(2, {180, 0, 40});
  row(3, {154, 1000, 1000});
  row(4, {141, 0, 500});
  row(5, {154, 1000, 1000});
  row(6, {136});
  start();
  command("STARTCAM");
  ticks(540, 2);
  EXPECT_EQ(get("follerr"), 1080 + 40);
  slave().count = 1120;
  sample();
  ticks(20, 2);
  EXPECT_EQ(get("rowex"), 5);
  // At the boundary of 1100 the axis had to be at 1140: that is 500 now.
  EXPECT_EQ(get("posit"), 500 - 20);
}

TEST_F(Camming4Stop, ACamThatBeginsOutOfTheSyncRangeHasNotLeftIt) {
  constant_ratio(1000, 1000);
  set({{"pgain", 0}});
  start();
  slave_blocked = true;
  slave().count = 60;
  sample();
  command("STARTCAM");
  ticks(3, 1);
  EXPECT_EQ(get("st_sync"), 0);
  EXPECT_EQ(get("st_warning"), 0);
  slave().count = 10;
  tick();
  EXPECT_EQ(get("st_sync"), 1);
  slave().count = 60;
  tick();
  EXPECT_EQ(get("wrncode"), 12);
  covers({"st_sync", "warning 12"});
}

TEST_F(Camming4Stop, PowerLossInARecoveryLeavesNothingOfIt) {
  row(1, {154, 100, 100});
  row(2, {180, 0, 400});
  row(3, {154, 1000, 1000});
  row(4, {136});
  set({{"setvel", 1000}});
  blocked();
  start();
  command("STARTCAM");
  ticks(60, 5);
  device.power_up();
  start();
  row(2, {130});
  command("STARTCAM");
  ticks(100, 5);
  EXPECT_EQ(get("follerr"), 500);
}

TEST_F(Camming4Stop, EmergencyInACamNeedsAResumeAndANewStart) {
  constant_ratio(1000, 1000);
  start();
  command("STARTCAM");
  ticks(50, 10);
  command("EMRG");
  EXPECT_EQ(word(), 0);
  EXPECT_EQ(get("st_camex"), 0);
  EXPECT_EQ(get("rowex"), 0);
  EXPECT_EQ(get("st_loopon"), 1);
  ticks(5, 10);
  EXPECT_EQ(word(), 0);
  command("RESUME");
  ticks(20, 10);
  EXPECT_EQ(get("st_camex"), 0);
  EXPECT_LE(get("follerr"), 1);
  command("STARTCAM");
  EXPECT_EQ(get("rowex"), 1);
  covers({"EMRG accepted", "RESUME accepted", "st_emrg", "STARTCAM accepted", "st_camex", "rowex"});
}

TEST_F(Camming4Stop, TheOutputOfThisSampleHoldsUntilTheNext) {
  constant_ratio(1000, 1000);
  start();
  command("STARTCAM");
  ticks(50, 10);
  const int held = word();
  master().count += 1000;
  slave().count -= 500;
  EXPECT_EQ(word(), held);
  sample();
  EXPECT_NE(word(), held);
}

}  // namespace
}  // namespace drycut::devices::camming4
