#include "plants/counter_drum.hpp"

namespace drycut::plants {

Parameters counter_drum_parameters(CounterDrumData& data) {
  return {
      row("drum",
          "what is geared to the drum under the web: none; smooth = an anvil drum; blades = a second knife "
          "drum, "
          "whose blades meet those of the first in the middle of the web",
          data.kind, {"none", "smooth", "blades"}, "a fixed anvil"),
      live(row("inertia", "kg m2", "inertia of the counter drum with its blades and gear wheels, on its axis",
               data.inertia, 1e-5, 1e4, "estimate: as the default drum")),
      row("ratio", "",
          "turns of the counter drum for one of the knife drum; its circumference goes with that", data.ratio,
          0.05, 20, "two equal drums"),
      live(row("friction.coulomb", "N m", "dry friction of its bearings, seals and gear wheels, on its axis",
               data.friction.coulomb, 0, 1e5, "estimate: as the default drum")),
      live(row("friction.viscous", "N m s/rad", "viscous friction of the counter drum, on its axis",
               data.friction.viscous, 0, 1e4, "estimate: as the default drum")),
  };
}

double geared_inertia(double knife_drum, const CounterDrumData& counter) {
  return counter.turns() ? knife_drum + counter.inertia * counter.ratio * counter.ratio : knife_drum;
}

Friction geared_friction(const Friction& knife_drum, const CounterDrumData& counter) {
  Friction friction = knife_drum;
  if (!counter.turns()) return friction;
  friction.coulomb += counter.friction.coulomb * counter.ratio;
  friction.viscous += counter.friction.viscous * counter.ratio * counter.ratio;
  return friction;
}

}  // namespace drycut::plants
