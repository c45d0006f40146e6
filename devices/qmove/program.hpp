#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "devices/qmove/cnf.hpp"
#include "devices/qmove/symbols.hpp"

namespace drycut::devices::qmove {

/// What an instruction does. Expressions work on a stack of 32-bit cells; whether a cell holds a long or a
/// single is known when compiling. "a, b" are the instruction's operands, top is the top of the stack.
enum class Op : std::uint8_t {
  // Values.
  push,          ///< push a (for a single: its bits)
  load,          ///< push cell a
  load_at,       ///< top = cell[top]
  index,         ///< top = cell number a + top - 1; top must be 1..b, else error 3
  index_recipe,  ///< the same, else error 4
  index_step,    ///< recipe, step on the stack -> cell number in group variable a; errors 4, 5
  load_device,   ///< push symbol a of device b
  load_input,    ///< push level of input a
  load_output,   ///< push level of output a
  load_timer,    ///< push 1 if timer a has elapsed
  // Stores; the size says how the value wraps.
  store,         ///< cell a = top, wrapped to size b
  store_at,      ///< cell[second] = top, wrapped to size b
  store_device,  ///< write symbol a of device b
  store_output,  ///< output a = top != 0
  store_timer,   ///< start timer a for top ms
  // Arithmetic on longs (wrapping) and on singles.
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
  to_real,             ///< top = single(top)
  to_real_below,       ///< second = single(second)
  to_long,             ///< top = long(top), truncated
  to_flag_real,        ///< top = top != 0.0
  to_flag_real_below,  ///< second = second != 0.0
  // Comparisons give 0 or 1.
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
  // Logic on 0 / not 0, and on bits.
  logic_and,
  logic_or,
  logic_not,
  bit_and,
  bit_or,
  bit_xor,
  bit_not,
  // Control.
  barrier,  ///< a read of device b: wait for its sample if something is posted; a = 1: the statement's last
  jump,     ///< go on at a
  jump_if_zero,  ///< the same if top is 0
  command,       ///< give command a to device b
  yield,         ///< end the turn
  wait_until,    ///< if top is 0: end the turn, go on at a at the next one
  call,          ///< go on at a until `back`
  back,          ///< return from call
  end,           ///< the task ends
};

struct Instruction {
  Op op = Op::end;
  std::int32_t a = 0;
  std::int32_t b = 0;
};

/// A compiled module: one task of the controller.
struct Program {
  std::string name;  ///< the file's name without folder and extension
  std::string file;  ///< for messages
  std::string text;
  std::vector<Instruction> code;
  std::vector<int> lines;          ///< line of each instruction
  std::vector<bool> begins;        ///< whether a statement begins there, or another look at a WAIT or FOR
  std::vector<Symbol> symbols;     ///< device symbols that instructions refer to
  std::vector<NamedThing> steps;   ///< group variables that index_step refers to
  std::vector<std::string> notes;  ///< what a reader should know that is no fault: "file:line:column: ..."
};

/// Deepest nesting of an expression, and of the stack that evaluates it.
inline constexpr int max_depth = 64;
/// Deepest nesting of CALL; one more is error 9.
inline constexpr int max_calls = 32;

/// Compiles a QCL module (spec qem.md §4) against its configuration. All faults of the text are appended to
/// `problems` in order; a module with faults has no code.
Program compile_module(std::string_view text, const std::string& file_name,
                       const Configuration& configuration, std::span<const CatalogueEntry> catalogue,
                       Problems& problems);

}  // namespace drycut::devices::qmove
