#include <fmt/format.h>

#include <stdexcept>

#include "base/units.hpp"
#include "plants/axis_objections.hpp"
#include "plants/linear_axis.hpp"

namespace drycut::plants {

namespace {

Parameter row(const char* name, std::string_view unit, std::string_view meaning, double& value, double min,
              double max, std::string_view source) {
  return Parameter{name, unit, meaning, &value, min, max, {}, {}, source};
}

Parameters mechanics(LinearAxisData& data) {
  return {
      row("mass", "kg", "mass of the carriage with all that it carries", data.mass, 1e-3, 1e5,
          "a medium carriage"),
      row("lead", "mm", "travel for one turn of the screw, or of the belt's pulley", data.lead, 0.1, 5000,
          "ball screw 25 x 20"),
      row("screw_inertia", "kg m2", "inertia of the screw or the pulleys", data.screw_inertia, 0, 100,
          "steel screw, 25 mm by 1 m"),
      row("inclination", "deg", "the axis climbs by this angle in positive direction", data.inclination, -90,
          90, "horizontal"),
      row("start", "mm", "position at the start; encoder and scale count 0 there", data.start, -1e6, 1e6,
          "off the home switch"),
      row("travel_min", "mm", "where the lower end stop begins", data.travel_min, -1e6, 1e6, "1 m of work"),
      row("travel_max", "mm", "where the upper end stop begins", data.travel_max, -1e6, 1e6, "1 m of work"),
      row("stop.stiffness", "N/m", "stiffness of an end stop", data.stop.stiffness, 1, 1e9,
          "estimate: hard rubber buffer"),
      row("stop.damping", "N s/m", "damping of an end stop", data.stop.damping, 0, 1e7,
          "estimate: 16 % of critical for 20 kg"),
      row("motor_friction.coulomb", "N m", "dry friction of the motor and the screw's bearings",
          data.motor_friction.coulomb, 0, 1e4, "estimate: 1 % of rated torque"),
      row("motor_friction.viscous", "N m s/rad", "viscous friction of the motor", data.motor_friction.viscous,
          0, 100, "estimate"),
      row("carriage_friction.coulomb", "N", "dry friction of the guides", data.carriage_friction.coulomb, 0,
          1e6, "estimate: four sealed guide carriages"),
      row("carriage_friction.viscous", "N s/m", "viscous friction of the guides",
          data.carriage_friction.viscous, 0, 1e6, "estimate"),
      row("carriage_friction.breakaway", "N", "what dry friction is more at standstill (Stribeck)",
          data.carriage_friction.breakaway, 0, 1e6, "none: set it to study stick-slip"),
      row("carriage_friction.stribeck_speed", "mm/s", "speed at which 1/e of it is left",
          data.carriage_friction.stribeck_speed, 1e-3, 1e5, "estimate"),
  };
}

Parameters looks(LinearAxisData& data) {
  return {
      row("heading", "deg", "direction of the axis in plan: 0 with the line, 90 away from the operator",
          data.heading, -360, 360, "with the line"),
      row("place.x", "mm", "picture: where position 0 is along the line; on a carrier, from its carriage",
          data.place_x, -1e5, 1e5, "at the cut"),
      row("place.y", "mm", "picture: height of the beam over the web", data.place_y, -900, 1e5,
          "height of the web"),
      row("place.z", "mm", "picture: across the line, towards the operator", data.place_z, -1e5, 1e5,
          "middle of the line"),
      {.name = "carrier",
       .unit = "",
       .meaning = "picture: the linear axis whose carriage carries this one; its mass is to include it",
       .value = &data.carrier,
       .reference = "linear_axis",
       .source = "it stands on the floor"},
      {.name = "motor",
       .unit = "",
       .meaning = "picture: the end of the axis where the motor is",
       .value = &data.motor,
       .choices = {"lower", "upper"},
       .source = "behind the home switch"},
      {.name = "tool",
       .unit = "",
       .meaning = "picture: what the carriage carries",
       .value = &data.tool,
       .choices = {"none", "guide", "blade", "pen"},
       .source = "bare carriage"},
  };
}

double reflected_inertia(const LinearAxisData& data) {
  const double metre_per_radian = data.lead / units::turn;
  return data.mass * metre_per_radian * metre_per_radian;
}

double motor_inertia(const LinearAxisData& data) {
  return data.drive.rotor_inertia() + data.screw_inertia / (data.gear.ratio * data.gear.ratio);
}

}  // namespace

Parameters LinearAxisDefinition::parameters() {
  Parameters table = mechanics(data);
  const auto append = [&table](Parameters rows) {
    for (Parameter& p : rows) table.push_back(std::move(p));
  };
  append(axis_transducer_parameters(data.sensors));
  append(axis_drive_parameters(data.drive));
  append(transmission_parameters(data.gear, "gear."));
  append(looks(data));
  for (Parameter& p : table) {
    if (p.name == "gear.stiffness") p.source = "estimate: 100 N/um of screw, nut and bearings, lead 20 mm";
    if (p.name == "servo.inertia_ratio") p.source = "the default screw and carriage on the motor";
  }
  return table;
}

std::vector<PlantDefinition::Objection> LinearAxisDefinition::objections(double h) {
  AxisObjections found("carriage", h);
  found.gear(data.gear, motor_inertia(data), reflected_inertia(data));
  found.contact("stop", data.stop, data.mass, "end stop");
  found.viscous("motor_friction.viscous", data.motor_friction, motor_inertia(data), "motor");
  found.viscous("carriage_friction.viscous", data.carriage_friction, data.mass, "carriage");
  found.travel(data.travel_min, data.travel_max, data.start);
  found.limit_switches(data.sensors.limit_min, data.sensors.limit_max);
  found.add(axis_drive_objections(data.drive, motor_inertia(data), h));
  return found.take();
}

std::unique_ptr<Plant> LinearAxisDefinition::build(World& world,
                                                   const std::function<Plant*(std::string_view)>& find) {
  const LinearAxis* carrier = nullptr;
  if (data.carrier != no_plant) {
    carrier = dynamic_cast<const LinearAxis*>(find(data.carrier));
    if (carrier == nullptr)
      throw std::invalid_argument(fmt::format(
          "carrier: '{}' is no plant of type linear_axis; name one that stands before this one, or none",
          data.carrier));
  }
  return std::make_unique<LinearAxis>(data, world, carrier);
}

}  // namespace drycut::plants
