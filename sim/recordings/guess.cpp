#include "sim/recordings/guess.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>

#include "base/text.hpp"
#include "sim/file.hpp"
#include "sim/record/own_file.hpp"
#include "sim/scenario/format.hpp"
#include "sim/scenario/units.hpp"

namespace drycut::sim::recordings {

namespace {

using Values = std::vector<double>;

/// Whether a column has times of day.
bool has_moments(const FirstLines& beginning, const ExportHead& head, std::size_t column) {
  std::vector<std::string_view> cells;
  split(beginning.lines[static_cast<std::size_t>(head.first_line - 1)], head.dialect, cells);
  return cell_at(cells, column, head.dialect.decimal).is_moment;
}

/// The columns of the first rows; what is no number is left out.
std::vector<Values> first_rows(const FirstLines& beginning, const ExportHead& head) {
  std::vector<Values> columns(head.columns.size());
  std::vector<std::string_view> cells;
  for (auto i = static_cast<std::size_t>(head.first_line - 1); i < beginning.lines.size(); ++i) {
    split(beginning.lines[i], head.dialect, cells);
    for (std::size_t c = 0; c < columns.size(); ++c)
      if (const auto cell = cell_at(cells, c, head.dialect.decimal); cell.kind == DataCell::Kind::number)
        columns[c].push_back(cell.value);
  }
  return columns;
}

bool is_whole(double number) { return std::floor(number) == number; }

/// Whether the numbers of a column rise all the time, and most of them by one, as the numbers of samples do.
struct Rise {
  bool rises = false;
  bool by_one = false;
};
Rise rise_of(const Values& numbers) {
  if (numbers.size() < 3) return {};
  const auto falls = std::adjacent_find(numbers.begin(), numbers.end(), std::greater_equal());
  std::size_t ones = 0;
  for (std::size_t i = 1; i < numbers.size(); ++i) ones += numbers[i] - numbers[i - 1] == 1 ? 1 : 0;
  return {falls == numbers.end(), is_whole(numbers.front()) && 2 * ones > numbers.size() - 1};
}

/// Units as exports write them, as drycut does.
struct UnitSpelling {
  std::string_view written;
  std::string_view unit;
};
constexpr std::array spellings = {UnitSpelling{"1/min", "rpm"},
                                  UnitSpelling{"r/min", "rpm"},
                                  UnitSpelling{"u/min", "rpm"},
                                  UnitSpelling{"min-1", "rpm"},
                                  UnitSpelling{"volt", "V"},
                                  UnitSpelling{"volts", "V"},
                                  UnitSpelling{"ampere", "A"},
                                  UnitSpelling{"inc", "counts"},
                                  UnitSpelling{"incr", "counts"},
                                  UnitSpelling{"ink", "counts"},
                                  UnitSpelling{"inkr", "counts"},
                                  UnitSpelling{"inkremente", "counts"},
                                  UnitSpelling{"increments", "counts"},
                                  UnitSpelling{"pulses", "counts"},
                                  UnitSpelling{"pls", "counts"},
                                  UnitSpelling{"pulse", "counts"},
                                  UnitSpelling{"\u00b0", "deg"},
                                  UnitSpelling{"\u00b0/s", "deg/s"},
                                  UnitSpelling{"\u2030", "permille"},
                                  UnitSpelling{"1/1000", "permille"},
                                  UnitSpelling{"mm/sec", "mm/s"},
                                  UnitSpelling{"sec", "s"}};

std::string unit_of(std::string written) {
  while (written.ends_with('.')) written.pop_back();  // "Inkr."
  for (const auto& [known, unit] : spellings)
    if (same_word(known, written)) return std::string(unit);
  if (!written.empty() && scenario::is_unit(written)) return written;
  const auto small = lower(written);
  return !small.empty() && scenario::is_unit(small) ? small : "";
}

/// A name for a channel, of what stands over the column.
std::string channel_name(const std::string& header, std::size_t column) {
  std::string name;
  for (const char c : name_alone(header)) name += in_name(c) || c == '.' ? c : '_';
  while (name.ends_with('_') || name.ends_with('.')) name.pop_back();
  return name.empty() || is_digit(name.front()) ? fmt::format("column_{}", column + 1) : name;
}

class Guesser {
 public:
  Guesser(const FirstLines& beginning, const ExportHead& head)
      : beginning_(beginning), head_(head), columns_(first_rows(beginning, head)) {}

