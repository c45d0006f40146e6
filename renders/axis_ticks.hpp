#pragma once
#include <string>
#include <vector>

namespace drycut::renders {

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
