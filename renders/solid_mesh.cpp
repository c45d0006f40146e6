#include "renders/solid_mesh.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

#include "renders/geometry.hpp"

namespace drycut::renders {
namespace {

constexpr std::array<std::pair<std::string_view, Material>, 5> kMaterials = {{
    {"steel", {0.42F, 50}},
    {"paint", {0.10F, 36}},
    {"rubber", {0.02F, 6}},
    {"web", {0.05F, 14}},
    {"blade", {0.62F, 110}},
}};
constexpr int kSegments = 72;     ///< of a cylinder
constexpr int kMarkSegments = 3;  ///< width of the index mark on a cylinder's end
using Colour = std::array<float, 3>;

Colour shaded(const Colour& colour, float factor) {
  return {colour[0] * factor, colour[1] * factor, colour[2] * factor};
}

struct MeshCorner {
  Vec3 position;
  Vec3 normal;
};

/// Collects a part's triangles.
class MeshBuilder {
 public:
  MeshBuilder(std::vector<Vertex>& triangles, const Material& material)
      : triangles_(triangles), surface_{material.reflection, material.gloss} {}

  void triangle(const MeshCorner& a, const MeshCorner& b, const MeshCorner& c, const Colour& colour) {
    for (const MeshCorner* corner : {&a, &b, &c}) add(*corner, colour);
  }

  void quad(const MeshCorner& a, const MeshCorner& b, const MeshCorner& c, const MeshCorner& d,
            const Colour& colour) {
    triangle(a, b, c, colour);
    triangle(a, c, d, colour);
  }

  /// A flat polygon, counter-clockwise from outside.
  void polygon(const std::vector<Vec3>& points, const Colour& colour) {
    const Vec3 normal = (points[1] - points[0]).cross(points[2] - points[0]).normalized();
    for (std::size_t i = 2; i < points.size(); ++i) {
      triangle({points[0], normal}, {points[i - 1], normal}, {points[i], normal}, colour);
    }
  }

 private:
  void add(const MeshCorner& corner, const Colour& colour) {
    triangles_.push_back({as_floats(corner.position), as_floats(corner.normal), colour, surface_});
  }

