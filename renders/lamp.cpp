#include "renders/lamp.hpp"

#include <algorithm>
#include <limits>

namespace drycut::renders {
namespace {

/// How a lamp sees something: a rectangle along its `right` and `up` [m].
struct Outline {
  std::array<double, 2> low, high;

  double area() const { return (high[0] - low[0]) * (high[1] - low[1]); }
};

Outline together(const Outline& a, const Outline& b) {
  Outline sum = a;
  for (std::size_t i = 0; i < 2; ++i) {
    sum.low[i] = std::min(a.low[i], b.low[i]);
    sum.high[i] = std::max(a.high[i], b.high[i]);
  }
  return sum;
}

Outline outline_of(const Lamp& lamp, const std::array<Vec3, 8>& thing, double border) {
  constexpr double far = std::numeric_limits<double>::infinity();
  Outline outline = {{far, far}, {-far, -far}};
  for (const Vec3& point : thing) {
    const std::array<double, 2> seen = {dot(point, lamp.right), dot(point, lamp.up)};
    outline = together(outline, {seen, seen});
  }
  for (std::size_t i = 0; i < 2; ++i) {
    outline.low[i] -= border;
    outline.high[i] += border;
  }
  return outline;
}

/// Joins what covers no more together.
void join(std::vector<Outline>& outlines) {
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    for (std::size_t k = i + 1; k < outlines.size();) {
      const Outline both = together(outlines[i], outlines[k]);
      if (both.area() > outlines[i].area() + outlines[k].area()) {
        ++k;
        continue;
      }
      outlines[i] = both;
      outlines.erase(outlines.begin() + static_cast<std::ptrdiff_t>(k));
      k = i + 1;
    }
  }
}

/// The point of the floor that the lamp sees so far right and up of the origin.
Vec3 on_floor(const Lamp& lamp, double right, double up, double floor_level) {
  const double toward = (floor_level - right * lamp.right[1] - up * lamp.up[1]) / lamp.toward[1];
  return right * lamp.right + up * lamp.up + toward * lamp.toward;
}

}  // namespace

Lamp lamp_towards(const Vec3& direction) {
  const Vec3 toward = normalised(direction);
  const Vec3 line = {1, 0, 0};
  const Vec3 right = normalised(line - dot(line, toward) * toward);
  return {toward, right, cross(toward, right)};
}

Matrix4 map_matrix(const Lamp& lamp, const Vec3& centre, double reach) {
  const double deep = 3 * reach;
  const Vec3 x = (1 / reach) * lamp.right;
  const Vec3 y = (1 / reach) * lamp.up;
  const Vec3 z = (-1 / deep) * lamp.toward;
  return {x[0],
          y[0],
          z[0],
          0,  //
          x[1],
          y[1],
          z[1],
          0,  //
          x[2],
          y[2],
          z[2],
          0,  //
          -dot(x, centre),
          -dot(y, centre),
          -dot(z, centre),
          1};
}

Matrix4 patch_matrix(const Patch& patch) {
  const auto& [c, x, y] = patch;
  return {x[0], x[1], x[2], 0, y[0], y[1], y[2], 0, 0, 0, 0, 0, c[0], c[1], c[2], 1};
}

std::vector<Patch> shade_on_floor(const Lamp& lamp, const std::vector<std::array<Vec3, 8>>& things,
                                  double floor_level, double border) {
  std::vector<Outline> outlines;
  for (const auto& thing : things) outlines.push_back(outline_of(lamp, thing, border));
  join(outlines);
  std::vector<Patch> patches;
  for (const Outline& outline : outlines) {
    const double right = (outline.low[0] + outline.high[0]) / 2;
    const double up = (outline.low[1] + outline.high[1]) / 2;
    const Vec3 centre = on_floor(lamp, right, up, floor_level);
    patches.push_back({centre, on_floor(lamp, outline.high[0], up, floor_level) - centre,
                       on_floor(lamp, right, outline.high[1], floor_level) - centre});
  }
  return patches;
}

}  // namespace drycut::renders
