#include <fmt/format.h>

#include <stdexcept>

#include "base/units.hpp"
#include "plants/axis_objections.hpp"
#include "plants/flying_saw.hpp"

namespace drycut::plants {

namespace {

Parameter row(const char* name, std::string_view unit, std::string_view meaning, double& value, double min,
              double max, std::string_view source) {
  return Parameter{name, unit, meaning, &value, min, max, {}, {}, source};
}

Parameters mechanics(FlyingSawData& data) {
  return {
      {.name = "web",
       .unit = "",
       .meaning = "the web, strip or tube, that it cuts",
       .value = &data.web,
       .reference = "web",
       .sole = true},
      row("mass", "kg", "mass of the carriage with clamps and saw head", data.mass, 1, 1e5,
          "estimate: a light saw"),
      row("lead", "mm", "travel for one turn of the pinion, or of the screw", data.lead, 0.1, 5000,
          "pinion of 63.7 mm"),
      row("pinion_inertia", "kg m2", "inertia of the pinion or the screw", data.pinion_inertia, 0, 100,
          "estimate: steel pinion with its shaft"),
      row("start", "mm", "place of the blade on the line at the start; encoder and scale count 0 there",
          data.start, -1e6, 1e6, "at home"),
      row("travel_min", "mm", "where the lower end stop begins", data.travel_min, -1e6, 1e6,
          "40 mm behind home"),
      row("travel_max", "mm", "where the upper end stop begins", data.travel_max, -1e6, 1e6,
          "0.8 m of travel"),
      row("stop.stiffness", "N/m", "stiffness of an end stop", data.stop.stiffness, 1, 1e9,
          "estimate: hard rubber buffer"),
      row("stop.damping", "N s/m", "damping of an end stop", data.stop.damping, 0, 1e7,
          "estimate: 9 % of critical for 60 kg"),
      row("motor_friction.coulomb", "N m", "dry friction of motor and gear", data.motor_friction.coulomb, 0,
          1e4, "estimate: 1 % of rated torque"),
      row("motor_friction.viscous", "N m s/rad", "viscous friction of the motor", data.motor_friction.viscous,
          0, 100, "estimate"),
      row("carriage_friction.coulomb", "N", "dry friction of the guides", data.carriage_friction.coulomb, 0,
          1e6, "estimate: four sealed guide carriages"),
      row("carriage_friction.viscous", "N s/m", "viscous friction of the guides",
          data.carriage_friction.viscous, 0, 1e6, "estimate"),
      {.name = "stroke_check",
       .unit = "",
       .meaning = "refuse a line speed at which no program can cut within the travel",
       .value = &data.stroke_check,
       .max = 1,
       .source = "off: see it crash"},
  };
}

double motor_inertia(const FlyingSawData& data) {
  return data.drive.servo.rotor_inertia + data.pinion_inertia / (data.gear.ratio * data.gear.ratio);
}

double reflected_inertia(const FlyingSawData& data) {
  const double metre_per_radian = data.lead / units::turn;
  return data.mass * metre_per_radian * metre_per_radian;
}

using Objections = std::vector<PlantDefinition::Objection>;

// What the saw cannot do with this material.
Objections objections_to(const WebData& web, const FlyingSawData& saw) {
  Objections found;
  const Section section = web.cross_section();
  const double reach = saw.head.stroke - saw.head.clearance;
  const double height = section_height(section);
  if (reach < height + saw.head.switch_margin)
    found.push_back(
        {"head.stroke",
         fmt::format("{:g} mm of stroke less {:g} mm of clearance do not go through {:g} mm of "
                     "material before the switch head.down",
                     saw.head.stroke * 1000, saw.head.clearance * 1000, height * 1000),
         fmt::format("more than {:g} mm", (height + saw.head.clearance + saw.head.switch_margin) * 1000)});
  const double travel = saw.travel_max - saw.travel_min;
  const LeastStroke least = least_stroke(saw, section, web.drive.speed);
  if (saw.stroke_check && least.stroke > travel)
    found.push_back(
        {"travel_max",
         fmt::format("at {:g} m/min a cut takes the carriage at least {:.0f} mm ({:.0f} ms from "
                     "clamp to clamp open, and the ramps), and {:.0f} mm are there: it would "
                     "crash into the end stop",
                     web.drive.speed * 60, least.stroke * 1000, least.cycle * 1000, travel * 1000),
         fmt::format("at most {:.3g} m/min, a quicker cut, or more travel; 'stroke_check: off' "
                     "runs it all the same",
                     60 * web.drive.speed * travel / least.stroke)});
  return found;
}

}  // namespace

Parameters FlyingSawDefinition::parameters() {
  Parameters table = mechanics(data);
  const auto append = [&table](Parameters rows) {
    for (Parameter& p : rows) table.push_back(std::move(p));
  };
  append(clamp_parameters(data.clamp, "clamp."));
  append(saw_head_parameters(data.head, "head."));
  append(saw_blade_parameters(data.blade, "blade."));
  append(axis_transducer_parameters(data.sensors));
  append(servo_axis_parameters(data.drive));
  append(transmission_parameters(data.gear, "gear."));
  for (Parameter& p : table) {
    if (p.name == "gear.stiffness") p.source = "estimate: gear, pinion and rack, 4.9 N/um at the carriage";
    if (p.name == "servo.inertia_ratio") p.source = "the default carriage on the motor";
    if (p.name == "servo.speed_at_10v") p.source = "setting: largest speed at 10 V";
    if (p.name == "limit_max") p.source = "10 mm before the stop";
    if (p.name == "limit_min") p.source = "10 mm before the stop";
  }
  return table;
}

Objections FlyingSawDefinition::objections(double h) {
  AxisObjections found("carriage", h);
  found.gear(data.gear, motor_inertia(data), reflected_inertia(data));
  found.contact("stop", data.stop, data.mass, "end stop");
  found.pair("head.mass", "head.mass", head_cushion(data.head), "head and the end of its cylinder");
  found.viscous("motor_friction.viscous", data.motor_friction, motor_inertia(data), "motor");
  found.viscous("carriage_friction.viscous", data.carriage_friction, data.mass, "carriage");
  found.travel(data.travel_min, data.travel_max, data.start);
  found.limit_switches(data.sensors.limit_min, data.sensors.limit_max);
  if (return_speed(data.head) <= 0)
    found.object("head.up_force", fmt::format("it does not lift the head of {:g} kg", data.head.mass),
                 fmt::format("more than {:.0f} N", data.head.mass * 9.80665));
  found.add(servo_axis_objections(data.drive, motor_inertia(data), h));
  return found.take();
}

Objections FlyingSawDefinition::objections_with(const FindDefinition& find, double h) {
  const auto* web = dynamic_cast<WebDefinition*>(find(data.web));
  if (web == nullptr) return {};
  AxisObjections found("carriage", h);
  found.add(objections_to(web->data, data));
  found.pair("blade.stiffness", "blade.damping",
             {data.blade.stiffness, data.blade.damping, reduced(data.mass, web->data.mass)},
             "blade and material");
  return found.take();
}

std::unique_ptr<Plant> FlyingSawDefinition::build(World& world,
                                                  const std::function<Plant*(std::string_view)>& find) {
  auto* web = dynamic_cast<Web*>(find(data.web));
  if (web == nullptr)
    throw std::invalid_argument(
        fmt::format("web: '{}' is no plant of type web; name one that stands before this one", data.web));
  return std::make_unique<FlyingSaw>(data, world, *web);
}

}  // namespace drycut::plants
