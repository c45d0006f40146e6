#pragma once
#include <array>
#include <vector>

#include "renders/geometry.hpp"

namespace drycut::renders {

/// A lamp so far away that its light is parallel.
struct Lamp {
  Vec3 toward;     ///< the lamp, of length 1; above the horizon
  Vec3 right, up;  ///< across the light, of length 1: with `toward` a right-handed frame
};
/// `right` goes along the line (x) as far as it can, so that what is long in the line is so in the lamp's
/// frame.
Lamp lamp_towards(const Vec3& direction);

/// World to the clip coordinates of a map of what the lamp sees: up to `reach` [m] across and 3 `reach` along
/// the light to each side of `centre`.
Matrix4 map_matrix(const Lamp& lamp, const Vec3& centre, double reach);

/// A parallelogram: from its centre to the middle of two sides [m].
struct Patch {
  Vec3 centre, right, up;
};
/// The square from -1 to 1 in x and y to this patch.
Matrix4 patch_matrix(const Patch& patch);

/// The patches of the floor from which things keep the lamp's light, with a `border` around [m]. Each of
/// `things` is the corners of one thing above `floor_level`; things whose patches would overlap much get one
/// together.
std::vector<Patch> shade_on_floor(const Lamp& lamp, const std::vector<std::array<Vec3, 8>>& things,
                                  double floor_level, double border);

}  // namespace drycut::renders
