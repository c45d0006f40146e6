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
  void constant_ratio(int master, int slave) { rows({{154, master, slave}, {137, 1}}); }
  /// Way of the ramp after STOPCAM [bits].
  int stopping_way() {
    const int before = get("follerr");
    does("STOPCAM until:still:3000");
    return get("follerr") - before;
  }
};

TEST_F(Camming4Stop, TheRampBeginsWithTheSpeedOfTheLaw) {
  // v2/2d from 5000 Um/s and 50000 Um/s2, less half the way of the first period.
  without_gains();
  constant_ratio(1000, 1000);
  does("INIT LOOPON STARTCAM +100*10");
  EXPECT_NEAR(stopping_way(), 250, 5);
  covers({"STOPCAM accepted", "st_still"});
}

// 000 1.9.2 ramptype: of placements; what belongs to a cam is trapezoidal.
TEST_F(Camming4Stop, TheRampIsStraightWhateverRamptypeSays) {
  constant_ratio(1000, 1000);
  does("pgain=0 ramptype=1 rtype=0 INIT LOOPON STARTCAM +100*10");  // 5000 Um/s
  after("STOPCAM +11", "speed=3800~30");                            // 100 Um/s less in each period
  after("+26", "speed=1200~30");
  about("ramptype");
}

TEST_F(Camming4Stop, ARecoveryIsATrapezoidWhateverRamptypeSays) {
  rows({{154, 10, 0}, {180, 0, 3000}, {154, 10000, 0}, {136}});
  does("pgain=0 ramptype=1 rtype=0 INIT LOOPON STARTCAM +5*5 +10");
  const double before = speed();
  after("+10", "rowex=3");
  EXPECT_NEAR(speed() - before, 1000, 10);  // 100 Um/s more in each period
}

TEST_F(Camming4Stop, ASlowMastersCountsAreNoSteps) {
  // One count of the master in three samples, 60 Um of slave each: 10000 Um/s on average, 0 or 30000 in a
  // sample. The ramp must begin near the average whichever sample STOPCAM meets.
  for (int phase = 0; phase < 3; ++phase) {
    SCOPED_TRACE(phase);
    does("power");
    without_gains();
    constant_ratio(10000, 600000);
    does("INIT LOOPON STARTCAM");
    for (int i = 0; i < 300 + phase; ++i) tick(i % 3 == 0 ? 1 : 0);
    EXPECT_NEAR(stopping_way(), 1000, 300);  // 10000^2 / (2*50000), or 11250: 6 of 16 samples
  }
}

TEST_F(Camming4Stop, AMasterThatStandsStillStopsTheSlaveWithoutARamp) {
  without_gains();
  constant_ratio(1000, 1000);
  does("INIT LOOPON STARTCAM +100*10 +3");  // the master has stopped dead
  EXPECT_EQ(stopping_way(), 0);
}

TEST_F(Camming4Stop, ARampInTheMiddleOfASectorBeginsWithItsSpeed) {
  without_gains();
  row(1, {131, 1000, 1000});  // 0 to twice the master's speed
  row(2, {137, 2});
  does("INIT LOOPON STARTCAM +50*10");  // at its middle: as fast as the master, 5000 Um/s
  EXPECT_NEAR(stopping_way(), 250, 8);
}

TEST_F(Camming4Stop, TheWayBackwardStopsBackward) {
  constant_ratio(1000, -1000);
  does("pgain=1000 INIT LOOPON STARTCAM +100*10");
  const int posit = get("posit");
  after("STOPCAM", "movdir");
  does("until:still +200");
  EXPECT_NEAR(get("posit") - posit, -250, 15);
}

TEST_F(Camming4Stop, LoopOnInACamGoesOnFromWhereTheAxisIs) {
  constant_ratio(1000, 1000);
  does("INIT LOOPON STARTCAM +100*10 LOOPOFF blocked=1");  // a hand holds the axis for 30 samples
  after("+30*10 blocked=0 +20*10", "follerr=310~15 propreg=0");
  const int behind = get("positm") - get("posit");
  after("LOOPON! +1*10", "follerr=0 ffwdreg=3277");  // no spike
  shows("camex sync");
  after("+500*10", "follerr<2");
  EXPECT_NEAR(get("positm") - get("posit"), behind, 2);  // it stays so far behind
  shows("warning");                                      // out of syncrange while it was held
  shows("wrncode=12");
  covers({"LOOPON accepted", "LOOPOFF accepted", "warning 12"});
}

