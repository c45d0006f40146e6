#include "devices/lx3vp/il_scan.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "devices/lx3vp/il_apply.hpp"
#include "devices/lx3vp/il_values.hpp"

namespace drycut::devices::lx3vp::il {

namespace {

constexpr int count_down_flags = 8000;  ///< M8200..M8234: C200..C234 count down; M8000 + the counter's number

/// RST: OFF, or 0.
void reset(Registers& registers, const Operand& device) {
  const auto place = static_cast<std::size_t>(device.number);
  if (device.kind == Kind::D) {
    registers.d[place] = 0;
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

/// What a scan carries from instruction to instruction.
struct Scanner::Rung {
  Registers& registers;
  Instructions& instructions;
  std::int64_t passed_ns = 0;       ///< since the scan before
  std::vector<bool> blocks = {};    ///< begun before the present one
  std::vector<bool> branches = {};  ///< kept by MPS
  bool flow = false;
  std::size_t next = 0;
  bool over = false;
};

Scanner::Scanner(const Program& program) : program_(program) { restart(); }

void Scanner::restart() {
  memories_.assign(static_cast<std::size_t>(program_.memories), false);
  fractions_.assign(timers, 0);
  last_scan_ns_ = 0;
  scanned_ = false;
}

void Scanner::scan(Registers& registers, Instructions& instructions) {
  Rung rung{registers, instructions};
  rung.passed_ns = scanned_ ? registers.time_ns - last_scan_ns_ : 0;
  last_scan_ns_ = registers.time_ns;
  scanned_ = true;
  // A label before a jump could make a loop without end: the watchdog of the PLC (D8000, 200 ms) stops it.
  constexpr int most_jumps_back = 1000;
  int jumps_back = 0;
  while (!rung.over && rung.next < program_.steps.size()) {
    const auto place = rung.next;
    const auto& step = program_.steps[rung.next++];
    execute(step, rung);
    if (rung.next <= place && ++jumps_back > most_jumps_back) {
      constexpr int watchdog = 6105;  // FX
      instructions.error(step.number, watchdog,
                         fmt::format("{}:{}: {}: CJ jumps back without end; let it jump forward",
                                     program_.file, step.line, watchdog));
      return;
    }
  }
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

bool Scanner::contact(const Step& step, const Rung& rung) {
  const Op op = step.op();
  if (op >= Op::ld_equal) return compare(rung.registers, step);
  const bool on = read_bit(rung.registers, step.operands[0]);
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
  } else if (op == Op::fend || op == Op::end) {
    rung.over = true;
  } else if (op < Op::cj) {
    call(step, rung);
  } else if (op == Op::cj) {
    const bool jumps = step.memory >= 0 ? rises(step, rung.flow) : rung.flow;
    if (!jumps) return;
    rung.branches.clear();
    rung.next = static_cast<std::size_t>(step.target);
  }
}

void Scanner::coil(const Step& step, Rung& rung) {
  auto& registers = rung.registers;
  const auto& device = step.operands[0];
  switch (step.op()) {
    case Op::out:
      if (device.kind == Kind::T)
        timer(step, rung.flow, rung);
      else if (device.kind == Kind::C)
        counter(step, rung.flow, rung);
      else
        write_bit(registers, device, rung.flow);
      break;
    case Op::set:
      if (rung.flow) write_bit(registers, device, true);
      break;
    case Op::rst:
      if (rung.flow) reset(registers, device);
      break;
    case Op::pls:
      write_bit(registers, device, rises(step, rung.flow));
      break;
    default:
      write_bit(registers, device, falls(step, rung.flow));
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
  const int preset = read_value(rung.registers, step.operands[1], false);
  if (ran && timer.value < preset) {
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
  if (op == Op::plsv || op == Op::drvi || op == Op::drva || op == Op::decam) {
    drive_outputs(rung.registers, step, rung.flow, rung.instructions);
    return;
  }
  const bool executes = step.spelling->pulse ? rises(step, rung.flow) : rung.flow;
  if (!executes) return;
  try {
    if (op == Op::zrst)
      reset_all(rung.registers, step.operands[0], step.operands[1]);
    else if (op == Op::alt)
      write_bit(rung.registers, step.operands[0], !read_bit(rung.registers, step.operands[0]));
    else if (op == Op::ecamtbx)
      make_cam_table(step, rung);
    else
      apply(rung.registers, step);
  } catch (const RuntimeError& error) {
    rung.instructions.error(step.number, error.code,
                            fmt::format("{}:{}: {}: {}: {}", program_.file, step.line, error.code,
                                        step.spelling->text, error.what()));
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
