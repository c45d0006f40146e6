#pragma once
#include <string>
#include <vector>

#include "plants/plant.hpp"
#include "plants/random.hpp"
#include "plants/world.hpp"

namespace drycut::plants {

/// The way of a transducer's pulses to the counter, with what can go wrong on it: EncoderPort is after the
/// faults. The count is a straight line of the exact position between two changes of a fault, so that nothing
/// is summed up and nothing drifts.
class PulseLine {
 public:
  explicit PulseLine(Random noise) : random_(noise) {}

  EncoderPort port;

  /// Carries the exact position over a step [bits x4].
  void carry(double before, double now) {
    if (now != last_) forward_ = now > last_;
    last_ = now;
    double early = 0;
    double late = 0;
    if (jitter_ > 0) {
      early = jitter_now_;
      late = jitter_now_ = jitter_ * random_.gaussian();
    }
    port.before = base_ + gain_ * (before - anchor_) + early;
    port.now = base_ + gain_ * (now - anchor_) + late;
    port.count = port.count_at(1);
  }
  [[nodiscard]] bool stuck() const { return stuck_; }

  /// lose_counts, stuck, reverse and jitter under the component name `component`. 0 clears each but
  /// lose_counts.
  void offer_faults(std::vector<Fault>& faults, const std::string& component);

 private:
  void change_gain();
  void lose(double counts);

  Random random_;
  double gain_ = 1;    // counts out per count in
  double anchor_ = 0;  // exact position where the gain changed last
  double base_ = 0;    // count out there
  double last_ = 0;    // exact position
  bool forward_ = true;
  bool stuck_ = false;
  bool reverse_ = false;
  double jitter_ = 0;  // rms [bits x4]
  double jitter_now_ = 0;
};

/// Puts the index pulses of a step on `index`: pulses without width, a rising and a falling edge at the exact
/// fraction at which `turns` passes a whole number, (before, now] forwards and [now, before) backwards. The
/// counts are the same motion in bits x4: the fraction is taken from them, so that
/// EncoderPort::count_at(fraction) gives the index's own count to the last digit.
void put_index(SignalPort& index, double turns_before, double turns, double count_before, double count,
               double count_per_turn);

/// Incremental encoder on a shaft: counts x4 since the start, and an index pulse once a turn.
struct EncoderData {
  int lines = 2048;      ///< per turn; the counter counts four times as many
  bool reverse = false;  ///< counts down when the shaft turns forwards
};

class Encoder {
 public:
  /// `start`: revolutions of the shaft at the start, where the count is 0.
  Encoder(const EncoderData& data, double start, Random noise);

  PulseLine pulses;
  SignalPort index;  ///< once a turn of the shaft, at its whole turns: see put_index

  void sense(const Shaft& shaft);

 private:
  double bits_per_turn_;
  double start_;
};

}  // namespace drycut::plants
