#pragma once
#include <cstddef>
#include <istream>
#include <optional>
#include <string>
#include <vector>

#include "base/problem.hpp"
#include "sim/recordings/text_table.hpp"

namespace drycut::sim::recordings {

/// The first lines of a file, enough for any header.
struct FirstLines {
  std::vector<std::string> lines;
  bool is_whole = true;  ///< the file has no more
};
FirstLines first_lines_of(std::istream& stream);

/// The data among the first lines: from where a line of data follows another, or the end.
struct Block {
  std::size_t lines = 0;  ///< of data
  std::size_t first = 0;  ///< index of its first line
  int width = 0;          ///< cells of its first line
  int cells = 0;          ///< of that or of the line above, whichever has more
};
Block block_of(const FirstLines& beginning, const Dialect& dialect);

/// What is known of a dialect.
struct GivenSigns {
  std::optional<char> separator = {};
  std::optional<char> decimal = {};
};
/// The dialect in which most lines are data. `single_blanks`: of the separator ' ' each ends a cell.
Dialect dialect_of(const FirstLines& beginning, const GivenSigns& given, bool single_blanks);

/// What is wrong with a text as a table.
struct HeadFault {
  enum class Kind { empty, binary, utf16, ambiguous_comma, thousands, no_data };
  Kind kind;
  int line = 1;
  int column = 1;
};

/// In words.
Problem problem_of(const HeadFault& fault, const std::string& file);

/// What shows before any dialect is known.
std::optional<HeadFault> fault_of_bytes(const FirstLines& beginning);

}  // namespace drycut::sim::recordings
