#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/compare/comparison.hpp"
#include "sim/compare/overlays.hpp"

namespace drycut::sim {

/// What a comparison's page tells besides the comparison itself.
struct ComparisonPage {
  std::string title;
  std::string source;               ///< what was compared: a scene's file, folders
  std::vector<Figure> figures;      ///< asked for by name, shown first
  std::vector<CheckResult> checks;  ///< over the figures of the runs
  std::optional<bool> passed;       ///< absent: nothing is judged, only compared
  std::string verdict;
  std::vector<OverlayRequest> overlays;  ///< before the usual ones
};

/// Writes comparison.csv and, with `pictures`, plots/ and report.html into `folder`; what an earlier
/// comparison left there goes. Throws std::runtime_error if something cannot be drawn or written.
void write_comparison(const Comparison& comparison, const ComparisonPage& page,
                      const std::filesystem::path& folder, bool pictures);

/// What differs, for a terminal: a line a check, a parameter.
std::string comparison_text(const Comparison& comparison);

}  // namespace drycut::sim
