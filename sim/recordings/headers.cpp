// How each tool's export begins: a table of formats, each with its mark and the reader of its header.
#include "sim/recordings/headers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "base/text.hpp"

namespace drycut::sim::recordings {

namespace {

using Row = std::vector<std::string>;

/// The lines above the data, in cells.
struct Above {
  std::vector<Row> rows;

  /// The row whose first cell is `key`, the last one of several that has `width` cells at most; nullptr if
  /// there is none.
  [[nodiscard]] const Row* row(std::string_view key, std::size_t width = none) const {
    const auto found = std::find_if(rows.rbegin(), rows.rend(), [&](const Row& row) {
      return !row.empty() && row.size() <= width && same_word(row[0], key);
    });
    return found == rows.rend() ? nullptr : &*found;
  }
  /// The number-th row from below.
  [[nodiscard]] const Row* from_below(std::size_t number) const {
    return number < rows.size() ? &rows[rows.size() - 1 - number] : nullptr;
  }
  [[nodiscard]] std::optional<double> number(std::string_view key) const {
    const auto* const found = row(key);
    if (found == nullptr || found->size() < 2) return {};
    return number_in(found->at(1));
  }
  /// Behind "Analog:", with a decimal point or comma.
  static std::optional<double> number_in(std::string_view text) {
    if (const auto colon = text.rfind(':'); colon != std::string_view::npos) text.remove_prefix(colon + 1);
    const auto cell = cell_of(trimmed(text), text.find('.') == std::string_view::npos ? ',' : '.');
    return cell.kind == DataCell::Kind::number ? std::optional(cell.value) : std::nullopt;
  }
};

constexpr std::string_view slash = " / ";  // between name and unit

/// "Torque [N m]", "M / Nm", "pos (5)": the name as it stands, and the unit.
ExportColumn named(std::string_view text) {
  for (const auto& [open, close] : {std::pair{'[', ']'}, {'(', ')'}}) {
    const auto begin = text.rfind(open);
    if (begin == std::string_view::npos || begin == 0 || !text.ends_with(close)) continue;
    const auto unit = trimmed(text.substr(begin + 1, text.size() - begin - 2));
    // "pos (5)" is a name: a number is no unit.
    if (unit.empty() || parsed<double>(unit)) continue;
    return {std::string(text), std::string(unit == "-" ? "" : unit)};
  }
  if (const auto at = text.find(slash); at != std::string_view::npos && at > 0)
    return {std::string(text), std::string(trimmed(text.substr(at + slash.size())))};
  return {std::string(text)};
}

bool says_time(const ExportColumn& column) {
  return is_one_of(std::array{"time", "t", "zeit", "timestamp", "time stamp", "second", "seconds", "date"},
                   name_alone(column.name));
}

// TwinCAT Scope: rows `key, value, ...`, where the key stands over each column of time.
void read_twincat(const Above& above, ExportHead& head) {
  const auto* const types = above.row("Data-Type");  // has no blanks in it, whatever the separator
  if (types == nullptr) return;
  const auto width = types->size();
  // Names with blanks are torn where blanks stand between cells; the symbols' names have none.
  const auto* names = above.row("Name", width);
  if (names == nullptr || names->size() < width) names = above.row("SymbolName", width);
  const auto* const units = above.row("Unit", width);
  std::size_t time = none;
  for (std::size_t i = 0; i < types->size(); ++i) {
    if (same_word(types->at(i), "Data-Type")) {
      time = i;
      head.columns.push_back({"", "ms", none, true});
      continue;
    }
    ExportColumn column{names != nullptr && i < names->size() ? names->at(i) : "", "", time};
    const auto unit = units != nullptr && i < units->size() ? units->at(i) : "";
    if (!unit.starts_with('(')) column.unit = trimmed(std::string_view(unit).substr(0, unit.find('(')));
    for (const auto* key : {"ScaleFactor", "Unit ScaleFactor", "Unit Offset"})
      if (const auto* const row = above.row(key, width); row != nullptr && i < row->size())
        if (const auto number = Above::number_in(row->at(i));
            number && *number != (std::string_view(key) == "Unit Offset" ? 0 : 1))
          column.remark += fmt::format("{}{} {:g}", column.remark.empty() ? "" : ", ", key, *number);
    if (!column.remark.empty()) column.remark += ": the file does not say whether that was applied";
    head.columns.push_back(column);
  }
}

/// MR Configurator2 names what its columns measure, not in which unit.
struct Measured {
  std::string_view begins;
  std::string_view unit;
};
constexpr std::array measured = {
    Measured{"servo motor speed", "rpm"},
    Measured{"speed command", "rpm"},
    Measured{"torque", "%"},
    Measured{"instantaneous torque", "%"},
    Measured{"current command", "%"},
    Measured{"effective load ratio", "%"},
    Measured{"droop pulses", "counts"},
    Measured{"command pulse", "counts"},
    Measured{"cumulative", "counts"},
    Measured{"within one-revolution position", "counts"},
    Measured{"bus voltage", "V"},
};

// MR Configurator2: the names stand in the row of the units, over them which analogue channel it is.
void read_mr_configurator2(const Above& above, ExportHead& head) {
  if (const auto interval = above.number("Sampling time interval(ms)")) head.interval = *interval / 1000;
  const auto* const names = above.from_below(0);
  const auto* const channels = above.from_below(1);
  if (names == nullptr || channels == nullptr) return;
  for (std::size_t i = 0; i < names->size(); ++i) {
    if (i == 0) {
      head.columns.push_back({channels->at(0), names->at(0), none, true});
      continue;
    }
    const bool unused = names->at(i).empty() || same_word(names->at(i), "Not selected");
    ExportColumn column{unused && i < channels->size() ? channels->at(i) : names->at(i)};
    column.is_unused = unused;
    for (const auto& [begins, unit] : measured)
      if (column.unit.empty() && lower(column.name).starts_with(begins)) column.unit = unit;
    head.columns.push_back(column);
  }
}

// Rigol: start and increment stand behind the names, their numbers behind the units.
void read_rigol(const Above& above, ExportHead& head) {
  const auto& names = above.rows.front();
  const auto* const units = above.rows.size() > 1 ? &above.rows[1] : nullptr;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto unit = units != nullptr && i < units->size() ? units->at(i) : "";
    if (same_word(names[i], "Start"))
      head.start = Above::number_in(unit).value_or(0);
    else if (same_word(names[i], "Increment"))
      head.interval = Above::number_in(unit);
    else if (same_word(unit, "Sequence"))
      head.columns.push_back({names[i], "", none, false, true});
    else if (!names[i].empty())
      head.columns.push_back({names[i], unit});
  }
}

// Siglent: `Second,Volt` is the last row; which channels they are stands behind `Vertical Scale`.
void read_siglent(const Above& above, ExportHead& head) {
  head.interval = above.number("Sample Interval");
  if (const auto rate = above.number("Sample Rate"); rate && *rate > 0) head.interval = 1 / *rate;
  const auto* const units = above.from_below(0);
  const auto* const scales = above.row("Vertical Scale");
  if (units == nullptr) return;
  for (std::size_t i = 0; i < units->size(); ++i) {
    ExportColumn column{units->at(i), units->at(i), none, i == 0};
    if (i > 0 && scales != nullptr && i < scales->size())
      if (const auto colon = scales->at(i).find(':'); colon != std::string::npos)
        column.name = scales->at(i).substr(0, colon);
    head.columns.push_back(column);
  }
}

void read_halsampler(const Above&, ExportHead&) {}

bool is_row_of_names(const Row* row, int width) {
  if (row == nullptr || static_cast<int>(row->size()) > width + 1 || row->empty()) return false;
  return static_cast<int>(row->size()) >= width || (width > 2 && static_cast<int>(row->size()) >= width - 1);
}

/// "Nm" of "[Nm]".
std::string_view without_brackets(std::string_view cell) {
  for (const auto& [open, close] : {std::pair{'[', ']'}, {'(', ')'}})
    if (cell.size() >= 2 && cell.front() == open && cell.back() == close)
      return trimmed(cell.substr(1, cell.size() - 2));
  return cell;
}

/// A row of nothing but units: short words, blanks, or all of them in brackets.
bool is_row_of_units(const Row& row) {
  if (std::all_of(row.begin(), row.end(), [](const auto& cell) {
        return cell.empty() || without_brackets(cell).size() < cell.size();
      }))
    return true;
  constexpr std::array known = {"s",     "ms",  "us",    "second", "volt", "v",     "mv",  "a",      "ma",
                                "%",     "rpm", "1/min", "r/min",  "nm",   "n m",   "deg", "rad",    "rad/s",
                                "deg/s", "mm",  "m",     "mm/s",   "m/s",  "m/min", "n",   "counts", "inc",
                                "inch",  "in",  "hz",    "min-1",  "-",    ""};
  return std::all_of(row.begin(), row.end(),
                     [&](const auto& cell) { return is_one_of(known, trimmed(cell)); });
}

// Any other: names above the data, units below the names or behind each.
void read_csv(const Above& above, ExportHead& head) {
  const auto* names = above.from_below(0);
  const Row* units = nullptr;
  if (is_row_of_names(names, head.width) && is_row_of_names(above.from_below(1), head.width) &&
      is_row_of_units(*names)) {
    units = names;
    names = above.from_below(1);
  }
  if (!is_row_of_names(names, head.width)) return;
  for (std::size_t i = 0; i < names->size(); ++i) {
    auto column = named(names->at(i));
    if (units != nullptr && i < units->size()) column.unit = without_brackets(units->at(i));
    if (column.unit == "-") column.unit.clear();
    column.is_time = says_time(column);
    head.columns.push_back(column);
  }
}

/// A format: what gives it away, and how its header is read.
struct FormatRow {
  std::string_view name;
  std::string_view mark;  ///< a cell of its header that no other has; "" = it has none
  void (*read)(const Above& above, ExportHead& head);
};
constexpr std::array formats = {
    // in the order of Format
    FormatRow{"twincat", "SampleTime[ms]", read_twincat},
    FormatRow{"mr_configurator2", "Number of sampling data", read_mr_configurator2},
    FormatRow{"rigol", "Increment", read_rigol},
    FormatRow{"siglent", "Record Length", read_siglent},
    FormatRow{"halsampler", "", read_halsampler},
    FormatRow{"csv", "", read_csv},
};

/// Where the mark of a format stands as a whole cell; nullopt if it does not.
std::optional<std::pair<std::size_t, std::size_t>> find_mark(const FirstLines& beginning,
                                                             const FormatRow& format) {
  for (std::size_t i = 0; i < beginning.lines.size() && !format.mark.empty(); ++i) {
    const std::string_view line = beginning.lines[i];
    const auto at = line.find(format.mark);
    if (at == std::string_view::npos) continue;
    const auto behind = at + format.mark.size();
    const bool begins = at == 0 || line[at - 1] == '"' ||
                        std::ispunct(static_cast<unsigned char>(line[at - 1])) != 0 || line[at - 1] == '\t';
    const bool ends = behind >= line.size() || std::isalnum(static_cast<unsigned char>(line[behind])) == 0;
    if (begins && ends) return std::pair{i, behind};
  }
  return {};
}

/// A comma between cells and in numbers: the data have more cells than the header, or not always as many.
std::optional<HeadFault> fault_of_commas(const FirstLines& beginning, const Above& above,
                                         const ExportHead& head) {
  const auto* const last = above.from_below(0);
  const bool is_remark = last != nullptr && last->front().starts_with('#');
  auto columns = head.columns.size();
  if (columns == 0 && last != nullptr && !is_remark) columns = last->size();
  if (columns == 0) columns = static_cast<std::size_t>(head.width);
  std::vector<std::string_view> cells;
  for (auto i = static_cast<std::size_t>(head.first_line - 1); i < beginning.lines.size(); ++i) {
    split(beginning.lines[i], head.dialect, cells);
    if (cells.size() > columns && cells.size() <= 2 * columns && !is_blank(beginning.lines[i]))
      return HeadFault{HeadFault::Kind::ambiguous_comma, static_cast<int>(i) + 1};
  }
  return {};
}

/// The first cell with a sign between thousands.
std::optional<HeadFault> fault_of_thousands(const FirstLines& beginning, const ExportHead& head) {
  std::vector<std::string_view> cells;
  for (auto i = static_cast<std::size_t>(head.first_line - 1); i < beginning.lines.size(); ++i) {
    const std::string_view line = beginning.lines[i];
    if (!is_data(line, head.dialect)) continue;
    split(line, head.dialect, cells);
    for (const auto cell : cells)
      if (has_thousands(cell, head.dialect.decimal))
        return HeadFault{HeadFault::Kind::thousands, static_cast<int>(i) + 1,
                         static_cast<int>(cell.data() - line.data()) + 1};
  }
  return {};
}

void cut_above(const FirstLines& beginning, std::size_t lines, const Dialect& dialect, bool is_twincat,
               Above& above) {
  std::vector<std::string_view> cells;
  for (std::size_t i = 0; i < lines; ++i) {
    auto text = as_utf8(beginning.lines[i]);
    // TwinCAT with blanks between its cells writes "V (Voltage)" as it stands.
    if (is_twincat && dialect.separator == ' ' && text.starts_with("Unit "))
      for (auto open = text.find(" ("); open != std::string::npos; open = text.find(" (", open + 1))
        if (text.compare(open, 7, " (None)") != 0)
          text.erase(open, std::min(text.find(')', open), text.size() - 1) - open + 1);
    split(text, dialect, cells);
    if (!trimmed(text).empty()) above.rows.emplace_back(cells.begin(), cells.end());
  }
}

}  // namespace

