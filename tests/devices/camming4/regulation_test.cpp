#include <gmock/gmock.h>

#include "tests/devices/camming4/covers.hpp"
#include "tests/devices/camming4/fixture.hpp"

namespace drycut::devices::camming4 {
namespace {

using Camming4Regulation = Camming4Test;

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