TEST_F(Camming4Stop, CountUpdatesAfterALoopOnMeetTheAxisWhereItIs) {
  rows({{154, 1000, 1000}, {141, 0, 500}, {137, 1}});
  does("pgain=0 feedfw=0 blocked=1 INIT STARTCAM +30*10 count=250");  // 50 behind
  after("LOOPON", "follerr=0");
  does("count=950 +75*10");  // at 1050: 50 beyond the boundary
  shows("rowex=1");
  // When the table's boundary was reached the axis had to be at 950: that is 500 now.
  shows("posit=500 follerr=50");
  covers({"sector 141"});
}

TEST_F(Camming4Stop, AnotherStartForgetsTheSlip) {
  constant_ratio(1000, 1000);
  after("INIT blocked=1 STARTCAM +30*10 LOOPON STOPCAM until:still EMRG RESUME STARTCAM", "follerr=0");
  after("+20*10", "follerr=200");
}

TEST_F(Camming4Stop, ARecoveryThatTheEndCutsOffIsReported) {
  rows({{154, 100, 100}, {180, 0, 4000}, {154, 100, 100}, {136}});
  after("setvel=1000 INIT LOOPON STARTCAM +60*5", "!camex");
  EXPECT_THAT(diagnostics(), Contains("st_camex: the cam ended before the recovery of sector 180 was done"));
  covers({"sector 180"});
}

TEST_F(Camming4Stop, ARecoveryStopsWithTheCam) {
  without_gains();
  rows({{154, 100, 100}, {180, 0, 40000}, {154, 1000, 1000}, {136}});
  does("INIT LOOPON STARTCAM +51*2 +200");  // the master stands, the recovery runs at setvel
  EXPECT_NEAR(stopping_way(), 250, 15);
}

TEST_F(Camming4Stop, CountUpdatesAfterARecoveryMeetTheAxisWhereItIs) {
  without_gains();
  rows({{154, 100, 100}, {180, 0, 40}, {154, 1000, 1000}, {141, 0, 500}, {154, 1000, 1000}, {136}});
  does("INIT LOOPON STARTCAM +540*2");
  EXPECT_EQ(get("follerr"), 1080 + 40);
  after("count=1120 sample +20*2", "rowex=5");
  // At the boundary of 1100 the axis had to be at 1140: that is 500 now.
  EXPECT_EQ(get("posit"), 500 - 20);
}

TEST_F(Camming4Stop, ACamThatBeginsOutOfTheSyncRangeHasNotLeftIt) {
  constant_ratio(1000, 1000);
  after("pgain=0 INIT LOOPON blocked=1 count=60 sample STARTCAM +3*1", "!sync !warning");
  after("count=10 +1", "sync");
  after("count=60 +1", "wrncode=12");
  covers({"warning 12"});
}

TEST_F(Camming4Stop, TheSyncRangeIsLeftByTheBitsOfFollerr) {
  without_gains();
  constant_ratio(1000, 100);
  does("syncrange=10 INIT LOOPON STARTCAM +2*1");
  while (get("st_sync") == 1 && samples < 1000) tick(1);  // 0.1 bit more in each
  shows("camex !sync wrncode=12 follerr=11");
}

TEST_F(Camming4Stop, PowerLossInARecoveryLeavesNothingOfIt) {
  rows({{154, 100, 100}, {180, 0, 400}, {154, 1000, 1000}, {136}});
  does("setvel=1000");
  without_gains();
  does("INIT LOOPON STARTCAM +60*5 power INIT LOOPON");
  row(2, {130});
  after("STARTCAM +100*5", "follerr=500");
}

TEST_F(Camming4Stop, EmergencyInACamNeedsAResumeAndANewStart) {
  constant_ratio(1000, 1000);
  after("INIT LOOPON STARTCAM +50*10 EMRG", "DAC=0 !camex rowex=0 loopon");
  after("+5*10", "DAC=0");
  after("RESUME +20*10", "!camex follerr<2");
  after("STARTCAM", "rowex=1");
  covers({"st_emrg"});
}

TEST_F(Camming4Stop, TheOutputOfThisSampleHoldsUntilTheNext) {
  constant_ratio(1000, 1000);
  does("INIT LOOPON STARTCAM +50*10");
  const int held = word();
  does("master+=1000 count+=-500");
  EXPECT_EQ(word(), held);
  does("sample");
  EXPECT_NE(word(), held);
}

}  // namespace
}  // namespace drycut::devices::camming4
