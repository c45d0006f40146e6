#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "base/problem.hpp"
#include "devices/cards.hpp"
#include "devices/value_range.hpp"

namespace drycut {
class StateArchive;
}

namespace drycut::devices {

struct CamTable;  // devices/cam/table.hpp
struct Coverage;  // devices/coverage.hpp

/// The slave of a cam at an instant, in the units of the cam's table, to be compared with its law.
struct CamMoment {
  bool follows = false;               ///< a cam runs and its slave is on it; else the rest says nothing
  double master = 0;                  ///< as the cam counts it, on and on from cycle to cycle
  double set = 0;                     ///< where the device wants the slave, from where the cam has its zero
  double turn = 0;                    ///< `set` is known but for whole turns of this length; 0 = it is known
  std::optional<double> behind = {};  ///< set less measured position; absent: the device does not measure
};

/// An axis of a controller that can play cams, as a simulation looks at it. Stays valid as long as the
/// controller.
struct CamAxis {
  std::string name;  ///< "AxisX", "Y0", "Knife"
  std::optional<Address> pulses =
      {};  ///< output whose drive knows where the slave is, if the device does not
  /// Another number with each start and with each change of the table that the device takes over; 0 = no cam
  /// was started yet.
  std::function<std::uint64_t()> start;
  std::function<CamMoment()> moment;
  /// The table that it plays, or would play, with all that its law needs; null = it has none.
  std::function<std::shared_ptr<const CamTable>()> table;
};

/// The four tables of Modbus' data model, which functions 1, 2, 3 and 4 read.
enum class ModbusTable : std::uint8_t { coils, discrete_inputs, holding_registers, input_registers };

/// Whether an address of the table is a bit; else it is a word of 16.
constexpr bool has_bits(ModbusTable table) {
  return table == ModbusTable::coils || table == ModbusTable::discrete_inputs;
}

/// How a value of a controller lies in bits.
enum class ModbusFormat : std::uint8_t { bit, int16, uint16, int32, uint32, real32, real64 };

/// 1, 16, 32 or 64.
int width_of(ModbusFormat format);
/// A whole number is rounded, what is beyond the format's ends becomes the end, no number becomes 0.
std::uint64_t to_bits(ModbusFormat format, double value);
double from_bits(ModbusFormat format, std::uint64_t bits);

/// What stands at an address: a bit or a word of one of the controller's values.
struct ModbusPlace {
  std::string value;  ///< as Controller::find knows it; "" = memory that nothing stands in: reads 0
  ModbusFormat format = ModbusFormat::int16;
  int shift = 0;                ///< the bit, or the lowest one of the word, in the value
  std::int64_t settles_ns = 0;  ///< what is written has been taken that much later
};

/// What a controller shows to Modbus, and what it lets it write. The registers are device knowledge; frames,
/// functions and sockets are not.
class ModbusFace {
 public:
  ModbusFace() = default;
  virtual ~ModbusFace() = default;
  ModbusFace(const ModbusFace&) = delete;
  ModbusFace& operator=(const ModbusFace&) = delete;

  /// Nullopt where nothing can be read.
  [[nodiscard]] virtual std::optional<ModbusPlace> read(ModbusTable table, std::uint16_t address) const = 0;
  /// Nullopt where nothing can be written; of coils and holding registers.
  [[nodiscard]] virtual std::optional<ModbusPlace> written(ModbusTable table,
                                                           std::uint16_t address) const = 0;
  /// Whether it answers as this unit, now. Most take any: over TCP the address of the socket says who is
  /// meant.
  [[nodiscard]] virtual bool answers(std::uint8_t unit) const {
    (void)unit;
    return true;
  }
};

// What one sees of a controller's programs while they run.

/// A text that a controller runs, or is set up by.
struct ProgramText {
  std::string name;      ///< the file's, without its folder
  std::string file;      ///< as messages name it
  std::string language;  ///< "qcl", "cnf", "il", "st"
  std::string text;      ///< UTF-8
  /// What of Controller::find() each line names, by the line's number from 1, in its order.
  std::map<int, std::vector<std::string>> values = {};

