#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "sim/studies/compare/allowance.hpp"
#include "sim/studies/compare/run_folder.hpp"

namespace drycut::sim::studies {

// What several runs have in common and where they differ. Every row has an entry a run, in the order of the
// runs; what a run does not have is absent, or NaN among numbers.

/// A number that is told of every run.
struct Figure {
  std::string name;  ///< "knife.cut length: mean"
  std::string unit;
  std::vector<double> numbers;  ///< NaN: the run has none
};
/// True if the runs have not all the same number, or not all one.
bool differs(const Figure& figure);

/// A figure that is further from the first run's than is allowed.
struct FigureFault {
  std::string name;
  std::string unit;
  double difference = 0;  ///< infinite where a run has none
  double allowed = 0;
};
std::vector<FigureFault> figures_beyond(const std::vector<Figure>& figures, const Allowances& allowances);

/// A check, matched by its name.
struct CheckRow {
  std::string name;
  std::vector<std::optional<record::CheckResult>> results;
  /// "" = the same everywhere, margins within what is allowed; else "only in A", "verdict", "expectation",
  /// "margin" and, of two runs, by how much.
  std::string change;
};
std::vector<CheckRow> compare_checks(const std::vector<ComparedRun>& runs, const Allowances& allowances);

/// Events with values that any run has: number, mean, standard deviation (of a sample), least, greatest,
/// slope from one to the next; where a plot of a run states limits: the limits, the value nearest to a limit
/// or farthest beyond it, Cpk. All of them behind the start-up (window_of). Where pieces come in lots of
/// several lengths, the statistics are those of each lot. What happens once a run has its value alone, and
/// stands last.
std::vector<Figure> compare_events(const std::vector<ComparedRun>& runs, std::optional<double> from);

/// The lengths of pieces by their order behind the start-up: the first of each run, the second, ...
struct PieceRows {
  std::string event;  ///< "knife.cut"
  std::string unit;
  std::vector<std::vector<double>> runs;  ///< lengths of each
};
std::vector<PieceRows> compare_pieces(const std::vector<ComparedRun>& runs, std::optional<double> from);

/// A channel that two runs at least have in the same unit.
struct ChannelRow {
  std::string name;
  std::string unit;
  std::vector<double> rms;   ///< behind the start-up
  std::vector<double> peak;  ///< largest absolute value there
  /// Largest difference to the first run that has it, over the instants that both have recorded.
  double difference = 0;
  double at = 0;       ///< [s] where that is
  std::size_t in = 0;  ///< and in which run
  double allowed = 0;  ///< so much of a difference is none
  [[nodiscard]] bool is_kept() const { return difference <= allowed; }
};
/// Differences are looked for from `from` [s] on, else over the whole run.
std::vector<ChannelRow> compare_channels(const std::vector<ComparedRun>& runs, std::optional<double> from,
                                         const Allowances& allowances);
/// Channels that only one run has, or that have another unit there: "LX3VP: DD1025 [-]".
std::vector<std::string> unmatched_channels(const std::vector<ComparedRun>& runs);

/// The same event of each run: the n-th of its source.
struct EventRow {
  std::string name;                              ///< "knife.cut 3"
  std::vector<std::optional<std::string>> told;  ///< "5.218000 s: length=800 mm; ..."
};
/// Events that not all runs have, or that are further from the first run's than is allowed, in time or a
/// value; `all` is how many were looked at.
std::vector<EventRow> differing_events(const std::vector<ComparedRun>& runs, const Allowances& allowances,
                                       std::size_t& all);

/// A parameter in force, by its path in the scenario.
struct ParameterRow {
  std::string path;
  std::vector<std::optional<std::string>> values;
};
/// Parameters that have not the same value in all runs.
std::vector<ParameterRow> differing_parameters(const std::vector<ComparedRun>& runs);

}  // namespace drycut::sim::studies
