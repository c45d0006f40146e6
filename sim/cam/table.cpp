#include "sim/cam/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <map>
#include <optional>
#include <vector>

#include "devices/camming4/table.hpp"

namespace drycut::sim {

namespace {

namespace camming4 = devices::camming4;
using camming4::Code;
using camming4::Row;
using camming4::Use;

constexpr std::size_t most_problems = 1000;
const std::vector<std::string> columns = {"sector",  "codeG",   "codeQm", "codeQs",
                                          "codeQma", "codeQsa", "codeM"};

/// A piece of a line and where it stands.
struct Cell {
  std::string_view text;
  int column = 1;
};

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

Cell trimmed(Cell cell) {
  while (!cell.text.empty() && is_blank(cell.text.front())) {
    cell.text.remove_prefix(1);
    ++cell.column;
  }
  while (!cell.text.empty() && is_blank(cell.text.back())) cell.text.remove_suffix(1);
  return cell;
}

std::vector<Cell> split(std::string_view line) {
  std::vector<Cell> cells;
  std::size_t begin = 0;
  while (true) {
    const auto end = std::min(line.find(',', begin), line.size());
    cells.push_back(trimmed({line.substr(begin, end - begin), static_cast<int>(begin) + 1}));
    if (end == line.size()) return cells;
    begin = end + 1;
  }
}

/// What a message may quote: short, printable ASCII.
std::string quoted(std::string_view text) {
  constexpr std::size_t most = 40;
  std::string shown = "'";
  for (const char c : text.substr(0, most)) shown += c >= ' ' && c <= '~' ? c : '?';
  return shown + (text.size() > most ? "...'" : "'");
}

struct Range {
  double low = 0;
  double high = 0;
};

Range range_of_variable(std::string_view name) {
  for (const auto& variable : camming4::table::variables)
    if (variable.name == name) return {variable.min, variable.max};
  for (const auto& field : camming4::table::fields)
    if (field.name == name) return {static_cast<double>(field.min), static_cast<double>(field.max)};
  return {};
}

/// The range of a column under a code (000 1.2.13): narrower than its variable's where the code says so.
Range range_of(std::string_view column, Use use, int code) {
  switch (use) {
    case Use::master_space:
    case Use::master_coefficient:
    case Use::master_count:
    case Use::master_count_bits:
    case Use::master_quota:
    case Use::target_row:
      return {0, 999999};
    case Use::radius:
      return {-159154, 159154};
    case Use::displacement_x:
    case Use::displacement_y:
      return {-318308, 318308};
    case Use::slave_space:
      return code == 180 ? Range{-318308, 318308} : range_of_variable(column);
    default:
      return range_of_variable(column);
  }
}

class Reader {
 public:
  Reader(std::string_view text, const std::string& file, devices::Problems& problems)
      : text_(text), problems_(problems), before_(problems.size()) {
    table_.file = file;
  }

  CamTable read() {
    if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);
    while (!text_.empty() && !full_) {
      const auto end = std::min(text_.find('\n'), text_.size());
      ++line_;
      read_line(text_.substr(0, end));
      text_.remove_prefix(std::min(end + 1, text_.size()));
    }
    if (!full_) check_whole();
    return std::move(table_);
  }

 private:
  void problem(int line, int column, std::string what, std::string remedy) {
    if (full_) return;
    problems_.push_back({table_.file, line, column, std::move(what), std::move(remedy)});
    if (problems_.size() - before_ < most_problems) return;
    full_ = true;
    problems_.push_back(
        {table_.file, line, column, "too many problems: the rest is not told", "is this a cam table?"});
  }
  void problem(const Cell& cell, std::string what, std::string remedy) {
    problem(line_, cell.column, std::move(what), std::move(remedy));
  }

  void read_line(std::string_view line) {
    const Cell cell = trimmed({line, 1});
    if (cell.text.empty()) return;
    if (cell.text.front() == '#')
      read_comment(cell);
    else if (header_.empty())
      read_header(split(line));
    else
      read_sector(split(line));
  }

  // Settings.

  void read_comment(const Cell& comment) {
    const auto colon = comment.text.find(':');
    if (comment.text.starts_with("##") || colon == std::string_view::npos) return;
    const Cell key = trimmed({comment.text.substr(1, colon - 1), comment.column + 1});
    const bool is_word = !key.text.empty() && std::all_of(key.text.begin(), key.text.end(), [](char c) {
      return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
    });
    if (!is_word) return;
    const int at = comment.column + static_cast<int>(colon) + 1;
    const Cell value = trimmed({comment.text.substr(colon + 1), at});
    const auto found = settings_.find(std::string(key.text));
    if (found == settings_.end() && is_prose(value.text)) return;
    if (!header_.empty()) {
      if (found != settings_.end())
        problem(key, fmt::format("{} stands below the header", key.text), "give settings above the header");
      return;
    }
    if (found == settings_.end()) {
      unknown_setting(key);
      return;
    }
    const auto [first, fresh] = given_.emplace(key.text, line_);
    if (!fresh) {
      problem(key, fmt::format("{} is given twice", key.text),
              fmt::format("it was first given in line {}; keep one", first->second));
      return;
    }
    read_setting(key, value, *found->second);
  }

