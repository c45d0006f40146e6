#include "renders/plot_area.hpp"

#include <algorithm>
#include <cmath>

namespace drycut::renders {
namespace {

/// Far outside of every picture, and still a number that cairo can hold.
constexpr double kFarthest = 1e6;

double share(double value, const Range& range) {
  return (value - range.first) / (range.second - range.first);
}

}  // namespace

double PlotArea::x(double value) const {
  return std::clamp(left + share(value, x_range) * (right - left), -kFarthest, kFarthest);
}

double PlotArea::y(double value) const {
  return std::clamp(bottom - share(value, y_range) * (bottom - top), -kFarthest, kFarthest);
}

void trace(cairo_t* pen, const PlotArea& area, std::span<const double> x, std::span<const double> y,
           bool steps) {
  cairo_new_path(pen);  // words leave the pen where they end
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!std::isfinite(y[i])) {
      cairo_new_sub_path(pen);
      continue;
    }
    if (steps && i > 0 && std::isfinite(y[i - 1])) cairo_line_to(pen, area.x(x[i]), area.y(y[i - 1]));
    cairo_line_to(pen, area.x(x[i]), area.y(y[i]));
  }
}

}  // namespace drycut::renders
