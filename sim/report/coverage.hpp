#pragma once
#include <string>

#include "devices/coverage.hpp"
#include "renders/report.hpp"
#include "sim/loop/simulation.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::report {

/// lcov's table of what has run, of a scenario and over all of a call.
inline constexpr auto* coverage_file = "coverage.info";

/// What has run of the controller's programs, which were counted; files as seen from the current folder.
devices::Coverage coverage_of(const scenario::Scenario& scenario, const loop::Simulation& simulation);

/// A row a file: lines that ran of those that can, ways of decisions that were taken, the lines that never
/// ran. No rows where nothing was counted.
renders::ReportTable coverage_table(const loop::Simulation& simulation);

/// "41 of 50 lines ran (82 %), 12 of 16 branches", over all files.
std::string coverage_text(const devices::Coverage& coverage);

}  // namespace drycut::sim::report
