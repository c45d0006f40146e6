#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/problem.hpp"
#include "base/text.hpp"
#include "devices/plcopen/cam_table.hpp"

// What the readers of cam files share: lines, words with their places, numbers, rows.
namespace drycut::devices::plcopen {

/// A word of a line with its place.
struct Word {
  std::string_view text;
  int column = 0;  ///< 1-based
};

/// line[begin, end) without the blanks around it.
Word trimmed(std::string_view line, std::size_t begin, std::size_t end);
std::vector<Word> split(std::string_view line, char separator);
/// Words between blanks.
std::vector<Word> words_of(std::string_view line);
/// A finite number, or nullopt.
std::optional<double> number_of(std::string_view text, bool decimal_comma);

/// What the readers do with a text: faults, and rows into a table.
class TableReader {
 public:
  TableReader(std::string file, Problems& problems) : file_(std::move(file)), problems_(problems) {}

  void fault(int line, int column, std::string what, std::string remedy);
  [[nodiscard]] bool sound() const { return faults_ == 0; }
  /// A line of numbers of the table's type.
  void row(CamTable& table, const std::vector<Word>& words, int line, bool decimal_comma);
  /// Line of the file of each row.
  [[nodiscard]] const std::vector<int>& rows() const { return rows_; }
  /// A whole number in its range, or nullopt with a fault.
  std::optional<int> whole(const Word& word, int line, int min, int max);
  /// A number in its range, or nullopt with a fault.
  std::optional<double> real(const Word& word, int line, double min, double max);

 private:
  std::string file_;
  Problems& problems_;
  int faults_ = 0;
  std::vector<int> rows_;
};

}  // namespace drycut::devices::plcopen
