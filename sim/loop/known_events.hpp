#pragma once
#include <string>
#include <utility>
#include <vector>

#include "base/problem.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::loop {

/// An event that something in the scenario can report, with its values and their units.
struct KnownEvent {
  std::string source;
  std::string name;
  std::vector<std::pair<std::string, std::string>> values;
  bool is_failure = false;  ///< it fails a run none of whose checks looks at it
};

/// What the timeline and any controller report besides the plants' own events; these have no values.
std::vector<KnownEvent> events_of_every_run();

/// "cut" names the event of any source, "knife.cut" that of one.
bool names_event(const std::string& wanted, const std::string& source, const std::string& event);

/// The first of `events` that `wanted` names; nullptr after a problem that tells the nearest one.
const KnownEvent* find_event(const std::vector<KnownEvent>& events, const scenario::Text& wanted,
                             const scenario::Scenario& scenario, Problems& problems);

}  // namespace drycut::sim::loop
