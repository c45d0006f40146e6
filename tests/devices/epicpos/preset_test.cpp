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

TEST_F(EpicposPreset, ModeZeroLoadsAtTheEnablesRelease) {
  covers({"prsmode", "prspos", "prsvel", "sprsvel"});
  after("prspos=700 INIT LOOPON PRESET", "prson !still");
  after("+60", "speed=5000~1 setvel=5000");
  double slowest = 0;
  while (get("st_prson") == 1 && samples < 20000) {
    does("+1");
    slowest = std::min(slowest, speed());
  }
  EXPECT_NEAR(slowest, -1000, 1);
  shows("prsok !prson still setvel=1000 setpos=700");
  after("+200", "posit=700~1");
  // 700 lies where the slow leg left the enable, to the way of one sample (2 Um).
  shows("count=1999~3 silent");
}

TEST_F(EpicposPreset, ModeZeroBackwardBeyondTheLimits) {
  covers({"prsdir"});
  from = -1010;
  to = -1000;
  after("prspos=-50 prsdir=1 minpos=-100 maxpos=100 INIT LOOPON PRESET +60", "movdir");
  after("until:!prson +200", "posit=-50~1");
  // It ran over the enable, came back forward and left it at its upper end.
  shows("count=-1000~3");
}

TEST_F(EpicposPreset, ModeOneLoadsAtTheFirstZeroPulseAfterTheRelease) {
  after("prspos=0 prsmode=1 INIT LOOPON PRESET until:!prson", "prsok");
  does("+200");
  // Below 2000 the first pulse is at 1536, and its exact count is the quota.
  EXPECT_EQ(get("posit"), count() - 1536);
  shows("posit=0~1");
}

TEST_F(EpicposPreset, ModeOneBackward) {
  from = -1000000;
  to = -2000;
  does("prspos=100 prsmode=1 prsdir=1 INIT LOOPON PRESET until:!prson +200");
  EXPECT_EQ(get("posit"), 100 + count() + 1536);
}

TEST_F(EpicposPreset, InsideTheEnableTheSlowLegIsFirst) {
  from = -400;
  after("prspos=10 INIT LOOPON +2 PRESET +60", "speed=-1000~1");
  after("until:!prson", "count=-401~4");
}

TEST_F(EpicposPreset, PresetAgainTurnsTheSearch) {
  from = 1000000;
  after("INIT LOOPON PRESET +100", "speed>0");
  after("PRESET +150", "speed=-5000~1 prson");
  after("STOP", "!prson !prsok");
  does("until:still");
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
