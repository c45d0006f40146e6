#include <gtest/gtest.h>

#include <cmath>

#include "renders/lamp.hpp"
#include "renders/loaded/gl_renderer.hpp"

namespace drycut::renders {
namespace {

constexpr double kFloor = -0.3;

std::array<Vec3, 8> corners(const Vec3& low, const Vec3& high) { return corners_of(Extent(low, high)); }

/// Where a point's shadow falls on the floor.
Vec3 shadow_of(const Lamp& lamp, const Vec3& point) {
  return point - ((point[1] - kFloor) / lamp.toward[1]) * lamp.toward;
}

/// In shares of the patch's half sides, both within -1..1 inside.
std::array<double, 2> place_in(const Patch& patch, const Vec3& point) {
  // Both sides lie in the floor: two equations.
  const auto& [c, a, b] = patch;
  const double x = point[0] - c[0], z = point[2] - c[2];
  const double area = a[0] * b[2] - a[2] * b[0];
  return {(x * b[2] - z * b[0]) / area, (a[0] * z - a[2] * x) / area};
}

class RendersLamp : public ::testing::TestWithParam<Vec3> {};
INSTANTIATE_TEST_SUITE_P(Directions, RendersLamp,
                         ::testing::Values(Vec3{-0.35, 1, 0.62}, Vec3{0, 1, 0}, Vec3{2, 0.5, -1}));

TEST_P(RendersLamp, FrameIsRightHandedAndOfLengthOne) {
  const Lamp lamp = lamp_towards(GetParam());
  const Vec3 third = lamp.right.cross(lamp.up);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(third[i], lamp.toward[i], 1e-12);
  EXPECT_NEAR(lamp.toward.norm(), 1, 1e-12);
  EXPECT_NEAR(lamp.right.norm(), 1, 1e-12);
  EXPECT_NEAR(lamp.up[0], 0, 1e-12) << "the line goes to the right only";
}

TEST_P(RendersLamp, ShadowsStayWithinThePatchWithItsBorder) {
  const Lamp lamp = lamp_towards(GetParam());
  const auto thing = corners({0.2, 0, -0.4}, {0.9, 0.5, -0.1});
  const auto patches = shade_on_floor(lamp, {thing}, kFloor, 0.05);
  ASSERT_EQ(patches.size(), 1U);
  double widest = 0;
  for (const Vec3& corner : thing) {
    const Vec3 shadow = shadow_of(lamp, corner);
    EXPECT_NEAR(shadow[1], kFloor, 1e-12);
    EXPECT_NEAR(patches[0].centre[1] + patches[0].right[1] + patches[0].up[1], kFloor, 1e-12);
    const auto [a, b] = place_in(patches[0], shadow);
    // The border across the light is the same on every side.
    EXPECT_LE(std::abs(a) * patches[0].right.norm(), patches[0].right.norm() - 0.05 + 1e-9);
    EXPECT_LE(std::abs(b), 1);
    widest = std::max({widest, std::abs(a), std::abs(b)});
  }
  EXPECT_GT(widest, 0.8) << "no larger than it must be";
}

TEST(RendersLamps, ThingsSideBySideGetOnePatchAndThoseApartTwo) {
  const Lamp lamp = lamp_towards({0, 1, 0});
  const auto left = corners({0, 0, 0}, {1, 1, 1});
  const auto inside = corners({0.2, 0, 0.2}, {0.8, 2, 0.8});
  const auto away = corners({3, 0, 3}, {4, 1, 4});
  EXPECT_EQ(shade_on_floor(lamp, {left, inside}, kFloor, 0).size(), 1U);
  EXPECT_EQ(shade_on_floor(lamp, {left, inside, away}, kFloor, 0).size(), 2U);
  EXPECT_TRUE(shade_on_floor(lamp, {}, kFloor, 0).empty());
  const auto beside = corners({0.9, 0, 0}, {2, 1, 1});
  const auto both = shade_on_floor(lamp, {left, beside}, kFloor, 0);
  ASSERT_EQ(both.size(), 1U);
  EXPECT_NEAR(both[0].right.norm(), 1, 1e-12) << "from 0 to 2";
}

TEST(RendersLamps, MapHoldsWhatIsWithinReach) {
  const Lamp lamp = lamp_towards({-0.35, 1, 0.62});
  const Vec3 centre = {1, 2, 3};
  const Matrix4 m = map_matrix(lamp, centre, 2);
  const Vec3 point = centre + 2.0 * lamp.right - 2.0 * lamp.up + 6.0 * lamp.toward;
  const Vec4 edge = m * point.homogeneous();
  EXPECT_NEAR(edge[0], 1, 1e-12);
  EXPECT_NEAR(edge[1], -1, 1e-12);
  EXPECT_NEAR(edge[2], -1, 1e-12) << "nearest to the lamp";
}

/// A plate on the floor, a post on it and a beam above that goes from left to right; the post and the plate
/// stand.
Film workshop() {
  Film film;
  film.width = 320;
  film.height = 200;
  const auto part = [](const char* name, const Vec3& size) {
    SolidPart made;
    made.name = name;
    made.size = size;
    made.material = "paint";
    return made;
  };
  film.parts = {part("plate", {1.2, 0.1, 0.8}), part("post", {0.12, 0.6, 0.12}),
                part("beam", {0.3, 0.1, 0.5})};
  for (int i = 0; i < 4; ++i) {
    Frame frame;
    frame.placements.resize(3);
    frame.placements[0].position = {0, 0.05, 0};
    frame.placements[1].position = {-0.3, 0.4, 0};
    frame.placements[2].position = {-0.1 + 0.45 * i, 0.5 - 0.1 * i, -0.1};
    frame.placements[2].visible = i != 3;
    film.frames.push_back(frame);
  }
  film.camera.eye = {-0.6, 1.2, 2.2};
  film.camera.target = {0, 0.2, 0};
  return film;
}

Image drawn(GlRenderer& renderer, const Film& film, std::size_t frame) {
  Image image(film.width, film.height);
  renderer.draw(film.frames[frame].placements, film.camera, image);
  return image;
}

TEST(RendersStage, KnowsWhatStandsAndWhatMoves) {
  Film film = workshop();
  EXPECT_EQ(stage_of(film, 200).still, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(stage_of(film, 200).moving, (std::vector<std::size_t>{2}));
  film.frames[1].placements[1].rotation = {0, 0.1, 0, 1};
  film.frames[2].placements[0].visible = false;
  EXPECT_TRUE(stage_of(film, 200).still.empty());
  EXPECT_TRUE(stage_of(film, 200).camera_stands);
  film.follow = 2;
  EXPECT_FALSE(stage_of(film, 200).camera_stands);
}

TEST(RendersStage, EqualCornersAreOneVertexAndTheTrianglesStay) {
  const Film film = workshop();
  const Surfaces surfaces = stage_of(film, 200).surfaces;
  ASSERT_EQ(surfaces.parts.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto corners = solid_surface(film.parts[i]);
    const auto& range = surfaces.parts[i];
    ASSERT_EQ(range.indices, corners.size());
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Vertex& vertex = surfaces.vertices[range.first_vertex + surfaces.indices[range.first_index + k]];
      EXPECT_EQ(vertex.position, corners[k].position);
      EXPECT_EQ(vertex.normal, corners[k].normal);
    }
  }
  EXPECT_LT(surfaces.vertices.size(), surfaces.indices.size());
}

TEST(RendersStage, WhatIsKeptFromFrameToFrameShowsInNoPixel) {
  const Film film = workshop();
  const Stage stage = stage_of(film, film.height);
  Stage anew = stage;  // every frame lit as a whole
  anew.camera_stands = false;
  GlRenderer keeps(stage);
  std::vector<Image> kept;
  for (std::size_t i = 0; i < film.frames.size(); ++i) kept.push_back(drawn(keeps, film, i));
  GlRenderer whole(anew);
  for (std::size_t i = film.frames.size(); i-- > 0;)
    EXPECT_EQ(kept[i].rgb, drawn(whole, film, i).rgb) << "frame " << i;
}

TEST(RendersStage, PartsThatMoveAreDrawnLikePartsThatStand) {
  const Film film = workshop();
  const Stage stage = stage_of(film, film.height);
  Stage all_move = stage;
  all_move.still = {};
  all_move.moving = {0, 1, 2};
  GlRenderer one(stage);
  GlRenderer other(all_move);
  EXPECT_EQ(drawn(one, film, 1).rgb, drawn(other, film, 1).rgb);
}

int green_at(const Image& image, const Film& film, const Vec3& point) {
  const auto at = projected(film.camera, image.width, image.height, point);
  return image.row(static_cast<int>(at[1]))[3 * static_cast<int>(at[0]) + 1];
}

TEST(RendersSky, FloorDarkensTowardsAWallThatIsInTheLight) {
  Film film = workshop();
  film.parts[0].size = {1.2, 0.5, 0.8};
  for (Frame& frame : film.frames) {
    frame.placements[0].position[1] = 0.25;
    frame.placements[1].position[1] = 0.8;
  }
  film.camera.eye = {0, 2.5, 2.5};
  const Stage stage = stage_of(film, film.height);
  GlRenderer renderer(stage);
  const Image image = drawn(renderer, film, 3);
  // On the operator's side no shadow falls, so what darkens is the sky that the wall hides.
  const int close = green_at(image, film, {0.1, 0, 0.41});
  const int further = green_at(image, film, {0.1, 0, 0.45});
  const int away = green_at(image, film, {0.1, 0, 0.9});
  EXPECT_LT(close, further - 3);
  EXPECT_LT(further, away + 2);
  EXPECT_LT(close, away - 12);
}

TEST(RendersSky, WhatIsLowAboveAPlateDarkensItMoreThanWhatIsHigh) {
  Film film = workshop();
  film.frames.resize(2);
  film.camera.eye = {-1.5, 0.7, 0.4};
  film.camera.target = {0.2, 0.1, 0};
  for (std::size_t i = 0; i < 2; ++i) {
    film.frames[i].placements[1].visible = false;
    film.frames[i].placements[2].position = {0.2, i == 0 ? 0.22 : 0.6, -0.05};
  }
  film.parts[2].size = {0.5, 0.1, 0.5};
  const Stage stage = stage_of(film, film.height);
  GlRenderer renderer(stage);
  const Image low = drawn(renderer, film, 0);
  const Image high = drawn(renderer, film, 1);
  const Vec3 below = {0.02, 0.1, -0.05};
  EXPECT_LT(green_at(low, film, below), green_at(high, film, below) - 3);
}

}  // namespace
}  // namespace drycut::renders
