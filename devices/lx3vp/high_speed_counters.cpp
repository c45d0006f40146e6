#include "devices/lx3vp/high_speed_counters.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "base/state_archive.hpp"

namespace drycut::devices::lx3vp {

namespace {

constexpr int edges_per_pulse = 4;
constexpr int direction_relay = 8000;  // M8235 of C235

// Downwards, so that a standstill at 0 is no place where an edge is lost.
std::int64_t whole_pulses(std::int64_t edges) {
  return edges >= 0 ? edges / edges_per_pulse : -((edges_per_pulse - 1 - edges) / edges_per_pulse);
}

}  // namespace

void HighSpeedCounters::Channel::visit(StateArchive& archive) { STATE(archive, enabled, preset, last); }
void HighSpeedCounters::visit(StateArchive& archive) { STATE(archive, channels_, pulses_, compares_); }

void HighSpeedCounters::enable(int number, std::int32_t preset, bool powered) {
  Channel& channel = channels_[static_cast<std::size_t>(number - first_wide_counter)];
  channel.enabled = powered;
  channel.preset = preset;
}

void HighSpeedCounters::restart(int number, std::int64_t edges) {
  channels_[static_cast<std::size_t>(number - first_wide_counter)] = {false, 0, whole_pulses(edges)};
}

void HighSpeedCounters::count(int number, std::int64_t edges, Registers& registers) {
  Channel& channel = channels_[static_cast<std::size_t>(number - first_wide_counter)];
  const std::int64_t now = whole_pulses(edges);
  std::int64_t pulses = now - std::exchange(channel.last, now);
  if (!channel.enabled || pulses == 0) return;
  bool& down = registers.m[static_cast<std::size_t>(direction_relay + number)];
  if (number >= first_two_way_counter) {
    down = pulses < 0;
  } else {
    pulses = down ? -std::abs(pulses) : std::abs(pulses);
  }
  pulses_[static_cast<std::size_t>(number)] += pulses;
  PlcCounter& counter = registers.c[static_cast<std::size_t>(number)];
  const std::int32_t before = counter.value;
  // A ring of 32 bit.
  counter.value = static_cast<std::int32_t>(static_cast<std::uint32_t>(before + pulses));
  // The contact follows the count past the preset, either way; RST switches it off in between.
  if (before < channel.preset && before + pulses >= channel.preset) counter.contact = true;
  if (before >= channel.preset && before + pulses < channel.preset) counter.contact = false;
  if (!compares_.empty()) judge(number, before, before + pulses, registers);
}

void HighSpeedCounters::compare(int step, const CounterCompare& compare, bool powered) {
  if (powered)
    compares_[step] = compare;
  else
    compares_.erase(step);
}

void HighSpeedCounters::halt() {
  for (Channel& channel : channels_) channel.enabled = false;
  compares_.clear();
}

void HighSpeedCounters::write(Registers& registers, const CounterCompare& compare, int nth, bool on) {
  bool& bit = *bit_at(registers, compare.letter, compare.number + nth);
  if (compare.letter == 'Y') news_.outputs.emplace_back(compare.number + nth, on);
  bit = on;
}

// In the order in which the count comes to them.
void HighSpeedCounters::judge(int number, std::int64_t before, std::int64_t after, Registers& registers) {
  using enum CounterCompare::Kind;
  std::vector<const CounterCompare*> reached;
  for (const auto& [step, compare] : compares_) {
    if (compare.counter != number) continue;
    if (compare.kind == zone) {
      const int which = after < compare.low ? 0 : after > compare.high ? 2 : 1;
      for (int n = 0; n < 3; ++n) write(registers, compare, n, n == which);
      continue;
    }
    const bool upwards = before < compare.low && after >= compare.low;
    if (upwards || (before > compare.low && after <= compare.low)) reached.push_back(&compare);
  }
  std::ranges::stable_sort(reached, {},
                           [&](const CounterCompare* compare) { return std::abs(compare->low - before); });
  for (const CounterCompare* compare : reached) {
    if (compare->letter == 'I') {
      news_.interrupts.push_back(compare->number);
    } else if (compare->letter == 'C') {
      // What comes behind it in this tick counts on from 0.
      auto& counter = registers.c[static_cast<std::size_t>(number)];
      counter.value = static_cast<std::int32_t>(after - compare->low);
      counter.contact = false;
    } else {
      write(registers, *compare, 0, compare->kind == set);
    }
  }
}

void SpeedMeters::Meter::visit(StateArchive& archive) { STATE(archive, measure, ticks_left, level); }
void SpeedMeters::visit(StateArchive& archive) { STATE(archive, meters_); }

namespace {

constexpr std::int64_t ticks_per_ms = ticks_per_second / 1000;

void show_measure(const SpeedMeasure& measure, std::int64_t ticks_left, Registers& registers) {
  registers.put(measure.result + 2,
                static_cast<std::uint16_t>((ticks_left + ticks_per_ms - 1) / ticks_per_ms));
}

}  // namespace

void SpeedMeters::measure(int step, const SpeedMeasure& measure, bool powered, Registers& registers) {
  if (!powered) {
    meters_.erase(step);
    return;
  }
  const auto [meter, begins] = meters_.try_emplace(step);
  if (!begins) return;
  meter->second.measure = measure;
  meter->second.ticks_left = measure.period_ms * ticks_per_ms;
  registers.put(measure.result + 1, 0);
  show_measure(measure, meter->second.ticks_left, registers);
}

void SpeedMeters::tick(const std::array<bool, terminals>& inputs, Registers& registers) {
  for (auto& [step, meter] : meters_) {
    const bool level = inputs[static_cast<std::size_t>(meter.measure.input)];
    const bool was_on = std::exchange(meter.level, level);
    const auto present = static_cast<std::size_t>(meter.measure.result) + 1;
    if (level && !was_on)
      registers.put(meter.measure.result + 1, static_cast<std::uint16_t>(registers.d[present] + 1));
    if (--meter.ticks_left <= 0) {
      registers.put(meter.measure.result, registers.d[present]);
      registers.put(meter.measure.result + 1, 0);
      meter.ticks_left = meter.measure.period_ms * ticks_per_ms;
    }
    show_measure(meter.measure, meter.ticks_left, registers);
  }
}

}  // namespace drycut::devices::lx3vp
