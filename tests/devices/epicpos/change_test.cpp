#include <gmock/gmock.h>

#include "tests/devices/epicpos/fixture.hpp"

namespace drycut::devices::epicpos {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// Changes of quota, count, speed and ramp times in motion (002 1.3.2, 1.3.3, 1.5; spec 5.7, D13). A placement
// to 4000 Um at 5000 Um/s: 0.1 s up, 0.7 s at speed, 0.1 s down.
class EpicposChange : public PositionerTest {
 protected:
  void begin(int periods, int quota = 4000) {
    start();
    write("setpos", quota);
    command("START");
    ticks(periods - 1);
  }
  static constexpr const char* quota_refused =
      "setpos: needs a quota that the running placement can still reach without turning";
  static constexpr const char* posit_refused =
      "posit: needs no deceleration to the quota yet, and the quota ahead, in motion";
};

TEST_F(EpicposChange, ANewSpeedAtConstantSpeedActsWithoutMovingTheQuota) {
  begin(100);
  write("setvel", 10000);
  ticks(25);
  EXPECT_NEAR(speed(), 7500, 10);  // in the middle of its own ramp of 0.1 s
  ticks(30);
  EXPECT_NEAR(speed(), 10000, 1);
  write("setvel", 2500);
  ticks(80);
  EXPECT_NEAR(speed(), 2500, 1);
  ASSERT_TRUE(wait("st_still", 1));
  ticks(300);
  EXPECT_NEAR(get("posit"), 4000, 1);
  EXPECT_EQ(get("st_toll"), 1);
  EXPECT_THAT(diagnostics(), IsEmpty());
}

TEST_F(EpicposChange, ANewSpeedInARampWaitsForItsEnd) {
  begin(25);
  write("setvel", 2500);
  ticks(24);
  EXPECT_NEAR(speed(), 5000, 10);  // the ramp is the one that was begun
  ticks(60);
  EXPECT_NEAR(speed(), 2500, 1);
  ASSERT_TRUE(wait("st_still", 1));
  ticks(300);
  EXPECT_NEAR(get("posit"), 4000, 1);
}

TEST_F(EpicposChange, NewRampTimesWaitForTheNextRamp) {
  begin(25);
  write("taccdec", 200);
  ticks(25);
  EXPECT_NEAR(speed(), 5000, 1);  // this one took its 0.1 s
  ticks(10);
  write("setvel", 10000);
  ticks(100);
  EXPECT_NEAR(speed(), 10000, 1);  // 0.2 s for 5000 Um/s more
  ASSERT_TRUE(wait("st_still", 1));
  ticks(300);
  EXPECT_NEAR(get("posit"), 4000, 1);
}

TEST_F(EpicposChange, RampTimesThatLoseTheQuotaAreKeptForLater) {
  set({{"rampmode", 1}, {"tacc", 100}, {"tdec", 100}});
  begin(300);          // about 2750 Um
  write("tdec", 999);  // 2500 Um to stop
  sample();
  EXPECT_THAT(diagnostics(),
              ElementsAre("tdec: kept for the next movement, the running one cannot take it any more"));
  EXPECT_EQ(get("tdec"), 999);
  ASSERT_TRUE(wait("st_still", 1, 200));
  ticks(300);
  EXPECT_NEAR(get("posit"), 4000, 1);
}

TEST_F(EpicposChange, ParametersThatDoNotCountChangeNothing) {
  begin(300);
  write("tdec", 999);  // rampmode 0
  write("tacc", 999);
  sample();
  EXPECT_THAT(diagnostics(), IsEmpty());
}

TEST_F(EpicposChange, NothingIsTakenInTheFinalDeceleration) {
  begin(410);
  write("setvel", 8000);
  write("setpos", 6000);
  write("posit", 0);
  sample();
  EXPECT_THAT(diagnostics(),
              ElementsAre("setvel: kept for the next movement, the running one cannot take it any more",
                          quota_refused, posit_refused));
  EXPECT_EQ(get("setvel"), 8000);
  EXPECT_EQ(get("setpos"), 4000);
  ASSERT_TRUE(wait("st_still", 1));
  ticks(300);
  EXPECT_NEAR(get("posit"), 4000, 1);
}

TEST_F(EpicposChange, ANewQuotaAheadIsTaken) {
  begin(100);
  write("setpos", 6000);
  sample();
  ASSERT_TRUE(wait("st_still", 1));
  ticks(300);
  EXPECT_NEAR(get("posit"), 6000, 1);
  EXPECT_EQ(get("st_toll"), 1);
}

TEST_F(EpicposChange, AQuotaBehindIsNot) {
  begin(200);
  const int here = get("posit");
  write("setpos", here - 100);
  write("setpos", here + 200);  // it needs 250 Um to stop
  write("setpos", -500);
  sample();
  EXPECT_THAT(diagnostics(), ElementsAre(quota_refused, quota_refused, quota_refused));
  write("setpos", here + 350);
  sample();
  EXPECT_THAT(diagnostics(), IsEmpty());
  EXPECT_EQ(get("setpos"), here + 350);
  ASSERT_TRUE(wait("st_still", 1, 100));
}

TEST_F(EpicposChange, ANewCountKeepsTheQuota) {
  begin(200);
  const int here = get("posit");
  write("posit", here - 1000);  // 1000 Um more to go
  sample();
  EXPECT_NEAR(get("posit"), here - 1000, 1);
  EXPECT_EQ(get("setpos"), 4000);
  ASSERT_TRUE(wait("st_still", 1));
  ticks(300);
  EXPECT_NEAR(get("posit"), 4000, 1);
  EXPECT_NEAR(static_cast<double>(count()), 5000, 2);
}

TEST_F(EpicposChange, ACountBeyondTheQuotaIsNotTaken) {
  begin(200);
  const int here = get("posit");
  write("posit", 4001);
  sample();
  EXPECT_THAT(diagnostics(), ElementsAre(posit_refused));
  EXPECT_NEAR(get("posit"), here, 20);
  ASSERT_TRUE(wait("st_still", 1));
}

TEST_F(EpicposChange, AManualMovementNeverEndsWhenItsCountIsSetBack) {
  write("maxpos", 3000);
  start();
  command("MANFW");
  for (int i = 0; i < 5000; ++i) {
    tick();
    ASSERT_EQ(get("st_still"), 0);
    if (get("posit") > 2000) write("posit", 0);
  }
  EXPECT_NEAR(speed(), 5000, 1);
  EXPECT_GT(count(), 40000);
}

TEST_F(EpicposChange, SetposIsFreeWhileNoPlacementRuns) {
  start();
  command("MANFW");
  ticks(100);
  write("setpos", -700);
  sample();
  EXPECT_EQ(get("setpos"), -700);
  command("STOP");
  write("setpos", -800);
  sample();
  EXPECT_EQ(get("setpos"), -800);
  EXPECT_THAT(diagnostics(), IsEmpty());
}

TEST_F(EpicposChange, WhatNeedsAStillAxisIsRefusedInMotion) {
  begin(50);
  for (const char* name : {"cntratio", "maxpos", "minpos", "prspos", "maxvel", "prsvel", "sprsvel", "toll",
                           "unitvel", "decpt"}) {
    const int before = get(name);
    write(name, before + 1);
    sample();
    EXPECT_EQ(get(name), before) << name;
    EXPECT_THAT(diagnostics(), ElementsAre(std::string(name) + ": st_still is 0, must be 1"));
  }
  command("EMRG");
  write("cntratio", 5000);
  sample();
  EXPECT_EQ(get("cntratio"), 5000);
}

TEST_F(EpicposChange, ReadOnlyValuesAreNotWritten) {
  for (const char* name : {"vel", "frq", "follerr", "ffwdreg", "propreg", "integ", "derreg", "st_still"}) {
    write(name, 7);
    EXPECT_THAT(diagnostics(), ElementsAre(std::string(name) + ": read only"));
  }
}

}  // namespace
}  // namespace drycut::devices::epicpos
