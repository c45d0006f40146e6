#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "base/problem.hpp"
#include "plants/axis_objections.hpp"
#include "plants/friction_rows.hpp"
#include "plants/linear_axis.hpp"

namespace drycut::plants {

namespace {

constexpr FrictionSources motor_and_screw = {.dry = "dry friction of the motor and the screw's bearings",
                                             .viscous = "viscous friction of the motor",
                                             .coulomb_from = "estimate: 1 % of rated torque"};

Parameters mechanics(LinearAxisData& data, const LinearAxisSources& from) {
  return {
      live(row("mass", "kg", "mass of the carriage with all that it carries", data.mass, 1e-3, 1e5,
               from.mass)),
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
      row("stop.damping", "N s/m", "damping of an end stop", data.stop.damping, 0, 1e7, from.stop_damping),
  };
}

Parameters picture(LinearAxisData& data) {
  return {
      row("heading", "deg", "direction of the axis in plan: 0 with the line, 90 away from the operator",
          data.heading, -360, 360, "with the line"),
      row("place.x", "mm", "picture: where position 0 is along the line; on a carrier, from its carriage",
          data.place_x, -1e5, 1e5, "at the cut"),
      row("place.y", "mm", "picture: height of the beam over the web", data.place_y, -900, 1e5,
          "height of the web"),
      row("place.z", "mm", "picture: across the line, towards the operator", data.place_z, -1e5, 1e5,
          "middle of the line"),
      row("carrier", "picture: the linear axis whose carriage carries this one; its mass is to include it",
          data.carrier, "linear_axis", "it stands on the floor", false),
      row("motor", "picture: the end of the axis where the motor is", data.motor, {"lower", "upper"},
          "behind the home switch"),
      row("tool", "picture: what the carriage carries", data.tool, {"none", "guide", "blade", "pen"},
          "bare carriage"),
  };
}

}  // namespace

Parameters linear_axis_parameters(LinearAxisData& data, const LinearAxisSources& from) {
  return joined(
      mechanics(data, from), screw_parameters(data, "none is named: losses are not counted"),
      group("motor_friction.", shaft_friction_parameters(data.motor_friction, motor_and_screw)),
      group(
          "carriage_friction.",
          joined(guide_friction_parameters(data.guide_friction, {.dry = "dry friction of the guides",
                                                                 .viscous = "viscous friction of the guides",
                                                                 .coulomb_from = from.coulomb,
                                                                 .breakaway_from = from.breakaway}),
                 guide_coefficient_parameters(data))),
      axis_transducer_parameters(data.sensors),
      axis_drive_parameters(data.drive, {.servo = {.inertia_ratio = from.inertia_ratio}}),
      group("gear.",
            transmission_parameters(
                data.gear, {.stiffness = "estimate: 100 N/um of screw, nut and bearings, lead 20 mm"})),
      picture(data));
}

// Its motor may hang on the drive of another axis.
Parameters LinearAxisDefinition::parameters() {
  Parameters rows = linear_axis_parameters(data);
  const auto drive =
      std::find_if(rows.begin(), rows.end(), [](const Parameter& row) { return row.name == "drive"; });
  drive->choices.emplace_back("shared");
  Parameters shared = group("shared.", shared_drive_parameters(data.drive.shared, "linear_axis"));
  rows.insert(drive + 1, std::make_move_iterator(shared.begin()), std::make_move_iterator(shared.end()));
  return rows;
}

std::vector<PlantDefinition::Objection> LinearAxisDefinition::of_all(double h) const {
  AxisObjections found("carriage", h);
  const double inertia = motor_inertia(data, data.drive.rotor_inertia());
  found.screw(data, inertia);
  found.add(encoder_objections(data.sensors.encoder));
  found.guided("carriage_friction.viscous", data, inertia);
  found.add(axis_drive_objections(data.drive, inertia, h));
  return found.take();
}

// A shared drive's motor is known with its axis: objections_with().
std::vector<PlantDefinition::Objection> LinearAxisDefinition::objections(double h) {
  const bool shared = data.drive.kind == "shared";
  const auto& lender = data.drive.shared.drive;
  if (!shared && lender != no_plant)
    return {{"plant.parameters-contradict"_code, "shared.drive", "its own drive is named too",
             "drive: shared, or leave out shared.drive"}};
  if (!shared) return of_all(h);
  if (lender != no_plant) return {};
  return {{"plant.parameters-contradict"_code, "shared.drive", "no axis is named whose drive it shares",
           "shared: {drive: NAME}"}};
}

std::vector<PlantDefinition::Objection> LinearAxisDefinition::objections_with(const FindDefinition& find,
                                                                              double h) {
  if (data.drive.kind != "shared" || data.drive.shared.drive == no_plant) return {};
  const auto* lender = dynamic_cast<const LinearAxisDefinition*>(find(data.drive.shared.drive));
  if (lender == nullptr) return {};  // told by whoever looks for it
  const auto& kind = lender->data.drive.kind;
  if (lender == this || kind == "shared")
    return {{"plant.parameters-contradict"_code, "shared.drive",
             fmt::format("{} has no drive of its own", data.drive.shared.drive),
             "name the axis that has the drive"}};
  if (kind != "servo" && kind != "inverter")
    return {{"plant.parameters-contradict"_code, "shared.drive",
             fmt::format("the drive of {} is {}", data.drive.shared.drive, kind),
             "a servo or an inverter may be shared"}};
  data.drive.share(lender->data.drive);
  return of_all(h);
}

std::unique_ptr<Plant> LinearAxisDefinition::build(World& world,
                                                   const std::function<Plant*(std::string_view)>& find) {
  const LinearAxis* carrier = data.carrier == no_plant ? nullptr
                                                       : &referred<LinearAxis>(find, "carrier", data.carrier,
                                                                               "linear_axis", ", or none");
  LinearAxis* lender = nullptr;
  if (data.drive.kind == "shared" && data.drive.shared.drive != no_plant) {
    lender = &referred<LinearAxis>(find, "shared.drive", data.drive.shared.drive, "linear_axis");
    data.drive.share(lender->drive_data());
  }
  return std::make_unique<LinearAxis>(data, world, carrier, lender);
}

}  // namespace drycut::plants
