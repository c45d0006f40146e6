#include "tests/devices/camming4/fixture.hpp"
#include "tests/devices/search_bench.hpp"

namespace drycut::devices::camming4 {
namespace {

// Presets (spec 5.11). The enable is active from 2000 Um on, or up to 2200 Um.
class Camming4Preset : public SearchBench<Camming4Test, 512, 1> {
 public:
  Camming4Preset() : SearchBench(2000, 1000000) {}
};

TEST_F(Camming4Preset, ModeTwoLoadsAtTheEnableAfterARelease) {
  by_hand = true;
  after("prspos=99 prsmode=2 2.INP01=1 INIT LOOPON +5", "!prsok");
  after("2.INP01=0 +2 2.INP01=1 +1", "prsok posit=99");
  after("2.INP01=0 RSPRSOK", "!prsok");
  after("PRESET", "!prson");
}

// 002 1.2.5.4 explains the words that 000 1.9.2 uses too.
TEST_F(Camming4Preset, ModeTwoLoadsAsLongAsTheEnableIsOn) {
  by_hand = true;
  after("prspos=99 prsmode=2 blocked=1 INIT LOOPON +2 2.INP01=1 +1", "prsok posit=99");
  after("RSPRSOK count+=30 +1", "prsok posit=99");
  after("prspos=-7 +1", "posit=-7");
  after("2.INP01=0 count+=30 +1", "posit=23");
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
