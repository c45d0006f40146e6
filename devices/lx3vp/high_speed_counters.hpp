#pragma once
#include <array>
#include <cstdint>

#include "devices/lx3vp/registers.hpp"

namespace drycut::devices::lx3vp {

/// The counters C235..C255, and C200..C234 where they are wired, which count the pulses of their terminals by
/// themselves. Those up to C245 count every pulse in the direction of M8200..M8245 (on = down); C246..C255
/// count both ways and show the direction in M8246..M8255. A pulse is one period of an encoder, four edges,
/// as with an FX.
class HighSpeedCounters {
 public:
  /// As in `Instructions`.
  void enable(int number, std::int32_t preset, bool powered);
  /// Takes the edges of a counter's terminals since power-up; four of them are a pulse.
  void count(int number, std::int64_t edges, Registers& registers);
  /// Counts from here on, with nothing enabled.
  void restart(int number, std::int64_t edges);
  /// Pulses that each counter has counted since power-up, whatever was written to its register.
  [[nodiscard]] const std::array<std::int64_t, counters>& pulses() const { return pulses_; }

  void visit(StateArchive& archive);

 private:
  struct Channel {
    bool enabled = false;
    std::int32_t preset = 0;
    std::int64_t last = 0;
    void visit(StateArchive& archive);
  };
  std::array<Channel, counters - first_wide_counter> channels_{};
  std::array<std::int64_t, counters> pulses_{};
};

}  // namespace drycut::devices::lx3vp
