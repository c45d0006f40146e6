#include "tests/devices/oopos2/fixture.hpp"

namespace drycut::devices::oopos2 {
namespace {

using testing::ElementsAre;

// Backlash recovery (001 1.2.1, 1.2.3; spec 9.6): the placement always ends in the same direction.
class Oopos2Backlash : public Oopos2Test {
 protected:
  Oopos2Backlash() {
    does("setpos=1000 overpos=100 slowdly=4 tinvt=6 toldly=5 iner01=100");
    coast = 10;
    does("INIT");
  }
};

TEST_F(Oopos2Backlash, ForwardWithBackwardRecovery) {
  covers({"bklashmode", "bklashmode 2", "overpos", "tinvt"});
  does("bklashmode=2 START!");
  // The overshoot's quota is 1100: 900 in 45, slow from 49, 1090 and over (1092) in 97; it coasts to 1102.
  // tinvt to 103, then backward, in the slow range at once: 1010 (and 1010) in 126.
  switches("", 140, {"0 AM", "45 ", "47 R", "49 AMR", "97 ", "103 IDMR", "126 D", "131 DF"});
  shows("posit=1000 toll silent");
}

TEST_F(Oopos2Backlash, BackwardWithBackwardRecoveryIsDirect) {
  switches("bklashmode=2 setpos=-1000 START!", 110, {"0 IDM", "40 D", "42 DR", "44 IDMR", "92 D", "97 DF"});
}

TEST_F(Oopos2Backlash, BackwardWithForwardRecovery) {
  covers({"bklashmode 1"});
  switches("bklashmode=1 setpos=-1000 START!", 140,
           {"0 IDM", "45 D", "47 DR", "49 IDMR", "97 D", "103 AMR", "126 ", "131 F"});
  shows("posit=-1000");
  does("setpos=0 START!");
  EXPECT_EQ(record(140).front(), "0 AM");  // and forward it is direct
  shows("!movdir");
}

TEST_F(Oopos2Backlash, ModesThreeAndFourOvershootWithoutSlowdown) {
  covers({"bklashmode 3", "bklashmode 4"});
  does("bklashmode=4 START!");
  // 1090 and over (1100) in 55 at full speed.
  switches("", 100, {"0 AM", "55 ", "61 IDMR", "84 D", "89 DF"});
  switches("bklashmode=3 setpos=0 posit=1000 +1 START!", 100, {"0 IDM", "55 D", "61 AMR", "84 ", "89 F"});
}

TEST_F(Oopos2Backlash, WithoutOverposOrAKnownModeItIsDirect) {
  for (const auto& [mode, overpos] : {std::pair{2, 0}, {0, 100}, {5, 100}, {-1, 100}}) {
    set({{"posit", 0}, {"setpos", 1000}, {"bklashmode", mode}, {"overpos", overpos}});
    does("START!");
    EXPECT_THAT(record(98), ElementsAre("0 AM", "40 ", "42 R", "44 AMR", "92 ", "97 F")) << mode;
    EXPECT_EQ(get("posit"), 1002) << mode;
    does("posit=0 setpos=-1000 START!");
    EXPECT_THAT(record(98), ElementsAre("0 IDM", "40 D", "42 DR", "44 IDMR", "92 D", "97 DF")) << mode;
    does("+100");
  }
}

TEST_F(Oopos2Backlash, TheOvershootStaysInsideTheLimits) {
  does("bklashmode=2 maxpos=1040 iner01=0");
  coast = 0;
  does("START!");
  int most = 0;
  for (int i = 0; i < 200; ++i) {
    does("+1");
    most = std::max(most, get("posit"));
  }
  EXPECT_EQ(most, 1040);
  shows("posit=1000 toll");
}

TEST_F(Oopos2Backlash, EachLegHasTheInertiaOfItsDirection) {
  does("bklashmode=2 dobiner=1 iner01=200 iner02=400 START!");
  std::vector<int> ends;
  bool was = false;
  for (int i = 0; i < 150; ++i) {
    does("+1");
    const bool moving = output(4) && output(5);
    if (was && !moving) ends.push_back(get("posit"));
    was = moving;
  }
  ASSERT_EQ(ends.size(), 2u);
  EXPECT_EQ(ends[0], 1080);  // 1100 - 20
  EXPECT_EQ(ends[1], 1038);  // 1000 + 40, from 1090 by fours
}

TEST_F(Oopos2Backlash, ThePauseBelongsToAnyReversal) {
  // Off since sample 0 of this count: forward went off in the sample of STOP.
  switches("MANFFW +10 STOP! +2 MANFBW!", 10, {"4 IDM"});
  switches("MANFFW!", 10, {"0 D", "6 AM"});
  // The same direction again waits for nothing.
  switches("STOP! +1 MANFFW!", 3, {"0 AM"});
}

TEST_F(Oopos2Backlash, RepositioningAtTheQuotaOvershoots) {
  does("bklashmode=2 enstol=1 posit=1000 +1 START!");
  EXPECT_EQ(record(200).front(), "0 AMR");
  shows("movdir posit=1000~4");
}

}  // namespace
}  // namespace drycut::devices::oopos2
