#pragma once
#include <vector>

#include "renders/plots.hpp"
#include "sim/studies/tune/report.hpp"

namespace drycut::sim::studies {

/// Before and after of everything that metric and constraints look at, a plot a scenario; the way of the
/// search; the surroundings; the spread.
std::vector<renders::Plot> tuning_plots(const Tuning& tuning);

}  // namespace drycut::sim::studies
