#pragma once
#include "renders/camera.hpp"
#include "renders/geometry.hpp"
#include "renders/scene3d.hpp"

namespace drycut::renders {

/// The box of a mesh about its own axes [m]; its hull must be known.
Extent extent_of(const Mesh& mesh);

/// Fills in `hull`: the corners that stand out furthest along 26 directions.
void find_hull(Mesh& mesh);

/// `mesh` moved to the middle of its box and stretched so that the box has the sides `size` [m]. A side of no
/// length stays so.
Mesh stretched(const Mesh& mesh, const Vec3& size);

inline std::array<float, 3> as_floats(const Vec3& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}
inline Vec3 as_doubles(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }

}  // namespace drycut::renders
