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
/// length stays so. With `ends_kept` what is more than 1.5 times as long in z as the mesh stretches in the
/// middle only: feet, journals and posts at its ends keep their shape.
Mesh stretched(const Mesh& mesh, const Vec3& size, bool ends_kept = false);

}  // namespace drycut::renders
