#pragma once
#include <cstddef>
#include <vector>

#include "renders/plots.hpp"

namespace drycut::renders {

/// Points of a curve [units of its axes]; a point with a number that is not finite is a gap in the line.
struct Points {
  std::vector<double> x;
  std::vector<double> y;
};

/// The pixels that a curve is drawn on, and the range of each axis that they show.
struct PixelGrid {
  double x_low = 0, x_high = 1;
  double y_low = 0, y_high = 1;
  int columns = 1;
  int rows = 1;
};

/// What is left of a curve so that it looks the same. Lines and steps: of consecutive samples within one
/// pixel column the first, lowest, highest and last, so at most four a column for a curve that runs from left
/// to right. Points: one a pixel. Gaps stay gaps.
Points decimated(const Curve& curve, const PixelGrid& grid);

/// What is left of a path in a plane, which may run any way: a point that is less than half a pixel from the
/// last one kept is left out, the last of a stretch stays. Gaps stay gaps.
Points thinned_path(const Curve& curve, const PixelGrid& grid);

}  // namespace drycut::renders
