#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <vector>

#include "renders/antialias.hpp"
#include "renders/camera.hpp"
#include "renders/label_room.hpp"
#include "renders/overlays.hpp"
#include "renders/quota_gauge.hpp"
#include "renders/tiles.hpp"

namespace drycut::renders {
namespace {

constexpr int kCaption = 60;

/// A tool that turns on a circle of 0.5 m about the z axis, seen from the front, 20 degrees a frame.
Film turning_tool() {
  Film film;
  film.width = 480;
  film.height = 360;
  SolidPart tool;
  tool.size = {0.1, 0.1, 0.1};
  tool.tip = Vec3(0, -0.1, 0);
  film.parts = {tool};
  film.camera.eye = {0, 0, 4};
  film.camera.target = {0, 0, 0};
  for (int i = 0; i < 6; ++i) {
    const double angle = i * std::numbers::pi / 9;
    Frame frame;
    frame.time_s = 0.04 * i;
    frame.placements.resize(1);
    frame.placements[0].position = {0.4 * std::sin(angle), -0.4 * std::cos(angle), 0};
    frame.placements[0].rotation = {0, 0, std::sin(angle / 2), std::cos(angle / 2)};
    film.frames.push_back(frame);
  }
  return film;
}

Image grey(const Film& film) {
  Image image(film.width, film.height);
  std::fill(image.rgb.begin(), image.rgb.end(), std::uint8_t{128});
  return image;
}

Image drawn(const Film& film, std::size_t frame) {
  Image image = grey(film);
  Overlays(film, kCaption).draw(frame, image);
  return image;
}

std::array<int, 3> pixel(const Film& film, const Image& image, const Vec3& point) {
  const auto at = projected(film.camera, film.width, film.height - kCaption, point);
  const std::uint8_t* p = image.row(static_cast<int>(at[1])) + 3 * static_cast<int>(at[0]);
  return {p[0], p[1], p[2]};
}

TEST(RendersOverlays, NothingToDrawLeavesThePictureAlone) {
  const Film film = turning_tool();
  EXPECT_EQ(drawn(film, 5).rgb, grey(film).rgb);
}

TEST(RendersOverlays, TrailFollowsTheCircleBetweenFrames) {
  Film film = turning_tool();
  film.trails = true;
  const Image image = drawn(film, 5);
  for (const double degrees : {50.0, 70.0, 90.0}) {  // half way between two frames
    const double angle = degrees * std::numbers::pi / 180;
    const auto p = pixel(film, image, {0.5 * std::sin(angle), -0.5 * std::cos(angle), 0});
    EXPECT_GT(p[2], p[0] + 60) << degrees;
  }
  const auto ahead = pixel(film, image, {0.5 * std::sin(2.1), -0.5 * std::cos(2.1), 0});
  EXPECT_EQ(ahead, (std::array{128, 128, 128})) << "it has not been there yet";
}

TEST(RendersOverlays, TrailIsAnArcThroughTheWaypointsWhateverTheFrames) {
  // Two frames that are 250 degrees apart, a waypoint every 25 degrees.
  Film film = turning_tool();
  film.trails = true;
  const auto at = [](double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    Placement tool;
    tool.position = {0.4 * std::sin(angle), -0.4 * std::cos(angle), 0};
    tool.rotation = {0, 0, std::sin(angle / 2), std::cos(angle / 2)};
    return tool;
  };
  film.frames.resize(2);
  film.frames[1].time_s = 0.1;
  film.frames[1].placements[0] = at(250);
  for (int i = 1; i < 10; ++i) film.frames[1].before.push_back({0, 0.01 * i, at(25.0 * i)});
  const Image image = drawn(film, 1);
  for (int degrees = 100; degrees < 250; degrees += 5) {
    const double angle = degrees * std::numbers::pi / 180;
    const auto p = pixel(film, image, {0.5 * std::sin(angle), -0.5 * std::cos(angle), 0});
    EXPECT_GT(p[2], p[0] + 20) << degrees;
  }
  const auto chord = pixel(
      film, image,
      {0.25 * std::sin(125 * std::numbers::pi / 180), -0.25 * std::cos(125 * std::numbers::pi / 180), 0});
  EXPECT_EQ(chord, (std::array{128, 128, 128})) << "it did not take the short way";
}

TEST(RendersOverlays, ATrailHasAGapWhereTheToolWasNotThere) {
  Film film = turning_tool();
  film.trails = true;
  Waypoint gone = {0, 0.1, film.frames[2].placements[0]};
  gone.placement.visible = false;
  film.frames[3].before = {gone};
  const double angle = 50 * std::numbers::pi / 180;
  const Vec3 between = {0.5 * std::sin(angle), -0.5 * std::cos(angle), 0};
  EXPECT_EQ(pixel(film, drawn(film, 5), between), (std::array{128, 128, 128}));
}

TEST(RendersOverlays, LengthIsMarkedFromEndToEnd) {
  Film film = turning_tool();
  film.frames[2].callouts = {{DrawnCallout::Kind::length, "800.0 mm", {-0.6, 0.2, 0}, {0.6, 0.2, 0}}};
  const Image image = drawn(film, 2);
  for (const double x : {-0.6, -0.4, 0.4, 0.6}) EXPECT_GT(pixel(film, image, {x, 0.2, 0})[1], 220) << x;
  EXPECT_EQ(pixel(film, image, {0.7, 0.2, 0})[1], 128);
  EXPECT_LT(pixel(film, image, {0, 0.24, 0})[1], 60) << "the plate of the words";
  EXPECT_EQ(drawn(film, 1).rgb, grey(film).rgb) << "another frame has none";
}

TEST(RendersOverlays, ArrowPointsAlongTheForceAndGrowsWithIt) {
  Film film = turning_tool();
  film.frames[0].callouts = {{DrawnCallout::Kind::force, "cut", {0, 0, 0}, {0, 400, 0}}};
  film.frames[1].callouts = {{DrawnCallout::Kind::force, "cut", {0, 0, 0}, {0, 25, 0}}};
  const auto red = [&](std::size_t frame) {
    const Image image = drawn(film, frame);
    int rows = 0;
    for (int y = 0; y < film.height - kCaption; ++y) {
      const std::uint8_t* p = image.row(y) + 3 * (film.width / 2);
      if (p[0] > p[1] + 80) ++rows;
      if (y > (film.height - kCaption) / 2 + 4) {
        EXPECT_LE(p[0], p[1] + 80) << "below where it acts";
      }
    }
    return rows;
  };
  EXPECT_NEAR(red(0), 0.18 * (film.height - kCaption), 4);
  EXPECT_NEAR(red(1), (0.04 + 0.14 * 0.25) * (film.height - kCaption), 4);
}

DrawnCallout speed_at(double y, double speed) {
  return {DrawnCallout::Kind::speed, "tube", {-0.4, y, 0}, {speed, 0, 0}};
}
/// Columns with the green of a speed's arrow in the row of that height: the first, and how many.
std::pair<int, int> green_columns(const Film& film, const Image& image, double y) {
  const int row = static_cast<int>(projected(film.camera, film.width, film.height - kCaption, {0, y, 0})[1]);
  std::pair<int, int> found = {-1, 0};
  for (int x = 0; x < film.width; ++x) {
    const std::uint8_t* p = image.row(row) + 3 * x;
    if (p[1] < p[0] + 60 || p[1] < p[2] + 60) continue;
    if (found.second++ == 0) found.first = x;
  }
  return found;
}

TEST(RendersOverlays, ArrowsOfSpeedsAreInProportion) {
  Film film = turning_tool();
  const int longest = (film.height - kCaption) / 4;
  film.frames[0].callouts = {speed_at(0.3, 0.8), speed_at(-0.1, 0.2)};
  film.frames[1].callouts = {speed_at(0.3, 0.4), speed_at(-0.1, -0.4)};
  film.frames[2].callouts = {speed_at(0.3, 0.8), speed_at(-0.1, 0)};
  const auto from = projected(film.camera, film.width, film.height - kCaption, {-0.4, 0, 0})[0];
  const auto slow = drawn(film, 0);
  EXPECT_NEAR(green_columns(film, slow, 0.3).second, longest, 3);
  EXPECT_NEAR(green_columns(film, slow, -0.1).second, longest / 4.0, 3);
  EXPECT_NEAR(green_columns(film, slow, -0.1).first, from, 2) << "it begins where it moves";
  const auto half = drawn(film, 1);
  EXPECT_NEAR(green_columns(film, half, 0.3).second, longest / 2.0, 3) << "of the fastest of the whole film";
  EXPECT_NEAR(green_columns(film, half, -0.1).second, longest / 2.0, 3);
  EXPECT_NEAR(green_columns(film, half, -0.1).first, from - longest / 2.0, 3) << "backwards";
  const auto stands = drawn(film, 2);
  EXPECT_NEAR(green_columns(film, stands, 0.3).second, longest, 3);
  EXPECT_LE(green_columns(film, stands, -0.1).second, 6) << "a ring, no arrow";
  EXPECT_GE(green_columns(film, stands, -0.1).second, 1);
}

TEST(RendersOverlays, NoWordsCoverASpeedsArrow) {
  Film film = turning_tool();
  const DrawnCallout speed = speed_at(0, 0.8);
  film.frames[0].callouts = {speed};
  const auto bare = green_columns(film, drawn(film, 0), 0);
  // A force right above it, whose words would stand on the arrow.
  const double metre = projected(film.camera, film.width, film.height - kCaption, {0, 0, 0})[1] -
                       projected(film.camera, film.width, film.height - kCaption, {0, 1, 0})[1];
  const double above = (0.18 * (film.height - kCaption) + 14 * film.height / 540.0) / metre;
  film.frames[0].callouts.push_back({DrawnCallout::Kind::force, "clamp", {-0.3, above, 0}, {0, -2400, 0}});
  EXPECT_EQ(green_columns(film, drawn(film, 0), 0), bare);
}

TEST(RendersOverlays, TheQuotaIsALineAndItsGaugeShowsHowFarOffItIs) {
  Film film = turning_tool();
  const double tolerance = 0.3e-3;
  const Box gauge = gauge_box(film);
  const double scale = film.height / 540.0;
  EXPECT_GE(gauge.left, 0);
  EXPECT_LE(gauge.right, film.width);
  EXPECT_LE(gauge.bottom, film.height - kCaption);
  struct Case {
    double miss, tolerances;
    bool in;
  };
  for (const auto& [miss, tolerances, in] :
       {Case{0, 0, true}, Case{0.29e-3, 0.29 / 0.3, true}, Case{0.6e-3, 2, false},
        Case{-0.31e-3, -0.31 / 0.3, false}, Case{0.1, 4, false}, Case{-0.1, -4, false}}) {
    film.frames[0].quota = DrawnQuota{{-0.6, 0.2, 0}, {0, 0.2, 0}, 0.3, miss, tolerance};
    const Image image = drawn(film, 0);
    const auto line = pixel(film, image, {-0.48, 0.2, 0});
    EXPECT_TRUE(line[0] > line[2] + 60 && line[1] > line[2] + 40) << "yellow";
    // The mark beside the scale: its middle row, and whether it is green or orange.
    const int column = static_cast<int>(gauge.left + (12 + 16 + 8) * scale);
    double sum = 0, green = 0, orange = 0;
    for (int y = static_cast<int>(gauge.top + 30 * scale); y < gauge.bottom - 30 * scale; ++y) {
      const std::uint8_t* p = image.row(y) + 3 * column;
      if (p[2] > 120 || std::max(p[0], p[1]) < 120) continue;
      (p[0] > p[1] ? orange : green) += 1;
      sum += y + 0.5;
    }
    ASSERT_GT(green + orange, 3) << miss;
    EXPECT_EQ(green > 0, in) << miss;
    EXPECT_EQ(orange > 0, !in) << miss;
    EXPECT_NEAR(sum / (green + orange), (gauge.top + gauge.bottom) / 2 - 72 * scale * tolerances / 4, 1.5)
        << miss;
  }
  EXPECT_EQ(drawn(film, 1).rgb, grey(film).rgb) << "a frame without a quota has none";
}

TEST(RendersOverlays, TheGaugeStandsInThePictureOfTheFirstCamera) {
  Film film = turning_tool();
  film.width = 960;
  film.height = 540;
  EXPECT_NEAR(gauge_box(film).right, 950, 1e-9);
  film.beside = {{"ram", film.camera}};
  EXPECT_LT(gauge_box(film).right, 479);
}

TEST(RendersOverlays, LiveCurveHasItsLastValueAtTheRightEdge) {
  Film film = turning_tool();
  LiveCurve curve{"knife.motor.torque", "N m", {}, {}};
  for (int i = 0; i <= 200; ++i) {
    curve.times_s.push_back(0.001 * i);
    curve.values.push_back(i < 100 ? 0 : 1);
  }
  film.live = {curve};
  film.live_window_s = 0.1;
  const int view = film.height - kCaption;
  const auto lit_rows = [&](const Image& image) {  // of amber pixels a little left of the plot's right edge
    double sum = 0, count = 0;
    const double scale = film.height / 540.0;
    const int x = static_cast<int>(film.width - 20 * scale - 4);
    for (int y = static_cast<int>(0.745 * view); y < view; ++y) {
      const std::uint8_t* p = image.row(y) + 3 * x;
      if (p[0] > 150 && p[2] < 130) sum += y, ++count;
    }
    return count > 0 ? sum / count : -1;
  };
  const double low = lit_rows(drawn(film, 2));   // t = 0.08 s
  const double high = lit_rows(drawn(film, 5));  // t = 0.20 s
  EXPECT_GT(low, 0);
  EXPECT_GT(high, 0);
  EXPECT_LT(high, low - 20);
}

TEST(RendersOverlays, CurvesStartAtTheirOwnFirstPoint) {
  Film film = turning_tool();
  film.live = {{"a", "", {0, 0.2}, {0, 1}}, {"b", "", {0, 0.2}, {1, 1}}};
  film.live_window_s = 0.2;
  const Image image = drawn(film, 5);
  const int view = film.height - kCaption;
  int blue = 0;  // the second curve is level and in the middle: nothing of it above that
  for (int y = static_cast<int>(0.83 * view); y < static_cast<int>(0.84 * view); ++y)
    for (int x = 0; x < film.width; ++x)
      if (image.row(y)[3 * x + 2] > 180) ++blue;
  EXPECT_EQ(blue, 0);
}

using Middle = std::optional<std::array<double, 2>>;
Middle middle(double x, double y) { return std::array{x, y}; }

TEST(RendersLabels, PartWithAsLittleWayAsCanBe) {
  LabelRoom room(400, 200);
  EXPECT_EQ(room.place({100, 100}, 60, 20, false), middle(100, 100)) << "free: where it belongs";
  EXPECT_EQ(room.place({110, 100}, 60, 20, false), middle(110, 77)) << "a height and a little above it";
  EXPECT_EQ(room.place({90, 100}, 60, 20, false), middle(90, 123)) << "then below";
  EXPECT_EQ(room.place({100, 100}, 60, 20, false), middle(100, 54)) << "then two above";
  EXPECT_EQ(room.place({161, 100}, 60, 20, false), middle(161, 100)) << "beside all of them";
  EXPECT_EQ(room.place({300, 100}, 60, 20, true), middle(300, 77)) << "not on what it tells of";
}

TEST(RendersLabels, StayInThePictureAndOffWhatIsTaken) {
  LabelRoom room(400, 200);
  EXPECT_EQ(room.place({395, 198}, 60, 20, false), middle(370, 190)) << "moved in";
  EXPECT_EQ(room.place({2, 3}, 60, 20, true), middle(30, 33)) << "no room above";
  EXPECT_EQ(room.place({440, 100}, 60, 20, false), std::nullopt) << "what it tells of is not in the picture";
  room.take({150, 0, 250, 200});
  EXPECT_EQ(room.place({200, 100}, 60, 20, false), std::nullopt) << "nothing is free there";
}

TEST(RendersOverlays, LabelsOfShortPiecesBesideEachOtherDoNotMeet) {
  Film film = turning_tool();
  const auto plates = [&](std::vector<DrawnCallout> callouts) {  // pixels as dark as a plate
    film.frames[2].callouts = std::move(callouts);
    const Image image = drawn(film, 2);
    int count = 0;
    for (std::size_t i = 0; i < image.rgb.size(); i += 3)
      if (image.rgb[i] < 60 && image.rgb[i + 2] < 70) ++count;
    return count;
  };
  const DrawnCallout left = {DrawnCallout::Kind::length, "800.0 mm", {-0.1, 0.2, 0}, {0.02, 0.2, 0}};
  const DrawnCallout right = {DrawnCallout::Kind::length, "740.0 mm", {0.02, 0.2, 0}, {0.1, 0.2, 0}};
  EXPECT_GT(plates({left, right}), 1.8 * plates({left}));
}

TEST(RendersTiles, ShareThePictureWithAGapBetweenThem) {
  EXPECT_EQ(tiles_of(1, 960, 458), (std::vector<Tile>{{0, 0, 960, 458}}));
  EXPECT_EQ(tiles_of(2, 960, 458), (std::vector<Tile>{{0, 0, 479, 458}, {481, 0, 479, 458}}));
  EXPECT_EQ(tiles_of(3, 960, 458),
            (std::vector<Tile>{{0, 0, 479, 458}, {481, 0, 479, 228}, {481, 230, 479, 228}}));
  EXPECT_EQ(
      tiles_of(4, 961, 459),
      (std::vector<Tile>{{0, 0, 479, 228}, {481, 0, 480, 228}, {0, 230, 479, 229}, {481, 230, 480, 229}}));
  EXPECT_THROW(tiles_of(5, 960, 458), std::invalid_argument);
}

TEST(RendersOverlays, EachCameraHasItsNameAndItsMarks) {
  Film film = turning_tool();
  film.camera_name = "operator";
  film.beside = {{"knife", film.camera}};
  film.frames[2].callouts = {{DrawnCallout::Kind::length, "800.0 mm", {-0.3, 0.2, 0}, {0.3, 0.2, 0}}};
  const Image image = drawn(film, 2);
  const auto tiles = tiles_of(2, film.width, film.height - kCaption);
  for (const Tile& tile : tiles) {
    const auto at = projected(film.camera, tile.width, tile.height, {0.28, 0.2, 0});
    const std::uint8_t* on_line =
        image.row(static_cast<int>(at[1])) + 3 * (tile.left + static_cast<int>(at[0]));
    EXPECT_GT(on_line[1], 220) << "its line";
    EXPECT_LT(image.row(2)[3 * (tile.left + 2)], 60) << "the plate of its name";
  }
}

TEST(RendersOverlays, CameraGoesWithThePartItFollows) {
  Film film = turning_tool();
  EXPECT_EQ(camera_of(film, 3), film.camera);
  film.follow = 0;
  const auto first = projected(camera_of(film, 0), 480, 300, film.frames[0].placements[0].position);
  const auto later = projected(camera_of(film, 3), 480, 300, film.frames[3].placements[0].position);
  EXPECT_NEAR(first[0], later[0], 1e-9);
  EXPECT_NEAR(first[1], later[1], 1e-9);
}

TEST(RendersAntialias, FlatAreasStayAndStraightEdgesNearlyDo) {
  Image image(40, 40);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 60; ++x) image.row(y)[x] = 200;  // the left half
  Image smooth = image;
  antialias(smooth, 40);
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 40; ++x) {
      const bool beside = x == 19 || x == 20;
      EXPECT_NEAR(smooth.row(y)[3 * x], image.row(y)[3 * x], beside ? 200 / 20 : 0) << x << ' ' << y;
    }
  }
}

TEST(RendersAntialias, StairsOfASlantedEdgeGetTheShareThatTheyCover) {
  // The edge y = 20 + x / 8: in every pixel beside it the true cover is known.
  Image image(64, 48);
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64 * 3; ++x) image.row(y)[x] = y + 0.5 < 20 + (x / 3 + 0.5) / 8 ? 240 : 0;
  const auto error_of = [](const Image& shown) {
    double sum = 0;
    for (int x = 8; x < 56; ++x) {
      double column = 0;
      for (int y = 10; y < 40; ++y) column += shown.row(y)[3 * x];
      sum += std::abs(column / 240 - (10 + (x + 0.5) / 8));
    }
    return sum / 48;
  };
  Image smooth = image;
  antialias(smooth, 48);
  EXPECT_GT(error_of(image), 0.2);
  EXPECT_LT(error_of(smooth), 0.08);
}

}  // namespace
}  // namespace drycut::renders
