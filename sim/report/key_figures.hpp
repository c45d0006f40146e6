#pragma once
#include <string>
#include <vector>

#include "renders/report.hpp"
#include "sim/loop/known_events.hpp"
#include "sim/loop/simulation.hpp"

namespace drycut::sim::report {

/// What one wants to know first of a run, as far as it has it: pieces (whatever comes with a length), every
/// event value that a check limits (mean and standard deviation, the worst one, Cpk where there are ten or
/// more), the speeds of `lines` (names of plants), torques of the drives, and the check that is nearest to
/// its limit.
std::vector<renders::ReportKey> key_figures(const record::Recording& recording,
                                            const std::vector<loop::KnownEvent>& known_events,
                                            const std::vector<std::string>& lines,
                                            const record::Outcome& outcome, bool drives_judged);

}  // namespace drycut::sim::report
