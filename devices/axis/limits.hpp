#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "devices/device.hpp"

// The software limits minpos and maxpos, as START and the manual movements of every positioner take them.
namespace drycut::devices::axis {

/// A quota held between the limits; minpos is the stronger where they are crossed.
inline std::int32_t held(std::int32_t quota, std::int32_t minpos, std::int32_t maxpos) {
  return std::max(minpos, std::min(quota, maxpos));
}

/// What START says of a setpos that it does not go to.
inline Diagnostic outside_limits(std::int32_t setpos, std::int32_t target) {
  return {Diagnostic::Kind::note, "START",
          fmt::format("setpos {} is outside minpos..maxpos, the axis goes to {}", setpos, target)};
}

/// A manual movement has no way left to its limit.
inline bool at_limit(bool backward, std::int32_t posit, std::int32_t limit) {
  return backward ? posit <= limit : posit >= limit;
}

/// What it says of that.
inline Diagnostic no_way_left(bool backward, std::int32_t posit, std::int32_t limit) {
  return {Diagnostic::Kind::note, backward ? "MANBW" : "MANFW",
          fmt::format("posit {} is already at {} {}", posit, backward ? "minpos" : "maxpos", limit)};
}

}  // namespace drycut::devices::axis
