#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/problem.hpp"
#include "sim/cams/csv.hpp"
#include "sim/record/recording.hpp"

namespace drycut::sim::studies {

/// The remedy for a file of results that is not as it was written.
inline constexpr auto* run_again = "run the scenario again: drycut run writes the file";

/// A row of a CSV file: its cells without the quotes around them.
struct CsvRow {
  struct Cell {
    std::string text;
    int column = 1;
  };
  std::vector<Cell> cells;
  int line = 1;
};

/// Takes the rows of a file of results one after the other; cells in quotes may hold commas, quotes and line
/// ends.
class CsvRows {
 public:
  CsvRows(std::string_view text, cams::TableProblems& problems) : text_(text), problems_(problems) {}
  /// False at the end.
  bool next(CsvRow& row);

 private:
  CsvRow::Cell cell();
  CsvRow::Cell quoted_cell(CsvRow::Cell cell);

  std::string_view text_;
  cams::TableProblems& problems_;
  std::size_t at_ = 0;
  std::size_t begin_ = 0;  ///< of the row
  int line_ = 1;
};

/// A text as a cell in quotes, in one line.
std::string csv_quoted(const std::string& text);

/// The number that a text is, all of it.
std::optional<double> number_of(std::string_view text);

// trace.csv and events.csv read back (sim/loop/recorder.hpp writes them). `file` names the text in messages;
// what is wrong goes to `problems`, and then the result is not to be used.

/// The channels of a run: first column `time [s]`, ascending, then `channel [unit]`.
record::Recording read_trace(std::string_view text, const std::string& file, Problems& problems);
/// Adds the events of a run to its recording. Times have nine digits behind the point, values nine in all.
void read_events(std::string_view text, const std::string& file, record::Recording& recording,
                 Problems& problems);

}  // namespace drycut::sim::studies
