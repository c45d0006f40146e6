#pragma once
#include <string>
#include <vector>

#include "sim/studies/compare/run_folder.hpp"

namespace drycut::sim::studies {

/// Whether `wanted` is the channel, or as "Axis.*" what it begins with.
bool is_named(const std::string& wanted, const std::string& channel);

/// Leaves channels out of all runs: "gbTour", or "Axis.*" for all that begin so. A name that no run has is a
/// problem.
void leave_out(std::vector<ComparedRun>& runs, const std::vector<std::string>& names, Problems& problems);

/// Lays all runs over the first, stretch by stretch: `mark` is an event ("knife.cut", "cut") or a channel,
/// and a stretch begins each time it happens, or changes. The n-th stretch of each run then begins when it
/// does in the first; what a run does longer than the first is not looked at, what it does shorter stays as
/// it ended. Channels are taken at the nearest record instant. A mark that a run never has is a problem.
void align(std::vector<ComparedRun>& runs, const std::string& mark, Problems& problems);

}  // namespace drycut::sim::studies
