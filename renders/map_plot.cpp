#include "renders/map_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "base/output_file.hpp"
#include "renders/axes.hpp"
#include "renders/contours.hpp"
#include "renders/label_room.hpp"
#include "renders/paper.hpp"
#include "renders/png_image.hpp"
#include "renders/text.hpp"

namespace drycut::renders {
namespace {

constexpr double kTitleSize = 20;
constexpr double kTextSize = 15;
constexpr double kLevelSize = 13;
constexpr double kLegendWidth = 300;
const std::array<Dash, 3> kLineDashes = {Dash{}, Dash{8, 4}, Dash{3, 3}};
const Dash kCurveDash = {10, 4, 2, 4};
constexpr Tone kGood = kCurves[2];
constexpr Tone kNothing = {0xa3adb8};
constexpr std::array kBad = {kCurves[1], kCurves[4],     kCurves[3],     kCurves[5],
                             kStrong,    Tone{0x8d6cb8}, Tone{0x7a6a4f}, kSoftText};
constexpr std::array kLineTones = {kCurves[0], Tone{0x6a3d9a}, Tone{0x006b4f}, Tone{0x8a4b00}};
constexpr double kLineWidth = 1.6;
constexpr double kCurveWidth = 2.2;
constexpr double kBoundWidth = 1.4;
constexpr double kClear = 14;  ///< between the outermost points and the axes
constexpr double kLargestDot = 7;
constexpr double kSmallestDot = 1.5;
constexpr double kRow = 24;             ///< of the legend
constexpr double kNextLine = 18;        ///< of words there that take more than one
constexpr std::size_t kMostPieces = 4;  ///< of a level's line: more are noise

/// Half-way to the neighbour on either side; at the ends no further.
Range around(const std::vector<double>& values, std::size_t i) {
  return {i == 0 ? values[i] : (values[i - 1] + values[i]) / 2,
          i + 1 == values.size() ? values[i] : (values[i] + values[i + 1]) / 2};
}

class MapPainter : Paper {
 public:
  MapPainter(cairo_t* pen, const MapPlot& map)
      : Paper(pen), map_(map), area_(map_area(map)), radius_(dot_radius()), drawn_(map.lines.size()) {}

  void paint() {
    blank();
    text(area_.left, 24, fitted(map_.title, kTitleSize, map_.width - area_.left - 10, true), Align::left,
         kTitleSize, true);
    axes();
    points();
    clipped(area_, [&] {
      for (std::size_t i = 0; i < map_.lines.size(); ++i) lines(i);
      for (const MapCurve& shown : map_.curves) curve(shown);
    });
    if (!map_.bound.empty()) bound();
    legend();
  }

 private:
  /// So that neighbours do not touch.
  [[nodiscard]] double dot_radius() const {
    constexpr double share = 0.35;  // of the way to the nearest
    double nearest = kLargestDot / share;
    for (std::size_t i = 1; i < map_.x.values.size(); ++i)
      nearest = std::min(nearest, area_.x(map_.x.values[i]) - area_.x(map_.x.values[i - 1]));
    for (std::size_t i = 1; i < map_.y.values.size(); ++i)
      nearest = std::min(nearest, area_.y(map_.y.values[i - 1]) - area_.y(map_.y.values[i]));
    return std::max(kSmallestDot, share * nearest);
  }

  void points() const {
    const std::size_t columns = map_.x.values.size();
    for (std::size_t i = 0; i < map_.region.size(); ++i)
      point(area_.x(map_.x.values[i % columns]), area_.y(map_.y.values[i / columns]), radius_,
            map_.region[i]);
  }

  void point(double x, double y, double radius, std::size_t region) const {
    const double half = 0.85 * radius;
    switch (map_.regions[region].kind) {
      case MapRegion::Kind::good:
        return dot(x, y, radius, ink_of(region));
      case MapRegion::Kind::bad:
        return box(x - half, y - half, x + half, y + half, ink_of(region));
      case MapRegion::Kind::none:
        break;
    }
    const double arm = 0.6 * radius;
    x = crisp(x);
    y = crisp(y);
    line(x - arm, y - arm, x + arm, y + arm, ink_of(region), 2);
    line(x - arm, y + arm, x + arm, y - arm, ink_of(region), 2);
  }