  Guess guess(std::string file, std::filesystem::path yaml) {
    auto& recording = guess_.recording;
    recording.path = std::move(yaml);
    recording.file.text = std::move(file);
    recording.format = head_.format;
    recording.separator = head_.dialect.separator;
    recording.decimal = head_.dialect.decimal;
    remark("file:", fmt::format("its data begin in line {}, {}", head_.first_line,
                                counted(static_cast<std::int64_t>(head_.columns.size()), "column")));
    time();
    for (std::size_t i = 0; i < head_.columns.size(); ++i) channel(i);
    remark("channels:", "name them as the machine does: knife.motor.torque");
    return std::move(guess_);
  }

 private:
  void remark(std::string key, std::string text) {
    guess_.remarks.emplace_back(std::move(key), std::move(text));
  }

  /// A column's name where only it has it; else its number.
  [[nodiscard]] std::string reference(std::size_t column) const {
    const auto& name = head_.columns[column].name;
    const auto same = std::count_if(head_.columns.begin(), head_.columns.end(),
                                    [&](const ExportColumn& other) { return other.name == name; });
    return name.empty() || same > 1 ? std::to_string(column + 1) : name;
  }

  [[nodiscard]] std::size_t find(bool ExportColumn::*is) const {
    for (std::size_t i = 0; i < head_.columns.size(); ++i)
      if (head_.columns[i].*is) return i;
    return none;
  }

  void time() {
    auto& time = guess_.recording.time;
    const auto told = find(&ExportColumn::is_time);
    const auto counted = find(&ExportColumn::counts_samples);
    if (head_.format == Format::twincat) {
      time.unit.text = "ms";
      return remark("time:", "each channel has the column of time before it");
    }
    if (told != none && !columns_[told].empty()) return time_column(told);
    if (head_.interval && *head_.interval > 0) {
      time.rate = 1 / *head_.interval;
      time.start = head_.start;
      if (counted != none) skip_ = counted;
      if (counted != none) time.column.text = reference(counted);
      return remark("time:", fmt::format("the header says {:g} s a sample", *head_.interval));
    }
    if (head_.columns.size() > 1 && has_moments(beginning_, head_, 0)) return time_column(0);
    const auto rise = head_.columns.size() > 1 ? rise_of(columns_.front()) : Rise();
    if (!rise.rises) return remark("channels:", "THE FILE HAS NO TIME: add a line time: {rate: 1 kHz}");
    skip_ = 0;
    time.column.text = reference(0);
    remark("time:", rise.by_one ? "it counts samples; ADD THEIR RATE, which is not in the file: rate: 1 kHz"
                                : "it rises all the time; ADD ITS UNIT, which is not in the file: unit: ms");
  }

  void time_column(std::size_t column) {
    auto& time = guess_.recording.time;
    skip_ = column;
    time.column.text = reference(column);
    time.unit.text = unit_of_time(head_.columns[column].unit);
    if (has_moments(beginning_, head_, column)) {
      time.unit.text = "s";
      remark("time:", "times of day");
    } else if (time.unit.text.empty()) {
      remark("time:", "ADD ITS UNIT, which is not in the file: unit: ms");
    } else if (head_.interval) {
      remark("time:", fmt::format("the header says {:g} s a sample; the column is taken", *head_.interval));
    } else {
      remark("time:", "by its header");
    }
  }

  void channel(std::size_t column) {
    const auto& header = head_.columns[column];
    if (header.is_time || header.counts_samples || header.is_unused || column == skip_) return;
    auto& made = guess_.recording.channels.emplace_back();
    made.name.text = unique(channel_name(header.name, column));
    made.column.text = reference(column);
    made.unit.text = unit_of(header.unit);
    std::vector<std::string> says;
    if (made.unit.text.empty())
      says.push_back(header.unit.empty()
                         ? "ADD unit:, which is not in the file"
                         : fmt::format("ADD unit:, the file says {}, which is none that is known",
                                       in_quotes(header.unit)));
    if (made.unit.text == "%" || made.unit.text == "permille")
      says.emplace_back("of what is not in the file: of: 9.55 N m, say, if that is the rated torque");
    if (made.unit.text == "counts")
      says.emplace_back(
          "an encoder's count (knife.encoder.count) needs no more; of a position add what so many are: "
          "of: 1 rev, full: 8192, say");
    if (reference(column) != header.name && !header.name.empty())
      says.emplace_back("several columns have its name");
    numbers(columns_[column], made, says);
    if (!header.remark.empty()) says.push_back(header.remark);
    if (!says.empty())
      remark("  " + scenario::yaml_text(made.name.text) + ":", fmt::format("{}", fmt::join(says, "; ")));
  }

