#pragma once
#include <cstdint>

#include "sim/studies/tune/trials.hpp"

namespace drycut::sim::studies {

/// Looks for the values with the least metric that keep all limits: a Latin hypercube over two fifths of the
/// runs that are left, several at the same time; then subplex (NLopt) from the best, and from the next best
/// that lies elsewhere when it has converged. What has been tried before takes part. One set of values is
/// always tried; beyond that `trials` never come to more than `most_runs` simulated runs. Ends at the first
/// loop that is measured if nothing can be told of it. The way depends on `seed` and `most_runs` alone.
void search(Trials& trials, int most_runs, std::uint64_t seed);

/// True if nothing could be told of the first loop that was measured, for what else moves or for play: so it
/// will be with all others.
bool is_unmeasurable(const Trials& trials);

/// How the metric changes when one parameter at a time is moved by a share of its range.
struct Slice {
  std::size_t parameter = 0;
  double share = 0;  ///< of the range, -0.1 .. 0.1
  std::size_t trial = 0;
};
/// Tries the surroundings of trial `best`, ±10 % of each range at most, as long as `trials` come to no more
/// than `most_runs` simulated runs: at +-5 % first, none if not even those fit. Where something better shows
/// up there, `best` moves and the surroundings are tried again (at most eight times).
std::vector<Slice> look_around(Trials& trials, std::size_t& best, int most_runs);

}  // namespace drycut::sim::studies
