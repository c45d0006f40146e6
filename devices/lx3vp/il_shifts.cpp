// Shifts, rotations and conversions of whole numbers: what each does, with its row in the table.
#include <cmath>
#include <vector>

#include "devices/lx3vp/il_operands.hpp"
#include "devices/lx3vp/il_values.hpp"

namespace drycut::devices::lx3vp::il {

namespace {

using namespace form;

constexpr int most_shifted = 1024;  // FX
constexpr int most_averaged = 64;   // FX

/// Whether `count` devices from a bit on exist.
void need_bits(const Call& call, std::size_t i, int count) {
  const Operand& first = call.operand(i);
  Operand last = first;
  last.number += count - 1;
  if (!exists(last))
    throw IlError(bad_operand,
                  fmt::format("{} devices from {} on go beyond what there is", count, to_string(first)));
}

/// SFTL and SFTR: n1 bits from D on move by n2; what becomes free is filled from S on.
void shift(Call& call, bool up) {
  const int length = call.ranged(2);
  const int by = call.ranged(3);
  if (by > length) throw IlError(bad_operand, fmt::format("{} bits of {} are to be shifted", by, length));
  need_bits(call, 0, by);
  need_bits(call, 1, length);
  auto& registers = call.registers();
  const auto bit = [&](std::size_t i, int n) {
    Operand device = call.operand(i);
    device.number += n;
    return device;
  };
  // Taken before anything moves: S and D may overlap.
  std::vector<bool> bits;
  for (int n = 0; n < by; ++n) bits.push_back(read_bit(registers, bit(0, n)));
  const auto kept_from = up ? 0 : by;
  std::vector<bool> kept;
  for (int n = 0; n < length - by; ++n) kept.push_back(read_bit(registers, bit(1, kept_from + n)));
  bits.insert(up ? bits.end() : bits.begin(), kept.begin(), kept.end());
  for (int n = 0; n < length; ++n) write_bit(registers, bit(1, n), bits[static_cast<std::size_t>(n)]);
}

/// ROL and ROR: what leaves at one end comes in at the other.
void rotate(Call& call, bool left) {
  const int width = call.wide() ? 32 : 16;
  const int by = call.ranged(1);
  const std::uint64_t mask = (std::uint64_t{1} << width) - 1;
  const auto bits = static_cast<std::uint64_t>(call.value(0)) & mask;
  const int to_left = left ? by : width - by;
  const auto turned = (bits << to_left | bits >> (width - to_left)) & mask;
  call.set(0, static_cast<std::int32_t>(static_cast<std::uint32_t>(turned)));
  call.set_flag(carry_flag, (turned >> (left ? 0 : width - 1) & 1) != 0);
}

/// Four bits a digit: four digits, of a 32-bit number eight.
int digits_of(const Call& call) { return call.wide() ? 8 : 4; }

void to_decimal_digits(Call& call) {
  std::int32_t rest = call.ranged(0);
  std::uint32_t digits = 0;
  for (int i = 0; i < digits_of(call); ++i, rest /= 10)
    digits |= static_cast<std::uint32_t>(rest % 10) << 4 * i;
  call.set(1, static_cast<std::int32_t>(digits));
}

void from_decimal_digits(Call& call) {
  const auto digits = static_cast<std::uint32_t>(call.value(0));
  std::int32_t number = 0;
  for (int i = digits_of(call) - 1; i >= 0; --i) {
    const auto digit = digits >> 4 * i & 0xF;
    if (digit > 9)
      throw IlError(bad_operand, fmt::format("H{:X} is no BCD: it has a digit {:X}",
                                             call.wide() ? digits : digits & 0xFFFF, digit));
    number = number * 10 + static_cast<std::int32_t>(digit);
  }
  call.set(1, number);
}

void average(Call& call) {
  const int count = call.ranged(2);
  call.need_values(0, count);
  std::int64_t sum = 0;
  for (int i = 0; i < count; ++i) sum += read_value(call.registers(), call.nth(0, i), call.wide());
  call.set(1, static_cast<std::int32_t>(sum / count));
}

void square_root(Call& call) {
  const std::int32_t square = call.ranged(0);
  // Exact: a double holds all of 32 bit.
  const auto root = static_cast<std::int32_t>(std::sqrt(static_cast<double>(square)));
  call.set(1, root);
  call.set_flag(zero_flag, root == 0);
  call.set_flag(borrow_flag, root * root != square);
}

constexpr NumberRange sft_numbers[] = {{2, "n1", 1, most_shifted, 0, "1"},
                                       {3, "n2", 1, most_shifted, 0, "0"}};
constexpr NumberRange rotation_numbers[] = {{1, "n", 1, 16, 32}};
constexpr NumberRange bcd_numbers[] = {{0, "S", 0, 9999, 99'999'999}};
constexpr NumberRange mean_numbers[] = {{2, "n", 1, most_averaged, 0, "0"}};
constexpr NumberRange sqr_numbers[] = {{0, "S", 0}};

constexpr Mnemonic shift_rows[] = {
    {"SFTL", Op::shift, "ghkk", np, 9, 0, "shifts n1 bits from D on up by n2, from S on fill in",
     [](Call& c) { shift(c, true); }, sft_numbers},
    {"SFTR", Op::shift, "ghkk", np, 9, 0, "shifts n1 bits from D on down by n2, from S on fill in",
     [](Call& c) { shift(c, false); }, sft_numbers},
    {"ROL", Op::rotate, "wk", nwp, 5, 7, "turns D round to the left by n bits, the last of them in M8022",
     [](Call& c) { rotate(c, true); }, rotation_numbers},
    {"ROR", Op::rotate, "wk", nwp, 5, 7, "turns D round to the right by n bits, the last in M8022",
     [](Call& c) { rotate(c, false); }, rotation_numbers},
    {"BCD", Op::action, "nw", nwp, 5, 9, "D = S with a decimal digit in each four bits", to_decimal_digits,
     bcd_numbers},
    {"BIN", Op::action, "nw", nwp, 5, 9, "D = S, which has a decimal digit in each four bits",
     from_decimal_digits},
    {"MEAN", Op::action, "uwk", nwp, 7, 13, "D = mean of n values (1 to 64) from S on, no decimals", average,
     mean_numbers},
    {"SQR", Op::action, "ji", nwp, 5, 9, "D = square root of S, no decimals", square_root, sqr_numbers},
};

}  // namespace

std::span<const Mnemonic> shift_mnemonics() { return shift_rows; }

}  // namespace drycut::devices::lx3vp::il
