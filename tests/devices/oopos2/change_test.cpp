#include "tests/devices/oopos2/fixture.hpp"

namespace drycut::devices::oopos2 {
namespace {

using testing::ElementsAre;

// A quota or a count changed in motion (001 1.4.2; D36).
class Oopos2Change : public Oopos2Test {
 protected:
  Oopos2Change() { does("setpos=1000 tbrake=3 toldly=5 INIT"); }
  static constexpr const char* kept =
      "setpos: kept for the next START: the running placement is in its slow range or would have to turn";
};

TEST_F(Oopos2Change, AFartherQuotaIsTaken) {
  after("START +20 setpos=1500 until:still", "posit=1500 toll silent");
}

TEST_F(Oopos2Change, AndSoIsTheFirstOneAgain) {
  after("START +20 setpos=1500 +5 setpos=1000 until:still", "posit=1000");
}

TEST_F(Oopos2Change, ANearerOneStillAheadIsTaken) {
  after("START +20", "posit=340");
  after("setpos=400 +1", "on=AMR");  // in its slow range already
  after("until:still", "posit=400");
}

TEST_F(Oopos2Change, AQuotaBehindIsKept) {
  says("START +20 setpos=300 +1", {kept});
  shows("setpos=300");
  after("until:still", "posit=1000 toll");
  place(300);
  shows("posit=300");
}

TEST_F(Oopos2Change, InTheSlowRangeNothingIsTaken) {
  says("START until:movslow setpos=5000 +1", {kept});
  after("until:still", "posit=1000");
}

TEST_F(Oopos2Change, BeforeTheOutputsItIsTakenToo) { after("START setpos=600 until:still", "posit=600"); }

TEST_F(Oopos2Change, TheToolOfTheStartStays) {
  after("tool=40 START +10 tool=0 setpos=1200 until:still", "posit=1204");
}

TEST_F(Oopos2Change, TheBandFollowsTheQuota) {
  after("ninert=8 inertmode=2 START", "actiner=4");
  after("+10 setpos=3000 +1", "actiner=5");
}

TEST_F(Oopos2Change, AnOvershootMovesWithItsQuota) {
  does("bklashmode=2 overpos=100 START +20 setpos=1500");
  int most = 0;
  while (get("st_still") == 0) {
    does("+1");
    most = std::max(most, get("posit"));
  }
  EXPECT_EQ(most, 1600);
  shows("posit=1500");
}

TEST_F(Oopos2Change, AQuotaOfAManualMovementIsForTheNextStart) {
  after("MANFFW +10 setpos=-300 +1", "silent on=AM");
}

TEST_F(Oopos2Change, PositInAPlacementShiftsTheAxis) {
  after("START +20", "posit=340");
  after("posit=-1000 +1", "posit=-1000");
  after("until:still", "posit=1000");
  EXPECT_EQ(count(), 360 + 2000);
}

TEST_F(Oopos2Change, PositBeyondTheQuotaOrInTheSlowRangeIsRefused) {
  const auto refused =
      ElementsAre("posit: needs the quota ahead and not in the slow range, while a placement runs");
  does("START +20 posit=1000 +1");
  EXPECT_THAT(diagnostics(), refused);
  shows("posit=360");
  does("until:movslow posit=0 +1");
  EXPECT_THAT(diagnostics(), refused);
  does("until:!movfwd posit=0");  // it coasts: the judgement would be of another place
  does("+1");
  EXPECT_THAT(diagnostics(), refused);
  after("until:still posit=0 +1", "posit=0");
}

// Endless motion: the count is put back before the limit comes (001 1.4.2).
TEST_F(Oopos2Change, AManualMovementGoesOnWithANewCount) {
  does("maxpos=1000 MANFFW");
  for (int i = 0; i < 500; ++i) {
    if (get("posit") > 500) write("posit", 0);
    does("+1");
  }
  shows("movfwd count>9000");
}

TEST_F(Oopos2Change, TimesActOnTheNextTimer) {
  switches("START tbrake=50", 4, {"2 AM"});
  switches("toldly=2 STOP", 4, {"1 F"});
}

}  // namespace
}  // namespace drycut::devices::oopos2
