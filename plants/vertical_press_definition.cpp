#include "base/problem.hpp"
#include "plants/axis_objections.hpp"
#include "plants/friction_rows.hpp"
#include "plants/vertical_press.hpp"

namespace drycut::plants {

namespace {

Parameters mechanics(VerticalPressData& data) {
  return {
      live(row("mass", "kg", "mass of the ram with its tool", data.mass, 1e-3, 1e6, "a small screw press")),
      row("load", "kg", "what the ram carries besides, at the start", data.load, 0, 1e6, "none"),
      live(row("counterbalance", "N", "constant force upwards: cylinder or gas spring", data.counterbalance,
               0, 1e7, "estimate: a third of the weight")),
      row("lead", "mm", "travel for one turn of the screw, or of a rack's pinion", data.lead, 0.1, 5000,
          "ball screw 40 x 10"),
      row("screw_inertia", "kg m2", "inertia of screw or pinion", data.screw_inertia, 0, 100,
          "steel screw, 40 mm by 0.8 m, 36 mm at the root"),
      row("start", "mm", "height at the start; encoder and scale count 0 there", data.start, -1e6, 1e6,
          "middle of the stroke"),
      row("travel_min", "mm", "where the lower end stop begins", data.travel_min, -1e6, 1e6,
          "10 mm below the stroke"),
      row("travel_max", "mm", "where the upper end stop begins", data.travel_max, -1e6, 1e6,
          "10 mm above a stroke of 600 mm"),
      row("stop.stiffness", "N/m", "stiffness of an end stop", data.stop.stiffness, 1, 1e10,
          "estimate: steel on hard rubber"),
      row("stop.damping", "N s/m", "damping of an end stop", data.stop.damping, 0, 1e8,
          "estimate: a third of critical for ram and motor"),
      row("workpiece.height", "mm", "height at which the tool meets the workpiece", data.workpiece_height,
          -1e6, 1e6, "a part of 50 mm"),
      row("workpiece.stiffness", "N/m", "of the workpiece, 0 = none is there", data.workpiece.stiffness, 0,
          1e10, "none"),
      row("workpiece.damping", "N s/m", "of the workpiece", data.workpiece.damping, 0, 1e8, "none"),
  };
}

Parameters picture(VerticalPressData& data) {
  return {
      row("place.x", "mm", "picture: middle of the table along the line", data.place_x, -1e5, 1e5,
          "at the cut"),
      row("place.y", "mm", "picture: height of the table over the web", data.place_y, -900, 1e5,
          "height of the web"),
      row("place.z", "mm", "picture: across the line, towards the operator", data.place_z, -1e5, 1e5,
          "middle of the line"),
  };
}

}  // namespace

Parameters vertical_press_parameters(VerticalPressData& data) {
  return joined(
      mechanics(data), screw_parameters(data, "ball screw; backwards 0.8, on the safe side"),
      group("motor_friction.", shaft_friction_parameters(data.motor_friction,
                                                         {.dry = "dry friction of motor and screw bearings",
                                                          .viscous = "viscous friction of the motor, its fan",
                                                          .coulomb_from = "estimate: 1 % of rated torque"})),
      group("ram_friction.",
            guide_friction_parameters(data.guide_friction, {.dry = "dry friction of the ram's guides",
                                                            .viscous = "viscous friction of the guides",
                                                            .coulomb_from = "estimate: four guide bushes"})),
      axis_drive_parameters(data.drive, {.kind = "a press that is positioned on/off",
                                         .brake_torque = "1.7 times rated torque"}),
      group("gear.", transmission_parameters(
                         data.gear, {.stiffness = "estimate: 100 N/um of screw, nut and bearings, lead 10 mm",
                                     .ratio = "motor on the screw"})),
      axis_transducer_parameters(data.sensors, {.scale_resolution = "a usual scale of a press",
                                                .home = "in the upper part of the stroke",
                                                .limits = "10 mm before the stop"}),
      picture(data));
}

std::vector<PlantDefinition::Objection> VerticalPressDefinition::objections(double h) {
  AxisObjections found("ram", h);
  const double inertia = motor_inertia(data, data.drive.rotor_inertia());
  found.screw(data, inertia);
  found.add(encoder_objections(data.sensors.encoder));
  found.contact("workpiece", data.workpiece, data.mass, "workpiece");
  found.guided("ram_friction.viscous", data, inertia);
  if (data.workpiece.stiffness > 0 && data.start < data.workpiece_height)
    found.object("plant.parameters-contradict"_code, "workpiece.height", "the ram starts in the workpiece",
                 "below start");
  found.add(axis_drive_objections(data.drive, inertia, h));
  return found.take();
}

std::unique_ptr<Plant> VerticalPressDefinition::build(World& world,
                                                      const std::function<Plant*(std::string_view)>&) {
  return std::make_unique<VerticalPress>(data, world);
}

}  // namespace drycut::plants
