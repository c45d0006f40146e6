#pragma once
#include <array>
#include <string_view>
#include <vector>

#include "renders/scene3d.hpp"

namespace drycut::renders {

/// How a surface answers light.
struct Material {
  float reflection = 0;  ///< share of the surroundings mirrored, 0..1
  float gloss = 8;       ///< exponent of the highlight
};

/// The material of that name, or nullptr.
const Material* find_material(std::string_view name);
/// "steel, paint, ...": what find_material knows.
std::string_view material_names();

/// One corner of a triangle, as the shader reads it; the part's own coordinates [m].
struct Vertex {
  std::array<float, 3> position;
  std::array<float, 3> normal;
  std::array<float, 3> colour;
  std::array<float, 2> surface;  ///< reflection, gloss
};

/// The part's surface in its own coordinates as triangles (three vertices each, counter-clockwise seen from
/// outside). Edges are broken a little, as on real parts, so that they catch the light; a cylinder's ends
/// carry an index mark so that one sees it turn. A part with a mesh is drawn by its mesh. The part's material
/// must be known and its sizes positive.
std::vector<Vertex> solid_surface(const SolidPart& part);

}  // namespace drycut::renders
