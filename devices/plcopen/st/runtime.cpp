#include "devices/plcopen/st/runtime.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "base/state_archive.hpp"
#include "base/text.hpp"
#include "devices/due.hpp"
#include "devices/plcopen/st/code.hpp"
#include "devices/plcopen/st/coverage.hpp"
#include "devices/plcopen/st/machine.hpp"

namespace drycut::devices::plcopen::st {

namespace {

/// A task and its programs.
struct ScheduledTask {
  std::string name;
  Due due;
  int priority = 0;
  int single = -1;
  bool last = false;  ///< of SINGLE
  std::vector<std::size_t> programs = {};

  void visit(StateArchive& archive) { STATE(archive, due, last); }
};

/// The tasks by their priorities, the controller's own last.
std::vector<ScheduledTask> plan(const Compiled& code, const Schedule& schedule) {
  const bool given = !schedule.tasks.empty();
  std::vector<ScheduledTask> plan;
  const auto& tasks = given ? schedule.tasks : code.tasks;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    const int single = given ? -1 : code.singles[i];
    plan.push_back(
        {tasks[i].name, {single >= 0 ? schedule.cycle_ns : tasks[i].interval_ns}, tasks[i].priority, single});
  }
  plan.push_back({"program", {schedule.task_ns}, std::numeric_limits<int>::max()});
  for (std::size_t i = 0; i < code.instance_names.size() && i < code.instances.size(); ++i) {
    const Program::Instance& instance = code.instance_names[i];
    std::size_t task = instance.task < 0 || given ? tasks.size() : static_cast<std::size_t>(instance.task);
    for (std::size_t t = 0; given && t < tasks.size(); ++t)
      for (const std::string& name : tasks[t].programs)
        if (same_word(name, instance.name)) task = t;
    plan[task].programs.push_back(i);
  }
  std::erase_if(plan, [](const ScheduledTask& task) { return task.programs.empty(); });
  std::stable_sort(plan.begin(), plan.end(),
                   [](const ScheduledTask& a, const ScheduledTask& b) { return a.priority < b.priority; });
  return plan;
}

}  // namespace

struct Runtime::State {
  State(Program of, MotionKernel& kernel, const Schedule& schedule)
      : program(std::move(of)),
        machine(program.compiled(), kernel),
        tasks(plan(program.compiled(), schedule)),
        statement_ns(schedule.statement_ns) {}

  /// Whether a task runs now; an edge of its SINGLE is seen once.
  bool is_due(ScheduledTask& task, std::int64_t time_ns) const {
    if (!task.due.take(time_ns)) return false;
    if (task.single < 0) return true;
    const bool before = std::exchange(task.last, machine.cell(task.single) != 0);
    return task.last && !before;
  }

  /// The programs of a task; false after a fault.
  bool run(const ScheduledTask& task, std::int64_t time_ns) {
    const auto& instances = program.compiled().instances;
    order.clear();
    try {
      for (const std::size_t number : task.programs) {
        if (watched || counts) trace(number);
        machine.run(instances[number], time_ns);
      }
    } catch (const StError& error) {
      fault = RuntimeFault{error.line, error.column, error.what()};
    }
    return !fault;
  }

  /// Has the machine tell what it executes of a program from now on.
  void trace(std::size_t number) {
    traces.resize(program.compiled().instances.size());
    if (watched) traces[number].lines.assign(static_cast<std::size_t>(program.lines().count()), ' ');
    traces[number].order = watched && statement_ns > 0 ? &order : nullptr;
    traces[number].counts = counts ? &*counts : nullptr;
    machine.trace(&traces[number]);
  }

  Program program;
  Machine machine;
  std::vector<ScheduledTask> tasks;
  std::int64_t statement_ns;
  std::int64_t free_ns = 0;  ///< the last task has ended
  std::optional<RuntimeFault> fault;
  bool watched = false;
  std::optional<Counts> counts = {};
  std::vector<Trace> traces = {};  ///< of each program; none before it ran
  std::vector<int> order = {};     ///< lines of the statements of the task that ran last
};

Runtime::Runtime(Program program, MotionKernel& kernel, Schedule schedule)
    : state_(std::make_unique<State>(std::move(program), kernel, schedule)) {
  cold_start(true);
}
Runtime::~Runtime() = default;

void Runtime::cold_start(bool all) {
  state_->fault.reset();
  state_->machine.start(all);
  state_->free_ns = 0;
  watch(state_->watched);
  for (ScheduledTask& task : state_->tasks) task.last = false;
}

void Runtime::scan(std::int64_t time_ns) {
  if (state_->fault) return pass(time_ns);
  for (ScheduledTask& task : state_->tasks)
    if (state_->is_due(task, time_ns) && !state_->run(task, time_ns)) return;
}

std::optional<TaskRun> Runtime::run_next(std::int64_t time_ns) {
  if (state_->fault) {
    pass(time_ns);
    return std::nullopt;
  }
  for (ScheduledTask& task : state_->tasks) {
    const std::int64_t due_ns = task.due.next_ns;
    if (!state_->is_due(task, time_ns)) continue;
    const std::int64_t begun_ns = std::max(due_ns, state_->free_ns);
    const std::int64_t before = state_->machine.statements();
    state_->run(task, time_ns);
    state_->free_ns = begun_ns + (state_->machine.statements() - before) * state_->statement_ns;
    return TaskRun{task.name, due_ns, begun_ns, state_->free_ns, task.single < 0 ? task.due.period_ns : 0};
  }
  return std::nullopt;
}

