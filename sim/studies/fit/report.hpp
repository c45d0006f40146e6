#pragma once
#include <string>
#include <vector>

#include "base/table.hpp"
#include "sim/output_folder.hpp"
#include "sim/record/verdict.hpp"
#include "sim/studies/fit/question.hpp"
#include "sim/studies/fit/study.hpp"

namespace drycut::sim::studies {

inline constexpr auto* fit_file = "fit.json";
inline constexpr auto* fitted_file = "fitted.yaml";
/// What a fit may write into its folder.
inline const std::vector<std::string> fit_files = {fit_file, fitted_file, "report.html", "plots/",
                                                   record::verdict_file};

/// The values with their limits, a row each, those of the recordings behind them.
Table fit_table(const FitFound& found);
/// What a terminal is told.
std::string fit_text(const FitFound& found);
record::Verdict verdict_of(const FitPlan& plan, const FitFound& found);
/// The scenario with the values found: `extends` it, seen from `folder`.
std::string fitted_text(const FitPlan& plan, const FitFound& found, const std::filesystem::path& folder);

/// Writes all of it, the page and its plots only with `pictures`. Returns the exit status. Throws
/// std::runtime_error if something cannot be written.
int write_fit(const FitPlan& plan, const FitFound& found, OutputFolder& folder, bool pictures);

}  // namespace drycut::sim::studies
