#include "renders/solid_mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "renders/geometry.hpp"

namespace drycut::renders {
namespace {

Vec3 position(const Vertex& v) { return as_doubles(v.position); }
Vec3 normal(const Vertex& v) { return as_doubles(v.normal); }

std::vector<Vertex> mesh(SolidPart::Shape shape, const Vec3& size) {
  SolidPart part;
  part.shape = shape;
  part.size = size;
  return solid_surface(part);
}

/// Of a closed surface, positive if its triangles run counter-clockwise seen from outside.
double volume(const std::vector<Vertex>& triangles) {
  double sum = 0;
  for (std::size_t i = 0; i < triangles.size(); i += 3) {
    sum += position(triangles[i]).dot(position(triangles[i + 1]).cross(position(triangles[i + 2]))) / 6;
  }
  return sum;
}

/// Vanishes for a surface without holes.
double net_area(const std::vector<Vertex>& triangles) {
  Vec3 sum = {0, 0, 0};
  for (std::size_t i = 0; i < triangles.size(); i += 3) {
    const Vec3 a = position(triangles[i]);
    sum += 0.5 * (position(triangles[i + 1]) - a).cross(position(triangles[i + 2]) - a);
  }
  return sum.norm();
}

class RendersSolid : public ::testing::TestWithParam<SolidPart::Shape> {};

TEST_P(RendersSolid, IsClosedAndFacesOutwards) {
  const auto triangles = mesh(GetParam(), {0.4, 0.3, 0.8});
  ASSERT_EQ(triangles.size() % 3, 0U);
  EXPECT_LT(net_area(triangles), 1e-5);
  EXPECT_GT(volume(triangles), 0);
  for (std::size_t i = 0; i < triangles.size(); i += 3) {
    const Vec3 a = position(triangles[i]);
    const Vec3 face = (position(triangles[i + 1]) - a).cross(position(triangles[i + 2]) - a);
    for (std::size_t k = i; k < i + 3; ++k) {
      EXPECT_NEAR(normal(triangles[k]).norm(), 1, 1e-5);
      EXPECT_GE(face.dot(normal(triangles[k])), -1e-9) << "normal against its face, triangle " << i / 3;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, RendersSolid,
                         ::testing::Values(SolidPart::Shape::box, SolidPart::Shape::cylinder,
                                           SolidPart::Shape::wedge));

TEST(RendersSolidMesh, VolumesAreThoseOfTheShapes) {
  EXPECT_NEAR(volume(mesh(SolidPart::Shape::box, {0.4, 0.3, 0.8})), 0.096, 0.096 * 0.002);
  EXPECT_NEAR(volume(mesh(SolidPart::Shape::cylinder, {0.4, 0.4, 0.8})), std::numbers::pi * 0.04 * 0.8,
              0.1 * 0.004);
  EXPECT_NEAR(volume(mesh(SolidPart::Shape::wedge, {0.4, 0.3, 0.8})), 0.048, 1e-6);
}

TEST(RendersSolidMesh, WedgeHasItsEdgeBelow) {
  double lowest = 1, half_width_there = 1;
  for (const Vertex& v : mesh(SolidPart::Shape::wedge, {0.4, 0.3, 0.8})) {
    if (v.position[1] < lowest) {
      lowest = v.position[1];
      half_width_there = std::abs(v.position[0]);
    }
  }
  EXPECT_NEAR(lowest, -0.15, 1e-6);
  EXPECT_NEAR(half_width_there, 0, 1e-6);
}

TEST(RendersSolidMesh, CylinderCarriesAMarkThatShowsItTurn) {
  // Darkest corners of the end that faces the operator, and where they are on average.
  Vec3 sum = {0, 0, 0};
  for (const Vertex& v : mesh(SolidPart::Shape::cylinder, {1, 1, 0.2}))
    if (v.normal[2] > 0.99F && v.colour[0] < 0.2F) sum += position(v);
  EXPECT_GT(std::hypot(sum[0], sum[1]), 1.0) << "on one side";
}

TEST(RendersSolidMesh, KnowsItsMaterials) {
  for (const char* name : {"steel", "paint", "rubber", "web", "blade"}) {
    EXPECT_NE(find_material(name), nullptr) << name;
    EXPECT_NE(material_names().find(name), std::string_view::npos) << name;
  }
  EXPECT_EQ(find_material("gold"), nullptr);
}

}  // namespace
}  // namespace drycut::renders
