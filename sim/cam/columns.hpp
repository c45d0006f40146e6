#pragma once
#include <string>
#include <vector>

namespace drycut::sim {

/// Columns of text, as wide as their widest cells; numbers to the right, words to the left.
class Columns {
 public:
  /// One flag a column: true for words.
  explicit Columns(std::vector<bool> words) : words_(std::move(words)) {}
  void add(std::vector<std::string> cells) { lines_.push_back(std::move(cells)); }
  [[nodiscard]] std::string text() const;
  [[nodiscard]] const std::vector<std::vector<std::string>>& lines() const { return lines_; }

 private:
  std::vector<bool> words_;
  std::vector<std::vector<std::string>> lines_;
};

}  // namespace drycut::sim
