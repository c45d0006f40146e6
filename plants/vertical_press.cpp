#include "plants/vertical_press.hpp"

#include <cmath>

#include "base/state_archive.hpp"
#include "base/units.hpp"

namespace drycut::plants {

namespace {

constexpr double sag_after = 0.5;   // [s]: by then every sound brake has stopped the ram
constexpr double sag_speed = 1e-3;  // [m/s]

// With this force the screw carries the ram at rest, so that a run begins without a fall.
double carried(const VerticalPressData& data) {
  return (data.mass + data.load) * units::gravity - data.counterbalance;
}

}  // namespace

VerticalPress::VerticalPress(const VerticalPressData& data, World& world)
    : data_(data),
      world_(world),
      screw_(data, "press", data.drive.rotor_inertia(),
             {.name = "press ram", .mass = data.mass + data.load, .axis = {0, 1, 0}, .gravity = true}, world,
             carried(data)),
      drive_(data.drive, world, "press"),
      workpiece_(data.workpiece, data.workpiece_height, -1) {}

void VerticalPress::drive(double h) {
  drive_.drive(rotor(), h);
  screw_.transmit();
  ram().add_force(data_.counterbalance);
  ram().add_force(outer_force_);
  screw_.push_back(h);
  if (data_.workpiece.stiffness > 0) workpiece_.drive(ram(), h);
  const double brake = drive_.brake_torque();
  screw_.rub(h, {brake, brake}, -screw_.mass() * units::gravity);
}

void VerticalPress::sense(double h) {
  tell_motor_load(h);
  screw_.sense(h);
  report_contacts();
  watch_for_sag(h);
  happened_to(drive_, rotor());
}

void VerticalPress::report_contacts() {
  for (EndStop& stop : screw_.stops)
    if (stop.stopped(ram())) happened(stop.hit("end_stop"));
  if (data_.workpiece.stiffness <= 0 || !workpiece_.stopped(ram())) return;
  MachineEvent pressed = workpiece_.hit("pressed");
  pressed.values.erase(pressed.values.begin());  // it has no side
  happened(std::move(pressed));
}

void VerticalPress::watch_for_sag(double h) {
  if (!drive_.at_rest()) {
    resting_ = 0;
    sagged_ = false;
    return;
  }
  resting_ += h;
  // By the motor: a ram that is loaded while it rests gives way on its screw, and swings.
  const double let_down = rotor().speed / data_.gear.ratio * data_.lead / units::turn;
  if (sagged_ || resting_ < sag_after || let_down > -sag_speed) return;
  sagged_ = true;
  happened({"sag",
            1,
            {{"speed", let_down * units::millimetres, "mm/s"},
             {"position", ram().position * units::millimetres, "mm"}}});
}

std::vector<Port> VerticalPress::ports() {
  std::vector<Port> ports;
  screw_.sensors.offer_ports(ports);
  drive_.offer_ports(ports);
  return ports;
}

std::vector<Channel> VerticalPress::channels() {
  std::vector<Channel> channels = {
      {"position", "mm", [this] { return ram().position * units::millimetres; },
       "height of the tool over the table"},
      {"speed", "mm/s", [this] { return ram().speed * units::millimetres; },
       "speed of the ram, positive upwards"},
      {"motor.position", "mm", [this] { return (ram().position + screw_.ahead()) * units::millimetres; },
       "where the motor would have the ram without play and twist"},
      {"motor.speed", "rpm", [this] { return rotor().speed * units::rpm; }, "speed of the motor"},
  };
  drive_.offer_channels(channels);
  channels.insert(
      channels.end(),
      {{"mass", "kg", [this] { return screw_.mass(); }, "of the ram with its load"},
       {"screw.force", "N", [this] { return screw_.force(); },
        "force of the screw on the ram, positive upwards"},
       {"press.force", "N", [this] { return workpiece_.force(); }, "of the ram on the workpiece"},
       {"stop.force", "N", [this] { return screw_.stop_force(); }, "force of the end stops on the ram"}});
  screw_.sensors.offer_channels(channels);
  return channels;
}

std::vector<Setting> VerticalPress::settings() {
  std::vector<Setting> settings = {{"load",
                                    "kg",
                                    [this](double v) {
                                      data_.load = v;
                                      parameters_changed();
                                    },
                                    [this] { return data_.load; },
                                    "what the ram carries besides itself",
                                    {0, 1e6, false}},
                                   {"force",
                                    "N",
                                    [this](double v) { outer_force_ = v; },
                                    [this] { return outer_force_; },
                                    "force of the process on the ram, positive upwards",
                                    {-1e7, 1e7, false}}};
  drive_.offer_settings(settings);
  return settings;
}

std::vector<DriveOfPlant> VerticalPress::drives() {
  return drive_.drives(load_inertia(data_), efficiency(data_));
}

MotorLoad VerticalPress::motor_load(double h) const {
  return screw_.motor_load(drive_.torque(), data_.counterbalance - screw_.mass() * units::gravity, h);
}

void VerticalPress::visit(StateArchive& archive) {
  archive.named("load", data_.load);  // a setting
  STATE(archive, screw_, drive_, outer_force_, workpiece_, resting_, sagged_);
}

Parameters VerticalPress::live_parameters() { return live_rows(vertical_press_parameters(data_)); }

void VerticalPress::parameters_changed() { screw_.take(data_, data_.mass + data_.load, world_); }

std::vector<EventType> VerticalPress::event_types() {
  std::vector<EventType> types = {
      {"end_stop",
       {{"side", ""}, {"speed", "mm/s"}, {"impulse", "N s"}, {"force", "N"}},
       "an end stop has stopped the ram: side -1 lower or 1 upper, speed when it touched, impulse taken "
       "until it stood, largest force",
       Severity::error},
      {"pressed",
       {{"speed", "mm/s"}, {"impulse", "N s"}, {"force", "N"}},
       "the workpiece has stopped the ram: speed when it touched, impulse taken until it stood, largest "
       "force"},
      {"sag",
       {{"speed", "mm/s"}, {"position", "mm"}},
       "the motor lets the ram down 0.5 s after drive and brake were told to hold it: speed by the motor and "
       "place as that is seen, once each time",
       Severity::error}};
  AxisDrive::offer_events(types);
  return types;
}

std::vector<Fault> VerticalPress::faults() {
  std::vector<Fault> faults;
  drive_.offer_faults(faults);
  screw_.sensors.offer_faults(faults);
  return faults;
}

}  // namespace drycut::plants
