#include "sim/cams/csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/text.hpp"

namespace drycut::sim::cams {

namespace {

constexpr std::size_t most_problems = 1000;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

/// True for "the guide in 0.1 mm" and for nothing: a value is a number or one word.
bool is_prose(std::string_view value) {
  if (value.empty()) return true;
  const bool is_number = std::string_view("+-.0123456789").find(value.front()) != std::string_view::npos;
  return !is_number && value.find_first_of(" \t") != std::string_view::npos;
}

/// Reads a floating-point number; false if there is more or less.
bool read_real(std::string_view digits, double& number) {
  if (digits.starts_with('+') && !digits.starts_with("+-")) digits.remove_prefix(1);
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return !digits.empty() && error == std::errc{} && end == digits.data() + digits.size();
}

}  // namespace

Cell trimmed(Cell cell) {
  while (!cell.text.empty() && is_blank(cell.text.front())) {
    cell.text.remove_prefix(1);
    ++cell.column;
  }
  while (!cell.text.empty() && is_blank(cell.text.back())) cell.text.remove_suffix(1);
  return cell;
}

std::vector<Cell> split_cells(std::string_view line) {
  std::vector<Cell> cells;
  std::size_t begin = 0;
  while (true) {
    const auto end = std::min(line.find(',', begin), line.size());
    cells.push_back(trimmed({line.substr(begin, end - begin), static_cast<int>(begin) + 1}));
    if (end == line.size()) return cells;
    begin = end + 1;
  }
}

void TableProblems::add(Code code, int line, int column, std::string what, std::string remedy) {
  if (full_) return;
  problems_.push_back({code, file_, line, column, std::move(what), std::move(remedy)});
  if (problems_.size() - before_ < most_problems) return;
  full_ = true;
  problems_.push_back({"text.too-many-problems"_code, file_, line, column,
                       "too many problems: the rest is not told", "is this a cam table?"});
}

std::string range_text(CamKeyRange range) { return fmt::format("{:.10g} to {:.10g}", range.low, range.high); }

std::optional<std::int64_t> whole_number(const Cell& cell, int line, std::string_view name, CamKeyRange range,
                                         TableProblems& problems) {
  auto digits = cell.text;
  if (digits.starts_with('+') && !digits.starts_with("+-")) digits.remove_prefix(1);
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  const bool whole = !digits.empty() && end == digits.data() + digits.size();
  const auto remedy = fmt::format("write a whole number from {:.0f} to {:.0f}", range.low, range.high);
  if (cell.text.empty()) {
    problems.add("cam.missing"_code, line, cell.column, fmt::format("{} has no value", name), remedy);
  } else if (!whole || error == std::errc::invalid_argument) {
    problems.add("cam.value"_code, line, cell.column,
                 fmt::format("{} {} is not a whole number", name, in_quotes(cell.text)), remedy);
  } else if (error != std::errc{} || static_cast<double>(number) < range.low ||
             static_cast<double>(number) > range.high) {
    problems.add("cam.out-of-range"_code, line, cell.column,
                 fmt::format("{} {} is out of range", name, in_quotes(cell.text)), remedy);
  } else {
    return number;
  }
  return {};
}

std::optional<double> real_number(const Cell& cell, int line, std::string_view name, CamKeyRange range,
                                  TableProblems& problems) {
  const auto slash = cell.text.find('/');
  double number = 0;
  double divisor = 1;
  const bool read = slash == std::string_view::npos
                        ? read_real(cell.text, number)
                        : read_real(trimmed({cell.text.substr(0, slash)}).text, number) &&
                              read_real(trimmed({cell.text.substr(slash + 1)}).text, divisor);
  const auto remedy =
      fmt::format("write a number or a fraction (5/3) from {:g} to {:g}", range.low, range.high);
  if (cell.text.empty()) {
    problems.add("cam.missing"_code, line, cell.column, fmt::format("{} has no value", name), remedy);
  } else if (!read || divisor == 0) {
    problems.add("cam.value"_code, line, cell.column,
                 fmt::format("{} {} is not a number", name, in_quotes(cell.text)), remedy);
  } else if (number /= divisor; !(number >= range.low && number <= range.high)) {
    problems.add("cam.out-of-range"_code, line, cell.column,
                 fmt::format("{} {} is out of range", name, in_quotes(cell.text)), remedy);
  } else {
    return number;
  }
  return {};
}

// Settings.

void Settings::travel(const std::string& least, const std::string& most, CamKeyRange range,
                      devices::CamTravel& travel) {
  whole(least, range, travel.least, "lower end of the slave's travel");
  whole(most, range, travel.most, "upper end of it");
  travel_ = &travel;
  least_ = least;
  most_ = most;
}

void Settings::check_travel() const {
  if (travel_->least && travel_->most && *travel_->least > *travel_->most)
    problems_.add("cam.out-of-range"_code, line_of(least_), 1, fmt::format("{} is above {}", least_, most_),
                  fmt::format("give the lower end of the travel as {}", least_));
}

void Settings::read(const Cell& comment, int line, bool above) {
  const auto colon = comment.text.find(':');
  if (comment.text.starts_with("##")) return;
  if (colon == std::string_view::npos) return read_without_colon(comment, line);
  const Cell key = trimmed({comment.text.substr(1, colon - 1), comment.column + 1});
  const bool is_word = !key.text.empty() && std::all_of(key.text.begin(), key.text.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
  });
  if (!is_word) return;
  const int at = comment.column + static_cast<int>(colon) + 1;
  const Cell value = trimmed({comment.text.substr(colon + 1), at});
  const auto found = settings_.find(key.text);
  if (found == settings_.end() && is_prose(value.text)) return;
  if (!above) {
    if (found != settings_.end())
      problems_.add("cam.table-form"_code, line, key.column,
                    fmt::format("{} stands below the header", key.text), "give settings above the header");
    return;
  }
  if (found == settings_.end()) {
    refuse(key, line);
    return;
  }
  const auto [first, fresh] = given_.emplace(key.text, line);
  if (!fresh) {
    problems_.add("cam.twice"_code, line, key.column, fmt::format("{} is given twice", key.text),
                  fmt::format("it was first given in line {}; keep one", first->second));
    return;
  }
  found->second(value, line);
}

