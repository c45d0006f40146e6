#include "devices/plcopen/controller/controller.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>

#include "base/state_archive.hpp"
#include "base/text.hpp"

namespace drycut::devices::plcopen {
namespace {

MotionKernel make_kernel(const PlcopenConfiguration& configuration) {
  MotionKernel kernel(configuration.cycle_ns);
  for (const AxisConfiguration& axis : configuration.axes) kernel.add_axis(axis.name, axis.parameters);
  for (const McCamTable& table : configuration.tables) {
    [[maybe_unused]] const ErrorId error = kernel.add_table(table);
    assert(error == ErrorId::none);
  }
  return kernel;
}

std::string error_text(ErrorId id) {
  return fmt::format("{} {}", static_cast<std::uint32_t>(id), meaning_of(id));
}

std::string joined(const std::vector<std::string>& names, std::string_view none) {
  return names.empty() ? std::string(none) : listed(names);
}

std::string_view kind_text(AxisKind kind) {
  constexpr std::array<std::string_view, 3> texts{"a drive axis", "a virtual axis", "an encoder axis"};
  return texts.at(static_cast<std::size_t>(kind));
}

AxisKind kind_of(const AxisConfiguration& axis) { return axis.parameters.kind; }

}  // namespace

PlcopenController::PlcopenController(st::Program program, std::vector<std::string> files,
                                     PlcopenConfiguration configuration)
    : program_(std::move(program)),
      files_(std::move(files)),
      configuration_(std::move(configuration)),
      kernel_(make_kernel(configuration_)),
      plugs_(configuration_.axes.size()),
      runtime_(program_, kernel_,
               {configuration_.tasks, configuration_.task_ns, configuration_.cycle_ns,
                configuration_.statement_ns}) {
  assert(configuration_.cycle_ns > 0 && configuration_.task_ns % configuration_.cycle_ns == 0);
  add_axes();
  add_located();
  add_memory();
  const auto symbols = runtime_.symbols();
  for (std::size_t i = 0; i < symbols.size(); ++i) symbols_.emplace(lower(symbols[i].name), i);
  find_error_pins();
}

// What an axis cannot do without has a terminal from the start, so that a missing wire is told.
void PlcopenController::add_axes() {
  for (std::size_t i = 0; i < configuration_.axes.size(); ++i)
    for (const AxisTerminal& terminal : axis_terminal_table())
      if ((terminal.kind == Kind::counter || terminal.kind == Kind::analogue) &&
          terminal.offered_by(kind_of(configuration_.axes[i])))
        plug_in(static_cast<int>(i), terminal);
}

void PlcopenController::add_located() {
  for (const auto& located : program_.located()) {
    const bool output = located.address.kind == Kind::output;
    located_inputs_.push_back(output ? nullptr : &cards_.inputs[located.address]);
    located_outputs_.push_back(output ? &cards_.outputs[located.address] : nullptr);
  }
}

// Functions 1 and 2 read the same bits, 3 and 4 the same words.
void PlcopenController::add_memory() {
  for (const auto& variable : program_.in_memory()) {
    const int each = addresses_of(variable.place);
    const bool bits = variable.place.size == 'X';
    for (int i = 0; i < variable.count; ++i) {
      const auto name =
          variable.low ? fmt::format("{}[{}]", variable.name, *variable.low + i) : variable.name;
      for (const auto table : bits ? std::array{ModbusTable::coils, ModbusTable::discrete_inputs}
                                   : std::array{ModbusTable::holding_registers, ModbusTable::input_registers})
        modbus_.add(table, (variable.place.number + i) * each, name, variable.format, true);
    }
  }
}

std::variant<const ModbusFace*, std::string> PlcopenController::modbus() const {
  if (!modbus_.empty()) return &modbus_;
  return "variables AT %MX0.0, %MW0, %MD0 or %ML0 in the program, or controller.plcopen.modbus in the "
         "scenario";
}

void PlcopenController::find_error_pins() {
  constexpr std::string_view pin = ".error";
  for (const auto& [name, symbol] : symbols_) {
    if (!name.ends_with(pin)) continue;
    const auto id = symbols_.find(name + "id");
    if (id == symbols_.end()) continue;
    const std::string& spelled = runtime_.symbols()[symbol].name;
    blocks_.push_back({spelled.substr(0, spelled.size() - pin.size()), symbol, id->second});
    for (const auto* command : {".execute", ".enable"})
      if (const auto found = symbols_.find(name.substr(0, name.size() - pin.size()) + command);
          found != symbols_.end())
        blocks_.back().command = found->second;
  }
}

void PlcopenController::plug_in(int number, const AxisTerminal& terminal) {
  const Address address = terminal.address(number);
  AxisPlugs& plugs = plugs_[static_cast<std::size_t>(number)];
  switch (terminal.kind) {
    case Kind::counter:
      plugs.encoder = &cards_.counters[address];
      break;
    case Kind::analogue:
      plugs.reference = &cards_.analogue_outputs[address];
      break;
    case Kind::output:
      plugs.enable = &cards_.outputs[address];
      break;
    case Kind::input: {
      const DigitalInput* input = &cards_.inputs[address];
      if (terminal.number == ready_input) plugs.ready = input;
      if (terminal.number == emergency_stop_input) plugs.emergency_stop = input;
      if (terminal.number == feed_enable_input) plugs.feed_enable = input;
      if (terminal.number == feed_hold_input) plugs.feed_hold = input;
      break;
    }
    case Kind::interrupt:
      break;
  }
}

std::variant<Address, TerminalFault> PlcopenController::terminal(const std::string& text) {
  const auto name = parse_terminal(text);
  if (!name)
    return TerminalFault{
        "wiring.no-terminal"_code, fmt::format("'{}' is not a terminal of the controller", text),
        "write axis.encoder, axis.reference, axis.enable, ..., or IX0.0, QX0.7 for a BOOL of the "
        "program"};
  if (!name->axis.empty()) return axis_terminal(*name, text);
  const bool output = name->address.kind == Kind::output;
  if (output ? cards_.outputs.contains(name->address) : cards_.inputs.contains(name->address))
    return name->address;
  std::vector<std::string> known;
  for (const auto& located : program_.located())
    if (located.address.kind == name->address.kind) known.push_back(located_name(located.address));
  return TerminalFault{"wiring.no-terminal"_code,
                       fmt::format("the program has no variable AT %{}", located_name(name->address)),
                       fmt::format("its {} are: {}", output ? "outputs" : "inputs", joined(known, "none"))};
}

std::variant<Address, TerminalFault> PlcopenController::axis_terminal(const TerminalName& name,
                                                                      const std::string& text) {
  const int number = kernel_.find_axis(name.axis).number;
  if (number < 0) {
    std::vector<std::string> axes;
    for (const auto& axis : configuration_.axes) axes.push_back(axis.name);
    const auto near = nearest(name.axis, axes);
    return TerminalFault{
        "wiring.no-terminal"_code, fmt::format("'{}' is no terminal: there is no axis '{}'", text, name.axis),
        near.empty() ? fmt::format("axes: {}", joined(axes, "none")) : fmt::format("did you mean {}?", near)};
  }
  const AxisConfiguration& axis = configuration_.axes[static_cast<std::size_t>(number)];
  if (name.terminal != nullptr && name.terminal->offered_by(kind_of(axis))) {
    plug_in(number, *name.terminal);
    return name.terminal->address(number);
  }
  std::vector<std::string> offered;
  for (const AxisTerminal& candidate : axis_terminal_table())
    if (candidate.offered_by(kind_of(axis)))
      offered.push_back(fmt::format("{}.{}", axis.name, candidate.name));
  return TerminalFault{"wiring.no-terminal"_code,
                       fmt::format("{} is {} and has no terminal '{}'", axis.name, kind_text(kind_of(axis)),
                                   text.substr(name.axis.size() + 1)),
                       fmt::format("it has: {}", joined(offered, "none"))};
}

std::string PlcopenController::terminal_name(const Address& address) const {
  if (address.slot == 0) return located_name(address);
  const int number = address.slot - 1;
  for (const AxisTerminal& terminal : axis_terminal_table())
    if (terminal.address(number) == address)
      return fmt::format("{}.{}", configuration_.axes[static_cast<std::size_t>(number)].name, terminal.name);
  return {};
}

std::vector<Controller::Period> PlcopenController::periods() const {
  std::vector<Period> periods{{"cycle", configuration_.cycle_ns, true},
                              {"task_cycle", configuration_.task_ns}};
  for (const auto& task : configuration_.tasks.empty() ? program_.tasks() : configuration_.tasks)
    if (task.interval_ns > 0) periods.push_back({"task " + task.name, task.interval_ns});
  return periods;
}

std::int64_t PlcopenController::output_period(const Address& analogue) const {
  return cards_.analogue_outputs.contains(analogue) ? configuration_.cycle_ns : 0;
}

// Called every step of the simulation: most calls end at the first line.
void PlcopenController::run_devices(std::int64_t time_ns) {
  if (!cycle_.take(time_ns)) return;
  if (!powered_) return;
  if (std::exchange(power_up_due_, false)) latch_power_up();
  latch_inputs();
  kernel_.cycle();
  give_outputs();
  tell_axes();
}

void PlcopenController::run_tasks(std::int64_t time_ns) {
  if (time_ns < next_task_ns_) return;
  if (!powered_) runtime_.pass(time_ns);
  if (powered_ && configuration_.statement_ns > 0) return run_timed(time_ns);
  if (powered_) run_programs(time_ns);
  next_task_ns_ = runtime_.next_ns();
}

void PlcopenController::run_programs(std::int64_t time_ns) {
  take_located();
  runtime_.scan(time_ns);
  give_located();
  tell_axes();
  tell_blocks();
}

// One task after the other, each until its statements have had their time.
void PlcopenController::run_timed(std::int64_t time_ns) {
  while (true) {
    if (computing_) {
      next_task_ns_ = computing_->ended_ns;
      if (time_ns < next_task_ns_) return;
      give_located();
      tell_overrun(*computing_);
    }
    take_located();
    computing_ = runtime_.run_next(time_ns);
    next_task_ns_ = runtime_.next_ns();
    if (!computing_) return;
    tell_axes();
    tell_blocks();
  }
}

void PlcopenController::take_located() {
  for (std::size_t i = 0; i < located_inputs_.size(); ++i)
    if (located_inputs_[i] != nullptr) runtime_.set_located(i, located_inputs_[i]->level);
}

void PlcopenController::give_located() {
  for (std::size_t i = 0; i < located_outputs_.size(); ++i)
    if (located_outputs_[i] != nullptr) located_outputs_[i]->level = runtime_.located(i);
}

// Once, until it has come in time again.
void PlcopenController::tell_overrun(const st::TaskRun& run) {
  const std::int64_t next_ns = run.due_ns + run.interval_ns;
  if (run.interval_ns == 0 || run.ended_ns <= next_ns) {
    std::erase(late_, run.task);
    return;
  }
  if (std::find(late_.begin(), late_.end(), run.task) != late_.end()) return;
  late_.push_back(run.task);
  constexpr double ns_per_ms = 1e6;
  const auto ms = [](std::int64_t ns) { return static_cast<double>(ns) / ns_per_ms; };
  events_.push_back(
      {run.task, "overrun",
       fmt::format("due every {:.9g} ms, it waited {:.9g} ms for others and took {:.9g} ms: it "
                   "starts late, or not at all where a start is due meanwhile",
                   ms(run.interval_ns), ms(run.begun_ns - run.due_ns), ms(run.ended_ns - run.begun_ns))});
}

void PlcopenController::interrupt(int line, bool rising) {
  const auto number = static_cast<std::size_t>(line - 1);
  if (!powered_ || power_up_due_ || !rising || line < 1 || number >= plugs_.size()) return;
  if (plugs_[number].encoder == nullptr) return;
  DriveInputs& drive = axis(line - 1).drive;
  drive.probe_counts = plugs_[number].encoder->latched - plugs_[number].counts_at_power_up;
  ++drive.probe_edges;
}

void PlcopenController::power(bool on) {
  if (on == powered_) return;
  powered_ = on;
  if (!on) {
    for (auto& [address, output] : cards_.outputs) output.level = false;
    for (auto& [address, output] : cards_.analogue_outputs) output.word = 0;
  }
  // When power is lost too: an axis without power is Disabled and takes its machine data.
  start_anew();
}

void PlcopenController::start_anew() {
  // What has been written into the machine data stays there.
  for (int i = 0; i < kernel_.axes(); ++i)
    configuration_.axes[static_cast<std::size_t>(i)].parameters = axis(i).parameters();
  MotionKernel fresh = make_kernel(configuration_);
  for (int i = 0; i < kernel_.axes(); ++i) {
    Axis& made = *fresh.axis({i});
    made.control = axis(i).control;
    made.drive.ready = axis(i).drive.ready;
    made.drive.emergency_stop = axis(i).drive.emergency_stop;
  }
  kernel_ = std::move(fresh);
  runtime_.cold_start();
  power_up_due_ = true;
  fault_told_ = false;
  computing_.reset();
  late_.clear();
  for (ErrorPins& block : blocks_) block.seen = false;
  for (AxisPlugs& plugs : plugs_) plugs.in_errorstop = false;
}

// An incremental encoder's counter begins at 0, an absolute encoder knows where it is.
void PlcopenController::latch_power_up() {
  for (std::size_t i = 0; i < plugs_.size(); ++i) {
    AxisPlugs& plugs = plugs_[i];
    const bool absolute = configuration_.axes[i].parameters.homed_at_start;
    plugs.counts_at_power_up = absolute || plugs.encoder == nullptr ? 0 : plugs.encoder->count;
  }
}

void PlcopenController::latch_inputs() {
  for (std::size_t i = 0; i < plugs_.size(); ++i) {
    const AxisPlugs& plugs = plugs_[i];
    Axis& present = axis(static_cast<int>(i));
    if (plugs.encoder != nullptr) present.drive.counts = plugs.encoder->count - plugs.counts_at_power_up;
    if (plugs.ready != nullptr) present.drive.ready = plugs.ready->level;
    if (plugs.emergency_stop != nullptr) present.drive.emergency_stop = plugs.emergency_stop->level;
    if (plugs.feed_enable != nullptr) present.control.feed_enable = plugs.feed_enable->level;
    if (plugs.feed_hold != nullptr) present.control.feed_hold = plugs.feed_hold->level;
  }
}

void PlcopenController::give_outputs() {
  for (std::size_t i = 0; i < plugs_.size(); ++i) {
    const DriveOutputs& outputs = axis(static_cast<int>(i)).outputs();
    if (plugs_[i].reference != nullptr) plugs_[i].reference->word = outputs.reference;
    if (plugs_[i].enable != nullptr) plugs_[i].enable->level = outputs.enable;
  }
}

void PlcopenController::tell_axes() {
  for (std::size_t i = 0; i < plugs_.size(); ++i) {
    Axis& present = axis(static_cast<int>(i));
    if (present.has_remarks())
      for (const AxisRemark& remark : present.take_remarks())
        events_.push_back({present.name(), remark.event, remark.text});
    const bool now = present.state() == AxisState::errorstop;
    if (now && !plugs_[i].in_errorstop)
      events_.push_back({present.name(), "errorstop", error_text(present.error())});
    plugs_[i].in_errorstop = now;
  }
}

// Once for each rising Error pin, and why the program stands.
void PlcopenController::tell_blocks() {
  for (ErrorPins& block : blocks_) {
    const bool now = runtime_.holds(block.error);
    if (now && !block.seen) {
      const auto id = static_cast<ErrorId>(static_cast<std::uint32_t>(runtime_.read(block.id)));
      const FunctionBlock* motion = runtime_.block(block.error);
      const Axis* about = motion == nullptr ? nullptr : kernel_.axis(motion->about);
      events_.push_back(
          {block.instance, "block_error", error_text(id) + (about == nullptr ? "" : ": " + about->name())});
    }
    block.seen = now;
    if (!block.commanded && block.command) block.commanded = runtime_.holds(*block.command);
  }
  for (const auto& loss : runtime_.take_losses())
    events_.push_back(
        {"program", "value_cut", fmt::format("{}: {}", told_place(loss.line, loss.column), loss.text)});
  const auto& fault = runtime_.fault();
  if (!fault || fault_told_) return;
  fault_told_ = true;
  events_.push_back(
      {"program", "error", fmt::format("{}: {}", told_place(fault->line, fault->column), fault->text)});
}

std::string PlcopenController::told_place(int line, int column) const {
  const auto at = program_.lines().at(line);
  return fmt::format("{}:{}:{}", files_.at(at.file), at.line, column);
}

void PlcopenController::AxisPlugs::visit(StateArchive& archive) {
  STATE(archive, counts_at_power_up, in_errorstop);
}

void PlcopenController::ErrorPins::visit(StateArchive& archive) { STATE(archive, seen, commanded); }

void PlcopenController::visit(StateArchive& archive) {
  STATE(archive, cards_, kernel_, plugs_, runtime_, blocks_, events_, cycle_, next_task_ns_, computing_);
  STATE(archive, late_, powered_, power_up_due_, fault_told_);
  // What the next power-up gives to the axes.
  for (AxisConfiguration& axis : configuration_.axes)
    archive.named(fmt::format("kept_{}", axis.name), axis.parameters);
}

}  // namespace drycut::devices::plcopen
