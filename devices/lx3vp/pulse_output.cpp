#include "devices/lx3vp/instructions.hpp"

#include <algorithm>
#include <cstdlib>

#include "base/state_archive.hpp"

namespace drycut::devices::lx3vp {

void MasterSource::visit(StateArchive& archive) { STATE(archive, kind, number); }
void StartSignal::visit(StateArchive& archive) { STATE(archive, is_input, number); }
void DecamOperands::visit(StateArchive& archive) { STATE(archive, master, block, start, output, direction); }
void DogSignal::visit(StateArchive& archive) { STATE(archive, letter, number); }
void PulseOrder::visit(StateArchive& archive) {
  STATE(archive, kind, output, direction, frequency, pulses, creep, dog, ramp_ms, width_ms, period_ms);
}
void CounterCompare::visit(StateArchive& archive) {
  STATE(archive, kind, counter, low, high, letter, number);
}
void SpeedMeasure::visit(StateArchive& archive) { STATE(archive, input, result, period_ms); }
void PulseOutput::visit(StateArchive& archive) { STATE(archive, position_, credit_, forwards_); }

PulseTick PulseOutput::give(std::int64_t pulses, bool forwards) {
  position_ += forwards ? pulses : -pulses;
  return {static_cast<int>(pulses), forwards_, false};
}

PulseTick PulseOutput::follow(std::int64_t target, std::int32_t limit) {
  const std::int64_t owed = std::abs(target - position_);
  const bool forwards = target > position_;
  credit_ += limit;
  const std::int64_t allowed = credit_ / ticks_per_second;
  std::int64_t given = std::min(owed, allowed);
  if (owed > 0 && forwards != forwards_) {
    forwards_ = forwards;
    given = 0;
  }
  // Less than a pulse is kept: enough that a steady train at the limit passes, too little for a burst.
  credit_ = std::min<std::int64_t>(credit_ - given * ticks_per_second, ticks_per_second - 1);
  PulseTick tick = give(given, forwards);
  tick.late = owed > allowed;
  return tick;
}

PulseTick PulseOutput::run(std::int32_t frequency, std::int64_t most) {
  const bool forwards = frequency > 0;
  if (frequency == 0) return give(0, forwards);
  if (forwards != forwards_) {
    forwards_ = forwards;
    return give(0, forwards);
  }
  credit_ += std::abs(frequency);
  const std::int64_t pulses = std::min(credit_ / ticks_per_second, most);
  credit_ -= pulses * ticks_per_second;
  return give(pulses, forwards);
}

}  // namespace drycut::devices::lx3vp
