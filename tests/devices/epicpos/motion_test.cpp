#include <gmock/gmock.h>

#include <algorithm>

#include "tests/devices/epicpos/fixture.hpp"

namespace drycut::devices::epicpos {
namespace {

// Placements and ramps (002 1.2.3, 1.4.3; spec 5.3-5.10). At maxvel 50000 Um/s and taccdec 1 s a ramp to
// 5000 Um/s takes 0.1 s = 50 periods and 250 Um.
class EpicposMotion : public PositionerTest {
 protected:
  /// Largest change of the theoretical speed from sample to sample while the axis moves [bits/s2].
  double peak_acceleration() {
    double peak = 0;
    double last = speed();
    while (get("st_still") == 0) {
      does("+1");
      peak = std::max(peak, std::abs(speed() - last) * 1000 / period);
      last = speed();
    }
    return peak;
  }
};

TEST_F(EpicposMotion, TheRampIsEpicycloidalWithTwiceTheLinearPeak) {
  does("INIT LOOPON setpos=4000 START");
  for (int i = 2; i <= 50; ++i) {
    does("+1");
    const double p = i / 50.0;
    const double expected = 5000 * (p - std::sin(2 * M_PI * p) / (2 * M_PI));
    EXPECT_NEAR(speed(), expected, 1) << i;
  }
  EXPECT_NEAR(peak_acceleration(), 2 * 5000 / 0.1, 300);
}

TEST_F(EpicposMotion, TwoRampTimes) {
  covers({"rampmode", "tacc", "tdec"});
  does("tacc=200 tdec=50 setpos=1000 INIT LOOPON");
  EXPECT_EQ(duration("START"), 150);  // rampmode 0: taccdec counts
  does("rampmode=1 setpos=0");
  // 0.2 s and 500 Um, 0.05 s and 125 Um, 375 Um at speed in 0.075 s
  EXPECT_EQ(duration("START"), 100 + 38 + 25);
}

TEST_F(EpicposMotion, ReductionKeepsTimesOrGradients) {
  covers({"rtype"});
  does("rampmode=1 tacc=100 tdec=200 setpos=75 INIT LOOPON");
  // Ramps of 0.1 s and 0.2 s; 75 Um in them is a peak of 2 * 75 / 0.3 = 500 Um/s.
  does("rtype=0");
  EXPECT_EQ(duration("START"), 150);
  // a = 50000, d = 25000: vp = sqrt(2 D a d / (a + d)) = 1581 Um/s, 0.0316 s and 0.0632 s.
  does("rtype=1 setpos=0 START!");
  double peak = 0;
  const long before = samples;
  do {
    does("+1");
    peak = std::max(peak, std::abs(speed()));
  } while (get("st_still") == 0);
  EXPECT_NEAR(static_cast<double>(samples - before), 0.0949 / 0.002, 1);
  EXPECT_NEAR(peak, 1581, 15);
}

TEST_F(EpicposMotion, StopFinishesTheAccelerationOrNot) {
  covers({"stopt", "STOP accepted"});
  does("setpos=100000 INIT LOOPON");
  for (const int stopt : {0, 1}) {
    write("stopt", stopt);
    does("START +24");  // mid ramp: half the speed
    shows("speed=2500~1");
    does("STOP!");
    double peak = 0;
    long periods = 0;
    do {
      does("+1");
      ++periods;
      peak = std::max(peak, speed());
    } while (get("st_still") == 0);
    if (stopt == 0) {
      EXPECT_NEAR(peak, 5000, 1);  // the ramp is finished, then the whole deceleration
      EXPECT_EQ(periods, 25 + 50);
    } else {
      EXPECT_LE(peak, 2500);  // at once: half the speed in half the time
      EXPECT_EQ(periods, 25);
    }
    shows("!toll");
  }
}

TEST_F(EpicposMotion, ManualMovementsRunUntilStopOrTheLimit) {
  covers({"minpos", "maxpos"});
  after("minpos=-3000 maxpos=3000 INIT LOOPON MANFW +100", "speed=5000~1 !movdir");
  after("STOP until:still:60", "posit<1500");
  after("MANBW +1", "movdir");
  after("until:still +300", "posit=-3000~1");
  after("posit=-3000 sample MANBW", "still");
  says({"MANBW: posit -3000 is already at minpos -3000"});
  says("posit=3000 sample MANFW", {"MANFW: posit 3000 is already at maxpos 3000"});
}

TEST_F(EpicposMotion, PausesBeforeTurning) {
  covers({"tinvt"});
  does("tinvt=20");  // 0.2 s = 100 periods
  does("INIT LOOPON setpos=1000");
  EXPECT_EQ(duration("START"), 150);
  does("setpos=2000");
  EXPECT_EQ(duration("START"), 150);  // the same way on: no pause
  does("setpos=1000");
  EXPECT_EQ(duration("START"), 100 + 150);
  does("+60");  // it has rested for 0.12 s already
  does("setpos=2000");
  EXPECT_EQ(duration("START"), 40 + 150);
  does("+200 setpos=1000");
  EXPECT_EQ(duration("START"), 150);
}

TEST_F(EpicposMotion, TheFirstMovementNeverPauses) {
  does("tinvt=999 setpos=-1000 INIT LOOPON");
  EXPECT_EQ(duration("START"), 150);
}

TEST_F(EpicposMotion, StopEndsThePauseBeforeTurning) {
  does("tinvt=100 stopt=0 INIT LOOPON");
  ASSERT_TRUE(place(1000));
  after("setpos=0 tinvt=999 START +10", "!still ffwdreg=0");
  EXPECT_EQ(duration("STOP"), 1);
  shows("posit=1000~1");
}

TEST_F(EpicposMotion, ToleranceIsReportedAfterItsDelay) {
  covers({"toll", "toldly"});
  after("toldly=10 pgain=500 INIT LOOPON", "!toll");
  does("setpos=1000");
  duration("START");
  after("until:toll setpos=2000 START", "!toll");
  does("until:still");
  while (std::abs(get("posit") - 2000) > 2) tick();
  int periods = 0;
  for (; get("st_toll") == 0 && periods < 1000; ++periods) tick();
  EXPECT_EQ(periods, 50);  // 0.1 s
  after("blocked=1 count+=3 sample", "!toll");
  after("count+=-3 sample", "!toll");  // the delay begins again
  after("+49", "!toll");
  after("+1", "toll");
}

TEST_F(EpicposMotion, ToleranceConcernsTheStartedQuota) {
  does("INIT LOOPON");
  ASSERT_TRUE(place(1000));
  shows("toll");
  after("setpos=5000 +5", "toll");
  after("MANFW +5 STOP until:still", "!toll");
}

TEST_F(EpicposMotion, SpeedsAreInWholeUnits) {
  covers({"decpt", "unitvel"});
  // 002 1.2.1.3: cm with one decimal, 10 cm/s are 100 Um/s.
  after("decpt=1 unitvel=1 maxvel=5000 setvel=10 INIT LOOPON MANFW +100",
        "speed=100~1 ffwdreg=66");  // a five hundredth of 10 V
  after("STOP until:still unitvel=0 decpt=0 maxvel=3000000 setvel=60000 MANFW +100", "speed=1000~2");
}

TEST_F(EpicposMotion, StartAndStopInOneSampleStop) {
  after("INIT LOOPON setpos=1000 stopt=1 START! STOP! +3", "still posit=0");
}

}  // namespace
}  // namespace drycut::devices::epicpos
