#pragma once
#include <compare>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/problem.hpp"
#include "devices/controller.hpp"
#include "devices/coverage.hpp"
#include "devices/due.hpp"
#include "devices/modbus/modbus.hpp"
#include "devices/qmove/catalogue.hpp"
#include "devices/qmove/cnf.hpp"
#include "devices/qmove/machine.hpp"
#include "devices/qmove/program.hpp"

namespace drycut::devices::qmove {

/// What a variable of this size takes.
ValueRange range_of(Size size);

/// What the controller's CPU is doing, as QMOS reports it in osmode (spec 4.5).
enum class OsMode : std::uint8_t { initial = 0, run = 3, error = 5 };

/// A QMOVE controller: devices and program tasks on one set of cards.
///
/// Scheduling (spec D9): every `cycle_ns` a round begins in which each task, in the order given, has one
/// turn; a turn lasts until WAIT or END. Where a task reads a device, its turn waits for the sample that
/// takes what was posted to the device before, by anyone; a turn that others held up is finished before the
/// next round begins. With `statement_ns` each statement, and each look at the condition of a WAIT, takes
/// that time and acts at its end; a round that lasts longer than `cycle_ns` is followed at once by the next,
/// devices take their samples meanwhile. A task that comes to no WAIT for 1 s is told ("held_up"). A run-time
/// error or a task that loops without WAIT stops all tasks until the next power-up; devices go on.
class QmoveController : public Controller {
 public:
  /// `configuration` and `programs` are free of problems; `programs` were compiled against `configuration`
  /// and both against `catalogue`. `cycle_ns` > 0, `statement_ns` >= 0. The controller begins powered on, at
  /// time 0.
  QmoveController(Configuration configuration, std::vector<QclProgram> programs,
                  std::span<const CatalogueEntry> catalogue, std::int64_t cycle_ns,
                  std::int64_t statement_ns = 0);

  Cards& cards() override { return cards_; }
  std::variant<Address, TerminalFault> terminal(const std::string& text) override {
    return find_slot_terminal(cards_, text);
  }
  [[nodiscard]] bool takes_wire(const Address& address) const override { return slot_takes_wire(address); }
  [[nodiscard]] std::vector<Period> periods() const override;
  [[nodiscard]] std::int64_t output_period(const Address& analogue) const override;
  void run_devices(std::int64_t time_ns) override;
  void run_tasks(std::int64_t time_ns) override;
  void interrupt(int line, bool rising) override;
  void power(bool on) override;
  void visit(StateArchive& archive) override;

  /// Values by name, any case: variables `slLength`, `arr[3]`, `ddbCodeG[2,1]`, timers (1 = elapsed), inputs
  /// and outputs by symbol or terminal (`2.OUT01`, `2.AN01` in V, `2.CNT01` in counts), devices
  /// `AxisX.posit`, and `QMOS.oserr`, `QMOS.osmode`. A value read-only to programs is read-only here.
  std::optional<ControllerValue> find(const std::string& name) override;
  /// Arrays and datagroup variables are listed by their first element.
  [[nodiscard]] std::vector<std::string> names() const override;

  [[nodiscard]] std::vector<CamAxis> cam_axes() override;

  /// Of the first device MODBUS of the configuration.
  [[nodiscard]] std::variant<const ModbusFace*, std::string> modbus() const override;
  /// The tasks' modules, in their order, then the configuration.
  [[nodiscard]] std::vector<ProgramText> programs() override;
  [[nodiscard]] ProgramPositions positions(std::int64_t time_ns) const override;
  void count_programs() override;
  /// A WAIT counts its looks at the condition; ELSE, SUB and what closes a block are no lines of their own.
  void add_coverage(Coverage& to) const override;
  /// What ran of a program, where programs are counted.
  [[nodiscard]] const Counts& counts(std::size_t program) const { return counts_.at(program); }
  /// The run-time error that has stopped all tasks.
  struct Stop {
    std::size_t task = 0;
    int line = 0;
    RunTimeError error = RunTimeError::none;
  };
  [[nodiscard]] std::optional<Stop> stopped() const;
  [[nodiscard]] bool ended(std::size_t task) const { return tasks_[task].ended; }
  [[nodiscard]] std::vector<ProgramWait> waits() override;
  [[nodiscard]] std::vector<PositionLoop> position_loops() override;
  [[nodiscard]] std::vector<CountedUnit> counted_units() const override;
  [[nodiscard]] std::vector<ProgramDoubt> doubts() const override;

