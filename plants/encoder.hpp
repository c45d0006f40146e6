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

  /// Carries the exact position over a step of `h` seconds [bits x4].
  void carry(double before, double now, double h) {
    if (now != last_) forward_ = now > last_;
    last_ = now;
    double early = 0;
    double late = 0;
    double added = 0;
    if (noisy_) {
      early = jitter_now_;
      late = jitter_now_ = jitter_ > 0 ? jitter_ * random_.gaussian() : 0;
      added = false_counts(h);
    }
    port.before = base_ + gain_ * (before - anchor_) + early;
    base_ += added;
    port.now = base_ + gain_ * (now - anchor_) + late;
    port.count = port.count_at(1);
  }
  [[nodiscard]] bool stuck() const { return stuck_; }

  /// lose_counts, stuck, reverse, jitter, and bursts of false counts under the component name `component`. 0
  /// clears stuck, reverse and jitter.
  void offer_faults(std::vector<Fault>& faults, const std::string& component);

 private:
  /// A count that the motion did not make, at a time on clock_ [s].
  struct FalseCount {
    double time;
    double count;  // 1 or -1
  };

  void change_gain();
  void lose(double counts);
  void burst(double counts, bool by_chance);
  double false_counts(double h);  // of this step
  void listen() { noisy_ = jitter_ > 0 || !burst_.empty(); }

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
  bool noisy_ = false;             // there is jitter or a burst
  double burst_time_ = 0.01;       // [s]
  double clock_ = 0;               // runs while a burst lasts [s]
  std::vector<FalseCount> burst_;  // still to come, the next one last
};

/// Puts the index pulses of a step on `index`: pulses without width, a rising and a falling edge at the exact
/// fraction at which `turns` passes a whole number, (before, now] forwards and [now, before) backwards. The
/// counts are the same motion in bits x4: the fraction is taken from them, so that
/// EncoderPort::count_at(fraction) gives the index's own count to the last digit. `width` of the pulse in
/// counts, for whoever must know how long it lasted (SignalPort::Edge::width).
void put_index(SignalPort& index, double turns_before, double turns, double count_before, double count,
               double count_per_turn, double width = 1);

/// Incremental encoder on a shaft: counts x4 since the start, and an index pulse once a turn.
struct EncoderData {
  int lines = 2048;         ///< per turn; the counter counts four times as many
  bool reverse = false;     ///< counts down when the shaft turns forwards
  double eccentricity = 0;  ///< its disc sits off the axis: peak of the error that comes once a turn [rad]
  double tooth_error = 0;   ///< peak of the error that comes `teeth` times a turn [rad]
  int teeth = 64;           ///< of its gear or coupling
  double index_width = 1;   ///< of the index pulse [bits x4]
};

/// Rows of the group `encoder.` for what is not ideal about it.
Parameters encoder_error_parameters(EncoderData& data);
/// What is wrong with them, for parameters of the group `encoder.`.
std::vector<PlantDefinition::Objection> encoder_objections(const EncoderData& data);

class Encoder {
 public:
  /// `start`: revolutions of the shaft at the start, where the count is 0.
  Encoder(const EncoderData& data, double start, Random noise);

  PulseLine pulses;
  SignalPort index;  ///< once a turn of the shaft, at its whole turns: see put_index

  /// Follows the shaft over the last step of `h` seconds.
  void sense(const Shaft& shaft, double h);

 private:
  // What it shows ahead of the shaft at a part of a turn [turns].
  [[nodiscard]] double error(double part) const;

  EncoderData data_;
  bool uneven_;
  double bits_per_turn_;
  double start_;  // as it shows it
};

}  // namespace drycut::plants
