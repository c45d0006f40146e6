#pragma once
#include <cairo.h>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace drycut::renders {

using Range = std::pair<double, double>;

/// A rectangle of a picture [pixels from the upper left corner] and the ranges that it shows.
struct PlotArea {
  double left = 0, top = 0, right = 0, bottom = 0;
  Range x_range = {0, 1};
  Range y_range = {0, 1};

  [[nodiscard]] double x(double value) const;
  [[nodiscard]] double y(double value) const;
};

/// Begins a path of the pen: lines through the points, as steps where asked for. A point with a y that is not
/// finite interrupts it.
void trace(cairo_t* pen, const PlotArea& area, std::span<const double> x, std::span<const double> y,
           bool steps = false);

/// A mark on an axis.
struct Tick {
  double value = 0;
  std::string label;
};

/// Marks at 1, 2 or 5 times a power of ten from `low` to `high` (finite, low < high), about `wanted` of them
/// (at least 1; up to a third more) and not closer than `least_step`, with just the digits that tell them
/// apart.
std::vector<Tick> axis_ticks(double low, double high, int wanted, double least_step = 0);

/// Marks of a logarithmic axis from 10^`low` to 10^`high`: at 1, 2 and 5 times the powers of ten, at the
/// powers alone where there are many. Values are logarithms, labels the numbers.
std::vector<Tick> decade_ticks(double low, double high);

}  // namespace drycut::renders
