#include "renders/overlays.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "renders/cairo_image.hpp"
#include "renders/camera.hpp"
#include "renders/geometry.hpp"
#include "renders/label_room.hpp"
#include "renders/quota_gauge.hpp"

namespace drycut::renders {
namespace {

constexpr std::size_t kTrailFrames = 12;
constexpr double kFinest = 8;   ///< length of the lines of a trail, for a film 540 pixels high [pixels]
constexpr int kMostLines = 12;  ///< from one known place of the tip to the next
constexpr double kLongestArrow = 0.18;  ///< of the picture's height, for the film's largest force
constexpr double kShortestArrow = 0.04;
constexpr double kFastestArrow = 0.25;  ///< for the film's highest speed; others in proportion
constexpr double kSeenArrow = 2;        ///< what is shorter is a ring [pixels]

using Point = std::array<double, 2>;  // pixels

/// What every mark on what a camera sees needs to know.
struct OverlaySheet {
  cairo_t* pen;
  const Camera& camera;
  int width;
  int height;
  double scale;  ///< 1 for a film 540 pixels high
  LabelRoom& room;

  Point at(const Vec3& point) const { return projected(camera, width, height, point); }
  bool before_eye(const Vec3& point) const {
    return (point - camera.eye).dot(camera.target - camera.eye) > 0;
  }
};

/// Words on a dark plate with their middle at `wanted`, or, where others stand there or the plate would hide
/// a line of that `length`, beside it with a thin line back. Left out where there is no room.
void plate(const OverlaySheet& sheet, const Point& wanted, const std::string& words, double length) {
  const double size = 12 * sheet.scale;
  cairo_set_font_size(sheet.pen, size);
  const double half = text_width(sheet.pen, words) / 2 + 0.4 * size;
  const double high = 0.75 * size;
  const auto place = sheet.room.place(wanted, 2 * half, 2 * high, length < 2.5 * half);
  if (!place) return;
  const Point at = *place;
  if (std::abs(at[1] - wanted[1]) > high) {
    cairo_move_to(sheet.pen, wanted[0], wanted[1]);
    cairo_line_to(sheet.pen, at[0], at[1]);
    set_ink(sheet.pen, kGround, 0.85);
    cairo_set_line_width(sheet.pen, sheet.scale);
    cairo_stroke(sheet.pen);
  }
  set_ink(sheet.pen, kGround, 0.85);
  fill_box(sheet.pen, at[0] - half, at[1] - high, 2 * half, 2 * high);
  cairo_set_source_rgb(sheet.pen, 1, 1, 1);
  write_text(sheet.pen, at[0] - half + 0.4 * size, at[1] + 0.36 * size, words);
}

/// A line with a dark border, so that it shows on bright and dark parts alike.
void stroke(const OverlaySheet& sheet, double red, double green, double blue) {
  cairo_set_line_cap(sheet.pen, CAIRO_LINE_CAP_ROUND);
  cairo_set_source_rgba(sheet.pen, 0.05, 0.06, 0.08, 0.8);
  cairo_set_line_width(sheet.pen, 4.5 * sheet.scale);
  cairo_stroke_preserve(sheet.pen);
  cairo_set_source_rgb(sheet.pen, red, green, blue);
  cairo_set_line_width(sheet.pen, 2.2 * sheet.scale);
  cairo_stroke(sheet.pen);
}

void line(const OverlaySheet& sheet, const Point& from, const Point& to) {
  cairo_move_to(sheet.pen, from[0], from[1]);
  cairo_line_to(sheet.pen, to[0], to[1]);
}

/// A mark that is drawn, and the words that come to it once all are.
struct Marked {
  Point at;
  std::string words;
  double length = 1e9;  ///< of the line on which they stand; long, if they hide none [pixels]
};

/// A line between the two ends with a stroke up and down at each, which is where it was cut.
std::optional<Marked> draw_length(const OverlaySheet& sheet, const DrawnCallout& callout) {
  if (!sheet.before_eye(callout.at) || !sheet.before_eye(callout.to)) return std::nullopt;
  const Point from = sheet.at(callout.at);
  const Point to = sheet.at(callout.to);
  const double tick = 8 * sheet.scale;
  line(sheet, from, to);
  for (const Point& end : {from, to}) line(sheet, {end[0], end[1] - tick}, {end[0], end[1] + tick});
  stroke(sheet, 1, 1, 1);
  return Marked{{(from[0] + to[0]) / 2, (from[1] + to[1]) / 2},
                callout.text,
                std::hypot(to[0] - from[0], to[1] - from[1])};
}

/// The path of an arrow from `at` along `way`, so many pixels long; its end. None where it points at the eye.
std::optional<Point> arrow(const OverlaySheet& sheet, const Vec3& at, const Vec3& way, double pixels) {
  if (!sheet.before_eye(at)) return std::nullopt;
  const double reach = (at - sheet.camera.eye).norm();
  const Point from = sheet.at(at);
  const Point ahead = sheet.at(at + 0.02 * reach * way.normalized());
  const double seen = std::hypot(ahead[0] - from[0], ahead[1] - from[1]);
  if (seen < 1e-6) return std::nullopt;
  const Point unit = {(ahead[0] - from[0]) / seen, (ahead[1] - from[1]) / seen};
  const Point to = {from[0] + pixels * unit[0], from[1] + pixels * unit[1]};
  const double head = std::min(9 * sheet.scale, pixels);
  line(sheet, from, to);
  for (const double side : {-0.6, 0.6})
    line(sheet, {to[0] - head * (unit[0] + side * unit[1]), to[1] - head * (unit[1] - side * unit[0])}, to);
  return to;
}

std::optional<Marked> draw_force(const OverlaySheet& sheet, const DrawnCallout& callout, double largest) {
  const double force = callout.to.norm();
  if (force < 1e-3 * largest) return std::nullopt;
  const double pixels =
      sheet.height * (kShortestArrow + (kLongestArrow - kShortestArrow) * std::sqrt(force / largest));
  const auto to = arrow(sheet, callout.at, callout.to, pixels);
  if (!to) return std::nullopt;
  stroke(sheet, 1.0, 0.25, 0.18);
  const Point from = sheet.at(callout.at);
  const Point unit = {((*to)[0] - from[0]) / pixels, ((*to)[1] - from[1]) / pixels};
  return Marked{{(*to)[0] + 22 * sheet.scale * unit[0], (*to)[1] + 14 * sheet.scale * unit[1]},
                fmt::format("{} {:.0f} N", callout.text, force)};
}

/// As long as what moves is fast, so that two arrows can be compared, with words below; a ring where it is
/// too short. Nothing else is written on it.
std::optional<Marked> draw_speed(const OverlaySheet& sheet, const DrawnCallout& callout, double fastest) {
  if (!sheet.before_eye(callout.at)) return std::nullopt;
  const double speed = callout.to.norm();
  const Point from = sheet.at(callout.at);
  const double pixels = speed > 0 ? sheet.height * kFastestArrow * speed / fastest : 0;
  std::optional<Point> end;
  if (pixels > kSeenArrow) end = arrow(sheet, callout.at, callout.to, pixels);
  if (!end) cairo_arc(sheet.pen, from[0], from[1], 4 * sheet.scale, 0, 2 * std::numbers::pi), end = from;
  stroke(sheet, 0.45, 0.95, 0.35);
  const double half = 6 * sheet.scale;  // of its head
  sheet.room.take({std::min(from[0], (*end)[0]) - half, std::min(from[1], (*end)[1]) - half,
                   std::max(from[0], (*end)[0]) + half, std::max(from[1], (*end)[1]) + half});
  const double shown = 60 * speed;  // [m/min]
  const auto words =
      shown < 0.05 ? callout.text + " stands" : fmt::format("{} {:.1f} m/min", callout.text, shown);
  return Marked{{(from[0] + (*end)[0]) / 2, (from[1] + (*end)[1]) / 2 + 16 * sheet.scale}, words};
}

Marked draw_quota(const OverlaySheet& sheet, const DrawnQuota& quota) {
  const Point right = sheet.at(quota.right);
  line(sheet, sheet.at(quota.left), right);
  stroke(sheet, 1.0, 0.85, 0.20);
  return {right, fmt::format("quota {:.2f} mm", quota.place * 1e3)};
}

/// Where a tip was at a time [s].
struct TipPlace {
  double time_s;
  Vec3 place;
};

/// Its speed at the middle one of three places, by the parabola through them.
Vec3 speed_at(const TipPlace& a, const TipPlace& b, const TipPlace& c) {
  const double before = b.time_s - a.time_s;
  const double after = c.time_s - b.time_s;
  return ((b.place - a.place) * (after / before) + (c.place - b.place) * (before / after)) / (before + after);
}

/// The smooth way from one place to the next that is left and reached with these speeds (Hermite); `t` 0..1.
Vec3 on_way(const TipPlace& from, const Vec3& leaves, const TipPlace& to, const Vec3& comes, double t) {
  const double time = to.time_s - from.time_s;
  const double u = 1 - t;
  return (1 + 2 * t) * u * u * from.place + t * t * (3 - 2 * t) * to.place +
         t * u * time * (u * leaves - t * comes);
}

/// Where the tip of a part has been in the frames from `first` on until `frame`, in stretches in which it was
/// visible.
std::vector<std::vector<TipPlace>> ways_of_tip(const Film& film, std::size_t part, std::size_t first,
                                               std::size_t frame) {
  std::vector<std::vector<TipPlace>> ways(1);
  const auto add = [&](double time_s, const Placement& placement) {
    if (!placement.visible) {
      if (!ways.back().empty()) ways.emplace_back();
    } else if (ways.back().empty() || time_s > ways.back().back().time_s) {
      ways.back().push_back({time_s, placed(placement, *film.parts[part].tip)});
    }
  };
  for (std::size_t f = first; f <= frame; ++f) {
    if (f > first)
      for (const Waypoint& way : film.frames[f].before)
        if (way.part == part) add(way.time_s, way.placement);
    add(film.frames[f].time_s, film.frames[f].placements[part]);
  }
  return ways;
}

/// Where the tip of a part was in the last frames; older is fainter.
void draw_trail(const OverlaySheet& sheet, const Film& film, std::size_t part, std::size_t frame) {
  const std::size_t first = frame - std::min(frame, kTrailFrames);
  const double now_s = film.frames[frame].time_s;
  const double oldest_s = (now_s - film.frames[first].time_s) * (1 + 1.0 / kTrailFrames);
  cairo_set_line_width(sheet.pen, 2.5 * sheet.scale);
  cairo_set_line_cap(sheet.pen, CAIRO_LINE_CAP_ROUND);
  for (const auto& way : ways_of_tip(film, part, first, frame)) {
    for (std::size_t i = 0; i + 1 < way.size(); ++i) {
      const TipPlace& from = way[i];
      const TipPlace& to = way[i + 1];
      if (!sheet.before_eye(from.place) || !sheet.before_eye(to.place)) continue;
      const Vec3 straight = (to.place - from.place) / (to.time_s - from.time_s);
      const bool begins = i == 0;
      const bool ends = i + 2 == way.size();
      Vec3 leaves = begins ? straight : speed_at(way[i - 1], from, to);
      Vec3 comes = ends ? straight : speed_at(from, to, way[i + 2]);
      // At the ends as by the parabola, too.
      if (begins && !ends) leaves = 2 * straight - comes;
      if (ends && !begins) comes = 2 * straight - leaves;
      const Point begin = sheet.at(from.place);
      const Point end = sheet.at(to.place);
      const double length = std::hypot(end[0] - begin[0], end[1] - begin[1]) / (kFinest * sheet.scale);
      const int lines = std::clamp(static_cast<int>(std::ceil(length)), 1, kMostLines);
      cairo_move_to(sheet.pen, begin[0], begin[1]);
      for (int k = 1; k <= lines; ++k) {
        const Point at = sheet.at(on_way(from, leaves, to, comes, static_cast<double>(k) / lines));
        cairo_line_to(sheet.pen, at[0], at[1]);
      }
      const double age = (now_s - from.time_s) / oldest_s;
      cairo_set_source_rgba(sheet.pen, 0.0, 0.85, 0.95, 0.9 * (1 - age));
      cairo_stroke(sheet.pen);
    }
  }
}

}  // namespace

Overlays::Overlays(const Film& film, int caption_height)
    : film_(film),
      live_(film),
      height_(film.height - caption_height),
      tiles_(tiles_of(1 + film.beside.size(), film.width, height_)),
      empty_(!film.trails && film.live.empty() && film.beside.empty()) {
  for (const Frame& frame : film.frames) {
    empty_ = empty_ && frame.callouts.empty() && !frame.quota;
    for (const DrawnCallout& callout : frame.callouts) {
      if (callout.kind == DrawnCallout::Kind::force) largest_ = std::max(largest_, callout.to.norm());
      if (callout.kind == DrawnCallout::Kind::speed) fastest_ = std::max(fastest_, callout.to.norm());
    }
  }
}

void Overlays::draw(std::size_t frame, Image& image) const {
  if (empty_) return;
  const CairoSurface surface = cairo_surface_of(image, height_);
  const Cairo pen = cairo_pen(surface.get());
  for (std::size_t view = 0; view < tiles_.size(); ++view) {
    const Tile& tile = tiles_[view];
    cairo_save(pen.get());
    cairo_rectangle(pen.get(), tile.left, tile.top, tile.width, tile.height);
    cairo_clip(pen.get());
    cairo_translate(pen.get(), tile.left, tile.top);
    draw_view(frame, view, pen.get());
    cairo_restore(pen.get());
  }
  live_.draw(pen.get(), film_.frames[frame].time_s, height_);
  if (film_.frames[frame].quota) draw_gauge(pen.get(), film_, *film_.frames[frame].quota);
  copy_rows(surface.get(), height_, image, 0);
}

void Overlays::draw_view(std::size_t frame, std::size_t view, cairo_t* pen) const {
  const Tile& tile = tiles_[view];
  const Camera camera = camera_of(film_, frame, view);
  LabelRoom room(tile.width, tile.height);
  const auto keep_free = [&](Box box) {
    box.left -= tile.left, box.right -= tile.left;
    box.top -= tile.top, box.bottom -= tile.top;
    room.take(box);
  };
  keep_free(live_.box(height_));
  const std::optional<DrawnQuota>& quota = film_.frames[frame].quota;
  if (quota) keep_free(gauge_box(film_));
  const OverlaySheet sheet = {pen, camera, tile.width, tile.height, picture_scale(film_.height), room};
  if (tiles_.size() > 1) {
    const std::string& name = view == 0 ? film_.camera_name : film_.beside[view - 1].name;
    if (!name.empty()) plate(sheet, {0, 0}, name, 1e9);
  }
  for (std::size_t part = 0; film_.trails && part < film_.parts.size(); ++part)
    if (film_.parts[part].tip) draw_trail(sheet, film_, part, frame);
  const auto draw_all = [&](DrawnCallout::Kind kind, auto&& draw_one) {
    std::vector<Marked> marked;
    for (const DrawnCallout& callout : film_.frames[frame].callouts) {
      if (callout.kind != kind) continue;
      if (auto one = draw_one(callout)) marked.push_back(std::move(*one));
    }
    return marked;
  };
  const auto lengths =
      draw_all(DrawnCallout::Kind::length, [&](const DrawnCallout& one) { return draw_length(sheet, one); });
  const auto forces = draw_all(DrawnCallout::Kind::force,
                               [&](const DrawnCallout& one) { return draw_force(sheet, one, largest_); });
  const auto speeds = draw_all(DrawnCallout::Kind::speed,
                               [&](const DrawnCallout& one) { return draw_speed(sheet, one, fastest_); });
  if (quota && sheet.before_eye(quota->left) && sheet.before_eye(quota->right)) {
    const Marked one = draw_quota(sheet, *quota);
    plate(sheet, one.at, one.words, one.length);
  }
  // A force lasts a moment: its words have the first choice.
  for (const auto* marked : {&forces, &speeds, &lengths})
    for (const Marked& one : *marked) plate(sheet, one.at, one.words, one.length);
}

}  // namespace drycut::renders
