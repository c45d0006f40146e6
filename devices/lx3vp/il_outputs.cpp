#include "devices/lx3vp/il_outputs.hpp"

#include <fmt/format.h>

#include <limits>

#include "devices/lx3vp/il_values.hpp"

namespace drycut::devices::lx3vp::il {

namespace {

DecamOperands decam_operands(const Step& step) {
  const auto number = [&](std::size_t i) { return step.operands[i].number; };
  const auto& master = step.operands[0];
  DecamOperands operands;
  operands.master.kind = master.kind == Kind::C   ? MasterSource::Kind::counter
                         : master.kind == Kind::D ? MasterSource::Kind::word
                                                  : MasterSource::Kind::time;
  operands.master.number = master.kind == Kind::constant ? master.value : master.number;
  operands.block = number(1);
  operands.start = {step.operands[2].kind == Kind::X, number(2)};
  operands.output = number(3);
  operands.direction = number(4);
  return operands;
}

}  // namespace

void drive_outputs(const Registers& registers, const Step& step, bool powered, Instructions& instructions) {
  if (step.op() == Op::decam) return instructions.decam(step.number, decam_operands(step), powered);
  using enum PulseOrder::Kind;
  const auto number = [&](std::size_t i) { return step.operands[i].number; };
  // Without power index registers are not applied, and nobody looks at the values.
  const auto value = [&](std::size_t i, int least = std::numeric_limits<int>::min(), const char* name = "") {
    const auto read = powered || !step.indexed ? read_value(registers, step.operands[i], step.wide()) : 0;
    if (powered && read < least)
      throw RuntimeError(bad_operand, fmt::format("{} is {}; write {} or more", name, read, least));
    return read;
  };
  const auto give = [&](const PulseOrder& order) { instructions.pulses(step.number, order, powered); };
  switch (step.op()) {
    case Op::plsv:
      return give({speed, number(1), number(2), value(0)});
    case Op::plsy: {
      const auto frequency = value(0, 0, "the frequency S1");
      return give(
          {train, number(2), PulseOrder::no_direction, frequency, value(1, 0, "the number of pulses S2")});
    }
    case Op::zrn: {
      PulseOrder order{zero, number(3), PulseOrder::no_direction, value(0, 1, "the speed S1")};
      order.creep = value(1, 1, "the creep speed S2");
      order.dog = {static_cast<char>(step.operands[2].kind), number(2)};
      return give(order);
    }
    default:
      return give({step.op() == Op::drva ? position : distance, number(2), number(3), value(1), value(0)});
  }
}

}  // namespace drycut::devices::lx3vp::il
