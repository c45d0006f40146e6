#pragma once
#include <array>
#include <cmath>

namespace drycut::renders {

// The little linear algebra that pictures need. Metres, right-handed, y up; matrices column-major as GL reads
// them.

using Vec3 = std::array<double, 3>;
using Quaternion = std::array<double, 4>;  ///< x y z w
using Matrix4 = std::array<double, 16>;

/// For OpenGL and files.
template <std::size_t N>
std::array<float, N> as_floats(const std::array<double, N>& values) {
  std::array<float, N> floats{};
  for (std::size_t i = 0; i < N; ++i) floats[i] = static_cast<float>(values[i]);
  return floats;
}
inline Vec3 as_doubles(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }

inline Vec3 operator+(const Vec3& a, const Vec3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Vec3 operator-(const Vec3& a, const Vec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Vec3 operator*(double s, const Vec3& a) { return {s * a[0], s * a[1], s * a[2]}; }
inline double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double length(const Vec3& a) { return std::sqrt(dot(a, a)); }
/// `a` with length 1; the zero vector stays as it is.
inline Vec3 normalised(const Vec3& a) {
  const double size = length(a);
  return size > 0 ? (1 / size) * a : a;
}

/// `v` turned by the rotation `q`, which need not be of unit length (but not zero).
inline Vec3 rotated(const Quaternion& q, const Vec3& v) {
  const double norm2 = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
  const Vec3 axis = {q[0], q[1], q[2]};
  const Vec3 t = (2 / norm2) * cross(axis, v);
  return v + q[3] * t + cross(axis, t);
}

inline Matrix4 multiplied(const Matrix4& a, const Matrix4& b) {
  Matrix4 product{};
  for (std::size_t column = 0; column < 4; ++column) {
    for (std::size_t row = 0; row < 4; ++row) {
      double sum = 0;
      for (std::size_t k = 0; k < 4; ++k) sum += a[k * 4 + row] * b[column * 4 + k];
      product[column * 4 + row] = sum;
    }
  }
  return product;
}

/// World to eye coordinates: x right, y up, looking along -z.
inline Matrix4 look_at(const Vec3& eye, const Vec3& target) {
  const Vec3 forward = normalised(target - eye);
  const Vec3 up_hint = std::abs(forward[1]) > 0.999 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 right = normalised(cross(forward, up_hint));
  const Vec3 up = cross(right, forward);
  return {right[0],         up[0],         -forward[0],       0,  //
          right[1],         up[1],         -forward[1],       0,  //
          right[2],         up[2],         -forward[2],       0,  //
          -dot(right, eye), -dot(up, eye), dot(forward, eye), 1};
}

inline Matrix4 perspective(double vertical_field_of_view_rad, double aspect, double near, double far) {
  const double f = 1 / std::tan(vertical_field_of_view_rad / 2);
  return {f / aspect,
          0,
          0,
          0,
          0,
          f,
          0,
          0,
          0,
          0,
          (far + near) / (near - far),
          -1,
          0,
          0,
          2 * far * near / (near - far),
          0};
}

/// A box of half width and height `radius`, from `near` to `far` in front of the eye.
inline Matrix4 orthographic(double radius, double near, double far) {
  return {
      1 / radius, 0, 0, 0, 0, 1 / radius, 0, 0, 0, 0, 2 / (near - far), 0, 0, 0, (far + near) / (near - far),
      1};
}

}  // namespace drycut::renders
