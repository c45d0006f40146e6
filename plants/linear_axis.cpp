#include "plants/linear_axis.hpp"

#include <cmath>

namespace drycut::plants {

namespace {

constexpr double turn = 2 * std::numbers::pi;
constexpr double rpm = 60 / turn;  // rad/s -> rpm
constexpr double degrees = 360 / turn;
constexpr double millimetres = 1000;
constexpr double standard_gravity = 9.80665;  // [m/s2]
constexpr double beyond = 1000;               // width of a limit switch's target: longer than any axis [m]

PositionSwitchData limit_switch(double edge, double side, double delay) {
  return {edge + side * beyond / 2, beyond, 0.5e-3, delay};
}

}  // namespace

LinearAxis::LinearAxis(const LinearAxisData& data, World& world, const LinearAxis* carrier)
    : data_(data),
      carrier_(carrier),
      screw_per_metre_(turn / data.lead),
      rotor_(world.add_shaft(
          {.name = "linear axis motor",
           .inertia = data.servo.rotor_inertia + data.screw_inertia / (data.gear.ratio * data.gear.ratio),
           .revolutions = data.start / data.lead * data.gear.ratio})),
      carriage_(world.add_slide(
          {.name = "linear axis carriage",
           .mass = data.mass,
           .axis = {std::cos(data.inclination) * std::cos(data.heading), std::sin(data.inclination),
                    -std::cos(data.inclination) * std::sin(data.heading)},
           .position = data.start,
           .gravity = true})),
      servo_(data.servo, world.random("linear axis servo")),
      stop_min_(data.stop, data.travel_min, -1),
      stop_max_(data.stop, data.travel_max, 1),
      encoder_(data.encoder, rotor_.revolutions(), world.random("linear axis encoder")),
      scale_(world.random("linear axis scale")),
      home_(data.home, 0, data.start),
      limit_min_(limit_switch(data.limit_min, -1, data.limit_delay), 0, data.start),
      limit_max_(limit_switch(data.limit_max, 1, data.limit_delay), 0, data.start) {}

void LinearAxis::drive(double h) {
  servo_.drive(rotor_, h);
  const double rate = rotor_.speed / data_.gear.ratio - carriage_.speed * screw_per_metre_;
  const double torque = transmission_torque(data_.gear, twist_, rate);
  drive_force_ = torque * screw_per_metre_;
  rotor_.add_torque(-torque / data_.gear.ratio);
  carriage_.add_force(drive_force_ + outer_force_);
  stop_min_.drive(carriage_, h);
  stop_max_.drive(carriage_, h);
  // Dry friction last: it answers to all other efforts, and so to the weight that the world adds.
  rotor_.add_torque(friction_effort(data_.motor_friction, rotor_.speed, rotor_.torque, rotor_.inertia, h));
  const double weight = -data_.mass * standard_gravity * std::sin(data_.inclination);
  carriage_.add_force(
      friction_effort(data_.carriage_friction, carriage_.speed, carriage_.force + weight, carriage_.mass, h));
}

void LinearAxis::sense(double h) {
  // Summed up from the speeds, as Transmission does: a difference of two long ways would lose its digits.
  twist_ += (rotor_.speed / data_.gear.ratio - carriage_.speed * screw_per_metre_) * h;
  encoder_.sense(rotor_);

  const double before = (carriage_.position_before - data_.start) / data_.scale_resolution;
  const double now = (carriage_.position - data_.start) / data_.scale_resolution;
  scale_.carry(before, now);
  scale_index_.edge_count = 0;
  if (before != now && !scale_.stuck())
    put_index(scale_index_, carriage_.position_before / data_.scale_pitch,
              carriage_.position / data_.scale_pitch, before, now,
              data_.scale_pitch / data_.scale_resolution);

  for (PositionSwitch* s : {&home_, &limit_min_, &limit_max_})
    s->sense(carriage_.position_before, carriage_.position, h);
  if (stop_min_.stopped(carriage_)) report(stop_min_, -1);
  if (stop_max_.stopped(carriage_)) report(stop_max_, 1);
  if (tool_.level && data_.tool == "pen") draw_ink();
}

void LinearAxis::report(const EndStop& stop, double side) {
  happened({"end_stop",
            stop.fraction(),
            {{"side", side, ""},
             {"speed", stop.hit_speed() * millimetres, "mm/s"},
             {"impulse", stop.impulse(), "N s"},
             {"force", stop.peak(), "N"}}});
}

std::vector<Port> LinearAxis::ports() {
  return {{"encoder", &encoder_.pulses.port, "encoder on the motor"},
          {"encoder.index", &encoder_.index, "its index pulse, once a turn of the motor"},
          {"scale", &scale_.port, "linear scale on the carriage"},
          {"scale.index", &scale_index_, "its reference marks"},
          {"servo.reference", &servo_.reference, "speed reference, +-10 V"},
          {"servo.enable", &servo_.enable, "enable of the amplifier; strapped high unless wired"},
          {"home", &home_.port, "home switch"},
          {"limit_min", &limit_min_.port, "limit switch at the lower end, on beyond it"},
          {"limit_max", &limit_max_.port, "limit switch at the upper end, on beyond it"},
          {"tool", &tool_, "tool down; shown and recorded, it does not act on anything"}};
}

std::vector<Channel> LinearAxis::channels() {
  return {
      {"position", "mm", [this] { return carriage_.position * millimetres; }, "position of the carriage"},
      {"speed", "mm/s", [this] { return carriage_.speed * millimetres; }, "speed of the carriage"},
      {"motor.position", "mm",
       [this] { return (carriage_.position + twist_ / screw_per_metre_) * millimetres; },
       "where the motor would have the carriage without play and twist"},
      {"motor.speed", "rpm", [this] { return rotor_.speed * rpm; }, "speed of the motor"},
      {"motor.torque", "N m", [this] { return servo_.torque(); }, "torque of the motor"},
      {"motor.utilisation", "%", [this] { return servo_.utilisation() * 100; },
       "motor torque over rated torque"},
      {"servo.reference", "V", [this] { return servo_.volts(); },
       "speed reference as the amplifier reads it"},
      {"servo.set_speed", "rpm", [this] { return servo_.speed_reference() * rpm; },
       "speed reference after offset, drift and filter"},
      {"servo.saturated", "", [this] { return servo_.saturated() ? 1.0 : 0.0; },
       "1 while the torque limit acts"},
      {"gear.force", "N", [this] { return drive_force_; }, "force of screw or belt on the carriage"},
      {"gear.ahead", "mm", [this] { return twist_ / screw_per_metre_ * millimetres; },
       "motor.position less position: play and twist taken up"},
      {"gear.twist", "deg", [this] { return twist_ * degrees; },
       "turn of the screw or pulley ahead of the carriage"},
      {"stop.force", "N", [this] { return stop_min_.force() + stop_max_.force(); },
       "force of the end stops on the carriage"},
      {"encoder.count", "", [this] { return static_cast<double>(encoder_.pulses.port.count); },
       "count of the encoder (x4), after faults"},
      {"scale.count", "", [this] { return static_cast<double>(scale_.port.count); },
       "count of the linear scale (x4), after faults"},
      {"home", "", [this] { return home_.port.level ? 1.0 : 0.0; }, "home switch"},
      {"limit_min", "", [this] { return limit_min_.port.level ? 1.0 : 0.0; }, "lower limit switch"},
      {"limit_max", "", [this] { return limit_max_.port.level ? 1.0 : 0.0; }, "upper limit switch"},
      {"tool", "", [this] { return tool_.level ? 1.0 : 0.0; }, "1 while the tool is down"},
  };
}

std::vector<Setting> LinearAxis::settings() {
  return {{"force", "N", [this](double v) { outer_force_ = v; }, [this] { return outer_force_; },
           "force of the process on the carriage, positive in positive direction"}};
}

std::vector<EventType> LinearAxis::event_types() {
  return {{"end_stop",
           {{"side", ""}, {"speed", "mm/s"}, {"impulse", "N s"}, {"force", "N"}},
           "an end stop has stopped the carriage: side -1 lower or 1 upper, speed when it touched, impulse "
           "taken until it stood, largest force"}};
}

std::vector<Fault> LinearAxis::faults() {
  std::vector<Fault> faults;
  servo_.offer_faults(faults, "servo");
  encoder_.pulses.offer_faults(faults, "encoder");
  scale_.offer_faults(faults, "scale");
  home_.offer_faults(faults, "home");
  limit_min_.offer_faults(faults, "limit_min");
  limit_max_.offer_faults(faults, "limit_max");
  return faults;
}

}  // namespace drycut::plants
