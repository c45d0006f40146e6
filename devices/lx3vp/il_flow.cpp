// Jumps, loops, subroutines, master contacts and the steps of sequences, as the FX family has them.
#include <algorithm>

#include "devices/lx3vp/il_scan.hpp"

namespace drycut::devices::lx3vp::il {

void ProgramScan::flow(const Step& step, Rung& rung) {
  const auto nesting = [&] { return static_cast<std::size_t>(step.operands[0].number); };
  switch (step.op()) {
    case Op::mc: {
      const bool power = rung.power();
      write_bit(rung.registers, step.operands[1], power);
      rung.open_masters[nesting()] = !power;
      return rung.renew_supply();
    }
    case Op::mcr:
      std::fill(rung.open_masters.begin() + static_cast<std::ptrdiff_t>(nesting()), rung.open_masters.end(),
                false);
      return rung.renew_supply();
    case Op::stl:
      if (step.memory >= 0) begin_state(step, rung);
      return;
    case Op::ret:
      rung.state = -1;
      rung.state_on = true;
      return rung.renew_supply();
    case Op::for_: {
      const Step* taken = indexed(step, rung);
      // 0 and less are once.
      const int times =
          taken == nullptr ? 1 : std::max(1, read_value(rung.registers, taken->operands[0], false));
      rung.loops.push_back({static_cast<int>(rung.next), times});
      return;
    }
    case Op::next:
      if (--rung.loops.back().left > 0)
        rung.next = static_cast<std::size_t>(rung.loops.back().place);
      else
        rung.loops.pop_back();
      return;
    case Op::cj:
      return jump(step, rung);
    case Op::call:
      return call_subroutine(step, rung);
    case Op::sret:
      rung.next = rung.frames.back().back;
      rung.loops.resize(rung.frames.back().loops);
      rung.frames.pop_back();
      return;
    case Op::ei:
      interrupts_on_ = true;
      rung.work += run_interrupts(rung.registers, rung.instructions);
      return;
    case Op::di:
      interrupts_on_ = false;
      return;
    case Op::iret:
    case Op::fend:
    case Op::end:
      rung.over = true;
      return;
    default:
      return;
  }
}

/// The instructions of a state run while it is ON and once more, without power, in the scan after. Several
/// STL in a row are one that needs all its states; the first has them.
void ProgramScan::begin_state(const Step& step, Rung& rung) {
  const auto& states = step.operands;
  const bool on = std::all_of(states.begin(), states.end(),
                              [&](const Operand& state) { return read_bit(rung.registers, state); });
  const auto memory = static_cast<std::size_t>(step.memory);
  const bool was_on = memories_[memory];
  memories_[memory] = on;
  rung.state = static_cast<int>(rung.next) - 1;
  rung.state_on = on;
  rung.flow = true;
  rung.renew_supply();
  if (!on && !was_on) rung.next = static_cast<std::size_t>(step.target);
}

/// Whether a coil on `device` goes on to another step of the sequence: it is none of an ordinary relay then.
bool ProgramScan::transfers(const Operand& device, const Rung& rung) const {
  return device.kind == OperandType::S && rung.state >= 0 &&
         program_.states[static_cast<std::size_t>(device.number)];
}

void ProgramScan::transfer(const Operand& device, Rung& rung) {
  const Step& from = program_.steps[static_cast<std::size_t>(rung.state)];
  constexpr std::size_t no_transfer = 8040;  // M8040
  if (rung.registers.m[no_transfer]) return;
  for (const auto& state : from.operands) write_bit(rung.registers, state, false);
  write_bit(rung.registers, device, true);
}

void ProgramScan::jump(const Step& step, Rung& rung) {
  if (!executes(step, rung)) return;
  rung.branches.clear();
  rung.next = static_cast<std::size_t>(step.target);
  // Out of loops: those around the label go on.
  const auto outside = rung.frames.empty() ? 0 : rung.frames.back().loops;
  const auto depth = outside + static_cast<std::size_t>(program_.steps[rung.next].depth);
  if (depth < rung.loops.size()) rung.loops.resize(depth);
}

void ProgramScan::call_subroutine(const Step& step, Rung& rung) {
  constexpr std::size_t most_calls = 5;
  if (!executes(step, rung)) return;
  if (rung.frames.size() == most_calls)
    return tell_error(step, IlError(calls_too_deep, "five subroutines call each other already"), rung);
  rung.frames.push_back({rung.next, rung.loops.size()});
  rung.next = static_cast<std::size_t>(step.target);
}

}  // namespace drycut::devices::lx3vp::il
