#include "base/sheet.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <numeric>

#include "base/json.hpp"
#include "base/text.hpp"

namespace drycut {

namespace {

constexpr std::size_t margin = 2;  ///< blanks before every column

/// Broken at blanks into lines of `width` characters; a longer word has a line of its own.
std::vector<std::string_view> wrapped(std::string_view text, std::size_t width) {
  std::vector<std::string_view> lines;
  while (characters(text) > width) {
    auto end = text.find(' ');
    if (end == std::string_view::npos) break;
    for (auto next = end; characters(text.substr(0, next)) <= width; next = text.find(' ', next + 1))
      end = next;
    lines.push_back(text.substr(0, end));
    text = trimmed(text.substr(end));
  }
  lines.push_back(text);
  return lines;
}

/// The widest columns give way until the line fits or all have only room for their longest word.
void fit(std::vector<std::size_t>& widths, const std::vector<std::size_t>& least, std::size_t width) {
  auto whole = std::accumulate(widths.begin(), widths.end(), margin * widths.size());
  for (; whole > width; --whole) {
    std::size_t* widest = nullptr;
    for (std::size_t i = 0; i < widths.size(); ++i)
      if (widths[i] > least[i] && (widest == nullptr || widths[i] > *widest)) widest = &widths[i];
    if (widest == nullptr) return;
    --*widest;
  }
}

/// What would end a cell or begin markup in it.
std::string markdown_cell(std::string_view cell) {
  std::string safe;
  for (const char c : cell) {
    if (std::string_view("|*_<\\").find(c) != std::string_view::npos) safe += '\\';
    safe += c == '\n' ? ' ' : c;
  }
  return safe;
}

}  // namespace

std::size_t characters(std::string_view text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::size_t output_width() {
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  const char* columns = std::getenv("COLUMNS");
  const std::string_view text = columns == nullptr ? "" : columns;
  std::size_t width = 0;
  std::from_chars(text.data(), text.data() + text.size(), width);
  return width;
}

std::string in_columns(const std::vector<std::vector<std::string>>& rows, std::size_t width,
                       const std::vector<bool>& right) {
  std::vector<std::size_t> widths;
  std::vector<std::size_t> longest_words;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    longest_words.resize(widths.size());
    for (std::size_t i = 0; i < row.size(); ++i) {
      widths[i] = std::max(widths[i], characters(row[i]));
      for (const auto word : wrapped(row[i], 0))
        longest_words[i] = std::max(longest_words[i], characters(word));
    }
  }
  if (width > 0) fit(widths, longest_words, width);
  std::string text;
  for (const auto& row : rows) {
    std::vector<std::vector<std::string_view>> cells;
    std::size_t height = 1;
    for (std::size_t i = 0; i < row.size(); ++i)
      height = std::max(height, cells.emplace_back(wrapped(row[i], widths[i])).size());
    for (std::size_t number = 0; number < height; ++number) {
      std::string line;
      for (std::size_t i = 0; i < row.size(); ++i) {
        const auto part = number < cells[i].size() ? cells[i][number] : std::string_view();
        const std::string gap(widths[i] - characters(part), ' ');
        const bool at_right = i < right.size() && right[i];
        line.append(margin, ' ').append(at_right ? gap : "").append(part).append(at_right ? "" : gap);
      }
      line.erase(line.find_last_not_of(' ') + 1);
      text += line + '\n';
    }
  }
  return text;
}

std::string Sheet::Cell::plain(const Json& value) {
  if (value.is_null()) return "";
  if (value.is_string()) return value.get<std::string>();
  if (value.is_array()) return listed(value.get<std::vector<std::string>>());
  return json_text(value);
}

Sheet::Sheet(std::string key, std::string title, const std::vector<std::string>& columns)
    : key_(std::move(key)), title_(std::move(title)) {
  for (const auto& column : columns) {
    const auto equals = column.find('=');
    keys_.push_back(column.substr(0, equals));
    headings_.push_back(equals == std::string::npos ? column : column.substr(equals + 1));
  }
}

std::vector<std::vector<std::string>> Sheet::shown() const {
  std::vector<std::vector<std::string>> lines(1);
  for (const auto& heading : headings_)
    if (!heading.empty()) lines.front().push_back(heading);
  for (const auto& row : rows_) {
    std::vector<std::string> cells;
    bool empty = true;
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (headings_[i].empty()) continue;
      empty = empty && row[i].text.empty();
      cells.push_back(row[i].text);
    }
    if (!empty) lines.push_back(std::move(cells));
  }
  return lines;
}

std::string Sheet::text(std::size_t width) const {
  if (title_.empty()) return "";
  const auto lines = shown();
  return lines.size() == 1 ? "" : fmt::format("\n{}\n{}", title_, in_columns(lines, width));
}

std::string Sheet::markdown() const {
  const auto lines = shown();
  if (lines.size() == 1) return "";
  auto text = title_.empty() ? "\n" : fmt::format("\n## {}\n\n", title_);
  for (const auto& line : lines) {
    for (const auto& cell : line) text += "| " + markdown_cell(cell) + ' ';
    text += "|\n";
    if (&line != &lines.front()) continue;
    for (std::size_t i = 0; i < line.size(); ++i) text += "|---";
    text += "|\n";
  }
  return text;
}

Json Sheet::json() const {
  auto made = Json::array();
  for (const auto& row : rows_) {
    auto object = Json::object();
    for (std::size_t i = 0; i < row.size(); ++i)
      if (!keys_[i].empty() && !row[i].value.is_null()) object[keys_[i]] = row[i].value;
    if (!object.empty()) made.push_back(std::move(object));
  }
  return made;
}

}  // namespace drycut
