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
