#pragma once
#include <cmath>
#include <cstdint>
#include <limits>
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
    port.before = base_ + gain_ * (before - anchor_);
    if (noisy_) {
      port.before += jitter_now_;
      jitter_now_ = jitter_ > 0 ? jitter_ * random_.gaussian() : 0;
      base_ += false_counts(h);
    }
    port.now = base_ + gain_ * (now - anchor_);
    if (noisy_) port.now += jitter_now_;
    // That of port.count_at(1), whose floor is a call.
    const double exact = port.before + (port.now - port.before) + 0.5;
    const auto towards_0 = static_cast<std::int64_t>(exact);
    port.count = static_cast<double>(towards_0) > exact ? towards_0 - 1 : towards_0;
  }
  [[nodiscard]] bool stuck() const { return stuck_; }

  /// lose_counts, stuck, reverse, jitter, and bursts of false counts under the component name `component`. 0
  /// clears stuck, reverse and jitter.
  void offer_faults(std::vector<Fault>& faults, const std::string& component);

  void visit(StateArchive& archive);

 private:
  /// A count that the motion did not make, at a time on clock_ [s].
  struct FalseCount {
    double time;
    double count;  // 1 or -1
    void visit(StateArchive& archive);
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

void put_passed_index(SignalPort& index, double turns_before, double turns, double count_before, double count,
                      double count_per_turn, double width);
/// Puts the index pulses of a step on `index`: pulses without width, a rising and a falling edge at the exact
/// fraction at which `turns` passes a whole number, (before, now] forwards and [now, before) backwards. The
/// counts are the same motion in bits x4: the fraction is taken from them, so that
/// EncoderPort::count_at(fraction) gives the index's own count to the last digit. `width` of the pulse in
/// counts, for whoever must know how long it lasted (SignalPort::Edge::width).
inline void put_index(SignalPort& index, double turns_before, double turns, double count_before, double count,
                      double count_per_turn, double width = 1) {
  // Both are beyond the same whole number and before the next: the common case, told without rounding. What
  // is cut off to 0 lies on either side of it.
  const auto whole = static_cast<std::int64_t>(turns_before);
  const auto exact = static_cast<double>(whole);
  if (static_cast<std::int64_t>(turns) == whole && turns_before != exact && turns != exact &&
      (whole != 0 || (turns_before > 0) == (turns > 0)))
    return;
  if (turns == turns_before) return;
  put_passed_index(index, turns_before, turns, count_before, count, count_per_turn, width);
}

/// Incremental encoder on a shaft: counts x4 since the start, and an index pulse once a turn.
struct EncoderData {
  int lines = 2048;                     ///< per turn; the counter counts four times as many
  bool reverse = false;                 ///< counts down when the shaft turns forwards
  std::string encoder_class = "ideal";  ///< of encoder_classes(): the errors below unless they are given
  double eccentricity = 0;  ///< its disc sits off the axis: peak of the error that comes once a turn [rad]
  double interpolation_error = 0;  ///< peak of the error that comes once a signal period, over that period
  int signal_periods = 0;          ///< of its disc, a turn; 0: as many as lines
  double tooth_error = 0;          ///< peak of the error that comes `teeth` times a turn [rad]
  int teeth = 64;                  ///< of its gear or coupling
  double index_width = 1;          ///< of the index pulse [bits x4]
};

/// Kinds of encoders with their usual errors; values of encoder.eccentricity and
/// encoder.interpolation_error.
const std::vector<Preset>& encoder_classes();
/// Rows of the group `encoder.` for what is not ideal about it.
Parameters encoder_error_parameters(EncoderData& data);
/// What is wrong with them, for parameters of the group `encoder.`.
std::vector<PlantDefinition::Objection> encoder_objections(const EncoderData& data);

/// What a function of one number came to last: a step begins where the one before ended.
class LastValue {
 public:
  template <typename Function>
  double at(double place, Function function) {
    if (place != place_) value_ = function(place_ = place);
    return value_;
  }

 private:
  double place_ = std::numeric_limits<double>::quiet_NaN();
  double value_ = 0;
};

class Encoder {
 public:
  /// `start`: revolutions of the shaft at the start, where the count is 0.
  Encoder(const EncoderData& data, double start, Random noise);

  PulseLine pulses;
  SignalPort index;  ///< once a turn of the shaft, at its whole turns: see put_index

  /// Follows the shaft over the last step of `h` seconds.
  void sense(const Shaft& shaft, double h);

  void visit(StateArchive& archive);

 private:
  // What it shows ahead of the shaft at a part of a turn [turns].
  [[nodiscard]] double error(double part) const;

  const EncoderData data_;
  const bool uneven_;
  const double bits_per_turn_;
  const double start_;  // as it shows it
  LastValue error_;
};

/// A proximity or limit switch with a target of some width: on while the position is over the target. All
/// positions in one unit of the plant's choice (turns for a drum, metres for a slide).
struct PositionSwitchData {
  double centre = 0;      ///< of the target
  double width = 0;       ///< of the target
  double hysteresis = 0;  ///< the switch lets go this far behind the edge of the target
  double delay = 0;       ///< of its filter [s]: shorter pulses and gaps are swallowed
};

class PositionSwitch {
 public:
  /// `period`: the position repeats after this much (1 turn), 0 = it does not. `start`: position at the
  /// start.
  PositionSwitch(const PositionSwitchData& data, double period, double start);

  SignalPort port;  ///< edges with their exact fraction of the step, after the delay

  /// Follows the motion over the last step of `h` seconds, over the whole target if it goes so far.
  void sense(double before, double now, double h) {
    port.edges.clear();
    if (before == now && !pending_) return;
    const double way = shorter(now - before);
    // Over the centre it comes towards it first, then goes away.
    const double rest = std::abs(way) > distance_ ? to_centre(before, way, h) : 0;
    move(std::abs(offset(now)), rest, 1, h);
    if (pending_) filter(h);
  }
  /// The same for a target that is not at one place: `distance` from its centre now.
  void follow(double distance, double h);

  /// stuck and dead under the component name `component`. 0 clears each.
  void offer_faults(std::vector<Fault>& faults, const std::string& component);

  void visit(StateArchive& archive);

 private:
  // The shorter way round, where it goes round.
  [[nodiscard]] double shorter(double way) const {
    return period_ > 0 && std::abs(way) > period_ / 2 ? wrapped(way) : way;
  }
  [[nodiscard]] double wrapped(double way) const;
  [[nodiscard]] double offset(double position) const {  // from the nearest centre
    return shorter(position - data_.centre);
  }
  double to_centre(double before, double way, double h);
  // In this part of the step, straight.
  void move(double distance, double begin, double end, double h) {
    const double was = distance_;
    distance_ = distance;
    const double edge = data_.width / 2 + (raw_ ? data_.hysteresis : 0);
    if ((distance <= edge) != raw_) pass(edge, was, begin, end, h);
  }
  void pass(double edge, double was, double begin, double end, double h);
  void filter(double h);
  void let_through(double h);
  void show(bool level, double fraction);

  PositionSwitchData data_;
  double period_;
  double distance_;       // at the end of the last step
  bool raw_;              // over the target, with hysteresis, before the delay
  bool filtered_;         // after the delay, before the faults
  bool pending_ = false;  // raw_ changed less than `delay` ago
  double remaining_ = 0;  // until the filter lets it through [s]
  bool stuck_ = false;
  bool dead_ = false;
};

/// What an axis' position is measured with; positions along the axis [m].
struct AxisTransducersData {
  EncoderData encoder = {.lines = 2500};                ///< on the motor
  double scale_resolution = 1e-6;                       ///< of the linear scale, a count x4
  double scale_pitch = 0.02;                            ///< between two index pulses of the scale
  PositionSwitchData home = {0, 0.02, 0.5e-3, 0.5e-3};  ///< [m]
  double limit_min = -0.03;                             ///< the limit switches are on beyond these
  double limit_max = 1.03;
  double limit_delay = 0.5e-3;  ///< of the limit switches' filter [s]
};

/// Where a machine's defaults are from.
struct AxisTransducersSources {
  std::string_view scale_resolution = "a usual scale";
  std::string_view home = "position 0";
  std::string_view limits = "20 mm before the stop";
};
/// Rows for a parameter table: `encoder.`, `scale.`, `home.`, `limit_`.
Parameters axis_transducer_parameters(AxisTransducersData& data, const AxisTransducersSources& from = {});

/// Encoder on the motor, linear scale and switches on the moving part. Both count 0 at the start.
class AxisTransducers {
 public:
  /// `start` [m] and `revolutions` of the motor at the start.
  AxisTransducers(const AxisTransducersData& data, double start, double revolutions, Random encoder_noise,
                  Random scale_noise);

  /// Follows the bodies over the last step of `h` seconds.
  void sense(const Shaft& rotor, const Slide& part, double h);

  // What they add to a plant's lists.
  void offer_ports(std::vector<Port>& ports);
  void offer_channels(std::vector<Channel>& channels) const;
  void offer_faults(std::vector<Fault>& faults);

  void visit(StateArchive& archive);

 private:
  const AxisTransducersData data_;
  const double start_;
  Encoder encoder_;
  PulseLine scale_;
  SignalPort scale_index_;
  PositionSwitch home_;
  PositionSwitch limit_min_;
  PositionSwitch limit_max_;
};

}  // namespace drycut::plants
