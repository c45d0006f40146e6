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
/// Which devices of its letter there are: "there are D0 to D8255".
std::string devices_text(const Operand& operand);

/// Whether a kind of operand is written by its instruction.
bool is_written(char kind);
/// How many devices an operand stands for: words of D, or bits.
int extent_of(const Operand& operand, char kind, bool wide);
/// What is wrong with writing so many devices from an operand on: the PLC writes one of them itself.
std::optional<ValueFault> read_only(const Operand& operand, int count, const Spelling& spelling);

/// From one value to the next in an operand's devices, where it stands for several.
int stride_of(const Operand& first, bool wide);
/// Whether so many values from an operand on exist.
bool has_values(const Operand& first, int count, bool wide);

// il_numbers.cpp

/// Whether a step may have this number where its instruction has a range.
bool is_in(const NumberRange& range, const Step& step, std::int64_t number);
/// "write 0 to 15".
std::string remedy_of(const NumberRange& range, const Step& step);

/// A fault of a step's operands, and at which of them.
struct Misfit {
  std::size_t operand = 0;
  ValueFault fault;
};
/// What is wrong with the operands of a step that fit each alone: constants out of their range, what does not
/// go together, special registers that are read only.
std::optional<Misfit> misfit_together(const Step& step);

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
