#pragma once
#include <optional>
#include <string>
#include <vector>

#include "plants/efficiency.hpp"
#include "plants/pulse_servo.hpp"
#include "plants/servo_drive.hpp"

namespace drycut::plants {

/// The servo of a machine that runs under either kind of controller: one with analogue outputs or one that
/// gives pulse trains.
struct ServoAxisData {
  std::string kind = "servo";  ///< servo: speed reference +-10 V; pulses: pulse train and position loop
  ServoData servo = {};
  PulseServoData pulses = {};
  std::string servo_model = std::string(no_model);  ///< whose values `servo` has; whoever fills it sees to it
};

/// Rows for a parameter table: `drive`, `servo.`, `servo.pulses.`; `from` of a machine's defaults.
Parameters servo_axis_parameters(ServoAxisData& data, const ServoSources& from = {});
/// What is wrong with the data taken together, with `inertia` on the motor's shaft [kg m2] and steps of `h`
/// seconds.
std::vector<PlantDefinition::Objection> servo_axis_objections(const ServoAxisData& data, double inertia,
                                                              double h);

/// Event: `following_error` (turns, speed) when a position loop has tripped.
class ServoAxis {
 public:
  /// `rotor` at its start, where the position reference of a pulse train is 0.
  ServoAxis(const ServoAxisData& data, const Shaft& rotor, Random noise);
  // Its parts know each other.
  ServoAxis(const ServoAxis&) = delete;
  ServoAxis& operator=(const ServoAxis&) = delete;

  /// Torque on the rotor for the coming step of `h` seconds.
  void drive(Shaft& rotor, double h) {
    if (pulses_)
      pulses_->drive(rotor, h);
    else
      amplifier_.drive(rotor, h);
  }
  /// Outputs after the step.
  void sense(const Shaft& rotor) {
    if (pulses_) pulses_->sense(rotor);
  }

  [[nodiscard]] ServoDrive& amplifier() { return amplifier_; }
  [[nodiscard]] const ServoDrive& amplifier() const { return amplifier_; }
  [[nodiscard]] const std::optional<PulseServo>& pulses() const { return pulses_; }  ///< where it takes them

  /// For Plant::drives(), with what it turns, seen at the motor [kg m2].
  [[nodiscard]] std::vector<DriveOfPlant> drives(double load_inertia, const Efficiency& through) {
    return {{.name = "servo",
             .stage = &amplifier_.power(),
             .load_inertia = load_inertia,
             .efficiency = through.driving,
             .cogging = amplifier_.data().cogging,
             .torque_ripple = amplifier_.data().torque_ripple}};
  }

  // What it adds to a plant's lists.
  void offer_ports(std::vector<Port>& ports);
  void offer_channels(std::vector<Channel>& channels) const;
  void offer_settings(std::vector<Setting>& settings) { amplifier_.offer_settings(settings); }
  void offer_faults(std::vector<Fault>& faults);
  static void offer_events(std::vector<EventType>& types);
  [[nodiscard]] bool has_events() const {
    return amplifier_.power().has_events() || (pulses_ && pulses_->just_tripped());
  }
  /// What happened to it since it was asked last.
  [[nodiscard]] std::vector<MachineEvent> take_events(const Shaft& rotor);

  /// Between two steps, as its events have been taken.
  void visit(StateArchive& archive);

 private:
  ServoDrive amplifier_;
  std::optional<PulseServo> pulses_;
};

}  // namespace drycut::plants
