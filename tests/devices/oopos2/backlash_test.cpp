#include "tests/devices/oopos2/fixture.hpp"

namespace drycut::devices::oopos2 {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// Backlash recovery (001 1.2.1, 1.2.3; spec 9.6): the placement always ends in the same direction.
class Oopos2Backlash : public Oopos2Test {
 protected:
  Oopos2Backlash() {
    set({{"setpos", 1000}, {"overpos", 100}, {"slowdly", 4}, {"tinvt", 6}, {"toldly", 5}, {"iner01", 100}});
    coast = 10;
    command("INIT");
  }
};

TEST_F(Oopos2Backlash, ForwardWithBackwardRecovery) {
  covers({"bklashmode", "bklashmode 2", "overpos", "tinvt"});
  write("bklashmode", 2);
  order("START");
  // The overshoot's quota is 1100: 900 in 45, slow from 49, 1090 and over (1092) in 97; it coasts to 1102.
  // tinvt to 103, then backward, in the slow range at once: 1010 (and 1010) in 126.
  EXPECT_THAT(record(140),
              ElementsAre("0 AM", "45 ", "47 R", "49 AMR", "97 ", "103 IDMR", "126 D", "131 DF"));
  EXPECT_EQ(get("posit"), 1000);
  EXPECT_EQ(get("st_toll"), 1);
  EXPECT_THAT(diagnostics(), IsEmpty());
}

TEST_F(Oopos2Backlash, BackwardWithBackwardRecoveryIsDirect) {
  set({{"bklashmode", 2}, {"setpos", -1000}});
  order("START");
  EXPECT_THAT(record(110), ElementsAre("0 IDM", "40 D", "42 DR", "44 IDMR", "92 D", "97 DF"));
}

TEST_F(Oopos2Backlash, BackwardWithForwardRecovery) {
  covers({"bklashmode 1"});
  set({{"bklashmode", 1}, {"setpos", -1000}});
  order("START");
  EXPECT_THAT(record(140),
              ElementsAre("0 IDM", "45 D", "47 DR", "49 IDMR", "97 D", "103 AMR", "126 ", "131 F"));
  EXPECT_EQ(get("posit"), -1000);
  write("setpos", 0);
  order("START");
  EXPECT_EQ(record(140).front(), "0 AM");  // and forward it is direct
  EXPECT_EQ(get("st_movdir"), 0);
}

TEST_F(Oopos2Backlash, ModesThreeAndFourOvershootWithoutSlowdown) {
  covers({"bklashmode 3", "bklashmode 4"});
  write("bklashmode", 4);
  order("START");
  // 1090 and over (1100) in 55 at full speed.
  EXPECT_THAT(record(100), ElementsAre("0 AM", "55 ", "61 IDMR", "84 D", "89 DF"));
  set({{"bklashmode", 3}, {"setpos", 0}, {"posit", 1000}});
  tick();
  order("START");
  EXPECT_THAT(record(100), ElementsAre("0 IDM", "55 D", "61 AMR", "84 ", "89 F"));
}

TEST_F(Oopos2Backlash, WithoutOverposOrAKnownModeItIsDirect) {
  for (const auto& [mode, overpos] : {std::pair{2, 0}, {0, 100}, {5, 100}, {-1, 100}}) {
    set({{"posit", 0}, {"setpos", 1000}, {"bklashmode", mode}, {"overpos", overpos}});
    order("START");
    EXPECT_THAT(record(98), ElementsAre("0 AM", "40 ", "42 R", "44 AMR", "92 ", "97 F")) << mode;
    EXPECT_EQ(get("posit"), 1002) << mode;
    set({{"posit", 0}, {"setpos", -1000}});
    order("START");
    EXPECT_THAT(record(98), ElementsAre("0 IDM", "40 D", "42 DR", "44 IDMR", "92 D", "97 DF")) << mode;
    ticks(100);
  }
}

TEST_F(Oopos2Backlash, TheOvershootStaysInsideTheLimits) {
  set({{"bklashmode", 2}, {"maxpos", 1040}, {"iner01", 0}});
  coast = 0;
  order("START");
  int most = 0;
  for (int i = 0; i < 200; ++i) {
    tick();
    most = std::max(most, get("posit"));
  }
  EXPECT_EQ(most, 1040);
  EXPECT_EQ(get("posit"), 1000);
  EXPECT_EQ(get("st_toll"), 1);
}

TEST_F(Oopos2Backlash, EachLegHasTheInertiaOfItsDirection) {
  set({{"bklashmode", 2}, {"dobiner", 1}, {"iner01", 200}, {"iner02", 400}});
  order("START");
  std::vector<int> ends;
  bool was = false;
  for (int i = 0; i < 150; ++i) {
    tick();
    const bool moving = output(4) && output(5);
    if (was && !moving) ends.push_back(get("posit"));
    was = moving;
  }
  ASSERT_EQ(ends.size(), 2u);
  EXPECT_EQ(ends[0], 1080);  // 1100 - 20
  EXPECT_EQ(ends[1], 1038);  // 1000 + 40, from 1090 by fours
}

TEST_F(Oopos2Backlash, ThePauseBelongsToAnyReversal) {
  command("MANFFW");
  ticks(10);
  order("STOP");
  ticks(2);
  order("MANFBW");  // off since sample 0 of this count: forward went off in the sample of STOP
  EXPECT_THAT(record(10), ElementsAre("4 IDM"));
  order("MANFFW");
  EXPECT_THAT(record(10), ElementsAre("0 D", "6 AM"));
  // The same direction again waits for nothing.
  order("STOP");
  tick();
  order("MANFFW");
  EXPECT_THAT(record(3), ElementsAre("0 AM"));
}

TEST_F(Oopos2Backlash, RepositioningAtTheQuotaOvershoots) {
  set({{"bklashmode", 2}, {"enstol", 1}, {"posit", 1000}});
  tick();
  order("START");
  EXPECT_EQ(record(200).front(), "0 AMR");
  EXPECT_EQ(get("st_movdir"), 1);
  EXPECT_NEAR(get("posit"), 1000, 4);
}

}  // namespace
}  // namespace drycut::devices::oopos2
