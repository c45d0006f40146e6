#pragma once
#include <array>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "devices/cards.hpp"

namespace drycut {
class StateArchive;
}

namespace drycut::devices {

struct CamAxis;  // devices/controller.hpp

// A device is a table plus a step. The table (DeviceType) is its public face: QCL programs, scenario files,
// the recorder and `drycut devices` all use it, and nothing about a variable is written twice.

/// Size of a variable as QCL knows it: flag, byte, word, long, single.
enum class Size : char { F = 'F', B = 'B', W = 'W', L = 'L', S = 'S' };
enum class Access : std::uint8_t { read, read_write };
/// What becomes of a value at power-up and INIT.
enum class Retention : std::uint8_t { retentive, zero, one };

/// What must hold for a write or a command to be accepted: the states whose bits are in `mask` must have the
/// values of the same bits in `value`. Bit i is row i of the device's state table. `also` names, in the
/// manual's words, a requirement that is not a state ("rowex != n"); the device checks it itself.
struct Condition {
  std::uint64_t mask = 0;
  std::uint64_t value = 0;
  std::string_view also = {};
};

/// One parameter or variable. Values outside min..max are taken and reported, as the manuals say.
struct DeviceVariable {
  std::string_view name;  ///< the manual's spelling; rows > 1: without the row number ("codeG")
  Size size = Size::L;
  std::string_view unit;  ///< "Um", "bits x4", "speed", "1/100 s", "" for a code or a number
  double min = 0;
  double max = 0;
  Access access = Access::read_write;
  Retention retention = Retention::retentive;
  Condition write = {};
  std::string_view meaning = {};  ///< one sentence
  std::string_view section = {};  ///< where the manual defines it, "000 1.9.2"
  int rows = 1;                   ///< 128 for the cam table's program variables codeG1..codeG128
};

/// One reported state, a flag that programs read.
struct State {
  std::string_view name;
  Retention retention = Retention::zero;
  std::string_view meaning = {};
  std::string_view section = {};
};

/// What a command does to one state as soon as it is taken; whatever else it does is the device's.
struct Effect {
  int state = -1;      ///< row of the state table; -1 = no such effect
  bool on = false;     ///< the value that it gets
  bool quiet = false;  ///< where the state has the value already, the command is a silent no-op, no refusal
};

/// One command. Row order is execution order among commands of the same sample (priority).
struct DeviceCommand {
  std::string_view name;
  Condition condition = {};
  std::string_view meaning = {};
  std::string_view section = {};
  Effect effect = {};
};

/// One field of the device's INTDEVICE record in the .CNF, after name and type.
struct Field {
  enum class Kind : std::uint8_t { period_ms, counter, interrupt_line, input, output, analogue, port };
  std::string_view name;  ///< "TCamp", "CountS", "IntL" ...
  Kind kind = Kind::period_ms;
  int min = 0;  ///< range of a number: period [ms], interrupt line or communication port
  int max = 0;
  std::string_view meaning = {};
};

/// Another spelling that the manuals' programs use.
struct Alias {
  std::string_view spelling;
  std::string_view name;
};

/// A reading of ours, where the manual is silent, contradicts itself or lost its print.
struct ManualReading {
  std::string_view of;      ///< a row of the tables (a cam table's without number), "" for the whole device
  std::string_view text;    ///< what the device does here
  std::string_view manual;  ///< the place that leaves it open, and how
};

struct DeviceType {
  std::string_view name;  ///< "CAMMING4"
  std::string_view summary;
  std::span<const DeviceVariable> variables;
  std::span<const State> states;            ///< row 0 is st_init
  std::span<const DeviceCommand> commands;  ///< row 0 is INIT
  std::span<const Field> fields;
  std::span<const Alias> aliases;
  std::span<const ManualReading> readings = {};
};

/// Something a device has that can be read by name: a variable (with its row, 0-based) or a state.
struct Symbol {
  enum class Kind : std::uint8_t { variable, state };
  Kind kind = Kind::variable;
  int index = 0;
  int row = 0;

