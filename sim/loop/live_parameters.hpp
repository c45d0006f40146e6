#pragma once
#include <optional>
#include <string>

#include "devices/value_range.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::loop {

// Parameters of plants that a scenario changes in mid-run, seen from their definitions.

/// Why `name`, "knife.circumference", cannot be set in mid-run, if it is a parameter that is not live.
std::optional<devices::ValueFault> fixed_parameter(const scenario::Scenario& scenario,
                                                   const std::string& name);

/// What the plants object to if the live parameter `name` becomes `si`: a spring that is too stiff for the
/// step. Nothing if `name` is none.
std::optional<devices::ValueFault> objection_to(const scenario::Scenario& scenario, const std::string& name,
                                                double si);

}  // namespace drycut::sim::loop
