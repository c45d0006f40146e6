// The laws of ECAMTBX against their closed forms, and every curve and case of the rotary saw.
#include <tuple>

#include "tests/devices/lx3vp/ecamtbx_bench.hpp"

namespace drycut::devices::lx3vp {
namespace {

/// A ramp 0 -> 1 over 10 pulses.
CamProfile ramp(Transition law) {
  CamProfile profile;
  profile.add(10, 0, 1, law);
  return profile;
}

constexpr Transition curved[] = {Transition::uniform_acceleration, Transition::b_type, Transition::cosine,
                                 Transition::parabolas};

TEST(EcamtbxLaws, EveryTransitionCoversHalfItsLength) {
  for (const auto law : curved) {
    const auto profile = ramp(law);
    EXPECT_DOUBLE_EQ(profile.slave_length, 5);
    EXPECT_DOUBLE_EQ(at(profile, 10).position, 5);
    EXPECT_DOUBLE_EQ(at(profile, 0).velocity, 0);
    EXPECT_DOUBLE_EQ(at(profile, 10).velocity, 1);
    EXPECT_NEAR(at(profile, 5).velocity, 0.5, 1e-15);
  }
}

TEST(EcamtbxLaws, ClosedValues) {
  using std::numbers::pi;
  // Ratio and position a quarter in.
  EXPECT_DOUBLE_EQ(at(ramp(Transition::uniform_acceleration), 2.5).position, 10.0 / 32);
  EXPECT_DOUBLE_EQ(at(ramp(Transition::b_type), 2.5).velocity, 3.0 / 16 - 2.0 / 64);
  EXPECT_DOUBLE_EQ(at(ramp(Transition::b_type), 2.5).position, 10 * (1.0 / 64 - 1.0 / 512));
  EXPECT_DOUBLE_EQ(at(ramp(Transition::cosine), 2.5).velocity, (1 - std::sqrt(0.5)) / 2);
  EXPECT_NEAR(at(ramp(Transition::cosine), 2.5).position, 10 * (0.125 - std::sqrt(0.5) / (2 * pi)), 1e-14);
  EXPECT_DOUBLE_EQ(at(ramp(Transition::parabolas), 2.5).velocity, 0.125);
  EXPECT_DOUBLE_EQ(at(ramp(Transition::parabolas), 7.5).velocity, 0.875);
  EXPECT_DOUBLE_EQ(at(ramp(Transition::parabolas), 7.5).position, 10 * (0.5 - 0.25 + 2.0 / 3 / 64));
  // Largest gradients.
  EXPECT_DOUBLE_EQ(ramp(Transition::uniform_acceleration).pieces[0].peak(CamOrder::acceleration), 0.1);
  EXPECT_DOUBLE_EQ(ramp(Transition::b_type).pieces[0].peak(CamOrder::acceleration), 0.15);
  EXPECT_DOUBLE_EQ(ramp(Transition::cosine).pieces[0].peak(CamOrder::acceleration), pi / 20);
  EXPECT_DOUBLE_EQ(ramp(Transition::parabolas).pieces[0].peak(CamOrder::acceleration), 0.2);
}

TEST(EcamtbxLaws, DerivativesAreThoseOfThePosition) {
  constexpr double h = 1e-4;
  for (const auto law : curved) {
    const auto profile = ramp(law);
    for (const double m : {0.7, 2.5, 4.9, 5.1, 8.3}) {
      const auto before = at(profile, m - h);
      const auto here = at(profile, m);
      const auto after = at(profile, m + h);
      EXPECT_NEAR((after.position - before.position) / (2 * h), here.velocity, 1e-8);
      EXPECT_NEAR((after.velocity - before.velocity) / (2 * h), here.acceleration, 1e-8);
      EXPECT_NEAR((after.acceleration - before.acceleration) / (2 * h), here.jerk, 1e-8);
    }
  }
}

TEST(EcamtbxLaws, TheGradientNeverPassesItsPeak) {
  for (const auto law : curved) {
    const auto profile = ramp(law);
    const double peak = profile.pieces[0].peak(CamOrder::acceleration);
    double most = 0;
    for (int i = 0; i <= 1000; ++i) most = std::max(most, std::abs(at(profile, i / 100.0).acceleration));
    EXPECT_NEAR(most, peak, 1e-12);
  }
}

/// Rotary saw with plain numbers: k = 2, sync zone 100 master and 200 slave pulses of 1100 and `slave`.
SawParameters plain(std::int32_t slave, std::uint16_t curve, std::uint16_t law = 1, float max_ratio = 8) {
  return {.master_length = 1100,
          .slave_length = slave,
          .sync_length = 200,
          .sync_ratio = 2,
          .max_ratio = max_ratio,
          .acceleration = law,
          .curve = curve,
          .resolution = 100};
}

TEST(EcamtbxRotary, AsLongAsTheCircumferenceIsUniform) {
  const auto made = make_rotary_saw(plain(2200, left_cam));
  EXPECT_EQ(made.rows, (ecams::Rows{{0, 0}, {1100, 2200}}));
}

TEST(EcamtbxRotary, AShortCutCatchesUp) {
  // Mean ratio 3 over the correction of 1000: a triangle to 4.
  const auto made = make_rotary_saw(plain(3200, left_cam));
  ecams::expect_sound(made, {1100, 3200});
  EXPECT_EQ(made.code(), 100);
  EXPECT_DOUBLE_EQ(at(made.profile, 600).velocity, 4);
  EXPECT_TRUE(ecams::has(made, {100, 200}));
  EXPECT_TRUE(ecams::has(made, {600, 1700}));
}

TEST(EcamtbxRotary, AShortCutIsLimitedToP5) {
  // Limited to 3.5: ramps of 1000 (3.5 - 3) / (3.5 - 2) = 333.3 each.
  const auto made = make_rotary_saw(plain(3200, left_cam, 1, 3.5F));
  ecams::expect_sound(made, {1100, 3200});
  EXPECT_DOUBLE_EQ(ecams::largest_ratio(made.profile), 3.5);
  EXPECT_NEAR(made.profile.pieces[1].length, 1000.0 / 3, 1e-9);
  EXPECT_NEAR(made.profile.pieces[2].length, 1000.0 / 3, 1e-9);
}

TEST(EcamtbxRotary, ALongerCutSlowsDownAndAVeryLongOneStops) {
  const auto slow = make_rotary_saw(plain(1700, left_cam));  // mean 1.5: down to 1
  EXPECT_DOUBLE_EQ(at(slow.profile, 600).velocity, 1);
  const auto touches = make_rotary_saw(plain(1200, left_cam));  // mean 1 = k/2: touches standstill
  EXPECT_DOUBLE_EQ(at(touches.profile, 600).velocity, 0);
  EXPECT_EQ(touches.profile.pieces.size(), 3U);
  const auto stops = make_rotary_saw(plain(800, left_cam));  // mean 0.6: ramps of 300, standing for 400
  ecams::expect_sound(stops, {1100, 800});
  EXPECT_TRUE(ecams::has(stops, {400, 500}));
  EXPECT_TRUE(ecams::has(stops, {800, 500}));
}

TEST(EcamtbxRotary, UniformStepsToTheMeanRatio) {
  for (const auto curve : {left_cam, mid_cam_all, mid_cam_begin, mid_cam_end, right_cam}) {
    const auto made = make_rotary_saw(plain(1200, curve, 0));
    ecams::expect_sound(made, {1100, 1200});
    EXPECT_DOUBLE_EQ(at(made.profile, curve == right_cam ? 50 : 1050).velocity, 1);
  }
  EXPECT_EQ(make_rotary_saw(plain(1200, left_cam, 0)).rows, (ecams::Rows{{0, 0}, {100, 200}, {1100, 1200}}));
  EXPECT_EQ(make_rotary_saw(plain(1200, mid_cam_all, 0)).rows,
            (ecams::Rows{{0, 0}, {500, 500}, {600, 700}, {1100, 1200}}));
}

TEST(EcamtbxRotary, TheSynchronousZoneStandsWhereTheCurveSays) {
  const auto zone = [](std::uint16_t curve) {
    const auto made = make_rotary_saw(plain(1700, curve));
    for (double m = made.profile.sync_begin; m <= made.profile.sync_end; m += 10)
      EXPECT_DOUBLE_EQ(at(made.profile, m).velocity, 2) << curve;
    return std::pair(made.profile.sync_begin, made.profile.sync_end);
  };
  EXPECT_EQ(zone(left_cam), std::pair(0.0, 100.0));
  EXPECT_EQ(zone(right_cam), std::pair(1000.0, 1100.0));
  EXPECT_EQ(zone(mid_cam_all), std::pair(500.0, 600.0));
  EXPECT_EQ(zone(mid_cam_begin), std::pair(500.0, 600.0));
  EXPECT_EQ(zone(mid_cam_end), std::pair(500.0, 600.0));
}

TEST(EcamtbxRotary, RatiosAtTheEndsOfTheCycle) {
  for (const std::int32_t slave : {600, 1700, 3200}) {
    const double middle = slave == 600 ? 0 : slave == 1700 ? 1 : 4;
    const std::tuple<SawCurve, double, double> ends[] = {{left_cam, 2, 2},
                                                         {right_cam, 2, 2},
                                                         {mid_cam_all, middle, middle},
                                                         {mid_cam_begin, 0, middle},
                                                         {mid_cam_end, middle, 0}};
    for (const auto& [curve, first, last] : ends) {
      const auto made = make_rotary_saw(plain(slave, curve));
      ASSERT_TRUE(made.ok()) << curve;
      EXPECT_DOUBLE_EQ(at(made.profile, 0).velocity, first) << curve;
      EXPECT_DOUBLE_EQ(at(made.profile, 1100).velocity, last) << curve;
    }
  }
}

TEST(EcamtbxRotary, RightIsLeftAndEndIsBeginReadBackwards) {
  for (const std::int32_t slave : {600, 1200, 1700, 2200, 3200}) {
    for (const auto law : std::initializer_list<std::uint16_t>{1, 2}) {
      const auto profile = [&](std::uint16_t curve) {
        return make_rotary_saw(plain(slave, curve, law)).profile;
      };
      const auto left = profile(left_cam);
      const auto right = profile(right_cam);
      const auto begin = profile(mid_cam_begin);
      const auto end = profile(mid_cam_end);
      for (int m = 0; m <= 1100; m += 7) {
        EXPECT_NEAR(at(right, m).position, slave - at(left, 1100 - m).position, 1e-9);
        EXPECT_NEAR(at(end, m).position, slave - at(begin, 1100 - m).position, 1e-9);
      }
    }
  }
}

TEST(EcamtbxRotary, AllMiddleCurvesAreOneWhereTheSlaveStops) {
  const auto rows = make_rotary_saw(plain(800, mid_cam_all)).rows;
  EXPECT_EQ(make_rotary_saw(plain(800, mid_cam_begin)).rows, rows);
  EXPECT_EQ(make_rotary_saw(plain(800, mid_cam_end)).rows, rows);
}

TEST(EcamtbxRotary, RunsInFromRestWithEqualSlopes) {
  // Half the correction: 500 master and 750 slave pulses to k = 2; 2 * 750 > 500 * 2, so it overshoots.
  const auto made = make_rotary_saw(plain(1700, mid_cam_begin));
  const double peak = (750 + std::sqrt(750.0 * 750 - 500 * 750 * 2 + 500.0 * 500 * 4 / 2)) / 500;
  EXPECT_NEAR(ratio_of(made.profile.pieces[0]).r1, peak, 1e-12);
  EXPECT_NEAR(made.profile.pieces[0].peak(CamOrder::acceleration),
              made.profile.pieces[1].peak(CamOrder::acceleration), 1e-12);
  EXPECT_NEAR(at(made.profile, 500).position, 750, 1e-9);
  // And without enough to overshoot it waits first.
  const auto waits = make_rotary_saw(plain(1000, mid_cam_begin));  // 400 in 500 to k: stands for 100
  EXPECT_DOUBLE_EQ(at(waits.profile, 100).position, 0);
  EXPECT_DOUBLE_EQ(at(waits.profile, 500).position, 400);
}

TEST(EcamtbxRotary, OnlyMidCamEndStopsByItself) {
  for (const auto curve : {left_cam, mid_cam_all, mid_cam_begin, mid_cam_end, right_cam})
    EXPECT_EQ(make_rotary_saw(plain(1700, curve)).profile.stops, curve == mid_cam_end);
}

TEST(EcamtbxRotary, BothLawsShareTheirBoundaries) {
  const auto one = make_rotary_saw(plain(3200, mid_cam_all, 1));
  const auto two = make_rotary_saw(plain(3200, mid_cam_all, 2));
  for (const auto& piece : one.profile.pieces)
    EXPECT_NEAR(at(one.profile, piece.master).position, at(two.profile, piece.master).position, 1e-9);
  EXPECT_NE(one.rows, two.rows);
}

TEST(EcamtbxRotary, TheWholeCycleSynchronous) {
  SawParameters p = ecams::rotary_demo();
  p.master_length = 600;
  p.sync_length = 1000;  // 1000 / (5/3) = 600 but for the float
  const auto made = make_rotary_saw(p);
  EXPECT_EQ(made.rows, (ecams::Rows{{0, 0}, {600, 1000}}));
  EXPECT_DOUBLE_EQ(made.profile.sync_end, 600);
}

TEST(EcamtbxFlySaw, UniformRunsAtTheRatioAllTheWay) {
  auto p = ecams::fly_demo();
  p.acceleration = 0;
  p.sync_ratio = 4;
  EXPECT_EQ(make_fly_saw(p).rows, (ecams::Rows{{0, 0}, {500, 2000}, {1750, 2000}, {2250, 0}, {3500, 0}}));
}

TEST(EcamtbxFlySaw, IgnoresTheCurve) {
  auto p = ecams::fly_demo();
  const auto rows = make_fly_saw(p).rows;
  for (const auto curve : std::initializer_list<std::uint16_t>{1, 4, 0x1000, 0xFFFF}) {
    p.curve = curve;
    EXPECT_EQ(make_fly_saw(p).rows, rows);
  }
}

TEST(EcamtbxFlySaw, JustFits) {
  SawParameters p = ecams::fly_demo();
  p.sync_ratio = 2;
  p.slave_length = 1000;
  p.sync_length = 200;
  p.master_length = 900;  // (2 * 800 + 200) / 2
  ecams::expect_sound(make_fly_saw(p), {1800, 0});
  p.master_length = 899;
  EXPECT_EQ(make_fly_saw(p).code(), -3);
}

TEST(EcamtbxSCurve, TooShortForItsSpeedKeepsTheTimes) {
  auto p = ecams::s_curve_demo();
  p.length = 3000;  // 2 * 3000 / 0.2 s = 30 kHz
  const auto made = make_s_curve(EcamType::s_curve_0, p);
  ecams::expect_sound(made, {2000, 3000});
  EXPECT_EQ(made.speed_reached, 30000);
  EXPECT_EQ(made.uniform_time, 0);
  EXPECT_TRUE(ecams::has(made, {1000, 1500}));
}

TEST(EcamtbxSCurve, WithoutRampsItIsALine) {
  auto p = ecams::s_curve_demo();
  p.acceleration = p.deceleration = 0;
  EXPECT_EQ(make_s_curve(EcamType::s_curve_1, p).rows, (ecams::Rows{{0, 0}, {2000, 10000}}));
}

TEST(EcamtbxSCurve, BackwardsIsTheMirror) {
  auto p = ecams::s_curve_demo();
  const auto forward = make_s_curve(EcamType::s_curve_1, p).rows;
  p.length = -10000;
  const auto back = make_s_curve(EcamType::s_curve_1, p).rows;
  ASSERT_EQ(forward.size(), back.size());
  for (std::size_t i = 0; i < back.size(); ++i) EXPECT_EQ(back[i].slave, -forward[i].slave);
}

TEST(EcamtbxSCurve, TheTwoTypesDifferOnlyInsideTheRamps) {
  const auto zero = make_s_curve(EcamType::s_curve_0, ecams::s_curve_demo());
  const auto one = make_s_curve(EcamType::s_curve_1, ecams::s_curve_demo());
  EXPECT_NE(zero.rows, one.rows);
  EXPECT_NEAR(zero.profile.pieces[0].peak(CamOrder::acceleration), std::numbers::pi * 5 / 2000, 1e-12);
  EXPECT_NEAR(one.profile.pieces[0].peak(CamOrder::acceleration), 2 * 5 / 1000.0, 1e-12);
}

}  // namespace
}  // namespace drycut::devices::lx3vp