/// `# time_axis`, `# time_axis 5` and `# time_axis = 5` are meant as settings; `# time_axis in 0.1 ms` is
/// not.
void Settings::read_without_colon(const Cell& comment, int line) {
  const Cell text = trimmed({comment.text.substr(1), comment.column + 1});
  const auto key = text.text.substr(0, std::min(text.text.find_first_of(" \t="), text.text.size()));
  if (!settings_.contains(key)) return;
  auto value = trimmed({text.text.substr(key.size())}).text;
  const bool equals = value.starts_with('=');
  if (equals) value = trimmed({value.substr(1)}).text;
  const bool is_value = value.find_first_of("0123456789") != std::string_view::npos &&
                        value.find_first_of(" \t") == std::string_view::npos;
  if (!value.empty() && !equals && !is_value) return;
  problems_.add("cam.table-form"_code, line, text.column, fmt::format("{} has no colon", key),
                fmt::format("write # {}: {}; a remark begins with ##", key,
                            is_value ? std::string(value.substr(0, 40)) : "and its value"));
}

int Settings::line_of(std::string_view name) const {
  const auto found = given_.find(name);
  return found == given_.end() ? 0 : found->second;
}

void Settings::refuse(const Cell& key, int line) {
  std::vector<std::string> names;
  names.reserve(settings_.size());
  for (const auto& [name, take] : settings_) names.push_back(name);
  problems_.add("cam.unknown-key"_code, line, key.column,
                fmt::format("there is no setting {}", in_quotes(key.text)),
                did_you_mean(key.text.substr(0, 40), names, "there are " + listed(names)) +
                    "; a remark begins with ##");
}

// Header.

std::string Header::text() const { return fmt::format("{}", fmt::join(columns_, ",")); }

bool Header::read(const std::vector<Cell>& cells, int line, TableProblems& problems) {
  places_.assign(columns_.size(), -1);
  int known = 0;
  for (const auto& cell : cells)
    known += static_cast<int>(std::count(columns_.begin(), columns_.end(), cell.text));
  const auto& first = cells.front();
  const bool numbers =
      !first.text.empty() && (std::isdigit(static_cast<unsigned char>(first.text.front())) != 0);
  if (known == 0 && numbers) {
    problems.add("cam.missing"_code, line, first.column, "the header is missing",
                 "begin with the line " + text());
    for (std::size_t i = 0; i < places_.size(); ++i) places_[i] = static_cast<int>(i);
    width_ = columns_.size();
    return false;
  }
  width_ = cells.size();
  for (std::size_t i = 0; i < cells.size() && !problems.full(); ++i)
    read_name(cells[i], static_cast<int>(i), line, problems);
  for (std::size_t needed = 0; needed < needed_; ++needed) {
    if (places_[needed] < 0)
      problems.add("cam.unknown-key"_code, line, 1,
                   fmt::format("the header has no column {}", columns_[needed]), "the header is " + text());
  }
  return true;
}

void Header::read_name(const Cell& cell, int place, int line, TableProblems& problems) {
  const auto found = std::find(columns_.begin(), columns_.end(), cell.text);
  if (found == columns_.end()) {
    const bool semicolons = cell.text.find(';') != std::string_view::npos;
    problems.add("cam.unknown-key"_code, line, cell.column,
                 fmt::format("there is no column {}", in_quotes(cell.text)),
                 semicolons ? "separate the columns with commas"
                            : did_you_mean(cell.text.substr(0, 40), columns_, "the columns are " + text()));
    return;
  }
  int& taken = places_[static_cast<std::size_t>(found - columns_.begin())];
  if (taken >= 0) {
    problems.add("cam.twice"_code, line, cell.column, fmt::format("column {} is there twice", *found),
                 "keep one");
    return;
  }
  taken = place;
}

Cell Header::cell_of(const std::vector<Cell>& cells, std::size_t column) const {
  const int place = places_[column];
  if (place < 0 || place >= static_cast<int>(cells.size())) return {"", cells.back().column};
  return cells[static_cast<std::size_t>(place)];
}

void Header::check_width(const std::vector<Cell>& cells, int line, TableProblems& problems) const {
  for (std::size_t i = width_; i < cells.size(); ++i) {
    if (cells[i].text.empty()) continue;
    problems.add("cam.unknown-key"_code, line, cells[i].column,
                 fmt::format("{} is in no column of the header", in_quotes(cells[i].text)),
                 fmt::format("the header has {} columns", width_));
    return;
  }
}

}  // namespace drycut::sim::cams
