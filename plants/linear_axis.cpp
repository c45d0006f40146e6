#include "plants/linear_axis.hpp"

#include <cmath>

#include "base/units.hpp"

namespace drycut::plants {

namespace {

constexpr double standard_gravity = 9.80665;  // [m/s2]

}  // namespace

LinearAxis::LinearAxis(const LinearAxisData& data, World& world, const LinearAxis* carrier)
    : data_(data),
      carrier_(carrier),
      screw_per_metre_(units::turn / data.lead),
      rotor_(world.add_shaft(
          {.name = "linear axis motor",
           .inertia = data.drive.rotor_inertia() + data.screw_inertia / (data.gear.ratio * data.gear.ratio),
           .revolutions = data.start / data.lead * data.gear.ratio})),
      carriage_(world.add_slide(
          {.name = "linear axis carriage",
           .mass = data.mass,
           .axis = {std::cos(data.inclination) * std::cos(data.heading), std::sin(data.inclination),
                    -std::cos(data.inclination) * std::sin(data.heading)},
           .position = data.start,
           .gravity = true})),
      drive_(data.drive, world.random("linear axis servo")),
      stop_min_(data.stop, data.travel_min, -1),
      stop_max_(data.stop, data.travel_max, 1),
      sensors_(data.sensors, data.start, rotor_.revolutions(), world.random("linear axis encoder"),
               world.random("linear axis scale")) {}

void LinearAxis::drive(double h) {
  drive_.drive(rotor_, h);
  const double rate = rotor_.speed / data_.gear.ratio - carriage_.speed * screw_per_metre_;
  const double torque = transmission_torque(data_.gear, twist_, rate);
  drive_force_ = torque * screw_per_metre_;
  rotor_.add_torque(-torque / data_.gear.ratio);
  carriage_.add_force(drive_force_ + outer_force_);
  stop_min_.drive(carriage_, h);
  stop_max_.drive(carriage_, h);
  // Dry friction last: it answers to all other efforts, and so to the weight that the world adds.
  const double brake = drive_.brake_torque();
  rotor_.add_torque(
      friction_effort(data_.motor_friction, rotor_.speed, rotor_.torque, rotor_.inertia, h, {brake, brake}));
  const double weight = -data_.mass * standard_gravity * std::sin(data_.inclination);
  carriage_.add_force(
      friction_effort(data_.carriage_friction, carriage_.speed, carriage_.force + weight, carriage_.mass, h));
}

void LinearAxis::sense(double h) {
  // Summed up from the speeds, as Transmission does: a difference of two long ways would lose its digits.
  twist_ += (rotor_.speed / data_.gear.ratio - carriage_.speed * screw_per_metre_) * h;
  sensors_.sense(rotor_, carriage_, h);
  if (stop_min_.stopped(carriage_)) report(stop_min_, -1);
  if (stop_max_.stopped(carriage_)) report(stop_max_, 1);
  if (drive_.just_tripped()) happened({"trip", 0, {{"speed", rotor_.speed_before * units::rpm, "rpm"}}});
  if (tool_.level && data_.tool == "pen") draw_ink();
}

void LinearAxis::report(const EndStop& stop, double side) {
  happened({"end_stop",
            stop.fraction(),
            {{"side", side, ""},
             {"speed", stop.hit_speed() * units::millimetres, "mm/s"},
             {"impulse", stop.impulse(), "N s"},
             {"force", stop.peak(), "N"}}});
}

std::vector<Port> LinearAxis::ports() {
  std::vector<Port> ports;
  sensors_.offer_ports(ports);
  drive_.offer_ports(ports);
  ports.push_back({"tool", &tool_, "tool down; shown and recorded, it does not act on anything"});
  return ports;
}

std::vector<Channel> LinearAxis::channels() {
  std::vector<Channel> channels = {
      {"position", "mm", [this] { return carriage_.position * units::millimetres; },
       "position of the carriage"},
      {"speed", "mm/s", [this] { return carriage_.speed * units::millimetres; }, "speed of the carriage"},
      {"motor.position", "mm",
       [this] { return (carriage_.position + twist_ / screw_per_metre_) * units::millimetres; },
       "where the motor would have the carriage without play and twist"},
      {"motor.speed", "rpm", [this] { return rotor_.speed * units::rpm; }, "speed of the motor"},
  };
  drive_.offer_channels(channels);
  channels.insert(
      channels.end(),
      {{"gear.force", "N", [this] { return drive_force_; }, "force of screw or belt on the carriage"},
       {"gear.ahead", "mm", [this] { return twist_ / screw_per_metre_ * units::millimetres; },
        "motor.position less position: play and twist taken up"},
       {"gear.twist", "deg", [this] { return twist_ * units::degrees; },
        "turn of the screw or pulley ahead of the carriage"},
       {"stop.force", "N", [this] { return stop_min_.force() + stop_max_.force(); },
        "force of the end stops on the carriage"}});
  sensors_.offer_channels(channels);
  channels.push_back({"tool", "", [this] { return tool_.level ? 1.0 : 0.0; }, "1 while the tool is down"});
  return channels;
}

std::vector<Setting> LinearAxis::settings() {
  return {{"force",
           "N",
           [this](double v) { outer_force_ = v; },
           [this] { return outer_force_; },
           "force of the process on the carriage, positive in positive direction",
           {-1e6, 1e6, false}}};
}

std::vector<EventType> LinearAxis::event_types() {
  return {{"end_stop",
           {{"side", ""}, {"speed", "mm/s"}, {"impulse", "N s"}, {"force", "N"}},
           "an end stop has stopped the carriage: side -1 lower or 1 upper, speed when it touched, impulse "
           "taken until it stood, largest force"},
          AxisDrive::trip_event()};
}

std::vector<Fault> LinearAxis::faults() {
  std::vector<Fault> faults;
  drive_.offer_faults(faults);
  sensors_.offer_faults(faults);
  return faults;
}

}  // namespace drycut::plants
