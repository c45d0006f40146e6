#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "plants/plant.hpp"
#include "plants/servo_drive.hpp"

namespace drycut::plants {

/// The position loop of a servo that takes a pulse train. Values of the class of Mitsubishi MR-J4-A.
struct PulseServoData {
  int gear_numerator = 4194304;  ///< encoder counts per pulse: numerator over denominator
  int gear_denominator = 10000;
  int resolution = 4194304;           ///< of the drive's own encoder, counts a turn of the motor
  double position_gain = 50;          ///< Kp [rad/s]: speed for a deviation
  double feed_forward = 0;            ///< share of the reference speed given ahead of the loop, 0..1
  double feed_forward_filter = 2e-3;  ///< time constant, 0 = none [s]: smooths the whole counts of a step
  double smoothing = 0;               ///< time constant with which the command is followed, 0 = none [s]
  double following_limit = 3;         ///< deviation that trips the drive [turns of the motor]
  double in_position = 100;           ///< deviation up to which the axis is in position [pulses]
};

/// Rows of the group `servo.pulses.`.
Parameters pulse_servo_parameters(PulseServoData& data);

/// Counts = pulses * numerator / denominator in whole numbers: what a division leaves is kept for the next
/// pulse, so that any number of pulses in any pieces ends on the same count.
class ElectronicGear {
 public:
  /// Both > 0.
  ElectronicGear(int numerator, int denominator) : numerator_(numerator), denominator_(denominator) {}

  void add(std::int64_t pulses) {
    const std::int64_t total = remainder_ + pulses * numerator_;
    std::int64_t whole = total / denominator_;
    remainder_ = total % denominator_;
    if (remainder_ < 0) {  // the remainder stays 0 .. denominator - 1, backwards too
      remainder_ += denominator_;
      --whole;
    }
    counts_ += whole;
  }
  [[nodiscard]] std::int64_t counts() const { return counts_; }  ///< since the start, rounded down
  [[nodiscard]] double pulses_per_count() const {
    return static_cast<double>(denominator_) / static_cast<double>(numerator_);
  }

  void visit(StateArchive& archive);

 private:
  const std::int64_t numerator_;
  const std::int64_t denominator_;
  std::int64_t counts_ = 0;
  std::int64_t remainder_ = 0;
};

/// A servo amplifier that follows a pulse train: electronic gear, position loop with speed feed-forward, then
/// the speed and current loops of ServoDrive. A deviation beyond the limit trips it: the motor coasts, the
/// output alarm is on until reset. While it is disabled or tripped the deviation is held at 0 and pulses are
/// lost, as in the cabinet.
class PulseServo {
 public:
  /// `amplifier` lives as long as this; `rotor` at its start, where the reference is 0.
  PulseServo(const PulseServoData& data, ServoDrive& amplifier, const Shaft& rotor);

  PulsePort pulses;
  CommandPort direction;   ///< high = forward
  CommandPort reset;       ///< its rising edge clears the alarm
  SignalPort in_position;  ///< enabled and the deviation within its range
  SignalPort alarm;        ///< tripped

  /// Torque on the rotor for the coming step of `h` seconds.
  void drive(Shaft& rotor, double h);
  /// Outputs and trip after the step.
  void sense(const Shaft& rotor);

  [[nodiscard]] double reference() const { return reference_; }      ///< net pulses since the start
  [[nodiscard]] double deviation() const { return deviation_; }      ///< reference less motor [pulses]
  [[nodiscard]] bool just_tripped() const { return just_tripped_; }  ///< in the last step
  [[nodiscard]] double trip_turns() const { return trip_turns_; }    ///< deviation of the last trip [turns]

  /// Faults of the pulse cable, under the component name `component`.
  void offer_faults(std::vector<Fault>& faults, const std::string& component);

  void visit(StateArchive& archive);

 private:
  [[nodiscard]] std::int64_t actual(const Shaft& rotor) const;
  void take_pulses();

  const PulseServoData data_;
  ServoDrive& amplifier_;
  ElectronicGear gear_;
  const std::int64_t start_turns_;
  const double start_part_;
  std::int64_t seen_ = 0;     // of the pulse port
  std::int64_t cleared_ = 0;  // counts of the reference that are not to be followed
  std::int64_t counts_before_ = 0;
  double reference_ = 0;
  double deviation_ = 0;
  double h_ = 0;              // the step for which the share below holds
  double forward_share_ = 1;  // of a change of the reference's speed, followed in a step
  double smoothing_share_ = 1;
  double unsmoothed_ = 0;     // counts that the smoothed command is behind
  double forward_speed_ = 0;  // filtered speed of the reference [rad/s]
  double trip_turns_ = 0;
  bool tripped_ = false;
  bool just_tripped_ = false;
  bool reset_before_ = false;
  bool cable_broken_ = false;
};

}  // namespace drycut::plants
