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
  static Resources record(std::size_t fields, std::size_t dac) {
    Resources resources(fields);
    resources[0].number = period;
    resources[dac].address = parse_address("2.AN01");
    return resources;
  }
  std::unique_ptr<Device> second = make_epicpos(record(5, 4), cards);
  void give(Device& to, const char* name) { to.command(find_command(to.type(), name).value()); }
  void both() {
    device->sample();
    second->sample();
  }
  std::vector<std::string> said_by(Device& other) {
    std::vector<std::string> said;
    for (const Diagnostic& diagnostic : other.take_diagnostics())
      said.push_back(diagnostic.subject + ": " + diagnostic.text);
    return said;
  }
};

TEST_F(EpicposSharedDac, TurnsAreInOrder) {
  give(*device, "INIT");
  give(*device, "REGOFF");
  give(*second, "INIT");
  give(*second, "REGOFF");
  both();
  for (int i = 0; i < 3; ++i) {
    give(*device, "REGON");
    both();
    both();
    // The same turn of the program hands it over, and back: the order of sampling does not matter.
    give(*device, "REGOFF");
    give(*second, "REGON");
    both();
    both();
    give(*second, "REGOFF");
    give(*device, "REGON");
    both();
    both();
    give(*device, "REGOFF");
    both();
  }
  shows("silent");
  EXPECT_THAT(said_by(*second), IsEmpty());
}

TEST_F(EpicposSharedDac, TwoAtOnceAreReportedOnce) {
  give(*device, "INIT");
  give(*second, "INIT");
  for (int i = 0; i < 10; ++i) both();
  shows("silent");
  EXPECT_THAT(said_by(*second), ElementsAre(std::string("IOutA: ") + warning));
  give(*second, "REGOFF");
  both();
  give(*second, "REGON");
  for (int i = 0; i < 10; ++i) both();
  EXPECT_THAT(said_by(*second), ElementsAre(std::string("IOutA: ") + warning));
  does("power");
  for (int i = 0; i < 10; ++i) both();
  EXPECT_THAT(said_by(*second), IsEmpty());
  give(*device, "INIT");
  for (int i = 0; i < 10; ++i) both();
  says({std::string("IOutA: ") + warning});  // now it is the second
}

TEST_F(EpicposSharedDac, Camming4TakesPart) {
  const auto cam = camming4::make_camming4(record(12, 10), cards);
  const auto all = [&] {
    device->sample();
    cam->sample();
  };
  give(*device, "INIT");
  give(*cam, "INIT");
  for (int i = 0; i < 5; ++i) all();
  EXPECT_THAT(said_by(*cam), ElementsAre(std::string("IoutA: ") + warning));
  give(*cam, "REGOFF");
  all();
  give(*device, "CALON");
  all();
  does("vout=30");
  all();
  shows("DAC=9830");  // CAMMING4 leaves it alone
  give(*device, "REGOFF");
  all();
  give(*cam, "REGON");
  for (int i = 0; i < 3; ++i) all();
  shows("DAC=0");
  EXPECT_THAT(said_by(*cam), IsEmpty());
  shows("silent");
}

}  // namespace
}  // namespace drycut::devices::epicpos
