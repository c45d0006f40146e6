#pragma once
#include <optional>
#include <string>
#include <vector>

#include "sim/output_folder.hpp"
#include "sim/record/verdict.hpp"
#include "sim/studies/compare/comparison.hpp"
#include "sim/studies/compare/overlays.hpp"

namespace drycut::sim::studies {

/// What a comparison's page tells besides the comparison itself.
struct ComparisonPage {
  std::string title;
  std::string source;                       ///< what was compared: a scene's file, folders
  std::vector<std::string> scenarios = {};  ///< a scene's file
  std::vector<Figure> figures;              ///< asked for by name, shown first
  std::vector<record::CheckResult> checks;  ///< over the figures of the runs
  std::optional<bool> passed;               ///< absent: nothing is judged, only compared
  std::string verdict;
  std::vector<OverlayRequest> overlays;      ///< before the usual ones
  std::vector<std::string> tolerances = {};  ///< that were given: "length=0.01mm"
};

/// What a comparison may write into its folder.
inline const std::vector<std::string> comparison_files = {"comparison.csv", "report.html", "plots/",
                                                          record::verdict_file};

/// Writes comparison.csv, verdict.json and, with `pictures`, plots/ and report.html into `folder`. Returns
/// the exit status. Throws std::runtime_error if something cannot be written.
int write_comparison(const Comparison& comparison, const ComparisonPage& page, OutputFolder& folder,
                     bool pictures);

/// What differs, for a terminal: a line a check, a parameter; of what is `judged` also channels, and the
/// first events.
std::string comparison_text(const Comparison& comparison, bool judged);

}  // namespace drycut::sim::studies
