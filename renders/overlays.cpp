#include "renders/overlays.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "renders/cairo_image.hpp"
#include "renders/camera.hpp"
#include "renders/geometry.hpp"

namespace drycut::renders {
namespace {

constexpr std::size_t kTrailFrames = 12;
constexpr int kBetween = 8;             ///< points of a trail from frame to frame
constexpr double kLongestArrow = 0.18;  ///< of the picture's height, for the film's largest force
constexpr double kShortestArrow = 0.04;

using Point = std::array<double, 2>;  // pixels

/// What every mark on the picture needs to know.
struct Sheet {
  cairo_t* pen;
  const Camera& camera;
  int width;
  int height;
  double scale;  ///< 1 for a film 540 pixels high

  Point at(const Vec3& point) const { return projected(camera, width, height, point); }
  bool before_eye(const Vec3& point) const {
    return (point - camera.eye).dot(camera.target - camera.eye) > 0;
  }
};

/// Words on a dark plate, their middle at `at`, moved into the picture if they stick out.
void plate(const Sheet& sheet, Point at, const std::string& words) {
  const double size = 12 * sheet.scale;
  cairo_set_font_size(sheet.pen, size);
  const double half = text_width(sheet.pen, words) / 2 + 0.4 * size;
  const double high = 0.75 * size;
  if (at[0] < -half || at[0] > sheet.width + half || at[1] < -high || at[1] > sheet.height + high) return;
  at[0] = std::clamp(at[0], half, std::max(half, sheet.width - half));
  at[1] = std::clamp(at[1], high, std::max(high, sheet.height - high));
  set_ink(sheet.pen, kGround, 0.85);
  fill_box(sheet.pen, at[0] - half, at[1] - high, 2 * half, 2 * high);
  cairo_set_source_rgb(sheet.pen, 1, 1, 1);
  write_text(sheet.pen, at[0] - half + 0.4 * size, at[1] + 0.36 * size, words);
}

/// A line with a dark border, so that it shows on bright and dark parts alike.
void stroke(const Sheet& sheet, double red, double green, double blue) {
  cairo_set_line_cap(sheet.pen, CAIRO_LINE_CAP_ROUND);
  cairo_set_source_rgba(sheet.pen, 0.05, 0.06, 0.08, 0.8);
  cairo_set_line_width(sheet.pen, 4.5 * sheet.scale);
  cairo_stroke_preserve(sheet.pen);
  cairo_set_source_rgb(sheet.pen, red, green, blue);
  cairo_set_line_width(sheet.pen, 2.2 * sheet.scale);
  cairo_stroke(sheet.pen);
}

void line(const Sheet& sheet, const Point& from, const Point& to) {
  cairo_move_to(sheet.pen, from[0], from[1]);
  cairo_line_to(sheet.pen, to[0], to[1]);
}

/// A line between the two ends with a stroke up and down at each, which is where it was cut.
void draw_length(const Sheet& sheet, const Callout& callout) {
  if (!sheet.before_eye(callout.at) || !sheet.before_eye(callout.to)) return;
  const Point from = sheet.at(callout.at);
  const Point to = sheet.at(callout.to);
  const double tick = 8 * sheet.scale;
  line(sheet, from, to);
  for (const Point& end : {from, to}) line(sheet, {end[0], end[1] - tick}, {end[0], end[1] + tick});
  stroke(sheet, 1, 1, 1);
  plate(sheet, {(from[0] + to[0]) / 2, (from[1] + to[1]) / 2}, callout.text);
}

void draw_force(const Sheet& sheet, const Callout& callout, double largest) {
  const double force = callout.to.norm();
  if (force < 1e-3 * largest || !sheet.before_eye(callout.at)) return;
  const double reach = (callout.at - sheet.camera.eye).norm();
  const Point from = sheet.at(callout.at);
  const Point ahead = sheet.at(callout.at + (0.02 * reach / force) * callout.to);
  const double way = std::hypot(ahead[0] - from[0], ahead[1] - from[1]);
  if (way < 1e-6) return;
  const Point unit = {(ahead[0] - from[0]) / way, (ahead[1] - from[1]) / way};
  const double long_ =
      sheet.height * (kShortestArrow + (kLongestArrow - kShortestArrow) * std::sqrt(force / largest));
  const Point to = {from[0] + long_ * unit[0], from[1] + long_ * unit[1]};
  const double head = 9 * sheet.scale;
  line(sheet, from, to);
  for (const double side : {-0.6, 0.6})
    line(sheet, {to[0] - head * (unit[0] + side * unit[1]), to[1] - head * (unit[1] - side * unit[0])}, to);
  stroke(sheet, 1.0, 0.25, 0.18);
  plate(sheet, {to[0] + 22 * sheet.scale * unit[0], to[1] + 14 * sheet.scale * unit[1]},
        fmt::format("{} {:.0f} N", callout.text, force));
}

/// A smooth curve (Catmull-Rom) from `b` to `c` that comes from `a` and goes on to `d`: frames show a drum
/// only every few dozen degrees.
Vec3 between(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, double t) {
  const Vec3 bend = 2.0 * a - 5.0 * b + 4.0 * c - d;
  const Vec3 twist = 3.0 * (b - c) + d - a;
  return b + (t / 2) * ((c - a) + t * (bend + t * twist));
}

/// Where the tip of a part was in the last frames; older is fainter.
void draw_trail(const Sheet& sheet, const Film& film, std::size_t part, std::size_t frame) {
  const std::size_t first = frame - std::min(frame, kTrailFrames);
  cairo_set_line_width(sheet.pen, 2.5 * sheet.scale);
  cairo_set_line_cap(sheet.pen, CAIRO_LINE_CAP_ROUND);
  for (std::size_t f = first; f < frame; ++f) {
    const auto tip = [&](std::size_t at) {
      return placed(film.frames[at].placements[part], *film.parts[part].tip);
    };
    if (!film.frames[f].placements[part].visible || !film.frames[f + 1].placements[part].visible) continue;
    const Vec3 from = tip(f);
    const Vec3 to = tip(f + 1);
    const Vec3 before = f > first ? tip(f - 1) : from;
    const Vec3 after = f + 1 < frame ? tip(f + 2) : to;
    bool seen = true;
    for (int i = 0; i <= kBetween; ++i) {
      const Vec3 point = between(before, from, to, after, static_cast<double>(i) / kBetween);
      seen = seen && sheet.before_eye(point);
      const Point at = sheet.at(point);
      cairo_line_to(sheet.pen, at[0], at[1]);
    }
    const double age = static_cast<double>(frame - f) / (kTrailFrames + 1);
    cairo_set_source_rgba(sheet.pen, 0.0, 0.85, 0.95, seen ? 0.9 * (1 - age) : 0.0);
    cairo_stroke(sheet.pen);
  }
}

}  // namespace

Overlays::Overlays(const Film& film, int caption_height)
    : film_(film),
      live_(film),
      height_(film.height - caption_height),
      empty_(!film.trails && film.live.empty()) {
  for (const Frame& frame : film.frames) {
    empty_ = empty_ && frame.callouts.empty();
    for (const Callout& callout : frame.callouts)
      if (callout.kind == Callout::Kind::force) largest_ = std::max(largest_, callout.to.norm());
  }
}

void Overlays::draw(std::size_t frame, Image& image) const {
  if (empty_) return;
  const CairoSurface surface = cairo_surface_of(image, height_);
  const Cairo pen = cairo_pen(surface.get());
  const Camera camera = camera_of(film_, frame);
  const Sheet sheet = {pen.get(), camera, film_.width, height_, picture_scale(film_.height)};
  for (std::size_t part = 0; film_.trails && part < film_.parts.size(); ++part)
    if (film_.parts[part].tip) draw_trail(sheet, film_, part, frame);
  for (const Callout& callout : film_.frames[frame].callouts)
    if (callout.kind == Callout::Kind::length) draw_length(sheet, callout);
  for (const Callout& callout : film_.frames[frame].callouts)
    if (callout.kind == Callout::Kind::force) draw_force(sheet, callout, largest_);
  live_.draw(pen.get(), film_.frames[frame].time_s, height_);
  copy_rows(surface.get(), height_, image, 0);
}

}  // namespace drycut::renders
