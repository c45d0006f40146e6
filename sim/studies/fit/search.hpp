#pragma once
#include <vector>

#include "sim/studies/fit/bench.hpp"

namespace drycut::sim::studies {

// The search for the values, at several cutoffs of the filter.

/// A fit at one cutoff.
struct AtCutoff {
  double cutoff = 0;
  std::vector<double> values;
  FitSolution solution;
};

/// The fits at all cutoffs, and the one that counts.
struct Solved {
  std::vector<AtCutoff> tried;
  std::size_t best = 0;

  [[nodiscard]] const AtCutoff& chosen() const { return tried[best]; }
};

/// Where a search may begin: as the scenario has it, with springs four times as stiff and soft, and with the
/// recording late or early by some samples.
std::vector<std::vector<double>> starts_of(const FitBench& bench);
/// From the best of `starts`, at one cutoff. Throws std::runtime_error where no replay can be made, or too
/// little of the motion is of use.
AtCutoff solve_at(FitBench& bench, double cutoff, const std::vector<std::vector<double>>& starts,
                  int most_trials = 60);
/// At cutoffs that are chosen from the data.
Solved search_fit(FitBench& bench);

/// Each recording with the values found.
std::vector<Replayed> replayed_with(FitBench& bench, const AtCutoff& solved);
/// What is left unexplained of the recorded torque, rms over rms.
double error_of(const std::vector<Replayed>& all);

}  // namespace drycut::sim::studies
