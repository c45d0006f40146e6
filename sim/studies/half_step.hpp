#pragma once
#include <functional>
#include <optional>

#include "renders/report.hpp"
#include "sim/loop/simulation.hpp"

namespace drycut::sim {

// drycut run --verify-step: the scenario once more at half its step, to see what hangs on the step.

/// What makes the scenario run at half its step; nullopt and a problem where that is no whole number of
/// nanoseconds. Every period is a multiple of the step, and so of its half.
std::optional<Override> halved_step(const Scenario& scenario, Problems& problems);

/// Runs a scenario that was read with that override; nothing is recorded or drawn. Throws std::runtime_error
/// if it cannot be put together.
HalfStep run_half_step(Scenario scenario, const std::function<void(Time)>& progress);

/// Check by check the margins at both steps and how far they moved. `step` is the scenario's own.
renders::ReportTable margin_table(const Outcome& outcome, Time step);
/// Margin at half the step less margin at the step; nullopt where one has none.
std::optional<double> moved(const CheckResult& check, const CheckResult& at_half);

}  // namespace drycut::sim
