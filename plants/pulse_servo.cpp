#include "plants/pulse_servo.hpp"

#include <cmath>
#include <numbers>

#include "base/state_archive.hpp"
#include "plants/lag.hpp"

namespace drycut::plants {

namespace {

void show(SignalPort& port, bool level) {
  port.edges.clear();
  port.show(level);
}

}  // namespace

PulseServo::PulseServo(const PulseServoData& data, ServoDrive& amplifier, const Shaft& rotor)
    : data_(data),
      amplifier_(amplifier),
      gear_(data.gear_numerator, data.gear_denominator),
      start_turns_(rotor.turns),
      start_part_(rotor.part) {
  in_position.level = amplifier.enabled();
}

std::int64_t PulseServo::actual(const Shaft& rotor) const {
  // Whole turns stay whole numbers: a double of them all would lose counts on a long run.
  const double part = (rotor.part - start_part_) * data_.resolution;
  return (rotor.turns - start_turns_) * data_.resolution + static_cast<std::int64_t>(std::floor(part + 0.5));
}

void PulseServo::take_pulses() {
  const std::int64_t come = pulses.pulses - seen_;
  seen_ = pulses.pulses;
  if (come == 0 || cable_broken_) return;
  const std::int64_t net = direction.level ? come : -come;
  reference_ += static_cast<double>(net);
  gear_.add(net);
}

void PulseServo::drive(Shaft& rotor, double h) {
  take_pulses();
  if (reset.level && !reset_before_) tripped_ = false;
  reset_before_ = reset.level;

  const std::int64_t counts = gear_.counts();
  const double radians = 2 * std::numbers::pi / data_.resolution;
  if (h != h_) {
    h_ = h;
    forward_share_ = share_of(data_.feed_forward_filter, h);
    smoothing_share_ = share_of(data_.smoothing, h);
  }
  const auto come = static_cast<double>(counts - counts_before_);
  const double followed = (unsmoothed_ + come) * smoothing_share_;
  unsmoothed_ += come - followed;
  const double speed = followed * radians / h;
  counts_before_ = counts;
  forward_speed_ += (speed - forward_speed_) * forward_share_;
  if (tripped_ || !amplifier_.enabled()) {
    cleared_ = counts - actual(rotor);
    unsmoothed_ = 0;
    amplifier_.coast(rotor, h);
    return;
  }
  const double behind = static_cast<double>(counts - cleared_ - actual(rotor)) - unsmoothed_;
  amplifier_.follow(data_.position_gain * behind * radians + data_.feed_forward * forward_speed_,
                    forward_speed_, rotor, h);
}

void PulseServo::sense(const Shaft& rotor) {
  const bool enabled = amplifier_.enabled() && !tripped_;
  const double behind =
      enabled ? static_cast<double>(gear_.counts() - cleared_ - actual(rotor)) - unsmoothed_ : 0;
  deviation_ = behind * gear_.pulses_per_count();
  const double turns = behind / data_.resolution;
  just_tripped_ = std::abs(turns) > data_.following_limit;
  if (just_tripped_) {
    tripped_ = true;
    trip_turns_ = turns;
  }
  show(alarm, tripped_);
  show(in_position, enabled && !tripped_ && std::abs(deviation_) <= data_.in_position);
}

void PulseServo::offer_faults(std::vector<Fault>& faults, const std::string& component) {
  faults.push_back({component,
                    "lose_pulses",
                    "",
                    [this](double v) {
                      const auto lost = std::llround(v);
                      reference_ -= static_cast<double>(lost);
                      gear_.add(-lost);
                    },
                    "so many pulses are lost at once, negative: too many are counted",
                    in_counts,
                    {},
                    500});
  faults.push_back(fault_state(component, "broken_cable", cable_broken_, "1: no pulse arrives"));
}

void ElectronicGear::visit(StateArchive& archive) { STATE(archive, counts_, remainder_); }

void PulseServo::visit(StateArchive& archive) {
  STATE(archive, pulses, direction, reset, in_position, alarm, gear_, seen_, cleared_, counts_before_,
        reference_, deviation_, unsmoothed_, forward_speed_, trip_turns_, tripped_, just_tripped_,
        reset_before_, cable_broken_);
}

Parameters pulse_servo_parameters(PulseServoData& data) {
  constexpr std::string_view manual = "initial value of Mitsubishi MR-J4-A";
  return {
      row("gear_numerator", "electronic gear: encoder counts for gear_denominator pulses",
          data.gear_numerator, 1, 16777215, "with the denominator: 10000 pulses a turn"),
      row("gear_denominator", "electronic gear: pulses for gear_numerator encoder counts",
          data.gear_denominator, 1, 16777215, "with the numerator: 10000 pulses a turn"),
      row("resolution", "counts of the drive's own encoder per turn of the motor", data.resolution, 1,
          16777216, "encoder of the class: 22 bits"),
      row("position_gain", "rad/s", "gain of the position loop: speed for a deviation", data.position_gain,
          0.1, 2000, "estimate: medium stiffness"),
      row("feed_forward", "%", "share of the reference speed given ahead of the position loop",
          data.feed_forward, 0, 100, manual),
      row("feed_forward_filter", "ms", "time constant of the feed-forward, 0 = none",
          data.feed_forward_filter, 0, 100, "estimate"),
      row("smoothing", "ms",
          "time constant with which the command follows the pulses, 0 = none; the deviation is that from it",
          data.smoothing, 0, 1000, manual),
      row("following_limit", "", "deviation that trips the drive, in turns of the motor",
          data.following_limit, 1e-3, 1e4, manual),
      row("in_position", "", "deviation up to which the axis is in position, in pulses", data.in_position, 0,
          65535, manual),
  };
}

}  // namespace drycut::plants
