#pragma once
#include <vector>

#include "plants/torque_filters.hpp"
#include "sim/studies/bode/response.hpp"
#include "sim/studies/bode/speed_loop.hpp"

namespace drycut::sim::studies {

// Which filter the torque of a servo wants, from its speed loop as measured.

/// What a loop may be given: the largest gain with a sensitivity |1 / (1 + L)| of at most 2, which has 6 dB
/// of gain margin up and down and 29 deg of phase margin at least.
inline constexpr double kept_sensitivity = 2;
/// What a filter may cost at the gain in force, and how much more gain is looked for at most.
inline constexpr double most_cost = 10;  // [deg]
inline constexpr double largest_factor = 30;
/// From here on nobody needs a filter.
inline constexpr double ample_factor = 4;

/// One choice of filters.
struct FilterChoice {
  plants::TorqueFilterData filters;
  Margins margins;  ///< at the gain in force
  /// With filters up to 5 % beside their places.
  double factor = 0;  ///< of the gain in force: the largest that keeps the sensitivity
};

struct FilterAdvice {
  SpeedLoop loop;
  FilterChoice present;
  std::vector<FilterChoice> choices;  ///< the best of each kind, best first: notch, low-pass, both notches
  /// The first choice gains more than 1 dB of speed gain.
  [[nodiscard]] bool worth() const;
};

/// The loop with other filters, margins and largest factor.
FilterChoice judged_with(const SpeedLoop& loop, const plants::TorqueFilterData& filters);
/// The best low-pass, the best notch and the best second notch beside that one, by the largest factor.
FilterAdvice advise(SpeedLoop loop);

}  // namespace drycut::sim::studies
