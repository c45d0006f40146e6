#include "renders/mesh.hpp"

#include <algorithm>
#include <limits>

namespace drycut::renders {

Extent extent_of(const Mesh& mesh) {
  Extent extent;
  for (const Vec3& point : mesh.hull) extent.extend(point);
  return extent;
}

void find_hull(Mesh& mesh) {
  mesh.hull.clear();
  for (int code = 0; code < 27; ++code) {
    const Vec3 direction = {code % 3 - 1.0, code / 3 % 3 - 1.0, code / 9 - 1.0};
    if (direction.isZero()) continue;
    double furthest = -std::numeric_limits<double>::infinity();
    Vec3 found = Vec3::Zero();
    for (const auto& corner : mesh.corners) {
      const Vec3 point = as_doubles(corner.position);
      const double way = direction.dot(point);
      if (way <= furthest) continue;
      furthest = way;
      found = point;
    }
    mesh.hull.push_back(found);
  }
}

Mesh stretched(const Mesh& mesh, const Vec3& size) {
  const Extent extent = extent_of(mesh);
  const Vec3 middle = extent.center();
  const Vec3 factor = (extent.sizes().array() > 0).select(size.cwiseQuotient(extent.sizes()), 1);
  const auto moved = [&](const Vec3& point) -> Vec3 { return (point - middle).cwiseProduct(factor); };
  Mesh result;
  result.corners.reserve(mesh.corners.size());
  for (const auto& corner : mesh.corners)
    result.corners.push_back({as_floats(moved(as_doubles(corner.position))),
                              as_floats(as_doubles(corner.normal).cwiseQuotient(factor).normalized())});
  for (const auto& point : mesh.hull) result.hull.push_back(moved(point));
  return result;
}

}  // namespace drycut::renders
