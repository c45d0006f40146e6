// What of an instruction list has run.
#include <algorithm>
#include <memory>

#include "devices/coverage.hpp"
#include "devices/lx3vp/il_scan.hpp"

namespace drycut::devices::lx3vp::il {

namespace {

/// A contact of M8000 or M8001, which never change.
bool is_fixed(const Step& step) {
  constexpr int always_on = 8000;
  constexpr int always_off = 8001;
  const auto& device = step.operands[0];
  return device.kind == OperandType::M && device.index == Operand::no_index &&
         (device.number == always_on || device.number == always_off);
}

/// Every program has an END; where no scan comes to it, behind FEND, SRET or IRET and without a CJ P63, it
/// does nothing.
bool only_ends_the_text(const std::vector<Step>& steps, std::size_t at) {
  if (steps[at].op() != Op::end || at == 0) return false;
  const Op before = steps[at - 1].op();
  if (before != Op::fend && before != Op::sret && before != Op::iret) return false;
  return std::none_of(steps.begin(), steps.end(), [&](const Step& step) {
    return step.op() == Op::cj && static_cast<std::size_t>(step.target) == at;
  });
}

}  // namespace

void ProgramScan::count() { counts_ = std::make_unique<Counts>(program_.steps.size()); }

void ProgramScan::add_coverage(Coverage& to) const {
  if (!counts_) return;
  Coverage all;
  auto& file = all.files[program_.file];
  std::vector<bool> called(program_.steps.size());
  for (const Step& step : program_.steps)
    if (step.op() == Op::call) called[static_cast<std::size_t>(step.target)] = true;
  for (std::size_t i = 0; i < program_.steps.size(); ++i) {
    const Step& step = program_.steps[i];
    const auto passed = counts_->passed[i];
    const auto refused = counts_->refused[i];
    if (called[i]) file.functions[{step.line, to_string(step.operands[0])}] = passed;
    if (step.op() == Op::label || step.op() == Op::nop || only_ends_the_text(program_.steps, i)) continue;
    const bool contact = is_contact(step.op());
    file.line(step.line, contact ? passed : passed - refused);
    if (contact && !is_fixed(step)) file.decisions[step.line].push_back({passed - refused, refused});
  }
  to.add(all);
}

}  // namespace drycut::devices::lx3vp::il
