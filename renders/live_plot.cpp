#include "renders/live_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "renders/cairo_image.hpp"
#include "renders/text.hpp"

namespace drycut::renders {
namespace {

constexpr std::array<std::array<double, 3>, 2> kInks = {{{1.0, 0.72, 0.20}, {0.40, 0.85, 1.0}}};

struct Box {
  double left, top, width, height;
};

/// Lowest and highest value, a little apart even if they are equal.
std::array<double, 2> range_of(const LiveCurve& curve) {
  if (curve.values.empty()) return {0, 1};
  const auto [low, high] = std::minmax_element(curve.values.begin(), curve.values.end());
  const double least = std::max(1e-9, 1e-6 * std::max(std::abs(*low), std::abs(*high)));
  const double middle = (*low + *high) / 2;
  const double half = std::max(least, (*high - *low) / 2);
  return {middle - half, middle + half};
}

void draw_curve(cairo_t* pen, const LiveCurve& curve, const std::array<double, 2>& range, const Box& box,
                double from, double until) {
  const auto [low, high] = range;
  const auto first = std::lower_bound(curve.times_s.begin(), curve.times_s.end(), from);
  const auto last = std::upper_bound(first, curve.times_s.end(), until);
  cairo_new_path(pen);  // words leave the pen where they end
  for (auto at = first; at != last; ++at) {
    const double value = curve.values[static_cast<std::size_t>(at - curve.times_s.begin())];
    cairo_line_to(pen, box.left + box.width * (*at - from) / (until - from),
                  box.top + box.height * (1 - (value - low) / (high - low)));
  }
  cairo_stroke(pen);
}

double value_at(const LiveCurve& curve, double time) {
  const auto after = std::upper_bound(curve.times_s.begin(), curve.times_s.end(), time);
  const auto index = std::max<std::ptrdiff_t>(0, after - curve.times_s.begin() - 1);
  return curve.values[static_cast<std::size_t>(index)];
}

}  // namespace

LivePlot::LivePlot(const Film& film) : film_(film) {
  for (const LiveCurve& curve : film.live) ranges_.push_back(range_of(curve));
}

void LivePlot::draw(cairo_t* pen, double now, int height) const {
  if (film_.live.empty()) return;
  const int width = film_.width;
  const double scale = picture_scale(film_.height);
  const double margin = 10 * scale;
  const double size = 11 * scale;
  const Box frame = {0.70 * width - margin, 0.72 * height - margin, 0.30 * width, 0.28 * height};
  set_ink(pen, kGround, 0.82);
  cairo_rectangle(pen, frame.left, frame.top, frame.width, frame.height);
  cairo_fill(pen);

  const std::size_t count = std::min(film_.live.size(), kInks.size());
  const double words = 1.5 * size * static_cast<double>(count) + 0.4 * size;
  const Box box = {frame.left + margin, frame.top + words + 0.5 * margin, frame.width - 2 * margin,
                   frame.height - words - 1.5 * margin};
  cairo_set_source_rgba(pen, 1, 1, 1, 0.22);
  cairo_set_line_width(pen, scale);
  for (const double share : {0.0, 0.5, 1.0}) {
    cairo_move_to(pen, box.left, box.top + share * box.height);
    cairo_rel_line_to(pen, box.width, 0);
  }
  cairo_stroke(pen);

  cairo_set_font_size(pen, size);
  cairo_set_line_width(pen, 1.6 * scale);
  for (std::size_t i = 0; i < count; ++i) {
    const LiveCurve& curve = film_.live[i];
    if (curve.values.empty()) continue;
    cairo_set_source_rgb(pen, kInks[i][0], kInks[i][1], kInks[i][2]);
    draw_curve(pen, curve, ranges_[i], box, now - film_.live_window_s, now);
    const double baseline = frame.top + 1.5 * size * (static_cast<double>(i) + 0.9);
    const std::string value =
        fmt::format("{:.4g}{}{}", value_at(curve, now), curve.unit.empty() ? "" : " ", curve.unit);
    const double value_width = text_width(pen, value);
    cairo_move_to(pen, box.left + box.width - value_width, baseline);
    cairo_show_text(pen, value.c_str());
    cairo_move_to(pen, box.left, baseline);
    cairo_show_text(pen, fitted_text(pen, one_line(curve.label), box.width - value_width - size).c_str());
  }
}

}  // namespace drycut::renders
