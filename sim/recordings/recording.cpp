#include "sim/recordings/recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>
#include <utility>

#include "base/text.hpp"
#include "sim/file.hpp"
#include "sim/recordings/clock.hpp"
#include "sim/scenario/units.hpp"

namespace drycut::sim::recordings {

namespace {

/// Where a channel's numbers are and what becomes of them.
struct ColumnReader {
  std::size_t column = none;
  std::size_t clock = 0;
  Worth worth;
  const RecordingFile::Channel* channel = nullptr;
  std::size_t empty = 0;  ///< cells
  std::size_t nan = 0;
  int first_empty = 0;  ///< line
  int first_nan = 0;
  int first_clipped = 0;
};

class Loader {
 public:
  Loader(const RecordingFile& recording, Problems& problems, std::vector<Finding>& findings)
      : recording_(recording), problems_(problems), findings_(findings) {}

  Recording load() {
    std::ifstream stream = open();
    if (!stream) return {recording_.export_path(), 0, 0, {}};
    return load(stream);
  }

  Recording load(std::istream& stream) {
    Recording made{recording_.export_path(), 0, 0, {}};
    const auto beginning = first_lines_of(stream);
    std::optional<HeadFault> fault;
    head_ = head_of(beginning, {{recording_.separator, recording_.decimal}, recording_.format}, fault);
    if (fault) {
      problems_.push_back(problem_of(*fault, made.file.string()));
      return made;
    }
    const auto before = problems_.size();
    for (const auto& channel : recording_.channels) place(channel);
    if (problems_.size() != before) return made;
    for (const auto& reader : readers_) made.series.push_back({reader.channel->name.text, reader.worth.unit});
    stream.clear();
    stream.seekg(0);
    read(stream, made);
    tell(made);
    return made;
  }

 private:
  /// As read_file has it, but for the size.
  std::ifstream open() {
    const auto path = recording_.export_path();
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) {
      // Tells what is the matter.
      read_file(path, problems_,
                {recording_.path.string(), recording_.file.place.line, recording_.file.place.column});
      return std::ifstream("");
    }
    std::ifstream stream(path, std::ios::binary);
    if (!stream)
      problems_.push_back(recording_.problem("file.unreadable"_code, recording_.file.place,
                                             fmt::format("{} cannot be read", path.string()),
                                             "check its permissions"));
    return stream;
  }

  /// The column that a text names; none, told, if there is no such one.
  std::size_t find(const scenario::Text& wanted) {
    std::vector<std::string> names;
    std::vector<std::size_t> same;
    for (std::size_t i = 0; i < head_.columns.size(); ++i) {
      const auto& name = head_.columns[i].name;
      if (!name.empty()) names.push_back(name);
      if (name == wanted.text && !name.empty()) same.push_back(i);
    }
    if (same.size() == 1) return same.front();
    if (same.size() > 1) {
      problems_.push_back(
          recording_.problem("recording.column-twice"_code, wanted.place,
                             fmt::format("{} columns are called {}", same.size(), in_quotes(wanted.text)),
                             fmt::format("name it by its number: {}", numbers(same))));
      return none;
    }
    const auto number = parsed<std::size_t>(wanted.text);
    if (number && *number >= 1 && *number <= head_.columns.size()) return *number - 1;
    const auto count = fmt::format("columns are 1 to {}", head_.columns.size());
    problems_.push_back(recording_.problem("recording.unknown-column"_code, wanted.place,
                                           fmt::format("the file has no column {}", in_quotes(wanted.text)),
                                           names.empty() ? count : did_you_mean(wanted.text, names)));
    return none;
  }

  static std::string numbers(const std::vector<std::size_t>& columns) {
    std::vector<std::string> all(columns.size());
    std::transform(columns.begin(), columns.end(), all.begin(),
                   [](std::size_t column) { return std::to_string(column + 1); });
    return listed(all);
  }

  void place(const RecordingFile::Channel& channel) {
    ColumnReader reader;
    reader.channel = &channel;
    reader.column = find(channel.column);
    if (reader.column == none) return;
    reader.worth = worth_of(channel);
    if (const auto source = time_of(channel, reader.column)) {
      reader.clock = clock_of(*source);
      readers_.push_back(reader);
    }
  }

