#pragma once
#include <charconv>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/problem.hpp"

// What the readers of texts have in common, whatever the controller: names in any case, lines, complaints.
namespace drycut {

/// Where something stands in a text, both 1-based; a tab is one column.
struct Place {
  int line = 0;
  int column = 0;
};

/// A file of a program.
struct SourceFile {
  std::string name;
  std::string text;
};

/// The lines of all files of a program, counted on from each file to the next: one number says file and line.
class SourceLines {
 public:
  SourceLines() = default;
  explicit SourceLines(std::span<const SourceFile> files);

  struct At {
    std::size_t file = 0;
    int line = 0;  ///< in that file, from 1
  };
  [[nodiscard]] At at(int line) const;
  /// The number of a file's first line.
  [[nodiscard]] int first(std::size_t file) const { return begins_.at(file); }
  /// Of all files.
  [[nodiscard]] int count() const { return end_ - 1; }
  /// "line 5", or where that is another file than that of line `seen_from`, "line 5 of knife.st".
  [[nodiscard]] std::string told(int line, int seen_from) const;

 private:
  std::vector<int> begins_;
  std::vector<std::string> names_;
  int end_ = 1;
};

/// The text in small letters, ASCII only: names and keywords of every controller are the same in any case.
std::string lower(std::string_view text);
std::string upper(std::string_view text);
bool same_word(std::string_view a, std::string_view b);
bool is_one_of(const auto& words, std::string_view word) {
  for (const std::string_view known : words)
    if (same_word(known, word)) return true;
  return false;
}
bool is_letter(char c);  ///< a..z, A..Z or _
bool is_digit(char c);
bool in_name(char c);  ///< a letter, digit or _
/// A letter or _ followed by letters, digits and _.
bool is_identifier(std::string_view text);

/// The lines of a text, LF or CRLF, without their ends.
std::vector<std::string_view> split_lines(std::string_view text);

struct Word {
  std::string text;
  Place place;
};
using Words = std::vector<Word>;
/// What stands between the `gaps` of a line that begins at `begin`.
Words split_words(std::string_view line, Place begin, std::string_view gaps);

/// All of `text` as a number; nothing if it is none or out of the type's range.
template <typename Number>
std::optional<Number> parsed(std::string_view text, auto... base) {
  Number number{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number, base...);
  return error == std::errc{} && stop == end ? std::optional(number) : std::nullopt;
}

/// "1 piece", "2 pieces".
std::string counted(std::int64_t count, std::string_view noun);
/// `text` between quotes for a message: cut if long, unprintable bytes as \xNN.
std::string in_quotes(std::string_view text);
/// "did you mean posit?" for the nearest candidate, or `otherwise` if none is near.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates,
                         const std::string& otherwise);
/// The same, or all candidates if none is near: "known: posit, vel".
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);
/// The same with the candidate in quotes, as the controllers' own tools have it: "did you mean 'posit'?".
std::string suggestion(std::string_view word, const std::vector<std::string>& candidates,
                       const std::string& otherwise);
/// "A, B, C".
std::string listed(const std::vector<std::string>& items);
/// Without the blanks around it (spaces, tabs, CR); what is left is a piece of `text`, even of no length.
std::string_view trimmed(std::string_view text);
/// Windows' editors begin a UTF-8 text with a byte order mark.
std::string_view without_byte_order_mark(std::string_view text);

/// A cell of a CSV file: between quotes where it has to be.
std::string csv_cell(std::string_view text);
/// Text of XML or HTML, outside of tags or between double quotes.
std::string xml_text(std::string_view text);

/// Sorts the problems from index `first` on by line and column, keeping the order of equals.
void sort_from(Problems& problems, std::size_t first);

}  // namespace drycut
