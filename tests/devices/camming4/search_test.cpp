#include "tests/devices/camming4/fixture.hpp"
#include "tests/devices/search_bench.hpp"

namespace drycut::devices::camming4 {
namespace {

/// Preset searches (spec 5.11) over an enable from `from` to `to`, with a zero pulse every 512 bits.
class Camming4Search : public SearchBench<Camming4Test, 512, 1> {
 public:
  Camming4Search() : SearchBench(2000, 1000000) {}
  void prepare() { does("prspos=70 pgain=500 INIT LOOPON"); }
  /// The count that got the quota prspos.
  std::int64_t loaded_at() { return count() - (get("posit") - 70); }
};

TEST_F(Camming4Search, BothModesLoadWhereTheyShouldInBothDirections) {
  for (const int mode : {0, 1})
    for (const bool backward : {false, true}) {
      SCOPED_TRACE(mode * 10 + (backward ? 1 : 0));
      does("power count=0");
      from = backward ? -1000000 : 2000;
      to = backward ? -2000 : 1000000;
      set({{"prsmode", mode}, {"prsdir", backward ? 1 : 0}});
      prepare();
      does("PRESET +60");
      EXPECT_EQ(get("ffwdreg"), backward ? -3277 : 3277);  // prsvel
      shows("setvel=5000");
      does("until:dec until:vconst");
      EXPECT_EQ(get("ffwdreg"), backward ? 655 : -655);  // sprsvel
      shows("!chvel");
      after("until:!prson +100", "prsok still setpos=70 posit=70~1");
      EXPECT_EQ(loaded_at(), mode == 0 ? released_at : backward ? -1536 : 1536);
    }
  covers({"prsmode", "prsdir", "prsvel", "sprsvel", "prspos", "PRESET accepted"});
}

TEST_F(Camming4Search, PresetInTheSlowLegTurnsItToTheOtherEndOfTheEnable) {
  to = 2600;
  prepare();
  does("PRESET until:dec until:vconst");  // backward, slowly
  does("PRESET until:!prson +100");
  EXPECT_NEAR(static_cast<double>(loaded_at()), 2601, 2);
  EXPECT_EQ(loaded_at(), released_at);
}

TEST_F(Camming4Search, PresetWhileItTurnsTurnsTheSlowLeg) {
  to = 2600;
  prepare();
  does("PRESET until:dec +10 PRESET until:!prson +100");
  EXPECT_NEAR(static_cast<double>(loaded_at()), 2601, 2);
}

TEST_F(Camming4Search, TurnedByTheProgramIntoTheEnableItLeavesItTheWayBack) {
  prepare();
  does("PRESET");
  while (count() < 1900) tick();
  after("PRESET", "count<2000");
  does("until:!prson +100");
  EXPECT_NEAR(static_cast<double>(loaded_at()), 1998, 3);
  shows("prsok");
}

TEST_F(Camming4Search, PresetInTheLastPlacementChangesNothing) {
  prepare();
  does("PRESET until:dec until:vconst");
  while (released_at == 0) tick();
  after("+3 PRESET until:!prson", "prsok");
  EXPECT_EQ(loaded_at(), released_at);
}

TEST_F(Camming4Search, ItsSpeedsAreItsOwn) {
  prepare();
  after("PRESET +60 setvel=100 setpos=12345 tacc=1 +20", "ffwdreg=3277 setvel=5000 setpos=70");
}

TEST_F(Camming4Search, EmergencyAndCalibrationEndIt) {
  for (const char* name : {"EMRG", "CALON"}) {
    does("power");
    prepare();
    does("PRESET +30");
    command(name);
    shows("!prson still DAC=0");
    after("RESUME CALOFF +30", "still !prsok");
  }
}

TEST_F(Camming4Search, TheMastersZeroPulseLoadsItsExactCountOnce) {
  does("prsposm=1000 prsmodem=1 INIT LOOPON PRESETM 2.INP02=1 +1*10 2.INP02=0 +1*10");
  // Two pulses before the sample: the first counts.
  after("master+=5 rise:2 master+=20 rise:2 +1", "positm=1020 !prsonm prsokm");
  after("rise:2 +1*3", "positm=1023");
  // A new search needs its own release.
  after("PRESETM", "!prsokm");
  after("rise:2 +1*3", "prsonm");
  covers({"prsmodem", "prsposm"});
}

TEST_F(Camming4Search, ThePulsesFallingEdgeIsNone) {
  after("prsposm=1000 prsmodem=1 prsmode=1 INIT LOOPON PRESETM 2.INP02=1 +1 2.INP02=0 +1 fall:2 +1",
        "prsonm");
  rising = false;
  does("PRESET");
  while (released_at == 0) tick();
  after("+1000", "prson");
}

TEST_F(Camming4Search, TheMastersModeZeroLoadsAtTheRelease) {
  after("prsposm=1000 prsmodem=0 INIT LOOPON PRESETM rise:2 +1*5", "prsonm");
  after("2.INP02=1 +1*5", "prsonm");
  after("2.INP02=0 +1*5", "positm=1000");
}

TEST_F(Camming4Search, TheMastersModeTwoLoadsAtEachActivation) {
  does("prsposm=1000 prsmodem=2 2.INP02=1");  // active at power-up: it must be released first
  after("INIT LOOPON +3*5", "!prsokm");
  after("PRESETM", "!prsonm");
  for (int i = 0; i < 2; ++i) {
    after("2.INP02=0 +3*5 2.INP02=1 +1*5", "positm=1000 prsokm");
    after("RSPRSM", "!prsokm");
  }
}

}  // namespace
}  // namespace drycut::devices::camming4
