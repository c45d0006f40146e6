#pragma once
#include "sim/studies/cluster/engine.hpp"
#include "sim/studies/cluster/workers.hpp"

namespace drycut::sim::cluster {

/// A run that has ended whoever ran it so often is not tried again.
inline constexpr int most_deaths = 3;

/// Has a round run by `engine`: in chunks of the runs' measured cost, first single ones. What a chunk that
/// was lost had not answered goes again: the run that was under way alone, the others together. `jobs`
/// threads read. Throws std::runtime_error if the engine's machines cannot run anything, and Interrupted.
void dispatch(const Round& round, Engine& engine, int jobs);

}  // namespace drycut::sim::cluster