  [[nodiscard]] bool has_events() const override { return !events_.empty(); }
  std::vector<ControllerEvent> take_events() override;

  /// What survives power-off, as text: one `name = value` a line. Zeros of arrays and datagroups are left
  /// out.
  [[nodiscard]] std::string retentive_state() const override;
  /// Puts such a text back, before any device is initialised: variables that it does not name become 0,
  /// device values that it does not name stay. False, and nothing changed, if `problems` had to be added.
  bool restore(const std::string& text, Problems& problems,
               const std::string& file_name = "retentive state") override;

 private:
  /// Where a value lives.
  struct Location {
    enum class Kind : std::uint8_t { cell, timer, input, output, device, terminal, oserr, osmode };
    Kind kind = Kind::cell;
    int index = 0;  ///< cell, or number of the timer, input, output, device
    Size size = Size::L;
    Symbol symbol = {};
    Address address = {};
    std::string name = {};  ///< in the declared spelling
  };
  [[nodiscard]] std::optional<Location> locate(std::string_view name) const;
  [[nodiscard]] std::optional<Location> locate_indexed(std::string_view name) const;
  [[nodiscard]] std::optional<Location> locate_symbol(std::string_view device, std::string_view symbol) const;
  [[nodiscard]] bool has_terminal(const Address& address) const;
  ControllerValue terminal_value(const Location& location);
  [[nodiscard]] double cell_value(int cell, Size size) const;
  void set_cell(int cell, Size size, double value);
  void write_device(int device, Symbol symbol, double value);
  [[nodiscard]] bool is_retentive(const Location& location) const;
  /// A value to put back, and where.
  struct Kept {
    Location location;
    double value;
  };
  void read_kept(std::string_view line, int number, const std::string& file, std::set<std::string>& seen,
                 std::vector<Kept>& kept, Problems& problems) const;

  void add_terminal(const Address& address);
  void start_tasks();
  bool turn(std::size_t number);
  Counts* counts_of(std::size_t number) { return counts_.empty() ? nullptr : &counts_[number]; }
  bool finish_turn(std::size_t number, RunTimeError error);
  void run_timed(std::int64_t time_ns);
  bool run_place(std::int64_t time_ns);
  void tell_of_cut(std::size_t number);
  void tell_of_long_turn(std::size_t number);
  void stop(RunTimeError error, std::size_t task);
  void collect_diagnostics(std::size_t device);
  [[nodiscard]] ProgramText module_text(const QclProgram& program) const;
  [[nodiscard]] std::string doing(std::size_t number) const;

  void visit_machine(StateArchive& archive);

  const Configuration configuration_;
  const std::vector<QclProgram> programs_;
  const SymbolTable names_;
  std::vector<ProgramText> texts_;  ///< of programs(), once somebody has asked
  Cards cards_;
  QclMachine machine_;
  std::vector<Task> tasks_;
  std::vector<Counts> counts_;  ///< one a program where they are counted
  bool powered_ = true;
  std::optional<modbus::ExchangeFace> modbus_;
  OsMode mode_ = OsMode::run;
  RunTimeError error_ = RunTimeError::none;
  std::size_t failed_ = 0;  ///< the task that had it

  Due round_;                        ///< of the tasks
  const std::int64_t statement_ns_;  ///< what a statement takes
  std::int64_t computed_ns_ = 0;     ///< until when statements have been executed
  std::size_t place_ = 0;            ///< in the round's order of turns: those held up by others, then all
  bool in_round_ = false;
  std::vector<Due> device_due_;      ///< by device
  std::int64_t next_device_ns_ = 0;  ///< the earliest of them

  std::vector<ControllerEvent> events_;
  struct Said {
    std::size_t device = 0;
    Diagnostic::Kind kind = {};
    std::string subject;
    std::string text;
    auto operator<=>(const Said&) const = default;
    void visit(StateArchive& archive);
  };
  std::set<Said> said_;  ///< since power-up: a program that repeats a refused command does not flood
};

}  // namespace drycut::devices::qmove