  void visit(StateArchive& archive);
};

/// Looks `name` up, any case, aliases included: "posit", "codeQm17", "st_sync".
std::optional<Symbol> find_symbol(const DeviceType& type, std::string_view name);
/// Row of the command table, or nullopt.
std::optional<int> find_command(const DeviceType& type, std::string_view name);
/// All names a program may use, for suggestions (program variables once, as "codeG1").
std::vector<std::string> symbol_names(const DeviceType& type);
std::string name_of(const DeviceType& type, Symbol symbol);
/// Wraps a value to a size as a store does: B -128..127, W -32768..32767, L 32 bit, F value != 0.
std::int32_t wrap(Size size, std::int64_t value);

/// The terminals of one device, in the order of DeviceType::fields.
struct Resource {
  int number = 0;                  ///< period_ms, port and interrupt_line: the number; 0 = unused ("X")
  std::optional<Address> address;  ///< the others; nullopt = unused ("X.X")
};
using Resources = std::vector<Resource>;

/// Something a device did not do, or did with a remark: said once by the device, kept by the simulation.
struct Diagnostic {
  /// A note tells what something else tells again, when it comes to something.
  enum class Kind : std::uint8_t {
    command_refused,
    write_refused,
    out_of_range,
    note,
    warning,
    contradiction
  };
  Kind kind = Kind::warning;
  std::string subject;  ///< command or variable name
  std::string text;     ///< "st_still is 0, must be 1"

  void visit(StateArchive& archive);
};

/// Visits values that stand side by side: they stay where they are, one is listed under the name alone.
void visit_values(StateArchive& archive, std::string_view name, std::span<std::int32_t> values);

/// A device inside the controller: dual-port RAM on one side (write, command, read), transducers and DAC on
/// the other, and a periodic step (spec qem.md §2).
///
/// Mailbox: writes and commands wait for the next sample. Writes are applied first, in order; then the *set*
/// of pending commands runs in table order, so two identical commands between samples are one. Commands of
/// one sample that contradict each other (contradictions.hpp) are reported with who gave them, and again only
/// after one of them came without the other. Before INIT the device does nothing but take writes at once and
/// wait for INIT.
class Device {
 public:
  explicit Device(const DeviceType& type);
  virtual ~Device() = default;
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  [[nodiscard]] const DeviceType& type() const { return type_; }

  // The program's side.
  void write(Symbol symbol, std::int32_t value);
  /// `giver` is the task's name, "" for anybody else.
  void command(int index, std::string_view giver = {});
  /// False while writes or commands wait for a sample of an initialised device (the mailbox of spec §2).
  [[nodiscard]] bool settled() const;
  [[nodiscard]] std::int32_t read(Symbol symbol) const;
  /// Puts a retentive value or state back as the memory kept it, without conditions; only before INIT.
  void restore(Symbol symbol, std::int32_t value);

  // The hardware's side.
  /// Sampling time [ms]: the TCamp of the .CNF record.
  [[nodiscard]] virtual int period_ms() const = 0;
  /// One sampling: latch transducers and inputs, apply writes, run commands, then the device's own step.
  void sample();
  /// An edge on interrupt line `line`; the counters' `latched` hold their exact counts at the edge.
  virtual void interrupt(int line, bool rising);
  /// Power lost and restored: everything not retentive goes to its power-up value, st_init to 0.
  virtual void power_up();

  /// Its cam, if it has one; the owner gives it its name.
  [[nodiscard]] virtual std::optional<CamAxis> cam_axis();
  /// Of an analogue axis: what its parameters take for the speed at 10 V [bits x4/s], 0 = nothing.
  [[nodiscard]] virtual double bits_at_10v() const { return 0; }

  [[nodiscard]] std::vector<Diagnostic> take_diagnostics();
  [[nodiscard]] bool has_diagnostics() const { return !diagnostics_.empty(); }

  /// What changes while it runs; a device type adds its own.
  virtual void visit(StateArchive& archive);

 protected:
  // What a device type supplies.
  virtual void latch() = 0;               ///< read counters and inputs
  virtual void initialise() = 0;          ///< the INIT command; the base has reset variables and states
  virtual void execute(int command) = 0;  ///< beyond its effect, a command whose condition holds; never INIT
  virtual void step() = 0;  ///< motion, regulation, outputs, states; only called when initialised
  virtual bool may_write(Symbol symbol, std::int32_t value);  ///< requirements beyond the condition
  virtual void written(Symbol symbol, std::int32_t value);    ///< default stores the value
  virtual bool may_execute(int command);                      ///< requirements beyond the condition
  virtual void refused(int command);                          ///< a command whose condition did not hold

