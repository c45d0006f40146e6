#include <gmock/gmock.h>

#include "tests/devices/camming4/covers.hpp"
#include "tests/devices/camming4/fixture.hpp"

namespace drycut::devices::camming4 {
namespace {

using Camming4Regulation = Camming4Test;

TEST_F(Camming4Regulation, OpenLoopMovesOnFeedForwardOnly) {
  after("INIT setpos=1000 START until:still", "propreg=0 DAC=0 posit=1000~30");
  after("LOOPON", "follerr=0");
}

TEST_F(Camming4Regulation, EmergencyStopsWithoutRampAndResumeReactsOnTheSpot) {
  after("INIT LOOPON MANFW +60 EMRG", "DAC=0 emrg still loopon");
  after("count+=777 sample", "DAC=0");
  after("START MANFW STARTCAM PRESET", "still wrncode=11");
  after("RESUME", "!emrg follerr=0 DAC=0");
  after("count+=10 sample", "propreg=-655");  // pgain 200: 0.2 * 10/100 of 32767
}

TEST_F(Camming4Regulation, CalibrationIsAVoltageSource) {
  says("INIT LOOPON offset=7 vout=50 sample", {"vout: st_cal is 0, must be 1"});
  after("CALON", "DAC=7");
  does("vout=-25 sample");
  EXPECT_EQ(word(), -8192 + 7);
  shows("vout=-25");
  after("count+=-4000 sample CALOFF", "follerr=0 DAC=7");
  covers({"st_cal", "offset"});
}

TEST_F(Camming4Regulation, RegulationOffFreezesTheOutput) {
  does("INIT LOOPON blocked=1 count=-20 sample");
  const int before = word();
  EXPECT_EQ(before, 1311);  // 0.2 * 20/100 of 32767
  does("REGOFF count=300 sample");
  EXPECT_EQ(word(), before);
  shows("posit=300");
  after("START", "wrncode=11");
  after("REGON", "DAC=0");
  covers({"REGOFF accepted", "st_regoff"});
}

TEST_F(Camming4Regulation, RegulatesByItsClosedForms) {
  does("pgain=1000 feedfw=0 INIT LOOPON blocked=1 count=-100");  // the way of one period at maxvel
  after("sample", "DAC=32767 propreg=32767 follerr=100 !warning");
  does("count=50 offset=-100 sample");
  EXPECT_EQ(word(), -16384 - 100);
  covers({"pgain"});
}

TEST_F(Camming4Regulation, SaturationIsAWarning) {
  after("pgain=1000 INIT LOOPON blocked=1 count=-101 sample", "DAC=32767 wrncode=3");
  after("count=101 sample", "DAC=-32767 wrncode=3");  // 4 is of lower priority
  after("RSWRN", "wrncode=4");                        // and comes back at once
}

TEST_F(Camming4Regulation, FollowingErrorIsHeldForHalfASecond) {
  after("maxfollerr=40 INIT LOOPON blocked=1 count=41 sample", "foller");
  does("count=40");
  for (int ms = period; ms < 500; ms += period) {
    does("sample");
    ASSERT_EQ(get("st_foller"), 1) << ms;
  }
  after("sample", "!foller");
}

TEST_F(Camming4Regulation, MeasuresFrequencyAndSpeed) {
  does("tbf=2 tbfm=2 INIT");
  for (int i = 0; i < 12; ++i) does("count+=-8 +1*20");
  shows("frq=1000 vel=4000 frqm=2500");
}

TEST_F(Camming4Regulation, LocksAndReversesItsCounts) {
  after("INIT CNTREV count+=10 sample", "posit=-10");
  after("CNTLOCK count+=10 sample", "posit=-10");
  after("CNTUNLOCK CNTDIR count+=3 +1*4", "posit=-7");
  after("CNTREVM +1*1", "positm=3");
  after("CNTLOCKM +1*100", "encoderm=3");
}

TEST_F(Camming4Regulation, DelCntKeepsTheRemainder) {
  after("measure=1 pulse=10 INIT count=23 sample", "posit=2");
  after("delta1=2 DELCNT count+=7 sample", "posit=5");  // 4.3 + 0.7
  after("count+=3 sample posit=5 sample count+=9 sample", "posit=5");
  covers({"delta1"});
}

TEST_F(Camming4Regulation, TwoDelCntBetweenSamplesAreOne) {
  after("INIT posit=1000 delta1=-100 DELCNT! DELCNT! sample", "posit=900");
  after("DELCNT", "posit=800");
}

TEST_F(Camming4Regulation, ConvertsByTheRatioOfMeasureAndPulse) {
  after("measure=220 pulse=4096 INIT count=62296 sample", "posit=3345");
  after("encoder=-4096 sample", "posit=-220");
}

TEST_F(Camming4Regulation, ChangesTheMasterWithoutAJump) {
  after("INIT master=100 master_b=5000 sample mtype=1 sample", "positm=100");
  after("master=300 master_b=5007 sample", "positm=107");
  after("mtype=0 sample master=301 sample", "positm=108");
  covers({"mtype"});
}

}  // namespace
}  // namespace drycut::devices::camming4
