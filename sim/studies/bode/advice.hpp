#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "plants/torque_filters.hpp"
#include "sim/output_folder.hpp"
#include "sim/record/verdict.hpp"
#include "sim/studies/bode/loop.hpp"

namespace drycut::sim::studies {

// Which filter the torque of a servo wants. Its speed loop is measured where the drive itself could: a sine
// of torque is added between the loop and the motor, one frequency after the other, with the loop closed. A
// filter stands in that very place, so that the loop with another one follows from what was measured.

/// A speed loop as measured, L = -asked / (asked + test signal) at every step.
struct SpeedLoop {
  std::string drive;                 ///< "knife.servo"
  double amplitude = 0;              ///< of the sine [N m]
  double step = 0;                   ///< of the scenario [s]
  double speed_gain = 0;             ///< that is set [rad/s]
  plants::TorqueFilterData filters;  ///< that are set
  std::vector<BodePoint> points;
  std::size_t lost = 0;  ///< points that are not to be trusted, which are none of them
  std::string failure;   ///< why the simulation stopped, "" if it did not
};

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
/// The best low-pass, the best notch and the best pair of notches, by the largest factor.
FilterAdvice advise(SpeedLoop loop);

/// Measures the speed loop of the drive that --wire names, or of the only servo, from `request`'s time on,
/// at 360 points or more from 2 Hz to a quarter of the steps' frequency; a sine of 5 % of rated torque.
/// nullopt and problems if the request does not fit.
std::optional<SpeedLoop> measure_speed_loop(const scenario::Scenario& scenario, const LoopRequest& request,
                                            Problems& problems,
                                            const std::function<void(double)>& progress = {});

std::string advice_text(const FilterAdvice& advice);
record::Verdict verdict_of(const FilterAdvice& advice);
void write_advice_report(const FilterAdvice& advice, const scenario::Scenario& scenario,
                         OutputFolder& folder);

}  // namespace drycut::sim::studies
