#include "devices/lx3vp/registers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <chrono>
#include <cmath>
#include <limits>

#include "base/state_archive.hpp"
#include "base/text.hpp"

namespace drycut::devices::lx3vp {

namespace {

using Kind = RegisterName::Kind;

struct Prefix {
  std::string_view text;
  Kind kind;
  int count;  ///< numbers 0..count - 1
  int base = 10;
};
// Longer prefixes first: "DD10" is no D.
constexpr Prefix prefixes[] = {
    {"DD", Kind::wide, data_words - 1},
    {"FD", Kind::real, data_words - 1},
    {"TS", Kind::timer_contact, timers},
    {"CS", Kind::counter_contact, counters},
    {"D", Kind::word, data_words},
    {"M", Kind::m, relays},
    {"S", Kind::s, states},
    {"X", Kind::x, terminals, 8},
    {"Y", Kind::y, terminals, 8},
    {"T", Kind::timer, timers},
    {"C", Kind::counter, counters},
    {"V", Kind::v, index_registers},
    {"Z", Kind::z, index_registers},
};

const Prefix& prefix_of(Kind kind) {
  // A bit is one of a word.
  return *std::find_if(std::begin(prefixes), std::end(prefixes), [&](const Prefix& prefix) {
    return prefix.kind == (kind == Kind::bit ? Kind::word : kind);
  });
}

// What stands behind the number: `D10:L`, `D10:F`, `D10.A`.
bool read_suffix(std::string_view suffix, RegisterName& name) {
  if (suffix.empty()) return true;
  if (name.kind != Kind::word || suffix.size() != 2) return false;
  const char letter = suffix[1];
  if (suffix[0] == ':') {
    if (letter != 'L' && letter != 'F') return false;
    name.kind = letter == 'L' ? Kind::wide : Kind::real;
    return name.number < data_words - 1;
  }
  if (suffix[0] != '.') return false;
  name.kind = Kind::bit;
  name.bit = letter >= 'A' ? letter - 'A' + 10 : letter - '0';
  return name.bit >= 0 && name.bit <= 15;
}

}  // namespace

void Timer::visit(StateArchive& archive) { STATE(archive, value, coil, contact); }
void PlcCounter::visit(StateArchive& archive) { STATE(archive, value, coil, contact); }

// counts_pulses is wiring.
void Registers::visit(StateArchive& archive) {
  STATE(archive, d, m, x, y, s, t, c, v, z, time_ns, now_ns, clock_offset_s);
  constexpr std::size_t bits = 8;
  std::array<std::uint8_t, data_words / bits> written_bits{};
  static_assert(written_bits.size() * bits == data_words);
  for (std::size_t at = 0; at < data_words; ++at)
    if (written[at]) written_bits[at / bits] |= static_cast<std::uint8_t>(1U << at % bits);
  STATE(archive, written_bits);
  for (std::size_t at = 0; at < data_words; ++at)
    written[at] = (written_bits[at / bits] >> at % bits & 1U) != 0;
}

float Registers::f32(int index) const { return std::bit_cast<float>(u32(index)); }
void Registers::set_f32(int index, float value) { set_u32(index, std::bit_cast<std::uint32_t>(value)); }

namespace {

constexpr std::chrono::sys_days clock_begins{std::chrono::year{2000} / 1 / 1};

std::chrono::sys_seconds clock_time(const Registers& registers) {
  return clock_begins + std::chrono::seconds(registers.clock_offset_s) +
         std::chrono::floor<std::chrono::seconds>(std::chrono::nanoseconds(registers.now_ns));
}

}  // namespace

ClockWords clock_of(const Registers& registers) {
  const auto time = clock_time(registers);
  const auto day = std::chrono::floor<std::chrono::days>(time);
  const std::chrono::year_month_day date{day};
  const std::chrono::hh_mm_ss clock{time - day};
  return {static_cast<int>(date.year()) % 100,
          static_cast<int>(static_cast<unsigned>(date.month())),
          static_cast<int>(static_cast<unsigned>(date.day())),
          static_cast<int>(clock.hours().count()),
          static_cast<int>(clock.minutes().count()),
          static_cast<int>(clock.seconds().count()),
          static_cast<int>(std::chrono::weekday{day}.c_encoding())};
}

// It begins with a whole minute.
int clock_second(const Registers& registers) {
  constexpr std::int64_t ns_per_s = 1'000'000'000;
  constexpr int minute = 60;
  return static_cast<int>(((registers.clock_offset_s + registers.now_ns / ns_per_s) % minute + minute) %
                          minute);
}

bool set_clock(Registers& registers, const ClockWords& words) {
  const auto [year, month, day, hour, minute, second, weekday] = words;
  constexpr int first_of_the_last_century = 80;
  if (std::any_of(words.begin(), words.end(), [](int word) { return word < 0 || word > 99; })) return false;
  const std::chrono::year_month_day date{
      std::chrono::year{year < first_of_the_last_century ? 2000 + year : 1900 + year},
      std::chrono::month{static_cast<unsigned>(month)}, std::chrono::day{static_cast<unsigned>(day)}};
  if (!date.ok() || hour > 23 || minute > 59 || second > 59) return false;
  const auto time = std::chrono::sys_days{date} + std::chrono::hours(hour) + std::chrono::minutes(minute) +
                    std::chrono::seconds(second);
  registers.clock_offset_s += (time - clock_time(registers)).count();
  show_clock(registers);
  return true;
}

void show_clock(Registers& registers) {
  // D8018 year, D8017 month, D8016 day, D8015 hour, D8014 minute, D8013 second, D8019 weekday.
  constexpr std::array places = {8018, 8017, 8016, 8015, 8014, 8013, 8019};
  const auto clock = clock_of(registers);
  for (std::size_t i = 0; i < places.size(); ++i)
    registers.d[static_cast<std::size_t>(places[i])] = static_cast<std::uint16_t>(clock[i]);
}

std::string shown(std::string_view text) {
  constexpr std::size_t most = 24;
  std::string result;
  for (const char c : text.substr(0, most)) result += c >= ' ' && c <= '~' ? c : '?';
  return text.size() > most ? result + "..." : result;
}

std::optional<RegisterName> parse_register(std::string_view text) {
  const auto name_text = upper(text);
  for (const Prefix& prefix : prefixes) {
    if (!name_text.starts_with(prefix.text)) continue;
    const char* const first = name_text.data() + prefix.text.size();
    const char* const last = name_text.data() + name_text.size();
    RegisterName name{prefix.kind};
    const auto [end, error] = std::from_chars(first, last, name.number, prefix.base);
    if (first == last || *first == '-' || error != std::errc{} || name.number >= prefix.count)
      return std::nullopt;
    if (prefix.kind == Kind::m && name.number > last_relay && name.number < first_special)
      return std::nullopt;
    if (!read_suffix(std::string_view(end, static_cast<std::size_t>(last - end)), name)) return std::nullopt;
    return name;
  }
  return std::nullopt;
}

std::string to_string(const RegisterName& name) {
  if (name.kind == Kind::bit) return fmt::format("D{}.{:X}", name.number, name.bit);
  const Prefix& prefix = prefix_of(name.kind);
  return prefix.base == 8 ? fmt::format("{}{:o}", prefix.text, name.number)
                          : fmt::format("{}{}", prefix.text, name.number);
}

char letter_of(const RegisterName& name) {
  const Prefix& prefix = prefix_of(name.kind);
  return prefix.kind == Kind::wide || prefix.kind == Kind::real ? 'D' : prefix.text.front();
}

bool is_served(const RegisterName& name) {
  const char letter = letter_of(name);
  return (letter != 'D' && letter != 'M') || is_served(letter, name.number);
}

double read(const Registers& registers, const RegisterName& name) {
  const auto at = static_cast<std::size_t>(name.number);
  switch (name.kind) {
    case Kind::word:
      return registers.i16(name.number);
    case Kind::wide:
      return registers.i32(name.number);
    case Kind::real:
      return static_cast<double>(registers.f32(name.number));
    case Kind::bit:
      return registers.d[at] >> name.bit & 1;
    case Kind::timer:
      return registers.t[at].value;
    case Kind::counter:
      return registers.c[at].value;
    case Kind::v:
      return static_cast<std::int16_t>(registers.v[at]);
    case Kind::z:
      return static_cast<std::int16_t>(registers.z[at]);
    default:
      return *bit_at(registers, letter_of(name), name.number) ? 1 : 0;
  }
}

ValueRange range_of(const RegisterName& name) {
  constexpr double most = 2147483647.0;
  const auto as_float = fmt::format("D{}:F for a float", name.number);
  switch (name.kind) {
    case Kind::word:
      return {-32768, 65535, true, as_float, fmt::format("D{}:L", name.number)};
    case Kind::v:
    case Kind::z:
      return {-32768, 65535, true};
    case Kind::wide:
      return {-most - 1, most, true, as_float};
    case Kind::real:
      return {-std::numeric_limits<float>::max(), std::numeric_limits<float>::max()};
    case Kind::timer:
      return {0, 32767, true};
    case Kind::counter:
      if (name.number < first_wide_counter) return {-32768, 32767, true};
      return {-most - 1, most, true};
    default:
      return {0, 1, true};
  }
}

void write(Registers& registers, const RegisterName& name, double value) {
  const auto at = static_cast<std::size_t>(name.number);
  const ValueRange range = range_of(name);
  const double limited = std::isnan(value) ? 0 : std::clamp(value, range.low, range.high);
  if (name.kind == Kind::real) return registers.set_f32(name.number, static_cast<float>(limited));
  const auto whole = static_cast<std::int64_t>(std::llround(limited));
  const bool on = whole != 0;
  switch (name.kind) {
    case Kind::word:
      registers.put(name.number, static_cast<std::uint16_t>(whole));
      break;
    case Kind::wide:
      registers.set_i32(name.number, static_cast<std::int32_t>(whole));
      break;
    case Kind::bit: {
      const unsigned mask = 1U << static_cast<unsigned>(name.bit);
      registers.put(name.number,
                    static_cast<std::uint16_t>(on ? registers.d[at] | mask : registers.d[at] & ~mask));
      break;
    }
    case Kind::timer:
      registers.t[at].value = static_cast<std::uint16_t>(whole);
      break;
    case Kind::counter:
      registers.c[at].value = static_cast<std::int32_t>(whole);
      break;
    case Kind::v:
      registers.v[at] = static_cast<std::uint16_t>(whole);
      break;
    case Kind::z:
      registers.z[at] = static_cast<std::uint16_t>(whole);
      break;
    default:
      *bit_at(registers, letter_of(name), name.number) = on;
      break;
  }
}

}  // namespace drycut::devices::lx3vp
