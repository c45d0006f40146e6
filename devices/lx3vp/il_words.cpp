// Instructions on words: what each does, with its row in the table.
#include "devices/lx3vp/il_values.hpp"

namespace drycut::devices::lx3vp::il {

namespace {

using namespace form;

void reset_all(Call& call) {
  for (auto device = call.operand(0); device.number <= call.number(1); ++device.number)
    reset(call.registers(), device);
}

void invert(Call& call) {
  write_bit(call.registers(), call.operand(0), !read_bit(call.registers(), call.operand(0)));
}

void exchange(Call& call) {
  const auto first = call.value(0);
  call.set(0, call.value(1));
  call.set(1, first);
}

void multiply(Call& call) {
  const std::int64_t product = static_cast<std::int64_t>(call.value(0)) * call.value(1);
  auto& registers = call.registers();
  registers.set_i32(call.number(2), static_cast<std::int32_t>(static_cast<std::uint64_t>(product)));
  if (call.wide()) registers.set_i32(call.number(2) + 2, static_cast<std::int32_t>(product >> 32));
  registers.m[zero_flag] = product == 0;
}

void divide(Call& call) {
  const std::int64_t dividend = call.value(0);
  const std::int64_t divisor = call.value(1);
  if (divisor == 0) throw IlError(bad_operand, "division by 0");
  // The smallest number by -1 wraps back to itself.
  const auto quotient = static_cast<std::int32_t>(static_cast<std::uint64_t>(dividend / divisor));
  const auto rest = static_cast<std::int32_t>(dividend % divisor);
  auto& registers = call.registers();
  if (call.wide()) {
    registers.set_i32(call.number(2), quotient);
    registers.set_i32(call.number(2) + 2, rest);
  } else {
    registers.set_i16(call.number(2), static_cast<std::int16_t>(quotient));
    registers.set_i16(call.number(2) + 1, static_cast<std::int16_t>(rest));
  }
  registers.m[zero_flag] = quotient == 0;
  registers.m[carry_flag] = dividend / divisor > largest(call.wide());
}

void move_block(Call& call) {
  constexpr int backwards_flag = 8024;
  const int count = call.ranged(2);
  call.need_values(0, count);
  call.need_values(1, count);
  const std::size_t from = call.flag(backwards_flag) ? 1 : 0;
  const std::size_t to = 1 - from;
  if (call.operand(to).kind == OperandType::bits && call.operand(to).of == OperandType::X)
    throw IlError(bad_operand, "M8024 turns the move round, and inputs are not written");
  const auto move = [&](int i) {
    write_value(call.registers(), call.nth(to, i), false,
                read_value(call.registers(), call.nth(from, i), false));
  };
  // Blocks may overlap: nothing is overwritten before it was moved.
  if (call.number(to) <= call.number(from))
    for (int i = 0; i < count; ++i) move(i);
  else
    for (int i = count; i-- > 0;) move(i);
}

void fill_block(Call& call) {
  const int count = call.ranged(2);
  call.need_values(1, count);
  const auto value = call.value(0);
  for (int i = 0; i < count; ++i) write_value(call.registers(), call.nth(1, i), call.wide(), value);
}

constexpr int most_moved = 512;  // FX
constexpr NumberRange bmov_numbers[] = {{2, "n", 1, most_moved, 0, "01"}};
constexpr NumberRange fmov_numbers[] = {{2, "n", 1, most_moved, 0, "1"}};

constexpr Mnemonic word_rows[] = {
    {"ZRST", Op::zrst, "ll", np, 5, 0, "resets all devices from the one to the other", reset_all},
    {"ALT", Op::action, "s", np, 3, 0, "inverts a device", invert},
    {"MOV", Op::action, "nw", nwp, 5, 9, "D = S", [](Call& c) { c.set(1, c.value(0)); }},
    {"CML", Op::action, "nw", nwp, 5, 9, "D = S with every bit inverted",
     [](Call& c) { c.set(1, ~c.value(0)); }},
    {"BMOV", Op::block, "uUk", np, 7, 0, "moves n words, or groups of bits, from S on to D on", move_block,
     bmov_numbers},
    {"FMOV", Op::action, "nUk", nwp, 7, 13, "writes S into n words (values) from D on", fill_block,
     fmov_numbers},
    {"XCH", Op::action, "ww", nwp, 5, 9, "exchanges two values", exchange},
    {"ADD", Op::action, "nnw", nwp, 7, 13, "D = S1 + S2",
     [](Call& c) { c.set_sum(2, c.long_value(0) + c.value(1)); }},
    {"SUB", Op::action, "nnw", nwp, 7, 13, "D = S1 - S2",
     [](Call& c) { c.set_sum(2, c.long_value(0) - c.value(1)); }},
    {"MUL", Op::action, "nnq", nwp, 7, 13, "D = S1 * S2, in twice as many words", multiply},
    {"DIV", Op::action, "nnq", nwp, 7, 13, "D = S1 / S2, the remainder behind it", divide},
    {"INC", Op::action, "w", nwp, 3, 5, "adds 1, from the largest to the smallest",
     [](Call& c) { c.set_bits(0, c.bits(0) + 1U); }},
    {"DEC", Op::action, "w", nwp, 3, 5, "takes off 1, from the smallest to the largest",
     [](Call& c) { c.set_bits(0, c.bits(0) - 1U); }},
    {"NEG", Op::action, "w", nwp, 3, 5, "changes the sign", [](Call& c) { c.set_bits(0, 0U - c.bits(0)); }},
    {"WAND", Op::action, "nnw", nwp, 7, 13, "D = S1 and S2, bit by bit (32 bit: DAND)",
     [](Call& c) { c.set_bits(2, c.bits(0) & c.bits(1)); }},
    {"WOR", Op::action, "nnw", nwp, 7, 13, "D = S1 or S2, bit by bit (32 bit: DOR)",
     [](Call& c) { c.set_bits(2, c.bits(0) | c.bits(1)); }},
    {"WXOR", Op::action, "nnw", nwp, 7, 13, "D = S1 exclusive or S2, bit by bit (32 bit: DXOR)",
     [](Call& c) { c.set_bits(2, c.bits(0) ^ c.bits(1)); }},
    {"CMP", Op::action, "nnB", nwp, 7, 13, "three devices from D on: S1 > S2, S1 = S2, S1 < S2",
     [](Call& c) { c.set_order(2, c.value(0), c.value(1)); }},
    {"ZCP", Op::action, "nnnB", nwp, 9, 17, "three devices from D on: S below, within, above S1..S2",
     [](Call& c) { c.set_zone(3, c.value(2), c.value(0), c.value(1)); }},
};

}  // namespace

std::span<const Mnemonic> word_mnemonics() { return word_rows; }

}  // namespace drycut::devices::lx3vp::il
