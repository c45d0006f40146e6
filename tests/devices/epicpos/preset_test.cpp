#include "tests/devices/epicpos/fixture.hpp"
#include "tests/devices/search_bench.hpp"

namespace drycut::devices::epicpos {
namespace {

// The preset search (002 1.2.5; spec 5.11). The enable is active from `from` to `to`; a zero pulse each 512
// bits latches its exact count.
class EpicposPreset : public SearchBench<PositionerTest, 512, 3> {
 public:
  EpicposPreset() : SearchBench(2000, 1000000) { write("pgain", 500); }
};

TEST_F(EpicposPreset, ModeOneBackward) {
  from = -1000000;
  to = -2000;
  does("prspos=100 prsmode=1 prsdir=1 INIT LOOPON PRESET until:!prson +200");
  EXPECT_EQ(get("posit"), 100 + count() + 1536);
}

TEST_F(EpicposPreset, ANewSearchClearsTheOldResult) {
  after("INIT LOOPON PRESET until:!prson", "prsok");
  after("PRESET", "!prsok");
  after("power", "!prsok");
}

TEST_F(EpicposPreset, TheTurnsPauseForTinvt) {
  does("tinvt=50 INIT LOOPON PRESET");
  while (!enable() && samples < 5000) tick();
  while (std::abs(speed()) > 0.5 && samples < 5000) tick();
  long still = 0;
  for (; std::abs(speed()) < 0.5 && still < 5000; ++still) tick();
  EXPECT_NEAR(static_cast<double>(still), 250, 5);
  does("until:!prson");
}

TEST_F(EpicposPreset, ALockedCountIsNotLoaded) {
  for (const int mode : {0, 1}) {
    does("power count=0");
    set({{"prspos", 700}, {"prsmode", mode}, {"posit", 0}, {"pgain", 0}});  // a locked loop would run away
    does("INIT LOOPON PRESET +60 CNTLOCK");
    const int posit = get("posit");
    does("+1500");
    EXPECT_LT(count(), from - 600);  // released, and past a zero pulse
    shows("prson !prsok");
    EXPECT_EQ(get("posit"), posit);
    does("CNTUNLOCK +600");
    EXPECT_EQ(get("st_prson"), mode == 0 ? 1 : 0);  // mode 1: the next zero pulse loads
  }
}

TEST_F(EpicposPreset, ModeTwoLoadsWhileTheEnableIsActive) {
  by_hand = true;
  after("prspos=99 prsmode=2 2.INP01=1 INIT LOOPON +5", "!prsok");  // active at power-up: released first
  after("PRESET", "!prson");
  after("2.INP01=0 LOOPOFF +1", "posit=0");
  after("2.INP01=1 +1", "prsok posit=99");
  after("count+=40 sample", "posit=99");  // the load goes on
  after("2.INP01=0 count+=40 sample", "posit=139");
  after("CNTLOCK 2.INP01=1 +1", "posit=139 still");
}

TEST_F(EpicposPreset, AnOpenLoopGoesToTheQuotaFromWhereTheAxisStands) {
  // The axis is a tenth faster than maxvel says: theory is far from it when the search is over.
  // Four Um are a tenth of the way that the axis ran out from the load.
  after("prspos=700 maxvel=45455 INIT PRESET until:!prson", "posit=700~4");
}

TEST_F(EpicposPreset, AnotherLineIsNoZeroPulse) {
  by_hand = true;
  from = 300;
  does("prsmode=1 pgain=500 INIT LOOPON PRESET");
  for (int i = 0; i < 20000 && count() > -100; ++i) {
    enable() = count() >= from;
    does("+1");
    counter().latched = count();
    device->interrupt(zero_line + 1, true);
    device->interrupt(zero_line, false);
    if (enable()) i = 0;
    if (samples > 3000) break;
  }
  shows("prson !prsok");
}

}  // namespace
}  // namespace drycut::devices::epicpos
