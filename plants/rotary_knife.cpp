#include "plants/rotary_knife.hpp"

#include <cmath>

#include "base/state_archive.hpp"
#include "base/units.hpp"
#include "plants/stiff_pair.hpp"

namespace drycut::plants {

namespace {

CutterData cutter_data(const RotaryKnifeData& knife, const WebData& web, double radius) {
  return {.radius = radius,
          .blades = knife.blade_count,
          .eccentricity = knife.drum_eccentricity,
          .helix = knife.helix,
          .counter_blades = knife.counter.cuts(),
          .width = web.width,
          .thickness = web.thickness,
          .peak_force = web.shear_strength * web.thickness * web.width,
          .coupling = knife.coupling,
          .grip = knife.grip,
          .mismatch_limit = knife.mismatch_limit};
}

TransmissionData sprung(const RotaryKnifeData& data) {
  return with_stiffness(data.gear, data.drive.servo.rotor_inertia, data.geared() / data.motors);
}

}  // namespace

RotaryKnife::RotaryKnife(const RotaryKnifeData& data, World& world, Web& web)
    : data_(data),
      world_(world),
      radius_(data.circumference / units::turn),
      along_web_(radius_ * std::cos(data.helix)),
      friction_(geared_friction(data.drum_friction, data.counter)),
      station_(data.station, web, -radius_, radius_),
      rotor_(world.add_shaft({.name = "knife motor",
                              .inertia = data.drive.servo.rotor_inertia,
                              .revolutions = data.initial_angle / units::turn * data.gear.ratio})),
      drum_(world.add_shaft(
          {.name = "knife drum", .inertia = data.geared(), .revolutions = data.initial_angle / units::turn})),
      servo_(data.drive, rotor_, world.random("servo")),
      gear_(sprung(data)),
      sensors_(data.sensors, rotor_, drum_, world.random("encoder")),
      cutter_(cutter_data(data, web.data(), radius_), drum_) {}

void RotaryKnife::drive(double h) {
  servo_.drive(rotor_, h);
  gear_.drive(rotor_, drum_);
  if (data_.motors > 1) drum_.add_torque(gear_.torque() * (data_.motors - 1));
  Slide& material = station_.under(0, drum_.speed * along_web_);
  Cutter::Load load;
  if (!station_.is_empty()) {
    if (station_.is_light()) cutter_.couple(implicit_coupling(material, h));
    load = cutter_.load(drum_, material);
  }
  drum_.add_torque(load.torque);
  material.add_force(load.web_force);
  // Dry friction last: it answers to all other torques.
  rotor_.add_torque(friction_effort(data_.motor_friction, rotor_.speed, rotor_.torque, rotor_.inertia, h,
                                    losses(data_.gear.efficiency, gear_.torque() / data_.gear.ratio)));
  drum_.add_torque(friction_effort(friction_, drum_.speed, drum_.torque, drum_.inertia, h, load.dry));
}

// The coupling whose explicit force is that of the true one at the end of the step.
double RotaryKnife::implicit_coupling(const Slide& material, double h) const {
  return data_.coupling /
         (1 + data_.coupling * h / reduced(drum_.inertia / (radius_ * radius_), material.mass));
}

void RotaryKnife::sense(double h) {
  tell_motor_load(h);
  gear_.sense(rotor_, drum_, h);
  servo_.sense(rotor_);
  happened_to(servo_, rotor_);
  sensors_.sense(rotor_, drum_, h);
  const Cutter::Outcome outcome = cutter_.sense(drum_, station_.under(0, drum_.speed * along_web_), h);
  if (station_.is_empty()) return;
  if (outcome.separated || outcome.tore || outcome.buckled) report(outcome);
}

void RotaryKnife::report(const Cutter::Outcome& outcome) {
  if (outcome.separated) {
    station_.cut(outcome.fraction, outcome.mark);
    last_mismatch_ = outcome.mismatch;
    last_skew_ = outcome.skew;
    ++cuts_;
    MachineEvent cut = {"cut",
                        outcome.fraction,
                        {{"length", station_.length() * units::millimetres, "mm"},
                         {"mismatch", last_mismatch_ * units::millimetres, "mm/s"},
                         {"force", outcome.force, "N"},
                         {"number", static_cast<double>(cuts_), ""}}};
    if (data_.helix > 0) cut.values.push_back({"skew", last_skew_ * units::millimetres, "mm"});
    station_.describe(cut);
    happened(std::move(cut));
    for (MachineEvent& scrap : station_.take_events()) happened(std::move(scrap));
  }
  if (outcome.tore || outcome.buckled)
    happened(
        {outcome.tore ? "tear" : "buckle", 1, {{"mismatch", outcome.excess * units::millimetres, "mm/s"}}});
}

std::vector<Port> RotaryKnife::ports() {
  std::vector<Port> ports;
  sensors_.offer_ports(ports, "incremental encoder of the knife", "home switch on the drum");
  servo_.offer_ports(ports);
  return ports;
}

std::optional<PlugScale> RotaryKnife::scale_of(std::string_view port) const {
  if (port == "encoder") return PlugScale{data_.sensors.counts_per_radian(data_.gear.ratio), true, radius_};
  if (port == "servo.reference") return PlugScale{data_.drive.servo.speed_at_10v / data_.gear.ratio, true};
  return {};
}

std::vector<Channel> RotaryKnife::channels() {
  const auto blade_speed = [this] { return drum_.speed * along_web_; };
  std::vector<Channel> channels = {
      {"angle", "deg", [this] { return drum_.part * 360; },
       "drum angle within a turn, 0 = blade 1 at the cut"},
      {"angle.total", "deg", [this] { return drum_.revolutions() * 360; }, "drum angle over all turns"},
      {"speed", "rpm", [this] { return drum_.speed * units::rpm; }, "speed of the drum"},
      {"blade.speed", "m/min", [blade_speed] { return blade_speed() * units::metres_a_minute; },
       "speed of the blade tips, of helical ones along the web"},
      {"blade.ratio", "",
       [this, blade_speed] {
         const double web = station_.material().speed;
         return web != 0 ? blade_speed() / web : 0;
       },
       "blade tip speed over web speed"},
      {"mismatch", "mm/s", [this] { return cutter_.mismatch() * units::millimetres; },
       "blade speed along the web minus web speed while the blade is in the web, else 0"},
      {"cut.length", "mm", [this] { return station_.length() * units::millimetres; },
       "length of the last piece"},
      {"cut.mismatch", "mm/s", [this] { return last_mismatch_ * units::millimetres; },
       "largest speed mismatch of the last cut"},
      {"cut.force", "N", [this] { return cutter_.force(); }, "vertical force on the blade"},
      {"cut.skew", "mm", [this] { return last_skew_ * units::millimetres; },
       "how far the last cut of a helical blade is out of square over the width of the web"},
      {"cut.place", "mm", [this] { return cutter_.place() * units::millimetres; },
       "where across the web a helical blade cuts now, from its middle to the operator's side"},
      {"cut.number", "", [this] { return static_cast<double>(cuts_); }, "cuts since the start"},
      {"motor.speed", "rpm", [this] { return rotor_.speed * units::rpm; }, "speed of the motor"},
      {"gear.torque", "N m", [this] { return gear_.torque(); }, "torque of the gear on the drum"},
      {"gear.twist", "deg", [this] { return gear_.twist() * units::degrees; },
       "twist between motor and drum, at the drum"},
  };
  sensors_.offer_channels(channels);
  servo_.offer_channels(channels);
  return channels;
}

std::vector<Setting> RotaryKnife::settings() {
  std::vector<Setting> settings;
  servo_.offer_settings(settings);
  return settings;
}

std::vector<EventType> RotaryKnife::event_types() {
  EventType cut = {
      "cut",
      {{"length", "mm"}, {"mismatch", "mm/s"}, {"force", "N"}, {"number", ""}},
      "a blade went through the web at bottom dead centre: length of the piece, largest speed "
      "mismatch in the web, largest vertical force, number since the start; on a printed web "
      "register, how far the cut lies behind the nearest mark; of a station down the line rest, what is "
      "left of the piece behind the cut; of a helical blade, which cuts from "
      "edge to edge, skew, how far the cut is out of square over the width of the web, positive "
      "where the blade was too fast, and the length in the middle"};
  if (data_.helix > 0) cut.values.push_back({"skew", "mm"});
  station_.describe(cut);
  std::vector<EventType> types = {
      cut,
      {"tear", {{"mismatch", "mm/s"}}, "the blade in the web was too fast: it tears", Severity::error},
      {"buckle",
       {{"mismatch", "mm/s"}},
       "the blade in the web was too slow: the web buckles",
       Severity::warning}};
  station_.offer_events(types);
  ServoAxis::offer_events(types);
  return types;
}

std::vector<DriveOfPlant> RotaryKnife::drives() {
  auto drives = servo_.drives(data_.geared() / (data_.gear.ratio * data_.gear.ratio * data_.motors),
                              data_.gear.efficiency);
  for (auto& drive : drives) drive.alike = data_.motors;
  return drives;
}

// The motors share what turns with the drum.
MotorLoad RotaryKnife::motor_load(double h) const {
  const double arm = 1 / (data_.gear.ratio * data_.motors);
  const double torque = servo_.amplifier().torque();
  const double turning = rotor_.inertia * (rotor_.speed - rotor_.speed_before) / h;
  const double drum = drum_.inertia * (drum_.speed - drum_.speed_before) / h;
  const double resisting = gear_.torque() * data_.motors - drum;
  const double rubbing = friction_in(friction_, drum_.speed_before, resisting, drum_.inertia, h);
  return {.torque = torque,
          .acceleration = turning + drum * arm,
          .friction = torque - gear_.torque() / data_.gear.ratio - turning + rubbing * arm,
          .load = (resisting - rubbing) * arm,
          .speed = rotor_.speed};
}

std::vector<Recurrence> RotaryKnife::recurrences() {
  return {{"drum", 0, static_cast<double>(data_.blade_count)},
          {"motor", 0, data_.blade_count / data_.gear.ratio}};
}

void RotaryKnife::visit(StateArchive& archive) {
  STATE(archive, station_, servo_, gear_, sensors_, cutter_, cuts_, last_mismatch_, last_skew_);
}

Parameters RotaryKnife::live_parameters() { return live_rows(rotary_knife_parameters(data_)); }

void RotaryKnife::parameters_changed() {
  gear_.take(sprung(data_));
  friction_ = geared_friction(data_.drum_friction, data_.counter);
  if (drum_.inertia != data_.geared()) world_.set_inertia(drum_, data_.geared());
}

std::vector<Fault> RotaryKnife::faults() {
  std::vector<Fault> faults;
  servo_.offer_faults(faults);
  sensors_.offer_faults(faults);
  return faults;
}

}  // namespace drycut::plants
