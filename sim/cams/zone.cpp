#include "sim/cams/zone.hpp"

#include <cmath>

namespace drycut::sim::cams {

namespace {
constexpr double same = 1e-9;
}

bool is_master_speed(double speed) { return std::abs(speed - 1) <= same; }

std::string motion_name(double entry, double exit, bool steady) {
  if (steady && std::abs(entry) <= same) return "dwell";
  if (steady) return is_master_speed(entry) ? "synchronism" : entry < 0 ? "return" : "constant speed";
  if (std::abs(exit) > std::abs(entry) + same) return "acceleration";
  if (std::abs(exit) < std::abs(entry) - same) return "deceleration";
  return "compensation";
}

}  // namespace drycut::sim::cams
