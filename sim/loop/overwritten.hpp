#pragma once
#include <optional>
#include <string>
#include <vector>

#include "base/problem.hpp"
#include "devices/controller.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::loop {

/// Where a program writes a value before anything reads it, whatever it was: "programs/saw.mod:23"; nothing
/// where it reads the value first, or never names it.
std::optional<std::string> written_first(devices::Controller& controller, const std::string& name);

/// Values of the controller's `set` of which a run left nothing, for its program writes them first, a phrase
/// each: asked when it has run.
std::vector<Finding> overwritten(const scenario::Scenario& scenario, devices::Controller& controller);

/// The same of the value called `name` alone, after a run of its own; nothing = it stays, or is read first.
/// Of scenarios that cannot be run nothing is said.
std::optional<Finding> overwritten(const scenario::Scenario& scenario, const std::string& name);

}  // namespace drycut::sim::loop