  [[nodiscard]] bool state(int index) const { return (states_ >> index & 1) != 0; }
  void set_state(int index, bool on) {
    states_ = on ? states_ | std::uint64_t{1} << index : states_ & ~(std::uint64_t{1} << index);
  }
  [[nodiscard]] std::int32_t& value(int variable, int row = 0) { return values_[offsets_[variable] + row]; }
  [[nodiscard]] std::int32_t value(int variable, int row = 0) const {
    return values_[offsets_[variable] + row];
  }
  /// True if the states are as `condition` says (its `also` is the device's to check).
  [[nodiscard]] bool holds(const Condition& condition) const {
    return ((states_ ^ condition.value) & condition.mask) == 0;
  }
  void report(Diagnostic diagnostic);
  /// Reports `variable` if its value is outside low..value(`high`), a range that another variable ends.
  void report_outside(int variable, std::int32_t low, int high);

 private:
  struct PendingWrite {
    Symbol symbol;
    std::int32_t value = 0;
    void visit(StateArchive& archive);
  };
  void apply(const PendingWrite& pending);
  void run(int command);
  void tell_contradictions(std::uint64_t commands);
  [[nodiscard]] std::string given(int command) const;
  void reset_values();
  [[nodiscard]] std::string unmet(const Condition& condition) const;

  const DeviceType& type_;
  const std::vector<int> offsets_;
  std::vector<std::int32_t> values_;
  std::uint64_t states_ = 0;
  std::vector<PendingWrite> pending_writes_;
  std::uint64_t pending_commands_ = 0;
  struct Given {
    int command = 0;
    std::string giver;
    void visit(StateArchive& archive);
  };
  std::vector<Given> given_;                         ///< who gave the pending commands, each once
  const std::vector<std::uint64_t> contradictions_;  ///< by command: those that want the opposite
  std::vector<std::uint64_t> told_contradictions_;   ///< by command: told when it last ran
  std::vector<Diagnostic> diagnostics_;
};

// What every device's tables are written with and found in by name; all of it is done while compiling.

// constexpr where a consteval function hands its own parameters on: Clang 14 takes no consteval call there.

/// Number of the row called `name`; a name that is not in the table does not compile.
template <typename Rows>
constexpr int find_row(const Rows& rows, std::string_view name) {
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i].name == name) return static_cast<int>(i);
  throw "no such row";
}

/// The rows of `first`, then those of `then`.
template <typename Row, std::size_t N, std::size_t M>
consteval std::array<Row, N + M> joined(const std::array<Row, N>& first, const std::array<Row, M>& then) {
  std::array<Row, N + M> rows{};
  for (std::size_t i = 0; i < N; ++i) rows[i] = first[i];
  for (std::size_t i = 0; i < M; ++i) rows[N + i] = then[i];
  return rows;
}

/// The rows, in the manual's section where they name none.
template <typename Row, std::size_t N>
constexpr std::array<Row, N> in_section(std::string_view section, std::array<Row, N> rows) {
  for (Row& row : rows)
    if (row.section.empty()) row.section = section;
  return rows;
}
/// A row that the manual defines elsewhere than those around it.
template <typename Row>
constexpr Row elsewhere(std::string_view section, Row row) {
  row.section = section;
  return row;
}
/// Variables of a table that has so many rows.
template <std::size_t N>
constexpr std::array<DeviceVariable, N> of_rows(int number, std::array<DeviceVariable, N> variables) {
  for (DeviceVariable& variable : variables) variable.rows = number;
  return variables;
}

// The ends of a variable of size L.
inline constexpr double lowest = -2147483648.0;
inline constexpr double highest = 2147483647.0;

