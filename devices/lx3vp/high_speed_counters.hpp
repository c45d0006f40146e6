#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "devices/lx3vp/instructions.hpp"
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
  void compare(int step, const CounterCompare& compare, bool powered);
  /// The program stops: nothing counts or compares until it asks anew.
  void halt();
  /// What counting has brought since the last call.
  struct News {
    std::vector<std::pair<int, bool>> outputs;  ///< levels of Y to give at once
    std::vector<int> interrupts;                ///< 10 of I010
  };
  [[nodiscard]] bool has_news() const { return !news_.outputs.empty() || !news_.interrupts.empty(); }
  News take_news() { return std::exchange(news_, {}); }
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
  /// The register has gone from `before` to `after`, as if it did not wrap.
  void judge(int number, std::int64_t before, std::int64_t after, Registers& registers);
  void write(Registers& registers, const CounterCompare& compare, int nth, bool on);

  std::array<Channel, counters - first_wide_counter> channels_{};
  std::map<int, CounterCompare> compares_;  ///< by step, those with power
  News news_;                               ///< taken in the tick that brings it: no state
  std::array<std::int64_t, counters> pulses_{};
};

/// What SPD measures: pulses of inputs, by ticks of 100 us.
class SpeedMeters {
 public:
  /// As in `Instructions`.
  void measure(int step, const SpeedMeasure& measure, bool powered, Registers& registers);
  [[nodiscard]] bool measures() const { return !meters_.empty(); }
  /// A tick with the levels of the inputs.
  void tick(const std::array<bool, terminals>& inputs, Registers& registers);
  void visit(StateArchive& archive);

 private:
  struct Meter {
    SpeedMeasure measure;
    std::int64_t ticks_left = 0;
    bool level = true;  ///< of the input in the tick before
    void visit(StateArchive& archive);
  };
  std::map<int, Meter> meters_;  ///< by step, those with power
};

}  // namespace drycut::devices::lx3vp