const std::vector<std::string>& format_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all(formats.size());
    std::transform(formats.begin(), formats.end(), all.begin(),
                   [](const FormatRow& row) { return std::string(row.name); });
    return all;
  }();
  return names;
}

std::string_view name_alone(std::string_view header) {
  return trimmed(header.substr(0, std::min(header.find_first_of("[("), header.find(slash))));
}

ExportHead head_of(const FirstLines& beginning, const Given& given, std::optional<HeadFault>& fault) {
  ExportHead head;
  fault = fault_of_bytes(beginning);
  if (fault) return head;
  auto known = given;
  const bool may_be_any = !given.format;
  for (std::size_t i = 0; i < formats.size(); ++i) {
    const auto format = static_cast<Format>(i);
    if (!may_be_any && format != *given.format) continue;
    const auto mark = find_mark(beginning, formats[i]);
    if (may_be_any && !mark) continue;
    known.format = format;
    // Behind TwinCAT's key stands the separator, whatever else is in the file.
    if (format == Format::twincat && mark && !known.separator) {
      const std::string_view line = beginning.lines[mark->first];
      const auto at = mark->second + (mark->second < line.size() && line[mark->second] == '"' ? 1 : 0);
      if (at < line.size()) known.separator = line[at];
    }
    break;
  }
  const bool is_twincat = known.format == Format::twincat;
  head.dialect = dialect_of(beginning, known, is_twincat);
  const auto block = block_of(beginning, head.dialect);
  if (block.lines == 0) {
    fault = HeadFault{HeadFault::Kind::no_data, static_cast<int>(beginning.lines.size())};
    return head;
  }
  head.first_line = static_cast<int>(block.first) + 1;
  head.width = block.width;
  const bool is_bare = block.first == 0 && head.dialect.merges_blanks;
  head.format = known.format.value_or(is_bare ? Format::halsampler : Format::csv);
  Above above;
  cut_above(beginning, block.first, head.dialect, is_twincat, above);
  if (!above.rows.empty()) formats[static_cast<std::size_t>(head.format)].read(above, head);
  if (head.dialect.separator == ',' && !given.separator) fault = fault_of_commas(beginning, above, head);
  if (!fault) fault = fault_of_thousands(beginning, head);
  for (auto i = head.columns.size(); i < static_cast<std::size_t>(head.width); ++i)
    head.columns.push_back({""});
  return head;
}

}  // namespace drycut::sim::recordings