  /// Half-way between neighbours of which one is good and one bad.
  void bound() const {
    const std::size_t columns = map_.x.values.size();
    const auto part = [&](std::size_t a, std::size_t b) {
      const auto kind = [&](std::size_t i) { return map_.regions[map_.region[i]].kind; };
      using Kind = MapRegion::Kind;
      return (kind(a) == Kind::good && kind(b) == Kind::bad) ||
             (kind(a) == Kind::bad && kind(b) == Kind::good);
    };
    for (std::size_t i = 0; i < map_.region.size(); ++i) {
      const auto [left, right] = around(map_.x.values, i % columns);
      const auto [low, high] = around(map_.y.values, i / columns);
      if (i % columns + 1 < columns && part(i, i + 1))
        line(area_.x(right), area_.y(low), area_.x(right), area_.y(high), kText, kBoundWidth);
      if (i + columns < map_.region.size() && part(i, i + columns))
        line(area_.x(left), area_.y(high), area_.x(right), area_.y(high), kText, kBoundWidth);
    }
  }

  void axes() {
    const double left = crisp(area_.left - kClear);
    const double bottom = crisp(area_.bottom + kClear);
    line(left, area_.top, left, area_.bottom, kAxis, kGridWidth);
    line(area_.left, bottom, area_.right, bottom, kAxis, kGridWidth);
    for (const Tick& tick : axis_ticks(area_.x_range.first, area_.x_range.second, 10)) {
      const double x = crisp(area_.x(tick.value));
      line(x, bottom, x, bottom + kTickLength, kAxis, kGridWidth);
      text(x, bottom + 18, tick.label, Align::middle, kTextSize);
    }
    for (const Tick& tick : axis_ticks(area_.y_range.first, area_.y_range.second, 10)) {
      const double y = crisp(area_.y(tick.value));
      line(left - kTickLength, y, left, y, kAxis, kGridWidth);
      text(left - 9, y, tick.label, Align::right, kTextSize);
    }
    text((area_.left + area_.right) / 2, map_.height - 16,
         fitted(map_.x.label, kTextSize, area_.right - area_.left), Align::middle, kTextSize);
    text(18, (area_.top + area_.bottom) / 2, fitted(map_.y.label, kTextSize, area_.bottom - area_.top),
         Align::middle, kTextSize, false, kText, true);
  }

  void lines(std::size_t index) {
    const MapLines& shown = map_.lines[index];
    const Ink colour = kLineTones[index % kLineTones.size()];
    for (const Tick& level : levels_of(shown)) {
      const auto paths = contours(map_.x.values, map_.y.values, shown.values, level.value);
      if (paths.empty() || paths.size() > kMostPieces) continue;
      drawn_[index] = true;
      for (const Polyline& path : paths) {
        draw(path);
        stroke(colour, kLineWidth, kLineDashes[index % kLineDashes.size()]);
        label(path, level.label, colour, index);
      }
    }
  }

