#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "devices/lx3vp/il_program.hpp"
#include "devices/value_range.hpp"

namespace drycut::devices::lx3vp::il {

/// Reads an operand: a device in its range, a number or a label. A fault is told in `fault`.
std::optional<Operand> read_operand(std::string_view text, ValueFault& fault);
/// What is wrong with a special register or relay that the simulated PLC does not serve: a program that waits
/// for it would wait for ever.
std::optional<ValueFault> unserved(const Operand& operand);

/// Whether an operand is of the kind that an instruction asks for (a letter of Mnemonic::operands), and fits
/// its range with all the words or bits that the instruction takes there; else what is wrong.
std::optional<ValueFault> misfit(const Operand& operand, char kind, const Spelling& spelling);

/// Whether there is such a device, or such bits; true for what is none.
bool exists(const Operand& operand);

/// I000, I001, I100 to I501: an edge of X0 to X5 comes, to OFF and to ON.
inline constexpr int interrupt_inputs = 6;
/// I010, I020 to I060: a DHSCS has come to its value.
constexpr bool is_counter_interrupt(int number) { return number >= 10 && number <= 60 && number % 10 == 0; }
/// Whether there is an interrupt of this number: one of those, or I610 to I699, I710 to I799, I810 to I899,
/// which come every 10 to 99 ms.
bool is_interrupt(int number);

/// What an operand of a kind may be, for messages: "D", "X, Y, M, S, T or C".
std::string_view operand_text(char kind);

}  // namespace drycut::devices::lx3vp::il
