#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/problem.hpp"
#include "devices/lx3vp/il_mnemonics.hpp"

namespace drycut::devices::lx3vp::il {

// A controller program as a text of instructions, with the mnemonics of the FX family that the LX3V has: one
// instruction a line, operands behind it, comments behind ; or //. `LD X0`, `OUT T0 K10`, `DMOV K50000
// D2044`. Step numbers before it, brackets around it and the tables that editors export are read too
// (il_lines.hpp).

/// What an operand names: devices, labels and nestings have their letters.
enum class Kind : char {
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
  nesting = 'N',
  constant = 'K',
  real = 'E',
  bits = '#',     ///< a group: K4M0
  word_bit = '.'  ///< D10.F
};
constexpr char letter_of(Kind kind) { return static_cast<char>(kind); }

/// A checked operand.
struct Operand {
  Kind kind = Kind::constant;
  Kind of = Kind::M;         ///< bits: of which devices
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

/// One instruction.
struct Step {
  const Spelling* spelling = nullptr;  ///< nullptr: a label
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

  [[nodiscard]] Op op() const { return spelling == nullptr ? Op::label : spelling->mnemonic->op; }
  /// Letter of Mnemonic::operands; of the set value of a timer or a counter, which stands behind them, v.
  [[nodiscard]] char kind(std::size_t operand) const {
    const auto kinds = spelling == nullptr ? "P" : spelling->mnemonic->operands;
    return operand < kinds.size() ? kinds[operand] : 'v';
  }
  [[nodiscard]] bool wide() const { return spelling != nullptr && spelling->wide; }
};

/// A compiled program: runs by `Scanner` (il_scan.hpp).
struct Program {
  std::string file;
  std::string text;
  std::vector<Step> steps;
  int memories = 0;          ///< edge memories
  int size = 0;              ///< steps of program memory
  std::vector<bool> states;  ///< S0..S999: those that have an STL
};

/// Compiles a text. Every fault becomes a problem; the program is only to be run if there was none.
Program compile(std::string_view text, const std::string& file, Problems& problems);

/// "D100", "X17", "K4M0", "H1F", "D10Z0"; as the text would have it.
std::string to_string(const Operand& operand);

}  // namespace drycut::devices::lx3vp::il
