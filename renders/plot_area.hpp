#pragma once
#include <cairo.h>

#include <span>
#include <utility>

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

}  // namespace drycut::renders