  std::vector<Vertex>& triangles_;
  std::array<float, 2> surface_;
};

/// How far edges are broken: a few per cent of the thinnest side, at most 4 mm.
double edge_break(const Vec3& half) { return std::min(0.004, 0.12 * half.minCoeff()); }

void box(MeshBuilder& build, const Vec3& half, const Colour& colour) {
  const double bevel = edge_break(half);
  // The corner (sx, sy, sz) as it belongs to the face of `axis`: on that face, set in by the bevel elsewhere.
  const auto corner = [&](std::size_t axis, const std::array<int, 3>& sign) {
    Vec3 point;
    for (std::size_t i = 0; i < 3; ++i) point[i] = sign[i] * (half[i] - (i == axis ? 0 : bevel));
    return point;
  };
  const auto outward = [&](std::vector<Vec3> points) {
    const Vec3 normal = (points[1] - points[0]).cross(points[2] - points[0]);
    if (normal.dot(points[0] + points[2]) < 0) std::reverse(points.begin(), points.end());
    build.polygon(points, colour);
  };

  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t b = (axis + 1) % 3;
    const std::size_t c = (axis + 2) % 3;
    for (const int side : {-1, 1}) {
      std::vector<Vec3> face;
      for (const auto& [sb, sc] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
        std::array<int, 3> sign{};
        sign[axis] = side;
        sign[b] = sb;
        sign[c] = sc;
        face.push_back(corner(axis, sign));
      }
      outward(face);
      // The edge between this face and that of axis b, along c.
      for (const int other : {-1, 1}) {
        std::array<int, 3> sign{};
        sign[axis] = side;
        sign[b] = other;
        sign[c] = -1;
        std::array<int, 3> end = sign;
        end[c] = 1;
        outward({corner(axis, sign), corner(b, sign), corner(b, end), corner(axis, end)});
      }
    }
  }
  for (const int x : {-1, 1}) {
    for (const int y : {-1, 1}) {
      for (const int z : {-1, 1}) outward({corner(0, {x, y, z}), corner(1, {x, y, z}), corner(2, {x, y, z})});
    }
  }
}

/// One end of a cylinder: hub, face with the index mark, rim. `side` is the sign of z.
void cylinder_end(MeshBuilder& build, const Vec3& half, double rim, int side, const Colour& colour) {
  const Vec3 normal = {0, 0, static_cast<double>(side)};
  const auto point = [&](int segment, double share) {
    const double angle = 2 * std::numbers::pi * segment / kSegments;
    return MeshCorner{{share * half[0] * std::cos(angle), share * half[1] * std::sin(angle), side * half[2]},
                      normal};
  };
  const std::array<double, 5> rings = {0, 0.22, 0.34, 0.86, rim};
  for (int i = 0; i < kSegments; ++i) {
    const int next = side > 0 ? i + 1 : i;
    const int first = side > 0 ? i : i + 1;
    const bool mark = i < kMarkSegments;
    for (std::size_t ring = 0; ring + 1 < rings.size(); ++ring) {
      const float factor = ring == 0 ? 0.55F : (ring == 2 && mark ? 0.25F : 0.92F);
      build.quad(point(first, rings[ring]), point(first, rings[ring + 1]), point(next, rings[ring + 1]),
                 point(next, rings[ring]), shaded(colour, factor));
    }
  }
}

void cylinder(MeshBuilder& build, const Vec3& half, const Colour& colour) {
  const double bevel = edge_break(half);
  const double rim = 1 - bevel / std::min(half[0], half[1]);
  const auto point = [&](int segment, double share, double z, double slope) {
    const double angle = 2 * std::numbers::pi * segment / kSegments;
    const Vec3 radial = Vec3(std::cos(angle) / half[0], std::sin(angle) / half[1], 0).normalized();
    return MeshCorner{{share * half[0] * std::cos(angle), share * half[1] * std::sin(angle), z},
                      (radial + Vec3(0, 0, slope)).normalized()};
  };
  const double shoulder = half[2] - bevel;
  for (int i = 0; i < kSegments; ++i) {
    build.quad(point(i, 1, -shoulder, 0), point(i + 1, 1, -shoulder, 0), point(i + 1, 1, shoulder, 0),
               point(i, 1, shoulder, 0), colour);
    build.quad(point(i, 1, shoulder, 1), point(i + 1, 1, shoulder, 1), point(i + 1, rim, half[2], 1),
               point(i, rim, half[2], 1), colour);
    build.quad(point(i + 1, 1, -shoulder, -1), point(i, 1, -shoulder, -1), point(i, rim, -half[2], -1),
               point(i + 1, rim, -half[2], -1), colour);
  }
  cylinder_end(build, half, rim, 1, colour);
  cylinder_end(build, half, rim, -1, colour);
}

void wedge(MeshBuilder& build, const Vec3& half, const Colour& colour) {
  const Vec3 left_back = {-half[0], half[1], -half[2]};
  const Vec3 left_front = {-half[0], half[1], half[2]};
  const Vec3 right_back = {half[0], half[1], -half[2]};
  const Vec3 right_front = {half[0], half[1], half[2]};
  const Vec3 edge_back = {0, -half[1], -half[2]};
  const Vec3 edge_front = {0, -half[1], half[2]};
  build.polygon({left_back, left_front, right_front, right_back}, colour);
  build.polygon({left_front, left_back, edge_back, edge_front}, colour);
  build.polygon({right_back, right_front, edge_front, edge_back}, colour);
  build.polygon({left_front, edge_front, right_front}, colour);
  build.polygon({right_back, edge_back, left_back}, colour);
}

}  // namespace

const Material* find_material(std::string_view name) {
  for (const auto& [known, material] : kMaterials) {
    if (known == name) return &material;
  }
  return nullptr;
}

std::string_view material_names() { return "steel, paint, rubber, web, blade"; }

std::vector<Vertex> solid_surface(const SolidPart& part) {
  const Material* material = find_material(part.material);
  assert(material != nullptr);
  std::vector<Vertex> triangles;
  if (part.mesh) {
    triangles.reserve(part.mesh->corners.size());
    for (const auto& corner : part.mesh->corners)
      triangles.push_back(
          {corner.position, corner.normal, part.colour, {material->reflection, material->gloss}});
    return triangles;
  }
  MeshBuilder build(triangles, *material);
  const Vec3 half = 0.5 * part.size;
  switch (part.shape) {
    case SolidPart::Shape::box:
      box(build, half, part.colour);
      break;
    case SolidPart::Shape::cylinder:
      cylinder(build, half, part.colour);
      break;
    case SolidPart::Shape::wedge:
      wedge(build, half, part.colour);
      break;
  }
  return triangles;
}

}  // namespace drycut::renders