  ProgramText(const std::string& in_file, std::string in_language, std::string of)
      : name(in_file.substr(in_file.find_last_of("/\\") + 1)),
        file(in_file),
        language(std::move(in_language)),
        text(std::move(of)) {}
  /// A line names a value, once.
  void add_value(int line, const std::string& value) {
    auto& names = values[line];
    if (std::find(names.begin(), names.end(), value) == names.end()) names.push_back(value);
  }
};

/// A place at which a program stands until something comes, or for ever.
struct ProgramWait {
  std::string program;        ///< ProgramText::name
  int line = 0;               ///< from 1
  std::int64_t since_ns = 0;  ///< it has stood there all the time
  bool ended = false;         ///< it came to its end: nothing comes any more
  std::string lacks = {};     ///< what has never come, where the line does not say it
  std::int64_t until_ns = 0;  ///< a timer that it waits for elapses then; 0 = it waits for none that runs
};

/// What programs do at a moment.
struct ProgramPositions {
  /// Where one of them stands.
  struct Task {
    std::string name;
    std::size_t program = 0;      ///< of Controller::programs()
    int line = 0;                 ///< from 1; 0: nowhere, as between two scans
    std::string doing;            ///< "waits", "runs", "ended", "error 6: division by zero"
    std::vector<int> calls = {};  ///< lines of the calls that led there, the outermost first
  };
  std::vector<Task> tasks;
  /// For each program what its last scan did, a letter a line: '+' executed, with power or with a condition
  /// that held; '-' come by, without; ' ' not come by. "" of what is not scanned, or was not watched yet.
  std::vector<std::string> scanned;
};

/// A value inside the controller that scenarios record, check and set: "AxisX.posit", "slLength".
struct ControllerValue {
  std::string name;
  std::string unit;
  std::function<double()> read;
  std::function<void(double)> write;  ///< empty if read-only; acts as a program's store does (device mailbox)
  std::optional<ValueRange> range = {};  ///< of one that can be written: the manual's, of a parameter
  bool of_table = false;                 ///< a row of a cam table: one of many, of which most are 0
  std::string_view meaning = {};         ///< as the tables of devices have it; "" of the program's own

  /// What is wrong with giving it `number`, nullopt if it is taken as it is.
  [[nodiscard]] std::optional<ValueFault> misfit(double number) const {
    return range ? devices::misfit(name, *range, number, unit) : std::nullopt;
  }
};

/// Something that happened inside the controller: a refused command, a run-time error, a device warning.
struct ControllerEvent {
  std::string source;  ///< device or task name
  /// "refused", "out_of_range", "error", "warning", "note", "contradiction", "held_up", "overrun", "stopped",
  /// "errorstop" ...
  std::string event;
  std::string text;

  void visit(StateArchive& archive);
};

/// Why a text is no terminal of a controller.
struct TerminalFault {
  Code code;
  Prose what;
  Prose remedy;
};

/// A controller with its devices and programs, as the simulation sees it. Time is in integer nanoseconds.
class Controller {
 public:
  Controller() = default;
  virtual ~Controller() = default;
  Controller(const Controller&) = delete;
  Controller& operator=(const Controller&) = delete;

  virtual Cards& cards() = 0;
  /// The terminal that wiring calls `text`, any case, in this controller's own spelling: it is in cards()
  /// then, an interrupt line apart. Else why it is none.
  virtual std::variant<Address, TerminalFault> terminal(const std::string& text) = 0;
  /// How wiring writes the terminal.
  [[nodiscard]] virtual std::string terminal_name(const Address& address) const { return to_string(address); }
  /// False for a terminal to which nothing is wired.
  [[nodiscard]] virtual bool takes_wire(const Address& address) const {
    (void)address;
    return true;
  }
  /// The terminals that give pulses, for messages; "" if there is none.
  [[nodiscard]] virtual std::string_view pulse_terminals() const { return {}; }
  /// Every period that something inside runs at [ns], with its name for messages ("AxisX TCamp").
  struct Period {
    std::string name;
    std::int64_t ns;
    bool samples_axes = false;  ///< position loops are closed in it
  };
  [[nodiscard]] virtual std::vector<Period> periods() const = 0;
  /// Sampling time of the device whose output `analogue` is, the shortest if devices share it [ns]; 0 if
  /// none.
  [[nodiscard]] virtual std::int64_t output_period(const Address& analogue) const {
    (void)analogue;
    return 0;
  }

  /// Samples the devices whose period ends at `time_ns`.
  virtual void run_devices(std::int64_t time_ns) = 0;
  /// Runs the program tasks whose cycle begins at `time_ns`.
  virtual void run_tasks(std::int64_t time_ns) = 0;
  /// An edge on an interrupt line; the counters' `latched` hold their exact counts at the edge.
  virtual void interrupt(int line, bool rising) = 0;
  /// Power off: outputs 0, nothing runs. Power on: retentive values kept, programs start from the beginning.
  virtual void power(bool on) = 0;

