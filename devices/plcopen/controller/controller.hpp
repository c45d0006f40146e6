#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/problem.hpp"
#include "devices/controller.hpp"
#include "devices/due.hpp"
#include "devices/plcopen/axis.hpp"
#include "devices/plcopen/kernel.hpp"
#include "devices/plcopen/st/program.hpp"
#include "devices/plcopen/st/runtime.hpp"
#include "devices/plcopen/terminals.hpp"

namespace drycut::devices::plcopen {

/// What a controller is made of, its program apart.
struct PlcopenConfiguration {
  std::vector<AxisConfiguration> axes;
  std::vector<McCamTable> tables;  ///< each id once, types known
  std::int64_t cycle_ns = MotionKernel::default_cycle_ns;
  std::int64_t task_ns = MotionKernel::default_cycle_ns;  ///< a whole multiple of cycle_ns
  std::vector<st::Program::Task> tasks = {};  ///< in place of those of the program's CONFIGURATION
  std::int64_t statement_ns = 0;              ///< what a statement of the program takes
};

/// A PLCopen motion controller: a Structured Text program in front of the motion kernel.
///
/// A cycle latches encoders and inputs, moves the axes and gives their references; then, in every
/// task_ns/cycle_ns-th cycle, the program is scanned on the axes as they are after it and gives its outputs;
/// programs with tasks of their own at these tasks' intervals, the lowest priority number first. What a
/// program commands moves the axes from the next cycle on.
///
/// With statement_ns a task takes inputs and runs as it begins and gives its outputs as its statements have
/// had their time; what it commands moves the axes from the next cycle on all the same. Tasks do not
/// interrupt each other: one that is due meanwhile begins late, and one that ends after its next beginning
/// was due is told ("overrun"), the beginnings that it has missed are left out.
///
/// Power off loses everything but RETAIN variables, axis parameters and the operator's hand (override, feed
/// hold); until power is back, the variables and what the axes report read 0. An incremental encoder counts
/// from 0 at power-up; with homed_at_start it is absolute and keeps its counts. Tables come from their files
/// again.
class PlcopenController : public Controller {
 public:
  /// `program` is free of problems and names no axis that `configuration` lacks; `files` name its files in
  /// messages. Begins powered on, at time 0.
  PlcopenController(st::Program program, std::vector<std::string> files, PlcopenConfiguration configuration);
  /// Of one file.
  PlcopenController(st::Program program, std::string file, PlcopenConfiguration configuration)
      : PlcopenController(std::move(program), std::vector{std::move(file)}, std::move(configuration)) {}

  Cards& cards() override { return cards_; }
  /// `Knife.encoder`, `IX0.0`, `%QX0.1`: see axis_terminal_table.
  std::variant<Address, TerminalFault> terminal(const std::string& text) override;
  [[nodiscard]] std::string terminal_name(const Address& address) const override;
  [[nodiscard]] std::vector<Period> periods() const override;
  [[nodiscard]] std::int64_t output_period(const Address& analogue) const override;
  void run_devices(std::int64_t time_ns) override;
  void run_tasks(std::int64_t time_ns) override;
  void interrupt(int line, bool rising) override;
  void power(bool on) override;
  void visit(StateArchive& archive) override;

  /// Values by name, any case: variables and pins of the program (`state`, `CamIn.InSync`), values of axes
  /// (axis_value_table: `Knife.actual_position`), their parameters in the kernel's units
  /// (`Knife.cam_gear.v_phasing`), elements of cam tables (`table1[3,2]`: table 1, line 3, column 2, from 1).
  std::optional<ControllerValue> find(const std::string& name) override;
  /// Elements of tables apart.
  [[nodiscard]] std::vector<std::string> names() const override;

  [[nodiscard]] std::vector<CamAxis> cam_axes() override;

  [[nodiscard]] std::variant<const ModbusFace*, std::string> modbus() const override;
  /// To be filled from elsewhere too; it has what the program has AT %M.
  [[nodiscard]] MemoryFace& modbus_map() { return modbus_; }
  /// Variables by the names of find(), pins of a block in its call too; those of a function block's own text
  /// for each of its instances, four at most.
  [[nodiscard]] std::vector<ProgramText> programs() override;
  void watch_programs(bool on) override { runtime_.watch(on); }
  void count_programs() override { runtime_.count(); }
  void add_coverage(Coverage& to) const override { runtime_.add_coverage(to, files_); }
  [[nodiscard]] ProgramPositions positions(std::int64_t time_ns) const override;
  [[nodiscard]] std::vector<ProgramWait> waits() override;
  [[nodiscard]] std::vector<PositionLoop> position_loops() override;
  [[nodiscard]] std::vector<ProgramDoubt> doubts() const override;

