#pragma once
#include <cstdint>

namespace drycut::devices::lx3vp {

/// What an output does in a tick of 100 us.
struct PulseTick {
  int pulses = 0;        ///< to give, of one direction
  bool forwards = true;  ///< level of the direction output
  bool late = false;     ///< the frequency limit held pulses back
};

/// A pulse output with its direction, by ticks. It never loses a pulse and never gives more than the
/// frequency allows; what it owes comes later. The direction changes a tick before the first pulse that way.
class PulseOutput {
 public:
  /// Pulses given since power-up, less those backwards.
  [[nodiscard]] std::int64_t position() const { return position_; }
  [[nodiscard]] bool forwards() const { return forwards_; }
  /// Sets the direction while nothing is owed, so that the first pulse that way need not wait.
  void face(bool forwards) { forwards_ = forwards; }

  /// One tick towards `target`, at most at `limit` [Hz], 0..200000.
  PulseTick follow(std::int64_t target, std::int32_t limit);
  /// One tick at `frequency` [Hz], -200000..200000, negative backwards; not more than `most` pulses.
  PulseTick run(std::int32_t frequency, std::int64_t most);
  /// Nothing is owed any more: what a fraction of a pulse has gathered is dropped.
  void halt() { credit_ = 0; }

 private:
  PulseTick give(std::int64_t pulses, bool forwards);

  std::int64_t position_ = 0;
  std::int64_t credit_ = 0;  ///< pulses that the frequency has allowed and nobody used [1/10000 pulse]
  bool forwards_ = false;
};

inline constexpr std::int64_t tick_ns = 100'000;
inline constexpr int ticks_per_second = 10'000;

}  // namespace drycut::devices::lx3vp
