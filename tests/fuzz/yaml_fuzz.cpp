// Scenarios: read, built, printed with their defaults, and run for some steps. The files that they name are
// those of scenes/.
#include "sim/loop/simulation.hpp"
#include "sim/scenario/scenario.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace drycut {

DRYCUT_FUZZ(text) {
  Problems problems;
  const auto scenario =
      sim::scenario::read_scenario_text(text, DRYCUT_SOURCE_DIR "/scenes/fuzz.yaml", {}, problems);
  if (!scenario.buildable) {
    if (problems.empty()) fuzz::broken("a scenario that cannot be built has a problem");
    return;
  }
  sim::loop::Simulation simulation(scenario, problems);
  if (!problems.empty()) return;
  const auto again = sim::scenario::expand(scenario);
  Problems of_again;
  sim::scenario::read_scenario_text(again, DRYCUT_SOURCE_DIR "/scenes/fuzz.yaml", {}, of_again);
  if (!of_again.empty()) fuzz::broken("what is printed reads back: " + to_string(of_again.front()));
  constexpr int steps = 50;
  for (int i = 0; i < steps && simulation.advance(); ++i) continue;
}

}  // namespace drycut
