#include <gmock/gmock.h>

#include "devices/camming4/camming4.hpp"
#include "tests/devices/epicpos/fixture.hpp"

namespace drycut::devices::epicpos {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// PID with feed-forward, calibration and the DAC (002 1.2.2-1.2.4, 1.3.1; spec 5.2). The unit of error is 100
// bits, the way of maxvel in one TCamp.
class EpicposRegulation : public PositionerTest {
 protected:
  /// Closes the loop on a blocked axis and turns it `bits` away.
  void disturb(std::int64_t bits) {
    does("blocked=1 INIT LOOPON");
    count() += bits;
    does("sample");
  }
};

TEST_F(EpicposRegulation, ProportionalGainOf1000GivesTenVoltsAtTheUnitOfError) {
  covers({"pgain"});
  does("pgain=1000");
  disturb(-100);
  shows("follerr=100 propreg=32767 DAC=32767");
  after("count+=150 sample", "follerr=-50 DAC=-16384");
  after("pgain=10 sample", "DAC=-164");  // 1 %
}

TEST_F(EpicposRegulation, FeedForwardOf1000GivesTenVoltsAtMaxvel) {
  covers({"feedfw"});
  after("pgain=0 setvel=50000 taccdec=10 INIT LOOPON MANFW +100", "ffwdreg=32767 DAC=32767");
  after("feedfw=985 +1", "ffwdreg=32275");  // 98.5 %
  after("feedfw=2000 +1", "DAC=32767");     // the DAC ends at 10 V
}

TEST_F(EpicposRegulation, TheIntegralGrowsToItsRangeOf1024) {
  covers({"integt"});
  does("pgain=0 integt=1000");
  disturb(-10);
  // Each 2 ms sample of 1000 ms adds 0.1 * 32767 * 2 / 1000 bits.
  shows("integ=7");
  after("+9", "integ=66");
  after("+1000", "integ=1024 DAC=1024");
  after("count+=20 +2000", "integ=-1024");
  after("LOOPON", "integ=0 follerr=0");
}

TEST_F(EpicposRegulation, TheDerivativeActsOnAChangeOnlyUpTo1024) {
  covers({"derivt"});
  does("pgain=0 derivt=2");
  disturb(0);
  after("count+=-1 sample", "derreg=328");  // one bit in one TCamp
  after("sample", "derreg=0");
  after("count+=-50 sample", "derreg=1024 DAC=1024");
  after("count+=70 sample", "derreg=-1024");
}

TEST_F(EpicposRegulation, OffsetIsAlwaysAdded) {
  covers({"offset"});
  after("offset=-150 INIT LOOPON", "DAC=-150");
  after("LOOPOFF", "DAC=-150");
  after("CALON", "DAC=-150");
  after("offset=-32768 sample", "DAC=-32767");
}

// Several axes on one DAC (002 1.3.1).
class EpicposSharedDac : public EpicposRegulation {
 protected:
  static constexpr const char* warning =
      "another device regulates on the same analogue output; of devices that share one, all but one need "
      "REGOFF";
  std::unique_ptr<Device> second = make_epicpos(terminals_of("2 X X X 2.AN01"), cards);
  void both(int times = 1) {
    for (int i = 0; i < times; ++i) {
      device->sample();
      second->sample();
    }
  }
};

TEST_F(EpicposSharedDac, TurnsAreInOrder) {
  drive(*device, "INIT! REGOFF!");
  drive(*second, "INIT! REGOFF!");
  both();
  for (int i = 0; i < 3; ++i) {
    drive(*device, "REGON!");
    both(2);
    // The same turn of the program hands it over, and back: the order of sampling does not matter.
    drive(*device, "REGOFF!");
    drive(*second, "REGON!");
    both(2);
    drive(*second, "REGOFF!");
    drive(*device, "REGON!");
    both(2);
    drive(*device, "REGOFF!");
    both();
  }
  shows("silent");
  EXPECT_THAT(said_by(*second), IsEmpty());
}

TEST_F(EpicposSharedDac, TwoAtOnceAreReportedOnce) {
  drive(*device, "INIT!");
  drive(*second, "INIT!");
  both(10);
  shows("silent");
  EXPECT_THAT(said_by(*second), ElementsAre(std::string("IOutA: ") + warning));
  drive(*second, "REGOFF!");
  both();
  drive(*second, "REGON!");
  both(10);
  EXPECT_THAT(said_by(*second), ElementsAre(std::string("IOutA: ") + warning));
  does("power");
  both(10);
  EXPECT_THAT(said_by(*second), IsEmpty());
  drive(*device, "INIT!");
  both(10);
  says({std::string("IOutA: ") + warning});  // now it is the second
}

TEST_F(EpicposSharedDac, OfTwoAtOnceTheLaterHasTheLastWordAndRegoffLeavesItsVoltage) {
  drive(*device, "INIT! CALON!");
  drive(*second, "INIT! CALON!");
  both();
  drive(*device, "vout=20");
  drive(*second, "vout=-30");
  both(3);
  shows("DAC=-9830");
  drive(*second, "REGOFF!");
  both(3);
  shows("DAC=6553");
  drive(*device, "REGOFF!");
  both(3);
  drive(*device, "vout=50");
  drive(*second, "vout=50");
  both(3);
  shows("DAC=6553");
}

TEST_F(EpicposSharedDac, Camming4TakesPart) {
  second = camming4::make_camming4(terminals_of("2 X X X X X X X X X 2.AN01 X"), cards);
  drive(*device, "INIT!");
  drive(*second, "INIT!");
  both(5);
  EXPECT_THAT(said_by(*second), ElementsAre(std::string("IoutA: ") + warning));
  drive(*second, "REGOFF!");
  both();
  drive(*device, "CALON!");
  both();
  does("vout=30");
  both();
  shows("DAC=9830");  // CAMMING4 leaves it alone
  drive(*device, "REGOFF!");
  both();
  drive(*second, "REGON!");
  both(3);
  shows("DAC=0");
  EXPECT_THAT(said_by(*second), IsEmpty());
  shows("silent");
}

}  // namespace
}  // namespace drycut::devices::epicpos
