// Interrupt routines, as the FX family has them: I001 and its kind between EI and DI.
#include <algorithm>
#include <limits>

#include "devices/lx3vp/il_scan.hpp"

namespace drycut::devices::lx3vp::il {

namespace {

constexpr int first_timer_interrupt = 600;
constexpr int first_refusal = 8050;        // M8050..M8055: of X0..X5
constexpr int first_timer_refusal = 8056;  // M8056..M8058: of I6.. to I8..
constexpr std::size_t counter_refusal = 8059;

bool is_refused(const Registers& registers, int interrupt) {
  if (is_counter_interrupt(interrupt)) return registers.m[counter_refusal];
  const int first = interrupt < first_timer_interrupt ? first_refusal : first_timer_refusal - 6;
  return registers.m[static_cast<std::size_t>(first + interrupt / 100)];
}

}  // namespace

// What is refused is lost; what DI holds back waits, once.
void ProgramScan::ask(std::size_t interrupt, const Registers& registers) {
  if (is_refused(registers, program_.interrupts[interrupt].number)) return;
  if (std::find(waiting_.begin(), waiting_.end(), interrupt) == waiting_.end()) waiting_.push_back(interrupt);
}

void ProgramScan::request(int interrupt, const Registers& registers) {
  for (std::size_t i = 0; i < program_.interrupts.size(); ++i)
    if (program_.interrupts[i].number == interrupt) ask(i, registers);
}

void ProgramScan::take_interrupts(const std::array<bool, terminals>& inputs, std::int64_t time_ns,
                                  Registers& registers, Instructions& instructions) {
  constexpr std::int64_t ns_per_ms = 1'000'000;
  const bool first = taken_ns_ < 0;
  for (std::size_t i = 0; i < program_.interrupts.size() && !first; ++i) {
    const int number = program_.interrupts[i].number;
    if (is_counter_interrupt(number)) continue;
    if (number < first_timer_interrupt) {
      const auto input = static_cast<std::size_t>(number / 100);
      const bool wanted = number % 100 == 1;
      if (inputs[input] == wanted && levels_[input] != wanted) ask(i, registers);
    } else {
      const std::int64_t period_ns = number % 100 * ns_per_ms;
      if (time_ns / period_ns > taken_ns_ / period_ns) ask(i, registers);
    }
  }
  std::copy_n(inputs.begin(), levels_.size(), levels_.begin());
  taken_ns_ = time_ns;
  const auto work = run_interrupts(registers, instructions);
  if (rung_ != nullptr) rung_->work += work;
}

// The first that came first; of those of one tick that of the lowest number. How much they worked.
std::int64_t ProgramScan::run_interrupts(Registers& registers, Instructions& instructions) {
  std::int64_t work = 0;
  while (interrupts_on_ && !interrupted_ && !waiting_.empty()) {
    Rung routine{registers, instructions};
    refresh_watchdog(routine);
    routine.next = program_.interrupts[waiting_.front()].place;
    waiting_.erase(waiting_.begin());
    interrupted_ = true;
    run(routine, std::numeric_limits<std::int64_t>::max());
    interrupted_ = false;
    work += routine.work;
  }
  return work;
}

}  // namespace drycut::devices::lx3vp::il
