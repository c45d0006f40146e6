#include "sim/studies/recorded_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/text.hpp"
#include "sim/loop/known_events.hpp"

namespace drycut::sim::studies {

bool CsvRows::next(CsvRow& row) {
  if (at_ >= text_.size()) return false;
  row.cells.clear();
  row.line = line_;
  begin_ = at_;
  do {
    row.cells.push_back(cell());
  } while (at_ < text_.size() && text_[at_++] == ',');
  ++line_;
  return true;
}

CsvRow::Cell CsvRows::cell() {
  CsvRow::Cell cell{"", static_cast<int>(at_ - begin_) + 1};
  if (at_ < text_.size() && text_[at_] == '"') return quoted_cell(std::move(cell));
  const auto end = std::min(text_.find_first_of(",\n", at_), text_.size());
  cell.text = text_.substr(at_, end - at_);
  if (cell.text.ends_with('\r')) cell.text.pop_back();
  at_ = end;
  return cell;
}

CsvRow::Cell CsvRows::quoted_cell(CsvRow::Cell cell) {
  const int line = line_;
  for (++at_; at_ < text_.size(); ++at_) {
    if (text_[at_] == '\n') ++line_;
    if (text_[at_] == '"') {
      if (!text_.substr(at_ + 1).starts_with('"')) break;
      ++at_;
    }
    cell.text += text_[at_];
  }
  if (at_ == text_.size()) {
    problems_.add("record.damaged"_code, line, cell.column, "the quote is never closed", run_again);
    return cell;
  }
  ++at_;
  const auto end = std::min(text_.find_first_of(",\n", at_), text_.size());
  if (end != at_)
    problems_.add("record.damaged"_code, line_, cell.column, "text behind the closing quote", run_again);
  at_ = end;
  return cell;
}

std::string csv_quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c == '\n' ? ' ' : c;
  }
  return out + "\"";
}

std::optional<double> number_of(std::string_view text) {
  double number = 0;
  const auto* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, number);
  if (text.empty() || read.ec != std::errc() || read.ptr != end) return {};
  return number;
}

namespace {

std::optional<double> number_in(const CsvRow::Cell& cell, int line, cams::TableProblems& problems) {
  const auto number = number_of(cell.text);
  if (!number)
    problems.add("record.damaged"_code, line, cell.column,
                 fmt::format("{} is not a number", in_quotes(cell.text)), run_again);
  return number;
}

/// A time that a simulation can have reached, to the nanosecond.
std::optional<Time> time_of(const CsvRow::Cell& cell, int line, cams::TableProblems& problems) {
  const auto number = number_in(cell, line, problems);
  if (!number) return {};
  if (*number >= 0 && *number < 1e9) return std::llround(*number * static_cast<double>(second));
  problems.add("record.damaged"_code, line, cell.column,
               fmt::format("{} is no time of a run", in_quotes(cell.text)), run_again);
  return {};
}

bool has_width(const CsvRow& row, std::size_t width, cams::TableProblems& problems) {
  if (row.cells.size() == width) return true;
  problems.add("record.damaged"_code, row.line, 1,
               fmt::format("{}, the header has {}", counted(row.cells.size(), "cell"), width), run_again);
  return false;
}

/// "knife.angle [deg]"
void add_column(const CsvRow::Cell& cell, record::Recording& recording, cams::TableProblems& problems) {
  const auto open = cell.text.rfind(" [");
  if (open == std::string::npos || open == 0 || !cell.text.ends_with(']')) {
    problems.add("record.damaged"_code, 1, cell.column,
                 fmt::format("{} is no channel with its unit", in_quotes(cell.text)),
                 "the header has channel [unit], as drycut run writes it");
    recording.add(cell.text, "");
    return;
  }
  auto unit = cell.text.substr(open + 2, cell.text.size() - open - 3);
  if (unit == "-") unit.clear();
  const auto name = cell.text.substr(0, open);
  if (recording.column(name) != nullptr)
    problems.add("record.damaged"_code, 1, cell.column,
                 fmt::format("channel {} stands twice", in_quotes(name)), run_again);
  recording.add(name, std::move(unit));
}

/// The next of the pieces that "; " separates.
std::string_view take_piece(std::string_view& rest) {
  const auto end = std::min(rest.find("; "), rest.size());
  const auto piece = rest.substr(0, end);
  rest.remove_prefix(std::min(rest.size(), end + 2));
  return piece;
}

/// "length=800.012 mm"; nothing if the piece is the event's text.
std::optional<record::RecordedEvent::Value> value_of(std::string_view piece) {
  const auto equals = piece.find('=');
  const auto name = piece.substr(0, equals);
  if (equals == std::string_view::npos || name.empty() || name.find(' ') != std::string_view::npos) return {};
  const auto rest = piece.substr(equals + 1);
  const auto blank = std::min(rest.find(' '), rest.size());
  const auto number = number_of(rest.substr(0, blank));
  if (!number) return {};
  return record::RecordedEvent::Value{std::string(name), *number,
                                      std::string(rest.substr(std::min(rest.size(), blank + 1)))};
}

/// What follows the first piece that is no value is the event's text.
void take_values(std::string_view rest, record::RecordedEvent& event) {
  while (!rest.empty()) {
    const auto before = rest;
    auto value = value_of(take_piece(rest));
    if (!value) {
      event.text = before;
      return;
    }
    event.values.push_back(std::move(*value));
  }
}

bool read_header(CsvRows& rows, CsvRow& row, std::string_view wanted, cams::TableProblems& problems) {
  if (rows.next(row) && row.cells[0].text == "time [s]") return true;
  problems.add("record.damaged"_code, 1, 1, "the header does not begin with time [s]",
               fmt::format("the first line is {}", wanted));
  return false;
}

}  // namespace

record::Recording read_trace(std::string_view text, const std::string& file, Problems& problems) {
  cams::TableProblems found(file, problems);
  CsvRows rows(text, found);
  CsvRow row;
  if (!read_header(rows, row, "time [s],channel [unit],...", found)) return {};
  record::Recording recording;
  for (std::size_t i = 1; i < row.cells.size(); ++i) add_column(row.cells[i], recording, found);
  const auto width = row.cells.size();
  std::vector<double> numbers(width - 1);
  Time last = -1;
  while (!found.full() && rows.next(row)) {
    if (!has_width(row, width, found)) continue;
    const auto time = time_of(row.cells[0], row.line, found);
    if (time && *time <= last)
      found.add("record.damaged"_code, row.line, 1, "the time does not rise", run_again);
    for (std::size_t i = 0; i < numbers.size(); ++i)
      numbers[i] = number_in(row.cells[i + 1], row.line, found).value_or(0);
    last = time.value_or(last);
    recording.append(last, numbers);
  }
  return recording;
}

void read_events(std::string_view text, const std::string& file, record::Recording& recording,
                 Problems& problems) {
  cams::TableProblems found(file, problems);
  CsvRows rows(text, found);
  CsvRow row;
  if (!read_header(rows, row, "time [s],source,event,values", found)) return;
  constexpr std::size_t width = 4;
  has_width(row, width, found);
  while (!found.full() && rows.next(row)) {
    if (!has_width(row, width, found)) continue;
    const auto time = time_of(row.cells[0], row.line, found);
    record::RecordedEvent event{time.value_or(0),
                                0,
                                row.cells[1].text,
                                row.cells[2].text,
                                {},
                                "",
                                loop::severity_of(row.cells[2].text)};
    take_values(row.cells[3].text, event);
    recording.happened(std::move(event));
  }
}

}  // namespace drycut::sim::studies
