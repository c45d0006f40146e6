#pragma once
#include <array>
#include <vector>

#include "renders/geometry.hpp"
#include "renders/scene3d.hpp"

namespace drycut::renders {

/// A point of a part [m, its own coordinates] in the world.
Vec3 placed(const Placement& placement, const Vec3& point);

/// Points [m, world] whose hull is the part as placed: corners of a box or wedge, rims of a
/// cylinder, outstanding corners of a mesh.
std::vector<Vec3> outline(const SolidPart& part, const Placement& placement);

/// Where the mechanism is over the whole film: the parts that are visible in every frame, are not of the
/// material "web" (the product) and not longer than three times the median of those. What else is in the film
/// (the web, long belts, cut pieces) counts as far as a border of a tenth of the mechanism's length around
/// it. A unit box for an empty film.
Extent mechanism_extent(const Film& film);

/// The height of the floor [m]: the lowest point of any visible part of the film.
double floor_level(const Film& film);

/// A camera of the film in that frame: the first one (0), which, with a part to follow, is shifted as the
/// part has been since the first frame, or one of those beside it.
Camera camera_of(const Film& film, std::size_t frame, std::size_t view = 0);

/// World to clip coordinates for a picture of that shape; `extent` sets the depth range.
Matrix4 view_projection(const Camera& camera, double aspect, const Extent& extent);

/// Where a world point [m] is in a picture of that size: pixels from the upper left corner.
std::array<double, 2> projected(const Camera& camera, int width, int height, const Vec3& point);

}  // namespace drycut::renders
