#include "plants/backlash_axis.hpp"
#include "plants/bench.hpp"
#include "plants/flying_saw.hpp"
#include "plants/guest.hpp"
#include "plants/ideal_axis.hpp"
#include "plants/linear_axis.hpp"
#include "plants/plant.hpp"
#include "plants/rotary_axis.hpp"
#include "plants/rotary_knife.hpp"
#include "plants/vertical_press.hpp"
#include "plants/web.hpp"

namespace drycut::plants {

namespace {
template <class Definition>
std::unique_ptr<PlantDefinition> define() {
  return std::make_unique<Definition>();
}
}  // namespace

const std::vector<PlantType>& plant_types() {
  static const std::vector<PlantType> types = {
      {"backlash_axis", "a linear axis with play between motor and load, encoders on either side",
       define<BacklashAxisDefinition>},
      {"bench", "counters, switches and meters without physics, turned by the timeline",
       define<BenchDefinition>},
      {"flying_saw", "a saw on a carriage that clamps the running web, strip or tube, and cuts it",
       define<FlyingSawDefinition>},
      {"fmu",
       "a foreign model as an FMU, in a process of its own: a drive, a load, a controller. 'drycut plants "
       "FILE.fmu' lists "
       "its variables; units: {x: V} gives units to those that declare none",
       define<GuestDefinition>},
      {"ideal_axis", "an axis without mass: voltage is speed, exactly", define<IdealAxisDefinition>},
      {"linear_axis", "a carriage on a ball screw or belt with servo, end stops and switches",
       define<LinearAxisDefinition>},
      {"rotary_axis", "what a motor turns without end through a gear: a table, a roller, an indexer",
       define<RotaryAxisDefinition>},
      {"rotary_knife", "a servo-driven drum with blades that cuts the running web",
       define<RotaryKnifeDefinition>},
      {"vertical_press", "a ram under its weight on a screw, switched by inverter or contactors, with brake",
       define<VerticalPressDefinition>},
      {"web", "the material: line drive, measuring wheel, cut pieces on an outfeed belt",
       define<WebDefinition>},
  };
  return types;
}

}  // namespace drycut::plants
