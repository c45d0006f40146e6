#include "renders/axes.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cassert>
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

namespace {

constexpr double kDenser = 0.75;  ///< rather a third more ticks than wanted than half as many

/// The next of 1, 2, 5, 10 ... at or above `least`.
double round_step(double least) {
  const double decade = std::pow(10.0, std::floor(std::log10(least)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (step * decade >= least * (1 - 1e-9)) return step * decade;
  }
  return 10 * decade;
}

std::string label(double value, double step, double largest) {
  const int exponent = static_cast<int>(std::floor(std::log10(step) + 1e-9));
  if (largest >= 1e7 || largest < 1e-4) {
    const int digits = std::max(0, static_cast<int>(std::floor(std::log10(largest) + 1e-9)) - exponent);
    return value == 0 ? "0" : fmt::format("{:.{}e}", value, std::min(digits, 15));
  }
  return fmt::format("{:.{}f}", value, std::max(0, -exponent));
}

}  // namespace

std::vector<Tick> axis_ticks(double low, double high, int wanted, double least_step) {
  assert(low < high && wanted >= 1);
  const double step = round_step(std::max(kDenser * (high - low) / wanted, least_step));
  const double largest = std::max(std::abs(low), std::abs(high));
  std::vector<Tick> ticks;
  const double first = std::ceil(low / step - 1e-9);
  for (double k = first; k * step <= high + 1e-9 * step; ++k) {
    if (ticks.size() > 1000) break;  // a range too narrow for its size: steps no longer tell in a double
    const double value = k == 0 ? 0 : k * step;  // no "-0"
    ticks.push_back({value, label(value, step, largest)});
  }
  return ticks;
}

std::vector<Tick> decade_ticks(double low, double high) {
  constexpr double close = 1e-9;
  const bool all = high - low <= 6;
  std::vector<Tick> ticks;
  for (int decade = static_cast<int>(std::floor(low)); decade <= high + close; ++decade) {
    for (const double step : {1.0, 2.0, 5.0}) {
      const double value = decade + std::log10(step);
      if (value < low - close || value > high + close || (step != 1 && !all)) continue;
      ticks.push_back({value, fmt::format("{:.10g}", step * std::pow(10.0, decade))});
    }
  }
  return ticks;
}

}  // namespace drycut::renders
