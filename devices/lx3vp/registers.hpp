#pragma once
#include <array>
#include <bitset>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "devices/value_range.hpp"

namespace drycut {
class StateArchive;
}

namespace drycut::devices::lx3vp {

// The registers of the PLC: what programs, the cams and a panel on its port share. Numbers of X and Y are
// octal in text (X7 is followed by X10) and plain in code: X10 is x[8].

inline constexpr int data_words = 8256;               ///< D0..D8255; D8000 and above are special
inline constexpr int relays = 8256;                   ///< M0..M3071 and M8000..M8255
inline constexpr int last_relay = 3071;               ///< of the ordinary ones
inline constexpr int first_special = 8000;            ///< of D and M
inline constexpr int terminals = 256;                 ///< X0..X377 and Y0..Y377
inline constexpr int states = 1000;                   ///< S0..S999
inline constexpr int pulse_outputs = 4;               ///< Y0..Y3
inline constexpr int timers = 256;                    ///< T0..T255
inline constexpr int counters = 256;                  ///< C0..C255
inline constexpr int index_registers = 8;             ///< V0..V7 and Z0..Z7
inline constexpr int first_wide_counter = 200;        ///< C200..C255 count 32 bit
inline constexpr int first_high_speed_counter = 235;  ///< C235..C255 count pulses of terminals by themselves;
                                                      ///< C200..C234 where they are wired
inline constexpr int first_two_way_counter = 246;  ///< C246..C255 count both ways; those below as M82nn says

// What keeps its value without power; the rest is 0 after power-up. The seed manual gives no ranges: these
// are the FX ones, and they stand in one place.
struct RetentiveRange {
  char letter;
  int first;
  int end;  ///< the last and one more
};
inline constexpr int first_retentive_timer = 246;
inline constexpr RetentiveRange retentive_ranges[] = {{'D', 200, first_special},
                                                      {'M', 500, first_special},
                                                      {'S', 500, states},
                                                      {'T', first_retentive_timer, timers},
                                                      {'C', 100, first_wide_counter},
                                                      {'C', 220, counters}};
/// Whether a device is one of them.
constexpr bool is_retentive(char letter, int number) {
  for (const auto& range : retentive_ranges)
    if (range.letter == letter && number >= range.first && number < range.end) return true;
  return false;
}

struct Timer {
  std::uint16_t value = 0;
  bool coil = false;
  bool contact = false;
  void visit(StateArchive& archive);
};
struct PlcCounter {
  std::int32_t value = 0;  ///< -32768..32767 below C200
  bool coil = false;
  bool contact = false;
  void visit(StateArchive& archive);
};

/// Unit of a timer's value: 100 ms, 10 ms (T200..T245) or 1 ms (T246..T249) [ns].
constexpr std::int64_t timer_unit_ns(int number) {
  constexpr std::int64_t ms = 1'000'000;
  if (number >= 246 && number <= 249) return ms;
  return number >= 200 && number <= 245 ? 10 * ms : 100 * ms;
}
/// True for timers that stand still while their coil is off and go on later, until RST.
constexpr bool keeps_time(int number) { return number >= first_retentive_timer; }

/// All registers. 32-bit values and floats take two words, the low word first (003 3, 5).
struct Registers {
  std::array<std::uint16_t, data_words> d{};
  std::array<bool, relays> m{};
  std::array<bool, terminals> x{};  ///< image of the inputs, taken at the start of a scan
  std::array<bool, terminals> y{};  ///< image of the outputs, given at its end
  std::array<bool, states> s{};
  std::array<Timer, timers> t{};
  std::array<PlcCounter, counters> c{};
  std::array<std::uint16_t, index_registers> v{};  ///< V0..V7; of a 32-bit index the upper word
  std::array<std::uint16_t, index_registers> z{};  ///< Z0..Z7
  std::int64_t time_ns = 0;  ///< since power-up, at the start of the scan: what timers run by
  /// Since the start of the simulation, likewise; with the offset that TWR has set it is the time of the
  /// clock, which goes on without power, since 2000-01-01 0:00:00.
  std::int64_t now_ns = 0;
  std::int64_t clock_offset_s = 0;
  /// Counters that count pulses of terminals by themselves: C235..C255, and of C200..C234 those that are
  /// wired (003 4.1.3 takes C231).
  std::bitset<counters> counts_pulses = ~std::bitset<counters>() << first_high_speed_counter;
  /// Words of D that a program, a file or a scenario has written, be it 0 (003 5: the others have their
  /// initial values).
  std::bitset<data_words> written;

  void visit(StateArchive& archive);

