#include "renders/mesh.hpp"

#include <algorithm>
#include <cmath>
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

Mesh stretched(const Mesh& mesh, const Vec3& size, bool ends_kept) {
  constexpr double kLongest = 1.5;  // as an end is stretched
  constexpr double kPlain = 0.05;   // half of the share of a mesh that has no end in it
  const Extent extent = extent_of(mesh);
  const Vec3 middle = extent.center();
  const Vec3 factor = (extent.sizes().array() > 0).select(size.cwiseQuotient(extent.sizes()), 1);
  const double plain = kPlain * extent.sizes().z();
  const double of_ends = ends_kept ? std::min(factor.z(), kLongest) : factor.z();
  const double of_middle =
      plain > 0 ? (size.z() / 2 - (0.5 - kPlain) * extent.sizes().z() * of_ends) / plain : 1;
  const auto factor_at = [&](double z) -> Vec3 {
    return {factor.x(), factor.y(), std::abs(z) > plain ? of_ends : of_middle};
  };
  const auto moved = [&](const Vec3& point) -> Vec3 {
    const Vec3 from = point - middle;
    const double in = std::clamp(from.z(), -plain, plain);
    return {from.x() * factor.x(), from.y() * factor.y(), in * of_middle + (from.z() - in) * of_ends};
  };
  Mesh result;
  result.corners.reserve(mesh.corners.size());
  for (const auto& corner : mesh.corners) {
    const Vec3 point = as_doubles(corner.position);
    result.corners.push_back(
        {as_floats(moved(point)),
         as_floats(as_doubles(corner.normal).cwiseQuotient(factor_at(point.z() - middle.z())).normalized())});
  }
  for (const auto& point : mesh.hull) result.hull.push_back(moved(point));
  return result;
}

}  // namespace drycut::renders
