#include "devices/lx3vp/il_values.hpp"

#include <algorithm>
#include <utility>

#include "devices/lx3vp/il_operands.hpp"

namespace drycut::devices::lx3vp::il {

namespace {

std::size_t place(int number) { return static_cast<std::size_t>(number); }

/// A word of D, or the value of a timer or a counter.
std::uint16_t word_of(const Registers& registers, OperandType kind, int number) {
  if (kind == OperandType::D) return registers.d[place(number)];
  if (kind == OperandType::T) return registers.t[place(number)].value;
  if (kind == OperandType::V) return registers.v[place(number)];
  if (kind == OperandType::Z) return registers.z[place(number)];
  return static_cast<std::uint16_t>(registers.c[place(number)].value);
}

void set_word(Registers& registers, OperandType kind, int number, std::uint16_t value) {
  if (kind == OperandType::D)
    registers.put(number, value);
  else if (kind == OperandType::T)
    registers.t[place(number)].value = value;
  else if (kind == OperandType::V)
    registers.v[place(number)] = value;
  else if (kind == OperandType::Z)
    registers.z[place(number)] = value;
  else
    registers.c[place(number)].value = static_cast<std::int16_t>(value);
}

/// The upper word of a 32-bit value: of Z it is V.
std::pair<OperandType, int> upper_word(const Operand& operand) {
  if (operand.kind == OperandType::Z) return {OperandType::V, operand.number};
  return {operand.kind, operand.number + 1};
}

bool is_wide_counter(const Operand& operand) {
  return operand.kind == OperandType::C && operand.number >= first_wide_counter;
}

}  // namespace

bool read_bit(const Registers& registers, const Operand& operand) {
  if (operand.kind == OperandType::word_bit)
    return (registers.d[place(operand.number)] >> operand.count & 1) != 0;
  return *bit_at(registers, letter_of(operand.kind), operand.number);
}

void write_bit(Registers& registers, const Operand& operand, bool on) {
  if (operand.kind != OperandType::word_bit) {
    *bit_at(registers, letter_of(operand.kind), operand.number) = on;
    return;
  }
  const auto word = registers.d[place(operand.number)];
  const auto bit = static_cast<std::uint16_t>(1U << operand.count);
  registers.put(operand.number, static_cast<std::uint16_t>(on ? word | bit : word & ~bit));
}

void reset(Registers& registers, const Operand& device) {
  const auto place = static_cast<std::size_t>(device.number);
  if (device.kind == OperandType::D) {
    registers.put(device.number, 0);
    return;
  }
  if (device.kind == OperandType::V || device.kind == OperandType::Z) {
    set_word(registers, device.kind, device.number, 0);
    return;
  }
  if (device.kind == OperandType::T) registers.t[place].value = 0;
  if (device.kind == OperandType::C) registers.c[place].value = 0;
  write_bit(registers, device, false);
}

std::int32_t read_value(const Registers& registers, const Operand& operand, bool wide) {
  std::uint32_t value = 0;
  if (operand.kind == OperandType::constant) {
    value = static_cast<std::uint32_t>(operand.value);
  } else if (operand.kind == OperandType::bits) {
    for (int i = 4 * operand.count - 1; i >= 0; --i)
      value = value << 1 | (*bit_at(registers, letter_of(operand.of), operand.number + i) ? 1U : 0U);
    // Fewer bits than the instruction is wide are a number without sign.
    if (4 * operand.count < (wide ? 32 : 16)) return static_cast<std::int32_t>(value);
  } else if (is_wide_counter(operand)) {
    return registers.c[place(operand.number)].value;
  } else {
    value = word_of(registers, operand.kind, operand.number);
    const auto [kind, number] = upper_word(operand);
    if (wide) value |= static_cast<std::uint32_t>(word_of(registers, kind, number)) << 16;
  }
  return wide ? static_cast<std::int32_t>(value) : static_cast<std::int16_t>(value & 0xFFFF);
}

void write_value(Registers& registers, const Operand& operand, bool wide, std::int32_t value) {
  const auto bits = static_cast<std::uint32_t>(value);
  if (operand.kind == OperandType::bits) {
    for (int i = 0; i < 4 * operand.count; ++i)
      *bit_at(registers, letter_of(operand.of), operand.number + i) = (bits >> i & 1) != 0;
  } else if (is_wide_counter(operand)) {
    registers.c[place(operand.number)].value = value;
  } else {
    set_word(registers, operand.kind, operand.number, static_cast<std::uint16_t>(bits & 0xFFFF));
    const auto [kind, number] = upper_word(operand);
    if (wide) set_word(registers, kind, number, static_cast<std::uint16_t>(bits >> 16));
  }
}

void apply_index(const Registers& registers, Operand& operand, bool wide) {
  const bool is_z = operand.index >= Operand::first_z;
  const auto at = place(operand.index % Operand::first_z);
  std::int64_t index = static_cast<std::int16_t>(is_z ? registers.z[at] : registers.v[at]);
  if (wide)
    index = static_cast<std::int32_t>(static_cast<std::uint32_t>(registers.v[at]) << 16 | registers.z[at]);
  operand.index = Operand::no_index;
  if (operand.kind == OperandType::constant) {
    const auto sum = static_cast<std::uint32_t>(operand.value + index);
    operand.value = wide ? static_cast<std::int32_t>(sum) : static_cast<std::int16_t>(sum & 0xFFFF);
    return;
  }
  constexpr std::int64_t beyond = 1'000'000;  // of every device: none has such a number
  operand.number = static_cast<int>(std::clamp(operand.number + index, -beyond, beyond));
}

void need_in_range(const Step& step, std::size_t operand, std::int32_t number) {
  for (const NumberRange& range : step.spelling->mnemonic->ranges)
    if (range.operand == operand && !is_in(range, step, number))
      throw IlError(bad_operand, fmt::format("{} is {}; {}", range.name, number, remedy_of(range, step)));
}

std::int32_t Call::ranged(std::size_t i) const {
  const bool count = step_.kind(i) == 'k';
  const auto number = read_value(registers_, operand(i), wide_ && !count);
  need_in_range(step_, i, number);
  return number;
}

void Call::need_values(std::size_t i, int count) const {
  const Operand& first = operand(i);
  if (has_values(first, count, wide_)) return;
  throw IlError(bad_operand,
                fmt::format("{} values from {} on go beyond what there is", count, to_string(first)));
}

float read_float(const Registers& registers, const Operand& operand) {
  if (operand.kind == OperandType::real) return operand.real;
  if (operand.kind == OperandType::constant) return static_cast<float>(operand.value);
  return registers.f32(operand.number);
}

}  // namespace drycut::devices::lx3vp::il