  /// True for "the guide in 0.1 mm" and for nothing: a value is a number or one word.
  static bool is_prose(std::string_view value) {
    if (value.empty()) return true;
    const bool is_number = std::string_view("+-.0123456789").find(value.front()) != std::string_view::npos;
    return !is_number && value.find_first_of(" \t") != std::string_view::npos;
  }

  void unknown_setting(const Cell& key) {
    std::vector<std::string> names;
    std::string all;
    for (const auto& [name, value] : settings_) {
      names.push_back(name);
      all += (all.empty() ? "" : ", ") + name;
    }
    const auto near = devices::nearest(std::string(key.text.substr(0, 40)), names);
    problem(key, fmt::format("there is no setting {}", quoted(key.text)),
            (near.empty() ? "there are " + all : fmt::format("did you mean {}?", near)) +
                "; a remark begins with ##");
  }

  void read_setting(const Cell& key, Cell value, std::int32_t& target) {
    if (key.text == "TCamp" && value.text.ends_with("ms"))
      value = trimmed({value.text.substr(0, value.text.size() - 2), value.column});
    const auto range = range_of_variable(key.text);
    if (const auto number = integer(value, std::string(key.text), range)) target = *number;
  }

  /// A whole number in its range, or a problem.
  std::optional<std::int32_t> integer(const Cell& cell, const std::string& name, Range range) {
    auto digits = cell.text;
    if (digits.starts_with('+') && !digits.starts_with("+-")) digits.remove_prefix(1);
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    const bool whole = !digits.empty() && end == digits.data() + digits.size();
    const auto remedy = fmt::format("write a whole number from {:.0f} to {:.0f}", range.low, range.high);
    if (cell.text.empty()) {
      problem(cell, fmt::format("{} has no value", name), remedy);
    } else if (!whole || error == std::errc::invalid_argument) {
      problem(cell, fmt::format("{} {} is not a whole number", name, quoted(cell.text)), remedy);
    } else if (error != std::errc{} || static_cast<double>(number) < range.low ||
               static_cast<double>(number) > range.high) {
      problem(cell, fmt::format("{} {} is out of range", name, quoted(cell.text)), remedy);
    } else {
      return static_cast<std::int32_t>(number);
    }
    return {};
  }

  // Header: the place of each column, in the order of `columns`.

  void read_header(const std::vector<Cell>& cells) {
    header_.assign(columns.size(), -1);
    int known = 0;
    for (const auto& cell : cells)
      known += static_cast<int>(std::count(columns.begin(), columns.end(), cell.text));
    const bool numbers = !cells.front().text.empty() &&
                         (std::isdigit(static_cast<unsigned char>(cells.front().text.front())) != 0);
    if (known == 0 && numbers) {
      problem(cells.front(), "the header is missing",
              "begin with the line sector,codeG,codeQm,codeQs,codeQma,codeQsa,codeM");
      for (std::size_t i = 0; i < header_.size(); ++i) header_[i] = static_cast<int>(i);
      width_ = columns.size();
      read_sector(cells);
      return;
    }
    width_ = cells.size();
    for (std::size_t i = 0; i < cells.size() && !full_; ++i) read_column_name(cells[i], static_cast<int>(i));
    for (const std::size_t needed : {0U, 1U}) {
      if (header_[needed] < 0)
        problem(line_, 1, fmt::format("the header has no column {}", columns[needed]),
                "the header is sector,codeG,codeQm,codeQs,codeQma,codeQsa,codeM");
    }
  }

  void read_column_name(const Cell& cell, int place) {
    const auto found = std::find(columns.begin(), columns.end(), cell.text);
    if (found == columns.end()) {
      const auto near = devices::nearest(std::string(cell.text.substr(0, 40)), columns);
      const bool semicolons = cell.text.find(';') != std::string_view::npos;
      problem(cell, fmt::format("there is no column {}", quoted(cell.text)),
              semicolons     ? "separate the columns with commas"
              : near.empty() ? "the columns are sector,codeG,codeQm,codeQs,codeQma,codeQsa,codeM"
                             : fmt::format("did you mean {}?", near));
      return;
    }
    int& taken = header_[static_cast<std::size_t>(found - columns.begin())];
    if (taken >= 0) {
      problem(cell, fmt::format("column {} is there twice", *found), "keep one");
      return;
    }
    taken = place;
  }

  // Sectors.

  /// The cell of a column; empty if the line or the header ends before it.
  [[nodiscard]] Cell cell_of(const std::vector<Cell>& cells, std::size_t column) const {
    const int place = header_[column];
    if (place < 0 || place >= static_cast<int>(cells.size())) return {"", cells.back().column};
    return cells[static_cast<std::size_t>(place)];
  }

