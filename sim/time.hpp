#pragma once
#include <cstdint>
#include <limits>
#include <string>

namespace drycut::sim {

/// Simulated time: an integer count of nanoseconds. No floating-point time accumulates anywhere.
using Time = std::int64_t;

inline constexpr Time microsecond = 1'000;
inline constexpr Time millisecond = 1'000'000;
inline constexpr Time second = 1'000'000'000;
inline constexpr Time never = std::numeric_limits<Time>::max();

inline constexpr double seconds(Time time) { return static_cast<double>(time) / 1e9; }
/// "12.0004": in seconds, exact.
std::string seconds_text(Time time);

}  // namespace drycut::sim
