#include "devices/camming4/sector.hpp"

#include <algorithm>
#include <cmath>

namespace drycut::devices::camming4 {
namespace {

std::int64_t limited(std::int64_t value) { return std::clamp(value, -grain_limit, grain_limit); }

std::int64_t floor_divide(std::int64_t a, std::int64_t b) { return a / b - (a % b < 0 ? 1 : 0); }

/// The fraction brought back into 0..1, from -1..2.
Space carried(std::int64_t grains, double fraction) {
  if (fraction < 0) {
    fraction += 1;
    --grains;
  }
  if (fraction >= 1) {
    fraction -= 1;
    ++grains;
  }
  return {limited(grains), fraction};
}

}  // namespace

GrainResolution usable(GrainResolution resolution) {
  constexpr std::int64_t most = std::int64_t{1} << 30;
  return {std::clamp<std::int64_t>(resolution.measure, 1, most),
          std::clamp<std::int64_t>(resolution.pulse, 1, most)};
}

std::int64_t add(std::int64_t a, std::int64_t b) {
  std::int64_t sum = 0;
  if (__builtin_add_overflow(a, b, &sum)) return a < 0 ? -grain_limit : grain_limit;
  return limited(sum);
}

std::int64_t subtract(std::int64_t a, std::int64_t b) {
  std::int64_t difference = 0;
  if (__builtin_sub_overflow(a, b, &difference)) return a < 0 ? -grain_limit : grain_limit;
  return limited(difference);
}

std::int64_t multiply(std::int64_t a, std::int64_t b) {
  std::int64_t product = 0;
  if (__builtin_mul_overflow(a, b, &product)) return (a < 0) != (b < 0) ? -grain_limit : grain_limit;
  return limited(product);
}

Space space(double grains) {
  constexpr auto limit = static_cast<double>(grain_limit);
  const double bounded = std::clamp(grains, -limit, limit);
  const double whole = std::floor(bounded);
  return {static_cast<std::int64_t>(whole), bounded - whole};
}

Space operator+(Space a, Space b) { return carried(add(a.grains, b.grains), a.fraction + b.fraction); }

Space operator-(Space a) { return carried(-a.grains, -a.fraction); }

bool operator<(const Space& a, const Space& b) {
  return a.grains != b.grains ? a.grains < b.grains : a.fraction < b.fraction;
}

double to_double(const Space& length) { return static_cast<double>(length.grains) + length.fraction; }

Point moved(const Point& point, Space length, std::int64_t measure) {
  const Space rest = Space{point.part, point.fraction} + length;
  const std::int64_t whole = floor_divide(rest.grains, measure);
  return {add(point.bits, whole), rest.grains - whole * measure, rest.fraction};
}

Point point(std::int64_t bits, double fraction, std::int64_t measure) {
  return moved({limited(bits), 0, 0}, space(fraction * static_cast<double>(measure)), measure);
}

Space between(const Point& from, const Point& to, std::int64_t measure) {
  const std::int64_t whole = multiply(subtract(to.bits, from.bits), measure);
  return carried(add(whole, to.part - from.part), to.fraction - from.fraction);
}

}  // namespace drycut::devices::camming4
