#pragma once
#include <cstdint>
#include <deque>
#include <string>
#include <utility>
#include <vector>

#include "plants/ports.hpp"

namespace drycut::sim::loop {

/// What a filter of a card did not let through, for events.
struct Loss {
  std::string event;  ///< counts_lost, pulse_lost
  std::string text;
};

/// The filters of the cards' inputs: each stands in a wire, from a plug of a plant to what the terminal sees.
class InputFilters {
 public:
  /// A counter that follows `hertz` of one phase, four counts each, and loses what is beyond.
  const plants::EncoderPort* counter(const plants::EncoderPort* from, std::string terminal, double hertz);
  /// A line that sees zero pulses of `seconds` or more.
  const plants::SignalPort* zero_pulse(const plants::SignalPort* from, std::string terminal, double seconds);
  /// An input that takes a level when it has lasted `seconds`; shorter ones are swallowed. It gives no edges.
  const plants::SignalPort* input(const plants::SignalPort* from, double seconds);

  /// Lets the last step of `h` seconds through.
  void pass(double h);

  /// When a loss begins, once for each time that it does. A counter that was below its limit for 100 ms, a
  /// line that saw a pulse, begin anew.
  [[nodiscard]] std::vector<Loss> take_losses() { return std::exchange(losses_, {}); }
  /// What was lost in all, a line a terminal.
  [[nodiscard]] std::vector<std::string> lost() const;

 private:
  struct CounterFilter {
    const plants::EncoderPort* from;
    std::string terminal;
    double hertz;
    plants::EncoderPort to = {};
    double behind = 0;  // the count stays behind by so much
    double lost = 0;    // in either direction
    double calm = 1;    // since it lost the last ones [s]
  };
  struct PulseFilter {
    const plants::SignalPort* from;
    std::string terminal;
    double least;  // [s]
    plants::SignalPort to = {};
    std::int64_t lost = 0;
    bool losing = false;
  };
  struct LevelFilter {
    const plants::SignalPort* from;
    double delay;  // [s]
    plants::SignalPort to = {};
    double lasted = 0;  // the level that is not let through yet [s]
  };
  void pass(CounterFilter& filter, double h);
  void pass(PulseFilter& filter, double h);
  static void pass(LevelFilter& filter, double h);

  // Their ports are known by their place.
  std::deque<CounterFilter> counters_;
  std::deque<PulseFilter> pulses_;
  std::deque<LevelFilter> levels_;
  std::vector<Loss> losses_;
};

}  // namespace drycut::sim::loop
