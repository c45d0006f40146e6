#pragma once
#include <cstddef>
#include <functional>
#include <vector>

namespace drycut::sim::studies {

/// What a trial with some of the differences came to. Unresolved: it could not be run, or failed otherwise.
enum class TrialCame { passed, failed, unresolved };

/// Numbers of differences, ascending.
using Subset = std::vector<std::size_t>;

/// Tries sets of differences that know nothing of each other, and answers each. Fewer answers than sets:
/// there is no budget for the rest, nor for any later one.
using TrySets = std::function<std::vector<TrialCame>(const std::vector<Subset>&)>;

struct LeastSet {
  Subset set;
  bool minimal = false;  ///< without any single one of them it does not fail; else the budget ended before
};

/// A least set of `count` differences that fails, where all of them fail and none of them passes: delta
/// debugging (ddmin; Zeller and Hildebrandt, Simplifying and Isolating Failure-Inducing Input, 2002). The
/// sets that are tried depend on the answers alone.
LeastSet least_failing(std::size_t count, const TrySets& try_sets);

}  // namespace drycut::sim::studies