/// A parameter: programs write it where `write` holds, the retentive memory keeps it.
constexpr DeviceVariable kept(std::string_view name, Size size, std::string_view unit, double min, double max,
                              Condition write, std::string_view meaning) {
  return {name, size, unit, min, max, Access::read_write, Retention::retentive, write, meaning};
}
constexpr DeviceVariable kept(std::string_view name, Size size, std::string_view unit, double min, double max,
                              std::string_view meaning) {
  return kept(name, size, unit, min, max, {}, meaning);
}
/// The same of a value that begins at 0 with each power-up.
constexpr DeviceVariable zeroed(std::string_view name, Size size, std::string_view unit, double min,
                                double max, Condition write, std::string_view meaning) {
  return {name, size, unit, min, max, Access::read_write, Retention::zero, write, meaning};
}
constexpr DeviceVariable zeroed(std::string_view name, Size size, std::string_view unit, double min,
                                double max, std::string_view meaning) {
  return zeroed(name, size, unit, min, max, {}, meaning);
}
/// What the device shows; without a range any value of size L.
constexpr DeviceVariable shown(std::string_view name, Size size, std::string_view unit, double min,
                               double max, std::string_view meaning) {
  return {name, size, unit, min, max, Access::read, Retention::zero, {}, meaning};
}
constexpr DeviceVariable shown(std::string_view name, std::string_view unit, std::string_view meaning) {
  return shown(name, Size::L, unit, lowest, highest, meaning);
}

/// A command, and what it does to a state.
constexpr DeviceCommand command(std::string_view name, Condition condition, std::string_view meaning,
                                Effect effect = {}) {
  return {name, condition, meaning, {}, effect};
}

/// needs({"st_init", "!st_emrg"}): the condition that these rows of `states` are 1, or 0 where the name
/// begins with '!'.
template <const auto& states>
struct Needs {
  consteval Condition operator()(std::initializer_list<std::string_view> names,
                                 std::string_view also = {}) const {
    Condition condition{0, 0, also};
    for (std::string_view name : names) {
      const bool off = name.starts_with('!');
      const std::uint64_t bit = std::uint64_t{1} << find_row(states, off ? name.substr(1) : name);
      condition.mask |= bit;
      if (!off) condition.value |= bit;
    }
    return condition;
  }
};

/// turns("st_emrg"): the effect that this row of `states` becomes 1, or 0 where the name begins with '!'.
/// `quiet`: see Effect.
template <const auto& states, bool quiet>
struct Turns {
  consteval Effect operator()(std::string_view name) const {
    const bool off = name.starts_with('!');
    return {find_row(states, off ? name.substr(1) : name), !off, quiet};
  }
};

/// Number of a row of `type`, which its name stands for; a name that is not in the table does not compile.
template <const DeviceType& type, auto rows>
class NamedRow {
 public:
  consteval NamedRow(const char* name) : number_(find_row(type.*rows, name)) {}
  constexpr explicit NamedRow(int number) : number_(number) {}
  constexpr operator int() const { return number_; }
  friend constexpr bool operator==(NamedRow a, NamedRow b) = default;

 private:
  int number_;
};

/// A device whose rows go by their names in `table`: value("pgain"), state("st_still").
template <const DeviceType& table>
class TableDevice : public Device {
 protected:
  using VariableRow = NamedRow<table, &DeviceType::variables>;
  using StateRow = NamedRow<table, &DeviceType::states>;
  using CommandRow = NamedRow<table, &DeviceType::commands>;
  using FieldRow = NamedRow<table, &DeviceType::fields>;

  /// `type` has at least the rows of `table`, in the same places.
  explicit TableDevice(const DeviceType& type = table) : Device(type) {}

  [[nodiscard]] bool state(StateRow row) const { return Device::state(row); }
  void set_state(StateRow row, bool on) { Device::set_state(row, on); }
  [[nodiscard]] std::int32_t& value(VariableRow variable, int row = 0) {
    return Device::value(variable, row);
  }
  [[nodiscard]] std::int32_t value(VariableRow variable, int row = 0) const {
    return Device::value(variable, row);
  }
  [[nodiscard]] std::string_view name_of(VariableRow variable) const {
    return type().variables[variable].name;
  }
  void report_outside(VariableRow variable, std::int32_t low, VariableRow high) {
    Device::report_outside(variable, low, high);
  }
};

// How devices take hold of the terminals that their .CNF record names.

/// The terminal of `resource` in `terminals`, added if it is not there; nullptr if the field is unused (X.X).
template <typename Terminal>
Terminal* connect(std::map<Address, Terminal>& terminals, const Resource& resource) {
  return resource.address ? &terminals[*resource.address] : nullptr;
}

/// Count of a counter [bits x4]; 0 without one.
inline std::int64_t count_of(const Counter* counter) { return counter ? counter->count : 0; }

/// Level of an input; off without one.
inline bool is_on(const DigitalInput* input) { return input && input->level; }

}  // namespace drycut::devices
