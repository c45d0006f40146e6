#include "tests/devices/oopos2/fixture.hpp"

namespace drycut::devices::oopos2 {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// A quota or a count changed in motion (001 1.4.2; D36).
class Oopos2Change : public Oopos2Test {
 protected:
  Oopos2Change() {
    set({{"setpos", 1000}, {"tbrake", 3}, {"toldly", 5}});
    command("INIT");
  }
  static constexpr const char* kept =
      "setpos: kept for the next START: the running placement is in its slow range or would have to turn";
};

TEST_F(Oopos2Change, AFartherQuotaIsTaken) {
  command("START");
  ticks(20);
  write("setpos", 1500);
  ASSERT_TRUE(wait("st_still", 1));
  EXPECT_EQ(get("posit"), 1500);
  EXPECT_EQ(get("st_toll"), 1);
  EXPECT_THAT(diagnostics(), IsEmpty());
}

TEST_F(Oopos2Change, AndSoIsTheFirstOneAgain) {
  command("START");
  ticks(20);
  write("setpos", 1500);
  ticks(5);
  write("setpos", 1000);
  ASSERT_TRUE(wait("st_still", 1));
  EXPECT_EQ(get("posit"), 1000);
}

TEST_F(Oopos2Change, ANearerOneStillAheadIsTaken) {
  command("START");
  ticks(20);
  ASSERT_EQ(get("posit"), 340);
  write("setpos", 400);
  tick();
  EXPECT_EQ(on(), "AMR");  // in its slow range already
  ASSERT_TRUE(wait("st_still", 1));
  EXPECT_EQ(get("posit"), 400);
}

TEST_F(Oopos2Change, AQuotaBehindIsKept) {
  command("START");
  ticks(20);
  write("setpos", 300);
  tick();
  EXPECT_THAT(diagnostics(), ElementsAre(kept));
  EXPECT_EQ(get("setpos"), 300);
  ASSERT_TRUE(wait("st_still", 1));
  EXPECT_EQ(get("posit"), 1000);
  EXPECT_EQ(get("st_toll"), 1);
  place(300);
  EXPECT_EQ(get("posit"), 300);
}

TEST_F(Oopos2Change, InTheSlowRangeNothingIsTaken) {
  command("START");
  ASSERT_TRUE(wait("st_movslow", 1));
  write("setpos", 5000);
  tick();
  EXPECT_THAT(diagnostics(), ElementsAre(kept));
  ASSERT_TRUE(wait("st_still", 1));
  EXPECT_EQ(get("posit"), 1000);
}

TEST_F(Oopos2Change, BeforeTheOutputsItIsTakenToo) {
  command("START");
  write("setpos", 600);
  ASSERT_TRUE(wait("st_still", 1));
  EXPECT_EQ(get("posit"), 600);
}

TEST_F(Oopos2Change, TheToolOfTheStartStays) {
  write("tool", 40);
  command("START");
  ticks(10);
  write("tool", 0);
  write("setpos", 1200);
  ASSERT_TRUE(wait("st_still", 1));
  EXPECT_EQ(get("posit"), 1204);
}

TEST_F(Oopos2Change, TheBandFollowsTheQuota) {
  set({{"ninert", 8}, {"inertmode", 2}});
  command("START");
  EXPECT_EQ(get("actiner"), 4);
  ticks(10);
  write("setpos", 3000);
  tick();
  EXPECT_EQ(get("actiner"), 5);
}

TEST_F(Oopos2Change, AnOvershootMovesWithItsQuota) {
  set({{"bklashmode", 2}, {"overpos", 100}});
  command("START");
  ticks(20);
  write("setpos", 1500);
  int most = 0;
  while (get("st_still") == 0) {
    tick();
    most = std::max(most, get("posit"));
  }
  EXPECT_EQ(most, 1600);
  EXPECT_EQ(get("posit"), 1500);
}

TEST_F(Oopos2Change, AQuotaOfAManualMovementIsForTheNextStart) {
  command("MANFFW");
  ticks(10);
  write("setpos", -300);
  tick();
  EXPECT_THAT(diagnostics(), IsEmpty());
  EXPECT_EQ(on(), "AM");
}

TEST_F(Oopos2Change, PositInAPlacementShiftsTheAxis) {
  command("START");
  ticks(20);
  ASSERT_EQ(get("posit"), 340);
  write("posit", -1000);
  tick();
  EXPECT_EQ(get("posit"), -1000);
  ASSERT_TRUE(wait("st_still", 1));
  EXPECT_EQ(get("posit"), 1000);
  EXPECT_EQ(count(), 360 + 2000);
}

TEST_F(Oopos2Change, PositBeyondTheQuotaOrInTheSlowRangeIsRefused) {
  const auto refused =
      ElementsAre("posit: needs the quota ahead and not in the slow range, while a placement runs");
  command("START");
  ticks(20);
  write("posit", 1000);
  tick();
  EXPECT_THAT(diagnostics(), refused);
  EXPECT_EQ(get("posit"), 360);
  ASSERT_TRUE(wait("st_movslow", 1));
  write("posit", 0);
  tick();
  EXPECT_THAT(diagnostics(), refused);
  ASSERT_TRUE(wait("st_movfwd", 0));
  write("posit", 0);  // it coasts: the judgement would be of another place
  tick();
  EXPECT_THAT(diagnostics(), refused);
  ASSERT_TRUE(wait("st_still", 1));
  write("posit", 0);
  tick();
  EXPECT_EQ(get("posit"), 0);
}

// Endless motion: the count is put back before the limit comes (001 1.4.2).
TEST_F(Oopos2Change, AManualMovementGoesOnWithANewCount) {
  write("maxpos", 1000);
  command("MANFFW");
  for (int i = 0; i < 500; ++i) {
    if (get("posit") > 500) write("posit", 0);
    tick();
  }
  EXPECT_EQ(get("st_movfwd"), 1);
  EXPECT_GT(count(), 9000);
}

TEST_F(Oopos2Change, TimesActOnTheNextTimer) {
  command("START");
  write("tbrake", 50);
  EXPECT_THAT(record(4), ElementsAre("2 AM"));
  write("toldly", 2);
  command("STOP");
  EXPECT_THAT(record(4), ElementsAre("1 F"));
}

}  // namespace
}  // namespace drycut::devices::oopos2
