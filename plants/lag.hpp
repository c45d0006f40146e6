#pragma once
#include <cmath>

namespace drycut::plants {

/// How much of a change a lag of first order follows in a step of `h` seconds; all of it without a lag.
[[nodiscard]] inline double share_of(double lag, double h) { return lag > 0 ? -std::expm1(-h / lag) : 1; }

}  // namespace drycut::plants
