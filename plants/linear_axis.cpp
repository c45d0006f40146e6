#include "plants/linear_axis.hpp"

#include <cmath>

#include "base/state_archive.hpp"
#include "base/units.hpp"

namespace drycut::plants {

namespace {

LinearAxisData on_its_slope(LinearAxisData data) {
  data.guide_weight = std::cos(data.inclination);
  return data;
}

}  // namespace

LinearAxis::LinearAxis(const LinearAxisData& data, World& world, const LinearAxis* carrier,
                       LinearAxis* lender)
    : data_(on_its_slope(data)),
      world_(world),
      carrier_(carrier),
      screw_(data_, "linear axis", data.drive.rotor_inertia(),
             {.name = "linear axis carriage",
              .mass = data.mass,
              .axis = {std::cos(data.inclination) * std::cos(data.heading), std::sin(data.inclination),
                       -std::cos(data.inclination) * std::sin(data.heading)},
              .gravity = true},
             world),
      drive_(data.drive, world, "linear axis") {
  if (lender != nullptr) lender->drive_.lend_to(drive_, rotor());
}

void LinearAxis::drive(double h) {
  drive_.drive(rotor(), h);
  screw_.transmit();
  carriage().add_force(outer_force_);
  screw_.push_back(h);
  const double brake = drive_.brake_torque();
  screw_.rub(h, {brake, brake}, -data_.mass * units::gravity * std::sin(data_.inclination));
}

void LinearAxis::sense(double h) {
  tell_motor_load(h);
  screw_.sense(h);
  for (EndStop& stop : screw_.stops)
    if (stop.stopped(carriage())) happened(stop.hit("end_stop"));
  happened_to(drive_, rotor());
  if (tool_.level && data_.tool == "pen") draw_ink();
}

void LinearAxis::visit(StateArchive& archive) { STATE(archive, screw_, drive_, outer_force_, tool_, ink_); }

Parameters LinearAxis::live_parameters() { return live_rows(linear_axis_parameters(data_)); }

void LinearAxis::parameters_changed() { screw_.take(data_, data_.mass, world_); }

std::vector<Port> LinearAxis::ports() {
  std::vector<Port> ports;
  screw_.sensors.offer_ports(ports);
  drive_.offer_ports(ports);
  ports.push_back({"tool", &tool_, "tool down; shown and recorded, it does not act on anything"});
  return ports;
}

std::optional<PlugScale> LinearAxis::scale_of(std::string_view port) const {
  const double turns_a_metre = data_.gear.ratio / data_.lead;  // of the motor
  if (port == "encoder") return PlugScale{4 * data_.sensors.encoder.lines * turns_a_metre, false};
  if (port == "scale") return PlugScale{1 / data_.sensors.scale_resolution, false};
  if (port == "servo.reference")
    return PlugScale{data_.drive.servo.speed_at_10v / (units::turn * turns_a_metre), false};
  return {};
}

std::vector<Channel> LinearAxis::channels() {
  std::vector<Channel> channels = {
      {"position", "mm", [this] { return carriage().position * units::millimetres; },
       "position of the carriage"},
      {"speed", "mm/s", [this] { return carriage().speed * units::millimetres; }, "speed of the carriage"},
      {"motor.position", "mm", [this] { return (carriage().position + screw_.ahead()) * units::millimetres; },
       "where the motor would have the carriage without play and twist"},
      {"motor.speed", "rpm", [this] { return rotor().speed * units::rpm; }, "speed of the motor"},
  };
  drive_.offer_channels(channels);
  channels.insert(
      channels.end(),
      {{"gear.force", "N", [this] { return screw_.force(); }, "force of screw or belt on the carriage"},
       {"gear.ahead", "mm", [this] { return screw_.ahead() * units::millimetres; },
        "motor.position less position: play and twist taken up"},
       {"gear.twist", "deg", [this] { return twist() * units::degrees; },
        "turn of the screw or pulley ahead of the carriage"},
       {"stop.force", "N", [this] { return screw_.stop_force(); },
        "force of the end stops on the carriage"}});
  screw_.sensors.offer_channels(channels);
  channels.push_back(on_off("tool", tool_.level, "1 while the tool is down"));
  return channels;
}

std::vector<Setting> LinearAxis::settings() {
  std::vector<Setting> settings = {{"force",
                                    "N",
                                    [this](double v) { outer_force_ = v; },
                                    [this] { return outer_force_; },
                                    "force of the process on the carriage, positive in positive direction",
                                    {-1e6, 1e6, false}}};
  drive_.offer_settings(settings);
  return settings;
}

std::vector<DriveOfPlant> LinearAxis::drives() {
  return drive_.drives(load_inertia(data_), efficiency(data_));
}

MotorLoad LinearAxis::motor_load(double h) const {
  return screw_.motor_load(drive_.torque(), -data_.mass * units::gravity * std::sin(data_.inclination), h);
}

std::vector<EventType> LinearAxis::event_types() {
  std::vector<EventType> types = {
      {"end_stop",
       {{"side", ""}, {"speed", "mm/s"}, {"impulse", "N s"}, {"force", "N"}},
       "an end stop has stopped the carriage: side -1 lower or 1 upper, speed when it touched, impulse "
       "taken until it stood, largest force",
       Severity::error}};
  AxisDrive::offer_events(types);
  return types;
}

std::vector<Fault> LinearAxis::faults() {
  std::vector<Fault> faults;
  drive_.offer_faults(faults);
  screw_.sensors.offer_faults(faults);
  return faults;
}

}  // namespace drycut::plants
