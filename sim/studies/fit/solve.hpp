#pragma once
#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

namespace drycut::sim::studies {

/// A value that a fit looks for.
struct FitUnknown {
  double start = 0;
  double low = 0;  ///< least and largest value that may be tried
  double high = 0;
  /// As a mass: known only where its limits are narrower than itself, and it is worth half a percent of the
  /// whole.
  bool never_zero = false;

  [[nodiscard]] bool is_held() const { return low == high; }
};

/// What a set of values leaves unexplained, a block a recording: weighted, at equal intervals of time. All
/// sets give blocks of the same sizes.
using Residuals = std::vector<Eigen::VectorXd>;
/// Residuals of many sets of values at once; a set that no machine can have gives no blocks.
using ResidualsOf = std::function<std::vector<Residuals>(const std::vector<std::vector<double>>& sets)>;

/// How well a value is known. joined: with others only; no: hardly anything depends on it.
enum class FitKnown { yes, joined, no };

struct FitEstimate {
  double value = 0;
  double low = 0;  ///< it lies between these with 95 %
  double high = 0;
  FitKnown known = FitKnown::yes;
  std::vector<std::size_t> with = {};  ///< joined: the numbers of the others
  std::vector<double> alone = {};      ///< as each recording alone would have it
};

struct FitSolution {
  std::vector<FitEstimate> estimates;
  double norm = 0;       ///< root of the sum of squares that is left
  double condition = 0;  ///< largest singular value of the unit columns over the least
  std::size_t runs = 0;  ///< sets of values tried
};

/// The values with the least sum of squares of residuals, by Levenberg-Marquardt, and how well they are
/// known. Residuals of neighbouring instants are alike, so the limits are those of Newey and West, with the
/// quantiles of Kiefer and Vogelsang (2005) for lags up to a tenth of a block. Values whose columns depend
/// on each other (a condition index above 30: Belsley) are not told apart. `whole`: norm of what was
/// measured, in the unit of the residuals; what changes less than a twentieth of it within its limits
/// counts as known, whatever its value. What is held is no part of all that. The search ends after
/// `most_trials` at the latest. Throws std::runtime_error if the start gives no residuals.
FitSolution solve_fit(const std::vector<FitUnknown>& unknowns, const ResidualsOf& residuals, double whole,
                      int most_trials = 60);

}  // namespace drycut::sim::studies
