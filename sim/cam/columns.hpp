#pragma once
#include <cmath>
#include <string>
#include <vector>

#include "base/sheet.hpp"
#include "sim/cam/findings.hpp"

namespace drycut::sim {

/// Of a report's pieces and knots.
inline constexpr std::size_t most_lines = 60;

/// A number of a report: what is 0 but for rounding is 0.
inline std::string plain(double value) { return number_text(std::abs(value) < 1e-9 ? 0 : value, 6); }

/// Columns of text, as wide as their widest cells; numbers to the right, words to the left.
class Columns {
 public:
  /// One flag a column: true for words.
  explicit Columns(std::vector<bool> words) : numbers_(std::move(words)) { numbers_.flip(); }
  void add(std::vector<std::string> cells) { lines_.push_back(std::move(cells)); }
  [[nodiscard]] std::string text() const { return in_columns(lines_, 0, numbers_); }
  [[nodiscard]] const std::vector<std::vector<std::string>>& lines() const { return lines_; }

 private:
  std::vector<bool> numbers_;
  std::vector<std::vector<std::string>> lines_;
};

}  // namespace drycut::sim
