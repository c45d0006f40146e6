#include "devices/camming4/laws.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace drycut::devices::camming4 {
namespace {

constexpr double pi = std::numbers::pi;

std::uint64_t square(std::int32_t value) {
  const std::int64_t wide = value;
  return static_cast<std::uint64_t>(wide * wide);
}

/// The angle of the axis's speed zero (0) towards its speed maximum (pi/2), of period pi, in the direction of
/// running: |v| = sin, |dv/dm| = cos/radius, for x and y alike.
double phase(const Arc& arc, ArcAxis axis) {
  const double angle = axis == ArcAxis::x ? arc.start_angle : arc.start_angle - pi / 2;
  const double rest = std::fmod(arc.sense * angle, pi);
  return rest < 0 ? rest + pi : rest;
}

}  // namespace

int arc_error(std::int32_t radius, std::int32_t dx, std::int32_t dy) {
  if (dx == 0 && dy == 0) return radius != 0 ? 51 : 0;
  const std::uint64_t chord = square(dx) + square(dy);
  const std::uint64_t largest = square(radius);
  // 4R2 < dX2 + dY2 without leaving 64 bits.
  return chord / 4 > largest || (chord / 4 == largest && chord % 4 != 0) ? 50 : 0;
}

Arc make_arc(std::int32_t radius, std::int32_t dx, std::int32_t dy, Turn turn) {
  const double x = dx;
  const double y = dy;
  const double chord = std::hypot(x, y);
  const bool short_way = radius > 0;
  Arc arc;
  arc.radius = std::abs(static_cast<double>(radius));
  arc.sense = turn == Turn::counterclockwise ? 1 : -1;
  const double height = std::sqrt(std::max(0.0, (arc.radius - chord / 2) * (arc.radius + chord / 2)));
  // The centre lies left of the chord for the short way counterclockwise and the long way clockwise.
  const double side = (turn == Turn::counterclockwise) == short_way ? 1 : -1;
  arc.centre_x = x / 2 - side * height * y / chord;
  arc.centre_y = y / 2 + side * height * x / chord;
  arc.start_angle = std::atan2(-arc.centre_y, -arc.centre_x);
  const double least = 2 * std::asin(std::min(1.0, chord / (2 * arc.radius)));
  arc.sweep = short_way ? least : 2 * pi - least;
  arc.length = arc.radius * arc.sweep;
  return arc;
}

double peak_acceleration(const Arc& arc, ArcAxis axis) {
  if (axis == ArcAxis::tangent) return 0;
  const double start = phase(arc, axis);
  if (start + arc.sweep > pi) return 1 / arc.radius;
  return start < pi / 2 ? std::cos(start) / arc.radius : 0;
}

double peak_deceleration(const Arc& arc, ArcAxis axis) {
  if (axis == ArcAxis::tangent) return 0;
  const double end = phase(arc, axis) + arc.sweep;
  if (end >= pi) return 1 / arc.radius;
  return end > pi / 2 ? -std::cos(end) / arc.radius : 0;
}

}  // namespace drycut::devices::camming4
