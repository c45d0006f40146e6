#include "devices/lx3vp/il_scan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "devices/lx3vp/il_apply.hpp"
#include "devices/lx3vp/il_operands.hpp"
#include "devices/lx3vp/il_rung.hpp"

namespace drycut::devices::lx3vp::il {

namespace {

constexpr int count_down_flags = 8000;  ///< M8200..M8234: C200..C234 count down; M8000 + the counter's number

/// RST: OFF, or 0.
void reset(Registers& registers, const Operand& device) {
  const auto place = static_cast<std::size_t>(device.number);
  if (device.kind == Kind::D) {
    registers.put(device.number, 0);
    return;
  }
  if (device.kind == Kind::T) registers.t[place].value = 0;
  if (device.kind == Kind::C) registers.c[place].value = 0;
  write_bit(registers, device, false);
}

void reset_all(Registers& registers, Operand first, const Operand& last) {
  for (; first.number <= last.number; ++first.number) reset(registers, first);
}

}  // namespace

Scanner::Scanner(const Program& program) : program_(program) { restart(); }

void Scanner::restart() {
  memories_.assign(static_cast<std::size_t>(program_.memories), false);
  fractions_.assign(timers, 0);
  timed_ns_.assign(timers, -1);
  last_scan_ns_ = 0;
  scanned_ = false;
}

void Scanner::scan(Registers& registers, Instructions& instructions) {
  Rung rung{registers, instructions};
  rung.passed_ns = scanned_ ? registers.time_ns - last_scan_ns_ : 0;
  last_scan_ns_ = registers.time_ns;
  scanned_ = true;
  while (!rung.over && rung.next < program_.steps.size()) {
    const auto& step = program_.steps[rung.next++];
    execute(step, rung);
    if (++rung.work <= most_work) continue;
    constexpr int watchdog = 6105;  // FX
    instructions.watchdog(step.number,
                          fmt::format("{}:{}: {}: the scan works longer than the watchdog's 200 ms; repeat "
                                      "less in a scan (CJ back, FOR, blocks)",
                                      program_.file, step.line, watchdog));
    return;
  }
}

const Step* Scanner::indexed(const Step& step, Rung& rung) {
  if (!step.indexed) return &step;
  scratch_ = step;
  const auto kinds = step.spelling->mnemonic->operands;
  for (std::size_t i = 0; i < scratch_.operands.size(); ++i) {
    auto& operand = scratch_.operands[i];
    if (operand.index == Operand::no_index) continue;
    apply_index(rung.registers, operand, step.wide());
    if (operand.kind == Kind::constant || (exists(operand) && !misfit(operand, kinds[i], *step.spelling)))
      continue;
    tell_error(
        step,
        RuntimeError(bad_operand, fmt::format("{} is no device that it takes: the index register leads "
                                              "to number {}",
                                              to_string(step.operands[i]), operand.number)),
        rung);
    return nullptr;
  }
  return &scratch_;
}

void Scanner::tell_error(const Step& step, const RuntimeError& error, Rung& rung) const {
  rung.instructions.error(step.number, error.code,
                          fmt::format("{}:{}: {}: {}: {}", program_.file, step.line, error.code,
                                      step.spelling->text, error.what()));
}

bool Scanner::rises(const Step& step, bool now) {
  const auto memory = static_cast<std::size_t>(step.memory);
  const bool before = memories_[memory];
  memories_[memory] = now;
  return now && !before;
}

bool Scanner::falls(const Step& step, bool now) {
  const auto memory = static_cast<std::size_t>(step.memory);
  const bool before = memories_[memory];
  memories_[memory] = now;
  return !now && before;
}

bool Scanner::contact(const Step& step, Rung& rung) {
  const Op op = step.op();
  const Step* taken = indexed(step, rung);
  if (taken == nullptr) return false;
  if (op >= Op::ld_equal) return compare(rung.registers, *taken);
  const bool on = read_bit(rung.registers, taken->operands[0]);
  if (op >= Op::ldf) return falls(step, on);
  if (op >= Op::ldp) return rises(step, on);
  return op >= Op::ldi ? !on : on;
}

void Scanner::join(Op op, Rung& rung) {
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

void Scanner::execute(const Step& step, Rung& rung) {
  const Op op = step.op();
  if (op <= Op::or_ge) {
    const bool on = contact(step, rung);
    // Contacts come in the order LD, AND, OR.
    switch ((static_cast<int>(op) - static_cast<int>(Op::ld)) % 3) {
      case 0:
        if (step.opens_block)
          rung.blocks.push_back(rung.flow);
        else
          rung.blocks.clear();
        rung.flow = on;
        break;
      case 1:
        rung.flow = rung.flow && on;
        break;
      default:
        rung.flow = rung.flow || on;
        break;
    }
  } else if (op <= Op::inv) {
    join(op, rung);
  } else if (op <= Op::plf) {
    coil(step, rung);
  } else if (op >= Op::mc) {
    flow(step, rung);
  } else {
    call(step, rung);
  }
}

void Scanner::coil(const Step& step, Rung& rung) {
  const Step* taken = indexed(step, rung);
  if (taken == nullptr) return;
  auto& registers = rung.registers;
  const auto& device = taken->operands[0];
  const bool power = rung.power();
  switch (step.op()) {
    case Op::out:
      if (device.kind == Kind::T)
        timer(step, power, rung);
      else if (device.kind == Kind::C)
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

void Scanner::timer(const Step& step, bool on, Rung& rung) {
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

void Scanner::counter(const Step& step, bool on, Rung& rung) {
  const int number = step.operands[0].number;
  const bool wide = number >= first_wide_counter;
  const int preset = read_value(rung.registers, step.operands[1], wide);
  if (number >= first_high_speed_counter) {
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

void Scanner::call(const Step& step, Rung& rung) {
  const Op op = step.op();
  const bool power = rung.power();
  const bool drives = op >= Op::plsv && op <= Op::decam;
  const bool executes = step.spelling->pulse ? rises(step, power) : power;
  if (!executes && !drives) return;
  const Step* taken = executes ? indexed(step, rung) : &step;
  if (taken == nullptr) return;
  try {
    if (drives)
      drive_outputs(rung.registers, *taken, power, rung.instructions);
    else if (op == Op::zrst)
      reset_all(rung.registers, taken->operands[0], taken->operands[1]);
    else if (op == Op::alt)
      write_bit(rung.registers, taken->operands[0], !read_bit(rung.registers, taken->operands[0]));
    else if (op == Op::ecamtbx)
      make_cam_table(*taken, rung);
    else
      apply(rung.registers, *taken);
    rung.work += work_of(rung.registers, *taken);
  } catch (const RuntimeError& error) {
    tell_error(step, error, rung);
  }
}

void Scanner::make_cam_table(const Step& step, Rung& rung) {
  const auto report = apply_ecamtbx(rung.registers, step);
  std::string text;
  if (report.code < 0)
    text = fmt::format("{}:{}: ECAMTBX {}: {}; the block D{} is left as it was", program_.file, step.line,
                       report.code, report.fault, step.operands[2].number);
  rung.instructions.cam_table(step.number, report.code, text);
}

}  // namespace drycut::devices::lx3vp::il
