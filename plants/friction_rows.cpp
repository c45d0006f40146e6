#include "plants/friction_rows.hpp"

namespace drycut::plants {

namespace {

/// Units of effort, of effort over speed, and of speed.
struct Units {
  std::string_view effort;
  std::string_view damping;
  std::string_view speed;
};

Parameters rows_of(Friction& friction, const FrictionSources& from, const Units& units, double most) {
  return {live(row("coulomb", units.effort, from.dry, friction.coulomb, 0, most, from.coulomb_from)),
          live(row("viscous", units.damping, from.viscous, friction.viscous, 0, most, from.viscous_from)),
          live(row("breakaway", units.effort, "what dry friction is more at standstill (Stribeck)",
                   friction.breakaway, 0, most, from.breakaway_from)),
          row("stribeck_speed", units.speed, "speed at which 1/e of it is left", friction.stribeck_speed,
              1e-3, 1e5, "estimate"),
          live(row("backward", "%", "dry friction of a motion backwards, of that forwards", friction.backward,
                   0, 1000, "the same both ways")),
          live(row("viscous_backward", "%", "viscous friction of a motion backwards, of that forwards",
                   friction.viscous_backward, 0, 1000, "the same both ways"))};
}

}  // namespace

Parameters shaft_friction_parameters(Friction& friction, const FrictionSources& from) {
  return rows_of(friction, from, {"N m", "N m s/rad", "rpm"}, 1e5);
}

Parameters guide_friction_parameters(Friction& friction, const FrictionSources& from) {
  return rows_of(friction, from, {"N", "N s/m", "mm/s"}, 1e6);
}

}  // namespace drycut::plants
