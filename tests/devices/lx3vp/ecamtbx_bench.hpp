#pragma once
// Parameters and expectations for the tests of ECAMTBX.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "devices/lx3vp/ecamtbx.hpp"
#include "devices/lx3vp/registers.hpp"

namespace drycut::devices::lx3vp::ecams {

using Rows = std::vector<CamTableRow>;

inline void PrintTo(const CamTableRow& row, std::ostream* out) {
  *out << "(" << row.master << ", " << row.slave << ")";
}

/// The manual's rotary saw (appendix 1.3); the list says law 0 and calls it uniform acceleration, which is 1.
inline SawParameters rotary_demo(std::uint16_t curve = left_cam) {
  return {.master_length = 3183,
          .slave_length = 1000,
          .sync_length = 333,
          .sync_ratio = 5.0F / 3.0F,
          .max_ratio = 50.0F / 3.0F,
          .acceleration = 1,
          .curve = curve,
          .resolution = 0};
}
/// The manual's fly saw (appendix 2.3).
inline SawParameters fly_demo() {
  return {.master_length = 1750,
          .slave_length = 2000,
          .sync_length = 667,
          .sync_ratio = static_cast<float>(3 * std::numbers::pi),
          .max_ratio = 10,
          .acceleration = 1,
          .curve = left_cam,
          .resolution = 0};
}
/// The manual's S-curve (appendix 3.2).
inline SCurveParameters s_curve_demo() {
  return {.length = 10000, .top_speed = 50000, .acceleration = 100, .deceleration = 100, .resolution = 200};
}

/// Writes a list as a program does, from D`first` on.
inline void put(Registers& d, int first, const SawParameters& p) {
  d.set_i32(first, p.master_length);
  d.set_i32(first + 2, p.slave_length);
  d.set_i32(first + 4, p.sync_length);
  d.set_f32(first + 6, p.sync_ratio);
  d.set_f32(first + 8, p.max_ratio);
  d.set_i16(first + 10, static_cast<std::int16_t>(p.acceleration));
  d.set_i16(first + 11, static_cast<std::int16_t>(p.curve));
  d.set_i16(first + 12, static_cast<std::int16_t>(p.resolution));
}
inline void put(Registers& d, int first, const SCurveParameters& p) {
  d.set_i32(first, p.length);
  d.set_i32(first + 2, p.top_speed);
  d.set_i16(first + 6, p.acceleration);
  d.set_i16(first + 7, p.deceleration);
  d.set_i16(first + 8, static_cast<std::int16_t>(p.resolution));
}

/// Whether a table has this row.
inline bool has(const EcamResult& result, CamTableRow row) {
  for (const auto& r : result.rows)
    if (r == row) return true;
  return false;
}

/// A table from (0, 0) to its end, the master going up, as many rows as D1 says.
inline void expect_sound(const EcamResult& result, CamTableRow end) {
  ASSERT_TRUE(result.ok()) << error_text(result.error);
  ASSERT_GE(result.rows.size(), 2U);
  EXPECT_EQ(result.code(), static_cast<std::int32_t>(result.rows.size()));
  EXPECT_EQ(result.rows.front(), (CamTableRow{0, 0}));
  EXPECT_EQ(result.rows.back(), end);
  for (std::size_t i = 1; i < result.rows.size(); ++i)
    ASSERT_GT(result.rows[i].master, result.rows[i - 1].master);
}

/// Ratios at the boundaries of the pieces, as the pieces have them: continuous where the law is no step.
inline double largest_ratio(const CamProfile& profile) {
  double most = 0;
  for (const auto& piece : profile.pieces) most = std::max(most, piece.peak(CamOrder::velocity));
  return most;
}

}  // namespace drycut::devices::lx3vp::ecams
