// Maps over two quantities, and the lines of equal value on them.
#include "renders/map_plot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "renders/contours.hpp"
#include "renders/png_image.hpp"
#include "tests/renders/renders_scratch.hpp"

namespace drycut::renders {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;
using ::testing::ThrowsMessage;

std::vector<double> steps(double low, double high, int count) {
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) values.push_back(low + (high - low) * i / (count - 1));
  return values;
}

std::vector<double> over(const std::vector<double>& x, const std::vector<double>& y,
                         const std::function<double(double, double)>& of) {
  std::vector<double> values;
  values.reserve(x.size() * y.size());
  for (const double b : y)
    for (const double a : x) values.push_back(of(a, b));
  return values;
}

TEST(Contours, ACircleIsOneClosedLineAtItsRadius) {
  const auto x = steps(-2, 2, 81);
  const auto values = over(x, x, [](double a, double b) { return std::hypot(a, b); });
  const auto lines = contours(x, x, values, 1.234);
  ASSERT_THAT(lines, SizeIs(1));
  EXPECT_EQ(lines[0].front(), lines[0].back());
  for (const auto& [a, b] : lines[0]) EXPECT_NEAR(std::hypot(a, b), 1.234, 5e-4);
  double length = 0;
  for (std::size_t i = 1; i < lines[0].size(); ++i)
    length +=
        std::hypot(lines[0][i].first - lines[0][i - 1].first, lines[0][i].second - lines[0][i - 1].second);
  EXPECT_NEAR(length, 2 * M_PI * 1.234, 5e-3);
}

TEST(Contours, APlaneIsCutInAStraightLineOnAnyGrid) {
  const std::vector<double> x = {0, 1, 4, 9};
  const std::vector<double> y = {-1, 0, 5};
  const auto lines = contours(x, y, over(x, y, [](double a, double b) { return 2 * a + b; }), 3);
  ASSERT_THAT(lines, SizeIs(1));
  for (const auto& [a, b] : lines[0]) EXPECT_NEAR(2 * a + b, 3, 1e-12);
  EXPECT_NEAR(std::abs(lines[0].front().second - lines[0].back().second), 4, 1e-12);  // from b = -1 to 3
}

TEST(Contours, ASaddlePartsAsItsMiddleSays) {
  const std::vector<double> unit = {0, 1};
  // High corners at (0, 0) and (1, 1). The middle is 0.5: over the level it joins them, under it parts them.
  for (const auto& [level, joined] : {std::pair{0.4, true}, std::pair{0.6, false}}) {
    const auto lines = contours(unit, unit, {1, 0, 0, 1}, level);
    ASSERT_THAT(lines, SizeIs(2)) << level;
    for (const auto& line : lines) {
      const double a = (line.front().first + line.back().first) / 2;
      const double b = (line.front().second + line.back().second) / 2;
      EXPECT_EQ(std::abs(a - b) > 0.3, joined) << level;  // around the low corners, or around the high ones
    }
  }
}

TEST(Contours, GoRoundWhatIsNotKnown) {
  const auto x = steps(0, 4, 5);
  auto values = over(x, x, [](double a, double) { return a; });
  values[2 * 5 + 2] = std::numeric_limits<double>::quiet_NaN();
  const auto lines = contours(x, x, values, 1.5);
  ASSERT_THAT(lines, SizeIs(2));
  for (const auto& line : lines)
    for (const auto& [a, b] : line) {
      EXPECT_EQ(a, 1.5);
      EXPECT_TRUE(b <= 1 || b >= 3);
    }
  EXPECT_THAT(contours(x, x, values, 9), SizeIs(0));
}

MapPlot example() {
  MapPlot map{.name = "map",
              .title = "Fastest line over the length of the pieces",
              .x = {"length [mm]", steps(500, 3000, 26)},
              .y = {"speed of the line [m/min]", steps(20, 300, 29)},
              .regions = {{"passed", MapRegion::Kind::good},
                          {"rms torque"},
                          {"follows the cam"},
                          {"refused", MapRegion::Kind::none}},
              .region = {}};
  for (const double speed : map.y.values)
    for (const double length : map.x.values)
      map.region.push_back(speed > 280 ? 3 : speed > length / 6 ? 1 : speed > 180 ? 2 : 0);
  map.lines = {{"rms torque [N m]", over(map.x.values, map.y.values,
                                         [](double l, double v) { return 40 * v * v / l / l * 100; })},
               {"accuracy [mm]", over(map.x.values, map.y.values, [](double l, double v) {
                  return v > 200 ? std::numeric_limits<double>::quiet_NaN() : v / 1000 + l / 20000;
                })}};
  map.curves = {{"torque boundary, closed form", {{500, 80}, {1000, 160}, {1800, 300}}}};
  return map;
}