  void read_sector(const std::vector<Cell>& cells) {
    for (std::size_t i = width_; i < cells.size(); ++i) {
      if (cells[i].text.empty()) continue;
      problem(cells[i], fmt::format("{} is in no column of the header", quoted(cells[i].text)),
              fmt::format("the header has {} columns", width_));
      break;
    }
    std::optional<std::int32_t> number;
    if (header_[0] >= 0) number = integer(cell_of(cells, 0), "sector", {1, camming4::cam_rows});
    const Code* code = header_[1] >= 0 ? read_code(cell_of(cells, 1)) : nullptr;
    const auto use = [&](Use Code::*column) { return code != nullptr ? code->*column : Use::unused; };
    Row row;
    row.codeG = code != nullptr ? code->code : 0;
    read_number(cells, 2, use(&Code::qm), row, row.codeQm);
    read_number(cells, 3, use(&Code::qs), row, row.codeQs);
    read_number(cells, 4, use(&Code::qma), row, row.codeQma);
    read_number(cells, 5, use(&Code::qsa), row, row.codeQsa);
    read_number(cells, 6, Use::unused, row, row.codeM);
    if (number) keep(cell_of(cells, 0), *number, row);
  }

  void read_number(const std::vector<Cell>& cells, std::size_t column, Use use, const Row& row,
                   std::int32_t& target) {
    const Cell cell = cell_of(cells, column);
    if (cell.text.empty()) return;
    const auto& name = columns[column];
    if (const auto number = integer(cell, name, range_of(name, use, row.codeG))) target = *number;
  }

  const Code* read_code(const Cell& cell) {
    for (const auto& code : camming4::codes) {
      if (cell.text != code.mnemonic) continue;
      problem(cell, fmt::format("codeG {} is a name, not a number", quoted(cell.text)),
              fmt::format("write {}: {} {}", code.code, code.mnemonic, code.meaning));
      return &code;
    }
    if (cell.text.empty()) {
      problem(cell, "codeG has no value", "write an operating instruction, such as 133; 130 does nothing");
      return nullptr;
    }
    const auto number = integer(cell, "codeG", {0, 32767});
    if (!number) return nullptr;
    if (const auto* found = camming4::find_code(*number)) return found;
    const auto* nearest = camming4::codes.data();
    for (const auto& code : camming4::codes)
      if (std::abs(code.code - *number) < std::abs(nearest->code - *number)) nearest = &code;
    problem(cell, fmt::format("there is no codeG {}", *number),
            fmt::format("the nearest is {} {}: {}", nearest->code, nearest->mnemonic, nearest->meaning));
    return nullptr;
  }

  void keep(const Cell& where, int number, const Row& row) {
    auto& sector = table_.sectors[static_cast<std::size_t>(number - 1)];
    if (sector.line > 0) {
      problem(where, fmt::format("sector {} is given twice", number),
              fmt::format("it was first given in line {}; number each sector once", sector.line));
      return;
    }
    sector = {row, line_};
  }

  void check_whole() {
    for (const auto* ramp : {"taccmax", "tdecmax"}) {
      const auto found = given_.find(ramp);
      if (found != given_.end() && *settings_.at(ramp) > 0 && table_.maxvel == 0)
        problem(found->second, 1, fmt::format("{} means nothing without maxvel", ramp),
                "give the speed at 10 V too: # maxvel: 1000");
    }
    if (header_.empty()) {
      problem(std::max(line_, 1), 1, "there is no table: the header is missing",
              "give the line sector,codeG,codeQm,codeQs,codeQma,codeQsa,codeM and a line for each sector");
    } else if (table_.count() == 0 && problems_.size() == before_) {
      problem(line_, 1, "the table has no sector", "give a line for each sector, such as 1,132,100,50");
    }
    table_.settings = {{measurem_, pulsem_}, {measure_, pulse_}, decpt_};
  }

  std::string_view text_;
  devices::Problems& problems_;
  std::size_t before_;
  bool full_ = false;
  CamTable table_;
  int line_ = 0;
  std::vector<int> header_;
  std::size_t width_ = 0;
  std::map<std::string, int, std::less<>> given_;  ///< settings and their lines
  std::int32_t measure_ = 1, pulse_ = 1, measurem_ = 1, pulsem_ = 1, decpt_ = 0;
  std::map<std::string, std::int32_t*> settings_ = {
      {"measure", &measure_},     {"pulse", &pulse_},           {"measurem", &measurem_},
      {"pulsem", &pulsem_},       {"decpt", &decpt_},           {"unitvel", &table_.unitvel},
      {"maxvel", &table_.maxvel}, {"taccmax", &table_.taccmax}, {"tdecmax", &table_.tdecmax},
      {"TCamp", &table_.TCamp}};
};

}  // namespace

int CamTable::count() const {
  return static_cast<int>(
      std::count_if(sectors.begin(), sectors.end(), [](const Sector& s) { return s.line > 0; }));
}

CamTable read_cam_table(std::string_view text, const std::string& file, devices::Problems& problems) {
  return Reader(text, file, problems).read();
}

}  // namespace drycut::sim
