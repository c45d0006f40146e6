#pragma once
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "sim/studies/sweep/point.hpp"

namespace drycut::sim::studies {

/// Told how many of how many runs are done.
using StudyProgress = std::function<void(std::size_t done, std::size_t of)>;

/// Rows of points that have been run, by what they depend on, in a file that grows by a line a point: a study
/// that was interrupted, or killed, finds there what it had. Studies ask it for rounds of points; where and
/// in what order those run is known here only.
class PointStore {
 public:
  /// Takes what is in the file; a line cut short is left out. Throws std::runtime_error if it cannot be
  /// written. `jobs` run at the same time.
  PointStore(const std::filesystem::path& file, int jobs);

  /// The rows of points, each given by its overrides, in their order: from the file, else run now.
  std::vector<PointRow> rows(const PointQuestion& question,
                             const std::vector<std::vector<scenario::Override>>& points,
                             const StudyProgress& progress);
  /// Rows that were not in the file.
  [[nodiscard]] std::size_t simulated() const { return simulated_; }

 private:
  PointRow row(const PointQuestion& question, const std::vector<scenario::Override>& overrides);

  int jobs_;
  std::mutex mutex_;
  std::unordered_map<std::uint64_t, std::string> rows_;
  std::ofstream stream_;
  std::size_t simulated_ = 0;
};

}  // namespace drycut::sim::studies