  static std::vector<Tick> levels_of(const MapLines& shown) {
    std::vector<Tick> levels;
    for (const double level : shown.levels) levels.push_back({level, fmt::format("{:.6g}", level)});
    if (!levels.empty()) return levels;
    double low = HUGE_VAL;
    double high = -HUGE_VAL;
    for (const double value : shown.values) {
      if (!std::isfinite(value)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
    return low < high ? axis_ticks(low, high, 6) : levels;
  }

  void curve(const MapCurve& shown) {
    draw(shown.points);
    stroke(kText, kCurveWidth, kCurveDash);
  }

  void draw(const Polyline& path) {
    cairo_new_path(pen());
    for (const auto& [x, y] : path) cairo_line_to(pen(), area_.x(x), area_.y(y));
  }

  /// On the line, where it is long enough and no other label stands.
  void label(const Polyline& path, const std::string& words, const Ink& colour, std::size_t index) {
    double length = 0;
    for (std::size_t i = 1; i < path.size(); ++i)
      length += std::hypot(area_.x(path[i].first) - area_.x(path[i - 1].first),
                           area_.y(path[i].second) - area_.y(path[i - 1].second));
    const double width = text_width(words, kLevelSize) + 6;
    if (length < 2 * width) return;
    // Lines of several quantities have their labels at places of their own.
    const double shares[] = {0.5, 0.3, 0.7, 0.15, 0.85};
    for (std::size_t attempt = 0; attempt < std::size(shares); ++attempt) {
      const auto share = shares[(attempt + index) % std::size(shares)];
      const auto& at = path[static_cast<std::size_t>(share * static_cast<double>(path.size() - 1))];
      const double x = area_.x(at.first);
      const double y = area_.y(at.second);
      const Box room = {x - width / 2, y - kLevelSize * 0.7, x + width / 2, y + kLevelSize * 0.7};
      const bool inside = room.left >= area_.left && room.right <= area_.right && room.top >= area_.top &&
                          room.bottom <= area_.bottom;
      const bool free =
          std::none_of(labels_.begin(), labels_.end(), [&](const Box& other) { return room.meets(other); });
      if (!inside || !free) continue;
      labels_.push_back(room);
      box(room.left, room.top, room.right, room.bottom, kPaper, 0.85);
      text(x, y, words, Align::middle, kLevelSize, false, colour);
      return;
    }
  }

  void legend() {
    const double left = area_.right + kClear + 24;
    const double sample = 28;
    const double room = map_.width - left - sample - 16;
    double y = area_.top + 10;
    const auto words = [&](const std::string& label) {
      constexpr std::size_t most_lines = 3;
      y -= kNextLine;
      for (const auto& line : wrapped_text(one_line(label), kTextSize, room, most_lines))
        text(left + sample + 8, y += kNextLine, line, Align::left, kTextSize);
      y += kRow;
    };
    for (std::size_t i = 0; i < map_.regions.size(); ++i) {
      if (std::find(map_.region.begin(), map_.region.end(), i) == map_.region.end()) continue;
      point(left + sample / 2, y, kLargestDot, i);
      words(map_.regions[i].label);
    }
    if (!map_.bound.empty()) {
      line(left, y, left + sample, y, kText, kBoundWidth);
      words(map_.bound);
    }
    y += kRow / 2;
    for (std::size_t i = 0; i < map_.lines.size(); ++i) {
      if (!drawn_[i]) {
        words("no lines: " + map_.lines[i].label);
        continue;
      }
      line(left, y, left + sample, y, kLineTones[i % kLineTones.size()], kLineWidth,
           kLineDashes[i % kLineDashes.size()]);
      words(map_.lines[i].label);
    }
    for (const MapCurve& shown : map_.curves) {
      line(left, y, left + sample, y, kText, kCurveWidth, kCurveDash);
      words(shown.label);
    }
  }

  [[nodiscard]] Ink ink_of(std::size_t region) const {
    const auto kind = map_.regions[region].kind;
    if (kind == MapRegion::Kind::good) return kGood;
    if (kind == MapRegion::Kind::none) return kNothing;
    const auto earlier =
        std::count_if(map_.regions.begin(), map_.regions.begin() + static_cast<std::ptrdiff_t>(region),
                      [](const MapRegion& other) { return other.kind == MapRegion::Kind::bad; });
    return kBad[static_cast<std::size_t>(earlier) % kBad.size()];
  }

  const MapPlot& map_;
  PlotArea area_;
  double radius_;  // of the dots
  std::vector<Box> labels_;
  std::vector<bool> drawn_;  // of each quantity: a line at least
};

[[noreturn]] void refuse(const MapPlot& map, const std::string& what) {
  throw std::invalid_argument(fmt::format("map '{}': {}", map.name, what));
}

void require_drawable(const MapPlot& map) {
  if (map.width < 600 || map.height < 300 || map.width > 10000 || map.height > 10000)
    refuse(map,
           fmt::format("{}x{} cannot be drawn; 600x300 to 10000x10000 pixels can", map.width, map.height));
  for (const MapAxis* axis : {&map.x, &map.y}) {
    const auto& values = axis->values;
    const bool finite = std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
    const bool ascending =
        std::adjacent_find(values.begin(), values.end(), std::greater_equal<>()) == values.end();
    if (values.size() < 2 || !finite || !ascending)
      refuse(map, fmt::format("axis '{}' needs two or more ascending values", one_line(axis->label)));
  }
  const std::size_t points = map.x.values.size() * map.y.values.size();
  if (map.region.size() != points)
    refuse(map, fmt::format("it has {} points and {} regions of them", points, map.region.size()));
  for (const std::size_t region : map.region)
    if (region >= map.regions.size()) refuse(map, "a point belongs to a region that there is not");
  for (const MapLines& lines : map.lines)
    if (lines.values.size() != points)
      refuse(map, fmt::format("'{}' has {} values for {} points", one_line(lines.label), lines.values.size(),
                              points));
}

}  // namespace

PlotArea map_area(const MapPlot& map) {
  return {80 + kClear,
          48,
          map.width - kLegendWidth - kClear,
          map.height - 60.0 - kClear,
          {map.x.values.front(), map.x.values.back()},
          {map.y.values.front(), map.y.values.back()}};
}

std::filesystem::path draw_map(const MapPlot& map, const std::filesystem::path& directory) {
  require_drawable(map);
  Image image(map.width, map.height);
  const CairoSurface surface = cairo_surface(map.width, map.height);
  const Cairo pen = cairo_pen(surface.get());
  MapPainter(pen.get(), map).paint();
  copy_rows(surface.get(), map.height, image, 0);
  std::filesystem::create_directories(directory);
  auto file = directory / (map.name + ".png");
  constexpr int effort = 6;
  write_file(file, png_bytes(image, effort));
  return file;
}

}  // namespace drycut::renders
