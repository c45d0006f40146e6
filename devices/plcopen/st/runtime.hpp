#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "devices/plcopen/kernel.hpp"
#include "devices/plcopen/pins.hpp"
#include "devices/plcopen/st/program.hpp"

namespace drycut::devices {
struct Coverage;
}

namespace drycut::devices::plcopen::st {

/// A scalar of the program by the name that people give it: "count", "CamIn.InSync", "pos[3]", "state".
struct StSymbol {
  std::string name;
  std::string type;       ///< "BOOL", "LREAL", ..., or the name of its enumeration
  std::string unit;       ///< "s" of times and dates
  bool writable = false;  ///< not a constant, an output pin or a located input
  bool retain = false;
  double min = 0;  ///< range of the type; times in s
  double max = 0;
};

/// Why the program stands.
struct RuntimeFault {
  int line = 0;
  int column = 0;
  std::string text;

  void visit(StateArchive& archive);
};

/// When the programs run.
struct Schedule {
  /// Instead of those of a CONFIGURATION, if there are any; their programs are those that they name.
  std::vector<Program::Task> tasks;
  std::int64_t task_ns = 0;       ///< of programs without a task; 0: at each scan
  std::int64_t cycle_ns = 0;      ///< in which a task with a SINGLE looks at it; 0: at each scan
  std::int64_t statement_ns = 0;  ///< what a statement takes: of run_next()
};

/// A task that has run, where statements take time.
struct TaskRun {
  std::string task;
  std::int64_t due_ns = 0;
  std::int64_t begun_ns = 0;     ///< later than due where others were at work
  std::int64_t ended_ns = 0;     ///< its outputs are there
  std::int64_t interval_ns = 0;  ///< 0: it runs by its SINGLE

  void visit(StateArchive& archive);
};

/// Programs in a controller: their variables and function blocks, and their scans.
class Runtime {
 public:
  /// Binds the externals by their names; an axis that the kernel does not have stays unconnected.
  Runtime(Program program, MotionKernel& kernel, Schedule schedule = {});
  Runtime(const Runtime&) = delete;
  Runtime& operator=(const Runtime&) = delete;
  ~Runtime();

  /// Initial values, new function blocks, no fault. RETAIN variables keep theirs unless `all`.
  void cold_start(bool all = false);
  /// Runs the programs that are due at the controller's time, by the priorities of their tasks; nothing after
  /// a fault.
  void scan(std::int64_t time_ns);
  /// The same for one task where statements take time: the first by priority of those that are due. The next
  /// may run from its end on; none interrupts another. Nothing if none is due, and after a fault.
  std::optional<TaskRun> run_next(std::int64_t time_ns);
  /// Leaves out what is due: there is no power.
  void pass(std::int64_t time_ns);
  /// When the next program is due.
  [[nodiscard]] std::int64_t next_ns() const;

  [[nodiscard]] std::span<const StSymbol> symbols() const;
  /// A REAL that has overflowed as the largest there is, one that is no number as 0, BOOL as 0 and 1, TIME in
  /// s, TOD in s since midnight, DATE and DT in s since 1970, an enumeration as its number.
  [[nodiscard]] double read(std::size_t symbol) const;
  /// The same of a BOOL.
  [[nodiscard]] bool holds(std::size_t symbol) const;
  /// The motion block whose pin the symbol is; nullptr if it is none.
  [[nodiscard]] const FunctionBlock* block(std::size_t symbol) const;
  /// Its kind, "MC_CamIn"; "" if it is none.
  [[nodiscard]] std::string_view block_type(std::size_t symbol) const;
  /// Rounded and limited to the type's range; nothing if the symbol is not writable.
  void write(std::size_t symbol, double value);
  /// By index into Program::located().
  [[nodiscard]] bool located(std::size_t i) const;
  void set_located(std::size_t i, bool level);
  /// Whether somebody looks at what scans execute; costs time.
  void watch(bool on);
  /// Counts from now on what runs, which costs time.
  void count();
  /// Adds what was counted; `files` names the program's files.
  void add_coverage(Coverage& to, std::span<const std::string> files) const;
  /// What each program's last run did, together: see devices::ProgramPositions; "" before there is one.
  [[nodiscard]] std::string scanned() const;
  /// Where statements take time: the line of the statement that has its time `into_ns` after the beginning of
  /// the task that run_next() ran last; 0 if it was not watched.
  [[nodiscard]] int line_at(std::int64_t into_ns) const;
  /// Values that did not fit where they were put, since it was asked last; each place of the text once.
  std::vector<RuntimeFault> take_losses();
  /// Set: the program stands until the next cold start.
  [[nodiscard]] const std::optional<RuntimeFault>& fault() const;

  /// What was watched is forgotten: it is of another moment.
  void visit(StateArchive& archive);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace drycut::devices::plcopen::st
