#include "renders/mesh.hpp"

#include <algorithm>
#include <limits>

namespace drycut::renders {

Extent extent_of(const Mesh& mesh) {
  Extent extent = kNothing;
  for (const Vec3& point : mesh.hull) include(extent, point);
  return extent;
}

void find_hull(Mesh& mesh) {
  mesh.hull.clear();
  for (int code = 0; code < 27; ++code) {
    const Vec3 direction = {code % 3 - 1.0, code / 3 % 3 - 1.0, code / 9 - 1.0};
    if (dot(direction, direction) == 0) continue;
    double furthest = -std::numeric_limits<double>::infinity();
    Vec3 found{};
    for (const auto& corner : mesh.corners) {
      const Vec3 point = as_doubles(corner.position);
      const double way = dot(direction, point);
      if (way <= furthest) continue;
      furthest = way;
      found = point;
    }
    mesh.hull.push_back(found);
  }
}

Mesh stretched(const Mesh& mesh, const Vec3& size) {
  const Extent extent = extent_of(mesh);
  const Vec3 middle = 0.5 * (extent.low + extent.high);
  Vec3 factor{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double side = extent.high[i] - extent.low[i];
    factor[i] = side > 0 ? size[i] / side : 1;
  }
  const auto moved = [&](const Vec3& point) {
    return Vec3{(point[0] - middle[0]) * factor[0], (point[1] - middle[1]) * factor[1],
                (point[2] - middle[2]) * factor[2]};
  };
  Mesh result;
  result.corners.reserve(mesh.corners.size());
  for (const auto& corner : mesh.corners) {
    const Vec3 n = as_doubles(corner.normal);
    result.corners.push_back({as_floats(moved(as_doubles(corner.position))),
                              as_floats(normalised({n[0] / factor[0], n[1] / factor[1], n[2] / factor[2]}))});
  }
  for (const auto& point : mesh.hull) result.hull.push_back(moved(point));
  return result;
}

}  // namespace drycut::renders