void Runtime::pass(std::int64_t time_ns) {
  for (ScheduledTask& task : state_->tasks) task.due.take(time_ns);
}

std::int64_t Runtime::next_ns() const {
  std::int64_t next = std::numeric_limits<std::int64_t>::max();
  for (const ScheduledTask& task : state_->tasks) next = std::min(next, task.due.next_ns);
  return next;
}

std::span<const StSymbol> Runtime::symbols() const { return state_->program.compiled().symbols; }

double Runtime::read(std::size_t symbol) const {
  const SymbolPlace& place = state_->program.compiled().places.at(symbol);
  const Cell cell = state_->machine.cell(place.cell);
  if (is_real(place.basic)) {
    const double most = static_cast<double>(place.basic == Basic::real ? std::numeric_limits<float>::max()
                                                                       : std::numeric_limits<double>::max());
    return std::isnan(real_of(cell)) ? 0 : std::clamp(real_of(cell), -most, most);
  }
  if (is_wide(place.basic)) return static_cast<double>(static_cast<std::uint64_t>(cell));
  return is_clock(place.basic) ? static_cast<double>(cell) / per_second(place.basic)
                               : static_cast<double>(cell);
}

bool Runtime::holds(std::size_t symbol) const {
  return state_->machine.cell(state_->program.compiled().places[symbol].cell) != 0;
}

const FunctionBlock* Runtime::block(std::size_t symbol) const {
  return state_->machine.motion_at(state_->program.compiled().places.at(symbol).cell);
}

std::string_view Runtime::block_type(std::size_t symbol) const {
  const Compiled& code = state_->program.compiled();
  const int place = code.places.at(symbol).cell;
  for (const Compiled::Motion& motion : code.motions)
    if (place >= motion.cell && place < motion.cell + motion.type->cells) return motion.type->motion->name;
  return "";
}

void Runtime::write(std::size_t number, double value) {
  const Compiled& code = state_->program.compiled();
  const SymbolPlace& place = code.places.at(number);
  const StSymbol& symbol = code.symbols[number];
  if (!symbol.writable || std::isnan(value)) return;
  value = std::clamp(value, symbol.min, symbol.max);
  if (is_real(place.basic)) {
    state_->machine.set_cell(place.cell, cell_of(rounded(place.basic, value)));
    return;
  }
  const double whole = std::nearbyint(is_clock(place.basic) ? value * per_second(place.basic) : value);
  state_->machine.set_cell(place.cell, apply(StOp::to_whole, place.basic, cell_of(whole), 0));
}

void Runtime::watch(bool on) {
  state_->watched = on;
  state_->machine.trace(nullptr);
  state_->traces.clear();
  state_->order.clear();
}

void Runtime::count() { state_->counts.emplace(state_->program.compiled().code.size()); }

void Runtime::add_coverage(Coverage& to, std::span<const std::string> files) const {
  if (state_->counts) to.add(coverage_of(state_->program.compiled(), *state_->counts, files));
}

std::string Runtime::scanned() const {
  std::string all;
  for (const Trace& trace : state_->traces) {
    if (all.empty()) all.assign(trace.lines.size(), ' ');
    for (std::size_t i = 0; i < trace.lines.size(); ++i)
      if (all[i] != '+' && trace.lines[i] != ' ') all[i] = trace.lines[i];
  }
  return all;
}

int Runtime::line_at(std::int64_t into_ns) const {
  if (state_->order.empty() || state_->statement_ns == 0) return 0;
  const auto statement = static_cast<std::size_t>(std::max<std::int64_t>(into_ns, 0) / state_->statement_ns);
  return state_->order[std::min(statement, state_->order.size() - 1)];
}

bool Runtime::located(std::size_t i) const {
  const Compiled& code = state_->program.compiled();
  const Cell cell = state_->machine.cell(code.located_cells.at(i).cell);
  const int bit = code.located[i].bit;
  return bit < 0 ? cell != 0 : (static_cast<std::uint64_t>(cell) >> bit & 1U) != 0;
}
void Runtime::set_located(std::size_t i, bool level) {
  const Compiled& code = state_->program.compiled();
  const auto& [place, basic] = code.located_cells.at(i);
  const int bit = code.located[i].bit;
  if (bit < 0) return state_->machine.set_cell(place, level ? 1 : 0);
  const std::uint64_t mask = std::uint64_t{1} << bit;
  const auto value = static_cast<std::uint64_t>(state_->machine.cell(place));
  state_->machine.set_cell(place, wrapped(basic, static_cast<Cell>(level ? value | mask : value & ~mask)));
}
std::vector<RuntimeFault> Runtime::take_losses() {
  std::vector<RuntimeFault> losses;
  for (auto& [line, column, text] : state_->machine.take_losses())
    losses.push_back({line, column, std::move(text)});
  return losses;
}
const std::optional<RuntimeFault>& Runtime::fault() const { return state_->fault; }

void RuntimeFault::visit(StateArchive& archive) { STATE(archive, line, column, text); }
void TaskRun::visit(StateArchive& archive) { STATE(archive, task, due_ns, begun_ns, ended_ns, interval_ns); }

void Runtime::visit(StateArchive& archive) {
  for (ScheduledTask& task : state_->tasks) archive.named(task.name, task);
  archive("machine, free_ns, fault", state_->machine, state_->free_ns, state_->fault);
  if (archive.restores()) watch(state_->watched);
}

}  // namespace drycut::devices::plcopen::st
