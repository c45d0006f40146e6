#include <gmock/gmock.h>

#include <algorithm>

#include "tests/devices/camming4/covers.hpp"
#include "tests/devices/camming4/fixture.hpp"

namespace drycut::devices::camming4 {
namespace {

/// Preset searches (spec 5.11) over an enable from `from` to `to`, with a zero pulse every 512 bits.
class Camming4Search : public Camming4Test {
 protected:
  std::int64_t from = 2000;
  std::int64_t to = 1000000;
  bool rising = true;            ///< edges of the zero pulse that come
  std::int64_t released_at = 0;  ///< count of the sample that saw the last release

  void prepare() {
    set({{"prspos", 70}, {"pgain", 500}});
    start();
  }
  void track(int count = 1) {
    for (int i = 0; i < count; ++i) {
      bool& enable = input("2.INP01");
      const bool was = enable;
      enable = slave().count >= from && slave().count < to;
      const std::int64_t before = slave().count;
      tick();
      if (was && !enable) released_at = slave().count;
      pulse_between(before, slave().count);
    }
  }
  bool until(const char* state, int value) {
    for (int i = 0; i < 20000 && get(state) != value; ++i) track();
    return get(state) == value;
  }
  /// The count that got the quota prspos.
  std::int64_t loaded_at() { return slave().count - (get("posit") - 70); }