  [[nodiscard]] bool has_events() const override { return !events_.empty(); }
  std::vector<ControllerEvent> take_events() override { return std::exchange(events_, {}); }

  /// The RETAIN variables, one `name = value` a line.
  [[nodiscard]] std::string retentive_state() const override;
  /// Puts such a text back; variables that it does not name keep their initial values. False, and nothing
  /// changed, if `problems` had to be added.
  bool restore(const std::string& text, Problems& problems,
               const std::string& file_name = "retentive state") override;

 private:
  /// The terminals of an axis that are there, and its state a cycle ago.
  struct AxisPlugs {
    const Counter* encoder = nullptr;
    AnalogueOutput* reference = nullptr;
    DigitalOutput* enable = nullptr;
    const DigitalInput* ready = nullptr;
    const DigitalInput* emergency_stop = nullptr;
    const DigitalInput* feed_enable = nullptr;
    const DigitalInput* feed_hold = nullptr;
    std::int64_t counts_at_power_up = 0;
    bool in_errorstop = false;

    void visit(StateArchive& archive);
  };
  /// A block of the program with Error and ErrorID pins.
  struct ErrorPins {
    std::string instance;
    std::size_t error = 0;
    std::size_t id = 0;
    bool seen = false;
    std::optional<std::size_t> command = {};  ///< Execute or Enable
    bool commanded = false;                   ///< it has been TRUE

    void visit(StateArchive& archive);
  };

  void add_axes();
  void add_located();
  void add_memory();
  void find_error_pins();
  void plug_in(int axis, const AxisTerminal& terminal);
  Axis& axis(int number) { return *kernel_.axis({number}); }
  [[nodiscard]] const Axis& axis(int number) const { return *kernel_.axis({number}); }
  std::variant<Address, TerminalFault> axis_terminal(const TerminalName& name, const std::string& text);
  void start_anew();
  void latch_power_up();
  void latch_inputs();
  void run_programs(std::int64_t time_ns);
  void run_timed(std::int64_t time_ns);
  void take_located();
  void give_located();
  void tell_overrun(const st::TaskRun& run);
  void give_outputs();
  void tell_axes();
  /// "knife.st:5:3", of a line of all files.
  [[nodiscard]] std::string told_place(int line, int column) const;
  void tell_blocks();
  [[nodiscard]] CamMoment cam_moment(int number) const;
  [[nodiscard]] std::shared_ptr<const devices::CamTable> cam_table(int number) const;
  std::optional<ControllerValue> axis_value(int number, std::string_view name);
  std::optional<ControllerValue> parameter_value(int number, const AxisParameter& parameter);
  std::optional<ControllerValue> table_value(std::string_view name);
  ControllerValue symbol_value(std::size_t symbol);
  void set_parameter(int number, const AxisParameter& parameter, double value);
  void read_kept(std::string_view line, int number, const std::string& file,
                 std::vector<std::pair<std::size_t, double>>& kept, Problems& problems) const;

  st::Program program_;
  std::vector<std::string> files_;
  PlcopenConfiguration configuration_;
  Cards cards_;
  MotionKernel kernel_;
  std::vector<AxisPlugs> plugs_;
  st::Runtime runtime_;
  std::vector<DigitalInput*> located_inputs_;    ///< one a variable AT, nullptr at an output
  std::vector<DigitalOutput*> located_outputs_;  ///< nullptr at an input
  std::map<std::string, std::size_t> symbols_;   ///< by name in lower case
  std::vector<ErrorPins> blocks_;
  std::vector<ControllerEvent> events_;
  Due cycle_{configuration_.cycle_ns};
  std::int64_t next_task_ns_ = 0;
  std::optional<st::TaskRun> computing_;  ///< a task whose outputs are to come
  std::vector<std::string> late_;         ///< tasks that overran the last time they ran
  bool powered_ = true;
  MemoryFace modbus_{powered_};
  bool power_up_due_ = true;
  bool fault_told_ = false;
};

}  // namespace drycut::devices::plcopen
