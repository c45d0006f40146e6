#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "devices/cam/law.hpp"

namespace drycut::sim::cams {

/// Largest absolute value over pieces.
inline double peak_of(const std::vector<devices::CamPiece>& pieces, devices::CamOrder order) {
  double most = 0;
  for (const auto& piece : pieces) most = std::max(most, piece.peak(order));
  return most;
}

/// Between which positions pieces reach; there is one at least.
inline devices::CamExtremes reach_of(const std::vector<devices::CamPiece>& pieces) {
  auto reach = pieces.front().extremes(devices::CamOrder::position);
  for (const auto& piece : pieces) {
    const auto found = piece.extremes(devices::CamOrder::position);
    reach = {std::min(reach.low, found.low), std::max(reach.high, found.high)};
  }
  return reach;
}

/// The largest of a kind of finding, and how many there are.
struct CamWorst {
  int count = 0;
  double value = 0;
  int row = 0;

  void take(double size, int at) {
    ++count;
    if (std::abs(size) <= std::abs(value)) return;
    value = size;
    row = at;
  }
};

}  // namespace drycut::sim::cams
