#pragma once
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/problem.hpp"
#include "devices/lx3vp/registers.hpp"

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
  block,
  wdt,
  ref,
  // Pulses and cams.
  plsv,
  drvi,
  drva,
  plsy,
  plsr,
  pwm,
  zrn,
  hscs,
  hscr,
  hsz,
  spd,
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
  iret,
  ei,
  di,
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

/// What an operand's number may be, where it is less than it can hold: a constant is judged as the program is
/// read, a register as it runs.
struct NumberRange {
  std::size_t operand = 0;
  std::string_view name;  ///< "the time S1"
  std::int32_t least = 0;
  std::int32_t most = std::numeric_limits<std::int32_t>::max();
  std::int32_t wide_most = 0;    ///< of the 32-bit form; 0: the same
  std::string_view counts = {};  ///< operands, a digit each, of which it takes so many devices
  bool powers = false;           ///< of bits 2^n of them, of a word those that it has
};

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
  std::span<const NumberRange> ranges = {};

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
std::span<const Mnemonic> data_mnemonics();   ///< il_data.cpp
std::span<const Mnemonic> real_mnemonics();   ///< il_reals.cpp

/// Where no manual of the unit is at hand and the FX family's conventions, or a choice of ours, stand in.
std::span<const BlockReading> instruction_readings();

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

// A controller program as a text of instructions, with the mnemonics of the FX family that the LX3V has: one
// instruction a line, operands behind it, comments behind ; or //. `LD X0`, `OUT T0 K10`, `DMOV K50000
// D2044`. Step numbers before it, brackets around it and the tables that editors export are read too
// (il_lines.hpp).

/// What an operand names: devices, labels and nestings have their letters.
enum class OperandType : char {
  X = 'X',
  Y = 'Y',
  M = 'M',
  S = 'S',
  T = 'T',
  C = 'C',
  D = 'D',
  V = 'V',
  Z = 'Z',
  label = 'P',
  interrupt = 'I',  ///< label of an interrupt routine: I001
  nesting = 'N',
  constant = 'K',
  real = 'E',
  bits = '#',     ///< a group: K4M0
  word_bit = '.'  ///< D10.F
};
constexpr char letter_of(OperandType kind) { return static_cast<char>(kind); }

/// A checked operand.
struct Operand {
  OperandType kind = OperandType::constant;
  OperandType of = OperandType::M;  ///< bits: of which devices
  int number = 0;            ///< of the device (X and Y: decimal), first of the bits, of the label, of N
  int index = no_index;      ///< 0..7 V0..V7, 8..15 Z0..Z7: added to the number, of a constant to its value
  int count = 0;             ///< bits: groups of four, 1..8; word_bit: the bit, 0..15
  std::int32_t value = 0;    ///< constant
  bool hexadecimal = false;  ///< constant: a pattern of bits, H
  float real = 0;            ///< real
  int line = 0;              ///< in the text; a table has operands on lines of their own
  int column = 1;

  static constexpr int no_index = -1;
  static constexpr int first_z = 8;
};

/// How the scan carries a step out: the way is chosen when the program is compiled.
enum class Route : std::uint8_t {
  bit,      ///< a contact of a device that is no bit of a word, without edge and index
  contact,  ///< any other
  join,
  coil,
  action,  ///< does nothing without power: an action, SET or RST, not of the pulse form
  call,
  flow
};

/// One instruction.
struct Step {
  const Spelling* spelling = nullptr;  ///< nullptr: a label
  // Of it, at hand for the scan:
  Op code = Op::label;
  Join join = Join::begins;
  Route route = Route::flow;
  char letter = 0;  ///< of Route::bit, with its number
  int bit = 0;
  int skip = 0;  ///< of Route::action: place of the next step that is none
  std::vector<Operand> operands;
  int line = 0;
  int column = 1;
  int memory = -1;           ///< place among the program's edge memories, -1 = needs none
  int target = 0;            ///< place: of CJ and CALL their label, of FOR and NEXT each other, of STL what
                             ///< comes behind its state
  int depth = 0;             ///< FORs around it
  bool indexed = false;      ///< an operand has an index register
  int number = 0;            ///< of the first step of program memory, as D8069 tells it
  bool opens_block = false;  ///< LD and its kind: keeps the block before it for ANB, ORB

  void spell(const Spelling& as) {
    spelling = &as;
    code = as.mnemonic->op;
    join = as.mnemonic->join();
  }
  [[nodiscard]] Op op() const { return code; }
  /// Letter of Mnemonic::operands; of the set value of a timer or a counter, which stands behind them, v.
  [[nodiscard]] char kind(std::size_t operand) const {
    const auto kinds = spelling == nullptr ? "P" : spelling->mnemonic->operands;
    return operand < kinds.size() ? kinds[operand] : 'v';
  }
  [[nodiscard]] bool wide() const { return spelling != nullptr && spelling->wide; }
};

/// An interrupt routine.
struct InterruptRoutine {
  int number = 0;         ///< of its label: 1 of I001, 610 of I610
  std::size_t place = 0;  ///< of the label
};

/// A compiled program: runs by `ProgramScan` (il_scan.hpp).
struct IlProgram {
  std::string file;
  std::string text;
  std::vector<Step> steps;
  int memories = 0;                          ///< edge memories
  int size = 0;                              ///< steps of program memory
  std::vector<bool> states;                  ///< S0..S999: those that have an STL
  std::vector<InterruptRoutine> interrupts;  ///< by their labels' numbers
};

/// Compiles a text. Every fault becomes a problem; the program is only to be run if there was none.
IlProgram compile(std::string_view text, const std::string& file, Problems& problems);

/// "D100", "X17", "K4M0", "H1F", "D10Z0"; as the text would have it.
std::string to_string(const Operand& operand);

/// What is no fault in a program and hardly meant, "file:line:column: ..." each: a coil with two
/// OUT, or with OUT and SET; a type of cam that ECAMTBX does not know.
std::vector<Finding> doubts(const IlProgram& program);
/// A DECAM on another block than any ECAMTBX makes, where one makes a block that no DECAM runs; "" = none.
std::string strange_block(const IlProgram& program);

}  // namespace drycut::devices::lx3vp::il
