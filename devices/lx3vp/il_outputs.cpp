#include "devices/lx3vp/il_scan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <tuple>

#include "devices/lx3vp/il_program.hpp"
#include "devices/lx3vp/il_values.hpp"

namespace drycut::devices::lx3vp::il {

namespace {

DecamOperands decam_operands(const Step& step) {
  const auto number = [&](std::size_t i) { return step.operands[i].number; };
  const auto& master = step.operands[0];
  DecamOperands operands;
  operands.master.kind = master.kind == OperandType::C   ? MasterSource::Kind::counter
                         : master.kind == OperandType::D ? MasterSource::Kind::word
                                                         : MasterSource::Kind::time;
  operands.master.number = master.kind == OperandType::constant ? master.value : master.number;
  operands.block = number(1);
  operands.start = {step.operands[2].kind == OperandType::X, number(2)};
  operands.output = number(3);
  operands.direction = number(4);
  return operands;
}

/// Looks for coils that two instructions drive. Steps of a sequence and what jumps lead to take turns.
class CoilUses {
 public:
  explicit CoilUses(std::vector<Finding>& notes) : notes_(notes) {}

  void add(const IlProgram& program, const Step& step) {
    if (step.op() == Op::label) ++part_;
    if (step.op() == Op::stl || step.op() == Op::ret) in_sequence_ = step.op() == Op::stl;
    const bool drives = step.op() == Op::out || step.op() == Op::set;
    if (!drives || step.indexed || step.operands.empty()) return;
    const auto& coil = step.operands.front();
    if (coil.kind != OperandType::Y && coil.kind != OperandType::M && coil.kind != OperandType::word_bit)
      return;
    const auto [first, fresh] = uses_.emplace(std::tuple(coil.kind, coil.number, coil.count),
                                              Use{step.op(), step.line, part_, in_sequence_});
    auto& before = first->second;
    const bool again = !fresh && step.op() == Op::out && before.op == Op::out && before.part == part_ &&
                       !before.in_sequence && !in_sequence_;
    const bool mixed = !fresh && step.op() != before.op;
    if ((!again && !mixed) || before.told) return;
    before.told = true;
    notes_.emplace_back(
        "il.coil-twice"_code,
        fmt::format("{}:{}:{}: {} has {} here and {} in line {}: {}", program.file, step.line, coil.column,
                    to_string(coil), step.spelling->text, before.op == Op::out ? "OUT" : "SET", before.line,
                    mixed ? "OUT writes it in every scan, whatever SET has left"
                          : "the last in a scan decides alone"));
  }

 private:
  struct Use {
    Op op;
    int line;
    int part;
    bool in_sequence;
    bool told = false;
  };
  std::vector<Finding>& notes_;
  std::map<std::tuple<OperandType, int, int>, Use> uses_;
  int part_ = 0;  ///< between labels
  bool in_sequence_ = false;
};

}  // namespace

std::vector<Finding> doubts(const IlProgram& program) {
  constexpr std::array types = {0, 1, 100, 101};
  std::vector<Finding> notes;
  CoilUses coils(notes);
  for (const auto& step : program.steps) {
    coils.add(program, step);
    if (step.op() != Op::ecamtbx || step.indexed || step.operands.size() < 2) continue;
    const auto& type = step.operands[1];
    if (type.kind == OperandType::constant &&
        std::find(types.begin(), types.end(), type.value) == types.end())
      notes.emplace_back("il.no-such-cam-type"_code,
                         fmt::format("{}:{}:{}: ECAMTBX has no type {}; write K0, K1, K100 or K101",
                                     program.file, step.line, type.column, to_string(type)));
  }
  return notes;
}

std::string strange_block(const IlProgram& program) {
  const Operand* made = nullptr;
  const Step* running = nullptr;
  for (const auto& step : program.steps) {
    const bool makes = step.op() == Op::ecamtbx && step.operands.size() > 2;
    if (step.indexed && (makes || step.op() == Op::decam)) return "";
    if (makes) made = &step.operands[2];
    if (step.op() == Op::decam) running = &step;
  }
  if (made == nullptr || running == nullptr) return "";
  for (const auto& making : program.steps)
    for (const auto& decam : program.steps)
      if (making.op() == Op::ecamtbx && decam.op() == Op::decam &&
          making.operands[2].number == decam.operands[1].number)
        return "";
  const auto& block = running->operands[1];
  return fmt::format("{}:{}:{}: DECAM runs the cam block at {}, and ECAMTBX makes the one at {}",
                     program.file, running->line, block.column, to_string(block), to_string(*made));
}

void drive_outputs(const Registers& registers, const Step& step, bool powered, Instructions& instructions) {
  if (step.op() == Op::decam) return instructions.decam(step.number, decam_operands(step), powered);
  using enum PulseOrder::Kind;
  const auto number = [&](std::size_t i) { return step.operands[i].number; };
  // Without power index registers are not applied, and nobody looks at the values.
  const auto value = [&](std::size_t i) {
    return powered || !step.indexed ? read_value(registers, step.operands[i], step.wide()) : 0;
  };
  const auto ranged = [&](std::size_t i) {
    const auto read = value(i);
    if (powered) need_in_range(step, i, read);
    return read;
  };
  const auto give = [&](const PulseOrder& order) { instructions.pulses(step.number, order, powered); };
  const auto device = [&](std::size_t i) { return static_cast<char>(step.operands[i].kind); };
  const auto compare = [&](CounterCompare::Kind kind, std::size_t counter) {
    if (powered && !registers.counts_pulses[static_cast<std::size_t>(number(counter))])
      throw IlError(bad_operand,
                    fmt::format("C{} counts no pulses: wire it, or take C235 to C255", number(counter)));
    instructions.compare_counter(
        step.number,
        {kind, number(counter), value(0), value(counter - 1), device(counter + 1), number(counter + 1)},
        powered);
  };
  switch (step.op()) {
    case Op::hscs:
      return compare(CounterCompare::Kind::set, 1);
    case Op::hscr:
      return compare(CounterCompare::Kind::reset, 1);
    case Op::hsz:
      return compare(CounterCompare::Kind::zone, 2);
    case Op::spd:
      return instructions.measure_speed(step.number, {number(0), number(2), ranged(1)}, powered);
    case Op::plsr: {
      PulseOrder order{ramped, number(3), PulseOrder::no_direction, ranged(0), ranged(1)};
      order.ramp_ms = ranged(2);
      return give(order);
    }
    case Op::pwm: {
      PulseOrder order{pwm, number(2)};
      order.width_ms = ranged(0);
      order.period_ms = ranged(1);
      if (powered && order.width_ms > order.period_ms)
        throw IlError(bad_operand, fmt::format("S1 is {}, more than the period S2 of {}", order.width_ms,
                                               order.period_ms));
      return give(order);
    }
    case Op::plsv:
      return give({speed, number(1), number(2), value(0)});
    case Op::plsy: {
      return give({train, number(2), PulseOrder::no_direction, ranged(0), ranged(1)});
    }
    case Op::zrn: {
      PulseOrder order{zero, number(3), PulseOrder::no_direction, ranged(0)};
      order.creep = ranged(1);
      order.dog = {static_cast<char>(step.operands[2].kind), number(2)};
      return give(order);
    }
    default:
      return give({step.op() == Op::drva ? position : distance, number(2), number(3), value(1), value(0)});
  }
}

}  // namespace drycut::devices::lx3vp::il
