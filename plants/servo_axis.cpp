#include "plants/servo_axis.hpp"

#include "base/state_archive.hpp"
#include "base/units.hpp"
#include "plants/axis_objections.hpp"

namespace drycut::plants {

ServoAxis::ServoAxis(const ServoAxisData& data, const Shaft& rotor, Random noise)
    : amplifier_(data.servo, noise) {
  if (data.kind == "pulses") pulses_.emplace(data.pulses, amplifier_, rotor);
}

std::vector<MachineEvent> ServoAxis::take_events(const Shaft& rotor) {
  std::vector<MachineEvent> events = amplifier_.power().take_events();
  if (pulses_ && pulses_->just_tripped())
    events.push_back({"following_error",
                      1,
                      {{"turns", pulses_->trip_turns(), ""}, {"speed", rotor.speed * units::rpm, "rpm"}}});
  return events;
}

void ServoAxis::offer_events(std::vector<EventType>& types) {
  types.push_back({"following_error",
                   {{"turns", ""}, {"speed", "rpm"}},
                   "the drive's position loop has tripped: its deviation in turns of the motor, speed of the "
                   "motor; the motor coasts until reset",
                   Severity::error});
  PowerStage::offer_events(types);
}

void ServoAxis::offer_ports(std::vector<Port>& ports) {
  ports.push_back(
      {"servo.enable", &amplifier_.enable, "enable of the amplifier; strapped high unless wired"});
  amplifier_.power().offer_ports(ports, "servo");
  if (!pulses_) {
    ports.push_back({"servo.reference", &amplifier_.reference, "speed reference, +-10 V"});
    return;
  }
  ports.push_back({"servo.pulses", &pulses_->pulses, "pulse train: position reference"});
  ports.push_back({"servo.direction", &pulses_->direction, "direction of the pulses, on = forward"});
  ports.push_back({"servo.reset", &pulses_->reset, "its rising edge clears the alarm"});
  ports.push_back({"servo.in_position", &pulses_->in_position, "on while the deviation is within its range"});
  ports.push_back({"servo.alarm", &pulses_->alarm, "on after a trip by following error, until reset"});
}

void ServoAxis::offer_channels(std::vector<Channel>& channels) const {
  channels.push_back({"motor.torque", "N m", [this] { return amplifier_.torque(); }, "torque of the motor"});
  channels.push_back({"motor.utilisation", "%", [this] { return amplifier_.utilisation() * 100; },
                      "motor torque over rated torque"});
  if (pulses_) {
    channels.push_back({"servo.reference", "", [this] { return pulses_->reference(); },
                        "position reference: net pulses since the start"});
    channels.push_back({"servo.deviation", "", [this] { return pulses_->deviation(); },
                        "position reference less motor position, in pulses"});
    channels.push_back({"servo.in_position", "", [this] { return pulses_->in_position.level ? 1.0 : 0.0; },
                        "1 while the deviation is within its range"});
    channels.push_back({"servo.alarm", "", [this] { return pulses_->alarm.level ? 1.0 : 0.0; },
                        "1 after a trip by following error"});
  } else {
    channels.push_back({"servo.reference", "V", [this] { return amplifier_.volts(); },
                        "speed reference as the amplifier reads it"});
  }
  channels.push_back(
      {"servo.set_speed", "rpm", [this] { return amplifier_.speed_reference() * units::rpm; },
       pulses_ ? "speed that the position loop asks for" : "speed reference after offset, drift and filter"});
  channels.push_back({"servo.asked", "N m", [this] { return amplifier_.asked(); },
                      "torque that the speed loop asks for, before test signal and limit"});
  channels.push_back({"servo.saturated", "", [this] { return amplifier_.saturated() ? 1.0 : 0.0; },
                      "1 while the torque limit acts"});
  amplifier_.power().offer_channels(channels);
}

void ServoAxis::offer_faults(std::vector<Fault>& faults) {
  if (!pulses_) {
    amplifier_.offer_faults(faults, "servo");
    return;
  }
  amplifier_.offer_power_faults(faults, "servo");
  pulses_->offer_faults(faults, "servo");
}

void ServoAxis::visit(StateArchive& archive) {
  STATE(archive, amplifier_);
  if (pulses_) archive.named("pulses_", *pulses_);
}

Parameters servo_axis_parameters(ServoAxisData& data, const ServoSources& from) {
  return joined({row("drive",
                     "what the servo follows: servo = a speed reference by voltage; pulses = a "
                     "pulse train, with plugs servo.pulses, servo.direction (on = forward), "
                     "servo.reset, servo.in_position, servo.alarm",
                     data.kind, {"servo", "pulses"}, "positioning by voltage"),
                 model_row("servo.model", data.servo_model)},
                group("servo.", servo_parameters(data.servo, from)),
                group("servo.pulses.", pulse_servo_parameters(data.pulses)));
}

std::vector<PlantDefinition::Objection> servo_axis_objections(const ServoAxisData& data, double inertia,
                                                              double h) {
  AxisObjections found("servo", h);
  found.add(servo_objections(data.servo, inertia, h));
  if (data.kind == "pulses")
    found.damper("servo.pulses.position_gain", data.pulses.position_gain, 1, "reference and position loop");
  return found.take();
}

}  // namespace drycut::plants
