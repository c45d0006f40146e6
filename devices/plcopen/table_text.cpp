#include "devices/plcopen/table_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

namespace drycut::devices::plcopen {
namespace {

bool blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

}  // namespace

Word trimmed(std::string_view line, std::size_t begin, std::size_t end) {
  while (begin < end && blank(line[begin])) ++begin;
  while (end > begin && blank(line[end - 1])) --end;
  return {line.substr(begin, end - begin), static_cast<int>(begin) + 1};
}

std::vector<Word> split(std::string_view line, char separator) {
  std::vector<Word> words;
  std::size_t begin = 0;
  while (true) {
    const std::size_t end = std::min(line.find(separator, begin), line.size());
    words.push_back(trimmed(line, begin, end));
    if (end == line.size()) return words;
    begin = end + 1;
  }
}

std::vector<Word> words_of(std::string_view line) {
  std::vector<Word> words;
  std::size_t i = 0;
  while (i < line.size()) {
    while (i < line.size() && blank(line[i])) ++i;
    const std::size_t begin = i;
    while (i < line.size() && !blank(line[i])) ++i;
    if (i > begin) words.push_back({line.substr(begin, i - begin), static_cast<int>(begin) + 1});
  }
  return words;
}

std::optional<double> number_of(std::string_view text, bool decimal_comma) {
  std::string digits(text);
  if (decimal_comma) std::replace(digits.begin(), digits.end(), ',', '.');
  const char* begin = digits.c_str() + (digits.starts_with('+') ? 1 : 0);
  const char* end = digits.c_str() + digits.size();
  double value = 0;
  const auto [rest, error] = std::from_chars(begin, end, value);
  if (error != std::errc{} || rest != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

void TableReader::fault(int line, int column, std::string what, std::string remedy) {
  problems_.push_back({file_, line, column, std::move(what), std::move(remedy)});
  ++faults_;
}

void TableReader::row(CamTable& table, const std::vector<Word>& words, int line, bool decimal_comma) {
  const TableType* type = table_type(table.type);
  if (type == nullptr || type->columns == 0) return;
  if (static_cast<int>(words.size()) != type->columns)
    return fault(line, words.empty() ? 1 : words.front().column, fmt::format("{} numbers", words.size()),
                 fmt::format("a line of type {} ({}) has {}", type->number, type->meaning, type->columns));
  rows_.push_back(line);
  for (const Word& word : words) {
    const std::optional<double> value = number_of(word.text, decimal_comma);
    if (!value) {
      fault(line, word.column, fmt::format("'{}' is no number", word.text), "write digits");
    } else if (type->whole &&
               (*value != std::round(*value) || *value > type->limit || *value < -type->limit - 1)) {
      fault(line, word.column, fmt::format("{} does not fit {}", word.text, type->meaning),
            fmt::format("write a whole number, {} to {}", -type->limit - 1, type->limit));
    }
    table.values.push_back(value.value_or(0));
  }
}

std::optional<int> TableReader::whole(const Word& word, int line, int min, int max) {
  const std::optional<double> value = number_of(word.text, false);
  if (value && *value == std::round(*value) && *value >= min && *value <= max)
    return static_cast<int>(*value);
  fault(line, word.column, fmt::format("'{}' is out of range", word.text),
        fmt::format("write a whole number, {} to {}", min, max));
  return std::nullopt;
}

std::optional<double> TableReader::real(const Word& word, int line, double min, double max) {
  const std::optional<double> value = number_of(word.text, false);
  if (value && *value >= min && *value <= max) return value;
  fault(line, word.column, fmt::format("'{}' is out of range", word.text),
        fmt::format("write a number, {} to {}", min, max));
  return std::nullopt;
}

}  // namespace drycut::devices::plcopen
