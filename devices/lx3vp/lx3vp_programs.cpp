// What one sees of the program while it runs: its text, the registers that each line names, where a scan is
// or why there is none.
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "devices/lx3vp/lx3vp_controller.hpp"

namespace drycut::devices::lx3vp {

namespace {

/// The register that an operand stands for, as wide as its instruction takes it; nullopt of numbers, labels,
/// groups of bits, and what an index register leads to.
std::optional<RegisterName> register_of(const il::Step& step, std::size_t at) {
  using Name = RegisterName::Kind;
  const il::Operand& operand = step.operands[at];
  const char kind = step.kind(at);
  if (operand.index != il::Operand::no_index) return std::nullopt;
  const bool contact = kind == 'b';
  const bool real = kind == 'f' || kind == 'F' || kind == 'Q';
  switch (operand.kind) {
    case il::OperandType::X:
      return RegisterName{Name::x, operand.number};
    case il::OperandType::Y:
      return RegisterName{Name::y, operand.number};
    case il::OperandType::M:
      return RegisterName{Name::m, operand.number};
    case il::OperandType::S:
      return RegisterName{Name::s, operand.number};
    case il::OperandType::T:
      return RegisterName{contact ? Name::timer_contact : Name::timer, operand.number};
    case il::OperandType::C:
      return RegisterName{contact ? Name::counter_contact : Name::counter, operand.number};
    case il::OperandType::D:
      return RegisterName{real ? Name::real : step.wide() ? Name::wide : Name::word, operand.number};
    case il::OperandType::V:
      return RegisterName{Name::v, operand.number};
    case il::OperandType::Z:
      return RegisterName{Name::z, operand.number};
    case il::OperandType::word_bit:
      return RegisterName{Name::bit, operand.number, operand.count};
    default:
      return std::nullopt;
  }
}

}  // namespace

std::vector<ProgramText> Lx3vpController::programs() {
  ProgramText told(program_.file, "il", program_.text);
  for (const il::Step& step : program_.steps) {
    for (std::size_t i = 0; i < step.operands.size(); ++i) {
      const auto name = register_of(step, i);
      if (!name) continue;
      const int line = step.operands[i].line > 0 ? step.operands[i].line : step.line;
      if (const auto value = find(to_string(*name))) told.add_value(line, value->name);
    }
  }
  return {std::move(told)};
}

ProgramPositions Lx3vpController::positions(std::int64_t) const {
  ProgramPositions told;
  ProgramPositions::Task scan{"scan", 0, 0, "", {}};
  if (!powered_) {
    scan.doing = "no power";
  } else if (stopped_) {
    scan.doing = "stopped by the watchdog";
    if (const auto* step = step_at(stopped_at_)) scan.line = step->line;
  } else if (halted_) {
    scan.doing = "stopped by M8037";
  } else if (scanning_ && scanner_.line() > 0) {
    scan.doing = "runs";
    scan.line = scanner_.line();
  }
  told.tasks.push_back(std::move(scan));
  told.scanned.push_back(scanner_.scanned());
  return told;
}

std::vector<Controller::ProgramDoubt> Lx3vpController::doubts() const {
  auto block = il::strange_block(program_);
  if (block.empty()) return {};
  return {{"program.block-elsewhere"_code, std::move(block)}};
}

}  // namespace drycut::devices::lx3vp
