#include <gmock/gmock.h>

#include "tests/devices/epicpos/fixture.hpp"

namespace drycut::devices::epicpos {
namespace {

// Changes of quota, count, speed and ramp times in motion (002 1.3.2, 1.3.3, 1.5; spec 5.7, D13). A placement
// to 4000 Um at 5000 Um/s: 0.1 s up, 0.7 s at speed, 0.1 s down.
class EpicposChange : public PositionerTest {
 protected:
  void begin(int periods, int quota = 4000) {
    does("INIT LOOPON");
    write("setpos", quota);
    does("START");
    ticks(periods - 1);
  }
  static constexpr const char* quota_refused =
      "setpos: needs a quota that the running placement can still reach without turning";
  static constexpr const char* posit_refused =
      "posit: needs no deceleration to the quota yet, and the quota ahead, in motion";
};

TEST_F(EpicposChange, ANewSpeedAtConstantSpeedActsWithoutMovingTheQuota) {
  begin(100);
  after("setvel=10000 +25", "speed=7500~10");  // in the middle of its own ramp of 0.1 s
  after("+30", "speed=10000~1");
  after("setvel=2500 +80", "speed=2500~1");
  after("until:still +300", "posit=4000~1 toll silent");
}

TEST_F(EpicposChange, ANewSpeedInARampWaitsForItsEnd) {
  begin(25);
  after("setvel=2500 +24", "speed=5000~10");  // the ramp is the one that was begun
  after("+60", "speed=2500~1");
  after("until:still +300", "posit=4000~1");
}

TEST_F(EpicposChange, NewRampTimesWaitForTheNextRamp) {
  begin(25);
  after("taccdec=200 +25", "speed=5000~1");         // this one took its 0.1 s
  after("+10 setvel=10000 +100", "speed=10000~1");  // 0.2 s for 5000 Um/s more
  after("until:still +300", "posit=4000~1");
}

TEST_F(EpicposChange, RampTimesThatLoseTheQuotaAreKeptForLater) {
  does("rampmode=1 tacc=100 tdec=100");
  begin(300);        // about 2750 Um
  does("tdec=999");  // 2500 Um to stop
  says("sample", {"tdec: kept for the next movement, the running one cannot take it any more"});
  shows("tdec=999");
  after("until:still:200 +300", "posit=4000~1");
}

TEST_F(EpicposChange, ParametersThatDoNotCountChangeNothing) {
  begin(300);
  does("tdec=999");  // rampmode 0
  after("tacc=999 sample", "silent");
}

TEST_F(EpicposChange, NothingIsTakenInTheFinalDeceleration) {
  begin(410);
  says("setvel=8000 setpos=6000 posit=0 sample",
       {"setvel: kept for the next movement, the running one cannot take it any more", quota_refused,
        posit_refused});
  shows("setvel=8000 setpos=4000");
  after("until:still +300", "posit=4000~1");
}

TEST_F(EpicposChange, ANewQuotaAheadIsTaken) {
  begin(100);
  after("setpos=6000 sample until:still +300", "posit=6000~1 toll");
}

TEST_F(EpicposChange, AQuotaBehindIsNot) {
  begin(200);
  const int here = get("posit");
  write("setpos", here - 100);
  write("setpos", here + 200);  // it needs 250 Um to stop
  says("setpos=-500 sample", {quota_refused, quota_refused, quota_refused});
  write("setpos", here + 350);
  after("sample", "silent");
  EXPECT_EQ(get("setpos"), here + 350);
  does("until:still:100");
}

TEST_F(EpicposChange, ANewCountKeepsTheQuota) {
  begin(200);
  const int here = get("posit");
  write("posit", here - 1000);  // 1000 Um more to go
  does("sample");
  EXPECT_NEAR(get("posit"), here - 1000, 1);
  shows("setpos=4000");
  after("until:still +300", "posit=4000~1 count=5000~2");
}

TEST_F(EpicposChange, ACountBeyondTheQuotaIsNotTaken) {
  begin(200);
  const int here = get("posit");
  says("posit=4001 sample", {posit_refused});
  EXPECT_NEAR(get("posit"), here, 20);
  does("until:still");
}

TEST_F(EpicposChange, SetposIsFreeWhileNoPlacementRuns) {
  after("INIT LOOPON MANFW +100 setpos=-700 sample", "setpos=-700");
  after("STOP setpos=-800 sample", "setpos=-800 silent");
}

TEST_F(EpicposChange, WhatNeedsAStillAxisIsRefusedInMotion) {
  begin(50);
  for (const char* name : {"cntratio", "maxpos", "minpos", "prspos", "maxvel", "prsvel", "sprsvel", "toll",
                           "unitvel", "decpt"}) {
    const int before = get(name);
    write(name, before + 1);
    does("sample");
    EXPECT_EQ(get(name), before) << name;
    says({std::string(name) + ": st_still is 0, must be 1"});
  }
  after("EMRG cntratio=5000 sample", "cntratio=5000");
}

TEST_F(EpicposChange, ReadOnlyValuesAreNotWritten) {
  for (const char* name : {"vel", "frq", "follerr", "ffwdreg", "propreg", "integ", "derreg", "st_still"}) {
    write(name, 7);
    says({std::string(name) + ": read only"});
  }
}

}  // namespace
}  // namespace drycut::devices::epicpos
