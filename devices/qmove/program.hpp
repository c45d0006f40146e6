#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "devices/qmove/cnf.hpp"

namespace drycut::devices::qmove {

/// What a name of the configuration stands for, and where its value lives.
struct NamedThing {
  enum class Kind : std::uint8_t {
    constant,
    scalar,
    array,         ///< name[1..length]
    group_static,  ///< name[1..recipes]
    group_step,    ///< name[1..recipes, 1..steps]
    group,         ///< the datagroup itself
    timer,
    input,
    output,
    device
  };
  Kind kind = Kind::scalar;
  std::string name;  ///< as declared
  Size size = Size::L;
  int index = 0;      ///< first memory cell, or number of the timer, input, output, device
  int length = 0;     ///< array length or recipes
  int steps = 0;      ///< steps of a group_step
  double value = 0;   ///< of a constant
  bool real = false;  ///< a constant written with a decimal point
};

/// "a timer", "an array" ... for messages.
std::string_view name_of(NamedThing::Kind kind);

/// The names of a configuration, any case, and the layout of the controller's memory: one cell a value,
/// first those that are zeroed at each start, then the retentive ones. The same configuration always gives
/// the same layout, so that modules are compiled apart from the controller that runs them.
class SymbolTable {
 public:
  explicit SymbolTable(const Configuration& configuration);
  [[nodiscard]] const NamedThing* find(std::string_view name) const;
  /// In the order of declaration.
  [[nodiscard]] const std::vector<NamedThing>& things() const { return things_; }
  [[nodiscard]] std::vector<std::string> names() const;
  [[nodiscard]] int cells() const { return cells_; }
  [[nodiscard]] int volatile_cells() const { return volatile_cells_; }

 private:
  void add(NamedThing thing);
  void add_values(const Configuration& configuration, bool retentive);

  std::vector<NamedThing> things_;
  std::map<std::string, std::size_t> by_name_;
  int cells_ = 0;
  int volatile_cells_ = 0;
};

/// Number of cells of an array or datagroup variable; 1 for a scalar.
int cell_count(const NamedThing& thing);

/// What an instruction does. Expressions work on a stack of 32-bit cells; whether a cell holds a long or a
/// single is known when compiling. "a, b" are the instruction's operands, top is the top of the stack.
enum class QclOp : std::uint8_t {
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
  assertion,     ///< if top is 0: a test has failed
};

struct Instruction {
  QclOp op = QclOp::end;
  std::int32_t a = 0;
  std::int32_t b = 0;
};

/// SUB name: where its code begins.
struct QclSub {
  std::string name;
  int line = 0;
  int code = 0;
};

/// A compiled module: one task of the controller.
struct QclProgram {
  std::string name;  ///< the file's name without folder and extension
  std::string file;  ///< for messages
  std::string text;
  std::vector<Instruction> code;
  std::vector<int> lines;         ///< line of each instruction
  std::vector<bool> begins;       ///< whether a statement begins there, or another look at a WAIT or FOR
  std::vector<Symbol> symbols;    ///< device symbols that instructions refer to
  std::vector<NamedThing> steps;  ///< group variables that index_step refers to
  std::vector<QclSub> subs;       ///< in the order of the text
  int start = 0;                  ///< the instruction at which the task begins
  std::vector<Finding> notes;     ///< what a reader should know that is no fault: "file:line:column: ..."
};

/// Deepest nesting of an expression, and of the stack that evaluates it.
inline constexpr int max_depth = 64;
/// Deepest nesting of CALL; one more is error 9.
inline constexpr int max_calls = 32;

/// Compiles a QCL module (spec qem.md §4) against its configuration. All faults of the text are appended to
/// `problems` in order; a module with faults has no code. With `tests` what tests assert is compiled, too,
/// which are comments to a controller: see tests.hpp.
QclProgram compile_module(std::string_view text, const std::string& file_name,
                          const Configuration& configuration, std::span<const CatalogueEntry> catalogue,
                          Problems& problems, bool tests = false);

/// The text with the assertions in TEST_ subroutines as statements: the `;` before each is a blank.
std::string with_assertions(std::string_view text);
/// Notes comments in TEST_ subroutines that begin with nearly ASSERT.
void note_misspelt_assertions(QclProgram& program);

}  // namespace drycut::devices::qmove
