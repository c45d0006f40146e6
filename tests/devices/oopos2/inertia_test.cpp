#include "devices/oopos2/laws.hpp"
#include "tests/devices/oopos2/fixture.hpp"

namespace drycut::devices::oopos2 {
namespace {

// Inertia bands and their recalculation (001 1.4.6, 1.4.7; spec 9.5).
TEST(Oopos2Laws, BandsDivideTheAxis) {
  EXPECT_EQ(inertia_band(0, 0, 800, 4), 0);
  EXPECT_EQ(inertia_band(1999, 0, 800, 4), 0);
  EXPECT_EQ(inertia_band(2000, 0, 800, 4), 1);
  EXPECT_EQ(inertia_band(7999, 0, 800, 4), 3);
  EXPECT_EQ(inertia_band(8000, 0, 800, 4), 3);
  EXPECT_EQ(inertia_band(99999, 0, 800, 4), 3);
  EXPECT_EQ(inertia_band(-5, 0, 800, 4), 0);
  EXPECT_EQ(inertia_band(0, -400, 400, 2), 1);
  EXPECT_EQ(inertia_band(-1, -400, 400, 2), 0);
  EXPECT_EQ(inertia_band(500, 0, 100, 0), 0);   // none is one
  EXPECT_EQ(inertia_band(500, 0, 100, 20), 4);  // more than eight are eight
  EXPECT_EQ(inertia_band(500, 100, 100, 8), 0);
  EXPECT_EQ(inertia_band(500, 100, -100, 8), 0);
  for (int quota = -12000; quota < 12000; ++quota) {
    const int band = inertia_band(quota, -1000, 1000, 7);
    EXPECT_EQ(band, quota < -10000 ? 0 : quota >= 10000 ? 6 : (quota + 10000) * 7 / 20000);
  }
}

TEST(Oopos2Laws, RowsAreThoseOfTheManualsTable) {
  for (int band = 0; band < 8; ++band) {
    EXPECT_EQ(inertia_row(band, false, false), band);
    EXPECT_EQ(inertia_row(band, false, true), band);
    EXPECT_EQ(inertia_row(band, true, false), 2 * band);
    EXPECT_EQ(inertia_row(band, true, true), 2 * band + 1);
  }
}

TEST(Oopos2Laws, RecalculationGivesTheWayThatWasCoasted) {
  EXPECT_EQ(recalculated_inertia(100, 12 * parts_per_um), 220);
  EXPECT_EQ(recalculated_inertia(100, -4 * parts_per_um), 60);
  EXPECT_EQ(recalculated_inertia(100, -50 * parts_per_um), 0);
  EXPECT_EQ(recalculated_inertia(32000, 5000 * parts_per_um), 32767);
  EXPECT_EQ(recalculated_inertia(0, parts_per_tenth / 2), 1);
  EXPECT_EQ(recalculated_inertia(0, parts_per_tenth / 2 - 1), 0);
  EXPECT_EQ(recalculated_inertia(9, -parts_per_tenth / 2), 8);
}

class Oopos2Inertia : public Oopos2Test {
 protected:
  Oopos2Inertia() {
    does("toldly=20 inertmode=2 minpos=0 maxpos=8000");
    coast = 12;
    slow = 1;  // the outputs go off exactly where they are to
    does("INIT");
  }
  /// "iner07"
  static std::string inertia(int number) { return (number < 10 ? "iner0" : "iner") + std::to_string(number); }
};

TEST_F(Oopos2Inertia, TheSecondPlacementHits) {
  covers({"inertmode", "inertmode 2"});
  does("tollp=10 tolln=10");
  place(1000);
  shows("posit=1012 !toll iner01=120");
  place(2012);  // as far as before
  shows("posit=2012 toll iner01=120");
}

TEST_F(Oopos2Inertia, BackwardItLearnsTheSame) {
  place(1000);
  does("iner01=0");
  place(400);
  shows("posit=388 iner01=120");
}

TEST_F(Oopos2Inertia, ModeZeroNeverModeOneOutOfToleranceOnly) {
  covers({"inertmode 0", "inertmode 1"});
  does("inertmode=0");
  place(1000);
  shows("iner01=0");
  does("inertmode=1 tollp=120");
  place(2012);
  shows("toll");  // 12 Um beyond, to the Um/10
  shows("iner01=0");
  does("tollp=119");
  place(3024);
  shows("!toll iner01=120");
}

TEST_F(Oopos2Inertia, EveryBandHasItsOwn) {
  covers({"iner02", "iner03", "iner04", "iner05", "iner06", "iner07", "iner08", "ninert", "actiner",
          "dobiner", "dobiner 0"});
  does("ninert=8");
  for (int band = 7; band >= 0; --band) {
    coast = 10 + band;
    place(band * 1000 + 300);
    EXPECT_EQ(get("actiner"), band);
  }
  for (int band = 0; band < 8; ++band) EXPECT_EQ(get(inertia(band + 1)), (10 + band) * 10) << band;
  for (int i = 9; i <= 16; ++i) EXPECT_EQ(get(inertia(i)), 0);
}

TEST_F(Oopos2Inertia, WithDobinerEveryDirectionToo) {
  covers({"iner09", "iner10", "iner11", "iner12", "iner13", "iner14", "iner15", "iner16", "dobiner 1"});
  does("ninert=8 dobiner=1");
  for (int band = 0; band < 8; ++band) {
    coast = 10 + band;
    place(band * 1000 + 300);
    coast = 20 + band;
    place(band * 1000 + 100);
  }
  for (int band = 0; band < 8; ++band) {
    EXPECT_EQ(get(inertia(2 * band + 1)), (10 + band) * 10) << band;
    EXPECT_EQ(get(inertia(2 * band + 2)), (20 + band) * 10) << band;
  }
}

TEST_F(Oopos2Inertia, AChangeAboveMaxinerIsAnAlertOnly) {
  covers({"maxiner"});
  does("maxiner=119");
  place(1000);
  shows("erin iner01=120");  // stored all the same
  place(2012);
  shows("!erin");
  does("iner01=230");  // a change downward counts too
  place(3124);
  shows("iner01=120 !erin");
  does("iner01=240");
  place(4236);
  shows("erin");
  does("iner01=0 maxiner=0");  // no alert
  place(5348);
  shows("iner01=120 !erin");
}

TEST_F(Oopos2Inertia, AWayThatItsWordDoesNotHoldIsToldOnceABand) {
  does("ninert=2 iner02=32767");
  const auto overrun = [&](int setpos) {  // 12 Um coasted and pushed on by 3265: 32770 Um/10 in band 1
    write("setpos", setpos);
    does("START until:movslow");
    while (output(4)) tick();
    does("count+=3265 until:still");
  };
  does("forget");
  overrun(500);
  shows("iner01=32767");
  EXPECT_THAT(diagnostics(),
              testing::ElementsAre("iner01: the way coasted would be 32770 Um/10, held at 32767"));
  does("iner01=0 count=0");
  overrun(500);
  shows("iner01=32767 silent");  // said already
  does("iner02=0");
  overrun(4500);
  shows("iner02=32767");
  EXPECT_THAT(diagnostics(),
              testing::ElementsAre("iner02: the way coasted would be 32770 Um/10, held at 32767"));
}

TEST_F(Oopos2Inertia, ItIsNeverNegative) {
  coast = 0;
  does("iner01=100 setpos=1000 START until:movslow");
  while (output(4)) tick();
  does("count+=-300");  // pushed back
  after("until:still", "iner01=0");
}

}  // namespace
}  // namespace drycut::devices::oopos2
