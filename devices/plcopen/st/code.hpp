#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "devices/plcopen/st/program.hpp"
#include "devices/plcopen/st/runtime.hpp"
#include "devices/plcopen/st/types.hpp"

// A compiled program: instructions over a flat memory of cells. Variables are places in that memory: those of
// VAR_GLOBAL and of FUNCTIONs (which cannot call themselves) at fixed places, those of a PROGRAM or a
// function block from the beginning of its instance on.
namespace drycut::devices::plcopen::st {

/// What a node of the tree (nodes.hpp) does; `a`, `b`, `c` are nodes unless it says otherwise. Instructions
/// are of these too, and of those at the end: see StInstruction.
enum class StOp : std::uint8_t {
  nothing,  ///< a statement

  // Values.
  constant,  ///< imm
  load,      ///< the cell at imm
  load_own,  ///< the cell at imm of the block's own instance
  load_at,   ///< the cell at address a
  /// POU c; from list a on: how many inputs, for each its node, its place and the cells to copy (1: a value,
  /// -n: n cells from the address that the node is, 2 + n: a STRING of n characters), how many outputs, and
  /// their statements. b: where a result of imm cells is copied to, an address that is the value then; or -1.
  call_function,
  /// The same of a method: in front of the list are the instance and the method's number, by which the kind
  /// of
  /// the instance has it; -1: POU c whatever the instance is.
  call_method,
  instance,  ///< where that is which the interface a stands for
  /// EN, list from a on: the condition, the value if it holds, the value if it does not, what stores ENO in
  /// either case (-1: nothing).
  enabled,

  // Addresses.
  address,       ///< imm
  address_own,   ///< imm in the block's own instance
  address_pool,  ///< imm among literals and scratch; an `address` once compiled
  follow,        ///< imm behind the address that the cell at address a holds: VAR_IN_OUT
  dereference,   ///< imm behind what the reference a is of, which must be of the type of Referent c
  element,       ///< imm behind element b of the array at address a; c its Span
  index,         ///< index a less the lower bound b; the upper bound is c

  // Values by references.
  make_reference,  ///< to the address a, Referent c
  load_by,         ///< the value of type `basic` that the reference a is at
  store_by,        ///< value b, a statement

  // Of the values of a and b, without effects; `basic` is the result's type.
  add,
  subtract,
  multiply,
  divide,
  modulo,
  negate,
  add_real,
  subtract_real,
  multiply_real,
  divide_real,
  negate_real,
  scale_time,   ///< TIME a times LREAL b
  divide_time,  ///< TIME a by LREAL b
  bit_and,
  bit_or,
  bit_xor,
  bit_not,
  equal,
  not_equal,
  less,
  less_equal,
  greater,
  greater_equal,
  equal_real,
  not_equal_real,
  less_real,
  less_equal_real,
  greater_real,
  greater_equal_real,
  shift_left,
  shift_right,
  rotate_left,
  rotate_right,
  wrap,              ///< a whole number into the width of `basic`
  to_real,           ///< a whole number to REAL or LREAL
  unsigned_to_real,  ///< ULINT or LWORD to REAL or LREAL
  seconds_of_day,    ///< of a DT
  bits_to_real,      ///< the bits of a DWORD or LWORD as those of a REAL or LREAL
  real_to_bits,
  round_real,  ///< LREAL to REAL
  to_whole,    ///< to the nearest whole number, halves to the even one
  truncate,    ///< towards zero
  valid_real,  ///< to BOOL: finite
  valid_bcd,   ///< to BOOL: all digits are 0 to 9
  swap_bytes,  ///< the first byte becomes the last one
  floor,       ///< of real numbers
  ceiling,
  nonzero,       ///< a whole number to BOOL
  nonzero_real,  ///< REAL or LREAL to BOOL
  absolute,
  absolute_real,
  square_root,
  sine,
  cosine,
  tangent,
  arc_sine,
  arc_cosine,
  arc_tangent,
  arc_tangent_2,
  exponential,
  logarithm,
  logarithm_10,
  power,
  minimum,
  maximum,
  minimum_real,
  maximum_real,

