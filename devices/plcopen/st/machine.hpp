#pragma once
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "devices/plcopen/st/code.hpp"

namespace drycut::devices::plcopen::st {

/// An error of a program while it runs; told as Runtime::fault.
struct StError : std::runtime_error {
  StError(const Node& at, const std::string& text)
      : std::runtime_error(text), line(at.line), column(at.column) {}
  int line;
  int column;
};

/// What has been executed, for whoever watches it.
struct Trace {
  /// A letter a line of the text: '+' executed, a condition with its result '+' or '-', ' ' not come by.
  std::string lines;
  /// The line of each statement in the order of their execution, as far as there is room; nullptr: not kept.
  std::vector<int>* order = nullptr;
};

/// The memory of a program and what runs on it.
class Machine {
 public:
  /// Work of one program in one scan above which it is taken for endless: each operation, statement and call
  /// is 1, and so are eight cells or characters that are copied.
  static constexpr std::int64_t most_work = 10'000'000;

  Machine(const Compiled& code, MotionKernel& kernel);

  /// Initial values and new motion blocks; RETAIN variables keep theirs unless `all`.
  void start(bool all);
  /// Runs one program once; throws RuntimeError.
  void run(const Compiled::Instance& program, std::int64_t time_ms);

  /// What is executed from now on goes there; nullptr: nowhere, and costs nothing.
  void trace(Trace* to) { trace_ = to; }

  /// Statements executed so far, each round of a loop one more.
  [[nodiscard]] std::int64_t statements() const { return statements_; }

  [[nodiscard]] Cell cell(int place) const { return memory_[static_cast<std::size_t>(place)]; }
  /// The motion block with this cell among its pins.
  [[nodiscard]] const FunctionBlock* motion_at(int place) const;
  void set_cell(int place, Cell value) { memory_[static_cast<std::size_t>(place)] = value; }

  /// A value that did not fit where it was put; told once for each place of the text.
  struct Loss {
    int line = 0;
    int column = 0;
    std::string text;
  };
  /// Those since it was asked last.
  std::vector<Loss> take_losses() { return std::exchange(losses_, {}); }

  /// Between two runs.
  void visit(StateArchive& archive);

 private:
  enum class Flow : std::uint8_t { next, leave_loop, next_turn, leave_pou };
  struct Motion {
    std::unique_ptr<FunctionBlock> block;
    std::vector<PinValue> pins;
    const Type* type = nullptr;

    void visit(StateArchive& archive);
  };

  [[nodiscard]] const Node& node(int number) const { return code_.nodes[static_cast<std::size_t>(number)]; }
  [[nodiscard]] Cell& at(std::int64_t place) { return memory_[static_cast<std::size_t>(place)]; }
  Cell value(int number);
  Cell operation(const Node& node);
  Cell multiplex(const Node& node);
  /// Tells what was lost in an operation, if anything was.
  void look_at(const Node& node, Cell before, Cell result);
  void tell_loss(const Node& node, std::string text);
  [[nodiscard]] std::string_view whole_text(std::int64_t place) const { return text(place, longest_bytes()); }
  std::int64_t element(const Node& node);
  std::int64_t dereference(const Node& node);
  /// The first of the cells that a value of `node` by a reference lies in, and how many bytes behind.
  std::pair<const Referent*, Cell*> seen_by(const Node& node, Cell reference, std::int64_t& bytes);
  Cell call_function(const Node& node);
  Cell call_method(const Node& node);
  Cell call_framed(const Node& node, const int* list, int number, std::int64_t own);
  Cell enabled(const Node& node);
  Cell in_range(const Node& node);
  Cell passes(const Node& node);
  Cell text_value(const Node& node);
  Cell compare(const Node& node);
  /// Gives a POU's variables at `frame` that do not outlast a call their initial values.
  void reset(const Pou& pou, std::int64_t frame);
  /// Of what functions of texts give; a WSTRING has up to four a character.
  [[nodiscard]] std::size_t longest_bytes() const { return code_.longest_bytes; }
  [[nodiscard]] std::string_view text(std::int64_t place, std::size_t most) const;

  void note(int number, char mark);
  void note_turn(int number);
  Flow execute(int number);
  Flow sequence(const Node& node);
  Flow branch(const Node& node);
  Flow choose(const Node& node);
  Flow loop(const Node& node, int number);
  Flow repeat(const Node& node, int number);
  void call_block(const Node& node);
  void call_motion(std::int64_t instance);
  void store_bits(const Node& node);
  void copy_string(std::int64_t from, std::int64_t to, std::size_t length);
  void put_string(std::string_view text, std::int64_t to, std::size_t length);
  /// Looked at by the next statement, so that it is statements that are told of.
  void charge(std::int64_t work) { work_ -= work; }
  void spend(const Node& node, std::int64_t work) {
    if ((work_ -= work) < 0) exhausted(node);
  }
  [[noreturn]] static void exhausted(const Node& node);

  const Compiled& code_;
  MotionKernel& kernel_;
  std::vector<Cell> memory_;
  std::vector<Motion> motions_;
  std::vector<Loss> losses_;
  std::set<int> told_;        ///< nodes whose loss has been told
  std::vector<bool> active_;  ///< methods that run
  std::int64_t own_ = 0;      ///< where the instance begins whose block runs
  std::int64_t time_ms_ = 0;
  std::int64_t work_ = 0;  ///< that is left in this scan
  std::int64_t statements_ = 0;
  Trace* trace_ = nullptr;
};

}  // namespace drycut::devices::plcopen::st
