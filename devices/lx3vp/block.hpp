#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "devices/lx3vp/registers.hpp"

namespace drycut::devices::lx3vp {

// What the manual lists: the words and flags of DECAM's parameter block and the special registers. One table
// for the engine, which takes its offsets from here, for `drycut devices DECAM` and for the tests, which walk
// it.

/// Words of the parameter block from S2 on (003 5).
struct BlockWord {
  enum class Access : std::uint8_t { read, write, reserved };  ///< as the program sees it
  int offset = 0;
  int words = 1;
  std::string_view name;
  std::string_view type;    ///< "flags", "u16", "i32", "u32"
  std::string_view range;   ///< "" = the type's
  std::int64_t set_up = 0;  ///< the manual's initial value; see `take_initial_values`
  Access access = Access::write;
  std::string_view taken;  ///< when the cam reads it: "start", "always"; "" = it writes it
  std::string_view meaning;
};
std::span<const BlockWord> block_words();

/// Bits of the flag words 1, 3 and 4.
struct BlockFlag {
  int word = 0;
  int bit = 0;
  std::string_view name;
  std::string_view access;  ///< "read", "reset" = the program may clear it, "write"
  std::string_view meaning;
};
std::span<const BlockFlag> block_flags();

/// D8nnn and M8nnn that the simulated PLC serves.
struct SpecialRegister {
  std::string_view name;    ///< "D8140" (32 bit: with the word behind it), "M8145"
  std::string_view type;    ///< "i32", "i16", "u16", "bit"
  std::string_view access;  ///< "read", "write"
  std::string_view meaning;
  int count = 1;  ///< of a row of relays: so many, each for the counter after the one before
};
std::span<const SpecialRegister> special_registers();
/// Whether the simulated PLC serves D or M `number`: all below D8000 and M8000, of the others those above.
bool is_served(char letter, int number);
/// "M8000 to M8004, M8011 to M8014, ...": all of D or M that it serves from 8000 on.
std::string served_specials(char letter);

/// A place where the manual is silent or contradicts itself, and what is done here.
struct Reading {
  std::string_view where;  ///< "word 4", "status bit 6"
  std::string_view text;
};
std::span<const Reading> block_readings();

/// Gives the words of the block at D`block` that nothing has written the manual's initial values (003 5).
/// What it gave and where, in words; "" if all of them were written.
std::string take_initial_values(Registers& registers, int block);

// Offsets, by the table's names.
namespace word {
inline constexpr int version = 0;
inline constexpr int status = 1;
inline constexpr int error = 2;
inline constexpr int function = 3;
inline constexpr int live = 4;
inline constexpr int start = 5;
inline constexpr int max_frequency = 6;
inline constexpr int sync_output = 8;
inline constexpr int sync_low = 9;
inline constexpr int sync_high = 11;
inline constexpr int repeats = 14;
inline constexpr int delay = 15;
inline constexpr int start_position = 17;
inline constexpr int slave_pulses = 19;
inline constexpr int slave_position = 21;
inline constexpr int slave_denominator = 23;
inline constexpr int slave_numerator = 24;
inline constexpr int master_position = 25;
inline constexpr int master_counts = 27;
inline constexpr int master_denominator = 29;
inline constexpr int master_numerator = 30;
inline constexpr int own_stop = 31;
inline constexpr int rows = 38;
inline constexpr int table_offset = 39;
inline constexpr int table = 40;
}  // namespace word

namespace status {
inline constexpr unsigned initialised = 1U << 0U;
inline constexpr unsigned completed = 1U << 1U;
inline constexpr unsigned delayed = 1U << 2U;
inline constexpr unsigned stopped = 1U << 3U;
inline constexpr unsigned parameter_error = 1U << 4U;
inline constexpr unsigned table_error = 1U << 5U;
inline constexpr unsigned cyclic = 1U << 6U;
inline constexpr unsigned non_cyclic = 1U << 7U;
inline constexpr unsigned cycle_completed = 1U << 9U;
inline constexpr unsigned in_window = 1U << 10U;
inline constexpr unsigned time_axis = 1U << 11U;
}  // namespace status

namespace function {
inline constexpr unsigned delayed_start = 1U << 0U;
inline constexpr unsigned start_position = 1U << 1U;
inline constexpr unsigned master_zoom = 1U << 2U;
inline constexpr unsigned slave_zoom = 1U << 3U;
inline constexpr unsigned external_start = 1U << 5U;
inline constexpr unsigned resume = 1U << 6U;
}  // namespace function

namespace live {
inline constexpr unsigned sync_output = 1U << 0U;
inline constexpr unsigned stop_after_cycle = 1U << 1U;
}  // namespace live

inline constexpr int block_length = 40;  ///< words before the table
inline constexpr int row_words = 4;      ///< of the table: master and slave, 32 bit each
inline constexpr int min_rows = 2;
inline constexpr int max_rows = 512;
inline constexpr int last_block_word = 7999;  ///< a block with its table lies below the special registers
inline constexpr std::int32_t max_frequency_hz = 200'000;

}  // namespace drycut::devices::lx3vp