  // Values that need more than a and b.
  and_then,
  or_else,
  select,           ///< b if a, else c
  multiplex,        ///< input a of c inputs from list b on
  compare_strings,  ///< -1, 0, 1 for the strings at addresses a and b
  text,             ///< TextOp imm of b nodes from list a on
  in_range,         ///< value a, which must lie in the Span c
  time_now,         ///< of the controller, [ns] of an LTIME, else [ms]
  /// AssertEquals and its like: Assertion imm; from list a on the nodes of what is expected, what is, how far
  /// they may lie apart, and the address of a text.
  assertion,
  passes,  ///< FOR: a is not yet beyond b with step c

  // Statements.
  evaluate,     ///< a value that nobody wants
  store,        ///< value a to the cell at imm
  store_own,    ///< value a to the cell at imm of the own instance
  store_at,     ///< value b to the cell at address a
  store_bits,   ///< value b into c bits, from bit imm on, of the cell at address a
  copy,         ///< imm cells from address b to address a
  copy_string,  ///< from address b to address a, imm characters at most
  sequence,     ///< b statements from list a on
  call_block,   ///< the instance at address a: POU b, or a motion block if b < 0
  branch,       ///< b conditions and bodies from list a on, c the ELSE or -1
  choose,       ///< CASE a: c Choices from b on, imm the ELSE or -1
  loop,         ///< while a: b, then c (-1: nothing)
  repeat,       ///< a until b
  leave_loop,
  next_turn,
  leave_pou,

