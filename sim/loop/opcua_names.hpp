#pragma once
#include "sim/loop/known_events.hpp"
#include "sim/loop/names.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::loop {

/// Says which names of the scenario's section opcua stand for nothing.
void check_opcua_names(const scenario::Scenario& scenario, Names& names,
                       const std::vector<KnownEvent>& events, Problems& problems);

}  // namespace drycut::sim::loop
