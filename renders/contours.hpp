#pragma once
#include <utility>
#include <vector>

namespace drycut::renders {

/// Points of a line, from its beginning to its end; a closed one ends where it begins.
using Polyline = std::vector<std::pair<double, double>>;

/// Where `values` are `level`: lines over a grid, straight between two of its edges. `values` has a row for
/// each y, each with a number for each x; x and y ascending. No line where one of a cell's corners is not
/// finite. In a saddle the middle of the cell decides.
std::vector<Polyline> contours(const std::vector<double>& x, const std::vector<double>& y,
                               const std::vector<double>& values, double level);

}  // namespace drycut::renders