  // Of instructions only.
  move,
  fetch,
  put,
  place,
  call_motion,
  turn,
  jump,
  jump_if,
  jump_unless,
  unless_equal,  ///< from here on in the order of the comparisons
  unless_not_equal,
  unless_less,
  unless_less_equal,
  unless_greater,
  unless_greater_equal,
  unless_equal_real,
  unless_not_equal_real,
  unless_less_real,
  unless_less_equal_real,
  unless_greater_real,
  unless_greater_equal_real,
};
inline constexpr StOp last_op = StOp::unless_greater_equal_real;

/// Functions of texts. A text is an address; where the result is one, the first node is where it goes.
enum class TextOp : std::uint8_t {
  left,
  right,
  mid,
  concat,
  insert,
  erase,
  replace,
  from_value,  ///< of the node's `basic`
  length,      ///< from here on the result is a number
  find,
  to_value,  ///< of the node's `basic`
};
/// How many of the inputs are texts; behind them stand numbers.
constexpr std::size_t texts_of(TextOp op, std::size_t inputs) {
  if (op == TextOp::concat) return inputs;
  return op == TextOp::insert || op == TextOp::replace || op == TextOp::find ? 2 : 1;
}

/// What tests say: of two values of the type `basic`; what they are called; that they have come to their end.
enum class Assertion : std::uint8_t { equal, title, finished };

/// Bounds of an array and the size of its elements.
struct Span {
  std::int64_t low = 0;
  std::int64_t high = 0;
  int cells = 0;
  std::int64_t behind = 0;  ///< in instructions: cells behind the array's beginning
};

/// What references are of: see references.hpp.
struct Referent {
  const Type* type = nullptr;
  Basic basic = Basic::unknown;  ///< of all its values, if they are of one elementary type or characters
  int cells = 0;
};

/// One label of a CASE.
struct Choice {
  Subrange range;
  int body = -1;  ///< a node; in instructions where they go on
};

/// Where cells of operands are counted from.
enum class Base : std::uint32_t { memory, own, temporary, constant };
/// Where a value of the instructions is; or a number as it is, of the base `memory`.
struct StOperand {
  std::uint32_t cells = 0;
  Base base = Base::memory;
};
inline bool operator==(const StOperand& a, const StOperand& b) {
  return a.cells == b.cells && a.base == b.base;
}
/// In one number, as lists have it.
constexpr int base_shift = 28;
constexpr int packed(const StOperand& of) {
  return static_cast<int>(of.cells | static_cast<std::uint32_t>(of.base) << base_shift);
}
constexpr StOperand unpacked(int number) {
  const auto bits = static_cast<std::uint32_t>(number);
  return {bits & ((1U << base_shift) - 1), static_cast<Base>(bits >> base_shift)};
}

/// One step of the machine. Most put into the cell `a` what comes of the cells `b` and `c`; of an operation
/// without effects `op` is that itself. The others:
///
/// assertion: Assertion b, its operands in list d; a becomes whether it holds.
/// move, time_now: b, the time. place: the place of the cell b. fetch: the cell d behind the address b. put:
/// b into the cell d behind the address a. follow: d behind the address b. element: element c of the array at
/// the address b, d its Span. dereference: d behind what the reference b is of, Referent c. make_reference:
/// to the address b, Referent d. load_by: by the reference b. store_by: b by the reference a. instance: what
/// the interface b stands for. index: b less the bound c, the upper one in the cell d. select: b if the cell
/// d holds, else c. compare_strings, passes: as the node, its step in the cell d. in_range: b in Span d.
/// text: TextOp b, whose texts and numbers stand in list d behind their number and whether they are WSTRINGs.
/// store_bits: b into c bits from bit d on at the address a. copy: d cells from the address b to a.
/// copy_string: from the address b to a, d bytes at most, and c - 1 characters of a WSTRING. call_function,
/// call_method: list d has the instance and the method's number of a method, then the POU, how many inputs,
/// and for each its cell, its place and the cells to copy (as in the node); c cells of the result go to the
/// address b, if any. call_block: POU d at the address a. call_motion: the block that begins at the cell a;
/// with c the one at the address a.
///
/// jump: on at d. jump_if, jump_unless: if the cell a holds, or does not; unless_...: unless b compares so
/// with c. choose: where one of c Choices from b on says by the value a, else at d. multiplex: where list d
/// says, of c. turn: a loop begins anew. leave_pou. nothing.
struct StInstruction {
  StOp op = StOp::nothing;
  Basic basic = Basic::unknown;
  bool statement = false;  ///< one begins here
  int d = 0;
  StOperand a;
  StOperand b;
  StOperand c;
};

/// What the text has to an instruction.
struct Origin {
  int node = 0;
  int line = 0;
  int column = 0;
  int statement = 0;        ///< line of the one that begins here; 0 in standard blocks
  bool shown = false;       ///< that line has been come by then; it has no condition
  bool standard = false;    ///< it is none of the text
  bool right_side = false;  ///< it stands right of an AND or OR, which take both sides
  /// It decides a condition: by its jump to FALSE, and as the last of several by going on to TRUE.
  enum class Condition : std::uint8_t { none, part, last } condition = Condition::none;
  int decision = -1;  ///< it jumps where this condition of the text does not hold; they are counted up
};

/// A body: of a PROGRAM, a FUNCTION or a user's function block.
struct Pou {
  int body = -1;   ///< a node; then where its instructions begin
  int frame = 0;   ///< where the variables of a FUNCTION are
  int result = 0;  ///< FUNCTION: offset of its result
  int unfit = -1;  ///< standard FUNCTION: offset of what tells that its inputs do not fit, or -1
  std::vector<Subrange> resets;  ///< offsets that get their initial values at each call, the last included
  const Type* type = nullptr;
  std::string name;  ///< with its block's, of a method
  int line = 0;      ///< of the name in the text; 0: a standard block, or nothing
};

/// Where a symbol's cell is.
struct SymbolPlace {
  int cell = 0;
  Basic basic = Basic::unknown;
};

struct Compiled {
  std::vector<Program::Name> externals;
  std::vector<int> external_cells;
  std::vector<Program::Located> located;
  std::vector<SymbolPlace> located_cells;
  std::vector<Program::InMemory> in_memory;
  std::vector<Program::Name> tables;

