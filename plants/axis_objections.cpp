#include "plants/axis_objections.hpp"

#include <fmt/format.h>

#include <numbers>

namespace drycut::plants {

void AxisObjections::object(std::string_view parameter, std::string what, std::string remedy) {
  found_.push_back({std::string(parameter), std::move(what), std::move(remedy)});
}

void AxisObjections::gear(const TransmissionData& gear, double motor_inertia, double load_inertia) {
  if (stable(gear, motor_inertia, load_inertia, usual_step)) return;
  object("gear.stiffness",
         fmt::format("motor and {} oscillate at {:.0f} Hz, or are damped so hard that steps of 100 us cannot "
                     "follow",
                     what_moves_, resonance(gear, motor_inertia, load_inertia) / (2 * std::numbers::pi)),
         "a softer gear, less damping or more inertia");
}

void AxisObjections::viscous(std::string_view parameter, const Friction& friction, double inertia,
                             std::string_view unit) {
  if (friction.viscous * usual_step <= inertia) return;
  object(parameter,
         fmt::format("{:g} {} brakes faster than steps of 100 us can follow", friction.viscous, unit),
         fmt::format("at most {:g} {}", inertia / usual_step, unit));
}

// Stiff spring and damper on a mass, explicit steps: k h2 + 2 c h < 4 m.
void AxisObjections::contact(std::string_view parameter, const EndStopData& stop, double mass,
                             std::string_view what) {
  if (stop.stiffness * usual_step * usual_step + 2 * stop.damping * usual_step < 4 * mass) return;
  object(parameter,
         fmt::format("the {} bounces off the {} faster than steps of 100 us can follow", what_moves_, what),
         fmt::format("a softer {}, less damping or more mass", what));
}

void AxisObjections::travel(double travel_min, double travel_max, double start) {
  if (travel_max <= travel_min)
    object("travel_max", "it is not above travel_min", "leave room between the end stops");
  else if (start < travel_min || start > travel_max)
    object("start", fmt::format("the {} starts at {:g} mm, in an end stop", what_moves_, start * 1000),
           fmt::format("between {:g} and {:g} mm", travel_min * 1000, travel_max * 1000));
}

void AxisObjections::limit_switches(double limit_min, double limit_max) {
  if (limit_max <= limit_min)
    object("limit_max", "it is not above limit_min", "leave room between the limit switches");
}

void AxisObjections::add(std::vector<PlantDefinition::Objection> more) {
  for (auto& objection : more) found_.push_back(std::move(objection));
}

}  // namespace drycut::plants
