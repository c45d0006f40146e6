#include "devices/qmove/qmove_controller.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <limits>
#include <utility>

#include <fmt/format.h>

namespace drycut::devices::qmove {

namespace {

constexpr std::int64_t ns_per_ms = 1'000'000;
constexpr std::int64_t long_turn_ns = 1'000'000'000;

std::string_view event_of(const Diagnostic& diagnostic) {
  switch (diagnostic.kind) {
    case Diagnostic::Kind::command_refused:
    case Diagnostic::Kind::write_refused:
      return "refused";
    case Diagnostic::Kind::out_of_range:
      return "out_of_range";
    case Diagnostic::Kind::note:
      return "note";
    case Diagnostic::Kind::warning:
      return "warning";
    case Diagnostic::Kind::contradiction:
      return "contradiction";
  }
  return "warning";
}

}  // namespace

QmoveController::QmoveController(Configuration configuration, std::vector<QclProgram> programs,
                                 std::span<const CatalogueEntry> catalogue, std::int64_t cycle_ns,
                                 std::int64_t statement_ns)
    : configuration_(std::move(configuration)),
      programs_(std::move(programs)),
      names_(configuration_),
      round_{cycle_ns},
      statement_ns_(statement_ns) {
  assert(cycle_ns > 0);
  machine_.cells.assign(static_cast<std::size_t>(names_.cells()), 0);
  machine_.timers.assign(configuration_.timers.size(), 0);
  for (const Terminal& input : configuration_.inputs) {
    add_terminal(input.address);
    machine_.inputs.push_back(&cards_.inputs[input.address]);
  }
  for (const Terminal& output : configuration_.outputs) {
    add_terminal(output.address);
    machine_.outputs.push_back(&cards_.outputs[output.address]);
  }
  for (const DeviceRecord& record : configuration_.devices) {
    const CatalogueEntry& entry = catalogue[record.type];
    for (std::size_t i = 0; i < record.resources.size(); ++i) {
      if (record.resources[i].address) add_terminal(*record.resources[i].address);
      if (entry.type->fields[i].kind == Field::Kind::interrupt_line && record.resources[i].number > 0)
        add_terminal({Kind::interrupt, 0, record.resources[i].number});
    }
    machine_.devices.push_back(entry.make(record.resources, cards_));
    if (entry.type == &modbus::modbus_type && !modbus_)
      modbus_.emplace(record.name, *machine_.devices.back(), powered_);
    machine_.oldest_post.push_back(0);
    device_due_.push_back({machine_.devices.back()->period_ms() * ns_per_ms});
  }
  start_tasks();
}

void QmoveController::add_terminal(const Address& address) {
  with_terminals(cards_, address, [](auto& terminals, const auto& key) { terminals.try_emplace(key); });
}

std::vector<Controller::Period> QmoveController::periods() const {
  std::vector<Period> periods;
  for (std::size_t i = 0; i < device_due_.size(); ++i)
    periods.push_back({configuration_.devices[i].name + " TCamp", device_due_[i].period_ns, true});
  periods.push_back({"task cycle", round_.period_ns});
  return periods;
}

std::int64_t QmoveController::output_period(const Address& analogue) const {
  std::int64_t shortest = 0;
  for (std::size_t i = 0; i < device_due_.size(); ++i) {
    const auto& resources = configuration_.devices[i].resources;
    const bool drives = std::any_of(resources.begin(), resources.end(),
                                    [&](const Resource& resource) { return resource.address == analogue; });
    if (drives && (shortest == 0 || device_due_[i].period_ns < shortest)) shortest = device_due_[i].period_ns;
  }
  return shortest;
}

// Called every step of the simulation: most calls end at the first line.
void QmoveController::run_devices(std::int64_t time_ns) {
  if (time_ns < next_device_ns_) return;
  machine_.now = time_ns;
  next_device_ns_ = std::numeric_limits<std::int64_t>::max();
  for (std::size_t i = 0; i < device_due_.size(); ++i) {
    if (device_due_[i].take(time_ns) && powered_) {
      machine_.devices[i]->sample();
      collect_diagnostics(i);
    }
    next_device_ns_ = std::min(next_device_ns_, device_due_[i].next_ns);
  }
}

void QmoveController::run_tasks(std::int64_t time_ns) {
  if (statement_ns_ > 0) return run_timed(time_ns);
  if (!round_.take(time_ns)) return;
  machine_.now = time_ns;
  if (!powered_ || mode_ != OsMode::run) return;
  // A task that waits for what others posted finishes that turn first: it costs it time, never a turn.
  for (std::size_t i = 0; i < tasks_.size(); ++i)
    if (tasks_[i].wait == Task::Wait::others && !turn(i)) return;
  for (std::size_t i = 0; i < tasks_.size(); ++i)
    if (!tasks_[i].ended && !turn(i)) return;
}

// Rounds as above, as far as the time has come; one that lasted too long is followed at once by the next.
void QmoveController::run_timed(std::int64_t time_ns) {
  machine_.now = time_ns;
  while (powered_ && mode_ == OsMode::run) {
    if (!in_round_) {
      const std::int64_t due_ns = round_.next_ns;
      if (computed_ns_ > time_ns || !round_.take(time_ns)) return;
      computed_ns_ = std::max(computed_ns_, due_ns);
      in_round_ = true;
      place_ = 0;
    }
    for (; place_ < 2 * tasks_.size(); ++place_)
      if (!run_place(time_ns)) return;
    in_round_ = false;
  }
  round_.take(time_ns);
}

// The turn at this place of the round; false if there is no time left for it, or an error stopped all.
bool QmoveController::run_place(std::int64_t time_ns) {
  const std::size_t number = place_ % tasks_.size();
  Task& task = tasks_[number];
  const bool its_turn = place_ < tasks_.size() ? task.wait == Task::Wait::others : !task.ended;
  if (!its_turn && !task.in_turn) return true;
  const std::int64_t fit = std::max<std::int64_t>(time_ns - computed_ns_, 0) / statement_ns_;
  std::int64_t left = fit;
  const RunTimeError error = run_statements(programs_[number], task, machine_, left, counts_of(number));
  computed_ns_ += (fit - left) * statement_ns_;
  return finish_turn(number, error) && !task.in_turn;
}

// False if it stopped all tasks.
bool QmoveController::turn(std::size_t number) {
  return finish_turn(number, run_turn(programs_[number], tasks_[number], machine_, counts_of(number)));
}

bool QmoveController::finish_turn(std::size_t number, RunTimeError error) {
  const Task& task = tasks_[number];
  if (machine_.cut) tell_of_cut(number);
  if (error != RunTimeError::none) {
    stop(error, number);
    return false;
  }
  if (task.wait != Task::Wait::none && !task.told && machine_.now - task.turned >= long_turn_ns)
    tell_of_long_turn(number);
  return true;
}

void QmoveController::tell_of_cut(std::size_t number) {
  const QclProgram& program = programs_[number];
  const auto [at, value, kept] = *std::exchange(machine_.cut, {});
  const int line = program.lines[static_cast<std::size_t>(at)];
  if (!tasks_[number].cuts.insert(line).second) return;
  const bool byte = static_cast<Size>(program.code[static_cast<std::size_t>(at)].b) == Size::B;
  events_.push_back(
      {program.name, "value_cut",
       fmt::format("{}:{}: {} does not fit into a variable of size {}, which keeps {}", program.file, line,
                   value, byte ? "B (-128..127)" : "W (-32768..32767)", kept)});
}

void QmoveController::tell_of_long_turn(std::size_t number) {
  Task& task = tasks_[number];
  task.told = true;
  const QclProgram& program = programs_[number];
  const auto at = static_cast<std::size_t>(task.at);
  const std::string& device = configuration_.devices[static_cast<std::size_t>(program.code[at].b)].name;
  events_.push_back(
      {program.name, "held_up",
       fmt::format("{}:{}: no WAIT and no END for 1 s: this statement reads {} and waits until it "
                   "has taken what {} wrote before, as each read does; put a WAIT into the loop",
                   program.file, program.lines[at], device,
                   task.wait == Task::Wait::own ? "the task" : "other tasks")});
}

void QmoveController::interrupt(int line, bool rising) {
  cards_.interrupt_lines[line].level = rising;
  if (!powered_) return;
  for (const auto& device : machine_.devices) device->interrupt(line, rising);
}

void QmoveController::power(bool on) {
  powered_ = on;
  if (on) {
    for (const auto& device : machine_.devices) device->power_up();
    said_.clear();
    start_tasks();
    return;
  }
  mode_ = OsMode::initial;
  for (auto& [address, output] : cards_.outputs) output.level = false;
  for (auto& [address, output] : cards_.analogue_outputs) output.word = 0;
}

// Programs begin at their first statement, with all that is not retentive at zero.
void QmoveController::start_tasks() {
  std::fill_n(machine_.cells.begin(), names_.volatile_cells(), 0);
  std::fill(machine_.timers.begin(), machine_.timers.end(), 0);
  tasks_.assign(programs_.size(), {});
  for (Task& task : tasks_) {
    task.last_post.assign(machine_.devices.size(), 0);
    task.turned = machine_.now;
  }
  in_round_ = false;
  computed_ns_ = machine_.now;
  // A module with faults has no code: there is nothing to run.
  for (std::size_t i = 0; i < programs_.size(); ++i) {
    tasks_[i].ended = programs_[i].code.empty();
    tasks_[i].at = programs_[i].start;
  }
  mode_ = OsMode::run;
  error_ = RunTimeError::none;
}

void QmoveController::stop(RunTimeError error, std::size_t task) {
  mode_ = OsMode::error;
  error_ = error;
  failed_ = task;
  const QclProgram& program = programs_[task];
  events_.push_back({program.name, "error",
                     fmt::format("{}:{}: error {}: {}; all tasks stop", program.file,
                                 program.lines[static_cast<std::size_t>(tasks_[task].at)],
                                 static_cast<int>(error), name_of(error))});
}

void QmoveController::collect_diagnostics(std::size_t device) {
  if (!machine_.devices[device]->has_diagnostics()) return;
  for (Diagnostic& diagnostic : machine_.devices[device]->take_diagnostics()) {
    // The device itself tells each contradiction once, and anew when it comes anew.
    if (diagnostic.kind != Diagnostic::Kind::contradiction &&
        !said_.insert({device, diagnostic.kind, diagnostic.subject, diagnostic.text}).second)
      continue;
    const std::string separator = diagnostic.subject.empty() || diagnostic.text.empty() ? "" : ": ";
    events_.push_back({configuration_.devices[device].name, std::string(event_of(diagnostic)),
                       diagnostic.subject + separator + diagnostic.text});
  }
}

std::vector<CamAxis> QmoveController::cam_axes() {
  std::vector<CamAxis> axes;
  for (std::size_t i = 0; i < machine_.devices.size(); ++i) {
    auto axis = machine_.devices[i]->cam_axis();
    if (!axis) continue;
    axis->name = configuration_.devices[i].name;
    axes.push_back(std::move(*axis));
  }
  return axes;
}

// A device's analogue output regulates, or its first two outputs run forward and backward; its first counter
// is its own.
std::vector<Controller::PositionLoop> QmoveController::position_loops() {
  std::vector<PositionLoop> loops;
  for (std::size_t i = 0; i < machine_.devices.size(); ++i) {
    const DeviceRecord& record = configuration_.devices[i];
    const Device& device = *machine_.devices[i];
    const auto reversed = find_symbol(device.type(), "st_cntrev");
    const Counter* counter = nullptr;
    const AnalogueOutput* dac = nullptr;
    PositionLoop loop;
    std::vector<Address> outputs;
    for (std::size_t f = 0; f < record.resources.size(); ++f) {
      const auto& address = record.resources[f].address;
      const Field& field = device.type().fields[f];
      // The first line is that of its own zero pulse.
      if (field.kind == Field::Kind::interrupt_line && !loop.zero && record.resources[f].number != 0 &&
          counter != nullptr && outputs.empty() && dac == nullptr)
        loop.zero = Address{Kind::interrupt, 0, record.resources[f].number};
      if (!address) continue;
      if (field.kind == Field::Kind::counter && counter == nullptr) {
        counter = &cards_.counters[*address];
        loop.counter = address;
      }
      if (field.kind == Field::Kind::analogue) {
        dac = &cards_.analogue_outputs[*address];
        loop.reference = address;
      }
      if (field.name == "OutAva" || field.name == "OutInd") outputs.push_back(*address);
    }
    if (!reversed || counter == nullptr || (dac == nullptr && outputs.size() != 2)) continue;
    loop.name = record.name;
    loop.counts = [counter, &device, reversed] {
      return device.read(*reversed) != 0 ? -counter->count : counter->count;
    };
    loop.remedy = fmt::format("CNTREV {0} or CNTDIR {0}", record.name);
    if (dac != nullptr) {
      loop.counts_at_10v = [&device] { return device.bits_at_10v(); };
      loop.drive = [dac] { return dac->word * (dac_full_scale_volts / dac_full_scale); };
    } else {
      loop.forward = outputs[0];
      loop.drive = [forward = &cards_.outputs[outputs[0]], backward = &cards_.outputs[outputs[1]]] {
        return (forward->level ? 1.0 : 0.0) - (backward->level ? 1.0 : 0.0);
      };
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

std::vector<Controller::CountedUnit> QmoveController::counted_units() const {
  // Of the first counter of a device and of its master's; cntratio is in 1/100000 of a unit a pulse of 4
  // bits.
  struct Ratio {
    std::string_view units;
    std::string_view counts;  ///< "" = that many counts, below
    double fixed;
  };
  constexpr std::array<std::array<Ratio, 2>, 2> ratios{
      {{{{"measure", "pulse", 0}, {"cntratio", "", 400000}}}, {{{"measurem", "pulsem", 0}, {"", "", 0}}}}};
  std::vector<CountedUnit> units;
  for (std::size_t i = 0; i < machine_.devices.size(); ++i) {
    const DeviceRecord& record = configuration_.devices[i];
    const Device& device = *machine_.devices[i];
    std::size_t number = 0;
    for (std::size_t f = 0; f < record.resources.size(); ++f) {
      if (device.type().fields[f].kind != Field::Kind::counter) continue;
      if (number == ratios.size()) break;
      const auto& address = record.resources[f].address;
      for (const Ratio& ratio : ratios[number]) {
        const auto measure = find_symbol(device.type(), ratio.units);
        const auto pulse = find_symbol(device.type(), ratio.counts);
        if (!address || !measure || (!pulse && !ratio.counts.empty()) || device.read(*measure) == 0) continue;
        const double counts = pulse ? device.read(*pulse) : ratio.fixed;
        units.push_back(
            {record.name,
             fmt::format("{}: {}", record.name,
                         pulse ? fmt::format("{}, {}", ratio.units, ratio.counts) : std::string(ratio.units)),
             *address, counts / device.read(*measure)});
      }
      ++number;
    }
  }
  return units;
}

std::variant<const ModbusFace*, std::string> QmoveController::modbus() const {
  if (modbus_) return &*modbus_;
  return "a device MODBUS in INTDEVICE of the .CNF: hmi MODBUS 0002 1 (drycut devices MODBUS)";
}

std::vector<ControllerEvent> QmoveController::take_events() { return std::exchange(events_, {}); }

}  // namespace drycut::devices::qmove
