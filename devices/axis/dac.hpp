#pragma once
#include <cstdint>

#include "devices/cards.hpp"

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

/// DAC bits of `tenths` of a volt (parameter vout).
inline double dac_bits_of_tenths(std::int32_t tenths) {
  return tenths * (dac_full_scale / (10.0 * dac_full_scale_volts));
}

}  // namespace drycut::devices::axis
