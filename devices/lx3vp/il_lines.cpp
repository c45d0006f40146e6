#include "devices/lx3vp/il_lines.hpp"

#include <algorithm>
#include <optional>

#include "base/text.hpp"

namespace drycut::devices::lx3vp::il {

namespace {

constexpr std::string_view gaps = " \t\r,";

// Lines.

bool is_step_number(std::string_view word) {
  if (word.ends_with(':')) word.remove_suffix(1);
  return !word.empty() && std::all_of(word.begin(), word.end(), is_digit);
}

/// Takes brackets off around the words; they are told if they do not match.
void take_brackets(Statement& words, const TellLine& tell) {
  const Word first = words.front();
  const bool opens = first.text.front() == '[';
  const bool closes = words.back().text.ends_with(']');
  if (!opens && !closes) return;
  if (opens != closes) {
    tell("il.syntax"_code, first.place, opens ? "'[' is not closed" : "']' was not opened",
         "write [MOV K5 D0]");
    words.clear();
    return;
  }
  words.back().text.pop_back();
  words.front().text.erase(0, 1);
  ++words.front().place.column;
  std::erase_if(words, [](const Word& word) { return word.text.empty(); });
  if (words.empty())
    tell("il.syntax"_code, first.place, "there is nothing between the brackets", "write [MOV K5 D0]");
}

Statement statement_of(std::string_view line, int number, const TellLine& tell) {
  line = line.substr(0, std::min({line.find(';'), line.find("//"), line.size()}));
  Statement words = split_words(line, {number, 1}, gaps);
  if (words.size() > 1 && is_step_number(words.front().text)) words.erase(words.begin());
  if (!words.empty()) take_brackets(words, tell);
  return words;
}

// Tables.

struct TableCell {
  std::string text;
  int column = 1;
};

std::vector<TableCell> cells_of(std::string_view line, char separator) {
  std::vector<TableCell> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    auto& cell = cells.back();
    if (line[i] == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
      cell.text += line[i++];
    } else if (line[i] == '"') {
      quoted = !quoted;
      if (quoted && cell.text.empty()) cell.column = static_cast<int>(i) + 2;
    } else if (line[i] == separator && !quoted) {
      cells.push_back({{}, static_cast<int>(i) + 2});
    } else {
      cell.text += line[i];
    }
  }
  return cells;
}

/// Where a table has what.
struct TableColumns {
  char separator = ',';
  std::size_t heading = 0;  ///< its line, from 0
  std::size_t instruction = 0;
  std::size_t operand = 0;      ///< the first
  std::size_t operand_end = 0;  ///< one behind the last
};

bool names_operand(std::string_view name) {
  return name.starts_with("I/O") || name.starts_with("DEVICE") || name.starts_with("OPERAND");
}

/// Operands have a column, or some side by side: named as such, or without a name, also behind the heading.
std::size_t end_of_operands(const std::vector<TableCell>& heading, std::size_t first) {
  for (std::size_t c = first + 1; c < heading.size(); ++c) {
    const auto name = upper(trimmed(heading[c].text));
    if (!name.empty() && (!names_operand(name) || name.find("COMMENT") != std::string::npos)) return c;
  }
  return std::string_view::npos;
}

std::optional<TableColumns> columns_of(const std::vector<std::string_view>& lines) {
  constexpr std::size_t most = 20;  // titles before the heading
  for (std::size_t i = 0; i < std::min(most, lines.size()); ++i) {
    for (const char separator : {'\t', ',', ';'}) {
      const auto cells = cells_of(lines[i], separator);
      TableColumns columns{separator, i, cells.size(), cells.size()};
      for (std::size_t c = cells.size(); c-- > 0;) {
        const auto name = upper(cells[c].text);
        if (name == "INSTRUCTION") columns.instruction = c;
        if (names_operand(name)) columns.operand = c;
      }
      if (columns.instruction == cells.size() || columns.operand == cells.size()) continue;
      columns.operand_end = end_of_operands(cells, columns.operand);
      return columns;
    }
  }
  return std::nullopt;
}

std::vector<Statement> rows_of(const std::vector<std::string_view>& lines, const TableColumns& columns,
                               const TellLine& tell) {
  std::vector<Statement> statements;
  for (std::size_t i = columns.heading + 1; i < lines.size(); ++i) {
    const auto cells = cells_of(lines[i], columns.separator);
    const int line = static_cast<int>(i) + 1;
    Statement words;
    const auto take = [&](const TableCell& cell) {
      const Words more = split_words(cell.text, {line, cell.column}, gaps);
      words.insert(words.end(), more.begin(), more.end());
    };
    if (columns.instruction < cells.size()) take(cells[columns.instruction]);
    const bool continues = words.empty();
    for (auto c = columns.operand; c < std::min(columns.operand_end, cells.size()); ++c) take(cells[c]);
    if (words.empty()) continue;  // a note or a title
    if (!continues)
      statements.push_back(std::move(words));
    else if (!statements.empty())
      statements.back().insert(statements.back().end(), words.begin(), words.end());
    else
      tell("il.syntax"_code, {line, words.front().place.column},
           "an operand stands before the first instruction", "name the instruction in its column");
  }
  return statements;
}

}  // namespace

std::vector<Statement> statements_of(std::string_view text, const TellLine& tell) {
  const auto lines = split_lines(text);
  if (const auto columns = columns_of(lines)) return rows_of(lines, *columns, tell);
  std::vector<Statement> statements;
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (auto words = statement_of(lines[i], static_cast<int>(i) + 1, tell); !words.empty())
      statements.push_back(std::move(words));
  return statements;
}

bool is_table(std::string_view text) { return columns_of(split_lines(text)).has_value(); }

}  // namespace drycut::devices::lx3vp::il
