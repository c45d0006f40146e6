// Every error of ECAMTBX, and 10 000 random parameter sets: a right table or the error, never a wrong table.
#include <gmock/gmock.h>

#include <bit>
#include <limits>
#include <random>

#include "devices/lx3vp/ecamtbx_registers.hpp"
#include "tests/devices/lx3vp/ecamtbx_bench.hpp"

namespace drycut::devices::lx3vp {
namespace {

template <typename Change>
std::int32_t rotary(const Change& change) {
  auto p = ecams::rotary_demo();
  change(p);
  const auto made = make_rotary_saw(p);
  EXPECT_EQ(made.rows.empty(), !made.ok());
  return made.code();
}
template <typename Change>
std::int32_t fly(const Change& change) {
  auto p = ecams::fly_demo();
  change(p);
  return make_fly_saw(p).code();
}
template <typename Change>
std::int32_t s_curve(const Change& change) {
  auto p = ecams::s_curve_demo();
  change(p);
  return make_s_curve(EcamType::s_curve_0, p).code();
}
using P = SawParameters;
using S = SCurveParameters;

TEST(EcamtbxErrors, NoSuchLawOrCurve) {
  EXPECT_EQ(rotary([](P& p) { p.acceleration = 3; }), -1);
  for (const auto curve : std::initializer_list<std::uint16_t>{4, 6, 0x2000, 0x1004})
    EXPECT_EQ(rotary([&](P& p) { p.curve = curve; }), -1);
  EXPECT_EQ(fly([](P& p) { p.acceleration = 3; }), -1);
  EXPECT_EQ(make_s_curve(EcamType::fly_saw, ecams::s_curve_demo()).code(), -1);
}

TEST(EcamtbxErrors, Lengths) {
  EXPECT_EQ(rotary([](P& p) { p.master_length = 0; }), -2);
  EXPECT_EQ(rotary([](P& p) { p.master_length = -1; }), -2);
  EXPECT_EQ(rotary([](P& p) { p.slave_length = 0; }), -2);
  EXPECT_EQ(rotary([](P& p) { p.sync_length = -1; }), -2);
  EXPECT_EQ(fly([](P& p) { p.master_length = 1073741824; }), -2);  // twice that is no 32-bit number
  EXPECT_EQ(s_curve([](S& p) { p.length = 0; }), -2);
  EXPECT_EQ(s_curve([](S& p) { p = {2147483647, 1, 0, 0, 100}; }), -2);  // 7000 years of ticks
  // The largest negative slave has no positive counterpart.
  EXPECT_EQ(rotary([](P& p) {
              p = {1000000, std::numeric_limits<std::int32_t>::min(), 0, 1000, 9000, 1, 0x1000, 0};
            }),
            200);
}

TEST(EcamtbxErrors, SynchronousZone) {
  EXPECT_EQ(rotary([](P& p) { p.sync_length = 1001; }), -3);                // longer than the slave
  EXPECT_EQ(rotary([](P& p) { p.master_length = 199; }), -3);               // shorter than the zone
  EXPECT_EQ(rotary([](P& p) { p = {100, 300, 200, 2, 9, 1, 0, 0}; }), -3);  // fills it, slave left over
  EXPECT_EQ(fly([](P& p) { p.master_length = 353; }), -3);                  // the stroke needs 353.64
  EXPECT_GT(fly([](P& p) { p.master_length = 354; }), 0);
}

TEST(EcamtbxErrors, Ratios) {
  EXPECT_EQ(rotary([](P& p) { p.max_ratio = 1.6F; }), -4);
  EXPECT_EQ(fly([](P& p) { p.max_ratio = 9; }), -4);
  EXPECT_EQ(rotary([](P& p) { p = {1100, 3200, 200, 2, 2.9F, 1, 0, 0}; }), -4);  // needs 3 on average
  EXPECT_EQ(rotary([](P& p) { p = {1100, 3200, 200, 2, 3, 1, 0, 0}; }),
            -4);  // 3 would have to be there at once
  EXPECT_EQ(rotary([](P& p) { p = {1100, 3200, 200, 2, 3, 0, 0, 0}; }), 3);  // as without ramps it is
  EXPECT_EQ(rotary([](P& p) { p = {1100, 2200, 200, 2, 3, 1, mid_cam_begin, 0}; }),
            -4);  // needs 3.41 from rest
}

TEST(EcamtbxErrors, Resolution) {
  for (const auto rows : std::initializer_list<std::uint16_t>{1, 9, 513, 65535}) {
    EXPECT_EQ(rotary([&](P& p) { p.resolution = rows; }), -5);
    EXPECT_EQ(fly([&](P& p) { p.resolution = rows; }), -5);
  }
  EXPECT_EQ(rotary([](P& p) { p.resolution = 10; }), 10);
  EXPECT_EQ(rotary([](P& p) { p.resolution = 512; }), 512);
  // Eight pieces and four ramps of the fly saw need nine boundaries and four rows inside.
  EXPECT_EQ(fly([](P& p) { p.resolution = 12; }), -5);
  EXPECT_EQ(fly([](P& p) { p.resolution = 13; }), 13);
  for (const auto rows : std::initializer_list<std::uint16_t>{0, 50, 513})
    EXPECT_EQ(s_curve([&](S& p) { p.resolution = rows; }), -5);
  // A ramp over less than two pulses of the master cannot be one.
  EXPECT_EQ(rotary([](P& p) { p = {1000, 101, 100, 1, 2, 1, 0, 0}; }), -5);
  EXPECT_EQ(s_curve([](S& p) { p = {1, 150000, 0, 0, 51}; }), -5);  // over within a tick
}

TEST(EcamtbxErrors, SpeedsAndTimes) {
  EXPECT_EQ(s_curve([](S& p) { p.top_speed = 0; }), -6);
  EXPECT_EQ(s_curve([](S& p) { p.top_speed = 150001; }), -6);
  EXPECT_EQ(s_curve([](S& p) { p.acceleration = -1; }), -6);
  EXPECT_EQ(s_curve([](S& p) { p.deceleration = -1; }), -6);
  EXPECT_GT(s_curve([](S& p) { p.top_speed = 150000; }), 0);
}

TEST(EcamtbxErrors, NoNumbers) {
  for (const float value :
       {0.0F, -1.0F, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
    EXPECT_EQ(rotary([&](P& p) { p.sync_ratio = value; }), -8);
    EXPECT_EQ(rotary([&](P& p) { p.max_ratio = value; }), -8);
    EXPECT_EQ(fly([&](P& p) { p.sync_ratio = value; }), -8);
  }
}

TEST(EcamtbxErrors, EveryErrorHasItsWords) {
  for (int code = -8; code <= 0; ++code)
    EXPECT_FALSE(error_text(static_cast<EcamError>(code)).empty()) << code;
}

TEST(EcamtbxErrors, AnIntegerWhereAFloatBelongsIsToldAsSuch) {
  Registers registers;
  const auto told = [&](std::int32_t p4, std::int32_t p5) {
    registers.set_i32(500, 16000);
    registers.set_i32(502, 20000);
    registers.set_i32(506, p4);
    registers.set_i32(508, p5);
    const auto error = make_rotary_saw(read_saw_parameters(registers, 500)).error;
    return ecamtbx_fault(registers, 500, 100, error);
  };
  const auto two = std::bit_cast<std::int32_t>(2.0F);
  EXPECT_THAT(told(2, 10),
              ::testing::HasSubstr("a float that looks like the integer 2; write DEMOV E2.0 D506"));
  EXPECT_THAT(told(two, 10), ::testing::HasSubstr("looks like the integer 10; write DEMOV E10.0 D508"));
  EXPECT_THAT(told(-2, two), ::testing::HasSubstr("looks like the integer -2"));
  EXPECT_THAT(told(0, two), ::testing::Not(::testing::HasSubstr("integer")));
  EXPECT_THAT(told(two, std::bit_cast<std::int32_t>(1.5F)), ::testing::Not(::testing::HasSubstr("integer")));
}

// Random sets.

class Dice {
 public:
  std::int64_t whole(std::int64_t low, std::int64_t high) {
    return low + static_cast<std::int64_t>(random_() % static_cast<std::uint64_t>(high - low + 1));
  }
  double real(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() >> 11) / 9007199254740992.0;
  }

 private:
  std::mt19937_64 random_{20240517};
};

SawParameters random_saw(Dice& dice) {
  SawParameters p;
  const auto most = static_cast<std::int32_t>(std::pow(10, dice.real(1, 8)));
  p.master_length = static_cast<std::int32_t>(dice.whole(dice.whole(0, 50) == 0 ? -5 : 1, most));
  const double mean = std::pow(10, dice.real(-1.5, 1.2));
  p.slave_length = static_cast<std::int32_t>(std::clamp(p.master_length * mean, -2e9, 2e9));
  p.sync_length = static_cast<std::int32_t>(p.slave_length * dice.real(-0.01, 1.02));
  p.sync_ratio = static_cast<float>(dice.whole(0, 9) == 0 ? mean : mean * std::pow(10, dice.real(-0.5, 1)));
  p.max_ratio = static_cast<float>(p.sync_ratio * dice.real(0.98, 4));
  p.acceleration = static_cast<std::uint16_t>(dice.whole(0, 40) == 0 ? 3 : dice.whole(0, 2));
  p.curve = static_cast<std::uint16_t>(dice.whole(0, 5) + (dice.whole(0, 4) == 0 ? return_square : 0));
  p.resolution = static_cast<std::uint16_t>(dice.whole(0, 1) == 0 ? 0 : dice.whole(8, 514));
  if (dice.whole(0, 3) == 0) p.slave_length = -p.slave_length;
  return p;
}

/// What any right table of a saw keeps: monotone strokes, no piece steeper than P5 but for the rounding of
/// its ends, rows within half a pulse of the law.
void expect_right(const SawParameters& p, const EcamResult& made, bool returns) {
  const double limit = static_cast<double>(p.max_ratio) * (1 + 2e-6);
  ASSERT_LE(ecams::largest_ratio(made.profile), limit);
  const int sense = made.profile.pieces.empty()                                            ? 1
                    : (p.slave_length < 0 || (!returns && (p.curve & return_square) != 0)) ? -1
                                                                                           : 1;
  for (std::size_t i = 1; i < made.rows.size(); ++i) {
    const auto& from = made.rows[i - 1];
    const auto& to = made.rows[i];
    const double rise = static_cast<double>(to.slave) - from.slave;
    const double run = static_cast<double>(to.master) - from.master;
    ASSERT_LE(std::abs(rise), limit * run + 1.001);
    const bool back = returns && from.master >= p.master_length;
    ASSERT_GE(rise * (back ? -sense : sense), 0) << "row " << i;
    const double law = at(made.profile, to.master).position;
    ASSERT_NEAR(to.slave, law, 0.5 + 1e-6 + 1e-9 * std::abs(law));
  }
}

std::string text(const SawParameters& p) {
  return std::to_string(p.master_length) + " " + std::to_string(p.slave_length) + " " +
         std::to_string(p.sync_length) + " " + std::to_string(p.sync_ratio) + " " +
         std::to_string(p.max_ratio) + " " + std::to_string(p.acceleration) + " " + std::to_string(p.curve) +
         " " + std::to_string(p.resolution);
}

TEST(EcamtbxRandom, RotarySawsAreRightOrRefused) {
  Dice dice;
  std::array<int, 9> count{};
  for (int i = 0; i < 5000; ++i) {
    const auto p = random_saw(dice);
    SCOPED_TRACE(text(p));
    const auto made = make_rotary_saw(p);
    ++count.at(static_cast<std::size_t>(-static_cast<int>(made.error)));
    if (!made.ok()) continue;
    const auto end = (p.curve & return_square) != 0 ? -std::abs(p.slave_length) : p.slave_length;
    ecams::expect_sound(made, {p.master_length, end});
    expect_right(p, made, false);
    if (HasFatalFailure()) return;
    ASSERT_LE(made.rows.size(), p.resolution == 0 ? 200U : p.resolution);
    ASSERT_NEAR(made.profile.master_length, p.master_length, 1e-6 * p.master_length);
    ASSERT_NEAR(made.profile.slave_length, end, 1e-6 * std::abs(static_cast<double>(end)) + 1e-6);
    // Ratios meet where pieces do, but for the steps of law 0 and of a slave that has no way to brake.
    for (std::size_t n = 1; p.acceleration != 0 && n < made.profile.pieces.size(); ++n) {
      const double step =
          std::abs(ratio_of(made.profile.pieces[n]).r0 - ratio_of(made.profile.pieces[n - 1]).r1);
      ASSERT_TRUE(step <= 2e-6 * std::abs(p.sync_ratio) || p.sync_length == std::abs(p.slave_length)) << n;
    }
  }
  EXPECT_GT(count[0], 1000);
  for (const int code : {1, 2, 3, 4, 5}) EXPECT_GT(count[static_cast<std::size_t>(code)], 10) << -code;
}

TEST(EcamtbxRandom, FlySawsAreRightOrRefused) {
  Dice dice;
  std::array<int, 9> count{};
  for (int i = 0; i < 3000; ++i) {
    auto p = random_saw(dice);
    if (i % 2 == 0) p.sync_ratio = p.max_ratio;
    SCOPED_TRACE(text(p));
    const auto made = make_fly_saw(p);
    ++count.at(static_cast<std::size_t>(-static_cast<int>(made.error)));
    if (!made.ok()) continue;
    ecams::expect_sound(made, {2 * p.master_length, 0});
    expect_right(p, made, true);
    if (HasFatalFailure()) return;
    ASSERT_NEAR(at(made.profile, p.master_length).position, p.slave_length,
                1e-9 * std::abs(static_cast<double>(p.slave_length)));
  }
  EXPECT_GT(count[0], 300);
  EXPECT_GT(count[3], 300);
}

TEST(EcamtbxRandom, SCurvesAreRightOrRefused) {
  Dice dice;
  int made_right = 0;
  for (int i = 0; i < 2000; ++i) {
    SCurveParameters p;
    p.length = static_cast<std::int32_t>(std::pow(10, dice.real(0, 9))) * (dice.whole(0, 1) == 0 ? 1 : -1);
    p.top_speed = static_cast<std::int32_t>(dice.whole(0, 5) == 0 ? dice.real(-1, 150010)
                                                                  : std::pow(10, dice.real(0, 5.17)));
    p.acceleration = static_cast<std::int16_t>(dice.whole(0, 4) == 0 ? 0 : dice.whole(-5, 3000));
    p.deceleration = static_cast<std::int16_t>(dice.whole(0, 4) == 0 ? 0 : dice.whole(-5, 32767));
    p.resolution = static_cast<std::uint16_t>(dice.whole(50, 513));
    SCOPED_TRACE(std::to_string(p.length) + " " + std::to_string(p.top_speed) + " " +
                 std::to_string(p.acceleration) + " " + std::to_string(p.deceleration));
    const auto made = make_s_curve(dice.whole(0, 1) == 0 ? EcamType::s_curve_0 : EcamType::s_curve_1, p);
    if (!made.ok()) continue;
    ++made_right;
    ecams::expect_sound(made, {made.rows.back().master, p.length});
    ASSERT_LE(made.rows.size(), p.resolution);
    ASSERT_LE(made.speed_reached, p.top_speed);
    const double limit = p.top_speed * 1e-4 * (1 + 1e-9);
    ASSERT_LE(ecams::largest_ratio(made.profile), limit);
    for (std::size_t n = 1; n < made.rows.size(); ++n) {
      const double rise =
          (static_cast<double>(made.rows[n].slave) - made.rows[n - 1].slave) * (p.length < 0 ? -1 : 1);
      ASSERT_GE(rise, 0);
      // The last row's master is rounded too: up to half a tick of speed more.
      ASSERT_LE(rise, limit * (made.rows[n].master - made.rows[n - 1].master + 0.5) + 1.001);
    }
  }
  EXPECT_GT(made_right, 500);
}

}  // namespace
}  // namespace drycut::devices::lx3vp
