#include "sim/recordings/dialect.hpp"

#include <algorithm>
#include <array>

namespace drycut::sim::recordings {

namespace {

constexpr std::array separators = {'\t', ';', ',', '|', ' ', ':'};
constexpr std::array decimals = {'.', ','};

Dialect made(char separator, char decimal, bool single_blanks) {
  return {separator, decimal, separator == ' ' && !single_blanks};
}

}  // namespace

FirstLines first_lines_of(std::istream& stream) {
  constexpr std::size_t most_lines = 500;
  constexpr std::size_t most_bytes = 4U << 20U;
  FirstLines beginning;
  LineStream lines(stream);
  std::string_view line;
  std::size_t bytes = 0;
  while (lines.next(line)) {
    if (beginning.lines.size() == most_lines || bytes > most_bytes) {
      beginning.is_whole = false;
      break;
    }
    bytes += line.size();
    beginning.lines.emplace_back(line);
  }
  return beginning;
}

Block block_of(const FirstLines& beginning, const Dialect& dialect) {
  Block block;
  std::vector<std::string_view> cells;
  std::optional<std::size_t> before;
  for (std::size_t i = 0; i < beginning.lines.size(); ++i) {
    const auto& line = beginning.lines[i];
    if (is_blank(line)) continue;
    if (!is_data(line, dialect)) {
      if (block.lines < 2) before.reset();
      if (block.lines < 2) block.lines = 0;
      continue;
    }
    if (!before) {
      before = block.first = i;
      split(line, dialect, cells);
      block.width = block.cells = static_cast<int>(cells.size());
      split(beginning.lines[i - (i > 0 ? 1 : 0)], dialect, cells);
      block.cells = std::max(block.cells, static_cast<int>(cells.size()));
    }
    ++block.lines;
  }
  return block;
}

Dialect dialect_of(const FirstLines& beginning, const GivenSigns& given, bool single_blanks) {
  auto best = made(given.separator.value_or(','), given.decimal.value_or('.'), single_blanks);
  auto most = Block();
  for (const char separator : separators) {
    if (given.separator && *given.separator != separator) continue;
    if (!given.separator && separator == ':') continue;  // times of day have it
    for (const char decimal : decimals) {
      if ((given.decimal && *given.decimal != decimal) || separator == decimal) continue;
      const auto dialect = made(separator, decimal, single_blanks);
      const auto block = block_of(beginning, dialect);
      // Two cells tell more than one: a line of a single number is data in every dialect.
      const bool better =
          block.lines > most.lines || (block.lines == most.lines && most.cells < 2 && block.cells > 1);
      if (!better) continue;
      most = block;
      best = dialect;
    }
  }
  return best;
}

std::optional<HeadFault> fault_of_bytes(const FirstLines& beginning) {
  if (beginning.lines.empty()) return HeadFault{HeadFault::Kind::empty};
  const std::string_view first = beginning.lines.front();
  if (first.starts_with("\xFF\xFE") || first.starts_with("\xFE\xFF"))
    return HeadFault{HeadFault::Kind::utf16};
  int number = 0;
  for (const auto& line : beginning.lines) {
    ++number;
    const auto odd = std::find_if(line.begin(), line.end(), [](char c) {
      return static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\r' && c != '\f';
    });
    if (odd != line.end())
      return HeadFault{HeadFault::Kind::binary, number, static_cast<int>(odd - line.begin()) + 1};
  }
  return {};
}

Problem problem_of(const HeadFault& fault, const std::string& file) {
  using Kind = HeadFault::Kind;
  const auto made = [&](Code code, const char* what, const char* remedy) {
    return Problem{code, file, fault.line, fault.column, what, remedy};
  };
  switch (fault.kind) {
    case Kind::empty:
      return made("recording.no-rows"_code, "the file is empty", "export the recording again");
    case Kind::binary:
      return made("file.not-text"_code, "this is no text", "export the recording as text (CSV)");
    case Kind::utf16:
      return made("file.not-text"_code, "this is UTF-16", "save it as plain text in UTF-8");
    case Kind::ambiguous_comma:
      return made("recording.ambiguous-comma"_code,
                  "a comma stands both between cells and in numbers: more cells than columns",
                  "export it with semicolons or tabs, or with decimal points");
    case Kind::thousands:
      return made("recording.not-a-number"_code, "a sign stands between the thousands of a number",
                  "export the numbers without it: 1234,5");
    case Kind::no_data:
      break;
  }
  return made("recording.no-rows"_code, "there are no rows of data in the first lines",
              "export it as text with a row a sample");
}

}  // namespace drycut::sim::recordings
