#pragma once
#include <cstdint>
#include <string_view>

#include "devices/cards.hpp"
#include "devices/turn.hpp"

namespace drycut::devices::axis {

/// A DAC word and whether the value asked for was beyond full scale: +1 above +10 V, -1 below -10 V.
struct DacOutput {
  std::int16_t word = 0;
  int saturated = 0;
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
    return turn_.take(dac.driver);
  }
  /// Leaves the DAC, as it stands, to the others.
  void release(AnalogueOutput& dac) { turn_.release(dac.driver); }

 private:
  Turn turn_;
};

/// What a device says when DacTurn::put finds another one on its DAC.
inline constexpr std::string_view shared_dac_text =
    "another device regulates on the same analogue output; of devices that share one, all but one need "
    "REGOFF";

/// DAC bits of `tenths` of a volt (parameter vout).
inline double dac_bits_of_tenths(std::int32_t tenths) {
  return tenths * (dac_full_scale / (10.0 * dac_full_scale_volts));
}

}  // namespace drycut::devices::axis
