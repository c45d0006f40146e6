#include "plants/axis_objections.hpp"

#include "base/problem.hpp"
#include "base/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace drycut::plants {

void AxisObjections::object(Code code, std::string_view parameter, std::string what, std::string remedy) {
  found_.push_back({code, std::string(parameter), std::move(what), std::move(remedy)});
}

void AxisObjections::pair(std::string_view stiffness, std::string_view damping, const StiffPair& pair,
                          std::string_view pair_name) {
  const double spring = longest_step_of_spring(pair);
  const double damper = longest_step_of_damper(pair);
  const double longest = std::min(spring, damper);
  if (h_ <= longest * (1 + 1e-9)) return;  // a step at the bound, whatever the last digit says
  const double hertz = std::sqrt(pair.stiffness / pair.inertia) / (2 * std::numbers::pi);
  const auto motion = spring <= damper
                          ? fmt::format("oscillate at {:.4g} Hz", hertz)
                          : fmt::format("settle in {:.3g} us", pair.inertia / pair.damping * 1e6);
  object("plant.step-too-long"_code, spring <= damper ? stiffness : damping,
         fmt::format("{} {}, steps of {:g} us cannot follow", pair_name, motion, h_ * 1e6),
         fmt::format("{}, or softer, less damped, heavier parts", step_remedy(longest)));
}

void AxisObjections::gear(const TransmissionData& given, double motor_inertia, double load_inertia) {
  const auto gear = with_stiffness(given, motor_inertia, load_inertia);
  pair("gear.stiffness", "gear.damping",
       {gear.stiffness, gear.damping, reduced(motor_inertia * gear.ratio * gear.ratio, load_inertia)},
       fmt::format("motor and {}", what_moves_));
  add(efficiency_objections(gear.efficiency, "gear."));
}

void AxisObjections::viscous(std::string_view parameter, const Friction& friction, double inertia,
                             std::string_view part) {
  damper(parameter, friction.viscous * std::max(1.0, friction.viscous_backward), inertia,
         fmt::format("{} and its friction", part));
}

void AxisObjections::contact(const std::string& group, const EndStopData& stop, double mass,
                             std::string_view what) {
  pair(group + ".stiffness", group + ".damping", {stop.stiffness, stop.damping, mass},
       fmt::format("{} and {}", what_moves_, what));
}

void AxisObjections::screw(const ScrewDriveData& data, double motor_inertia) {
  gear(with_stiffness(data.gear, motor_inertia, behind_gear(data)), motor_inertia, on_gear(data));
  if (data.nut_damping > 0 && data.nut_stiffness <= 0)
    object("plant.parameters-contradict"_code, "nut.damping", "the nut has no stiffness of its own",
           "nut.stiffness, or leave it out");
  if (data.nut_stiffness > 0) {
    const double metre = data.lead / units::turn;  // of travel for a radian of the screw
    pair("nut.stiffness", "nut.damping",
         {data.nut_stiffness, data.nut_damping, reduced(data.screw_inertia / (metre * metre), data.mass)},
         fmt::format("screw and {}", what_moves_));
    if (data.nut_rigid)
      object("plant.parameters-contradict"_code, "nut.rigid", "the nut has a stiffness, too",
             "leave out nut.stiffness or nut.rigid");
    if (data.screw_inertia <= 0)
      object("plant.parameters-contradict"_code, "screw_inertia", "a screw between two springs has none",
             "its inertia, or leave out nut.stiffness");
  }
  contact("stop", data.stop, data.mass, "end stop");
  add(efficiency_objections(data.efficiency, ""));
}

void AxisObjections::guided(std::string_view guides, const ScrewDriveData& data, double motor_inertia) {
  viscous("motor_friction.viscous", data.motor_friction, motor_inertia, "motor");
  viscous(guides, data.guide_friction, data.mass, what_moves_);
  if (data.travel_max <= data.travel_min)
    object("plant.parameters-contradict"_code, "travel_max", "it is not above travel_min",
           "leave room between the end stops");
  else if (data.start < data.travel_min || data.start > data.travel_max)
    object("plant.parameters-contradict"_code, "start",
           fmt::format("the {} starts at {:g} mm, in an end stop", what_moves_, data.start * 1000),
           fmt::format("between {:g} and {:g} mm", data.travel_min * 1000, data.travel_max * 1000));
  if (data.sensors.limit_max <= data.sensors.limit_min)
    object("plant.parameters-contradict"_code, "limit_max", "it is not above limit_min",
           "leave room between the limit switches");
}

void AxisObjections::add(std::vector<PlantDefinition::Objection> more) {
  for (auto& objection : more) found_.push_back(std::move(objection));
}

std::string step_remedy(double longest) {
  // 1, 2 or 5 of a decade divides the periods of controllers and records.
  const double decade = std::pow(10, std::floor(std::log10(longest * 1e9)));
  const double ns = decade * (longest * 1e9 >= 5 * decade ? 5 : longest * 1e9 >= 2 * decade ? 2 : 1);
  return fmt::format("scene.step of at most {:g} us", ns / 1e3);
}

}  // namespace drycut::plants
