#include <gmock/gmock.h>

#include <utility>

#include "tests/devices/camming4/covers.hpp"
#include "tests/devices/camming4/fixture.hpp"

namespace drycut::devices::camming4 {
namespace {

/// The commands that change what drives the output and how the axes count.
using Camming4Commands = Camming4Test;

TEST_F(Camming4Commands, CommandsSetTheirStates) {
  does("INIT LOOPON");
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
  shows("silent !warning");
}

// What lock and direction do to the count is in positioners_test.cpp; here each of both counts on its own.
TEST_F(Camming4Commands, EachCountHasItsLockAndItsDirection) {
  does("INIT");
  const auto moved = [&] {
    const int slave_before = get("posit");
    const int master_before = get("positm");
    does("count+=10 +1*100");
    return std::pair(get("posit") - slave_before, get("positm") - master_before);
  };
  does("blocked=1");
  EXPECT_EQ(moved(), std::pair(10, 100));
  does("CNTREV");
  EXPECT_EQ(moved(), std::pair(-10, 100));
  does("CNTREVM");
  EXPECT_EQ(moved(), std::pair(-10, -100));
  does("CNTLOCK");
  EXPECT_EQ(moved(), std::pair(0, -100));
  does("CNTLOCKM");
  EXPECT_EQ(moved(), std::pair(0, 0));
  does("CNTUNLOCKM");
  EXPECT_EQ(moved(), std::pair(0, -100));
  does("CNTUNLOCK CNTDIR CNTDIRM");
  EXPECT_EQ(moved(), std::pair(10, 100));
  covers({"st_cntlock", "st_cntrev", "st_cntlockm", "st_cntrevm"});
}

TEST_F(Camming4Commands, AnEmergencyInCalibrationDoesNotBringTheVoltageBack) {
  for (const bool same_sample : {false, true}) {
    SCOPED_TRACE(same_sample);
    after("power INIT LOOPON blocked=1 CALON vout=50 sample", "DAC=16384");
    does("EMRG!");
    if (!same_sample) {
      after("sample", "DAC=0 vout=0");
      does("+10");
    }
    after("RESUME", "cal vout=0 DAC=0");
    after("+10", "DAC=0");
  }
  covers({"EMRG accepted"});
}

TEST_F(Camming4Commands, RegulationOffInCalibrationGoesOnWithItsVoltage) {
  does("offset=500 INIT LOOPON blocked=1 CALON vout=20 sample");
  EXPECT_EQ(word(), 6553 + 500);
  does("REGOFF vout=30 sample");
  EXPECT_EQ(word(), 6553 + 500);
  does("vout=20 sample REGON");
  EXPECT_EQ(word(), 6553 + 500);
  covers({"offset", "REGOFF accepted", "REGON accepted"});
}

TEST_F(Camming4Commands, AfterCalibrationTheRegulatorBeginsAnew) {
  after("pgain=0 feedfw=0 integt=20 INIT LOOPON blocked=1 count+=-10 +20", "intreg>6000");
  for (const auto& [off, on] : {std::pair{"CALON", "CALOFF"}, {"REGOFF", "REGON"}, {"EMRG", "RESUME"}}) {
    SCOPED_TRACE(on);
    command(off);
    does("count+=-40");
    command(on);
    shows("follerr=0 intreg=0");
    does("count+=-10 +20");
  }
}

TEST_F(Camming4Commands, TheVoltageOfCalibrationStaysAsItWasWritten) {
  after("offset=500 INIT LOOPON blocked=1 CALON vout=20 +5", "vout=20");
  EXPECT_EQ(word(), 6553 + 500);
  after("vout=100 +5", "DAC=32767 !warning");  // nobody regulates
  covers({"st_cal"});
}

TEST_F(Camming4Commands, SaturationBelowIsWarningFour) {
  after("pgain=1000 INIT LOOPON blocked=1 count=100 sample", "DAC=-32767 !warning");
  after("count=101 sample", "wrncode=4");
  after("count=0 +5", "wrncode=4");  // latched
  after("RSWRN", "!warning");
  after("count=-101 sample", "wrncode=3");
  covers({"warning 3", "warning 4"});
}

TEST_F(Camming4Commands, AFrozenOutputDoesNotSaturateAgain) {
  after("pgain=1000 INIT LOOPON blocked=1 count=-200 sample REGOFF RSWRN +5", "DAC=32767 !warning");
}

TEST_F(Camming4Commands, LoopOnInAPlacementStillArrives) {
  after("setpos=3000 feedfw=900 INIT START +100", "follerr>50");
  after("LOOPON", "follerr<15");
  after("until:still", "posit=3000~30");  // the profile itself ends there
  after("+200", "posit=3000~1 toll");
  covers({"st_loopon"});
}

}  // namespace
}  // namespace drycut::devices::camming4
