#include <fmt/format.h>

#include "base/problem.hpp"
#include "base/units.hpp"
#include "plants/axis_objections.hpp"
#include "plants/flying_saw.hpp"
#include "plants/friction_rows.hpp"

namespace drycut::plants {

namespace {

Parameters mechanics(FlyingSawData& data) {
  return {
      row("web", "the web, strip or tube, that it cuts", data.web, "web", "", true),
      live(row("mass", "kg", "mass of the carriage with clamps and saw head", data.mass, 1, 1e5,
               "estimate: a light saw")),
      row("lead", "mm", "travel for one turn of the pinion, or of the screw", data.lead, 0.1, 5000,
          "pinion of 63.7 mm"),
      row("pinion_inertia", "kg m2", "inertia of the pinion or the screw", data.screw_inertia, 0, 100,
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
      row("mismatch_limit", "mm/s",
          "difference of speed at which clamps or blade may take hold of the material", data.mismatch_limit,
          0, 1e5, "estimate: jaws leave marks"),
      row("stroke_check", "refuse a line speed at which no program can cut within the travel",
          data.stroke_check, "off: see it crash"),
  };
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
        {"plant.parameters-contradict"_code, "head.stroke",
         fmt::format("{:g} mm of stroke less {:g} mm of clearance do not go through {:g} mm of "
                     "material, the section of {}, before the switch head.down",
                     saw.head.stroke * 1000, saw.head.clearance * 1000, height * 1000, saw.web),
         fmt::format("more than {:g} mm", (height + saw.head.clearance + saw.head.switch_margin) * 1000)});
  const double travel = saw.travel_max - saw.travel_min;
  const LeastStroke least = least_stroke(saw, section, web.drive.speed);
  if (saw.stroke_check && least.stroke > travel)
    found.push_back(
        {"plant.parameters-contradict"_code, "travel_max",
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

Parameters flying_saw_parameters(FlyingSawData& data) {
  return joined(
      mechanics(data), screw_parameters(data, "none is named: losses are not counted"),
      group("motor_friction.", shaft_friction_parameters(data.motor_friction,
                                                         {.dry = "dry friction of motor and gear",
                                                          .viscous = "viscous friction of the motor",
                                                          .coulomb_from = "estimate: 1 % of rated torque"})),
      group("carriage_friction.",
            joined(guide_friction_parameters(data.guide_friction,
                                             {.dry = "dry friction of the guides",
                                              .viscous = "viscous friction of the guides",
                                              .coulomb_from = "estimate: four sealed guide carriages"}),
                   guide_coefficient_parameters(data))),
      station_parameters(data.station), group("clamp.", clamp_parameters(data.clamp)),
      group("head.", saw_head_parameters(data.head)), group("blade.", saw_blade_parameters(data.blade)),
      axis_transducer_parameters(data.sensors, {.limits = "10 mm before the stop"}),
      servo_axis_parameters(data.drive, {.inertia_ratio = "the default carriage on the motor",
                                         .speed_at_10v = "setting: largest speed at 10 V"}),
      group("gear.", transmission_parameters(
                         data.gear, {.stiffness = "estimate: gear, pinion and rack, 4.9 N/um at the carriage",
                                     .damping = "estimate: 8 % of critical"})));
}

Objections FlyingSawDefinition::objections(double h) {
  AxisObjections found("carriage", h);
  const double inertia = motor_inertia(data, data.drive.servo.rotor_inertia);
  found.screw(data, inertia);
  found.add(encoder_objections(data.sensors.encoder));
  found.pair("head.mass", "head.mass", head_cushion(data.head), "head and the end of its cylinder");
  found.guided("carriage_friction.viscous", data, inertia);
  if (return_speed(data.head) <= 0)
    found.object("plant.parameters-contradict"_code, "head.up_force",
                 fmt::format("it does not lift the head of {:g} kg", data.head.mass),
                 fmt::format("more than {:.0f} N", data.head.mass * units::gravity));
  found.add(servo_axis_objections(data.drive, inertia, h));
  return found.take();
}

Objections FlyingSawDefinition::objections_with(const FindDefinition& find, double h) {
  const auto* web = dynamic_cast<WebDefinition*>(find(data.web));
  if (web == nullptr) return {};
  AxisObjections found("carriage", h);
  found.add(objections_to(web->data, data));
  found.add(station_objections(data.station, web->data));
  found.pair("blade.stiffness", "blade.damping",
             {data.blade.stiffness, data.blade.damping, reduced(data.mass, web->data.mass_at_cut())},
             "blade and material");
  return found.take();
}

std::optional<PlantDefinition::Stretch> FlyingSawDefinition::stretch() const {
  return Stretch{data.station.place + data.travel_min, data.station.place + data.travel_max};
}

std::unique_ptr<Plant> FlyingSawDefinition::build(World& world,
                                                  const std::function<Plant*(std::string_view)>& find) {
  return std::make_unique<FlyingSaw>(data, world, referred<Web>(find, "web", data.web, "web"));
}

}  // namespace drycut::plants
