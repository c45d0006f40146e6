#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "devices/lx3vp/block.hpp"

namespace drycut::devices::lx3vp::il {

/// What an instruction does, as far as the compiler or the scan looks at it; the rest is its action.
enum class Op : std::uint8_t {
  // Contacts, each in three ways: see Mnemonic::join.
  on,
  off,
  rising,
  falling,
  equal,
  greater,
  less,
  unequal,
  less_or_equal,
  greater_or_equal,
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
  // Those with an action.
  action,
  zrst,
  shift,
  rotate,
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
inline bool is_contact(Op op) { return op <= Op::greater_or_equal; }
inline bool is_comparison(Op op) { return op >= Op::equal && op <= Op::greater_or_equal; }

/// How a contact joins what is before it.
enum class Join : std::uint8_t { begins, series, parallel };

class Call;
/// What an instruction does with its operands. Throws RuntimeError.
using Action = void (*)(Call& call);

/// The forms that an instruction has: 16 bits (n), 32 bits (w), in the scan of a rising edge only (p).
namespace form {
inline constexpr std::uint8_t n = 1;
inline constexpr std::uint8_t w = 2;
inline constexpr std::uint8_t p = 4;
inline constexpr std::uint8_t nw = n | w;
inline constexpr std::uint8_t np = n | p;
inline constexpr std::uint8_t wp = w | p;
inline constexpr std::uint8_t nwp = n | w | p;
}  // namespace form

/// One instruction of the list as the program's text names it. One table for the compiler, the tests and the
/// reader.
struct Mnemonic {
  std::string_view name;  ///< of the 16-bit form; the 32-bit one begins with D, the pulse form ends in P
  Op op = Op::nop;
  std::string_view operands;     ///< a letter each, see `operand_text` (il_operands.hpp)
  std::uint8_t forms = form::n;  ///< narrow, wide and pulse, one or more
  int steps = 1;                 ///< of program memory; the 32-bit form's if there is no other
  int wide_steps = 0;
  std::string_view meaning;
  Action action = nullptr;

  [[nodiscard]] bool has(std::uint8_t form) const { return (forms & form) != 0; }
  /// Of a contact: LD begins, AND is in series, OR in parallel.
  [[nodiscard]] Join join() const {
    return name[0] == 'L' ? Join::begins : name[0] == 'A' ? Join::series : Join::parallel;
  }
};

/// All instructions, in the order of a reference.
std::span<const Mnemonic> mnemonics();
// Its parts that have actions, each with what they do.
std::span<const Mnemonic> word_mnemonics();   ///< il_words.cpp
std::span<const Mnemonic> shift_mnemonics();  ///< il_shifts.cpp
std::span<const Mnemonic> real_mnemonics();   ///< il_reals.cpp

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

}  // namespace drycut::devices::lx3vp::il
