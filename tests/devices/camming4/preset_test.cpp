#include <gmock/gmock.h>

#include "tests/devices/camming4/covers.hpp"
#include "tests/devices/camming4/fixture.hpp"

namespace drycut::devices::camming4 {
namespace {

// Presets (spec 5.11). The enable is active from 2000 Um on, or up to 2200 Um.
class Camming4Preset : public Camming4Test {
 protected:
  static constexpr const char* enable = "2.INP01";
  static constexpr const char* enable_master = "2.INP02";
  static constexpr int zero_line = 1;
  static constexpr int zero_line_master = 2;
  std::int64_t from = 2000;
  std::int64_t to = 1000000;
  void track(int count = 1) {
    for (int i = 0; i < count; ++i) {
      input(enable) = slave().count >= from && slave().count < to;
      tick();
    }
  }
  bool search_ends() {
    for (int i = 0; i < 20000 && get("st_prson") == 1; ++i) track();
    return get("st_prson") == 0;
  }
};

TEST_F(Camming4Preset, ModeZeroLoadsAtTheEnablesRelease) {
  set({{"prspos", 700}, {"pgain", 500}});
  start();
  command("PRESET");
  EXPECT_EQ(get("st_prson"), 1);
  EXPECT_EQ(get("st_still"), 0);
  track(60);
  EXPECT_EQ(get("setvel"), 5000);
  EXPECT_EQ(get("ffwdreg"), 3277);
  ASSERT_TRUE(search_ends());
  EXPECT_EQ(get("st_prsok"), 1);
  EXPECT_EQ(get("st_still"), 1);
  EXPECT_EQ(get("setvel"), 1000);
  EXPECT_EQ(get("setpos"), 700);
  track(200);
  EXPECT_NEAR(get("posit"), 700, 1);
  // The quota 700 lies where the slow leg left the enable, within the way of one sample (2 Um).
  EXPECT_NEAR(static_cast<double>(slave().count), 1999, 3);
  covers({"PRESET accepted", "prspos", "prsvel", "sprsvel", "prsmode", "st_prson", "st_prsok"});
}

TEST_F(Camming4Preset, ModeZeroBackwardCrossesAShortEnable) {
  from = -1010;
  to = -1000;
  set({{"prspos", -50}, {"prsdir", 1}, {"minpos", -100}, {"maxpos", 100}, {"pgain", 500}});
  start();
  command("PRESET");
  ASSERT_TRUE(search_ends());  // the limits do not count meanwhile
  track(200);
  EXPECT_NEAR(get("posit"), -50, 1);
  // It ran over the enable, came back forward and left it at its upper end.
  EXPECT_NEAR(static_cast<double>(slave().count), -1000, 3);
  covers({"prsdir"});
}

TEST_F(Camming4Preset, ModeOneLoadsAtTheFirstZeroPulseAfterIt) {
  set({{"prspos", 0}, {"prsmode", 1}, {"pgain", 500}});
  start();
  command("PRESET");
  bool seen = false;
  std::int64_t pulse = 0;
  for (int i = 0; i < 20000 && get("st_prson") == 1; ++i) {
    const std::int64_t before = slave().count;
    track();
    // A zero pulse each 512 bits: its exact count is latched between two samples.
    const std::int64_t mark = slave().count / 512 * 512;
    if (before > mark && slave().count <= mark + 1 && !seen) {
      for (auto& [address, counter] : cards.counters) counter.latched = mark;
      device.interrupt(zero_line, true);
      if (slave().count < from) {
        pulse = mark;
        seen = true;
      }
    }
  }
  EXPECT_EQ(pulse, 1536);
  EXPECT_EQ(get("st_prsok"), 1);
  track(100);
  EXPECT_EQ(get("posit"), slave().count - 1536);
  covers({"prsmode"});
}

TEST_F(Camming4Preset, StartsWithTheSlowLegInsideTheEnable) {
  from = -400;
  set({{"prspos", 10}, {"pgain", 500}});
  start();
  track(2);
  command("PRESET");
  track(60);
  EXPECT_EQ(get("setvel"), 1000);
  EXPECT_EQ(get("ffwdreg"), -655);
  ASSERT_TRUE(search_ends());
}

TEST_F(Camming4Preset, PresetAgainTurnsTheSearch) {
  from = 1000000;
  start();
  command("PRESET");
  track(100);
  EXPECT_GT(get("ffwdreg"), 0);
  command("PRESET");
  track(150);
  EXPECT_LT(get("ffwdreg"), 0);
  EXPECT_EQ(get("st_prson"), 1);
  command("STOP");
  EXPECT_EQ(get("st_prson"), 0);
  EXPECT_EQ(get("st_prsok"), 0);
  EXPECT_TRUE(wait("st_still", 1));
}

TEST_F(Camming4Preset, ModeTwoLoadsAtTheEnableAfterARelease) {
  set({{"prspos", 99}, {"prsmode", 2}});
  input(enable) = true;
  start();
  ticks(5);
  EXPECT_EQ(get("st_prsok"), 0);
  input(enable) = false;
  ticks(2);
  input(enable) = true;
  tick();
  EXPECT_EQ(get("st_prsok"), 1);
  EXPECT_EQ(get("posit"), 99);
  command("RSPRSOK");
  EXPECT_EQ(get("st_prsok"), 0);
  command("PRESET");
  EXPECT_EQ(get("st_prson"), 0);
  covers({"RSPRSOK accepted", "st_prsok"});
}

TEST_F(Camming4Preset, MasterPresetModeZero) {
  write("prsposm", 5000);
  start();
  input(enable_master) = true;
  tick(10);
  input(enable_master) = false;
  tick(10);
  EXPECT_EQ(get("positm"), 20);  // nobody asked
  command("PRESETM");
  EXPECT_EQ(get("st_prsonm"), 1);
  input(enable_master) = true;
  tick(10);
  EXPECT_EQ(get("st_prsonm"), 1);
  input(enable_master) = false;
  tick(10);
  EXPECT_EQ(get("positm"), 5000);
  EXPECT_EQ(get("st_prsokm"), 1);
  EXPECT_EQ(get("st_prsonm"), 0);
  command("RSPRSM");
  EXPECT_EQ(get("st_prsokm"), 0);
  covers({"PRESETM accepted", "RSPRSM accepted", "prsposm", "prsmodem", "st_prsonm", "st_prsokm"});
}

TEST_F(Camming4Preset, MasterPresetModeOneTakesTheLatchedCount) {
  set({{"prsposm", 100}, {"prsmodem", 1}});
  start();
  command("PRESETM");
  input(enable_master) = true;
  tick(10);
  edge(zero_line_master, true);
  tick(10);
  EXPECT_EQ(get("st_prsonm"), 1);  // the enable is not released
  input(enable_master) = false;
  tick(10);
  edge(zero_line_master, true);
  tick(7);
  EXPECT_EQ(get("positm"), 107);
  EXPECT_EQ(get("st_prsokm"), 1);
}

TEST_F(Camming4Preset, MasterPresetModeTwoNeedsNoCommand) {
  set({{"prsposm", 100}, {"prsmodem", 2}});
  start();
  ticks(3, 5);
  input(enable_master) = true;
  tick(5);
  EXPECT_EQ(get("positm"), 100);
  tick(5);
  EXPECT_EQ(get("positm"), 105);
}

TEST_F(Camming4Preset, RsprsmEndsTheMasterSearch) {
  start();
  command("PRESETM");
  command("RSPRSM");
  EXPECT_EQ(get("st_prsonm"), 0);
  input(enable_master) = true;
  tick();
  input(enable_master) = false;
  tick();
  EXPECT_EQ(get("st_prsokm"), 0);
}

}  // namespace
}  // namespace drycut::devices::camming4