TEST(MapPlot, ShowsEveryPointsRegion) {
  const Scratch scratch;
  auto map = example();
  map.lines.clear();
  map.curves.clear();
  const auto image = read_png(draw_map(map, scratch.path));
  const auto area = map_area(map);
  const auto colour_at = [&](double x, double y) {
    const auto* pixel = image.row(static_cast<int>(area.y(y))) + 3 * static_cast<int>(area.x(x));
    return std::array{pixel[0], pixel[1], pixel[2]};
  };
  const std::array<std::uint8_t, 3> paper = {255, 255, 255};
  std::array<std::array<std::uint8_t, 3>, 4> colours = {colour_at(2000, 100), colour_at(600, 200),
                                                        colour_at(2000, 200), colour_at(600, 300)};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(colours[i], colours[j]);
  for (std::size_t row = 0; row < map.y.values.size(); ++row)
    for (std::size_t column = 0; column < map.x.values.size(); ++column)
      EXPECT_EQ(colour_at(map.x.values[column], map.y.values[row]),
                colours[map.region[row * map.x.values.size() + column]])
          << map.x.values[column] << " " << map.y.values[row];
  // What was not run is not painted: between the points and beyond the last. The axes end there.
  for (const auto& colour : colours) EXPECT_NE(colour, paper);
  for (std::size_t row = 0; row + 1 < map.y.values.size(); ++row)
    for (std::size_t column = 0; column + 1 < map.x.values.size(); ++column)
      EXPECT_EQ(colour_at((map.x.values[column] + map.x.values[column + 1]) / 2,
                          (map.y.values[row] + map.y.values[row + 1]) / 2),
                paper)
          << map.x.values[column] << " " << map.y.values[row];
  EXPECT_EQ(area.x_range, Range(500, 3000));
  EXPECT_EQ(area.y_range, Range(20, 300));
  for (const double length : {500.0, 1700.0, 3000.0}) EXPECT_EQ(colour_at(length, 304), paper) << length;
}

// A mark between what passed and what failed beside it; none where one of both was not run.
TEST(MapPlot, MarksTheBoundBetweenTheVerdicts) {
  const Scratch scratch;
  MapPlot map{.name = "bound",
              .title = "",
              .x = {"x", {0, 1, 2}},
              .y = {"y", {0, 1, 2}},
              .regions = {{"passed", MapRegion::Kind::good}, {"torque"}, {"refused", MapRegion::Kind::none}},
              .region = {0, 0, 0, 0, 1, 0, 1, 1, 2},
              .bound = "the bound"};
  const auto area = map_area(map);
  const auto image = read_png(draw_map(map, scratch.path));
  const auto is_marked = [&](double x, double y) {
    bool dark = false;
    for (int dx = -2; dx <= 2; ++dx)
      for (int dy = -2; dy <= 2; ++dy)
        dark =
            dark || image.row(static_cast<int>(area.y(y)) + dy)[3 * (static_cast<int>(area.x(x)) + dx)] < 128;
    return dark;
  };
  EXPECT_TRUE(is_marked(0, 1.5));
  EXPECT_TRUE(is_marked(0.5, 1));
  EXPECT_TRUE(is_marked(1, 0.5));
  EXPECT_TRUE(is_marked(1.5, 1));
  EXPECT_FALSE(is_marked(0, 0.5));   // both passed
  EXPECT_FALSE(is_marked(0.5, 2));   // both failed
  EXPECT_FALSE(is_marked(2, 1.5));   // refused above passed
  EXPECT_FALSE(is_marked(1.75, 2));  // refused beside failed
}

TEST(MapPlot, IsTheSameBytesAgainAndTellsItsLines) {
  const Scratch scratch;
  const auto bytes = read_file(draw_map(example(), scratch.path));
  EXPECT_EQ(read_file(draw_map(example(), scratch.path / "again")), bytes);
  auto bare = example();
  bare.lines.clear();
  EXPECT_NE(read_file(draw_map(bare, scratch.path / "bare")), bytes);
}

TEST(MapPlot, DrawsNoLinesOfWhatIsUneven) {
  const Scratch scratch;
  auto map = example();
  map.curves.clear();
  map.lines.resize(1);
  const auto blue = [&](const std::function<double(std::size_t)>& value) {
    for (std::size_t i = 0; i < map.region.size(); ++i) map.lines[0].values[i] = value(i);
    return pixels_like(read_png(draw_map(map, scratch.path)), 0, 0x72, 0xb2);
  };
  EXPECT_GT(blue([](std::size_t i) { return static_cast<double>(i); }), 3000);
  EXPECT_LT(blue([](std::size_t i) { return static_cast<double>(i * 7919 % 101); }), 10);
  // Noise at one level takes no line from another: below 300 all ups and downs, above it a plane.
  map.lines[0].levels = {50, 500};
  const auto torn = [](std::size_t i) { return static_cast<double>(i < 300 ? i * 7919 % 101 : i); };
  const auto both = blue(torn);
  EXPECT_GT(both, 500);
  map.lines[0].levels = {500};
  EXPECT_EQ(blue(torn), both);
  map.lines[0].levels = {2000};  // there is none
  EXPECT_LT(blue(torn), 10);
}

TEST(MapPlot, RefusesWhatItCannotDraw) {
  const Scratch scratch;
  const auto refuses = [&](const std::function<void(MapPlot&)>& spoil, const char* words) {
    auto map = example();
    spoil(map);
    EXPECT_THAT([&] { draw_map(map, scratch.path); }, ThrowsMessage<std::invalid_argument>(HasSubstr(words)));
  };
  refuses([](MapPlot& map) { map.x.values = {1}; }, "'length [mm]' needs two or more ascending");
  refuses([](MapPlot& map) { map.y.values[3] = map.y.values[2]; }, "ascending");
  refuses([](MapPlot& map) { map.y.values[3] = std::nan(""); }, "ascending");
  refuses([](MapPlot& map) { map.region.pop_back(); }, "754 points and 753 regions");
  refuses([](MapPlot& map) { map.region[0] = 4; }, "a region that there is not");
  refuses([](MapPlot& map) { map.lines[1].values.clear(); }, "'accuracy [mm]' has 0 values");
  refuses([](MapPlot& map) { map.width = 100; }, "100x700");
}

}  // namespace
}  // namespace drycut::renders
