#pragma once
#include <cstdint>
#include <stdexcept>
#include <string>

#include "devices/lx3vp/il_program.hpp"
#include "devices/lx3vp/registers.hpp"

namespace drycut::devices::lx3vp::il {

/// An error of an instruction while it runs (D8067).
struct RuntimeError : std::runtime_error {
  RuntimeError(int number, const std::string& text) : std::runtime_error(text), code(number) {}
  int code;
};
/// FX: more than five subroutines call each other.
inline constexpr int calls_too_deep = 6702;
/// FX: an operand's value or device number is out of its range.
inline constexpr int bad_operand = 6706;

/// ON or OFF of a contact.
bool read_bit(const Registers& registers, const Operand& operand);
/// Switches a bit; of timers and counters the contact.
void write_bit(Registers& registers, const Operand& operand, bool on);
/// RST: OFF, or 0.
void reset(Registers& registers, const Operand& device);

/// A number as the instruction sees it: sign-extended 16 bit, or 32 bit.
std::int32_t read_value(const Registers& registers, const Operand& operand, bool wide);
/// Stores the low 16 bit of `value`, or all 32.
void write_value(Registers& registers, const Operand& operand, bool wide, std::int32_t value);

/// Adds the operand's index register to its number, of a constant to its value: V or Z, of a 32-bit
/// instruction V and Z. The number may then be of no device.
void apply_index(const Registers& registers, Operand& operand, bool wide);

/// A floating-point operand: E, D, or a whole number K or H.
float read_float(const Registers& registers, const Operand& operand);

}  // namespace drycut::devices::lx3vp::il
