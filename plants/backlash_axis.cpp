#include "plants/backlash_axis.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "base/units.hpp"
#include "plants/stiff_pair.hpp"

namespace drycut::plants {

namespace {

// Rows of the linear axis that the flanks replace, and the carrier: this axis stands on the floor.
bool replaced(std::string_view name) {
  return name.starts_with("nut.") || name == "gear.stiffness" || name == "gear.damping" ||
         name == "gear.backlash" || name == "carrier";
}

}  // namespace

// With m the reduced inertia and time in units of the root of m/k, the flank pushes with x + min(x, 2 zeta
// v). While the damper is held to the spring's force the motion is a sine of frequency root 2; it ends where
// x = 2 zeta v. From there on it is the damped oscillation, until x = -2 zeta v: the flanks part without
// pulling. The speeds at both ends of the second part differ by what the first has taken, and what is left is
// the decay over the angle between the two points.
double restitution_of(double zeta) {
  const double wd = std::sqrt(1 - zeta * zeta);
  const double in = std::atan2(1 + 2 * zeta * zeta, 2 * zeta * wd);
  const double out = std::atan2(1 - 2 * zeta * zeta, 2 * zeta * wd);
  return std::exp(-zeta / wd * (in + out));
}

double damping_ratio_for(double restitution) {
  double low = 0;
  double high = 0.999;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (restitution_of(middle) > restitution ? low : high) = middle;
  }
  return restitution >= 1 ? 0 : low;
}

BacklashAxisDefinition::BacklashAxisDefinition() {
  axis.data.mass = 100;
  axis.data.guide_friction = {150, 100, 50, 0.01};
  axis.data.drive.servo.inertia_ratio = 0.25;
  apply_flanks(flanks, axis.data);
}

void apply_flanks(const FlankData& flanks, LinearAxisData& axis) {
  TransmissionData& gear = axis.gear;
  const double metre = axis.lead / units::turn;  // of travel for a radian of the screw
  const double screw = axis.drive.rotor_inertia() * gear.ratio * gear.ratio + axis.screw_inertia;
  const double motor_mass = screw / (metre * metre);
  const double damping = 2 * damping_ratio_for(flanks.restitution) *
                         std::sqrt(flanks.stiffness * reduced(axis.mass, motor_mass));
  gear.stiffness = flanks.stiffness * metre * metre;
  gear.damping = damping * metre * metre;
  gear.backlash = flanks.gap / metre;
}

void BacklashAxis::parameters_changed() {
  apply_flanks(flanks_, data_);
  LinearAxis::parameters_changed();
}

Parameters backlash_axis_parameters(FlankData& flanks, LinearAxisData& axis) {
  Parameters carried =
      linear_axis_parameters(axis, {.mass = "a worn machine's heavy slide",
                                    .stop_damping = "estimate: 7 % of critical for 100 kg",
                                    .coulomb = "estimate: plain guides, 0.15 of the weight of 100 kg",
                                    .breakaway = "estimate: plain guides stick",
                                    .inertia_ratio = "the default screw and load on the motor"});
  std::erase_if(carried, [](const Parameter& p) { return replaced(p.name); });
  return joined({live(row("gap", "mm", "whole play between motor and load, as travel of the load", flanks.gap,
                          1e-3, 100, "a worn nut; new ones have 0.05")),
                 live(row("contact.stiffness", "N/m", "stiffness behind a flank: nut, screw and bearings",
                          flanks.stiffness, 1e3, 1e10, "estimate: ball screw 25 x 20")),
                 live(row("contact.restitution", "",
                          "speed of parting over speed of meeting at a flank, no drive acting",
                          flanks.restitution, 0.3, 1, "estimate: greased steel flanks"))},
                std::move(carried));
}

std::vector<PlantDefinition::Objection> BacklashAxisDefinition::objections(double h) {
  apply_flanks(flanks, axis.data);
  std::vector<Objection> found = axis.objections(h);
  for (Objection& objection : found)
    if (objection.parameter == "gear.stiffness" || objection.parameter == "gear.damping")
      objection.parameter = "contact.stiffness";
  return found;
}

std::unique_ptr<Plant> BacklashAxisDefinition::build(World& world,
                                                     const std::function<Plant*(std::string_view)>& find) {
  (void)find;
  apply_flanks(flanks, axis.data);
  return std::make_unique<BacklashAxis>(flanks, axis.data, world);
}

}  // namespace drycut::plants
