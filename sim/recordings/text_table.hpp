#pragma once
#include <cstddef>
#include <cstdint>
#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace drycut::sim::recordings {

/// How the cells of a delimited text are told apart and read.
struct Dialect {
  char separator = ',';
  char decimal = '.';
  bool merges_blanks = false;  ///< of the separator ' ': several in a row are one, none stands in front
};

/// The lines of a text of any length, one at a time, whatever ends them. A byte-order mark is left out.
class LineStream {
 public:
  explicit LineStream(std::istream& stream) : stream_(stream) {}
  /// False at the end. `line` is good until the next call.
  bool next(std::string_view& line);
  /// Of the line given last, from 1.
  [[nodiscard]] int number() const { return number_; }
  /// FNV-1a of all bytes that were read.
  [[nodiscard]] std::uint64_t checksum() const { return checksum_; }

 private:
  bool fill();

  std::istream& stream_;
  std::string buffer_;
  std::size_t at_ = 0;
  int number_ = 0;
  std::uint64_t checksum_ = 14695981039346656037ULL;
};

/// The cells of a line, without blanks and quotes around them; empty ones at its end are left out.
void split(std::string_view line, const Dialect& dialect, std::vector<std::string_view>& cells);

/// What a cell of data is.
struct DataCell {
  enum class Kind { number, empty, not_a_number, text };
  Kind kind = Kind::empty;
  double value = 0;
  bool is_moment = false;  ///< a time of day, with or without a date: `value` in s
};
/// "1.234,5": a sign between thousands. What "1.234" is, is not known then, so that such numbers are refused.
bool has_thousands(std::string_view text, char decimal);

/// A time of day, with or without a date, counts as a number: seconds, since 1970 if there is a date.
DataCell cell_of(std::string_view text, char decimal);
/// The same of a text that may be missing.
DataCell cell_at(const std::vector<std::string_view>& cells, std::size_t index, char decimal);

/// True if all cells of the line are data, and one of them is a number, be it with a sign between thousands.
bool is_data(std::string_view line, const Dialect& dialect);

/// The line is no data at all: blank, or the mark that TwinCAT ends a file with.
bool is_blank(std::string_view line);

/// Text of a file in UTF-8 or, where it is none, in Latin-1, as Windows' tools write it.
std::string as_utf8(std::string_view text);

}  // namespace drycut::sim::recordings
