#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "devices/lx3vp/block.hpp"

namespace drycut::devices::lx3vp::il {

/// What an instruction does. Contacts come in the order LD, AND, OR: `Op::and_` of a kind is `Op::ld` + 1.
enum class Op : std::uint8_t {
  // Contacts.
  ld,
  and_,
  or_,
  ldi,
  ani,
  ori,
  ldp,
  andp,
  orp,
  ldf,
  andf,
  orf,
  // Comparisons as contacts.
  ld_equal,
  and_equal,
  or_equal,
  ld_gt,
  and_gt,
  or_gt,
  ld_lt,
  and_lt,
  or_lt,
  ld_unequal,
  and_unequal,
  or_unequal,
  ld_le,
  and_le,
  or_le,
  ld_ge,
  and_ge,
  or_ge,
  // Connections.
  anb,
  orb,
  mps,
  mrd,
  mpp,
  inv,
  // Coils.
  out,
  set,
  rst,
  pls,
  plf,
  zrst,
  alt,
  // Words.
  mov,
  cml,
  bmov,
  fmov,
  xch,
  add,
  sub,
  mul,
  div,
  inc,
  dec,
  neg,
  wand,
  wor,
  wxor,
  cmp,
  zcp,
  // Shifts and conversions.
  sftl,
  sftr,
  rol,
  ror,
  bcd,
  bin,
  mean,
  sqr,
  // Floating point.
  flt,
  int_,
  emov,
  eadd,
  esub,
  emul,
  ediv,
  ecmp,
  ezcp,
  // Pulses and cams.
  plsv,
  drvi,
  drva,
  plsy,
  zrn,
  decam,
  ecamtbx,
  // Flow.
  mc,
  mcr,
  stl,
  ret,
  for_,
  next,
  cj,
  call,
  sret,
  label,
  nop,
  fend,
  end
};

/// One instruction of the list as the program's text names it. One table for the compiler, the tests and the
/// reader.
struct Mnemonic {
  std::string_view name;  ///< of the 16-bit form; the 32-bit one begins with D, the pulse form ends in P
  Op op = Op::nop;
  std::string_view operands;  ///< a letter each, see `operand_text`
  std::uint8_t forms = 1;     ///< narrow | wide | pulse
  int steps = 1;              ///< of program memory; the 32-bit form's if there is no other
  int wide_steps = 0;
  std::string_view meaning;

  static constexpr std::uint8_t narrow = 1;
  static constexpr std::uint8_t wide = 2;
  static constexpr std::uint8_t pulse = 4;
  [[nodiscard]] bool has(std::uint8_t form) const { return (forms & form) != 0; }
};

/// All instructions, in the order of a reference.
std::span<const Mnemonic> mnemonics();

/// Where no manual of the unit is at hand and the FX family's conventions, or a choice of ours, stand in.
std::span<const Reading> instruction_readings();

/// A mnemonic as it is written: "DMOVP" is MOV, wide, pulse.
struct Spelling {
  std::string text;
  const Mnemonic* mnemonic = nullptr;
  bool wide = false;
  bool pulse = false;
};
/// Every spelling there is, in the order of the table.
const std::vector<Spelling>& spellings();
/// The spelling, any case, or nullptr.
const Spelling* find_spelling(std::string_view text);

/// Whether the real unit has such an instruction (any case, with D before or P behind it) that is not
/// simulated.
bool is_not_simulated(std::string_view text);

/// What an operand of a kind may be, for messages: "D", "X, Y, M, S, T or C".
std::string_view operand_text(char kind);

}  // namespace drycut::devices::lx3vp::il
