#include "tests/devices/oopos2/fixture.hpp"

namespace drycut::devices::oopos2 {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// The preset search (001 1.4.8; spec 5.11 and 9.7). The enable is active from `from` to `to`; a zero pulse
// each 64 bits latches its exact count.
class Oopos2Preset : public Oopos2Test {
 protected:
  Oopos2Preset() {
    set({{"prspos", 700}, {"toldly", 5}, {"tinvt", 6}, {"tollp", 10}, {"tolln", 10}});
    coast_fast = 50;
    coast = 10;
  }
  int from = 600;
  int to = 100000;
  /// One period with the enable and the zero pulses of the axis.
  void track(int number = 1) {
    for (int i = 0; i < number; ++i) {
      const std::int64_t before = count();
      enable() = count() >= from && count() < to;
      tick();
      const std::int64_t low = std::min(before, count());
      const std::int64_t mark = (low + 64000) / 64 * 64 - 64000 + 64;
      if (mark > std::max(before, count())) continue;
      cards.counters.at(*parse_address("2.CNT01")).latched = mark;
      device->interrupt(zero_line, true);
    }
  }
  /// The outputs on the way, until the search ends.
  std::vector<std::string> search() {
    std::vector<std::string> changes;
    std::string last = on();
    for (int i = 0; i < 5000 && get("st_prson") == 1; ++i) {
      track();
      if (on() != last) changes.push_back(last = on());
    }
    EXPECT_EQ(get("st_prson"), 0);
    return changes;
  }
};

TEST_F(Oopos2Preset, ModeZeroLoadsAtTheEnablesRelease) {
  covers({"prsmode", "prsmode 0", "prsdir 0", "prspos", "st_prson", "st_prsok", "PRESET accepted"});
  command("INIT");
  command("PRESET");
  EXPECT_EQ(get("st_prson"), 1);
  EXPECT_EQ(get("st_still"), 0);
  // Fast to the enable, off, tinvt, slowly back, off and braked not before the quota is reached.
  EXPECT_THAT(search(), ElementsAre("", "IDMR", "D", "AMR", "", "F"));
  EXPECT_EQ(get("st_prsok"), 1);
  EXPECT_EQ(get("st_still"), 1);
  EXPECT_EQ(get("st_toll"), 0);  // it coasted 10 with an inertia of 0
  // It left the enable at 600 (598 by the count of the slow way), coasted 10, and came back to 700.
  EXPECT_NEAR(static_cast<double>(count()) - (get("posit") - 700), 598, 4);
  EXPECT_THAT(diagnostics(), IsEmpty());
}

TEST_F(Oopos2Preset, TheEndIsAPlacementAtTheQuota) {
  write("iner01", 60);
  command("INIT");
  command("PRESET");
  search();
  // From 690 where it coasted to: off at 694, coasting 10 again.
  EXPECT_NEAR(get("posit"), 706, 3);
  EXPECT_EQ(get("setpos"), 0);
}

TEST_F(Oopos2Preset, InToleranceItStaysWhereItCoastedTo) {
  write("tolln", 200);
  command("INIT");
  command("PRESET");
  EXPECT_THAT(search(), ElementsAre("", "IDMR", "D", "DF"));
  EXPECT_EQ(get("st_prsok"), 1);
  EXPECT_EQ(get("st_sttoll"), 0);
}

TEST_F(Oopos2Preset, Backward) {
  covers({"prsdir", "prsdir 1"});
  from = -100000;
  to = -300;
  write("prsdir", 1);
  command("INIT");
  command("PRESET");
  EXPECT_THAT(search(), ElementsAre("D", "AMR", "", "IDMR", "D", "DF"));
  EXPECT_NEAR(static_cast<double>(count()) - (get("posit") - 700), -296, 4);
}

TEST_F(Oopos2Preset, AlwaysSlow) {
  covers({"prsdir 2", "prsdir 3"});
  write("prsdir", 2);
  command("INIT");
  command("PRESET");
  EXPECT_EQ(on(), "AMR");
  EXPECT_EQ(search().at(1), "IDMR");
  from = -100000;
  to = -300;
  write("prsdir", 3);
  track(2);
  order("PRESET");
  EXPECT_THAT(record(10), ElementsAre("0 IDMR"));
}

TEST_F(Oopos2Preset, ModeOneLoadsAtTheZeroPulseAfterTheRelease) {
  covers({"prsmode 1"});
  write("prsmode", 1);
  command("INIT");
  command("PRESET");
  search();
  EXPECT_EQ(get("st_prsok"), 1);
  // Below 600 the first pulse is at 576: its exact count is the quota.
  EXPECT_EQ(get("posit"), 700 + count() - 576);
}

TEST_F(Oopos2Preset, OnlyTheZeroLinesRisingEdgeIsAPulse) {
  write("prsmode", 1);
  command("INIT");
  command("PRESET");
  for (int i = 0; i < 300; ++i) {
    enable() = count() >= from;
    tick();
    cards.counters.at(*parse_address("2.CNT01")).latched = count();
    device->interrupt(zero_line + 1, true);
    device->interrupt(zero_line, false);
  }
  EXPECT_EQ(get("st_prson"), 1);
  EXPECT_EQ(get("st_prsok"), 0);
}

TEST_F(Oopos2Preset, InsideTheEnableTheSlowWayIsFirst) {
  from = -40;
  command("INIT");
  track();
  command("PRESET");
  EXPECT_EQ(on(), "IDMR");
  search();
  EXPECT_NEAR(static_cast<double>(count()) - (get("posit") - 700), -46, 4);
}

TEST_F(Oopos2Preset, PresetAgainTurns) {
  from = 100000;
  command("INIT");
  command("PRESET");
  track(20);
  order("PRESET");
  EXPECT_THAT(record(10), ElementsAre("0 ", "6 IDM"));
  EXPECT_EQ(get("st_prson"), 1);
  command("STOP");
  EXPECT_EQ(get("st_prson"), 0);
  EXPECT_EQ(get("st_prsok"), 0);
  EXPECT_TRUE(wait("st_still", 1));
}

TEST_F(Oopos2Preset, TurnedItCanStillRunIntoTheEnable) {
  command("INIT");
  command("PRESET");
  while (count() < from - 20) track();
  order("PRESET");  // it coasts 50 into the enable and turns
  search();
  EXPECT_EQ(get("st_prsok"), 1);
  EXPECT_NEAR(static_cast<double>(count()) - (get("posit") - 700), 598, 4);
}

TEST_F(Oopos2Preset, TheLimitsDoNotCount) {
  set({{"maxpos", 100}, {"minpos", -100}, {"prspos", 50}});
  command("INIT");
  command("PRESET");
  search();
  EXPECT_EQ(get("st_prsok"), 1);
  EXPECT_GT(count(), 500);
}

TEST_F(Oopos2Preset, ALockedCountIsNotLoaded) {
  for (const int mode : {0, 1}) {
    device->power_up();
    count() = 0;
    write("prsmode", mode);
    command("INIT");
    command("CNTUNLOCK");
    command("PRESET");
    track(20);
    command("CNTLOCK");
    track(100);
    EXPECT_LT(count(), from) << mode;
    EXPECT_EQ(get("st_prson"), 1) << mode;
    EXPECT_EQ(get("st_prsok"), 0) << mode;
  }
}

TEST_F(Oopos2Preset, AManualMovementEndsTheSearch) {
  command("INIT");
  command("PRESET");
  track(5);
  command("MANSFW");
  EXPECT_EQ(get("st_prson"), 0);
  EXPECT_EQ(on(), "AMR");
  track(200);
  EXPECT_EQ(get("st_prsok"), 0);
}

TEST_F(Oopos2Preset, ANewSearchClearsTheOldResult) {
  command("INIT");
  command("PRESET");
  search();
  ASSERT_EQ(get("st_prsok"), 1);
  command("PRESET");
  EXPECT_EQ(get("st_prsok"), 0);
}

TEST_F(Oopos2Preset, ModeTwoLoadsWhileTheEnableIsActive) {
  covers({"prsmode 2"});
  write("prsmode", 2);
  enable() = true;
  command("INIT");
  tick();
  EXPECT_EQ(get("st_prsok"), 0);  // active at power-up: released first
  command("PRESET");
  EXPECT_EQ(get("st_prson"), 0);
  EXPECT_EQ(get("st_still"), 1);
  enable() = false;
  tick();
  EXPECT_EQ(get("posit"), 0);
  enable() = true;
  tick();
  EXPECT_EQ(get("st_prsok"), 1);
  EXPECT_EQ(get("posit"), 700);
  count() += 40;
  tick();
  EXPECT_EQ(get("posit"), 700);  // the load goes on
  enable() = false;
  count() += 40;
  tick();
  EXPECT_EQ(get("posit"), 740);
  command("CNTLOCK");
  enable() = true;
  tick();
  EXPECT_EQ(get("posit"), 740);
}

}  // namespace
}  // namespace drycut::devices::oopos2
