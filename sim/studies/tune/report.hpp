#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/output_folder.hpp"
#include "sim/record/verdict.hpp"
#include "sim/studies/tune/present.hpp"
#include "sim/studies/tune/study.hpp"
#include "sim/studies/tune/trials.hpp"

namespace drycut::sim::studies {

/// All that a tuning found out. `best` is the best set of values that was tried; the answer is that, or the
/// present values if they are not worse.
struct Tuning {
  const Study& study;
  const Trials& trials;
  std::vector<PresentValue> present;  ///< of the values before
  Verdict before = {};
  std::size_t best = 0;
  std::optional<Point> start = {};    ///< the present values, if all are known: the first of `trials`
  std::optional<double> unlike = {};  ///< the metric where values are given that the program sets, if another
  bool stays = false;                 ///< the present values are the answer
  bool unmeasurable = false;          ///< ended at the first loop that was measured
  bool settled = true;                ///< the search came to a bottom before its runs were used up
  std::vector<Slice> slices = {};
  const Trials* spread = nullptr;         ///< trials of the tuned values over spread parameters
  std::vector<KeptRun> runs_before = {};  ///< one a scenario
  std::vector<KeptRun> runs_after = {};
  int budget = 0;                                      ///< [simulated runs]
  std::vector<std::pair<std::string, int>> used = {};  ///< simulated runs of each part
  int spread_asked = 0;  ///< machines; fewer were tried where the budget had no room

  /// The answer's verdict.
  [[nodiscard]] const Verdict& after() const { return stays ? before : trials.at(best).verdict; }
  /// The answer, if it is known: present values that the program sets are not.
  [[nodiscard]] std::optional<Point> answer() const { return stays ? start : trials.at(best).point; }
};

/// What is to be known before anything else: that nothing keeps the limits, that the present values stay,
/// that nothing could be measured; "" where better values were found. A sentence or two.
std::string miss_text(const Tuning& tuning);
/// "97 of at most 200: present values 3, search 82, ...".
std::string runs_text(const Tuning& tuning);
/// Before and after, the values, the surroundings, the spread: for the terminal.
std::string summary_text(const Tuning& tuning);
/// What came of it.
record::Verdict verdict_of(const Tuning& tuning);
/// Draws plots/ and writes report.html in `folder`. Throws std::runtime_error if something cannot be written.
void write_tuning_report(const Tuning& tuning, OutputFolder& folder);

/// Index of the worst trial of the spread.
std::size_t worst_of(const Trials& spread);

}  // namespace drycut::sim::studies