  /// How a channel's time is told; nothing, and a problem, if by nothing.
  std::optional<TimeSource> time_of(const RecordingFile::Channel& channel, std::size_t column) {
    const auto& time = recording_.time;
    TimeSource source;
    source.step = time.rate > 0 ? 1 / time.rate : head_.interval.value_or(0);
    source.start = time.start != 0 ? time.start : head_.start;
    source.is_told = time.rate > 0;
    const auto& own = channel.time.text.empty() ? time.column : channel.time;
    if (!own.text.empty()) {
      source.column = find(own);
      if (source.column == none) return {};
    } else if (time.rate == 0) {
      source.column = head_.columns[column].time;
      for (std::size_t i = 0; source.column == none && i < head_.columns.size(); ++i)
        if (head_.columns[i].is_time && head_.format != Format::twincat) source.column = i;
    }
    if (source.column == none) {
      if (source.step > 0) return source;
      problems_.push_back(
          recording_.problem("recording.no-time"_code, channel.name.place,
                             fmt::format("{} has no time, and the file tells no rate", channel.name.text),
                             "add time: {column: 1, unit: ms} or time: {rate: 1 kHz}"));
      return {};
    }
    const auto unit =
        time.unit.text.empty() ? unit_of_time(head_.columns[source.column].unit) : time.unit.text;
    source.unit = unit.empty() ? source.step : scenario::to_si(1, unit);
    source.counts = unit.empty();
    if (source.unit > 0) return source;
    problems_.push_back(
        recording_.problem("recording.no-time"_code, own.place.line > 0 ? own.place : channel.name.place,
                           fmt::format("the unit of the time of {} is not known", channel.name.text),
                           "add time: {unit: ms} or what the tool is set to"));
    return {};
  }

  std::size_t clock_of(const TimeSource& source) {
    for (std::size_t i = 0; i < clocks_.size(); ++i)
      if (clocks_[i].source == source) return i;
    clocks_.push_back(Clock{source});
    return clocks_.size() - 1;
  }

  void read(std::istream& stream, Recording& made) {
    const auto file = made.file.string();
    LineStream lines(stream);
    std::string_view line;
    std::vector<std::string_view> cells;
    std::size_t row = 0;
    while (lines.next(line)) {
      if (lines.number() < head_.first_line || is_blank(line)) continue;
      ++row;
      if (recording_.rows && (static_cast<double>(row) < recording_.rows->first ||
                              static_cast<double>(row) > recording_.rows->second))
        continue;
      if (is_given_up_) continue;  // the checksum is of the whole
      split(line, head_.dialect, cells);
      if (cells.size() > head_.columns.size())
        refuse("recording.cells"_code, lines.number(), 1,
               fmt::format("{}, the header has {}", counted(static_cast<std::int64_t>(cells.size()), "cell"),
                           head_.columns.size()),
               "export it with another separator, or without a comma in its numbers");
      take(cells, line, lines.number(), row - 1, made);
      ++made.rows;
    }
    made.checksum = lines.checksum();
    if (made.rows == 0)
      problems_.push_back(
          {"recording.no-rows"_code, file, std::max(1, lines.number()), 1,
           recording_.rows ? "none of its rows is among those that are wanted" : "there are no rows of data",
           "take other rows, or export it again"});
  }

  void take(const std::vector<std::string_view>& cells, std::string_view line, int number, std::size_t row,
            Recording& made) {
    for (auto& clock : clocks_) {
      const auto cell = clock.source.column == none
                            ? DataCell{DataCell::Kind::number, static_cast<double>(row)}
                            : cell_at(cells, clock.source.column, head_.dialect.decimal);
      if (cell.kind == DataCell::Kind::text) refuse_text(cells[clock.source.column], line, number);
      const auto went_back = clock.take(cell, number);
      if (went_back)
        refuse("recording.time-goes-back"_code, number, 1,
               fmt::format("the time goes back, from {:g} s to {:g} s", went_back->first, went_back->second),
               fmt::format("two recordings? take the rows of one: rows: [1, {}]", row));
    }
    for (std::size_t i = 0; i < readers_.size(); ++i) {
      auto& reader = readers_[i];
      const auto& clock = clocks_[reader.clock];
      const auto cell = cell_at(cells, reader.column, head_.dialect.decimal);
      if (cell.kind == DataCell::Kind::text) refuse_text(cells[reader.column], line, number);
      if (!clock.now) continue;
      if (cell.kind == DataCell::Kind::number) {
        append(reader, *clock.now, cell.value, number, made.series[i]);
      } else if (cell.kind == DataCell::Kind::empty) {
        if (reader.empty++ == 0) reader.first_empty = number;
      } else if (reader.nan++ == 0) {
        reader.first_nan = number;
      }
    }
  }

