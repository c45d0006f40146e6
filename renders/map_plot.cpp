#include "renders/map_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "base/output_file.hpp"
#include "renders/axis_ticks.hpp"
#include "renders/contours.hpp"
#include "renders/paper.hpp"
#include "renders/png_image.hpp"
#include "renders/text.hpp"

namespace drycut::renders {
namespace {

constexpr double kTitleSize = 20;
constexpr double kTextSize = 15;
constexpr double kLevelSize = 13;
constexpr double kLegendWidth = 300;
constexpr Ink kGood = ink(0xc5ebdf);
constexpr Ink kNothing = ink(0xeef1f4);
constexpr std::array kBad = {ink(0xfbdcc4), ink(0xf3dcea), ink(0xfbe8b9), ink(0xcfe6f5),
                             ink(0xf5c6c2), ink(0xe3dcf6), ink(0xd8d2c4), ink(0xdadfe4)};
constexpr std::array kLineInks = {ink(0x0072b2), ink(0x6a3d9a), ink(0x006b4f), ink(0x8a4b00)};
const std::array<Dash, 3> kLineDashes = {Dash{}, Dash{8, 4}, Dash{3, 3}};
const Dash kCurveDash = {10, 4, 2, 4};
constexpr double kLineWidth = 1.6;
constexpr double kCurveWidth = 2.2;
constexpr double kRow = 24;             ///< of the legend
constexpr std::size_t kMostPieces = 4;  ///< of a level's line: more are noise

/// Half-way to the neighbours, and as far beyond the ends.
std::vector<double> borders(const std::vector<double>& values) {
  std::vector<double> found = {values[0] - (values[1] - values[0]) / 2};
  found.reserve(values.size() + 1);
  for (std::size_t i = 0; i + 1 < values.size(); ++i) found.push_back((values[i] + values[i + 1]) / 2);
  found.push_back(values.back() + (values.back() - values[values.size() - 2]) / 2);
  return found;
}

class MapPainter : Paper {
 public:
  MapPainter(cairo_t* pen, const MapPlot& map)
      : Paper(pen),
        map_(map),
        area_(map_area(map)),
        x_(borders(map.x.values)),
        y_(borders(map.y.values)),
        drawn_(map.lines.size()) {}

  void paint() {
    blank();
    text(area_.left, 24, fitted(map_.title, kTitleSize, map_.width - area_.left - 10, true), Align::left,
         kTitleSize, true);
    cells();
    axes();
    clipped(area_, [&] {
      for (std::size_t i = 0; i < map_.lines.size(); ++i) lines(i);
      for (const MapCurve& shown : map_.curves) curve(shown);
    });
    legend();
  }

 private:
  /// Neighbours of one region in a row are one box: no seams.
  void cells() {
    const std::size_t columns = map_.x.values.size();
    for (std::size_t row = 0; row < map_.y.values.size(); ++row) {
      for (std::size_t first = 0; first < columns;) {
        const std::size_t region = map_.region[row * columns + first];
        std::size_t last = first + 1;
        while (last < columns && map_.region[row * columns + last] == region) ++last;
        box(std::floor(area_.x(x_[first])), std::floor(area_.y(y_[row + 1])), std::floor(area_.x(x_[last])),
            std::floor(area_.y(y_[row])), ink_of(region));
        first = last;
      }
    }
    borders_of_regions();
  }

  void borders_of_regions() {
    const std::size_t columns = map_.x.values.size();
    const auto differ = [&](std::size_t a, std::size_t b) { return map_.region[a] != map_.region[b]; };
    for (std::size_t row = 0; row < map_.y.values.size(); ++row) {
      for (std::size_t column = 0; column < columns; ++column) {
        const std::size_t here = row * columns + column;
        const double left = area_.x(x_[column]);
        const double right = area_.x(x_[column + 1]);
        if (column + 1 < columns && differ(here, here + 1))
          line(right, area_.y(y_[row]), right, area_.y(y_[row + 1]), kPaper, 1.5);
        if (row + 1 < map_.y.values.size() && differ(here, here + columns))
          line(left, area_.y(y_[row + 1]), right, area_.y(y_[row + 1]), kPaper, 1.5);
      }
    }
  }

  void axes() {
    const double left = crisp(area_.left);
    const double bottom = crisp(area_.bottom);
    line(left, area_.top, left, bottom, kAxis, kGridWidth);
    line(left, bottom, area_.right, bottom, kAxis, kGridWidth);
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
    const Ink& colour = kLineInks[index % kLineInks.size()];
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
      const PlotArea room = {x - width / 2, y - kLevelSize * 0.7, x + width / 2, y + kLevelSize * 0.7};
      const bool inside = room.left >= area_.left && room.right <= area_.right && room.top >= area_.top &&
                          room.bottom <= area_.bottom;
      const bool free = std::none_of(labels_.begin(), labels_.end(), [&](const PlotArea& other) {
        return room.left < other.right && other.left < room.right && room.top < other.bottom &&
               other.top < room.bottom;
      });
      if (!inside || !free) continue;
      labels_.push_back(room);
      box(room.left, room.top, room.right, room.bottom, kPaper, 0.85);
      text(x, y, words, Align::middle, kLevelSize, false, colour);
      return;
    }
  }

  void legend() {
    const double left = area_.right + 24;
    const double sample = 28;
    const double room = map_.width - left - sample - 16;
    double y = area_.top + 10;
    const auto words = [&](const std::string& label) {
      text(left + sample + 8, y, fitted(label, kTextSize, room), Align::left, kTextSize);
      y += kRow;
    };
    for (std::size_t i = 0; i < map_.regions.size(); ++i) {
      if (std::find(map_.region.begin(), map_.region.end(), i) == map_.region.end()) continue;
      box(left, y - 8, left + sample, y + 8, ink_of(i));
      words(map_.regions[i].label);
    }
    y += kRow / 2;
    for (std::size_t i = 0; i < map_.lines.size(); ++i) {
      if (!drawn_[i]) {
        words("no lines: " + map_.lines[i].label);
        continue;
      }
      line(left, y, left + sample, y, kLineInks[i % kLineInks.size()], kLineWidth,
           kLineDashes[i % kLineDashes.size()]);
      words(map_.lines[i].label);
    }
    for (const MapCurve& shown : map_.curves) {
      line(left, y, left + sample, y, kText, kCurveWidth, kCurveDash);
      words(shown.label);
    }
  }

  [[nodiscard]] const Ink& ink_of(std::size_t region) const {
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
  std::vector<double> x_;  // borders of the cells
  std::vector<double> y_;
  std::vector<PlotArea> labels_;
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
  const auto x = borders(map.x.values);
  const auto y = borders(map.y.values);
  return {80, 48, map.width - kLegendWidth, map.height - 60.0, {x.front(), x.back()}, {y.front(), y.back()}};
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
