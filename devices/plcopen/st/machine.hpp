#pragma once
#include <array>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "devices/plcopen/st/code.hpp"

namespace drycut::devices {
struct Counts;
struct TestLog;
}  // namespace drycut::devices

namespace drycut::devices::plcopen::st {

/// An error of a program while it runs; told as Runtime::fault.
struct StError : std::runtime_error {
  StError(int in_line, int at_column, const std::string& text)
      : std::runtime_error(text), line(in_line), column(at_column) {}
  int line;
  int column;
};

/// What has been executed, for whoever watches it.
struct Trace {
  /// A letter a line of the text: '+' executed, a condition with its result '+' or '-', ' ' not come by.
  std::string lines;
  /// The line of each statement in the order of their execution, as far as there is room; nullptr: not kept.
  std::vector<int>* order = nullptr;
  Counts* counts = nullptr;  ///< of the instructions; nullptr: not counted
};

/// The memory of a program and what runs on it.
class Machine {
 public:
  /// Work of one program in one scan above which it is taken for endless: each instruction is 1, and so are
  /// eight cells or characters that are copied. Looked at where a loop begins anew, at calls and copies.
  static constexpr std::int64_t most_work = 10'000'000;

  Machine(const Compiled& code, MotionKernel& kernel);

  /// Initial values and new motion blocks; RETAIN variables keep theirs unless `all`.
  void start(bool all);
  /// Runs one program once; throws RuntimeError.
  void run(const Compiled::Instance& program, std::int64_t time_ns);
  /// The same of a test.
  void run(const Compiled::Test& test, std::int64_t time_ns);

  /// What is executed from now on goes there; nullptr: nowhere, and costs nothing.
  void trace(Trace* to) { trace_ = to; }

  /// What tests say goes there; nullptr: nowhere.
  void log_tests(TestLog* to) { test_log_ = to; }

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
  /// Where operands are, by their Base.
  using Bases = std::array<Cell*, 4>;
  static Cell& at(const Bases& bases, const StOperand& of) {
    return bases[static_cast<std::size_t>(of.base)][of.cells];
  }
  struct Motion {
    std::unique_ptr<FunctionBlock> block;
    std::vector<PinValue> pins;
    const Type* type = nullptr;

    void visit(StateArchive& archive);
  };

  [[nodiscard]] Cell& at(std::int64_t place) { return memory_[static_cast<std::size_t>(place)]; }
  [[nodiscard]] std::int64_t place_of(const Cell& cell) const { return &cell - memory_.data(); }
  [[nodiscard]] const Origin& origin(const StInstruction& of) const {
    return code_.origins[static_cast<std::size_t>(&of - code_.code.data())];
  }
  [[noreturn]] void fail(const StInstruction& at, const std::string& text) const;
  /// Of a value that the program may have meant to test left of an AND.
  [[noreturn]] void fail_value(const StInstruction& at, const std::string& text) const;
  [[noreturn]] void exhausted(const StInstruction& at) const;

  // machine.cpp
  /// Executes from instruction `first` on until it leaves the body; `own`: where the block's instance begins.
  void execute(int first, std::int64_t own);
  template <bool watched>
  void steps(int first, std::int64_t own);
  /// Gives a POU's variables at `frame` that do not outlast a call their initial values.
  void reset(const Pou& pou, std::int64_t frame);
  void charge(std::int64_t work) { work_ -= work; }
  void spend(const StInstruction& on, std::int64_t work) {
    if ((work_ -= work) < 0) exhausted(on);
  }
  void note(int line, char mark);
  void note_statement(const Origin& origin);

  // machine_values.cpp
  Cell operation(const StInstruction& of, Cell a, Cell b);
  /// Tells what was lost in an operation, if anything was.
  void look_at(const StInstruction& of, Cell before, Cell result);
  void tell_loss(const StInstruction& of, std::string text);
  /// The same of what was given to a standard FUNCTION.
  void tell_unfit(const StInstruction& call, const Pou& function);
  Cell element(const StInstruction& of, Cell array, Cell index) const;
  Cell index(const StInstruction& of, Cell value, Cell low, Cell high) const;
  Cell in_range(const StInstruction& of, Cell value) const;
  Cell dereference(const StInstruction& of, Cell value) const;
  /// The first of the cells that a value by a reference lies in, and how many bytes behind.
  std::pair<const Referent*, Cell*> seen_by(const StInstruction& by, Cell reference, std::int64_t& bytes);
  Cell compare(std::int64_t a, std::int64_t b);
  Cell text_value(const StInstruction& of, const Bases& bases);
  /// Of what functions of texts give; a WSTRING has up to four a character.
  [[nodiscard]] std::size_t longest_bytes() const { return code_.longest_bytes; }
  [[nodiscard]] std::string_view text(std::int64_t place, std::size_t most) const;
  [[nodiscard]] std::string_view whole_text(std::int64_t place) const { return text(place, longest_bytes()); }
  void store_bits(const StInstruction& of, Cell& whole, Cell part) const;
  void store_text(const StInstruction& of, std::int64_t to, std::int64_t from);
  void copy_string(std::int64_t from, std::int64_t to, std::size_t length);
  void put_string(std::string_view text, std::int64_t to, std::size_t length);

  // assertions.cpp
  Cell assertion(const StInstruction& of, const Bases& bases);

  // machine_calls.cpp
  Cell call_function(const StInstruction& of, const Bases& bases);
  Cell call_method(const StInstruction& of, const Bases& bases);
  Cell call_framed(const StInstruction& of, const Bases& bases, const int* list, int number,
                   std::int64_t own);
  void call_block(const StInstruction& of, std::int64_t instance);
  void call_motion(const StInstruction& of, Cell* instance);

  const Compiled& code_;
  MotionKernel& kernel_;
  std::vector<Cell> constants_;
  std::vector<Cell> memory_;
  std::vector<Motion> motions_;
  std::vector<Loss> losses_;
  std::set<int> told_;        ///< nodes whose loss has been told
  std::vector<bool> active_;  ///< methods that run
  std::int64_t time_ns_ = 0;
  std::int64_t work_ = 0;  ///< that is left in this scan
  std::int64_t statements_ = 0;
  Trace* trace_ = nullptr;
  TestLog* test_log_ = nullptr;
};

}  // namespace drycut::devices::plcopen::st
