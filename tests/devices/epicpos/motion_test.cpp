#include <gmock/gmock.h>

#include <algorithm>

#include "tests/devices/epicpos/fixture.hpp"

namespace drycut::devices::epicpos {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// Placements and ramps (002 1.2.3, 1.4.3; spec 5.3-5.10). At maxvel 50000 Um/s and taccdec 1 s a ramp to
// 5000 Um/s takes 0.1 s = 50 periods and 250 Um.
class EpicposMotion : public PositionerTest {
 protected:
  /// Largest change of the theoretical speed from sample to sample while the axis moves [bits/s2].
  double peak_acceleration() {
    double peak = 0;
    double last = speed();
    while (get("st_still") == 0) {
      tick();
      peak = std::max(peak, std::abs(speed() - last) * 1000 / period);
      last = speed();
    }
    return peak;
  }
};

TEST_F(EpicposMotion, PlacesTheAxisExactly) {
  covers({"setpos", "st_still", "START accepted"});
  start();
  EXPECT_EQ(get("st_still"), 1);
  for (const int target : {1000, -2000, -1999, 0}) {
    write("setpos", target);
    command("START");
    EXPECT_EQ(get("st_still"), 0);
    ASSERT_TRUE(wait("st_still", 1));
    ticks(300);
    EXPECT_NEAR(get("posit"), target, 1);
  }
  EXPECT_THAT(diagnostics(), IsEmpty());
}

TEST_F(EpicposMotion, ARampTakesItsTimeFromRestToMaxvel) {
  covers({"taccdec", "setvel", "maxvel"});
  start();
  // 0.1 s each ramp, 500 Um in ramps, 500 Um at speed: 0.3 s, as a trapezoid of the same times needs.
  write("setpos", 1000);
  EXPECT_EQ(duration("START"), 150);
  // A tenth of the speed: 0.01 s ramps and 5 Um, 990 Um at 500 Um/s.
  set({{"setpos", 0}, {"setvel", 500}});
  EXPECT_EQ(duration("START"), 5 + 995 + 5);
}

TEST_F(EpicposMotion, TheRampIsEpicycloidalWithTwiceTheLinearPeak) {
  start();
  write("setpos", 4000);
  command("START");
  for (int i = 2; i <= 50; ++i) {
    tick();
    const double p = i / 50.0;
    const double expected = 5000 * (p - std::sin(2 * M_PI * p) / (2 * M_PI));
    EXPECT_NEAR(speed(), expected, 1) << i;
  }
  EXPECT_NEAR(peak_acceleration(), 2 * 5000 / 0.1, 300);
}

TEST_F(EpicposMotion, TwoRampTimes) {
  covers({"rampmode", "tacc", "tdec"});
  set({{"tacc", 200}, {"tdec", 50}, {"setpos", 1000}});
  start();
  EXPECT_EQ(duration("START"), 150);  // rampmode 0: taccdec counts
  set({{"rampmode", 1}, {"setpos", 0}});
  // 0.2 s and 500 Um, 0.05 s and 125 Um, 375 Um at speed in 0.075 s
  EXPECT_EQ(duration("START"), 100 + 38 + 25);
}

TEST_F(EpicposMotion, ReductionKeepsTimesOrGradients) {
  covers({"rtype"});
  set({{"rampmode", 1}, {"tacc", 100}, {"tdec", 200}, {"setpos", 75}});
  start();
  // Ramps of 0.1 s and 0.2 s; 75 Um in them is a peak of 2 * 75 / 0.3 = 500 Um/s.
  write("rtype", 0);
  EXPECT_EQ(duration("START"), 150);
  // a = 50000, d = 25000: vp = sqrt(2 D a d / (a + d)) = 1581 Um/s, 0.0316 s and 0.0632 s.
  set({{"rtype", 1}, {"setpos", 0}});
  order("START");
  double peak = 0;
  const long before = samples;
  do {
    tick();
    peak = std::max(peak, std::abs(speed()));
  } while (get("st_still") == 0);
  EXPECT_NEAR(static_cast<double>(samples - before), 0.0949 / 0.002, 1);
  EXPECT_NEAR(peak, 1581, 15);
}

TEST_F(EpicposMotion, StopFinishesTheAccelerationOrNot) {
  covers({"stopt", "STOP accepted"});
  set({{"setpos", 100000}});
  start();
  for (const int stopt : {0, 1}) {
    write("stopt", stopt);
    command("START");
    ticks(24);  // mid ramp: half the speed
    EXPECT_NEAR(speed(), 2500, 1);
    order("STOP");
    double peak = 0;
    long periods = 0;
    do {
      tick();
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
    EXPECT_EQ(get("st_toll"), 0);
  }
}

TEST_F(EpicposMotion, ManualMovementsRunUntilStopOrTheLimit) {
  covers({"MANFW accepted", "MANBW accepted", "st_movdir", "minpos", "maxpos"});
  set({{"minpos", -3000}, {"maxpos", 3000}});
  start();
  command("MANFW");
  ticks(100);
  EXPECT_NEAR(speed(), 5000, 1);
  EXPECT_EQ(get("st_movdir"), 0);
  command("STOP");
  EXPECT_TRUE(wait("st_still", 1, 60));
  EXPECT_LT(get("posit"), 1500);
  command("MANBW");
  tick();
  EXPECT_EQ(get("st_movdir"), 1);
  ASSERT_TRUE(wait("st_still", 1));
  ticks(300);
  EXPECT_NEAR(get("posit"), -3000, 1);
  write("posit", -3000);
  sample();
  command("MANBW");
  EXPECT_EQ(get("st_still"), 1);
  EXPECT_THAT(diagnostics(), ElementsAre("MANBW: posit -3000 is already at minpos -3000"));
  write("posit", 3000);
  sample();
  command("MANFW");
  EXPECT_THAT(diagnostics(), ElementsAre("MANFW: posit 3000 is already at maxpos 3000"));
}

TEST_F(EpicposMotion, APlacementEndsAtTheLimit) {
  set({{"minpos", -300}, {"maxpos", 500}});
  start();
  write("setpos", 900);
  sample();
  diagnostics();
  command("START");
  EXPECT_THAT(diagnostics(),
              ElementsAre("START: setpos 900 is outside minpos..maxpos, the axis goes to 500"));
  ASSERT_TRUE(wait("st_still", 1));
  ticks(300);
  EXPECT_NEAR(get("posit"), 500, 1);
}

TEST_F(EpicposMotion, PausesBeforeTurning) {
  covers({"tinvt"});
  write("tinvt", 20);  // 0.2 s = 100 periods
  start();
  write("setpos", 1000);
  EXPECT_EQ(duration("START"), 150);
  write("setpos", 2000);
  EXPECT_EQ(duration("START"), 150);  // the same way on: no pause
  write("setpos", 1000);
  EXPECT_EQ(duration("START"), 100 + 150);
  ticks(60);  // it has rested for 0.12 s already
  write("setpos", 2000);
  EXPECT_EQ(duration("START"), 40 + 150);
  ticks(200);
  write("setpos", 1000);
  EXPECT_EQ(duration("START"), 150);
}

TEST_F(EpicposMotion, TheFirstMovementNeverPauses) {
  set({{"tinvt", 999}, {"setpos", -1000}});
  start();
  EXPECT_EQ(duration("START"), 150);
}

TEST_F(EpicposMotion, StopEndsThePauseBeforeTurning) {
  set({{"tinvt", 100}, {"stopt", 0}});
  start();
  ASSERT_TRUE(place(1000));
  write("setpos", 0);
  write("tinvt", 999);
  command("START");
  ticks(10);
  EXPECT_EQ(get("st_still"), 0);
  EXPECT_EQ(get("ffwdreg"), 0);
  EXPECT_EQ(duration("STOP"), 1);
  EXPECT_NEAR(get("posit"), 1000, 1);
}

TEST_F(EpicposMotion, ToleranceIsReportedAfterItsDelay) {
  covers({"toll", "toldly", "st_toll"});
  set({{"toldly", 10}, {"pgain", 500}});
  start();
  EXPECT_EQ(get("st_toll"), 0);
  write("setpos", 1000);
  duration("START");
  EXPECT_TRUE(wait("st_toll", 1));
  write("setpos", 2000);
  command("START");
  EXPECT_EQ(get("st_toll"), 0);
  ASSERT_TRUE(wait("st_still", 1));
  while (std::abs(get("posit") - 2000) > 2) tick();
  int periods = 0;
  for (; get("st_toll") == 0 && periods < 1000; ++periods) tick();
  EXPECT_EQ(periods, 50);  // 0.1 s
  blocked = true;
  count() += 3;
  sample();
  EXPECT_EQ(get("st_toll"), 0);
  count() -= 3;
  sample();
  EXPECT_EQ(get("st_toll"), 0);  // the delay begins again
  ticks(49);
  EXPECT_EQ(get("st_toll"), 0);
  tick();
  EXPECT_EQ(get("st_toll"), 1);
}

TEST_F(EpicposMotion, ToleranceConcernsTheStartedQuota) {
  start();
  ASSERT_TRUE(place(1000));
  EXPECT_EQ(get("st_toll"), 1);
  write("setpos", 5000);
  ticks(5);
  EXPECT_EQ(get("st_toll"), 1);
  command("MANFW");
  ticks(5);
  command("STOP");
  wait("st_still", 1);
  EXPECT_EQ(get("st_toll"), 0);
}

TEST_F(EpicposMotion, SpeedsAreInWholeUnits) {
  covers({"decpt", "unitvel"});
  // 002 1.2.1.3: cm with one decimal, 10 cm/s are 100 Um/s.
  set({{"decpt", 1}, {"unitvel", 1}, {"maxvel", 5000}, {"setvel", 10}});
  start();
  command("MANFW");
  ticks(100);
  EXPECT_NEAR(speed(), 100, 1);
  EXPECT_EQ(get("ffwdreg"), 66);  // a five hundredth of 10 V
  command("STOP");
  ASSERT_TRUE(wait("st_still", 1));
  set({{"unitvel", 0}, {"decpt", 0}, {"maxvel", 3000000}, {"setvel", 60000}});
  command("MANFW");
  ticks(100);
  EXPECT_NEAR(speed(), 1000, 2);
}

TEST_F(EpicposMotion, StartAndStopInOneSampleStop) {
  start();
  set({{"setpos", 1000}, {"stopt", 1}});
  order("START");
  order("STOP");
  ticks(3);
  EXPECT_EQ(get("st_still"), 1);
  EXPECT_EQ(get("posit"), 0);
}

}  // namespace
}  // namespace drycut::devices::epicpos