  /// All that changes while it runs: devices, programs, terminals, timers, what is remembered to tell.
  virtual void visit(StateArchive& archive) = 0;

  /// What survives power-off, as text, one `name = value` a line; "" if there is nothing.
  [[nodiscard]] virtual std::string retentive_state() const { return ""; }
  /// Puts such a text back, before the first run; `file_name` names it in problems. False, and nothing
  /// changed, if `problems` had to be added.
  virtual bool restore(const std::string& /*text*/, Problems& /*problems*/,
                       const std::string& /*file_name*/) {
    return true;
  }

  /// The value called `name`, any case, or nullopt. Stays valid as long as the controller.
  virtual std::optional<ControllerValue> find(const std::string& name) = 0;
  /// All names that `find` knows, for suggestions.
  [[nodiscard]] virtual std::vector<std::string> names() const = 0;

  /// The axes that can play cams.
  [[nodiscard]] virtual std::vector<CamAxis> cam_axes() { return {}; }

  /// What it shows to Modbus, which lives as long as it; else what would have to be there.
  [[nodiscard]] virtual std::variant<const ModbusFace*, std::string> modbus() const {
    return "a controller that has Modbus";
  }
  /// Its programs, then what sets them up.
  [[nodiscard]] virtual std::vector<ProgramText> programs() { return {}; }
  /// Whether somebody looks at what scans do, which costs time: ProgramPositions::scanned.
  virtual void watch_programs(bool /*on*/) {}
  /// Where the programs stand. `time_ns`: the time until which it has run.
  [[nodiscard]] virtual ProgramPositions positions(std::int64_t /*time_ns*/) const { return {}; }

  /// Counts from now on what of its programs runs, over losses of power too, which costs time.
  virtual void count_programs() {}
  /// Adds what has been counted since then.
  virtual void add_coverage(Coverage& /*to*/) const {}

  /// What its programs say that is no fault and hardly meant.
  struct ProgramDoubt {
    Code code;
    std::string text;        ///< "cycle.mod:12: gaQuota[2] is read, and no task sets it: it stays 0"
    std::string value = {};  ///< which the text holds for unless it is set from outside; "" = always
  };
  [[nodiscard]] virtual std::vector<ProgramDoubt> doubts() const { return {}; }

  /// Where programs wait now: at a condition, or for the command of a block that has never come.
  [[nodiscard]] virtual std::vector<ProgramWait> waits() { return {}; }

  /// An axis that moves by an output of the controller and is counted by one of its counters.
  struct PositionLoop {
    std::string name;
    std::function<double()> drive;               ///< above 0: forward; [V], or 1 of an output that is on
    std::function<std::int64_t()> counts;        ///< in its counting direction [bits x4]
    std::optional<Address> forward = {};         ///< the output that means forward, where there are two
    std::string remedy;                          ///< what turns the count round
    std::optional<Address> counter = {};         ///< where it counts ...
    std::optional<Address> reference = {};       ///< ... and drives, if both are named
    std::optional<Address> zero = {};            ///< the interrupt line of its zero pulse
    std::function<double()> counts_at_10v = {};  ///< its parameters' speed at 10 V [bits x4/s], 0 = none
  };
  /// What a counter's counts are to the axis that reads them, as its parameters have it now.
  struct CountedUnit {
    std::string axis;
    std::string name;  ///< "AxisX: measurem, pulsem"
    Address counter;
    double counts = 0;  ///< [bits x4] of one unit
  };
  [[nodiscard]] virtual std::vector<CountedUnit> counted_units() const { return {}; }

  /// What they read stays valid as long as the controller.
  [[nodiscard]] virtual std::vector<PositionLoop> position_loops() { return {}; }

  [[nodiscard]] virtual bool has_events() const = 0;
  virtual std::vector<ControllerEvent> take_events() = 0;
};

/// Terminals of cards in slots: wiring may name those that the configuration uses.
std::variant<Address, TerminalFault> find_slot_terminal(const Cards& cards, const std::string& text);

/// False for the CPU's simulated counters: nothing is wired to them.
bool slot_takes_wire(const Address& address);

}  // namespace drycut::devices
