#include "plants/flying_saw.hpp"

#include <algorithm>
#include <cmath>

#include "base/units.hpp"

namespace drycut::plants {

namespace {

constexpr double metres_a_minute = 60;   // m/s -> m/min
constexpr double longest_contact = 0.1;  // a carriage that leans on its stop is reported after this [s]
constexpr double blade_speed = 2 * units::turn;  // pictures: slow enough to be seen to turn [rad/s]

}  // namespace

LeastStroke least_stroke(const FlyingSawData& saw, const Section& section, double line_speed) {
  const SawHeadData& head = saw.head;
  const double down = plunge_speed(head);
  const double up = return_speed(head);
  const double push = head.down_force + head.mass * 9.80665;
  LeastStroke least;
  least.cycle = saw.clamp.close_time + saw.clamp.open_time + 2 * head.valve_delay + head.clearance / down +
                cutting_time(saw.blade, section, push, head.down_throttle) + section_height(section) / up;
  const double per_metre = units::turn / saw.lead;
  const double ratio = saw.gear.ratio;
  const double turning = (saw.drive.servo.rotor_inertia + saw.pinion_inertia / (ratio * ratio)) * ratio *
                         ratio * per_metre * per_metre;
  const double acceleration = saw.drive.servo.peak_torque * ratio * per_metre / (saw.mass + turning);
  least.stroke = line_speed * least.cycle + line_speed * line_speed / acceleration;
  return least;
}

FlyingSaw::FlyingSaw(const FlyingSawData& data, World& world, Web& web)
    : data_(data),
      web_(web),
      pinion_per_metre_(units::turn / data.lead),
      rotor_(world.add_shaft({.name = "saw motor",
                              .inertia = data.drive.servo.rotor_inertia +
                                         data.pinion_inertia / (data.gear.ratio * data.gear.ratio),
                              .revolutions = data.start / data.lead * data.gear.ratio})),
      carriage_(world.add_slide({.name = "saw carriage", .mass = data.mass, .position = data.start})),
      servo_(data.drive, rotor_, world.random("saw servo")),
      lower_{EndStop(data.stop, data.travel_min, -1), data.travel_min, -1},
      upper_{EndStop(data.stop, data.travel_max, 1), data.travel_max, 1},
      sensors_(data.sensors, data.start, rotor_.revolutions(), world.random("saw encoder"),
               world.random("saw scale")),
      clamp_(data.clamp),
      head_(data.head, world),
      cut_(data.blade, web.data().cross_section(), data.head.clearance) {}

void FlyingSaw::push_back(Buffer& buffer, double h) {
  buffer.stop.drive(carriage_, h);
  if (buffer.side * (carriage_.position - buffer.position) <= 0) return;
  buffer.touched = true;
  buffer.impulse += buffer.stop.force() * h;
  buffer.time += h;
}

void FlyingSaw::drive(double h) {
  Slide& material = web_.material();
  servo_.drive(rotor_, h);
  const double rate = rotor_.speed / data_.gear.ratio - carriage_.speed * pinion_per_metre_;
  const double torque = transmission_torque(data_.gear, twist_, rate);
  drive_force_ = torque * pinion_per_metre_;
  rotor_.add_torque(-torque / data_.gear.ratio);
  const SawCut::Load load = cut_.load(head_.body(), carriage_, material);
  carriage_.add_force(drive_force_ + outer_force_ + load.sideways);
  material.add_force(-load.sideways);
  push_back(lower_, h);
  push_back(upper_, h);
  head_.drive(h, load.resistance);
  // Dry friction last: it answers to all other efforts, the clamps' to that of the guides too.
  rotor_.add_torque(friction_effort(data_.motor_friction, rotor_.speed, rotor_.torque, rotor_.inertia, h));
  carriage_.add_force(
      friction_effort(data_.carriage_friction, carriage_.speed, carriage_.force, carriage_.mass, h));
  clamp_.drive(carriage_, material, h);
}

void FlyingSaw::watch(Buffer& buffer) {
  if (!buffer.touched) return;
  const double depth = buffer.side * (carriage_.position - buffer.position);
  const bool over = depth <= 0;
  if (!buffer.reported && (over || buffer.time >= longest_contact)) {
    const double before = buffer.side * (carriage_.position_before - buffer.position);
    buffer.reported = true;
    happened({"crash",
              over ? std::clamp(before / (before - depth), 0.0, 1.0) : 1,
              {{"side", buffer.side, ""},
               {"speed", buffer.stop.hit_speed() * units::millimetres, "mm/s"},
               {"impulse", buffer.impulse, "N s"},
               {"force", buffer.stop.peak(), "N"}}});
  }
  if (!over) return;
  buffer.touched = buffer.reported = false;
  buffer.impulse = buffer.time = 0;
}

void FlyingSaw::sense(double h) {
  // Summed up from the speeds, as Transmission does: a difference of two long ways would lose its digits.
  twist_ += (rotor_.speed / data_.gear.ratio - carriage_.speed * pinion_per_metre_) * h;
  servo_.sense(rotor_);
  if (auto trip = servo_.trip(rotor_)) happened(std::move(*trip));
  sensors_.sense(rotor_, carriage_, h);
  head_.sense(h);
  clamp_.sense(carriage_, web_.material(), h);
  report(cut_.sense(head_.body(), carriage_, web_.material(), h));
  watch(lower_);
  watch(upper_);
  blade_turn_ = std::fmod(blade_turn_ + blade_speed * h, units::turn);
}

void FlyingSaw::report(const SawCut::Outcome& outcome) {
  if (outcome.pinched)
    happened({"pinch",
              1,
              {{"force", std::abs(cut_.sideways()), "N"},
               {"displacement", cut_.displacement() * units::millimetres, "mm"}}});
  if (!outcome.separated) return;
  last_length_ = web_.separate(outcome.fraction, outcome.mark);
  last_slant_ = outcome.slant;
  last_pinch_ = outcome.pinch;
  ++cuts_;
  happened({"cut",
            outcome.fraction,
            {{"length", last_length_ * units::millimetres, "mm"},
             {"slant", outcome.slant * units::millimetres, "mm"},
             {"mismatch", outcome.mismatch * units::millimetres, "mm/s"},
             {"pinch", outcome.pinch, "N"},
             {"force", outcome.force, "N"},
             {"time", outcome.time * units::milliseconds, "ms"},
             {"number", static_cast<double>(cuts_), ""}}});
}

std::vector<EventType> FlyingSaw::event_types() {
  return {{"cut",
           {{"length", "mm"},
            {"slant", "mm"},
            {"mismatch", "mm/s"},
            {"pinch", "N"},
            {"force", "N"},
            {"time", "ms"},
            {"number", ""}},
           "the blade is through: length of the piece where the blade touched, how far the cut is out of "
           "square, largest speed mismatch, largest sideways and cutting force, time from the touch, number"},
          {"pinch",
           {{"force", "N"}, {"displacement", "mm"}},
           "the material and the carriage pinch the blade: sideways force, displacement since the touch"},
          {"crash",
           {{"side", ""}, {"speed", "mm/s"}, {"impulse", "N s"}, {"force", "N"}},
           "the carriage has been in an end stop: side -1 lower or 1 upper, speed when it touched, impulse "
           "until it was off again (or 100 ms), largest force"},
          ServoAxis::trip_event()};
}

std::vector<Port> FlyingSaw::ports() {
  std::vector<Port> ports;
  sensors_.offer_ports(ports);
  servo_.offer_ports(ports);
  ports.push_back({"clamp", &clamp_.command, "valve of the clamps: on = close"});
  ports.push_back({"clamp.closed", &clamp_.closed, "the clamps grip"});
  head_.offer_ports(ports);
  return ports;
}

std::vector<Channel> FlyingSaw::channels() {
  std::vector<Channel> channels = {
      {"position", "mm", [this] { return carriage_.position * units::millimetres; },
       "place of the blade on the line"},
      {"speed", "m/min", [this] { return carriage_.speed * metres_a_minute; }, "speed of the carriage"},
      {"mismatch", "mm/s", [this] { return (carriage_.speed - web_.material().speed) * units::millimetres; },
       "speed of the carriage less speed of the material"},
      {"clamp.closed", "", [this] { return clamp_.closed.level ? 1.0 : 0.0; }, "1 while the clamps grip"},
      {"clamp.command", "", [this] { return clamp_.command.level ? 1.0 : 0.0; },
       "1 while the clamps are told to close"},
      {"clamp.force", "N", [this] { return clamp_.friction(); }, "friction of the clamps on the carriage"},
      {"clamp.slip", "mm", [this] { return clamp_.slip() * units::millimetres; },
       "carriage ahead of the material since the clamps closed"},
      {"blade.engaged", "", [this] { return cut_.engaged() ? 1.0 : 0.0; },
       "1 while the blade is in the material"},
      {"blade.pinch", "N", [this] { return cut_.sideways(); }, "sideways force of the blade on the carriage"},
      {"blade.displacement", "mm", [this] { return cut_.displacement() * units::millimetres; },
       "way of the blade on the material since it touched, else 0"},
      {"cut.length", "mm", [this] { return last_length_ * units::millimetres; }, "length of the last piece"},
      {"cut.slant", "mm", [this] { return last_slant_ * units::millimetres; },
       "how far the last cut is out of square"},
      {"cut.pinch", "N", [this] { return last_pinch_; }, "largest sideways force of the last cut"},
      {"cut.force", "N", [this] { return cut_.force(); }, "cutting force on the blade"},
      {"cut.number", "", [this] { return static_cast<double>(cuts_); }, "cuts since the start"},
      {"motor.speed", "rpm", [this] { return rotor_.speed * units::rpm; }, "speed of the motor"},
      {"gear.force", "N", [this] { return drive_force_; }, "force of rack or screw on the carriage"},
      {"gear.ahead", "mm", [this] { return twist_ / pinion_per_metre_ * units::millimetres; },
       "motor ahead of the carriage: play and twist taken up"},
      {"stop.force", "N", [this] { return lower_.stop.force() + upper_.stop.force(); },
       "force of the end stops on the carriage"},
  };
  head_.offer_channels(channels);
  servo_.offer_channels(channels);
  sensors_.offer_channels(channels);
  return channels;
}

std::vector<Setting> FlyingSaw::settings() {
  return {{"force",
           "N",
           [this](double v) { outer_force_ = v; },
           [this] { return outer_force_; },
           "force of hoses and cables on the carriage, positive with the line",
           {-1e6, 1e6, false}}};
}

std::vector<Fault> FlyingSaw::faults() {
  std::vector<Fault> faults;
  servo_.offer_faults(faults);
  sensors_.offer_faults(faults);
  clamp_.offer_faults(faults, "clamp");
  head_.offer_faults(faults);
  return faults;
}

}  // namespace drycut::plants