  // Accessors of D; a 32-bit value's second word is index + 1.
  [[nodiscard]] std::int16_t i16(int index) const {
    return static_cast<std::int16_t>(d[static_cast<std::size_t>(index)]);
  }
  [[nodiscard]] std::uint32_t u32(int index) const {
    return static_cast<std::uint32_t>(d[static_cast<std::size_t>(index)]) |
           static_cast<std::uint32_t>(d[static_cast<std::size_t>(index) + 1]) << 16U;
  }
  [[nodiscard]] std::int32_t i32(int index) const { return static_cast<std::int32_t>(u32(index)); }
  [[nodiscard]] float f32(int index) const;
  /// Writes a word and notes that it was written.
  void put(int index, std::uint16_t value) {
    d[static_cast<std::size_t>(index)] = value;
    written.set(static_cast<std::size_t>(index));
  }
  void set_i16(int index, std::int16_t value) { put(index, static_cast<std::uint16_t>(value)); }
  void set_u32(int index, std::uint32_t value) {
    put(index, static_cast<std::uint16_t>(value));
    put(index + 1, static_cast<std::uint16_t>(value >> 16U));
  }
  void set_i32(int index, std::int32_t value) { set_u32(index, static_cast<std::uint32_t>(value)); }
  void set_f32(int index, float value);
};

/// The clock in words, as TRD gives them: year (two digits: 80 to 99 are of the last century), month, day,
/// hour, minute, second, weekday (0 is Sunday).
using ClockWords = std::array<int, 7>;
ClockWords clock_of(const Registers& registers);
/// Its second, 0 to 59: tells cheaply whether it has gone on.
int clock_second(const Registers& registers);
/// Sets it; false, and nothing changed, if there is no such time. The weekday is not looked at.
bool set_clock(Registers& registers, const ClockWords& words);
inline constexpr int first_clock_word = 8013;
inline constexpr int last_clock_word = 8019;
/// Writes it to D8013..D8019.
void show_clock(Registers& registers);

/// A bit by its device's letter: X, Y, M, S, or the contact of T and C.
inline const bool* bit_at(const Registers& registers, char letter, int number) {
  const auto at = static_cast<std::size_t>(number);
  switch (letter) {
    case 'X':
      return &registers.x[at];
    case 'Y':
      return &registers.y[at];
    case 'M':
      return &registers.m[at];
    case 'S':
      return &registers.s[at];
    case 'T':
      return &registers.t[at].contact;
    default:
      return &registers.c[at].contact;
  }
}
inline bool* bit_at(Registers& registers, char letter, int number) {
  return const_cast<bool*>(bit_at(std::as_const(registers), letter, number));
}

/// A value by its name in scenarios, recordings and register files: `D10` signed word, `DD10` (also `D10:L`)
/// signed 32 bit of D10 and D11, `FD10` (also `D10:F`) float of both, `D10.A` bit 10 of D10 (hexadecimal),
/// `M0`, `S0`, `X10` and `Y10` (octal) 0 or 1, `T0` and `C0` values, `TS0` and `CS0` contacts, `V0` and `Z0`
/// the index registers. Any case.
struct RegisterName {
  enum class Kind : std::uint8_t {
    word,
    wide,
    real,
    bit,
    m,
    s,
    x,
    y,
    timer,
    timer_contact,
    counter,
    counter_contact,
    v,
    z
  };
  Kind kind = Kind::word;
  int number = 0;  ///< plain, of X and Y too
  int bit = 0;     ///< 0..15 of Kind::bit
  bool operator==(const RegisterName&) const = default;
};
/// As much of a text as a message shows, without what a terminal would take for a command.
std::string shown(std::string_view text);
/// Nullopt if `text` names no register of the LX3VP.
std::optional<RegisterName> parse_register(std::string_view text);
/// The letter of its device.
char letter_of(const RegisterName& name);
/// Whether the simulated PLC serves it: of the special ones not all (block.hpp).
bool is_served(const RegisterName& name);
/// In the first of the spellings above.
std::string to_string(const RegisterName& name);

/// The value behind a name.
double read(const Registers& registers, const RegisterName& name);
/// What `write` takes without changing the value: -32768..65535 of a word, and so on.
ValueRange range_of(const RegisterName& name);
/// Stores `value`, rounded to a whole number where the register holds one and limited to `range_of`.
void write(Registers& registers, const RegisterName& name, double value);

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
/// The row of D or M `number`; nullptr of those below D8000 and M8000, and of what is not served.
const SpecialRegister* special_register(char letter, int number);
/// Whether the simulated PLC serves D or M `number`: all below D8000 and M8000, of the others those above.
bool is_served(char letter, int number);
/// D8000 [ms], what it has at power-up, and the error (D8061) of a scan that works longer.
inline constexpr int watchdog_register = 8000;
inline constexpr std::uint16_t default_watchdog_ms = 200;
inline constexpr std::uint16_t watchdog_error = 6105;
/// "M8000 to M8004, M8011 to M8014, ...": all of D or M that it serves from 8000 on.
std::string served_specials(char letter);

/// A place where the manual is silent or contradicts itself, and what is done here.
struct BlockReading {
  std::string_view where;  ///< "word 4", "status bit 6"
  std::string_view text;
};
std::span<const BlockReading> block_readings();

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
