#pragma once
#include <array>
#include <cmath>

#include "plants/part.hpp"

namespace drycut::plants {

using Quaternion = std::array<double, 4>;  ///< x y z w

// Rotations by `angle` [rad].
[[nodiscard]] inline Quaternion about_x(double angle) {
  return {std::sin(angle / 2), 0, 0, std::cos(angle / 2)};
}
[[nodiscard]] inline Quaternion about_y(double angle) {
  return {0, std::sin(angle / 2), 0, std::cos(angle / 2)};
}
[[nodiscard]] inline Quaternion about_z(double angle) {
  return {0, 0, std::sin(angle / 2), std::cos(angle / 2)};
}

/// First `b`, then `a`.
[[nodiscard]] inline Quaternion product(const Quaternion& a, const Quaternion& b) {
  return {a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
          a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
          a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3],
          a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]};
}

/// A pose turned by `angle` [rad] about z.
[[nodiscard]] inline Pose turned(double x, double y, double z, double angle) {
  return {{x, y, z}, about_z(angle)};
}

}  // namespace drycut::plants
