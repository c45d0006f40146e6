#pragma once
#include <string>
#include <vector>

#include "base/problem.hpp"
#include "sim/loop/bus.hpp"
#include "sim/loop/known_events.hpp"
#include "sim/loop/names.hpp"
#include "sim/loop/watch.hpp"
#include "sim/record/recording.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::loop {

/// Where the names that a scenario wants recorded and drawn are looked up.
struct Lookup {
  const scenario::Scenario& scenario;
  const std::vector<NamedPlant>& plants;
  const Names& names;
  Watch& watch;
  const std::vector<KnownEvent>& plant_events;
  const std::vector<KnownEvent>& all_events;  ///< with those of timeline and controller
};

/// The numbers below a film: one a caption channel, then one a lamp.
struct Captions {
  std::vector<const double*> slots;
  std::vector<std::string> units;
  /// Where the plant is to go, in a unit of so many metres; no plant: nothing is drawn.
  struct Quota {
    const plants::Plant* plant = nullptr;
    const double* slot = nullptr;
    double metres = 1;
  };
  Quota quota = {};
};

/// Adds to the recording what is to be recorded, then what the pictures need. What is not there, and what in
/// the pictures does not fit, goes to `problems`.
Captions bind_recording(const Lookup& lookup, record::Recording& recording, Problems& problems);

/// What of a plant is recorded for the picture of its motor: speed, then torque.
std::vector<std::string> motor_channels(const std::string& plant);

}  // namespace drycut::sim::loop