  static void append(ColumnReader& reader, double time, double number, int line, Series& series) {
    const auto& channel = *reader.channel;
    constexpr double sign_bit = 32768;
    if (channel.clipped && number == *channel.clipped) {
      if (series.clipped.empty()) reader.first_clipped = line;
      series.clipped.push_back(series.value.size());
    }
    if (channel.numbers != Numbers::plain && number >= sign_bit)
      number = channel.numbers == Numbers::sign_magnitude ? sign_bit - number : number - 2 * sign_bit;
    series.time_s.push_back(time - channel.delay);
    series.value.push_back(number * reader.worth.factor + reader.worth.offset);
  }

  void refuse_text(std::string_view cell, std::string_view line, int number) {
    const auto at = cell.data() >= line.data() ? cell.data() - line.data() : 0;
    refuse("recording.not-a-number"_code, number, static_cast<int>(at) + 1,
           fmt::format("{} is not a number", in_quotes(as_utf8(cell))),
           "leave the rows out with rows: [1, 5000], or export it again");
  }

  void refuse(Code code, int line, int column, std::string what, std::string remedy) {
    constexpr int most = 20;
    const auto file = recording_.export_path().string();
    problems_.push_back({code, file, line, column, std::move(what), std::move(remedy)});
    if (++refused_ < most) return;
    is_given_up_ = true;
    problems_.push_back({"text.too-many-problems"_code, file, line, column,
                         "too many problems: the rest is not told", "is this what the format says?"});
  }

  void doubt(Code code, Finding::Role role, int line, const std::string& text) {
    findings_.emplace_back(code, fmt::format("{}:{}: {}", recording_.export_path().string(), line, text),
                           role);
  }

  void tell(const Recording& made) {
    using Role = Finding::Role;
    for (const auto& clock : clocks_)
      for (const auto& one : doubts_of(clock)) doubt(one.code, Role::warning, one.line, one.text);
    for (std::size_t i = 0; i < readers_.size(); ++i) {
      const auto& reader = readers_[i];
      const auto& series = made.series[i];
      if (reader.nan > 0)
        doubt("recording.nan"_code, Role::warning, reader.first_nan,
              fmt::format("{}: {} without a number, left out", series.channel,
                          counted(static_cast<std::int64_t>(reader.nan), "sample")));
      if (reader.empty > 0)
        doubt("recording.empty-cells"_code, Role::note, reader.first_empty,
              fmt::format("{}: {} empty, left out", series.channel,
                          counted(static_cast<std::int64_t>(reader.empty), "cell")));
      if (!series.clipped.empty())
        doubt("recording.clipped"_code, Role::warning, reader.first_clipped,
              fmt::format("{}: {} clipped, from {:g} s on", series.channel,
                          counted(static_cast<std::int64_t>(series.clipped.size()), "sample"),
                          series.time_s[series.clipped.front()]));
      if (made.rows > 0 && series.value.empty() && refused_ == 0)
        problems_.push_back(recording_.problem("recording.no-rows"_code, reader.channel->column.place,
                                               fmt::format("{}: its column has no numbers", series.channel),
                                               "name another column"));
    }
  }

  const RecordingFile& recording_;
  Problems& problems_;
  std::vector<Finding>& findings_;
  ExportHead head_;
  std::vector<Clock> clocks_;
  std::vector<ColumnReader> readers_;
  int refused_ = 0;
  bool is_given_up_ = false;
};

}  // namespace

Series without_clipped(const Series& series) {
  Series usable{series.channel, series.unit};
  auto clipped = series.clipped.begin();
  for (std::size_t i = 0; i < series.value.size(); ++i) {
    if (clipped != series.clipped.end() && *clipped == i) {
      ++clipped;
      continue;
    }
    usable.time_s.push_back(series.time_s[i]);
    usable.value.push_back(series.value[i]);
  }
  return usable;
}

double Recording::begin() const {
  double first = std::numeric_limits<double>::infinity();
  for (const auto& one : series)
    if (!one.time_s.empty()) first = std::min(first, one.time_s.front());
  return first;
}

Recording load(const RecordingFile& recording, Problems& problems, std::vector<Finding>& findings) {
  return Loader(recording, problems, findings).load();
}

Recording load(const RecordingFile& recording, std::string bytes, Problems& problems,
               std::vector<Finding>& findings) {
  std::istringstream stream(std::move(bytes));
  return Loader(recording, problems, findings).load(stream);
}

}  // namespace drycut::sim::recordings
