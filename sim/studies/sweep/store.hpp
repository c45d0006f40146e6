#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "sim/studies/cluster/workers.hpp"
#include "sim/studies/kept_lines.hpp"
#include "sim/studies/sweep/point.hpp"

namespace drycut::sim::studies {

/// Told how many of how many runs are done.
using StudyProgress = std::function<void(std::size_t done, std::size_t of)>;

/// Rows of points that have been run, by what they depend on, in a file that grows by a line a point: a study
/// that was interrupted, or killed, finds there what it had. Studies ask it for rounds of points; where and
/// in what order those run is known here only.
class PointStore {
 public:
  /// Takes what is in the file; a line that is cut short or damaged is left out, and its point run again.
  /// Throws std::runtime_error if it cannot be written. `workers` run what is not in it; a number of jobs is
  /// so many threads here.
  PointStore(const std::filesystem::path& file, cluster::Workers workers);

  /// The rows of points, each given by its overrides, in their order: from the file, else run now. One that
  /// was lost is a row that says so, and is not kept.
  std::vector<PointRow> rows(const PointQuestion& question,
                             const std::vector<std::vector<scenario::Override>>& points,
                             const StudyProgress& progress);
  /// Rows that were not in the file: runs, and points that no run was made of.
  [[nodiscard]] std::size_t simulated() const { return simulated_; }
  [[nodiscard]] std::size_t refused() const { return refused_; }
  /// Why each row that was lost was: "variables.end=9 s was lost: whoever ran it died, 3 times: ..."
  [[nodiscard]] const std::vector<std::string>& lost() const { return lost_; }

 private:
  cluster::Workers workers_;
  std::unordered_map<std::uint64_t, std::string> rows_;
  KeptLines lines_;
  std::size_t simulated_ = 0;
  std::size_t refused_ = 0;
  std::vector<std::string> lost_;
};

/// Answers the points of a question as a store asks them elsewhere: JSON in, the row's text out. Throws
/// std::runtime_error if the question is none.
std::function<std::string(const std::string& ask)> point_answerer(const std::string& question);

}  // namespace drycut::sim::studies
