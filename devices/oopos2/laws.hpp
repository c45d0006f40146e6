#pragma once
#include <algorithm>
#include <cstdint>

namespace drycut::devices::oopos2 {

// The laws of OOPOS2 as plain functions (001 1.4.5 to 1.4.7; spec qem.md 9.3 to 9.5).

/// A position or a way, exact: in parts of 1/4 000 000 Um. One bit x4 is 10 cntratio of them.
using Parts = std::int64_t;
inline constexpr Parts parts_per_um = 4'000'000;
inline constexpr Parts parts_per_tenth = parts_per_um / 10;  ///< of Um/10, the unit of the QPS parameters

/// Parameters of the slow range.
struct Slowdown {
  std::int32_t slowtype = 0;  ///< 1 in proportion to the speed, 2 to its square
  std::int32_t maxslow = 0;   ///< [Um] at maxvel
  std::int32_t minslow = 0;   ///< [Um] at least; stronger than maxslow
  std::int32_t maxvel = 0;    ///< [speed]
};

/// Slow range at the speed `vel` >= 0 [Um], whole, the rest cut off (D37). Without a maxvel it is maxslow; a
/// maxvel above ten million, far outside its range, acts as that.
inline std::int32_t slow_range(const Slowdown& s, std::int32_t vel) {
  const std::int64_t full = std::min(s.maxvel, 10'000'000);
  std::int64_t range = s.maxslow;
  if (full > 0 && vel < full)
    range = s.slowtype == 2 ? range * vel * vel / (full * full) : range * vel / full;
  return static_cast<std::int32_t>(std::max<std::int64_t>(range, s.minslow));
}

/// Band 0..ninert-1 in which a quota [Um/10] lies between minpos and maxpos [Um]; beyond them the outermost.
inline int inertia_band(std::int64_t quota, std::int32_t minpos, std::int32_t maxpos, std::int32_t ninert) {
  const std::int64_t bands = std::clamp(ninert, 1, 8);
  const std::int64_t width = (std::int64_t{maxpos} - minpos) * 10;
  const std::int64_t way = quota - std::int64_t{minpos} * 10;
  if (width <= 0 || way <= 0) return 0;
  return static_cast<int>(std::min(way * bands / width, bands - 1));
}

/// Row 0..15 of the inertias iner01 to iner16 (001 1.4.6).
inline int inertia_row(int band, bool two_a_band, bool backward) {
  return two_a_band ? 2 * band + (backward ? 1 : 0) : band;
}

/// True if the axis stands within `less` short of its quota to `more` beyond it [Um/10]; `off` is position
/// minus quota.
inline bool in_tolerance(Parts off, std::int32_t more, std::int32_t less) {
  return off <= more * parts_per_tenth && off >= -less * parts_per_tenth;
}

inline constexpr std::int32_t largest_inertia = 32767;  ///< [Um/10] that an inertia's word holds

/// Way that the axis coasted in a placement that used `inertia` and ended `beyond` its quota in its
/// direction, to the nearest Um/10 (D38).
inline std::int64_t coasted_way(std::int32_t inertia, Parts beyond) {
  const Parts half = beyond < 0 ? -parts_per_tenth / 2 : parts_per_tenth / 2;
  return inertia + (beyond + half) / parts_per_tenth;
}

/// Inertia after such a placement: the way coasted, as far as its word holds it.
inline std::int32_t recalculated_inertia(std::int32_t inertia, Parts beyond) {
  return static_cast<std::int32_t>(std::clamp<Parts>(coasted_way(inertia, beyond), 0, largest_inertia));
}

}  // namespace drycut::devices::oopos2
