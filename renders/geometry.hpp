#pragma once
#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "renders/scene3d.hpp"

namespace drycut::renders {

// Eigen's types under short names, and what pictures need besides. Metres, right-handed, y up; matrices
// column-major as GL reads them.

using Matrix4 = Eigen::Matrix4d;
/// A box along the world axes [m]; empty to begin with.
using Extent = Eigen::AlignedBox3d;

/// For OpenGL and files.
inline std::array<float, 3> as_floats(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}
inline Vec3 as_doubles(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }

/// The rotation `turn` x y z w, which need not be of unit length (but not zero).
inline Eigen::Quaterniond rotation_of(const Vec4& turn) { return Eigen::Quaterniond(turn).normalized(); }

/// All eight corners.
inline std::array<Vec3, 8> corners_of(const Extent& box) {
  std::array<Vec3, 8> corners;
  for (int i = 0; i < 8; ++i)
    corners[static_cast<std::size_t>(i)] = box.corner(static_cast<Extent::CornerType>(i));
  return corners;
}

/// World to eye coordinates: x right, y up, looking along -z.
inline Matrix4 look_at(const Vec3& eye, const Vec3& target) {
  const Vec3 forward = (target - eye).normalized();
  const Vec3 up_hint = std::abs(forward.y()) > 0.999 ? Vec3::UnitX() : Vec3::UnitY();
  const Vec3 right = forward.cross(up_hint).normalized();
  Eigen::Matrix3d axes;
  axes << right.transpose(), right.cross(forward).transpose(), -forward.transpose();
  Matrix4 look = Matrix4::Identity();
  look.topLeftCorner<3, 3>() = axes;
  look.topRightCorner<3, 1>() = -axes * eye;
  return look;
}

inline Matrix4 perspective(double vertical_field_of_view_rad, double aspect, double near, double far) {
  const double f = 1 / std::tan(vertical_field_of_view_rad / 2);
  Matrix4 m = Vec4(f / aspect, f, (far + near) / (near - far), 0).asDiagonal();
  m(2, 3) = 2 * far * near / (near - far);
  m(3, 2) = -1;
  return m;
}

}  // namespace drycut::renders
