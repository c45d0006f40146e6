#pragma once
#include <cstdint>
#include <optional>

#include "sim/studies/tune/trials.hpp"

namespace drycut::sim::studies {

/// Looks for the values with the least metric that keep all limits: a Latin hypercube over two fifths of
/// `budget` (and `start`, where known and inside), several runs at the same time; then subplex (NLopt) from
/// the best, and from the next best that lies elsewhere when it has converged, until `budget` simulated runs
/// would be exceeded (one set of values is always tried). Returns the index of the best trial. The way
/// depends on `seed` and `budget` alone.
std::size_t search(Trials& trials, const std::optional<Point>& start, int budget, std::uint64_t seed);

/// How the metric changes when one parameter at a time is moved by a share of its range.
struct Slice {
  std::size_t parameter = 0;
  double share = 0;  ///< of the range, -0.1 .. 0.1
  std::size_t trial = 0;
};
/// Tries the surroundings of trial `best`, ±10 % of each range at most. Where something better shows up
/// there, `best` moves and the surroundings are tried again (at most eight times).
std::vector<Slice> look_around(Trials& trials, std::size_t& best);

}  // namespace drycut::sim::studies
