#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "plants/torque_filters.hpp"
#include "sim/studies/bode/loop.hpp"

namespace drycut::sim::studies {

// The speed loop of a servo, measured where the drive itself could: a sine of torque is added between the
// loop and the motor, one frequency after the other, with the loop closed. A filter of the torque stands in
// that very place, so that the loop with another one follows from what was measured.

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

/// Amplitude of the sine, over the rated torque.
inline constexpr double test_share = 0.05;

/// Frequencies at least, and if nothing is asked for: a resonance has some in its width.
inline constexpr int least_speed_points = 360;

/// What of the request's range and points does not fit the scenario's steps.
void check_speed_range(const scenario::Scenario& scenario, const LoopRequest& request, Problems& problems);

/// Measures the speed loop of the drive that --wire names, or of the only servo, from `request`'s time on,
/// at its points from its lowest frequency, absent = 2 Hz, to its highest, absent = a quarter of the steps'
/// frequency. The sine is always the same. nullopt and problems if the request does not fit.
std::optional<SpeedLoop> measure_speed_loop(const scenario::Scenario& scenario, const LoopRequest& request,
                                            Problems& problems,
                                            const std::function<void(double)>& progress = {});

/// What it would be with other filters.
std::vector<BodePoint> points_with(const SpeedLoop& loop, const plants::TorqueFilterData& filters);

}  // namespace drycut::sim::studies
