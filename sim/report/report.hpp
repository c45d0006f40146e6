#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "renders/report.hpp"
#include "sim/output_folder.hpp"
#include "sim/record/outcome.hpp"
#include "sim/record/verdict.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::report {

// What the reports of run, compare, tune and bode have in common.

/// Where a report and its plots lie in a folder of results.
inline constexpr auto* report_file = "report.html";
inline constexpr auto* plots_folder = "plots";

/// A page that begins with the verdict.
renders::Report page_of(const record::Verdict& verdict);

/// The checks with what is left of their limits.
void add_checks(const std::vector<record::CheckResult>& checks, renders::Report& report);

/// What the command line changed, a fact each.
void add_overrides(const std::vector<scenario::Override>& overrides, renders::Report& report);

/// Draws `plots` into the folder of plots and adds them, with their data, to the report. No two share a file:
/// a later one with a name that is taken gets another. Throws std::runtime_error if something cannot be
/// written.
void add_plots(std::vector<renders::Plot> plots, OutputFolder& folder, renders::Report& report);

/// Adds the plots and writes the report.
void write_report(renders::Report report, std::vector<renders::Plot> plots, OutputFolder& folder);

/// Draws one plot as the file `png`. Throws std::runtime_error if it cannot be written.
void draw_png(renders::Plot plot, const std::filesystem::path& png);

}  // namespace drycut::sim::report
