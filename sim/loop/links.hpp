#pragma once
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "base/problem.hpp"
#include "devices/controller.hpp"
#include "plants/plant.hpp"
#include "sim/loop/names.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::loop {

/// True if a wire goes from plant to plant, {load.speed: axis.speed}: what stands at its terminal is a
/// plant's.
bool joins_plants(const scenario::Wire& wire, const scenario::Scenario& scenario);

/// The wires from plant to plant: a setting, reference, command or count of pulses takes what another plant's
/// channel has at the end of the step before, in its own unit. That is how a foreign model has part in a
/// line, and how one that is a controller drives it.
class Links {
 public:
  /// What does not fit is reported with its place. From now on `names` knows what is driven; also of the
  /// inputs of foreign models that the controller drives.
  Links(const scenario::Scenario& scenario, const std::vector<NamedPlant>& plants, Names& names,
        Problems& problems);

  /// Once a step, before the plants drive.
  void run() {
    for (const auto& link : links_) link.write(link.read() * link.factor + link.offset);
  }

 private:
  struct Link {
    std::function<double()> read;
    double factor = 1;  // from the channel's unit to SI
    double offset = 0;
    std::function<void(double)> write;
  };
  friend class Linker;
  std::vector<Link> links_;
};

}  // namespace drycut::sim::loop
