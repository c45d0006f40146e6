#include "tests/devices/camming4/fixture.hpp"
#include "tests/devices/search_bench.hpp"

namespace drycut::devices::camming4 {
namespace {

// Presets (spec 5.11). The enable is active from 2000 Um on, or up to 2200 Um.
class Camming4Preset : public SearchBench<Camming4Test, 512, 1> {
 public:
  Camming4Preset() : SearchBench(2000, 1000000) {}
};

TEST_F(Camming4Preset, ModeZeroLoadsAtTheEnablesRelease) {
  after("prspos=700 pgain=500 INIT LOOPON PRESET", "prson !still");
  after("+60", "setvel=5000 ffwdreg=3277");
  after("until:!prson", "prsok still setvel=1000 setpos=700");
  after("+200", "posit=700~1");
  // The quota 700 lies where the slow leg left the enable, within the way of one sample (2 Um).
  shows("count=1999~3");
  covers({"prspos", "prsvel", "sprsvel", "prsmode"});
}

TEST_F(Camming4Preset, ModeZeroBackwardCrossesAShortEnable) {
  from = -1010;
  to = -1000;
  // The limits do not count meanwhile.
  does("prspos=-50 prsdir=1 minpos=-100 maxpos=100 pgain=500 INIT LOOPON PRESET");
  after("until:!prson +200", "posit=-50~1");
  // It ran over the enable, came back forward and left it at its upper end.
  shows("count=-1000~3");
  covers({"prsdir"});
}

TEST_F(Camming4Preset, ModeOneLoadsAtTheFirstZeroPulseAfterIt) {
  after("prspos=0 prsmode=1 pgain=500 INIT LOOPON PRESET until:!prson", "prsok");
  does("+100");
  EXPECT_EQ(get("posit"), count() - 1536);
  covers({"prsmode"});
}

TEST_F(Camming4Preset, StartsWithTheSlowLegInsideTheEnable) {
  from = -400;
  after("prspos=10 pgain=500 INIT LOOPON +2 PRESET +60", "setvel=1000 ffwdreg=-655");
  does("until:!prson");
}

TEST_F(Camming4Preset, PresetAgainTurnsTheSearch) {
  from = 1000000;
  after("INIT LOOPON PRESET +100", "ffwdreg>0");
  after("PRESET +150", "ffwdreg<0 prson");
  after("STOP", "!prson !prsok");
  does("until:still");
}

TEST_F(Camming4Preset, ModeTwoLoadsAtTheEnableAfterARelease) {
  by_hand = true;
  after("prspos=99 prsmode=2 2.INP01=1 INIT LOOPON +5", "!prsok");
  after("2.INP01=0 +2 2.INP01=1 +1", "prsok posit=99");
  after("RSPRSOK", "!prsok");
  after("PRESET", "!prson");
}

TEST_F(Camming4Preset, MasterPresetModeZero) {
  after("prsposm=5000 INIT LOOPON 2.INP02=1 +1*10 2.INP02=0 +1*10", "positm=20");  // nobody asked
  after("PRESETM", "prsonm");
  after("2.INP02=1 +1*10", "prsonm");
  after("2.INP02=0 +1*10", "positm=5000 prsokm !prsonm");
  after("RSPRSM", "!prsokm");
  covers({"prsposm", "prsmodem"});
}

TEST_F(Camming4Preset, MasterPresetModeOneTakesTheLatchedCount) {
  after("prsposm=100 prsmodem=1 INIT LOOPON PRESETM 2.INP02=1 +1*10 rise:2 +1*10",
        "prsonm");  // the enable is not released
  after("2.INP02=0 +1*10 rise:2 +1*7", "positm=107 prsokm");
}

TEST_F(Camming4Preset, MasterPresetModeTwoNeedsNoCommand) {
  after("prsposm=100 prsmodem=2 INIT LOOPON +3*5 2.INP02=1 +1*5", "positm=100");
  after("+1*5", "positm=105");
}

TEST_F(Camming4Preset, RsprsmEndsTheMasterSearch) {
  after("INIT LOOPON PRESETM RSPRSM", "!prsonm");
  after("2.INP02=1 +1 2.INP02=0 +1", "!prsokm");
}

}  // namespace
}  // namespace drycut::devices::camming4
