#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/output_folder.hpp"
#include "sim/studies/tune/search.hpp"
#include "sim/studies/tune/study.hpp"
#include "sim/studies/tune/trials.hpp"

namespace drycut::sim::studies {

/// All that a tuning found out.
struct Tuning {
  const Study& study;
  const Trials& trials;
  std::vector<std::optional<double>> present;  ///< values before, where the scenario says them
  Verdict before;
  std::size_t best = 0;
  std::vector<Slice> slices;
  const Trials* spread = nullptr;    ///< trials of the tuned values over spread parameters
  std::vector<KeptRun> runs_before;  ///< one a scenario
  std::vector<KeptRun> runs_after;
};

/// What is to be known before anything else where nothing keeps the limits; "" where the best does.
std::string miss_text(const Tuning& tuning);
/// Before and after, the values, the surroundings, the spread: for the terminal.
std::string summary_text(const Tuning& tuning);
/// Draws plots/ and writes report.html in `folder`. Throws std::runtime_error if something cannot be written.
void write_tuning_report(const Tuning& tuning, OutputFolder& folder);

/// Index of the worst trial of the spread.
std::size_t worst_of(const Trials& spread);

}  // namespace drycut::sim::studies
