#include <gmock/gmock.h>

#include <utility>

#include "tests/devices/camming4/covers.hpp"
#include "tests/devices/camming4/fixture.hpp"

namespace drycut::devices::camming4 {
namespace {

using testing::IsEmpty;

/// The commands that change what drives the output and how the axes count.
using Camming4Commands = Camming4Test;

TEST_F(Camming4Commands, CommandsSetTheirStates) {
  start();
  const struct {
    const char* command;
    const char* state;
    int value;
  } effects[] = {
      {"CNTLOCK", "st_cntlock", 1}, {"CNTUNLOCK", "st_cntlock", 0}, {"CNTREV", "st_cntrev", 1},
      {"CNTDIR", "st_cntrev", 0},   {"CNTLOCKM", "st_cntlockm", 1}, {"CNTUNLOCKM", "st_cntlockm", 0},
      {"CNTREVM", "st_cntrevm", 1}, {"CNTDIRM", "st_cntrevm", 0},   {"LOOPOFF", "st_loopon", 0},
      {"LOOPON", "st_loopon", 1},   {"CALON", "st_cal", 1},         {"CALOFF", "st_cal", 0},
      {"REGOFF", "st_regoff", 1},   {"REGON", "st_regoff", 0},      {"EMRG", "st_emrg", 1},
      {"RESUME", "st_emrg", 0},     {"PRESETM", "st_prsonm", 1},    {"RSPRSM", "st_prsonm", 0}};
  for (const auto& [name, state, value] : effects) {
    EXPECT_NE(get(state), value) << name;
    command(name);
    EXPECT_EQ(get(state), value) << name;
    covers({std::string(name) + " accepted", state});
  }
  EXPECT_THAT(diagnostics(), IsEmpty());
  EXPECT_EQ(get("st_warning"), 0);
}

// What the locks and directions do to the counts is in camming4_regulation_test.cpp; here each on its own.
TEST_F(Camming4Commands, EachCountHasItsLockAndItsDirection) {
  command("INIT");
  const auto moved = [&] {
    const int slave_before = get("posit");
    const int master_before = get("positm");
    slave().count += 10;
    tick(100);
    return std::pair(get("posit") - slave_before, get("positm") - master_before);
  };
  slave_blocked = true;
  EXPECT_EQ(moved(), std::pair(10, 100));
  command("CNTREV");
  EXPECT_EQ(moved(), std::pair(-10, 100));
  command("CNTREVM");
  EXPECT_EQ(moved(), std::pair(-10, -100));
  command("CNTLOCK");
  EXPECT_EQ(moved(), std::pair(0, -100));
  command("CNTLOCKM");
  EXPECT_EQ(moved(), std::pair(0, 0));
  command("CNTUNLOCKM");
  EXPECT_EQ(moved(), std::pair(0, -100));
  for (const char* name : {"CNTUNLOCK", "CNTDIR", "CNTDIRM"}) command(name);
  EXPECT_EQ(moved(), std::pair(10, 100));
  covers({"st_cntlock", "st_cntrev", "st_cntlockm", "st_cntrevm"});
}

TEST_F(Camming4Commands, AnEmergencyInCalibrationDoesNotBringTheVoltageBack) {
  for (const bool same_sample : {false, true}) {
    SCOPED_TRACE(same_sample);
    device.power_up();
    start();
    slave_blocked = true;
    command("CALON");
    write("vout", 50);
    sample();
    EXPECT_EQ(word(), 16384);
    order("EMRG");
    if (!same_sample) {
      sample();
      EXPECT_EQ(word(), 0);
      EXPECT_EQ(get("vout"), 0);
      ticks(10);
    }
    command("RESUME");
    EXPECT_EQ(get("st_cal"), 1);
    EXPECT_EQ(get("vout"), 0);
    EXPECT_EQ(word(), 0);
    ticks(10);
    EXPECT_EQ(word(), 0);
  }
  covers({"vout", "EMRG accepted", "RESUME accepted", "CALON accepted"});
}

TEST_F(Camming4Commands, RegulationOffInCalibrationGoesOnWithItsVoltage) {
  write("offset", 500);
  start();
  slave_blocked = true;
  command("CALON");
  write("vout", 20);
  sample();
  EXPECT_EQ(word(), 6553 + 500);
  command("REGOFF");
  write("vout", 30);
  sample();
  EXPECT_EQ(word(), 6553 + 500);
  write("vout", 20);
  sample();
  command("REGON");
  EXPECT_EQ(word(), 6553 + 500);
  covers({"offset", "REGOFF accepted", "REGON accepted"});
}

TEST_F(Camming4Commands, AfterCalibrationTheRegulatorBeginsAnew) {
  set({{"pgain", 0}, {"feedfw", 0}, {"integt", 20}});
  start();
  slave_blocked = true;
  slave().count -= 10;
  ticks(20);
  EXPECT_GT(get("intreg"), 6000);
  for (const auto& [off, on] : {std::pair{"CALON", "CALOFF"}, {"REGOFF", "REGON"}, {"EMRG", "RESUME"}}) {
    SCOPED_TRACE(on);
    command(off);
    slave().count -= 40;
    command(on);
    EXPECT_EQ(get("follerr"), 0);
    EXPECT_EQ(get("intreg"), 0);
    slave().count -= 10;
    ticks(20);
  }
}

TEST_F(Camming4Commands, TheVoltageOfCalibrationStaysAsItWasWritten) {
  write("offset", 500);
  start();
  slave_blocked = true;
  command("CALON");
  write("vout", 20);
  ticks(5);
  EXPECT_EQ(get("vout"), 20);
  EXPECT_EQ(word(), 6553 + 500);
  write("vout", 100);
  ticks(5);
  EXPECT_EQ(word(), 32767);
  EXPECT_EQ(get("st_warning"), 0);  // nobody regulates
  covers({"vout", "st_cal"});
}

TEST_F(Camming4Commands, SaturationBelowIsWarningFour) {
  write("pgain", 1000);
  start();
  slave_blocked = true;
  slave().count = 100;
  sample();
  EXPECT_EQ(word(), -32767);
  EXPECT_EQ(get("st_warning"), 0);
  slave().count = 101;
  sample();
  EXPECT_EQ(get("wrncode"), 4);
  slave().count = 0;
  ticks(5);
  EXPECT_EQ(get("wrncode"), 4);  // latched
  command("RSWRN");
  EXPECT_EQ(get("st_warning"), 0);
  slave().count = -101;
  sample();
  EXPECT_EQ(get("wrncode"), 3);
  covers({"warning 3", "warning 4", "st_warning", "wrncode", "RSWRN accepted"});
}

TEST_F(Camming4Commands, AFrozenOutputDoesNotSaturateAgain) {
  write("pgain", 1000);
  start();
  slave_blocked = true;
  slave().count = -200;
  sample();
  command("REGOFF");
  command("RSWRN");
  ticks(5);
  EXPECT_EQ(word(), 32767);
  EXPECT_EQ(get("st_warning"), 0);
}

TEST_F(Camming4Commands, LoopOnInAPlacementStillArrives) {
  set({{"setpos", 3000}, {"feedfw", 900}});
  command("INIT");
  command("START");
  ticks(100);
  EXPECT_GT(get("follerr"), 50);
  command("LOOPON");
  EXPECT_LT(get("follerr"), 15);
  ASSERT_TRUE(wait("st_still", 1));
  EXPECT_NEAR(get("posit"), 3000, 30);  // the profile itself ends there
  ticks(200);
  EXPECT_NEAR(get("posit"), 3000, 1);
  EXPECT_EQ(get("st_toll"), 1);
  covers({"LOOPON accepted", "st_loopon"});
}

}  // namespace
}  // namespace drycut::devices::camming4
