#pragma once
#include <array>
#include <bitset>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "devices/value_range.hpp"

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
};
struct PlcCounter {
  std::int32_t value = 0;  ///< -32768..32767 below C200
  bool coil = false;
  bool contact = false;
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
  /// Counters that count pulses of terminals by themselves: C235..C255, and of C200..C234 those that are
  /// wired (003 4.1.3 takes C231).
  std::bitset<counters> counts_pulses = ~std::bitset<counters>() << first_high_speed_counter;
  /// Words of D that a program, a file or a scenario has written, be it 0 (003 5: the others have their
  /// initial values).
  std::bitset<data_words> written;

  // Accessors of D; a 32-bit value's second word is index + 1.
  [[nodiscard]] std::int16_t i16(int index) const {
    return static_cast<std::int16_t>(d[static_cast<std::size_t>(index)]);
  }
  [[nodiscard]] std::uint32_t u32(int index) const;
  [[nodiscard]] std::int32_t i32(int index) const { return static_cast<std::int32_t>(u32(index)); }
  [[nodiscard]] float f32(int index) const;
  /// Writes a word and notes that it was written.
  void put(int index, std::uint16_t value) {
    d[static_cast<std::size_t>(index)] = value;
    written.set(static_cast<std::size_t>(index));
  }
  void set_i16(int index, std::int16_t value) { put(index, static_cast<std::uint16_t>(value)); }
  void set_u32(int index, std::uint32_t value);
  void set_i32(int index, std::int32_t value) { set_u32(index, static_cast<std::uint32_t>(value)); }
  void set_f32(int index, float value);
};

/// A bit by its device's letter: X, Y, M, S, or the contact of T and C.
bool* bit_at(Registers& registers, char letter, int number);
const bool* bit_at(const Registers& registers, char letter, int number);

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

}  // namespace drycut::devices::lx3vp
