#pragma once
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>

#include "sim/studies/sweep/point.hpp"

namespace drycut::sim::studies {

/// Rows of points that have been run, by what they depend on, in a file that grows by a line a point: a study
/// that was interrupted, or killed, finds there what it had. Safe to use from several threads.
class PointStore {
 public:
  /// Takes what is in the file; a line cut short is left out. Throws std::runtime_error if it cannot be
  /// written.
  explicit PointStore(const std::filesystem::path& file);

  /// The row of a point, from the file, else run now.
  PointRow row(const PointQuestion& question, const std::vector<scenario::Override>& overrides);
  /// Rows that were not in the file.
  [[nodiscard]] std::size_t simulated() const { return simulated_; }

 private:
  std::mutex mutex_;
  std::unordered_map<std::uint64_t, std::string> rows_;
  std::ofstream stream_;
  std::size_t simulated_ = 0;
};

/// Runs `work(i)` for 0 <= i < count on `jobs` threads. The first exception ends it and is thrown on.
void for_each_index(std::size_t count, int jobs, const std::function<void(std::size_t)>& work);

}  // namespace drycut::sim::studies
