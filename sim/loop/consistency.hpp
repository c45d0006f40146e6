#pragma once
#include <string>
#include <vector>

#include "devices/controller.hpp"
#include "sim/loop/bus.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::loop {

/// Where controller and machine say different things of one thing, a phrase each: counts, speeds, cams.
std::vector<std::string> contradictions(const scenario::Scenario& scenario,
                                        const std::vector<NamedPlant>& plants);

/// What is wired and looks like a slip, a phrase each: outputs that no program and no device works, one
/// encoder on two counters.
std::vector<std::string> doubtful_wires(const scenario::Scenario& scenario, devices::Controller& controller);

}  // namespace drycut::sim::loop
