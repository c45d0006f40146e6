#include "devices/lx3vp/il_values.hpp"

namespace drycut::devices::lx3vp::il {

namespace {

std::size_t place(int number) { return static_cast<std::size_t>(number); }

bool bit_of(const Registers& registers, Kind kind, int number) {
  switch (kind) {
    case Kind::X:
      return registers.x[place(number)];
    case Kind::Y:
      return registers.y[place(number)];
    case Kind::M:
      return registers.m[place(number)];
    case Kind::S:
      return registers.s[place(number)];
    case Kind::T:
      return registers.t[place(number)].contact;
    case Kind::C:
      return registers.c[place(number)].contact;
    default:
      return false;
  }
}

void set_bit(Registers& registers, Kind kind, int number, bool on) {
  switch (kind) {
    case Kind::X:
      registers.x[place(number)] = on;
      break;
    case Kind::Y:
      registers.y[place(number)] = on;
      break;
    case Kind::M:
      registers.m[place(number)] = on;
      break;
    case Kind::S:
      registers.s[place(number)] = on;
      break;
    case Kind::T:
      registers.t[place(number)].contact = on;
      break;
    case Kind::C:
      registers.c[place(number)].contact = on;
      break;
    default:
      break;
  }
}

/// A word of D, or the value of a timer or a counter.
std::uint16_t word_of(const Registers& registers, Kind kind, int number) {
  if (kind == Kind::D) return registers.d[place(number)];
  if (kind == Kind::T) return registers.t[place(number)].value;
  return static_cast<std::uint16_t>(registers.c[place(number)].value);
}

void set_word(Registers& registers, Kind kind, int number, std::uint16_t value) {
  if (kind == Kind::D)
    registers.d[place(number)] = value;
  else if (kind == Kind::T)
    registers.t[place(number)].value = value;
  else
    registers.c[place(number)].value = static_cast<std::int16_t>(value);
}

bool is_wide_counter(const Operand& operand) {
  return operand.kind == Kind::C && operand.number >= first_wide_counter;
}

}  // namespace

bool read_bit(const Registers& registers, const Operand& operand) {
  if (operand.kind == Kind::word_bit) return (registers.d[place(operand.number)] >> operand.count & 1) != 0;
  return bit_of(registers, operand.kind, operand.number);
}

void write_bit(Registers& registers, const Operand& operand, bool on) {
  if (operand.kind != Kind::word_bit) {
    set_bit(registers, operand.kind, operand.number, on);
    return;
  }
  auto& word = registers.d[place(operand.number)];
  const auto bit = static_cast<std::uint16_t>(1U << operand.count);
  word = static_cast<std::uint16_t>(on ? word | bit : word & ~bit);
}

std::int32_t read_value(const Registers& registers, const Operand& operand, bool wide) {
  std::uint32_t value = 0;
  if (operand.kind == Kind::constant) {
    value = static_cast<std::uint32_t>(operand.value);
  } else if (operand.kind == Kind::bits) {
    for (int i = 4 * operand.count - 1; i >= 0; --i)
      value = value << 1 | (bit_of(registers, operand.of, operand.number + i) ? 1U : 0U);
    // Fewer bits than the instruction is wide are a number without sign.
    if (4 * operand.count < (wide ? 32 : 16)) return static_cast<std::int32_t>(value);
  } else if (is_wide_counter(operand)) {
    return registers.c[place(operand.number)].value;
  } else {
    value = word_of(registers, operand.kind, operand.number);
    if (wide) value |= static_cast<std::uint32_t>(word_of(registers, operand.kind, operand.number + 1)) << 16;
  }
  return wide ? static_cast<std::int32_t>(value) : static_cast<std::int16_t>(value & 0xFFFF);
}

void write_value(Registers& registers, const Operand& operand, bool wide, std::int32_t value) {
  const auto bits = static_cast<std::uint32_t>(value);
  if (operand.kind == Kind::bits) {
    for (int i = 0; i < 4 * operand.count; ++i)
      set_bit(registers, operand.of, operand.number + i, (bits >> i & 1) != 0);
  } else if (is_wide_counter(operand)) {
    registers.c[place(operand.number)].value = value;
  } else {
    set_word(registers, operand.kind, operand.number, static_cast<std::uint16_t>(bits & 0xFFFF));
    if (wide) set_word(registers, operand.kind, operand.number + 1, static_cast<std::uint16_t>(bits >> 16));
  }
}

float read_float(const Registers& registers, const Operand& operand) {
  if (operand.kind == Kind::real) return operand.real;
  if (operand.kind == Kind::constant) return static_cast<float>(operand.value);
  return registers.f32(operand.number);
}

}  // namespace drycut::devices::lx3vp::il
