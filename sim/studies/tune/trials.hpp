#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/studies/cluster/workers.hpp"
#include "sim/studies/kept_lines.hpp"
#include "sim/studies/tune/parameter.hpp"
#include "sim/studies/tune/study.hpp"

namespace drycut::sim::studies {

/// Every set of values that was tried, in order, kept in a CSV file: a study that is run again takes from the
/// file what it has and runs only the rest. The file does not depend on the number of jobs.
class Trials {
 public:
  struct Trial {
    std::string phase;  ///< "present", "sample", "search", "around", "spread"
    Point point;
    Verdict verdict;
  };
  /// `fixed` is set before the point's values; `workers` run what is not in the file, a number of jobs is so
  /// many threads here; `progress` is told the runs so far. Throws std::runtime_error if the file cannot be
  /// written.
  Trials(const Study& study, TunedParameters parameters, std::vector<scenario::Override> fixed,
         const std::filesystem::path& file, cluster::Workers workers, std::function<void(int)> progress = {});

  /// Tries all of `points`, several at the same time; returns the index of each in trials(). `to_beat`: see
  /// measure().
  std::vector<std::size_t> run(const std::string& phase, const std::vector<Point>& points,
                               double to_beat = std::numeric_limits<double>::infinity());

  [[nodiscard]] const std::vector<Trial>& trials() const { return trials_; }
  [[nodiscard]] const Trial& at(std::size_t index) const { return trials_[index]; }
  [[nodiscard]] bool has(const Point& point) const { return index_.contains(point); }
  [[nodiscard]] const TunedParameters& parameters() const { return parameters_; }
  /// Sets of values that were not found in the file.
  [[nodiscard]] int simulated() const { return simulated_; }
  /// Why each set of values that was lost was; it stands as stopped, and is not kept.
  [[nodiscard]] const std::vector<std::string>& lost() const { return lost_; }
  /// Simulated runs of all trials, those in the file included.
  [[nodiscard]] int runs() const;
  /// Simulated runs that one more set of values may take.
  [[nodiscard]] int runs_of_a_trial() const { return study_.runs_of_a_trial(); }
  [[nodiscard]] bool measures_loop() const { return study_.needs_loop; }
  /// Whether the loop was measured for `verdict`.
  [[nodiscard]] bool has_loop(const Verdict& verdict) const {
    return verdict.runs > static_cast<int>(study_.cases.size());
  }
  /// Simulated runs that measured the loop.
  [[nodiscard]] int loop_runs() const;
  /// Index of the best so far; the earlier of two equals. There must be a trial.
  [[nodiscard]] std::size_t best() const;

 private:
  [[nodiscard]] std::optional<Trial> trial_of(std::string_view line) const;
  void append(const Trial& trial);
  [[nodiscard]] std::string heading() const;
  [[nodiscard]] std::string fingerprint() const;

  const Study& study_;
  TunedParameters parameters_;
  std::vector<scenario::Override> fixed_;
  cluster::Workers workers_;
  std::function<void(int)> progress_;
  std::map<Point, Verdict> kept_;  ///< of the file, not asked for yet
  std::size_t rows_ = 0;           ///< in the file
  std::vector<Trial> trials_;
  std::map<Point, std::size_t> index_;
  int simulated_ = 0;
  std::vector<std::string> lost_;
  KeptLines lines_;  ///< reads the members above
};

/// Answers the trials of a study as Trials asks them elsewhere: JSON in, the row's cells behind the values
/// out. Throws std::runtime_error if the study is none.
std::function<std::string(const std::string& ask)> trial_answerer(const std::string& question);

/// Looks for the values with the least metric that keep all limits: a Latin hypercube over two fifths of the
/// runs that are left, several at the same time; then subplex (NLopt) from the best, and from the next best
/// that lies elsewhere when it has converged. What has been tried before takes part. One set of values is
/// always tried; beyond that `trials` never come to more than `most_runs` simulated runs. Ends at the first
/// loop that is measured if nothing can be told of it. The way depends on `seed` and `most_runs` alone.
/// Whether the descent that found the best came to a bottom before its runs were used up.
bool search(Trials& trials, int most_runs, std::uint64_t seed);

/// True if nothing could be told of the first loop that was measured, for what else moves or for play: so it
/// will be with all others.
bool is_unmeasurable(const Trials& trials);

/// How the metric changes when one parameter at a time is moved by a share of its range.
struct Slice {
  std::size_t parameter = 0;
  double share = 0;  ///< of the range, -0.1 .. 0.1
  std::size_t trial = 0;
};
/// Tries the surroundings of trial `best`, ±10 % of each range at most, as long as `trials` come to no more
/// than `most_runs` simulated runs: at +-5 % first, none if not even those fit. Where something better shows
/// up there, `best` moves and the surroundings are tried again (at most eight times).
std::vector<Slice> look_around(Trials& trials, std::size_t& best, int most_runs);

}  // namespace drycut::sim::studies
