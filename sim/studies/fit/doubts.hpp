#pragma once
#include <vector>

#include "base/problem.hpp"
#include "sim/studies/fit/bench.hpp"

namespace drycut::sim::studies {

/// What is doubtful in recordings: coarse, slow, clipped, a sign, two channels of one motion that contradict
/// each other.
std::vector<Finding> doubts_of(const FitBench& bench);

}  // namespace drycut::sim::studies
