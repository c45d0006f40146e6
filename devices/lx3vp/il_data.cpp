// Instructions on digits, bits, queues and times of day: what each does, with its row in the table.
#include <algorithm>
#include <array>
#include <bit>
#include <string_view>
#include <vector>

#include "devices/lx3vp/il_operands.hpp"
#include "devices/lx3vp/il_values.hpp"

namespace drycut::devices::lx3vp::il {

namespace {

using namespace form;

constexpr int hexadecimal_flag = 8168;  // M8168: SMOV moves digits of 16, not of 10
constexpr int most_words = 512;         // FX
constexpr int most_exponent = 8;        // FX, of bits

// Digits.

constexpr int word_digits = 4;

std::array<int, word_digits> digits_of_word(int value, int base) {
  std::array<int, word_digits> digits{};
  for (int& digit : digits) {
    digit = value % base;
    value /= base;
  }
  return digits;
}

/// SMOV: m2 digits of S, from the m1-th down, become digits of D, from the n-th down.
void move_digits(Call& call) {
  const int from = call.ranged(1);
  const int count = call.ranged(2);
  const int to = call.ranged(4);
  if (count > from || count > to)
    throw IlError(bad_operand,
                  fmt::format("{} digits from place {} to place {}: m2 is above m1 or n", count, from, to));
  const bool hexadecimal = call.flag(hexadecimal_flag);
  const int base = hexadecimal ? 16 : 10;
  const auto digits = [&](std::size_t i) {
    const int value = call.value(i);
    if (hexadecimal) return digits_of_word(value & 0xFFFF, base);
    if (value < 0 || value > 9999)
      throw IlError(bad_operand, fmt::format("{} has no four decimal digits", value));
    return digits_of_word(value, base);
  };
  const auto source = digits(0);
  auto target = digits(3);
  for (int i = 1; i <= count; ++i)
    target[static_cast<std::size_t>(to - i)] = source[static_cast<std::size_t>(from - i)];
  int value = 0;
  for (auto digit = target.rbegin(); digit != target.rend(); ++digit) value = value * base + *digit;
  call.set(3, value);
}

// Bits.

bool names_bits(const Operand& operand) {
  return std::string_view("XYMS").find(letter_of(operand.kind)) != std::string_view::npos;
}

void need_devices(const Operand& first, int count) {
  Operand last = first;
  last.number += count - 1;
  if (!exists(last))
    throw IlError(bad_operand,
                  fmt::format("{} devices from {} on go beyond what there is", count, to_string(first)));
}

/// The bits of a word, or `count` devices from a bit on.
std::vector<bool> bits_from(const Call& call, std::size_t i, int count) {
  std::vector<bool> bits;
  Operand bit = call.operand(i);
  if (!names_bits(bit)) {
    const auto word = call.bits(i);
    for (int n = 0; n < count; ++n) bits.push_back((word >> n & 1U) != 0);
    return bits;
  }
  need_devices(bit, count);
  for (int n = 0; n < count; ++n, ++bit.number) bits.push_back(read_bit(call.registers(), bit));
  return bits;
}

// n of DECO and ENCO: 2^n bits; 0 does nothing.
void decode(Call& call) {
  Operand device = call.operand(1);
  const int n = call.ranged(2);
  if (n == 0) return;
  int number = 0;
  const auto bits = bits_from(call, 0, n);
  for (int i = n; i-- > 0;) number = 2 * number + (bits[static_cast<std::size_t>(i)] ? 1 : 0);
  if (!names_bits(device)) return call.set(1, static_cast<std::int32_t>(1U << number));
  need_devices(device, 1 << n);
  for (int i = 0; i < 1 << n; ++i, ++device.number) write_bit(call.registers(), device, i == number);
}

void encode(Call& call) {
  const int n = call.ranged(2);
  if (n == 0) return;
  const auto bits = bits_from(call, 0, 1 << n);
  const auto highest = std::find(bits.rbegin(), bits.rend(), true);
  if (highest == bits.rend()) throw IlError(bad_operand, "none of the bits of S is ON");
  call.set(1, static_cast<std::int32_t>(bits.rend() - highest) - 1);
}

void count_bits(Call& call) {
  const auto word = call.wide() ? call.bits(0) : call.bits(0) & 0xFFFFU;
  call.set(1, std::popcount(word));
  call.set_flag(zero_flag, word == 0);
}

void test_bit(Call& call) {
  const int bit = call.ranged(2);
  write_bit(call.registers(), call.operand(1), (call.bits(0) >> bit & 1U) != 0);
}

void swap_bytes(Call& call) {
  const auto word = call.bits(0);
  call.set_bits(0, (word & 0x00FF00FFU) << 8U | (word >> 8U & 0x00FF00FFU));
}

// Rows of words.

std::int32_t word_at(const Call& call, std::size_t i, int n) {
  return read_value(call.registers(), call.nth(i, n), false);
}
void set_word_at(const Call& call, std::size_t i, int n, std::int32_t value) {
  write_value(call.registers(), call.nth(i, n), false, value);
}

/// WSFR and WSFL: n1 words from D on move by n2 down or up; from S on come those that are new.
void shift_words(Call& call, bool up) {
  const int length = call.ranged(2);
  const int by = call.ranged(3);
  if (by > length) throw IlError(bad_operand, fmt::format("{} words of {} are to be shifted", by, length));
  call.need_values(0, by);
  call.need_values(1, length);
  // Taken before anything moves: S and D may overlap.
  std::vector<std::int32_t> words;
  for (int n = 0; n < by; ++n) words.push_back(word_at(call, 0, n));
  std::vector<std::int32_t> kept;
  for (int n = 0; n < length - by; ++n) kept.push_back(word_at(call, 1, up ? n : n + by));
  words.insert(up ? words.end() : words.begin(), kept.begin(), kept.end());
  for (int n = 0; n < length; ++n) set_word_at(call, 1, n, words[static_cast<std::size_t>(n)]);
}

/// How many words a queue holds: its first word says so.
int words_in_queue(const Call& call, std::size_t queue, int length) {
  call.need_values(queue, length);
  const int held = word_at(call, queue, 0);
  if (held < 0) throw IlError(bad_operand, fmt::format("{} words stand in the queue", held));
  return held;
}

void put_into_queue(Call& call) {
  const int length = call.ranged(2);
  const int held = words_in_queue(call, 1, length);
  call.set_flag(carry_flag, held >= length - 1);
  if (held >= length - 1) return;
  set_word_at(call, 1, held + 1, call.value(0));
  set_word_at(call, 1, 0, held + 1);
}

void take_from_queue(Call& call) {
  const int length = call.ranged(2);
  const int held = words_in_queue(call, 0, length);
  call.set_flag(zero_flag, held == 0);
  if (held == 0) return;
  if (held > length - 1)
    throw IlError(bad_operand, fmt::format("{} words stand in a queue of {}", held, length - 1));
  call.set(1, word_at(call, 0, 1));
  for (int n = 1; n + 1 < length; ++n) set_word_at(call, 0, n, word_at(call, 0, n + 1));
  set_word_at(call, 0, 0, held - 1);
}

// Times of day.

constexpr int seconds_a_day = 24 * 3600;

int second_of_day(int hour, int minute, int second) {
  if (hour < 0 || hour > 23 || minute < 0 || minute > 59 || second < 0 || second > 59)
    throw IlError(bad_operand, fmt::format("{}:{}:{} is no time of day", hour, minute, second));
  return hour * 3600 + minute * 60 + second;
}
/// Of three words: hour, minute, second.
int second_of_day(const Call& call, std::size_t i) {
  return second_of_day(word_at(call, i, 0), word_at(call, i, 1), word_at(call, i, 2));
}

void compare_times(Call& call) {
  call.set_order(4, second_of_day(call.ranged(0), call.ranged(1), call.ranged(2)), second_of_day(call, 3));
}

void set_time_of_day(Call& call, int seconds) {
  call.set_flag(zero_flag, seconds == 0);
  set_word_at(call, 2, 0, seconds / 3600);
  set_word_at(call, 2, 1, seconds / 60 % 60);
  set_word_at(call, 2, 2, seconds % 60);
}

void add_times(Call& call) {
  const int sum = second_of_day(call, 0) + second_of_day(call, 1);
  call.set_flag(carry_flag, sum >= seconds_a_day);
  set_time_of_day(call, sum % seconds_a_day);
}

void subtract_times(Call& call) {
  const int difference = second_of_day(call, 0) - second_of_day(call, 1);
  call.set_flag(borrow_flag, difference < 0);
  set_time_of_day(call, (difference + seconds_a_day) % seconds_a_day);
}

void read_clock(Call& call) {
  const auto date = clock_of(call.registers());
  for (std::size_t n = 0; n < date.size(); ++n) set_word_at(call, 0, static_cast<int>(n), date[n]);
}

void write_clock(Call& call) {
  ClockWords date{};
  for (std::size_t n = 0; n < date.size(); ++n) date[n] = word_at(call, 0, static_cast<int>(n));
  if (!set_clock(call.registers(), date))
    throw IlError(bad_operand, fmt::format("year {}, month {}, day {}, {}:{}:{} is no time", date[0], date[1],
                                           date[2], date[3], date[4], date[5]));
}

constexpr NumberRange smov_numbers[] = {
    {1, "m1", 1, word_digits}, {2, "m2", 1, word_digits}, {4, "n", 1, word_digits}};
constexpr NumberRange deco_numbers[] = {{2, "n", 0, most_exponent, 0, "1", true}};
constexpr NumberRange enco_numbers[] = {{2, "n", 0, most_exponent, 0, "0", true}};
constexpr NumberRange bon_numbers[] = {{2, "n", 0, 15, 31}};
constexpr NumberRange wsf_numbers[] = {{2, "n1", 1, most_words, 0, "1"}, {3, "n2", 1, most_words, 0, "0"}};
constexpr NumberRange sfwr_numbers[] = {{2, "n", 2, most_words, 0, "1"}};
constexpr NumberRange sfrd_numbers[] = {{2, "n", 2, most_words, 0, "0"}};
constexpr NumberRange tcmp_numbers[] = {
    {0, "the hour S1", 0, 23}, {1, "the minute S2", 0, 59}, {2, "the second S3", 0, 59}};

constexpr Mnemonic data_rows[] = {
    {"SMOV", Op::action, "nkkwk", np, 11, 0,
     "m2 decimal digits of S from the m1-th down, to the n-th of D and down; with M8168 hexadecimal ones",
     move_digits, smov_numbers},
    {"SWAP", Op::action, "w", nwp, 3, 5, "exchanges the bytes of a word, of 32 bits in each word",
     swap_bytes},
    {"DECO", Op::action, "zOk", np, 7, 0,
     "of 2^n bits of D the one that S (n bits) names is ON, the others OFF; n to 8, in a word to 4", decode,
     deco_numbers},
    {"ENCO", Op::action, "ZWk", np, 7, 0, "D = the number of the highest bit that is ON of 2^n from S on",
     encode, enco_numbers},
    {"SUM", Op::action, "nw", nwp, 5, 9, "D = how many bits of S are ON", count_bits},
    {"BON", Op::action, "nhk", nwp, 7, 13, "D is ON if bit n of S is", test_bit, bon_numbers},
    {"WSFR", Op::block, "uUkk", np, 9, 0, "shifts n1 words from D on down by n2, from S on fill in",
     [](Call& c) { shift_words(c, false); }, wsf_numbers},
    {"WSFL", Op::block, "uUkk", np, 9, 0, "shifts n1 words from D on up by n2, from S on fill in",
     [](Call& c) { shift_words(c, true); }, wsf_numbers},
    {"SFWR", Op::action, "nUk", np, 7, 0,
     "puts S into a queue of n words, of which D counts what it holds; M8022: it is full", put_into_queue,
     sfwr_numbers},
    {"SFRD", Op::action, "Uwk", np, 7, 0,
     "takes D from a queue of n words, of which S counts what it holds; M8020: it is empty", take_from_queue,
     sfrd_numbers},
    {"TCMP", Op::action, "nnncB", np, 11, 0,
     "CMP of times of day: S1 h, S2 min, S3 s against three words from S on", compare_times, tcmp_numbers},
    {"TZCP", Op::action, "cccB", np, 9, 0, "ZCP of times of day, three words each: S3 below, within, above",
     [](Call& c) { c.set_zone(3, second_of_day(c, 2), second_of_day(c, 0), second_of_day(c, 1)); }},
    {"TADD", Op::action, "ccC", np, 7, 0, "D = S1 + S2, times of day; M8022: beyond midnight", add_times},
    {"TSUB", Op::action, "ccC", np, 7, 0, "D = S1 - S2, times of day; M8021: before midnight",
     subtract_times},
    {"TRD", Op::action, "8", np, 3, 0,
     "seven words from D on: year, month, day, hour, minute, second, weekday (0: Sunday)", read_clock},
    {"TWR", Op::action, "7", np, 3, 0, "sets the clock by seven words from S on, as TRD reads them",
     write_clock},
};

}  // namespace

std::span<const Mnemonic> data_mnemonics() { return data_rows; }

}  // namespace drycut::devices::lx3vp::il