  void numbers(const Values& numbers, RecordingFile::Channel& made, std::vector<std::string>& says) const {
    constexpr double saturated = -32768;
    constexpr double sign_bit = 32768;
    if (head_.format == Format::mr_configurator2 ||
        std::find(numbers.begin(), numbers.end(), saturated) != numbers.end())
      made.clipped = saturated;
    if (numbers.empty()) {
      says.emplace_back("it has no numbers in the first rows");
      return;
    }
    const auto [least, most] = std::minmax_element(numbers.begin(), numbers.end());
    if (*least == *most) says.push_back(fmt::format("always {:g} in the first rows", *least));
    const bool is_word = *least >= 0 && *most >= sign_bit && *most < 2 * sign_bit &&
                         std::all_of(numbers.begin(), numbers.end(), is_whole);
    const auto positive = [](double number) { return number < sign_bit; };
    if (!is_word || std::none_of(numbers.begin(), numbers.end(), positive)) return;
    // Counts that merely grow beyond it do so step by step.
    const auto jumps = [](double a, double b) { return std::abs(a - b) >= sign_bit / 2; };
    if (std::adjacent_find(numbers.begin(), numbers.end(), jumps) == numbers.end()) return;
    // Which reading keeps the negative numbers as small as the others?
    double magnitude = 0;
    double complement = 0;
    for (const double number : numbers)
      if (!positive(number)) {
        magnitude = std::max(magnitude, number - sign_bit);
        complement = std::max(complement, 2 * sign_bit - number);
      }
    made.numbers = magnitude < complement ? Numbers::sign_magnitude : Numbers::twos_complement;
    says.emplace_back("numbers from 32768 on are taken for negative ones");
  }

  std::string unique(const std::string& name) const {
    const auto& channels = guess_.recording.channels;
    auto made = name;
    for (int number = 2; std::any_of(channels.begin(), channels.end() - 1,
                                     [&](const auto& channel) { return channel.name.text == made; });
         ++number)
      made = fmt::format("{}_{}", name, number);
    return made;
  }

  const FirstLines& beginning_;
  const ExportHead& head_;
  std::vector<Values> columns_;
  std::size_t skip_ = none;
  Guess guess_;
};

/// The export as the YAML names it.
std::string relative_to(const std::filesystem::path& file, const std::filesystem::path& yaml) {
  std::error_code error;
  const auto folder = std::filesystem::absolute(yaml).parent_path();
  const auto path = std::filesystem::relative(std::filesystem::absolute(file), folder, error);
  return error || path.empty() ? std::filesystem::absolute(file).string() : path.string();
}

}  // namespace

Guess guess(const std::filesystem::path& file, const std::filesystem::path& yaml, Problems& problems) {
  std::error_code ignored;
  std::ifstream stream;
  if (std::filesystem::is_regular_file(file, ignored)) stream.open(file, std::ios::binary);
  if (!stream.is_open()) {
    read_file(file, problems);
    return {};
  }
  const auto beginning = first_lines_of(stream);
  std::optional<HeadFault> fault;
  const auto head = head_of(beginning, {}, fault);
  if (!fault) return Guesser(beginning, head).guess(relative_to(file, yaml), yaml);
  problems.push_back(problem_of(*fault, file.string()));
  return {};
}

std::string write(const Guess& guess) {
  auto text = fmt::format("# {} import. Look through it, then: drycut check\n", record::own_mark);
  const auto yaml = write(guess.recording);
  for (const auto line : split_lines(yaml)) {
    text += line;
    const char* before = "  # ";
    for (const auto& [key, remark] : guess.remarks) {
      if (!line.starts_with(key)) continue;
      text += before + remark;
      before = "; ";
    }
    text += '\n';
  }
  return text;
}

}  // namespace drycut::sim::recordings
