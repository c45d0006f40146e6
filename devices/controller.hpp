#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/problem.hpp"
#include "devices/cam_axis.hpp"
#include "devices/cards.hpp"
#include "devices/modbus_face.hpp"
#include "devices/program_text.hpp"
#include "devices/value_range.hpp"

namespace drycut::devices {

/// A value inside the controller that scenarios record, check and set: "AxisX.posit", "slLength".
struct ControllerValue {
  std::string name;
  std::string unit;
  std::function<double()> read;
  std::function<void(double)> write;  ///< empty if read-only; acts as a program's store does (device mailbox)
  std::optional<ValueRange> range = {};  ///< of one that can be written: the manual's, of a parameter
  bool of_table = false;                 ///< a row of a cam table: one of many, of which most are 0

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
};

/// Why a text is no terminal of a controller.
struct TerminalFault {
  std::string what;
  std::string remedy;
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

  /// What its programs say that is no fault and hardly meant.
  struct ProgramDoubt {
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

}  // namespace drycut::devices
