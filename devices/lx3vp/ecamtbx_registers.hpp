#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "devices/lx3vp/ecamtbx.hpp"
#include "devices/lx3vp/registers.hpp"

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
std::span<const BlockReading> ecamtbx_readings();

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

/// Words of a parameter list, and of a cam's block before its rows (003 5, appendix).
inline constexpr int ecamtbx_parameters = 20;
inline constexpr int cam_block_words = 40;

/// The lists at D`first`, 32-bit values and floats low word first.
SawParameters read_saw_parameters(const Registers& registers, int first);
SCurveParameters read_s_curve_parameters(const Registers& registers, int first);

/// What an ECAMTBX came to.
struct EcamtbxReport {
  std::int32_t code = 0;  ///< D1: the number of rows, or the error
  std::string fault;      ///< in words; empty if a table was made
};

/// ECAMTBX S0 S1 D0 D1: makes the table of type `type` from the list at D`list` and writes it to the cam's
/// block at D`block`: the rows from word 40 on, their number in word 38, 40 in word 39; with word 4 bit 0
/// (sync output enabled) a saw's synchronous zone in words 9 to 12. The result goes to D`result` as 32 bit,
/// its low word alone tells it too. With an error the block is left as it is. K0 and K1 report in
/// words 10..17 and 19 of their list.
///
/// A cam by midCAMend stops by itself at its end (003 appendix, rotary saw, P6), which the manual gives no
/// word for: word 31 tells DECAM, and is 0 with the table of another curve. Words of the block that nothing
/// has written get their initial values.
EcamtbxReport run_ecamtbx(Registers& registers, int list, std::int32_t type, int block, int result);

/// Why the list at D`list` makes no table of type `type`, with its numbers: "P3 (D504) is 9400: ...".
std::string ecamtbx_fault(const Registers& registers, int list, std::int32_t type, EcamError error);

}  // namespace drycut::devices::lx3vp
