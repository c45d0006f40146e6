#include "devices/lx3vp/high_speed_counters.hpp"

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
void HighSpeedCounters::visit(StateArchive& archive) { STATE(archive, channels_, pulses_); }

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
}

}  // namespace drycut::devices::lx3vp