 private:
  /// The zero pulse that the way to the last sample passed, seen before the next one.
  void pulse_between(std::int64_t before, std::int64_t now) {
    const auto turn = [](std::int64_t count) { return count / 512 - (count % 512 < 0 ? 1 : 0); };
    if (turn(before) == turn(now)) return;
    slave().latched = std::max(turn(before), turn(now)) * 512;
    device.interrupt(1, rising);
  }
};

TEST_F(Camming4Search, BothModesLoadWhereTheyShouldInBothDirections) {
  for (const int mode : {0, 1})
    for (const bool backward : {false, true}) {
      SCOPED_TRACE(mode * 10 + (backward ? 1 : 0));
      device.power_up();
      slave().count = 0;
      from = backward ? -1000000 : 2000;
      to = backward ? -2000 : 1000000;
      set({{"prsmode", mode}, {"prsdir", backward ? 1 : 0}});
      prepare();
      command("PRESET");
      track(60);
      EXPECT_EQ(get("ffwdreg"), backward ? -3277 : 3277);  // prsvel
      EXPECT_EQ(get("setvel"), 5000);
      ASSERT_TRUE(until("st_dec", 1));
      ASSERT_TRUE(until("st_vconst", 1));
      EXPECT_EQ(get("ffwdreg"), backward ? 655 : -655);  // sprsvel
      EXPECT_EQ(get("st_chvel"), 0);
      ASSERT_TRUE(until("st_prson", 0));
      track(100);
      EXPECT_EQ(get("st_prsok"), 1);
      EXPECT_EQ(get("st_still"), 1);
      EXPECT_EQ(get("setpos"), 70);
      EXPECT_NEAR(get("posit"), 70, 1);
      EXPECT_EQ(loaded_at(), mode == 0 ? released_at : backward ? -1536 : 1536);
    }
  covers({"prsmode", "prsdir", "prsvel", "sprsvel", "prspos", "st_prsok", "st_prson", "PRESET accepted"});
}

TEST_F(Camming4Search, PresetInTheSlowLegTurnsItToTheOtherEndOfTheEnable) {
  to = 2600;
  prepare();
  command("PRESET");
  ASSERT_TRUE(until("st_dec", 1));
  ASSERT_TRUE(until("st_vconst", 1));  // backward, slowly
  command("PRESET");
  ASSERT_TRUE(until("st_prson", 0));
  track(100);
  EXPECT_NEAR(static_cast<double>(loaded_at()), 2601, 2);
  EXPECT_EQ(loaded_at(), released_at);
}

TEST_F(Camming4Search, PresetWhileItTurnsTurnsTheSlowLeg) {
  to = 2600;
  prepare();
  command("PRESET");
  ASSERT_TRUE(until("st_dec", 1));
  track(10);
  command("PRESET");
  ASSERT_TRUE(until("st_prson", 0));
  track(100);
  EXPECT_NEAR(static_cast<double>(loaded_at()), 2601, 2);
}

TEST_F(Camming4Search, TurnedByTheProgramIntoTheEnableItLeavesItTheWayBack) {
  prepare();
  command("PRESET");
  while (slave().count < 1900) track();
  command("PRESET");
  EXPECT_LT(slave().count, 2000);
  ASSERT_TRUE(until("st_prson", 0));
  track(100);
  EXPECT_NEAR(static_cast<double>(loaded_at()), 1998, 3);
  EXPECT_EQ(get("st_prsok"), 1);
}

TEST_F(Camming4Search, PresetInTheLastPlacementChangesNothing) {
  prepare();
  command("PRESET");
  ASSERT_TRUE(until("st_dec", 1));
  ASSERT_TRUE(until("st_vconst", 1));
  while (released_at == 0) track();
  track(3);
  command("PRESET");
  ASSERT_TRUE(until("st_prson", 0));
  EXPECT_EQ(get("st_prsok"), 1);
  EXPECT_EQ(loaded_at(), released_at);
}

TEST_F(Camming4Search, ItsSpeedsAreItsOwn) {
  prepare();
  command("PRESET");
  track(60);
  set({{"setvel", 100}, {"setpos", 12345}, {"tacc", 1}});
  track(20);
  EXPECT_EQ(get("ffwdreg"), 3277);
  EXPECT_EQ(get("setvel"), 5000);
  EXPECT_EQ(get("setpos"), 70);
}

TEST_F(Camming4Search, EmergencyAndCalibrationEndIt) {
  for (const char* name : {"EMRG", "CALON"}) {
    device.power_up();
    prepare();
    command("PRESET");
    track(30);
    command(name);
    EXPECT_EQ(get("st_prson"), 0);
    EXPECT_EQ(get("st_still"), 1);
    EXPECT_EQ(word(), 0);
    command("RESUME");
    command("CALOFF");
    track(30);
    EXPECT_EQ(get("st_still"), 1);
    EXPECT_EQ(get("st_prsok"), 0);
  }
}

TEST_F(Camming4Search, TheMastersZeroPulseLoadsItsExactCountOnce) {
  set({{"prsposm", 1000}, {"prsmodem", 1}});
  start();
  command("PRESETM");
  input("2.INP02") = true;
  tick(10);
  input("2.INP02") = false;
  tick(10);
  // Two pulses before the sample: the first counts.
  master().count += 5;
  edge(2, true);
  master().count += 20;
  edge(2, true);
  tick(0);
  EXPECT_EQ(get("positm"), 1020);
  EXPECT_EQ(get("st_prsonm"), 0);
  EXPECT_EQ(get("st_prsokm"), 1);
  edge(2, true);
  tick(3);
  EXPECT_EQ(get("positm"), 1023);
  // A new search needs its own release.
  command("PRESETM");
  EXPECT_EQ(get("st_prsokm"), 0);
  edge(2, true);
  tick(3);
  EXPECT_EQ(get("st_prsonm"), 1);
  covers({"prsmodem", "prsposm", "st_prsonm", "st_prsokm"});
}

TEST_F(Camming4Search, ThePulsesFallingEdgeIsNone) {
  set({{"prsposm", 1000}, {"prsmodem", 1}, {"prsmode", 1}});
  start();
  command("PRESETM");
  input("2.INP02") = true;
  tick();
  input("2.INP02") = false;
  tick();
  edge(2, false);
  tick();
  EXPECT_EQ(get("st_prsonm"), 1);
  rising = false;
  command("PRESET");
  while (released_at == 0) track();
  track(1000);
  EXPECT_EQ(get("st_prson"), 1);
}

TEST_F(Camming4Search, TheMastersModeZeroLoadsAtTheRelease) {
  set({{"prsposm", 1000}, {"prsmodem", 0}});
  start();
  command("PRESETM");
  edge(2, true);
  tick(5);
  EXPECT_EQ(get("st_prsonm"), 1);
  input("2.INP02") = true;
  tick(5);
  EXPECT_EQ(get("st_prsonm"), 1);
  input("2.INP02") = false;
  tick(5);
  EXPECT_EQ(get("positm"), 1000);
}

TEST_F(Camming4Search, TheMastersModeTwoLoadsAtEachActivation) {
  set({{"prsposm", 1000}, {"prsmodem", 2}});
  input("2.INP02") = true;  // active at power-up: it must be released first
  start();
  ticks(3, 5);
  EXPECT_EQ(get("st_prsokm"), 0);
  command("PRESETM");
  EXPECT_EQ(get("st_prsonm"), 0);
  for (int i = 0; i < 2; ++i) {
    input("2.INP02") = false;
    ticks(3, 5);
    input("2.INP02") = true;
    tick(5);
    EXPECT_EQ(get("positm"), 1000);
    EXPECT_EQ(get("st_prsokm"), 1);
    command("RSPRSM");
    EXPECT_EQ(get("st_prsokm"), 0);
  }
}

}  // namespace
}  // namespace drycut::devices::camming4
