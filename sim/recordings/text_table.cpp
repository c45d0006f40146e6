#include "sim/recordings/text_table.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <limits>

#include "base/plain_text.hpp"
#include "base/text.hpp"

namespace drycut::sim::recordings {

bool LineStream::fill() {
  constexpr std::size_t block = 1U << 20U;
  buffer_.erase(0, at_);
  at_ = 0;
  const auto had = buffer_.size();
  buffer_.resize(had + block);
  stream_.read(buffer_.data() + had, block);
  const auto got = static_cast<std::size_t>(stream_.gcount());
  buffer_.resize(had + got);
  for (std::size_t i = had; i < buffer_.size(); ++i)
    checksum_ = (checksum_ ^ static_cast<unsigned char>(buffer_[i])) * 1099511628211ULL;
  return got > 0;
}

bool LineStream::next(std::string_view& line) {
  auto end = buffer_.find('\n', at_);
  constexpr std::size_t longest = 64U << 20U;  // what is longer is no text
  while (end == std::string::npos && buffer_.size() - at_ < longest) {
    const auto seen = buffer_.size() - at_;
    if (!fill()) break;
    end = buffer_.find('\n', seen);
  }
  if (end == std::string::npos && at_ == buffer_.size()) return false;
  const auto stop = std::min(end, buffer_.size());
  line = std::string_view(buffer_).substr(at_, stop - at_);
  at_ = std::min(stop + 1, buffer_.size());
  if (number_++ == 0) line = without_byte_order_mark(line);
  while (line.ends_with('\r')) line.remove_suffix(1);
  return true;
}

namespace {

std::string_view without_quotes(std::string_view cell) {
  if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"') return cell.substr(1, cell.size() - 2);
  return cell;
}

/// Where the cell that begins at `at` ends; a separator between quotes ends none.
std::size_t end_of_cell(std::string_view line, std::size_t at, char separator) {
  const auto first = line.find_first_not_of(' ', at);
  if (first != std::string_view::npos && line[first] == '"' && separator != '"') {
    const auto closing = line.find('"', first + 1);
    if (closing != std::string_view::npos) at = closing + 1;
  }
  return std::min(line.find(separator, at), line.size());
}

}  // namespace

void split(std::string_view line, const Dialect& dialect, std::vector<std::string_view>& cells) {
  cells.clear();
  std::size_t at = 0;
  while (at < line.size()) {
    if (dialect.merges_blanks) {
      at = line.find_first_not_of(" \t", at);
      if (at == std::string_view::npos) break;
    }
    auto end = end_of_cell(line, at, dialect.separator);
    if (dialect.merges_blanks) end = std::min(end, std::min(line.find('\t', at), line.size()));
    cells.push_back(without_quotes(trimmed(line.substr(at, end - at))));
    at = end + 1;
  }
  while (!cells.empty() && cells.back().empty()) cells.pop_back();
}

namespace {

/// "2024-01-31 10:11:12.345", "10:11:12,345", with T between and Z or nothing behind: seconds.
std::optional<double> time_of_day(std::string_view text) {
  double days = 0;
  if (text.ends_with('Z')) text.remove_suffix(1);
  if (text.size() > 11 && text[4] == '-' && text[7] == '-' && (text[10] == ' ' || text[10] == 'T')) {
    const auto year = parsed<int>(text.substr(0, 4));
    const auto month = parsed<unsigned>(text.substr(5, 2));
    const auto day = parsed<unsigned>(text.substr(8, 2));
    if (!year || !month || !day) return {};
    const std::chrono::year_month_day date{std::chrono::year(*year), std::chrono::month(*month),
                                           std::chrono::day(*day)};
    if (!date.ok()) return {};
    days = static_cast<double>(std::chrono::sys_days(date).time_since_epoch().count());
    text.remove_prefix(11);
  }
  const auto colon = text.find(':');
  const auto second = text.find(':', colon + 1);
  if (colon == std::string_view::npos || second == std::string_view::npos) return {};
  const auto hours = parsed<unsigned>(text.substr(0, colon));
  const auto minutes = parsed<unsigned>(text.substr(colon + 1, second - colon - 1));
  const auto rest = text.substr(second + 1);
  const auto seconds = cell_of(rest, rest.find(',') == std::string_view::npos ? '.' : ',');
  const bool fits =
      hours.value_or(24) < 24 && minutes.value_or(60) < 60 && !rest.empty() && is_digit(rest[0]);
  if (!fits || seconds.kind != DataCell::Kind::number || seconds.value >= 61) return {};
  return ((days * 24 + *hours) * 60 + *minutes) * 60 + seconds.value;
}

}  // namespace

DataCell cell_of(std::string_view text, char decimal) {
  if (text.empty()) return {};
  std::array<char, 64> pointed{};
  const auto whole = text;
  if (decimal != '.' && text.find(decimal) != std::string_view::npos) {
    if (text.size() > pointed.size() || text.find('.') != std::string_view::npos)
      return {DataCell::Kind::text, 0};
    std::replace_copy(text.begin(), text.end(), pointed.begin(), decimal, '.');
    text = {pointed.data(), text.size()};
  }
  if (text.front() == '+' && text.size() > 1 && text[1] != '-') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end == text.data() + text.size()) {
    if (error == std::errc() && std::isfinite(value)) return {DataCell::Kind::number, value};
    // Too small for a double is 0 to every drive.
    if (error == std::errc::result_out_of_range && text.find("e-") != std::string_view::npos)
      return {DataCell::Kind::number, 0};
    if (error == std::errc()) return {DataCell::Kind::not_a_number, 0};
  }
  if (whole.find(':') != std::string_view::npos)
    if (const auto seconds = time_of_day(whole)) return {DataCell::Kind::number, *seconds, true};
  const bool is_none = is_one_of(std::array{"nan", "-nan", "1.#qnan", "-1.#ind", "-", "--", "---"}, whole);
  return {is_none ? DataCell::Kind::not_a_number : DataCell::Kind::text, 0};
}

