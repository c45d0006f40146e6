#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/scanner.hpp"
#include "devices/plcopen/cam_table.hpp"

// What the readers of cam files share: lines, words with their places, numbers, rows.
namespace drycut::devices::plcopen {

/// line[begin, end) without the blanks around it; the line's `number` is from 1.
Word word_at(std::string_view line, int number, std::size_t begin, std::size_t end);
Words split(std::string_view line, int number, char separator);
/// A finite number, or nullopt.
std::optional<double> number_of(std::string_view text, bool decimal_comma);

/// What the readers do with a text: faults, and rows into a table.
class TableReader : private Complaints {
 public:
  using Complaints::Complaints;

  void fault(Place place, std::string what, std::string remedy);
  [[nodiscard]] bool sound() const { return faults_ == 0; }
  /// A line of numbers of the table's type.
  void row(CamTable& table, const Words& words, bool decimal_comma);
  /// Line of the file of each row.
  [[nodiscard]] const std::vector<int>& rows() const { return rows_; }
  /// A whole number in its range, or nullopt with a fault.
  std::optional<int> whole(const Word& word, int min, int max);
  /// A number in its range, or nullopt with a fault.
  std::optional<double> real(const Word& word, double min, double max);

 private:
  void out_of_range(const Word& word, std::string remedy);

  int faults_ = 0;
  std::vector<int> rows_;
};

}  // namespace drycut::devices::plcopen
