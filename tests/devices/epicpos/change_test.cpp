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
  static std::string kept(const std::string& name) {
    return name + ": kept for the next movement, the running one cannot take it any more";
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

TEST_F(EpicposChange, StopFollowsTheRampInUse) {
  // 002 1.4.2; 1.4.3: a time that loses the quota is saved but not processed.
  begin(300);
  says("taccdec=999 sample", {kept("taccdec")});
  const int here = get("posit");
  EXPECT_EQ(duration("STOP"), 50);
  EXPECT_NEAR(get("posit"), here + 250, 12);
}

TEST_F(EpicposChange, AManualMovementStopsBeforeItsLimitWhateverTimeWasRefused) {
  does("maxpos=3000 INIT LOOPON MANFW +250");  // about 2250 Um
  says("taccdec=999 sample", {kept("taccdec")});
  EXPECT_EQ(duration("STOP"), 50);
  shows("posit<3000");
}

TEST_F(EpicposChange, ATimeThatWasRefusedKeepsNothingElseOut) {
  does("rampmode=1 tacc=100 tdec=100");
  begin(300);
  says("tdec=999 sample", {kept("tdec")});
  after("setvel=2500 +60", "speed=2500~1 silent");
  after("tacc=200 setvel=5000 +25", "speed=3750~15 silent");  // the middle of 0.1 s
  after("setpos=4300 until:still +300", "posit=4300~1 toll silent");
}

TEST_F(EpicposChange, ATimeIsRefusedInTheRampThatItWouldFollow) {
  begin(25, 1500);                                // 250 Um up, 1000 at speed, 250 down
  says("taccdec=600 sample", {kept("taccdec")});  // 1500 Um to stop
  after("setpos=1700 setvel=2500 +24", "speed=5000~10 silent");
  after("+60", "speed=2500~1");
  after("until:still +300", "posit=1700~1 toll silent");
}

TEST_F(EpicposChange, OfWhatIsWrittenTogetherInARampTheRestIsTaken) {
  begin(25, 1500);
  says("taccdec=600 setvel=2500 sample", {kept("taccdec")});
  after("+84", "speed=2500~1");
  after("until:still +300", "posit=1500~1 toll");
}

TEST_F(EpicposChange, AShortPlacementMadeLongInItsRampGoesAtSetvel) {
  for (const int rtype : {0, 1}) {
    does("power posit=0 sample");
    write("rtype", rtype);
    begin(10, 50);  // a peak of 500 or of 1581 Um/s
    after("setpos=4000 +200", "speed=5000~1");
    after("until:still +300", "posit=4000~1 toll silent");
  }
}

TEST_F(EpicposChange, AManualMovementCountedBackInItsRampGoesAtSetvel) {
  // The endless movement of 002 1.3.2, begun just before its limit.
  does("rtype=1 maxpos=4000 posit=3950 INIT LOOPON MANFW +9");
  after("posit=0 +200", "speed=5000~1");
  after("until:still +300", "posit=4000~1");
}

TEST_F(EpicposChange, APresetSearchTakesNewTimesAndNoSpeed) {
  does("INIT LOOPON PRESET +100 taccdec=50 setvel=9000");
  after("+60", "speed=5000~1 setvel=5000 silent");  // prsvel
  EXPECT_EQ(duration("STOP"), 25);
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
