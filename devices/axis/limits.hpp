#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "devices/device.hpp"

// What the positioners say of parameters with which they cannot do what a program asks for, and the software
// limits minpos and maxpos, as START and the manual movements of every positioner take them.
namespace drycut::devices::axis {

/// A parameter that cannot be computed with, as when it was never set: the manuals give only its range.
inline Diagnostic acts_as(std::string_view name, std::int32_t value, std::int64_t acts) {
  return {Diagnostic::Kind::out_of_range, std::string(name), fmt::format("{} acts as {}", value, acts)};
}

/// A movement begins without a speed at 10 V to scale it by.
inline Diagnostic without_maxvel(std::int32_t maxvel) {
  return {Diagnostic::Kind::out_of_range, "maxvel",
          fmt::format("{} is no speed: ramps take no time, and the output is offset alone", maxvel)};
}

/// A parameter that came too late for the running movement.
inline Diagnostic kept_for_the_next(std::string_view name) {
  return {Diagnostic::Kind::warning, std::string(name),
          "kept for the next movement, the running one cannot take it any more"};
}

/// The following error has become larger than the program lets it be; the axis only reports it.
inline Diagnostic following_error_above(std::int32_t follerr, std::int32_t maxfollerr) {
  return {Diagnostic::Kind::note, "st_foller",
          fmt::format("the following error of {} bits x4 is above maxfollerr, {}", follerr, maxfollerr)};
}

/// A quota held between the limits; minpos is the stronger where they are crossed.
inline std::int32_t held(std::int32_t quota, std::int32_t minpos, std::int32_t maxpos) {
  return std::max(minpos, std::min(quota, maxpos));
}

/// What START says of a setpos that it does not go to.
inline Diagnostic outside_limits(std::int32_t setpos, std::int32_t target) {
  return {Diagnostic::Kind::warning, "START",
          fmt::format("setpos {} is outside minpos..maxpos, the axis goes to {}", setpos, target)};
}

/// A manual movement has no way left to its limit.
inline bool at_limit(bool backward, std::int32_t posit, std::int32_t limit) {
  return backward ? posit <= limit : posit >= limit;
}

/// What it says of that.
inline Diagnostic no_way_left(bool backward, std::int32_t posit, std::int32_t limit) {
  return {Diagnostic::Kind::warning, backward ? "MANBW" : "MANFW",
          fmt::format("posit {} is already at {} {}", posit, backward ? "minpos" : "maxpos", limit)};
}

}  // namespace drycut::devices::axis
