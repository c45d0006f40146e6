#pragma once
#include <string>

#include "base/table.hpp"
#include "sim/output_folder.hpp"
#include "sim/studies/compare/measured.hpp"

namespace drycut::sim::studies {

/// A row a channel: what the run leaves of what was measured.
Table residual_table(const MeasuredRun& measured);

/// The sentence of its verdict.
std::string residual_sentence(const MeasuredRun& measured);

/// Writes comparison.csv, verdict.json and, with `pictures`, plots/ and report.html into `folder`, which
/// tells `hints` too, the explained_table(). Returns the exit status: 1 where a tolerance was given and is
/// exceeded. Throws std::runtime_error if something cannot be written.
int write_measured(const MeasuredRun& measured, const Table& hints,
                   const std::vector<std::string>& tolerances, OutputFolder& folder, bool pictures);

}  // namespace drycut::sim::studies
