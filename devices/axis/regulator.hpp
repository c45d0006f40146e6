#pragma once
#include <algorithm>
#include <cstdint>
#include <string_view>

#include "devices/cards.hpp"

namespace drycut::devices::axis {

/// A DAC word and whether the value asked for was beyond full scale: +1 above +10 V, -1 below -10 V.
struct DacOutput {
  std::int16_t word = 0;
  int saturated = 0;

  void visit(StateArchive& archive);
};

/// Rounds to the nearest bit and holds at +-32767 (spec 1.8).
inline DacOutput to_dac(double bits) {
  if (!(bits < dac_full_scale + 0.5)) return {static_cast<std::int16_t>(dac_full_scale), 1};
  if (bits <= -dac_full_scale - 0.5) return {static_cast<std::int16_t>(-dac_full_scale), -1};
  return {static_cast<std::int16_t>(bits < 0 ? bits - 0.5 : bits + 0.5), 0};
}

/// A device's turn on a DAC that several devices may name.
class DacTurn {
 public:
  /// Puts a word out. True once if another device regulates on the DAC too.
  bool put(AnalogueOutput& dac, std::int16_t word) {
    dac.word = word;
    return turn_.take(dac.held);
  }
  /// Leaves the DAC, as it stands, to the others.
  void release(AnalogueOutput& dac) { turn_.release(dac.held); }
  void visit(StateArchive& archive);

 private:
  OutputTurn turn_;
};

/// What a device says when DacTurn::put finds another one on its DAC.
inline constexpr std::string_view shared_dac_text =
    "another device regulates on the same analogue output; of devices that share one, all but one need "
    "REGOFF";

/// DAC bits of `tenths` of a volt (parameter vout).
inline double dac_bits_of_tenths(std::int32_t tenths) {
  return tenths * (dac_full_scale / (10.0 * dac_full_scale_volts));
}

/// Keeps the report of a following error for 500 ms after it was last too large (st_foller, 000 1.9.6).
class FollowingErrorHold {
 public:
  static constexpr int hold_ms = 500;
  /// One sample; true while the report stands.
  bool sample(bool too_large, int period_ms) {
    if (too_large) {
      remaining_ms_ = hold_ms;
      return true;
    }
    remaining_ms_ = remaining_ms_ > period_ms ? remaining_ms_ - period_ms : 0;
    return remaining_ms_ > 0;
  }
  void visit(StateArchive& archive);

 private:
  int remaining_ms_ = 0;
};

/// Gains of the PID with feed-forward (000 1.1.12).
struct Gains {
  std::int32_t pgain = 0;   ///< [1/1000]
  std::int32_t feedfw = 0;  ///< [1/1000]
  std::int32_t integt = 0;  ///< [ms], smaller is stronger, 0 = off
  std::int32_t derivt = 0;  ///< [ms], larger is stronger, 0 = off

  void visit(StateArchive& archive);
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
  void visit(StateArchive& archive);
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
  void visit(StateArchive& archive);

 private:
  double integral_ = 0;
  double last_error_ = 0;
};

}  // namespace drycut::devices::axis
