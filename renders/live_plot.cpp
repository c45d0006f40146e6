#include "renders/live_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "renders/cairo_image.hpp"
#include "renders/text.hpp"

namespace drycut::renders {
namespace {

constexpr std::array<Ink, 2> kInks = {{{1.0, 0.72, 0.20}, {0.40, 0.85, 1.0}}};

/// Lowest and highest value, a little apart even if they are equal.
Range range_of(const LiveCurve& curve) {
  if (curve.values.empty()) return {0, 1};
  const auto [low, high] = std::minmax_element(curve.values.begin(), curve.values.end());
  const double least = std::max(1e-9, 1e-6 * std::max(std::abs(*low), std::abs(*high)));
  const double middle = (*low + *high) / 2;
  const double half = std::max(least, (*high - *low) / 2);
  return {middle - half, middle + half};
}

/// The samples between two times: the first and how many.
std::pair<std::size_t, std::size_t> window(const LiveCurve& curve, const Range& times) {
  const auto first = std::lower_bound(curve.times_s.begin(), curve.times_s.end(), times.first);
  const auto last = std::upper_bound(first, curve.times_s.end(), times.second);
  return {static_cast<std::size_t>(first - curve.times_s.begin()), static_cast<std::size_t>(last - first)};
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

Box LivePlot::box(int height) const {
  if (film_.live.empty()) return {};
  const double margin = 10 * picture_scale(film_.height);
  const double left = 0.70 * film_.width - margin;
  const double top = 0.72 * height - margin;
  return {left, top, left + 0.30 * film_.width, top + 0.28 * height};
}

void LivePlot::draw(cairo_t* pen, double now, int height) const {
  if (film_.live.empty()) return;
  const double scale = picture_scale(film_.height);
  const double margin = 10 * scale;
  const double size = 11 * scale;
  const auto [left, top, right, bottom] = box(height);
  set_ink(pen, kGround, 0.82);
  fill_box(pen, left, top, right - left, bottom - top);

  const std::size_t count = std::min(film_.live.size(), kInks.size());
  const double words = 1.5 * size * static_cast<double>(count) + 0.4 * size;
  PlotArea area = {left + margin,   top + words + 0.5 * margin,       right - margin,
                   bottom - margin, {now - film_.live_window_s, now}, {0, 1}};
  cairo_set_source_rgba(pen, 1, 1, 1, 0.22);
  cairo_set_line_width(pen, scale);
  for (const double share : {0.0, 0.5, 1.0}) {
    cairo_move_to(pen, area.left, area.y(share));
    cairo_line_to(pen, area.right, area.y(share));
  }
  cairo_stroke(pen);

  cairo_set_font_size(pen, size);
  cairo_set_line_width(pen, 1.6 * scale);
  for (std::size_t i = 0; i < count; ++i) {
    const LiveCurve& curve = film_.live[i];
    if (curve.values.empty()) continue;
    set_ink(pen, kInks[i]);
    area.y_range = ranges_[i];
    const auto [first, samples] = window(curve, area.x_range);
    trace(pen, area, {curve.times_s.data() + first, samples}, {curve.values.data() + first, samples});
    cairo_stroke(pen);
    const double baseline = top + 1.5 * size * (static_cast<double>(i) + 0.9);
    const std::string value =
        fmt::format("{:.4g}{}{}", value_at(curve, now), curve.unit.empty() ? "" : " ", curve.unit);
    const double value_width = text_width(pen, value);
    write_text(pen, area.right - value_width, baseline, value);
    const double room = area.right - area.left - value_width - size;
    write_text(pen, area.left, baseline, fitted_text(pen, one_line(curve.label), room));
  }
}

}  // namespace drycut::renders
