#include <gmock/gmock.h>

#include "tests/devices/epicpos/fixture.hpp"

namespace drycut::devices::epicpos {
namespace {

using testing::IsEmpty;

// The preset search (002 1.2.5; spec 5.11). The enable is active from `from` to `to`; a zero pulse each 512
// bits latches its exact count.
class EpicposPreset : public PositionerTest {
 protected:
  EpicposPreset() { write("pgain", 500); }
  std::int64_t from = 2000;
  std::int64_t to = 1000000;
  std::vector<std::int64_t> pulses;
  void track(int number = 1) {
    for (int i = 0; i < number; ++i) {
      enable() = count() >= from && count() < to;
      const std::int64_t before = count();
      tick();
      // The last multiple of 512 that was crossed, whichever way.
      const std::int64_t mark = (std::max(before, count()) + 512000) / 512 * 512 - 512000;
      if (mark <= std::min(before, count()) || before == count()) continue;
      cards.counters.at(address).latched = mark;
      device->interrupt(zero_line, true);
      pulses.push_back(mark);
    }
  }
  bool search_ends() {
    for (int i = 0; i < 20000 && get("st_prson") == 1; ++i) track();
    return get("st_prson") == 0;
  }
};

TEST_F(EpicposPreset, ModeZeroLoadsAtTheEnablesRelease) {
  covers({"prsmode", "prspos", "prsvel", "sprsvel", "st_prson", "st_prsok", "PRESET accepted"});
  write("prspos", 700);
  start();
  command("PRESET");
  EXPECT_EQ(get("st_prson"), 1);
  EXPECT_EQ(get("st_still"), 0);
  track(60);
  EXPECT_NEAR(speed(), 5000, 1);
  EXPECT_EQ(get("setvel"), 5000);
  double slowest = 0;
  while (get("st_prson") == 1 && samples < 20000) {
    track();
    slowest = std::min(slowest, speed());
  }
  EXPECT_NEAR(slowest, -1000, 1);
  EXPECT_EQ(get("st_prsok"), 1);
  EXPECT_EQ(get("st_prson"), 0);
  EXPECT_EQ(get("st_still"), 1);
  EXPECT_EQ(get("setvel"), 1000);
  EXPECT_EQ(get("setpos"), 700);
  track(200);
  EXPECT_NEAR(get("posit"), 700, 1);
  // 700 lies where the slow leg left the enable, to the way of one sample (2 Um).
  EXPECT_NEAR(static_cast<double>(count()), 1999, 3);
  EXPECT_THAT(diagnostics(), IsEmpty());
}

TEST_F(EpicposPreset, ModeZeroBackwardBeyondTheLimits) {
  covers({"prsdir"});
  from = -1010;
  to = -1000;
  set({{"prspos", -50}, {"prsdir", 1}, {"minpos", -100}, {"maxpos", 100}});
  start();
  command("PRESET");
  track(60);
  EXPECT_EQ(get("st_movdir"), 1);
  ASSERT_TRUE(search_ends());
  track(200);
  EXPECT_NEAR(get("posit"), -50, 1);
  // It ran over the enable, came back forward and left it at its upper end.
  EXPECT_NEAR(static_cast<double>(count()), -1000, 3);
}

TEST_F(EpicposPreset, ModeOneLoadsAtTheFirstZeroPulseAfterTheRelease) {
  set({{"prspos", 0}, {"prsmode", 1}});
  start();
  command("PRESET");
  ASSERT_TRUE(search_ends());
  EXPECT_EQ(get("st_prsok"), 1);
  track(200);
  // Below 2000 the first pulse is at 1536, and its exact count is the quota.
  EXPECT_EQ(get("posit"), count() - 1536);
  EXPECT_NEAR(get("posit"), 0, 1);
}

TEST_F(EpicposPreset, ModeOneBackward) {
  from = -1000000;
  to = -2000;
  set({{"prspos", 100}, {"prsmode", 1}, {"prsdir", 1}});
  start();
  command("PRESET");
  ASSERT_TRUE(search_ends());
  track(200);
  EXPECT_EQ(get("posit"), 100 + count() + 1536);
}

TEST_F(EpicposPreset, InsideTheEnableTheSlowLegIsFirst) {
  from = -400;
  write("prspos", 10);
  start();
  track(2);
  command("PRESET");
  track(60);
  EXPECT_NEAR(speed(), -1000, 1);
  ASSERT_TRUE(search_ends());
  EXPECT_NEAR(static_cast<double>(count()), -401, 4);
}

TEST_F(EpicposPreset, PresetAgainTurnsTheSearch) {
  from = 1000000;
  start();
  command("PRESET");
  track(100);
  EXPECT_GT(speed(), 0);
  command("PRESET");
  track(150);
  EXPECT_NEAR(speed(), -5000, 1);
  EXPECT_EQ(get("st_prson"), 1);
  command("STOP");
  EXPECT_EQ(get("st_prson"), 0);
  EXPECT_EQ(get("st_prsok"), 0);
  EXPECT_TRUE(wait("st_still", 1));
}

TEST_F(EpicposPreset, ANewSearchClearsTheOldResult) {
  start();
  command("PRESET");
  ASSERT_TRUE(search_ends());
  ASSERT_EQ(get("st_prsok"), 1);
  command("PRESET");
  EXPECT_EQ(get("st_prsok"), 0);
  device->power_up();
  EXPECT_EQ(get("st_prsok"), 0);
}

TEST_F(EpicposPreset, TheTurnsPauseForTinvt) {
  write("tinvt", 50);
  start();
  command("PRESET");
  while (!enable() && samples < 5000) track();
  while (std::abs(speed()) > 0.5 && samples < 5000) track();
  long still = 0;
  for (; std::abs(speed()) < 0.5 && still < 5000; ++still) track();
  EXPECT_NEAR(static_cast<double>(still), 250, 5);
  EXPECT_TRUE(search_ends());
}

TEST_F(EpicposPreset, ALockedCountIsNotLoaded) {
  for (const int mode : {0, 1}) {
    device->power_up();
    count() = 0;
    set({{"prspos", 700}, {"prsmode", mode}, {"posit", 0}, {"pgain", 0}});  // a locked loop would run away
    start();
    command("PRESET");
    track(60);
    command("CNTLOCK");
    const int posit = get("posit");
    track(1500);
    EXPECT_LT(count(), from - 600);  // released, and past a zero pulse
    EXPECT_EQ(get("st_prson"), 1);
    EXPECT_EQ(get("st_prsok"), 0);
    EXPECT_EQ(get("posit"), posit);
    command("CNTUNLOCK");
    track(600);
    EXPECT_EQ(get("st_prson"), mode == 0 ? 1 : 0);  // mode 1: the next zero pulse loads
  }
}

TEST_F(EpicposPreset, ModeTwoLoadsWhileTheEnableIsActive) {
  set({{"prspos", 99}, {"prsmode", 2}});
  enable() = true;
  start();
  for (int i = 0; i < 5; ++i) tick();
  EXPECT_EQ(get("st_prsok"), 0);  // active at power-up: released first
  command("PRESET");
  EXPECT_EQ(get("st_prson"), 0);
  enable() = false;
  command("LOOPOFF");
  tick();
  EXPECT_EQ(get("posit"), 0);
  enable() = true;
  tick();
  EXPECT_EQ(get("st_prsok"), 1);
  EXPECT_EQ(get("posit"), 99);
  count() += 40;
  sample();
  EXPECT_EQ(get("posit"), 99);  // the load goes on
  enable() = false;
  count() += 40;
  sample();
  EXPECT_EQ(get("posit"), 139);
  command("CNTLOCK");
  enable() = true;
  tick();
  EXPECT_EQ(get("posit"), 139);
  EXPECT_EQ(get("st_still"), 1);
}

TEST_F(EpicposPreset, AnOpenLoopGoesToTheQuotaFromWhereTheAxisStands) {
  // The axis is a tenth faster than maxvel says: theory is far from it when the search is over.
  set({{"prspos", 700}, {"maxvel", 45455}});
  command("INIT");
  command("PRESET");
  ASSERT_TRUE(search_ends());
  EXPECT_NEAR(get("posit"), 700, 4);  // a tenth of the way that the axis ran out from the load
}

TEST_F(EpicposPreset, AnotherLineIsNoZeroPulse) {
  set({{"prsmode", 1}, {"pgain", 500}});
  from = 300;
  start();
  command("PRESET");
  for (int i = 0; i < 20000 && count() > -100; ++i) {
    enable() = count() >= from;
    tick();
    cards.counters.at(address).latched = count();
    device->interrupt(zero_line + 1, true);
    device->interrupt(zero_line, false);
    if (enable()) i = 0;
    if (samples > 3000) break;
  }
  EXPECT_EQ(get("st_prson"), 1);
  EXPECT_EQ(get("st_prsok"), 0);
}

}  // namespace
}  // namespace drycut::devices::epicpos