  std::vector<std::unique_ptr<Type>> types;
  std::vector<StInstruction> code;
  std::vector<Origin> origins;  ///< one an instruction
  std::vector<Cell> constants;
  std::size_t temporaries = 0;  ///< cells that a body needs at most
  std::vector<int> lists;
  std::vector<Span> spans;
  std::vector<Choice> choices;
  std::map<std::pair<Cell, int>, int> methods;  ///< POUs by the kind of an instance and the method's number
  std::vector<Referent> referents;
  std::vector<Basic> kinds;  ///< of each cell of plain data, if there are references; else `unknown`
  std::vector<Pou> pous;
  /// A PROGRAM with variables of its own.
  struct Instance {
    int pou = -1;
    int cell = 0;     ///< where its variables are
    int before = -1;  ///< statements that give its inputs, and take its outputs; as Pou::body
    int after = -1;
  };
  std::vector<Instance> instances;  ///< as Program::instances
  std::vector<Program::Instance> instance_names;
  /// With CompileOptions::tests, whose units are the instances.
  struct Test {
    std::string name;
    int line = 0;
    std::size_t instance = 0;
    int method = -1;        ///< POU; -1: the body of the instance
    bool finishes = false;  ///< it says when it has come to its end
  };
  std::vector<Test> tests;
  std::vector<Program::Task> tasks;
  bool configured = false;       ///< there is a CONFIGURATION
  std::vector<int> singles;      ///< for each task the cell of its SINGLE, or -1
  std::vector<Cell> image;       ///< the memory with all initial values
  std::vector<Subrange> retain;  ///< cells, the last included
  struct Motion {
    int cell = 0;  ///< where the instance begins
    const Type* type = nullptr;
  };
  std::vector<Motion> motions;
  std::vector<StSymbol> symbols;
  std::vector<SymbolPlace> places;
  std::size_t longest_bytes = 255;  ///< of such a text
  std::size_t longest_text =
      255;  ///< characters that functions of STRING give: of the longest that is declared

  /// What is no fault and hardly meant.
  struct Doubt {
    Code code;
    int line = 0;
    int column = 0;
    std::string text;
    std::string value;  ///< which it holds for unless that is set from outside; "" = always
  };
  std::vector<Doubt> doubts;

  // For whoever watches it.
  std::vector<SourceFile> files;
  SourceLines lines;
  /// A PROGRAM or a block that runs, and what stands before the names of its variables: "", "Main.".
  struct Scope {
    std::string pou;
    std::string prefix;
  };
  std::vector<Scope> scopes;
};

/// The result of an operation without effects, Op::add to Op::maximum_real, in its type. Whole numbers wrap
/// in their width, REALs are rounded to single precision. What `no_result` tells is the caller's to refuse.
Cell apply(StOp op, Basic basic, Cell a, Cell b);
inline bool is_pure(StOp op) { return op >= StOp::add && op <= StOp::maximum_real; }

struct NoResult {
  Code code;
  Prose what;
  Prose remedy;
};
/// Why an operation without effects has no finite result where PLC run-times raise an exception: a division
/// by 0, SQRT, LN, LOG, ASIN, ACOS outside of what they take, a power or EXP beyond the type `basic`. Sums
/// and products of real numbers may become infinite.
std::optional<NoResult> no_result(StOp op, Basic basic, Cell a, Cell b);

/// What `result`, which apply() gave for `before`, has lost of it: "300 does not fit in SINT, which makes 44
/// of it"; nothing if it has not. BYTE to LWORD and the parts of numbers take the lower bits by intention.
std::optional<std::string> loss_of(StOp op, Basic basic, Cell before, Cell result);

// The functions of STRING as CODESYS has them: places count from 1, and what lies outside of a text is cut
// off.

/// LEFT, RIGHT, MID, CONCAT, INSERT, DELETE and REPLACE of one or more texts; `numbers` are L and P as far as
/// the function has them.
std::string edited(TextOp op, std::span<const std::string_view> texts, std::span<const Cell> numbers);
/// Of a WSTRING those of its UTF-8, else bytes.
std::size_t characters(std::string_view text, bool wide);
/// The first so many characters of a WSTRING.
std::string_view first_characters(std::string_view text, std::size_t count);
/// What `edited` counts in bytes where the program counts in characters.
std::vector<Cell> in_bytes(TextOp op, std::string_view text, std::span<const Cell> numbers);
/// Where `wanted` begins in `text`, from 1; 0 if nowhere.
Cell found(std::string_view text, std::string_view wanted);
/// '5', '-1.5', 'TRUE', 'T#1s500ms', 'D#1996-08-15': X_TO_STRING.
std::string text_of(Basic basic, Cell value);
/// The number, time or date that the text begins with, else 0: STRING_TO_X.
Cell value_of(Basic basic, std::string_view text);

}  // namespace drycut::devices::plcopen::st
