#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "devices/lx3vp/il_program.hpp"

namespace drycut::devices::lx3vp::il {

/// What is wrong with an operand, and what would be right.
struct OperandFault {
  std::string what;
  std::string remedy;
};

/// Reads an operand: a device in its range, a number or a label. A fault is told in `fault`.
std::optional<Operand> read_operand(std::string_view text, OperandFault& fault);

/// Whether an operand is of the kind that an instruction asks for (a letter of Mnemonic::operands), and fits
/// its range with all the words or bits that the instruction takes there; else what is wrong.
std::optional<OperandFault> misfit(const Operand& operand, char kind, const Spelling& spelling);

/// Whether there is such a device, or such bits; true for what is none.
bool exists(const Operand& operand);

/// Words or bits that an instruction takes from an operand on: 1, 2 or more.
int extent(char kind, const Spelling& spelling);

}  // namespace drycut::devices::lx3vp::il
