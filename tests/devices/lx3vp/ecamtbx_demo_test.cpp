// The three demos of the manual's appendix, to the pulse. The manual's own slips: it divides by 1000 pi where
// the circumference is 100 pi, prints 600 mm for 660 and 0.01 mm for the 0.02 mm of a pulse, writes F1/F2 for
// the number F2/F1, and calls both H0 and H1 uniform acceleration although the parameter list gives that
// to 1.
#include "tests/devices/lx3vp/ecamtbx_bench.hpp"

namespace drycut::devices::lx3vp {
namespace {

using std::numbers::pi;

TEST(EcamtbxDemo, TheRotarySawsParametersFollowFromItsMachine) {
  EXPECT_EQ(std::lround(1000.0 * 1000 / (100 * pi)), ecams::rotary_demo().master_length);
  EXPECT_FLOAT_EQ(static_cast<float>((1000 / (60 * pi)) / (1000 / (100 * pi))),
                  ecams::rotary_demo().sync_ratio);
}

TEST(EcamtbxDemo, TheRotarySawStandsStillBetweenTheCuts) {
  const auto made = make_rotary_saw(ecams::rotary_demo());
  ecams::expect_sound(made, {3183, 1000});
  EXPECT_EQ(made.code(), 200);
  // Synchronous over 199.8 master pulses, to rest over 400.2, standing for 2182.8, and back.
  EXPECT_NEAR(made.profile.sync_end, 199.8, 1e-4);
  ASSERT_EQ(made.profile.pieces.size(), 4U);
  EXPECT_NEAR(made.profile.pieces[1].length, 400.2, 1e-4);
  EXPECT_NEAR(made.profile.pieces[2].length, 2182.8, 2e-4);
  EXPECT_TRUE(ecams::has(made, {200, 333}));
  EXPECT_TRUE(ecams::has(made, {600, 667}));  // 666.5, half away from 0
  EXPECT_TRUE(ecams::has(made, {2783, 667}));
  EXPECT_NEAR(at(made.profile, 600.1).position, 666.5, 1e-9);
  EXPECT_NEAR(ecams::largest_ratio(made.profile), 5.0 / 3, 1e-6);
  EXPECT_LT(largest_deviation(made), 1.5);
}

TEST(EcamtbxDemo, TheFlySawGoesAndComesBack) {
  const auto made = make_fly_saw(ecams::fly_demo());
  ecams::expect_sound(made, {3500, 0});
  EXPECT_EQ(made.code(), 200);
  ASSERT_EQ(made.profile.pieces.size(), 8U);
  EXPECT_NEAR(made.profile.sync_begin, 141.436, 1e-3);
  EXPECT_NEAR(made.profile.sync_end - made.profile.sync_begin, 70.771, 1e-3);
  EXPECT_NEAR(made.profile.pieces[3].master, 353.642, 2e-3);
  EXPECT_NEAR(made.profile.pieces[3].length, 1396.358, 2e-3);
  EXPECT_NEAR(made.profile.pieces[7].master, 2103.642, 2e-3);
  EXPECT_TRUE(ecams::has(made, {354, 2000}));
  EXPECT_TRUE(ecams::has(made, {1750, 2000}));
  EXPECT_TRUE(ecams::has(made, {2104, 0}));
  for (const auto& row : made.rows) {  // the way back is the way there
    const double there = row.master <= 1750 ? row.master : row.master - 1750;
    const double forward = at(made.profile, there).position;
    EXPECT_NEAR(row.slave, row.master <= 1750 ? forward : 2000 - forward, 0.501);
  }
}

TEST(EcamtbxDemo, TheSCurveTakesThreeHundredMilliseconds) {
  for (const auto type : {EcamType::s_curve_0, EcamType::s_curve_1}) {
    const auto made = make_s_curve(type, ecams::s_curve_demo());
    ecams::expect_sound(made, {3000, 10000});
    EXPECT_EQ(made.code(), 200);
    EXPECT_EQ(made.uniform_time, 1000);
    EXPECT_EQ(made.speed_reached, 50000);
    EXPECT_TRUE(ecams::has(made, {1000, 2500}));
    EXPECT_TRUE(ecams::has(made, {2000, 7500}));
    int up = 0;
    for (const auto& row : made.rows) up += row.master <= 1000 ? 1 : 0;
    EXPECT_EQ(up, 100);  // 99 intervals
  }
}

TEST(EcamtbxDemo, TheNegativeSquareOfTheFlySawIsTheRotarySawsBackwards) {
  auto forward = ecams::fly_demo();
  forward.sync_ratio = static_cast<float>(3 * pi);
  auto back = forward;
  back.slave_length = -2000;
  back.curve = return_square;
  const auto there = make_rotary_saw(forward);
  const auto again = make_rotary_saw(back);
  ecams::expect_sound(there, {1750, 2000});
  ecams::expect_sound(again, {1750, -2000});
  ASSERT_EQ(there.rows.size(), again.rows.size());
  for (std::size_t i = 0; i < there.rows.size(); ++i)
    EXPECT_EQ(again.rows[i], (CamTableRow{there.rows[i].master, -there.rows[i].slave}));
}

}  // namespace
}  // namespace drycut::devices::lx3vp
