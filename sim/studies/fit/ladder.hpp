#pragma once
#include "sim/studies/fit/search.hpp"
#include "sim/studies/fit/study.hpp"

namespace drycut::sim::studies {

/// Tries what each of the models above the question's own would explain besides; tells which is worth it.
void climb_ladder(const FitBench& bench, const AtCutoff& base, int jobs, FitFound& found);

}  // namespace drycut::sim::studies
