#pragma once
#include <cstdint>

namespace drycut::devices::axis {

enum class RampShape : std::uint8_t { trapezoidal, epicycloidal };

/// A change of speed in a given time. Both shapes cover the same space in the same time; the epicycloidal one
/// begins and ends without acceleration and has twice the peak (spec 5.3, 5.4; 000 1.1.7).
struct Ramp {
  double from = 0;      ///< [bits x4/s]
  double to = 0;        ///< [bits x4/s]
  double duration = 0;  ///< [s]; 0 = a step of speed
};

/// Speed at `t` seconds from the ramp's start, 0 <= t <= duration [bits x4/s].
double ramp_speed(RampShape shape, const Ramp& ramp, double t);
/// Space covered at `t` seconds [bits x4].
double ramp_space(RampShape shape, const Ramp& ramp, double t);
/// Space of the whole ramp [bits x4].
inline double ramp_space(const Ramp& ramp) { return ramp.duration * (ramp.from + ramp.to) / 2; }

}  // namespace drycut::devices::axis
