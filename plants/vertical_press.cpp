#include "plants/vertical_press.hpp"

#include <cmath>

#include "base/units.hpp"

namespace drycut::plants {

namespace {

constexpr double standard_gravity = 9.80665;  // [m/s2]
constexpr double sag_after = 0.5;             // [s]: by then every sound brake has stopped the ram
constexpr double sag_speed = 1e-3;            // [m/s]

// The twist with which the screw carries the ram at rest, so that a run begins without a fall.
double carrying_twist(const VerticalPressData& data) {
  const double force = (data.mass + data.load) * standard_gravity - data.counterbalance;
  const double twist = force * data.lead / units::turn / data.gear.stiffness;
  return twist + std::copysign(data.gear.backlash / 2, twist);
}

}  // namespace

VerticalPressData::VerticalPressData() {
  gear = {1, 250, 0.1, 0};
  drive.kind = "inverter";
  drive.brake.torque = 25;
  sensors.scale_resolution = 5e-6;
  sensors.home = {0.5, 0.04, 0.5e-3, 0.5e-3};
  sensors.limit_min = 0;
  sensors.limit_max = 0.6;
}

VerticalPress::VerticalPress(const VerticalPressData& data, World& world)
    : data_(data),
      world_(world),
      screw_per_metre_(units::turn / data.lead),
      rotor_(world.add_shaft(
          {.name = "press motor",
           .inertia = data.drive.rotor_inertia() + data.screw_inertia / (data.gear.ratio * data.gear.ratio),
           .revolutions = data.start / data.lead * data.gear.ratio})),
      ram_(world.add_slide({.name = "press ram",
                            .mass = data.mass + data.load,
                            .axis = {0, 1, 0},
                            .position = data.start,
                            .gravity = true})),
      drive_(data.drive, world.random("press servo")),
      twist_(carrying_twist(data)),
      stop_min_(data.stop, data.travel_min, -1),
      stop_max_(data.stop, data.travel_max, 1),
      workpiece_(data.workpiece, data.workpiece_height, -1),
      sensors_(data.sensors, data.start, rotor_.revolutions(), world.random("press encoder"),
               world.random("press scale")) {}

// Against a motion that the motor must drive the screw rubs with (1/efficiency - 1) of its torque, against
// one that its load drives with (1 - back_efficiency) of it: less than the load itself unless self-locking.
DryResistance VerticalPress::losses(double torque) const {
  const double driving = std::abs(torque) * (1 / data_.efficiency - 1);
  const double driven = std::abs(torque) * (1 - data_.back_efficiency);
  return torque > 0 ? DryResistance{driving, driven} : DryResistance{driven, driving};
}

void VerticalPress::drive(double h) {
  drive_.drive(rotor_, h);
  const double rate = rotor_.speed / data_.gear.ratio - ram_.speed * screw_per_metre_;
  const double torque = transmission_torque(data_.gear, twist_, rate);
  screw_force_ = torque * screw_per_metre_;
  rotor_.add_torque(-torque / data_.gear.ratio);
  ram_.add_force(screw_force_ + data_.counterbalance + outer_force_);
  stop_min_.drive(ram_, h);
  stop_max_.drive(ram_, h);
  if (data_.workpiece.stiffness > 0) workpiece_.drive(ram_, h);
  // Dry friction last: it answers to all other efforts, and so to the weight that the world adds.
  DryResistance dry = losses(torque / data_.gear.ratio);
  dry.forward += drive_.brake_torque();
  dry.backward += drive_.brake_torque();
  rotor_.add_torque(
      friction_effort(data_.motor_friction, rotor_.speed, rotor_.torque, rotor_.inertia, h, dry));
  const double weight = -ram_.mass * standard_gravity;
  ram_.add_force(friction_effort(data_.ram_friction, ram_.speed, ram_.force + weight, ram_.mass, h));
}

void VerticalPress::sense(double h) {
  // Summed up from the speeds, as Transmission does: a difference of two long ways would lose its digits.
  twist_ += (rotor_.speed / data_.gear.ratio - ram_.speed * screw_per_metre_) * h;
  sensors_.sense(rotor_, ram_, h);
  report_contacts();
  watch_for_sag(h);
  if (drive_.just_tripped()) happened({"trip", 0, {{"speed", rotor_.speed_before * units::rpm, "rpm"}}});
}

void VerticalPress::report_contacts() {
  const auto report = [this](EndStop& stop, std::string_view name, double side) {
    if (!stop.stopped(ram_)) return;
    std::vector<Event::Value> values;
    if (side != 0) values.push_back({"side", side, ""});
    values.push_back({"speed", stop.hit_speed() * units::millimetres, "mm/s"});
    values.push_back({"impulse", stop.impulse(), "N s"});
    values.push_back({"force", stop.peak(), "N"});
    happened({name, stop.fraction(), std::move(values)});
  };
  report(stop_min_, "end_stop", -1);
  report(stop_max_, "end_stop", 1);
  if (data_.workpiece.stiffness > 0) report(workpiece_, "pressed", 0);
}

void VerticalPress::watch_for_sag(double h) {
  if (!drive_.at_rest()) {
    resting_ = 0;
    sagged_ = false;
    return;
  }
  resting_ += h;
  if (sagged_ || resting_ < sag_after || ram_.speed > -sag_speed) return;
  sagged_ = true;
  happened({"sag",
            1,
            {{"speed", ram_.speed * units::millimetres, "mm/s"},
             {"position", ram_.position * units::millimetres, "mm"}}});
}

std::vector<Port> VerticalPress::ports() {
  std::vector<Port> ports;
  sensors_.offer_ports(ports);
  drive_.offer_ports(ports);
  return ports;
}

std::vector<Channel> VerticalPress::channels() {
  std::vector<Channel> channels = {
      {"position", "mm", [this] { return ram_.position * units::millimetres; },
       "height of the tool over the table"},
      {"speed", "mm/s", [this] { return ram_.speed * units::millimetres; },
       "speed of the ram, positive upwards"},
      {"motor.position", "mm",
       [this] { return (ram_.position + twist_ / screw_per_metre_) * units::millimetres; },
       "where the motor would have the ram without play and twist"},
      {"motor.speed", "rpm", [this] { return rotor_.speed * units::rpm; }, "speed of the motor"},
  };
  drive_.offer_channels(channels);
  channels.insert(channels.end(),
                  {{"mass", "kg", [this] { return ram_.mass; }, "of the ram with its load"},
                   {"screw.force", "N", [this] { return screw_force_; },
                    "force of the screw on the ram, positive upwards"},
                   {"press.force", "N", [this] { return workpiece_.force(); }, "of the ram on the workpiece"},
                   {"stop.force", "N", [this] { return stop_min_.force() + stop_max_.force(); },
                    "force of the end stops on the ram"}});
  sensors_.offer_channels(channels);
  return channels;
}

std::vector<Setting> VerticalPress::settings() {
  return {{"load",
           "kg",
           [this](double v) { world_.set_mass(ram_, data_.mass + v); },
           [this] { return ram_.mass - data_.mass; },
           "what the ram carries besides itself",
           {0, 1e6, false}},
          {"force",
           "N",
           [this](double v) { outer_force_ = v; },
           [this] { return outer_force_; },
           "force of the process on the ram, positive upwards",
           {-1e7, 1e7, false}}};
}

std::vector<EventType> VerticalPress::event_types() {
  return {{"end_stop",
           {{"side", ""}, {"speed", "mm/s"}, {"impulse", "N s"}, {"force", "N"}},
           "an end stop has stopped the ram: side -1 lower or 1 upper, speed when it touched, impulse taken "
           "until it stood, largest force"},
          {"pressed",
           {{"speed", "mm/s"}, {"impulse", "N s"}, {"force", "N"}},
           "the workpiece has stopped the ram: speed when it touched, impulse taken until it stood, largest "
           "force"},
          {"sag",
           {{"speed", "mm/s"}, {"position", "mm"}},
           "the ram goes down 0.5 s after drive and brake were told to hold it: once each time"},
          AxisDrive::trip_event()};
}

std::vector<Fault> VerticalPress::faults() {
  std::vector<Fault> faults;
  drive_.offer_faults(faults);
  sensors_.offer_faults(faults);
  return faults;
}

}  // namespace drycut::plants
