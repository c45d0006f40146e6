#include "devices/plcopen/tab_file.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace drycut::devices::plcopen {
namespace {

bool blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

}  // namespace

Word word_at(std::string_view line, int number, std::size_t begin, std::size_t end) {
  while (begin < end && blank(line[begin])) ++begin;
  while (end > begin && blank(line[end - 1])) --end;
  return {std::string(line.substr(begin, end - begin)), {number, static_cast<int>(begin) + 1}};
}

Words split(std::string_view line, int number, char separator) {
  Words words;
  std::size_t begin = 0;
  while (true) {
    const std::size_t end = std::min(line.find(separator, begin), line.size());
    words.push_back(word_at(line, number, begin, end));
    if (end == line.size()) return words;
    begin = end + 1;
  }
}

std::optional<double> number_of(std::string_view text, bool decimal_comma) {
  std::string digits(text);
  if (decimal_comma) std::replace(digits.begin(), digits.end(), ',', '.');
  const auto value = parsed<double>(std::string_view(digits).substr(digits.starts_with('+') ? 1 : 0));
  return value && std::isfinite(*value) ? value : std::nullopt;
}

void TableReader::fault(Code code, Place place, std::string what, std::string remedy) {
  complain(code, place, std::move(what), std::move(remedy));
  ++faults_;
}

void TableReader::row(McCamTable& table, const Words& words, bool decimal_comma) {
  const TableType* type = table_type(table.type);
  if (type == nullptr || type->columns == 0) return;
  if (static_cast<int>(words.size()) != type->columns)
    return fault("cam.value"_code, words.front().place, fmt::format("{} numbers", words.size()),
                 fmt::format("a line of type {} ({}) has {}{}", type->number, type->meaning, type->columns,
                             words.front().text.find(';') != std::string::npos ? ", with commas between them"
                             : type->columns > 1 && static_cast<int>(words.size()) == 2 * type->columns
                                 ? "; decimals stand behind a point"
                                 : ""));
  rows_.push_back(words.front().place.line);
  for (const Word& word : words) {
    const std::optional<double> value = number_of(word.text, decimal_comma);
    if (!value) {
      fault("cam.value"_code, word.place, fmt::format("'{}' is no number", word.text), "write digits");
    } else if (type->whole &&
               (*value != std::round(*value) || *value > type->limit || *value < -type->limit - 1)) {
      fault("cam.value"_code, word.place, fmt::format("{} does not fit {}", word.text, type->meaning),
            fmt::format("write a whole number, {} to {}", -type->limit - 1, type->limit));
    }
    table.values.push_back(value.value_or(0));
  }
}

void TableReader::out_of_range(const Word& word, std::string remedy) {
  if (word.text.find("${") == std::string::npos)
    return fault("cam.value"_code, word.place, fmt::format("'{}' is out of range", word.text),
                 std::move(remedy));
  fault("cam.table-form"_code, word.place, fmt::format("'{}' has its value from a scenario", word.text),
        "name it: drycut cam --scene SCENARIO.yaml");
}

std::optional<int> TableReader::whole(const Word& word, int min, int max) {
  const std::optional<double> value = number_of(word.text, false);
  if (value && *value == std::round(*value) && *value >= min && *value <= max)
    return static_cast<int>(*value);
  out_of_range(word, fmt::format("write a whole number, {} to {}", min, max));
  return std::nullopt;
}

std::optional<double> TableReader::real(const Word& word, double min, double max) {
  const std::optional<double> value = number_of(word.text, false);
  if (value && *value >= min && *value <= max) return value;
  out_of_range(word, fmt::format("write a number, {} to {}", min, max));
  return std::nullopt;
}

}  // namespace drycut::devices::plcopen
