#include "renders/camera.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "renders/caption_bar.hpp"
#include "renders/pictures.hpp"

namespace drycut::renders {
namespace {

constexpr double kHalf = 0.70710678118654752;

SolidPart part(SolidPart::Shape shape, const Vec3& size, const std::string& material = "steel") {
  SolidPart p;
  p.shape = shape;
  p.size = size;
  p.material = material;
  return p;
}
Placement at(const Vec3& position, bool visible = true) {
  Placement p;
  p.position = position;
  p.visible = visible;
  return p;
}

/// Frame posts, a drum, a web of 20 m, pieces that come and go.
Film knife_line() {
  Film film;
  film.parts = {part(SolidPart::Shape::box, {0.3, 0.6, 0.05}), part(SolidPart::Shape::box, {0.3, 0.6, 0.05}),
                part(SolidPart::Shape::cylinder, {0.2, 0.2, 0.5}),
                part(SolidPart::Shape::box, {20, 0.003, 0.4}, "web"),
                part(SolidPart::Shape::box, {0.5, 0.003, 0.4}, "paint")};
  for (int i = 0; i < 5; ++i) {
    Frame frame;
    frame.time_s = 0.1 * i;
    frame.placements = {at({0, 0.3, 0.3}), at({0, 0.3, -0.3}), at({0.1, 0.5, 0}), at({-10, 0.4, 0}),
                        at({0.5 + i, 0.4, 0}, i > 0)};
    film.frames.push_back(frame);
  }
  return film;
}

TEST(RendersGeometry, TurnsByQuaternion) {
  const Vec3 turned = rotation_of({0, 0, kHalf, kHalf}) * Vec3(1, 2, 3);  // 90 degrees about z
  EXPECT_NEAR(turned[0], -2, 1e-12);
  EXPECT_NEAR(turned[1], 1, 1e-12);
  EXPECT_NEAR(turned[2], 3, 1e-12);
  const Vec3 longer =
      rotation_of({0, 0, 5 * kHalf, 5 * kHalf}) * Vec3(1, 2, 3);  // its length does not matter
  EXPECT_NEAR(longer[0], turned[0], 1e-12);
}

TEST(RendersCamera, TargetIsInTheMiddleAndUpIsUp) {
  Camera camera;
  camera.eye = {-1, 2, 4};
  camera.target = {0.3, 0.1, -0.2};
  const auto middle = projected(camera, 800, 600, camera.target);
  EXPECT_NEAR(middle[0], 400, 1e-9);
  EXPECT_NEAR(middle[1], 300, 1e-9);
  EXPECT_LT(projected(camera, 800, 600, camera.target + Vec3{0, 0.1, 0})[1], 300);
  EXPECT_GT(projected(camera, 800, 600, camera.target + Vec3{0.1, 0, 0})[0], 400);
}

TEST(RendersCamera, FieldOfViewIsVertical) {
  Camera camera;
  camera.eye = {0, 0, 2};
  camera.target = {0, 0, 0};
  camera.field_of_view_deg = 90;
  EXPECT_NEAR(projected(camera, 800, 600, {0, 2, 0})[1], 0, 1e-9);
  EXPECT_NEAR(projected(camera, 800, 600, {0, -2, 0})[1], 600, 1e-9);
}

TEST(RendersCamera, OutlineOfATurnedBoxAndACylinder) {
  Placement placed = at({1, 0, 0});
  placed.rotation = {0, 0, kHalf, kHalf};
  placed.scale = {2, 1, 1};
  double highest = 0;
  for (const Vec3& p : outline(part(SolidPart::Shape::box, {1, 0.2, 0.2}), placed))
    highest = std::max(highest, p[1]);
  EXPECT_NEAR(highest, 1.0, 1e-12);
  for (const Vec3& p : outline(part(SolidPart::Shape::cylinder, {2, 2, 3}), at({0, 0, 0}))) {
    EXPECT_NEAR(std::hypot(p[0], p[1]), 1, 1e-12);
    EXPECT_NEAR(std::abs(p[2]), 1.5, 1e-12);
  }
}

TEST(RendersCamera, MechanismLeavesOutTheFarEndsOfWebAndPieces) {
  const Extent extent = mechanism_extent(knife_line());
  // The posts span -0.15..0.15, the drum to 0.2; the mechanism is 0.65 deep, so the border is 0.065.
  EXPECT_NEAR(extent.min()[0], -0.15 - 0.065, 1e-9);
  EXPECT_NEAR(extent.max()[0], 0.2 + 0.065, 0.066);
  EXPECT_NEAR(extent.min()[1], 0, 1e-12);
  EXPECT_NEAR(extent.max()[2], 0.325, 1e-12);
}

TEST(RendersCamera, CarriageThatTravelsIsKeptInView) {
  Film film = knife_line();
  for (std::size_t i = 0; i < film.frames.size(); ++i) {
    film.frames[i].placements[2].position[0] = static_cast<double>(i);  // the drum rides on a carriage
  }
  // From -0.15 to 4.1, and the web as far as the border.
  EXPECT_NEAR(mechanism_extent(film).max()[0], 4.1 + 0.425, 1e-9);
}

TEST(RendersCamera, FilmWithNothingInItStillHasAnExtent) {
  const Extent extent = mechanism_extent(Film{});
  EXPECT_GT(extent.max()[0], extent.min()[0]);
  EXPECT_TRUE(std::isfinite(floor_level(Film{})));
}

TEST(RendersCamera, FloorIsBelowTheLowestVisiblePoint) {
  Film film = knife_line();
  EXPECT_NEAR(floor_level(film), 0, 1e-12);
  film.frames[2].placements[4] = at({0, -1, 0}, false);
  EXPECT_NEAR(floor_level(film), 0, 1e-12) << "hidden parts do not count";
  film.frames[2].placements[4].visible = true;
  EXPECT_NEAR(floor_level(film), -1.0015, 1e-12);
}

TEST(RendersCamera, OperatorSeesTheWholeMechanismAndLarge) {
  for (const auto& [width, height] : {std::pair{960, 540}, {540, 960}, {1920, 400}}) {
    Film film = knife_line();
    film.width = width;
    film.height = height;
    const Camera camera = operator_camera(film);
    const int view = height - CaptionLayout(film).height();
    const Extent extent = mechanism_extent(film);
    double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
    for (const Vec3& corner : corners_of(extent)) {
      const auto p = projected(camera, width, view, corner);
      left = std::min(left, p[0]);
      right = std::max(right, p[0]);
      top = std::min(top, p[1]);
      bottom = std::max(bottom, p[1]);
    }
    EXPECT_GE(left, 0.02 * width);
    EXPECT_LE(right, 0.98 * width);
    EXPECT_GE(top, 0.02 * view);
    EXPECT_LE(bottom, 0.98 * view);
    const double used = std::max((right - left) / width, (bottom - top) / view);
    EXPECT_NEAR(used, 0.95, 1e-6) << "the tighter direction fills the picture up to the margin";
    EXPECT_GT(camera.eye[2], extent.max()[2]) << "operator's side";
    EXPECT_GT(camera.eye[1], extent.max()[1]) << "above";
    EXPECT_LT(camera.eye[0], camera.target[0]) << "upstream";
  }
}

}  // namespace
}  // namespace drycut::renders
