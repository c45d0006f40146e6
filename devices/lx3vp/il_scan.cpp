#include "devices/lx3vp/il_scan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "base/state_archive.hpp"
#include "base/text.hpp"
#include "devices/coverage.hpp"
#include "devices/lx3vp/ecamtbx_registers.hpp"
#include "devices/lx3vp/il_operands.hpp"
#include "devices/lx3vp/il_values.hpp"

namespace drycut::devices::lx3vp::il {

namespace {

constexpr int count_down_flags = 8000;  ///< M8200..M8234: C200..C234 count down; M8000 + the counter's number

/// Whether a comparison as a contact (LD=, ANDD>) holds.
bool compare(const Registers& registers, const Step& step) {
  const auto left = read_value(registers, step.operands[0], step.wide());
  const auto right = read_value(registers, step.operands[1], step.wide());
  switch (step.op()) {
    case Op::equal:
      return left == right;
    case Op::greater:
      return left > right;
    case Op::less:
      return left < right;
    case Op::unequal:
      return left != right;
    case Op::less_or_equal:
      return left <= right;
    default:
      return left >= right;
  }
}

void execute_action(Registers& registers, const Step& step) {
  Call call(registers, step);
  step.spelling->mnemonic->action(call);
}

/// What an instruction costs beyond that of any other, for the watchdog: words and bits that it handles.
std::int64_t work_of(const Registers& registers, const Step& step) {
  if (step.op() == Op::zrst) return std::max(0, step.operands[1].number - step.operands[0].number);
  if (step.op() == Op::ecamtbx) return 10 * max_rows;
  // Blocks and rows of bits have their count there.
  constexpr std::size_t count = 2;
  const auto kinds = step.spelling->mnemonic->operands;
  if (kinds.size() <= count || kinds[count] != 'k') return 0;
  return std::max(0, read_value(registers, step.operands[count], false));
}

}  // namespace

ProgramScan::ProgramScan(const IlProgram& program, std::int64_t step_ns)
    : program_(program), step_ns_(step_ns) {
  restart();
}
ProgramScan::~ProgramScan() = default;

void ProgramScan::restart() {
  memories_.assign(static_cast<std::size_t>(program_.memories), false);
  fractions_.assign(timers, 0);
  timed_ns_.assign(timers, -1);
  last_scan_ns_ = 0;
  has_scanned_ = false;
  interrupts_on_ = false;
  waiting_.clear();
  taken_ns_ = -1;
  rung_.reset();
  scanned_.clear();
}

void ProgramScan::Rung::Loop::visit(StateArchive& archive) { STATE(archive, place, left); }
void ProgramScan::Rung::Frame::visit(StateArchive& archive) { STATE(archive, back, loops); }
void ProgramScan::Rung::visit(StateArchive& archive) {
  STATE(archive, passed_ns, blocks, branches, loops, frames, open_masters, state, state_on, supply, flow,
        work, limit, next, over);
}

void ProgramScan::visit(StateArchive& archive, Registers& registers, Instructions& instructions) {
  STATE(archive, memories_, fractions_, timed_ns_, last_scan_ns_, has_scanned_, interrupts_on_, waiting_,
        levels_, taken_ns_);
  bool begun = rung_ != nullptr;
  STATE(archive, begun);
  if (archive.restores()) {
    rung_ = begun ? std::make_unique<Rung>(registers, instructions) : nullptr;
    watch(watched_);
  }
  STATE(archive, rung_);
}

void ProgramScan::watch(bool on) {
  watched_ = on;
  scanned_.clear();
  scanning_.clear();  // a scan that is under way is not seen from its beginning
}

int ProgramScan::line() const {
  if (rung_ == nullptr || rung_->over || rung_->next >= program_.steps.size()) return 0;
  return program_.steps[rung_->next].line;
}

void ProgramScan::scan(Registers& registers, Instructions& instructions) {
  Rung rung{registers, instructions};
  start(rung);
  run(rung, std::numeric_limits<std::int64_t>::max());
}

void ProgramScan::begin(Registers& registers, Instructions& instructions) {
  rung_ = std::make_unique<Rung>(registers, instructions);
  start(*rung_);
}

std::optional<std::int64_t> ProgramScan::go_on(std::int64_t computed_ns) {
  if (!run(*rung_, computed_ns / step_ns_) || rung_->work * step_ns_ > computed_ns) return std::nullopt;
  return rung_->work * step_ns_;
}

void ProgramScan::start(Rung& rung) {
  const Registers& registers = rung.registers;
  rung.passed_ns = has_scanned_ ? registers.time_ns - last_scan_ns_ : 0;
  last_scan_ns_ = registers.time_ns;
  has_scanned_ = true;
  refresh_watchdog(rung);
  if (watched_)
    scanning_.assign(scanning_.empty() ? split_lines(program_.text).size() : scanning_.size(), ' ');
}

int ProgramScan::watchdog_ms(const Registers& registers) const {
  const int wanted = registers.i16(watchdog_register);
  return wanted > 0 ? wanted : default_watchdog_ms;
}

void ProgramScan::refresh_watchdog(Rung& rung) const {
  constexpr std::int64_t ns_per_ms = 1'000'000;
  constexpr std::int64_t usual_step_ns = 200;
  constexpr std::int64_t longest_ms = 32'767;
  constexpr std::int64_t most_times = 10;  // WDT in a loop without end must not hold the simulation for ever
  const std::int64_t time_ms = watchdog_ms(rung.registers);
  const auto work_in = [&](std::int64_t ms) {
    return ms * ns_per_ms / (step_ns_ > 0 ? step_ns_ : usual_step_ns);
  };
  rung.limit = std::min(rung.work + work_in(time_ms), work_in(std::min(most_times * time_ms, longest_ms)));
}

// An instruction has power if what is before it lets it through; those that need none are executed.
void ProgramScan::mark(const Step& step, const Rung& rung) {
  const Op op = step.op();
  const bool needs_power = op <= Op::mc || op == Op::cj || op == Op::call;
  const bool on = op == Op::stl ? rung.state_on : !needs_power || rung.power();
  if (counts_) {
    const auto place = static_cast<std::size_t>(&step - program_.steps.data());
    ++counts_->passed[place];
    if (!on && op > Op::inv) ++counts_->refused[place];
  }
  const auto line = static_cast<std::size_t>(step.line) - 1;
  if (watched_ && line < scanning_.size() && scanning_[line] != '+') scanning_[line] = on ? '+' : '-';
}

bool ProgramScan::run(Rung& rung, std::int64_t work) {
  if (!watched_ && !counts_) return run_steps<false>(rung, work);
  const bool done = run_steps<true>(rung, work);
  if (done || rung.work > rung.limit) scanned_ = scanning_;
  return done;
}

// Instructions while the work up to their end is within `work`; true when the scan has come to its end.
template <bool watched>
bool ProgramScan::run_steps(Rung& rung, std::int64_t work) {
  while (!rung.over && rung.next < program_.steps.size()) {
    if (rung.work >= work) return false;
    const Step& step = program_.steps[rung.next++];
    if (!watched && step.route == Route::bit) {
      const bool on = *bit_at(rung.registers, step.letter, step.bit);
      rung.join(step, on == (step.code == Op::on));
    } else if (!watched && step.route == Route::action && step_ns_ == 0 && !rung.power()) {
      // All of its kind behind it do nothing either; each is an instruction for the watchdog.
      const auto passed = static_cast<std::int64_t>(step.skip) - static_cast<std::int64_t>(rung.next);
      if (rung.work + passed < rung.limit) {
        rung.work += passed;
        rung.next = static_cast<std::size_t>(step.skip);
      }
    } else {
      execute<watched>(step, rung);
    }
    if constexpr (watched) mark(step, rung);
    if (++rung.work <= rung.limit) continue;
    rung.instructions.watchdog(
        step.number, fmt::format("{}:{}: {}: the scan works longer than the watchdog's {} ms; repeat "
                                 "less in a scan (CJ back, FOR, blocks)",
                                 program_.file, step.line, watchdog_error, watchdog_ms(rung.registers)));
    return false;
  }
  return true;
}

const Step* ProgramScan::with_index(const Step& step, Rung& rung) {
  scratch_ = step;
  const auto kinds = step.spelling->mnemonic->operands;
  for (std::size_t i = 0; i < scratch_.operands.size(); ++i) {
    auto& operand = scratch_.operands[i];
    if (operand.index == Operand::no_index) continue;
    apply_index(rung.registers, operand, step.wide());
    if (operand.kind == OperandType::constant ||
        (exists(operand) && !misfit(operand, kinds[i], *step.spelling) &&
         !(is_written(kinds[i]) &&
           read_only(operand, extent_of(operand, kinds[i], step.wide()), *step.spelling))))
      continue;
    tell_error(step,
               IlError(bad_operand, fmt::format("{} is no device that it takes: the index register leads "
                                                "to number {}",
                                                to_string(step.operands[i]), operand.number)),
               rung);
    return nullptr;
  }
  return &scratch_;
}

void ProgramScan::tell_error(const Step& step, const IlError& error, Rung& rung) const {
  rung.instructions.error(step.number, error.code,
                          fmt::format("{}:{}: {}: {}: {}", program_.file, step.line, error.code,
                                      step.spelling->text, error.what()));
}

bool ProgramScan::turns(const Step& step, bool now, bool on) {
  const auto memory = static_cast<std::size_t>(step.memory);
  const bool before = memories_[memory];
  memories_[memory] = now;
  return now == on && before != on;
}

bool ProgramScan::contact(const Step& step, Rung& rung) {
  const Op op = step.op();
  const Step* taken = indexed(step, rung);
  if (taken == nullptr) return false;
  if (is_comparison(op)) return compare(rung.registers, *taken);
  const bool on = read_bit(rung.registers, taken->operands[0]);
  if (op == Op::rising) return rises(step, on);
  if (op == Op::falling) return falls(step, on);
  return on == (op == Op::on);
}

void ProgramScan::join(Op op, Rung& rung) {
  switch (op) {
    case Op::anb:
      rung.flow = rung.blocks.back() && rung.flow;
      rung.blocks.pop_back();
      break;
    case Op::orb:
      rung.flow = rung.blocks.back() || rung.flow;
      rung.blocks.pop_back();
      break;
    case Op::mps:
      rung.branches.push_back(rung.flow);
      break;
    case Op::mrd:
      rung.flow = rung.branches.back();
      break;
    case Op::mpp:
      rung.flow = rung.branches.back();
      rung.branches.pop_back();
      break;
    default:
      rung.flow = !rung.flow;
      break;
  }
}

template <bool watched>
void ProgramScan::execute(const Step& step, Rung& rung) {
  switch (step.route) {
    case Route::bit:
    case Route::contact: {
      const bool on = contact(step, rung);
      if constexpr (watched)
        if (counts_ && !on) ++counts_->refused[static_cast<std::size_t>(&step - program_.steps.data())];
      return rung.join(step, on);
    }
    case Route::join:
      return join(step.op(), rung);
    case Route::coil:
      return coil(step, rung);
    case Route::flow:
      return flow(step, rung);
    case Route::action:
    case Route::call:
      if (step.op() <= Op::plf)
        coil(step, rung);
      else
        call(step, rung);
      return;
  }
}

void ProgramScan::coil(const Step& step, Rung& rung) {
  const Step* taken = indexed(step, rung);
  if (taken == nullptr) return;
  auto& registers = rung.registers;
  const auto& device = taken->operands[0];
  const bool power = rung.power();
  switch (step.op()) {
    case Op::out:
      if (device.kind == OperandType::T)
        timer(step, power, rung);
      else if (device.kind == OperandType::C)
        counter(step, power, rung);
      else if (!transfers(device, rung))
        write_bit(registers, device, power);
      else if (power)
        transfer(device, rung);
      break;
    case Op::set:
      if (!power) break;
      if (transfers(device, rung))
        transfer(device, rung);
      else
        write_bit(registers, device, true);
      break;
    case Op::rst:
      if (power) reset(registers, device);
      break;
    case Op::pls:
      write_bit(registers, device, rises(step, power));
      break;
    default:
      write_bit(registers, device, falls(step, power));
      break;
  }
}

void ProgramScan::timer(const Step& step, bool on, Rung& rung) {
  const int number = step.operands[0].number;
  auto& timer = rung.registers.t[static_cast<std::size_t>(number)];
  auto& fraction = fractions_[static_cast<std::size_t>(number)];
  const bool ran = timer.coil;
  timer.coil = on;
  if (!on) {
    if (keeps_time(number)) return;
    timer.value = 0;
    timer.contact = false;
    fraction = 0;
    return;
  }
  auto& timed_ns = timed_ns_[static_cast<std::size_t>(number)];
  const bool again = std::exchange(timed_ns, rung.registers.time_ns) == rung.registers.time_ns;
  const int preset = read_value(rung.registers, step.operands[1], false);
  if (ran && !again && timer.value < preset) {
    fraction += rung.passed_ns;
    const auto unit = timer_unit_ns(number);
    const auto value = std::min<std::int64_t>(timer.value + fraction / unit, preset);
    fraction %= unit;
    timer.value = static_cast<std::uint16_t>(value);
  }
  if (timer.value >= preset) timer.contact = true;
}

void ProgramScan::counter(const Step& step, bool on, Rung& rung) {
  const int number = step.operands[0].number;
  const bool wide = number >= first_wide_counter;
  const int preset = read_value(rung.registers, step.operands[1], wide);
  if (rung.registers.counts_pulses[static_cast<std::size_t>(number)]) {
    rung.instructions.high_speed_counter(number, preset, on);
    return;
  }
  auto& counter = rung.registers.c[static_cast<std::size_t>(number)];
  counter.coil = on;
  if (!rises(step, on)) return;
  if (!wide) {
    if (counter.contact) return;
    ++counter.value;
    counter.contact = counter.value >= preset;
    return;
  }
  const bool down = rung.registers.m[static_cast<std::size_t>(count_down_flags + number)];
  const auto before = counter.value;
  const auto change = down ? -1U : 1U;
  counter.value = static_cast<std::int32_t>(static_cast<std::uint32_t>(before) + change);
  // The contact goes ON as the count comes to the set value from below, OFF as it leaves it downwards.
  if (!down && counter.value == preset) counter.contact = true;
  if (down && before == preset) counter.contact = false;
}

bool ProgramScan::executes(const Step& step, const Rung& rung) {
  return step.spelling->pulse ? rises(step, rung.power()) : rung.power();
}

void ProgramScan::call(const Step& step, Rung& rung) {
  const Op op = step.op();
  const bool power = rung.power();
  const bool drives = op >= Op::plsv && op <= Op::decam;
  const bool executed = executes(step, rung);
  if (!executed && !drives) return;
  const Step* taken = executed ? indexed(step, rung) : &step;
  if (taken == nullptr) return;
  try {
    if (drives)
      drive_outputs(rung.registers, *taken, power, rung.instructions);
    else if (op == Op::ecamtbx)
      make_cam_table(*taken, rung);
    else if (op == Op::wdt)
      refresh_watchdog(rung);
    else if (op == Op::ref)
      refresh_terminals(*taken, rung);
    else
      execute_action(rung.registers, *taken);
    rung.work += work_of(rung.registers, *taken);
  } catch (const IlError& error) {
    tell_error(step, error, rung);
  }
}

void ProgramScan::refresh_terminals(const Step& step, Rung& rung) const {
  const auto& first = step.operands[0];
  const int count = read_value(rung.registers, step.operands[1], false);
  if (count < 8 || count % 8 != 0 || first.number + count > terminals)
    throw IlError(bad_operand, fmt::format("{} from {} on are no rows of eight", count, to_string(first)));
  rung.instructions.refresh(letter_of(first.kind), first.number, count);
}

void ProgramScan::make_cam_table(const Step& step, Rung& rung) {
  const auto number = [&](std::size_t i) { return step.operands[i].number; };
  const auto& type = step.operands[1];
  // The type is read from the low word: a program may have written it with MOV.
  const auto report =
      run_ecamtbx(rung.registers, number(0),
                  read_value(rung.registers, type, type.kind == OperandType::constant), number(2), number(3));
  std::string text;
  if (report.code < 0)
    text = fmt::format("{}:{}: ECAMTBX {}: {}; the block D{} is left as it was", program_.file, step.line,
                       report.code, report.fault, number(2));
  rung.instructions.cam_table(step.number, report.code, text);
}

}  // namespace drycut::devices::lx3vp::il
