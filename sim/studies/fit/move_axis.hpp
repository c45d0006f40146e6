#pragma once
#include <optional>

#include "sim/studies/fit/bench.hpp"
#include "sim/studies/fit/move.hpp"

namespace drycut::sim::studies {

/// The axis of a plan, in a machine that is a source of torque. A carriage is moved to its middle there.
std::optional<MoveAxis> move_axis(scenario::Scenario& machine, const FitQuestion& question,
                                  Problems& problems);

}  // namespace drycut::sim::studies
