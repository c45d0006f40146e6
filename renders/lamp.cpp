#include "renders/lamp.hpp"

namespace drycut::renders {
namespace {

/// How a lamp sees something: a rectangle along its `right` and `up` [m].
using Outline = Eigen::AlignedBox2d;

Outline outline_of(const Lamp& lamp, const std::array<Vec3, 8>& thing, double border) {
  Outline outline;
  for (const Vec3& point : thing) outline.extend(Eigen::Vector2d(point.dot(lamp.right), point.dot(lamp.up)));
  const Eigen::Vector2d around = Eigen::Vector2d::Constant(border);
  return {outline.min() - around, outline.max() + around};
}

/// Joins what covers no more together.
void join(std::vector<Outline>& outlines) {
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    for (std::size_t k = i + 1; k < outlines.size();) {
      const Outline both = outlines[i].merged(outlines[k]);
      if (both.volume() > outlines[i].volume() + outlines[k].volume()) {
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
  const Vec3 toward = direction.normalized();
  const Vec3 right = (Vec3::UnitX() - toward.x() * toward).normalized();
  return {toward, right, toward.cross(right)};
}

Matrix4 map_matrix(const Lamp& lamp, const Vec3& centre, double reach) {
  Eigen::Matrix3d axes;
  axes << lamp.right.transpose() / reach, lamp.up.transpose() / reach, -lamp.toward.transpose() / (3 * reach);
  Matrix4 map = Matrix4::Identity();
  map.topLeftCorner<3, 3>() = axes;
  map.topRightCorner<3, 1>() = -axes * centre;
  return map;
}

Matrix4 patch_matrix(const Patch& patch) {
  Matrix4 square = Matrix4::Zero();
  square.topRows<3>() << patch.right, patch.up, Vec3::Zero(), patch.centre;
  square(3, 3) = 1;
  return square;
}

std::vector<Patch> shade_on_floor(const Lamp& lamp, const std::vector<std::array<Vec3, 8>>& things,
                                  double floor_level, double border) {
  std::vector<Outline> outlines;
  for (const auto& thing : things) outlines.push_back(outline_of(lamp, thing, border));
  join(outlines);
  std::vector<Patch> patches;
  for (const Outline& outline : outlines) {
    const Eigen::Vector2d middle = outline.center();
    const Vec3 centre = on_floor(lamp, middle.x(), middle.y(), floor_level);
    patches.push_back({centre, on_floor(lamp, outline.max().x(), middle.y(), floor_level) - centre,
                       on_floor(lamp, middle.x(), outline.max().y(), floor_level) - centre});
  }
  return patches;
}

}  // namespace drycut::renders
