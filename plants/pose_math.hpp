#pragma once
#include <cmath>

#include "plants/part.hpp"

namespace drycut::plants {

/// A pose turned by `angle` [rad] about z.
[[nodiscard]] inline Pose turned(double x, double y, double z, double angle) {
  return {{x, y, z}, {0, 0, std::sin(angle / 2), std::cos(angle / 2)}};
}

}  // namespace drycut::plants
