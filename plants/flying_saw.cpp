#include "plants/flying_saw.hpp"

#include <algorithm>
#include <cmath>

#include "base/state_archive.hpp"
#include "base/units.hpp"

namespace drycut::plants {

namespace {

constexpr double longest_contact = 0.1;  // a carriage that leans on its stop is reported after this [s]

}  // namespace

LeastStroke least_stroke(const FlyingSawData& saw, const Section& section, double line_speed) {
  const SawHeadData& head = saw.head;
  const double down = plunge_speed(head);
  const double up = return_speed(head);
  const double push = head.down_force + head.mass * units::gravity;
  LeastStroke least;
  least.cycle = saw.clamp.close_time + saw.clamp.open_time + 2 * head.valve_delay + head.clearance / down +
                cutting_time(saw.blade, section, push, head.down_throttle) + section_height(section) / up;
  const double per_metre = units::turn / saw.lead;
  const double ratio = saw.gear.ratio;
  const double turning =
      motor_inertia(saw, saw.drive.servo.rotor_inertia) * ratio * ratio * per_metre * per_metre;
  const double acceleration = saw.drive.servo.peak_torque * ratio * per_metre / (saw.mass + turning);
  least.stroke = line_speed * least.cycle + line_speed * line_speed / acceleration;
  return least;
}

FlyingSaw::FlyingSaw(const FlyingSawData& data, World& world, Web& web)
    : data_(data),
      world_(world),
      web_(web),
      station_(data.station, web, data.travel_min, data.travel_max),
      screw_(data, "saw", data.drive.servo.rotor_inertia, {.name = "saw carriage", .mass = data.mass}, world),
      servo_(data.drive, rotor(), world.random("saw servo")),
      clamp_(data.clamp),
      head_(data.head, world),
      cut_(data.blade, web.data().cross_section(), data.head.clearance) {}

Slide& FlyingSaw::material() {
  const Slide& before = station_.material();
  Slide& now = station_.under(carriage().position, carriage().speed);
  if (&now != &before) cut_.handed(before, now);
  return now;
}

void FlyingSaw::drive(double h) {
  Slide& material = this->material();
  servo_.drive(rotor(), h);
  screw_.transmit();
  const SawCut::Load load = cut_.load(head_.body(), carriage(), material, !station_.is_empty());
  carriage().add_force(outer_force_);
  carriage().add_force(load.sideways);
  material.add_force(-load.sideways);
  screw_.push_back(h);
  for (std::size_t i = 0; i < crashes_.size(); ++i) {
    const EndStop& stop = screw_.stops[i];
    if (stop.depth(carriage().position) <= 0) continue;
    crashes_[i].touched = true;
    crashes_[i].impulse += stop.force() * h;
    crashes_[i].time += h;
  }
  head_.drive(h, load.resistance);
  // Dry friction last, the clamps' even after that of the guides.
  screw_.rub(h);
  clamp_.drive(carriage(), material, h);
}

void FlyingSaw::watch(const EndStop& stop, Crash& crash) {
  if (!crash.touched) return;
  const double depth = stop.depth(carriage().position);
  const bool over = depth <= 0;
  if (!crash.reported && (over || crash.time >= longest_contact)) {
    const double before = stop.depth(carriage().position_before);
    crash.reported = true;
    happened({"crash",
              over ? std::clamp(before / (before - depth), 0.0, 1.0) : 1,
              {{"side", stop.side(), ""},
               {"speed", stop.hit_speed() * units::millimetres, "mm/s"},
               {"impulse", crash.impulse, "N s"},
               {"force", stop.peak(), "N"}}});
  }
  if (over) crash = {};
}

void FlyingSaw::sense(double h) {
  tell_motor_load(h);
  screw_.sense(h);
  servo_.sense(rotor());
  happened_to(servo_, rotor());
  head_.sense(h);
  const Slide& material = this->material();
  clamp_.sense(carriage(), material, h);
  const bool was_engaged = cut_.engaged();
  const SawCut::Outcome outcome = cut_.sense(head_.body(), carriage(), material, h);
  if (!station_.is_empty()) hold(material, was_engaged);
  report(outcome);
  for (std::size_t i = 0; i < crashes_.size(); ++i) watch(screw_.stops[i], crashes_[i]);
}

void FlyingSaw::took_hold(double difference, bool blade) {
  hold_.mismatch = std::max(hold_.mismatch, std::abs(difference));
  if (std::abs(difference) <= data_.mismatch_limit) return;
  happened({"clamped_moving",
            0,
            {{"difference", difference * units::millimetres, "mm/s"}, {"blade", blade ? 1.0 : 0.0, ""}}});
}

// The speeds before the step are those at which the two met.
void FlyingSaw::hold(const Slide& material, bool was_engaged) {
  if (clamp_.has_let_go() && was_engaged)
    happened({"opened_early",
              0,
              {{"depth", (head_.body().position - data_.head.clearance) * units::millimetres, "mm"}}});
  const bool touched = cut_.engaged() && !was_engaged;
  const bool held = clamp_.closed.level || cut_.engaged();
  if (!held || !hold_.on) hold_ = {.on = held};
  if (!held) return;
  const double before = carriage().speed_before - material.speed_before;
  if (clamp_.has_gripped()) took_hold(before, false);
  if (touched && !clamp_.closed.level) took_hold(before, true);
  if (touched && clamp_.limit() <= 0 && data_.clamp.force > 0 && std::abs(before) <= data_.mismatch_limit)
    happened({"unclamped", 0, {}});
  hold_.mismatch = std::max(hold_.mismatch, std::abs(carriage().speed - material.speed));
  hold_.slip = std::max(hold_.slip, std::abs(clamp_.slip()));
}

void FlyingSaw::report(const SawCut::Outcome& outcome) {
  if (outcome.pinched)
    happened({"pinch",
              1,
              {{"force", std::abs(cut_.sideways()), "N"},
               {"displacement", cut_.displacement() * units::millimetres, "mm"}}});
  if (!outcome.separated || station_.is_empty()) return;
  station_.cut(outcome.fraction, outcome.mark);
  last_slant_ = outcome.slant;
  last_pinch_ = outcome.pinch;
  ++cuts_;
  MachineEvent cut = {"cut",
                      outcome.fraction,
                      {{"length", station_.length() * units::millimetres, "mm"},
                       {"slant", outcome.slant * units::millimetres, "mm"},
                       {"mismatch", hold_.mismatch * units::millimetres, "mm/s"},
                       {"slip", hold_.slip * units::millimetres, "mm"},
                       {"pinch", outcome.pinch, "N"},
                       {"force", outcome.force, "N"},
                       {"time", outcome.time * units::milliseconds, "ms"},
                       {"number", static_cast<double>(cuts_), ""}}};
  station_.describe(cut);
  happened(std::move(cut));
  for (MachineEvent& scrap : station_.take_events()) happened(std::move(scrap));
  hold_ = {.on = true};
}

void FlyingSaw::Crash::visit(StateArchive& archive) { STATE(archive, impulse, time, touched, reported); }
void FlyingSaw::Hold::visit(StateArchive& archive) { STATE(archive, on, mismatch, slip); }

void FlyingSaw::visit(StateArchive& archive) {
  STATE(archive, station_, screw_, servo_, outer_force_, crashes_, clamp_, head_, cut_, hold_, cuts_,
        last_slant_, last_pinch_);
}

std::vector<DriveOfPlant> FlyingSaw::drives() {
  return servo_.drives(load_inertia(data_), efficiency(data_));
}

MotorLoad FlyingSaw::motor_load(double h) const {
  return screw_.motor_load(servo_.amplifier().torque(), 0, h);
}

std::vector<EventType> FlyingSaw::event_types() {
  std::vector<EventType> types = {
      {"cut",
       {{"length", "mm"},
        {"slant", "mm"},
        {"mismatch", "mm/s"},
        {"slip", "mm"},
        {"pinch", "N"},
        {"force", "N"},
        {"time", "ms"},
        {"number", ""}},
       "the blade is through: length of the piece where the blade touched, how far the cut is out of "
       "square, largest speed mismatch and slip of the clamps since clamps or blade took hold of the "
       "material, largest sideways and cutting force, time from the touch, number; on a "
       "printed web register, how far the cut lies behind the nearest mark; of a station down the line rest, "
       "what is left of the piece behind the cut"},
      {"clamped_moving",
       {{"difference", "mm/s"}, {"blade", ""}},
       "the clamps have gripped material that ran at another speed by more than mismatch_limit, or the "
       "blade has come into it unclamped (blade 1): speed of the carriage less speed of the material",
       Severity::error},
      {"unclamped",
       {},
       "the blade has come into material that ran with the carriage while nothing clamped it: the clamps "
       "were open, or without force",
       Severity::error},
      {"opened_early",
       {{"depth", "mm"}},
       "the clamps have let go with the blade so deep in the material",
       Severity::error},
      {"pinch",
       {{"force", "N"}, {"displacement", "mm"}},
       "the material and the carriage pinch the blade: sideways force, displacement since the touch",
       Severity::warning},
      {"crash",
       {{"side", ""}, {"speed", "mm/s"}, {"impulse", "N s"}, {"force", "N"}},
       "the carriage has been in an end stop: side -1 lower or 1 upper, speed when it touched, impulse "
       "until it was off again (or 100 ms), largest force",
       Severity::damage}};
  station_.describe(types.front());
  station_.offer_events(types);
  ServoAxis::offer_events(types);
  return types;
}

std::vector<Port> FlyingSaw::ports() {
  std::vector<Port> ports;
  screw_.sensors.offer_ports(ports);
  servo_.offer_ports(ports);
  ports.push_back({"clamp", &clamp_.command, "valve of the clamps: on = close"});
  ports.push_back({"clamp.closed", &clamp_.closed, "the clamps grip"});
  head_.offer_ports(ports);
  return ports;
}

std::optional<PlugScale> FlyingSaw::scale_of(std::string_view port) const {
  const double turns_a_metre = data_.gear.ratio / data_.lead;  // of the motor
  if (port == "encoder") return PlugScale{4 * data_.sensors.encoder.lines * turns_a_metre, false};
  if (port == "scale") return PlugScale{1 / data_.sensors.scale_resolution, false};
  if (port == "servo.reference")
    return PlugScale{data_.drive.servo.speed_at_10v / (units::turn * turns_a_metre), false};
  return {};
}

std::vector<Channel> FlyingSaw::channels() {
  std::vector<Channel> channels = {
      {"position", "mm", [this] { return carriage().position * units::millimetres; },
       "place of the blade on the line, from its station's"},
      {"speed", "m/min", [this] { return carriage().speed * units::metres_a_minute; },
       "speed of the carriage"},
      {"mismatch", "mm/s",
       [this] { return (carriage().speed - station_.material().speed) * units::millimetres; },
       "speed of the carriage less speed of the material"},
      on_off("clamp.closed", clamp_.closed.level, "1 while the clamps grip"),
      on_off("clamp.command", clamp_.command.level, "1 while the clamps are told to close"),
      {"clamp.force", "N", [this] { return clamp_.friction(); }, "friction of the clamps on the carriage"},
      {"clamp.slip", "mm", [this] { return clamp_.slip() * units::millimetres; },
       "carriage ahead of the material since the clamps closed"},
      {"blade.engaged", "", [this] { return cut_.engaged() ? 1.0 : 0.0; },
       "1 while the blade is in the material"},
      {"blade.pinch", "N", [this] { return cut_.sideways(); }, "sideways force of the blade on the carriage"},
      {"blade.displacement", "mm", [this] { return cut_.displacement() * units::millimetres; },
       "way of the blade on the material since it touched, else 0"},
      {"cut.length", "mm", [this] { return station_.length() * units::millimetres; },
       "length of the last piece"},
      {"cut.slant", "mm", [this] { return last_slant_ * units::millimetres; },
       "how far the last cut is out of square"},
      {"cut.pinch", "N", [this] { return last_pinch_; }, "largest sideways force of the last cut"},
      {"cut.force", "N", [this] { return cut_.force(); }, "cutting force on the blade"},
      {"cut.number", "", [this] { return static_cast<double>(cuts_); }, "cuts since the start"},
      {"motor.speed", "rpm", [this] { return rotor().speed * units::rpm; }, "speed of the motor"},
      {"gear.force", "N", [this] { return screw_.force(); }, "force of rack or screw on the carriage"},
      {"gear.ahead", "mm", [this] { return screw_.ahead() * units::millimetres; },
       "motor ahead of the carriage: play and twist taken up"},
      {"stop.force", "N", [this] { return screw_.stop_force(); }, "force of the end stops on the carriage"},
  };
  head_.offer_channels(channels);
  servo_.offer_channels(channels);
  screw_.sensors.offer_channels(channels);
  return channels;
}

std::vector<Setting> FlyingSaw::settings() {
  std::vector<Setting> settings = {{"force",
                                    "N",
                                    [this](double v) { outer_force_ = v; },
                                    [this] { return outer_force_; },
                                    "force of hoses and cables on the carriage, positive with the line",
                                    {-1e6, 1e6, false}}};
  servo_.offer_settings(settings);
  return settings;
}

Parameters FlyingSaw::live_parameters() { return live_rows(flying_saw_parameters(data_)); }

void FlyingSaw::parameters_changed() { screw_.take(data_, data_.mass, world_); }

std::vector<Fault> FlyingSaw::faults() {
  std::vector<Fault> faults;
  servo_.offer_faults(faults);
  screw_.sensors.offer_faults(faults);
  clamp_.offer_faults(faults, "clamp");
  head_.offer_faults(faults);
  return faults;
}

}  // namespace drycut::plants