bool has_thousands(std::string_view text, char decimal) {
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  const auto point = text.find(decimal);
  const auto whole = text.substr(0, point);
  const auto fraction = point == std::string_view::npos ? std::string_view() : text.substr(point + 1);
  const auto sign_at = whole.find_first_not_of("0123456789");
  if (sign_at == std::string_view::npos || sign_at == 0 || sign_at > 3) return false;
  const char sign = whole[sign_at];
  constexpr std::string_view signs = ".,' ";
  if (signs.find(sign) == std::string_view::npos) return false;
  constexpr std::size_t group = 4;  // with its sign
  std::size_t groups = 0;
  for (auto rest = whole.substr(sign_at); !rest.empty(); rest.remove_prefix(group), ++groups)
    if (rest.size() < group || rest[0] != sign ||
        !std::all_of(rest.begin() + 1, rest.begin() + group, is_digit))
      return false;
  // "1.234" alone is a number, with another sign for its decimals.
  return std::all_of(fraction.begin(), fraction.end(), is_digit) && (groups > 1 || !fraction.empty());
}

DataCell cell_at(const std::vector<std::string_view>& cells, std::size_t index, char decimal) {
  return index < cells.size() ? cell_of(cells[index], decimal) : DataCell();
}

bool is_data(std::string_view line, const Dialect& dialect) {
  std::vector<std::string_view> cells;
  split(line, dialect, cells);
  bool has_number = false;
  for (const auto cell : cells) {
    const auto kind = cell_of(cell, dialect.decimal).kind;
    const bool is_grouped = kind == DataCell::Kind::text && has_thousands(cell, dialect.decimal);
    if (kind == DataCell::Kind::text && !is_grouped) return false;
    has_number = has_number || is_grouped || kind == DataCell::Kind::number;
  }
  return has_number;
}

std::string as_utf8(std::string_view text) {
  if (!text_fault(text)) return std::string(text);
  std::string made;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80) {
      made += byte < 0x20 && c != '\t' ? ' ' : c;
    } else {
      made += static_cast<char>(0xC0U | (byte >> 6U));
      made += static_cast<char>(0x80U | (byte & 0x3FU));
    }
  }
  return made;
}

bool is_blank(std::string_view line) {
  const auto text = trimmed(line);
  return text.empty() || text == "EOF";
}

}  // namespace drycut::sim::recordings
