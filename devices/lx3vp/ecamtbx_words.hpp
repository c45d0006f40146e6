#pragma once
#include <span>
#include <string_view>

#include "devices/lx3vp/block.hpp"

namespace drycut::devices::lx3vp {

// The parameter lists of ECAMTBX, word by word (003 appendix): one table for what reads the registers, for
// the texts of its errors, for `drycut devices ECAMTBX` and for the tests.

/// A parameter in the list from S0 on.
struct EcamtbxWord {
  int offset = 0;
  int words = 1;
  std::string_view number;  ///< the manual's: "P1"
  std::string_view type;    ///< "i32", "f32", "u16", "i16"
  std::string_view unit;    ///< "pulses", "Hz", "ms", "100 us"; "" = none
  std::string_view range;   ///< "" = it is written by ECAMTBX
  std::string_view meaning;
};
/// Of K100 (rotary saw) and K101 (flying saw).
std::span<const EcamtbxWord> saw_words();
/// Of K0 and K1 (S-curves).
std::span<const EcamtbxWord> s_curve_words();
/// Where the manual is silent or contradicts itself.
std::span<const Reading> ecamtbx_readings();

// Offsets, by the manual's numbers.
namespace saw_word {
inline constexpr int master_length = 0;
inline constexpr int slave_length = 2;
inline constexpr int sync_length = 4;
inline constexpr int sync_ratio = 6;
inline constexpr int max_ratio = 8;
inline constexpr int acceleration = 10;
inline constexpr int curve = 11;
inline constexpr int resolution = 12;
}  // namespace saw_word

namespace s_curve_word {
inline constexpr int length = 0;
inline constexpr int top_speed = 2;
inline constexpr int acceleration = 6;
inline constexpr int deceleration = 7;
inline constexpr int resolution = 8;
inline constexpr int last_master = 10;
inline constexpr int last_slave = 12;
inline constexpr int uniform_time = 14;
inline constexpr int speed_reached = 16;
inline constexpr int result = 19;
}  // namespace s_curve_word

}  // namespace drycut::devices::lx3vp
