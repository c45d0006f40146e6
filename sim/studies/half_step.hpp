#pragma once
#include <functional>
#include <optional>

#include "renders/report.hpp"
#include "sim/loop/simulation.hpp"

namespace drycut::sim::studies {

// drycut run --verify-step: the scenario once more at half its step, to see what hangs on the step.

/// What makes the scenario run at half its step; nullopt and a problem where that is no whole number of
/// nanoseconds. Every period is a multiple of the step, and so of its half.
std::optional<scenario::Override> halved_step(const scenario::Scenario& scenario, Problems& problems);

/// Runs a scenario that was read with that override; nothing is recorded or drawn. Throws std::runtime_error
/// if it cannot be put together.
record::HalfStep run_half_step(scenario::Scenario scenario, const std::function<void(Time)>& progress);

/// Check by check the margins at both steps and how far they moved. `step` is the scenario's own.
renders::ReportTable margin_table(const record::Outcome& outcome, Time step);
/// Margin at half the step less margin at the step; nullopt where one has none.
std::optional<double> moved(const record::CheckResult& check, const record::CheckResult& at_half);

}  // namespace drycut::sim::studies
