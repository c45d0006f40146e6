#pragma once
#include <algorithm>
#include <cstdint>

#include "devices/cards.hpp"

namespace drycut::devices::axis {

/// Gains of the PID with feed-forward (000 1.1.12).
struct Gains {
  std::int32_t pgain = 0;   ///< [1/1000]
  std::int32_t feedfw = 0;  ///< [1/1000]
  std::int32_t integt = 0;  ///< [ms], smaller is stronger, 0 = off
  std::int32_t derivt = 0;  ///< [ms], larger is stronger, 0 = off
};

/// The scale that the gains refer to.
struct RegulatorScale {
  double max_speed = 0;           ///< bits x4 per second at full scale; 0 or less: no action at all
  double period_s = 0;            ///< TCamp
  double limit = dac_full_scale;  ///< of the integral and the derivative term [DAC bits]
};

/// The four actions [DAC bits].
struct Actions {
  double feed_forward = 0;
  double proportional = 0;
  double integral = 0;
  double derivative = 0;
  [[nodiscard]] double sum() const { return feed_forward + proportional + integral + derivative; }
};

/// The regulator of spec 5.2. Its unit of error is the way at full speed in one period: an error of that
/// size at pgain 1000 asks for full scale.
class Regulator {
 public:
  /// Forgets the integral and takes `error` as where the derivative starts.
  void reset(double error = 0) {
    integral_ = 0;
    last_error_ = error;
  }
  /// One period in reaction: theoretical speed [bits x4/s], error = theoretical - actual [bits x4].
  Actions react(const Gains& gains, const RegulatorScale& scale, double speed, double error) {
    Actions actions = steer(gains, scale, speed);
    if (scale.max_speed <= 0) return actions;
    const double unit = dac_full_scale / (scale.max_speed * scale.period_s);
    const double period_ms = scale.period_s * 1000;
    actions.proportional = gains.pgain / 1000.0 * error * unit;
    if (gains.integt > 0)
      integral_ = std::clamp(integral_ + period_ms / gains.integt * error * unit, -scale.limit, scale.limit);
    else
      integral_ = 0;
    actions.integral = integral_;
    if (gains.derivt > 0)
      actions.derivative =
          std::clamp(gains.derivt / period_ms * (error - last_error_) * unit, -scale.limit, scale.limit);
    last_error_ = error;
    return actions;
  }
  /// The loop open: feed-forward only.
  static Actions steer(const Gains& gains, const RegulatorScale& scale, double speed) {
    if (scale.max_speed <= 0) return {};
    return {gains.feedfw / 1000.0 * (speed / scale.max_speed) * dac_full_scale, 0, 0, 0};
  }

 private:
  double integral_ = 0;
  double last_error_ = 0;
};

}  // namespace drycut::devices::axis
