#include "tests/devices/oopos2/fixture.hpp"
#include "tests/devices/search_bench.hpp"

namespace drycut::devices::oopos2 {
namespace {

using testing::ElementsAre;

// The preset search (001 1.4.8; spec 5.11 and 9.7). The enable is active from `from` to `to`; a zero pulse
// each 64 bits latches its exact count.
class Oopos2Preset : public SearchBench<Oopos2Test, 64, 3> {
 public:
  Oopos2Preset() : SearchBench(600, 100000) {
    does("prspos=700 toldly=5 tinvt=6 tollp=10 tolln=10");
    coast_fast = 50;
    coast = 10;
  }
  /// The outputs on the way, until the search ends.
  std::vector<std::string> search() {
    std::vector<std::string> changes;
    std::string last = on();
    for (int i = 0; i < 5000 && get("st_prson") == 1; ++i) {
      does("+1");
      if (on() != last) changes.push_back(last = on());
    }
    shows("!prson");
    return changes;
  }
};

TEST_F(Oopos2Preset, ModeZeroLoadsAtTheEnablesRelease) {
  covers({"prsmode", "prsmode 0", "prsdir 0", "prspos"});
  after("INIT PRESET", "prson !still");
  // Fast to the enable, off, tinvt, slowly back, off and braked not before the quota is reached.
  EXPECT_THAT(search(), ElementsAre("", "IDMR", "D", "AMR", "", "F"));
  shows("prsok still !toll");  // it coasted 10 with an inertia of 0
  // It left the enable at 600 (598 by the count of the slow way), coasted 10, and came back to 700.
  EXPECT_NEAR(static_cast<double>(count()) - (get("posit") - 700), 598, 4);
  shows("silent");
}

TEST_F(Oopos2Preset, TheEndIsAPlacementAtTheQuota) {
  does("iner01=60 INIT PRESET");
  search();
  // From 690 where it coasted to: off at 694, coasting 10 again.
  shows("posit=706~3 setpos=0");
}

TEST_F(Oopos2Preset, InToleranceItStaysWhereItCoastedTo) {
  does("tolln=200 INIT PRESET");
  EXPECT_THAT(search(), ElementsAre("", "IDMR", "D", "DF"));
  shows("prsok !sttoll");
}

TEST_F(Oopos2Preset, Backward) {
  covers({"prsdir", "prsdir 1"});
  from = -100000;
  to = -300;
  does("prsdir=1 INIT PRESET");
  EXPECT_THAT(search(), ElementsAre("D", "AMR", "", "IDMR", "D", "DF"));
  EXPECT_NEAR(static_cast<double>(count()) - (get("posit") - 700), -296, 4);
}

TEST_F(Oopos2Preset, AlwaysSlow) {
  covers({"prsdir 2", "prsdir 3"});
  after("prsdir=2 INIT PRESET", "on=AMR");
  EXPECT_EQ(search().at(1), "IDMR");
  from = -100000;
  to = -300;
  switches("prsdir=3 +2 PRESET!", 10, {"0 IDMR"});
}

TEST_F(Oopos2Preset, ModeOneLoadsAtTheZeroPulseAfterTheRelease) {
  covers({"prsmode 1"});
  does("prsmode=1 INIT PRESET");
  search();
  shows("prsok");
  // Below 600 the first pulse is at 576: its exact count is the quota.
  EXPECT_EQ(get("posit"), 700 + count() - 576);
}

TEST_F(Oopos2Preset, OnlyTheZeroLinesRisingEdgeIsAPulse) {
  by_hand = true;
  does("prsmode=1 INIT PRESET");
  for (int i = 0; i < 300; ++i) {
    enable() = count() >= from;
    does("+1");
    counter().latched = count();
    device->interrupt(zero_line + 1, true);
    device->interrupt(zero_line, false);
  }
  shows("prson !prsok");
}

TEST_F(Oopos2Preset, InsideTheEnableTheSlowWayIsFirst) {
  from = -40;
  after("INIT +1 PRESET", "on=IDMR");
  search();
  EXPECT_NEAR(static_cast<double>(count()) - (get("posit") - 700), -46, 4);
}

TEST_F(Oopos2Preset, PresetAgainTurns) {
  from = 100000;
  switches("INIT PRESET +20 PRESET!", 10, {"0 ", "6 IDM"});
  shows("prson");
  after("STOP", "!prson !prsok");
  does("until:still");
}

TEST_F(Oopos2Preset, TurnedItCanStillRunIntoTheEnable) {
  does("INIT PRESET");
  while (count() < from - 20) tick();
  does("PRESET!");  // it coasts 50 into the enable and turns
  search();
  shows("prsok");
  EXPECT_NEAR(static_cast<double>(count()) - (get("posit") - 700), 598, 4);
}

TEST_F(Oopos2Preset, TheLimitsDoNotCount) {
  does("maxpos=100 minpos=-100 prspos=50 INIT PRESET");
  search();
  shows("prsok count>500");
}

TEST_F(Oopos2Preset, ALockedCountIsNotLoaded) {
  for (const int mode : {0, 1}) {
    does("power count=0");
    write("prsmode", mode);
    does("INIT CNTUNLOCK PRESET +20 CNTLOCK +100");
    EXPECT_LT(count(), from) << mode;
    EXPECT_EQ(get("st_prson"), 1) << mode;
    EXPECT_EQ(get("st_prsok"), 0) << mode;
  }
}

TEST_F(Oopos2Preset, AManualMovementEndsTheSearch) {
  after("INIT PRESET +5 MANSFW", "!prson on=AMR");
  after("+200", "!prsok");
}

TEST_F(Oopos2Preset, ANewSearchClearsTheOldResult) {
  does("INIT PRESET");
  search();
  shows("prsok");
  after("PRESET", "!prsok");
}

TEST_F(Oopos2Preset, ModeTwoLoadsWhileTheEnableIsActive) {
  by_hand = true;
  covers({"prsmode 2"});
  after("prsmode=2 2.INP01=1 INIT +1", "!prsok");  // active at power-up: released first
  after("PRESET", "!prson still");
  after("2.INP01=0 +1", "posit=0");
  after("2.INP01=1 +1", "prsok posit=700");
  after("count+=40 +1", "posit=700");  // the load goes on
  after("2.INP01=0 count+=40 +1", "posit=740");
  after("CNTLOCK 2.INP01=1 +1", "posit=740");
}

}  // namespace
}  // namespace drycut::devices::oopos2
