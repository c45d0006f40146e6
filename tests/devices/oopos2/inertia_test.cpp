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
    set({{"toldly", 20}, {"inertmode", 2}, {"minpos", 0}, {"maxpos", 8000}});
    coast = 12;
    slow = 1;  // the outputs go off exactly where they are to
    command("INIT");
  }
  /// "iner07"
  static std::string inertia(int number) { return (number < 10 ? "iner0" : "iner") + std::to_string(number); }
};

TEST_F(Oopos2Inertia, TheSecondPlacementHits) {
  covers({"inertmode", "inertmode 2", "iner01"});
  set({{"tollp", 10}, {"tolln", 10}});
  place(1000);
  EXPECT_EQ(get("posit"), 1012);
  EXPECT_EQ(get("st_toll"), 0);
  EXPECT_EQ(get("iner01"), 120);
  place(2012);  // as far as before
  EXPECT_EQ(get("posit"), 2012);
  EXPECT_EQ(get("st_toll"), 1);
  EXPECT_EQ(get("iner01"), 120);
}

TEST_F(Oopos2Inertia, BackwardItLearnsTheSame) {
  place(1000);
  write("iner01", 0);
  place(400);
  EXPECT_EQ(get("posit"), 388);
  EXPECT_EQ(get("iner01"), 120);
}

TEST_F(Oopos2Inertia, ModeZeroNeverModeOneOutOfToleranceOnly) {
  covers({"inertmode 0", "inertmode 1"});
  write("inertmode", 0);
  place(1000);
  EXPECT_EQ(get("iner01"), 0);
  set({{"inertmode", 1}, {"tollp", 120}});
  place(2012);
  EXPECT_EQ(get("st_toll"), 1);  // 12 Um beyond, to the Um/10
  EXPECT_EQ(get("iner01"), 0);
  write("tollp", 119);
  place(3024);
  EXPECT_EQ(get("st_toll"), 0);
  EXPECT_EQ(get("iner01"), 120);
}

TEST_F(Oopos2Inertia, EveryBandHasItsOwn) {
  covers({"iner02", "iner03", "iner04", "iner05", "iner06", "iner07", "iner08", "ninert", "actiner",
          "dobiner", "dobiner 0"});
  write("ninert", 8);
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
  set({{"ninert", 8}, {"dobiner", 1}});
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
  covers({"maxiner", "st_erin"});
  write("maxiner", 119);
  place(1000);
  EXPECT_EQ(get("st_erin"), 1);
  EXPECT_EQ(get("iner01"), 120);  // stored all the same
  place(2012);
  EXPECT_EQ(get("st_erin"), 0);
  write("iner01", 230);  // a change downward counts too
  place(3124);
  EXPECT_EQ(get("iner01"), 120);
  EXPECT_EQ(get("st_erin"), 0);
  write("iner01", 240);
  place(4236);
  EXPECT_EQ(get("st_erin"), 1);
  write("iner01", 0);
  write("maxiner", 0);  // no alert
  place(5348);
  EXPECT_EQ(get("iner01"), 120);
  EXPECT_EQ(get("st_erin"), 0);
}

TEST_F(Oopos2Inertia, AWayThatItsWordDoesNotHoldIsToldOnceABand) {
  set({{"ninert", 2}, {"iner02", 32767}});
  const auto overrun = [&](int setpos) {  // 12 Um coasted and pushed on by 3265: 32770 Um/10 in band 1
    write("setpos", setpos);
    command("START");
    ASSERT_TRUE(wait("st_movslow", 1));
    while (output(4)) tick();
    count() += 3265;
    ASSERT_TRUE(wait("st_still", 1));
  };
  diagnostics();
  overrun(500);
  EXPECT_EQ(get("iner01"), 32767);
  EXPECT_THAT(diagnostics(),
              testing::ElementsAre("iner01: the way coasted would be 32770 Um/10, held at 32767"));
  write("iner01", 0);
  count() = 0;
  overrun(500);
  EXPECT_EQ(get("iner01"), 32767);
  EXPECT_THAT(diagnostics(), testing::IsEmpty());  // said already
  write("iner02", 0);
  overrun(4500);
  EXPECT_EQ(get("iner02"), 32767);
  EXPECT_THAT(diagnostics(),
              testing::ElementsAre("iner02: the way coasted would be 32770 Um/10, held at 32767"));
}

TEST_F(Oopos2Inertia, ItIsNeverNegative) {
  coast = 0;
  write("iner01", 100);
  write("setpos", 1000);
  command("START");
  ASSERT_TRUE(wait("st_movslow", 1));
  while (output(4)) tick();
  count() -= 300;  // pushed back
  ASSERT_TRUE(wait("st_still", 1));
  EXPECT_EQ(get("iner01"), 0);
}

}  // namespace
}  // namespace drycut::devices::oopos2
