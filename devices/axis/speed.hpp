#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "devices/axis/position.hpp"

namespace drycut::devices::axis {

/// Um/s of one unit of a speed parameter: whole units of measure per second or minute (spec 1.5).
/// decpt 0..3, others taken as the nearest; unitvel 1 = per second, else per minute.
inline double um_per_second(std::int32_t decpt, std::int32_t unitvel) {
  constexpr std::array<double, 4> powers = {1, 10, 100, 1000};
  const double um = powers[static_cast<std::size_t>(std::clamp(decpt, 0, 3))];
  return unitvel == 1 ? um : um / 60;
}

/// Bits x4 of one Um.
inline double bits_per_um(Resolution r) {
  return static_cast<double>(r.pulse) / static_cast<double>(r.measure);
}

/// A value as a 32-bit variable shows it: nearest, held at the ends of the range.
inline std::int32_t to_long(double value) {
  constexpr double limit = 2147483647.0;
  if (!(value > -limit)) return -2147483647;
  if (value >= limit) return 2147483647;
  return static_cast<std::int32_t>(value < 0 ? value - 0.5 : value + 0.5);
}

}  // namespace drycut::devices::axis
