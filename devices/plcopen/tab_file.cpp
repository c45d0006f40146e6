#include "devices/plcopen/tab_file.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <vector>

#include <fmt/format.h>

namespace drycut::devices::plcopen {
namespace {

/// A word of a line with its place.
struct Word {
  std::string_view text;
  int column = 0;  ///< 1-based
};

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

bool blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

Word trimmed(std::string_view line, std::size_t begin, std::size_t end) {
  while (begin < end && blank(line[begin])) ++begin;
  while (end > begin && blank(line[end - 1])) --end;
  return {line.substr(begin, end - begin), static_cast<int>(begin) + 1};
}

std::vector<Word> split(std::string_view line, char separator) {
  std::vector<Word> words;
  std::size_t begin = 0;
  while (true) {
    const std::size_t end = std::min(line.find(separator, begin), line.size());
    words.push_back(trimmed(line, begin, end));
    if (end == line.size()) return words;
    begin = end + 1;
  }
}

std::vector<Word> words_of(std::string_view line) {
  std::vector<Word> words;
  std::size_t i = 0;
  while (i < line.size()) {
    while (i < line.size() && blank(line[i])) ++i;
    const std::size_t begin = i;
    while (i < line.size() && !blank(line[i])) ++i;
    if (i > begin) words.push_back({line.substr(begin, i - begin), static_cast<int>(begin) + 1});
  }
  return words;
}

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    lines.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

std::optional<double> number_of(std::string_view text, bool decimal_comma) {
  std::string digits(text);
  if (decimal_comma) std::replace(digits.begin(), digits.end(), ',', '.');
  const char* begin = digits.c_str() + (digits.starts_with('+') ? 1 : 0);
  const char* end = digits.c_str() + digits.size();
  double value = 0;
  const auto [rest, error] = std::from_chars(begin, end, value);
  if (error != std::errc{} || rest != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// What both readers do with a text: faults, and rows into a table.
class Reader {
 public:
  Reader(std::string file, Problems& problems) : file_(std::move(file)), problems_(problems) {}

  void fault(int line, int column, std::string what, std::string remedy) {
    problems_.push_back({file_, line, column, std::move(what), std::move(remedy)});
    ++faults_;
  }
  [[nodiscard]] bool sound() const { return faults_ == 0; }

  void row(CamTable& table, const std::vector<Word>& words, int line, bool decimal_comma) {
    const TableType* type = table_type(table.type);
    if (type == nullptr || type->columns == 0) return;
    if (static_cast<int>(words.size()) != type->columns)
      return fault(line, words.empty() ? 1 : words.front().column, fmt::format("{} numbers", words.size()),
                   fmt::format("a line of type {} ({}) has {}", type->number, type->meaning, type->columns));
    rows_.push_back(line);
    for (const Word& word : words) {
      const std::optional<double> value = number_of(word.text, decimal_comma);
      if (!value) {
        fault(line, word.column, fmt::format("'{}' is no number", word.text), "write digits");
      } else if (type->whole &&
                 (*value != std::round(*value) || *value > type->limit || *value < -type->limit - 1)) {
        fault(line, word.column, fmt::format("{} does not fit {}", word.text, type->meaning),
              fmt::format("write a whole number, {} to {}", -type->limit - 1, type->limit));
      }
      table.values.push_back(value.value_or(0));
    }
  }

  /// The faults that MC_CamIn would find, each with its error id.
  void judge(const CamTable& table, Interpolation interpolation, double modulo, int line) {
    const ErrorId error = check(table, interpolation, modulo);
    if (error == ErrorId::none) return;
    if (error == ErrorId::table_master_order) {
      for (std::size_t i = 0; i < table.lines(); ++i) {
        const bool last = i + 1 == table.lines();
        const double next = last ? table.value(0, 0) + modulo : table.value(i + 1, 0);
        if (next - table.value(i, 0) < 1000) line = rows_[last ? i : i + 1];
      }
    }
    std::string remedy;
    if (error == ErrorId::table_type_mismatch)
      remedy =
          "STEP_DIRECT, LINEAR, POLYNOM_3 take one column, POLYNOM_3_KOEFF a0..a3, LINE_POLY5 and POLY5_LINE "
          "master and slave";
    if (error == ErrorId::table_master_order) remedy = "let the masters ascend inside one turn";
    if (error == ErrorId::table_line_count) remedy = "add or take away a line";
    if (error == ErrorId::position_range) remedy = "keep positions within +-1e12";
    if (error == ErrorId::too_few_lines) remedy = "write one line at least";
    fault(line, 1, fmt::format("error {}: {}", static_cast<unsigned>(error), meaning_of(error)), remedy);
  }

 private:
  std::string file_;
  Problems& problems_;
  int faults_ = 0;
  std::vector<int> rows_;  ///< line of each row of the table
};

const std::vector<std::string>& tab_keys() {
  static const std::vector<std::string> keys{"Tablename",    "Tabletype", "Table-ID",
                                             "Functiontype", "Lines",     "Begintable"};
  return keys;
}

/// A whole number of a header line, or nullopt with a fault.
std::optional<int> whole(Reader& reader, const Word& word, int line, int min, int max) {
  const std::optional<double> value = number_of(word.text, false);
  if (value && *value == std::round(*value) && *value >= min && *value <= max)
    return static_cast<int>(*value);
  reader.fault(line, word.column, fmt::format("'{}' is out of range", word.text),
               fmt::format("write a whole number, {} to {}", min, max));
  return std::nullopt;
}

void header_line(Reader& reader, CamTable& table, std::map<std::string, int>& seen, int& count,
                 std::string_view line, int number) {
  const std::size_t sign = line.find('=');
  const Word key = trimmed(line, 0, std::min(sign, line.size()));
  const std::string name = lower(key.text);
  const auto known = std::find_if(tab_keys().begin(), tab_keys().end(),
                                  [&](const std::string& candidate) { return lower(candidate) == name; });
  if (known == tab_keys().end()) {
    const std::string guess = nearest(std::string(key.text), tab_keys());
    return reader.fault(number, key.column, fmt::format("unknown key '{}'", key.text),
                        guess.empty() ? "known are Tablename, Tabletype, Table-ID, Functiontype, Lines"
                                      : fmt::format("did you mean {}?", guess));
  }
  if (sign == std::string_view::npos)
    return reader.fault(number, key.column, fmt::format("'{}' without a value", key.text),
                        fmt::format("write {} = ...", *known));
  if (const auto [first, is_new] = seen.try_emplace(name, number); !is_new)
    return reader.fault(number, key.column, fmt::format("a second {}", *known),
                        fmt::format("the first is in line {}", first->second));
  const Word value = trimmed(line, sign + 1, line.size());
  if (name == "tablename") {
    table.name = std::string(value.text);
  } else if (name == "tabletype") {
    table.type = whole(reader, value, number, 1, 7).value_or(0);
    if (table.type == 6) reader.fault(number, value.column, "type 6 is of the maker only", "use 1..5 or 7");
  } else if (name == "table-id") {
    table.id = static_cast<std::uint16_t>(whole(reader, value, number, 1, 65535).value_or(0));
  } else if (name == "functiontype") {
    const std::optional<Interpolation> type = parse_interpolation(value.text);
    if (!type || *type == Interpolation::table_defined)
      reader.fault(number, value.column, fmt::format("'{}' is no interpolation (error 42006)", value.text),
                   "write 0 STEP_DIRECT .. 5 POLY5_LINE");
    table.interpolation = type.value_or(Interpolation::table_defined);
  } else if (name == "lines") {
    count = whole(reader, value, number, 1, 1'000'000).value_or(-1);
  }
}

}  // namespace

std::optional<CamTable> parse_tab(std::string_view text, const std::string& file, Problems& problems) {
  Reader reader(file, problems);
  CamTable table{.file = file, .name = {}, .type = 0, .values = {}};
  std::map<std::string, int> seen;
  int count = -1;
  enum class Part { header, rows, after } part = Part::header;
  int number = 0;
  int rows = 0;
  for (std::string_view line : lines_of(text)) {
    ++number;
    line = line.substr(0, std::min(line.find('#'), line.size()));
    const std::vector<Word> words = words_of(line);
    if (words.empty()) continue;
    const std::string first = lower(words.front().text);
    if (part == Part::after) {
      reader.fault(number, words.front().column, "text after EndTable", "take it away");
      break;
    }
    if (part == Part::rows && first == "endtable") {
      part = Part::after;
    } else if (part == Part::rows) {
      ++rows;
      reader.row(table, words, number, true);
    } else if (first == "begintable") {
      part = Part::rows;
      for (const char* key : {"tabletype", "table-id", "lines"})
        if (!seen.contains(key))
          reader.fault(number, words.front().column, fmt::format("{} is missing above", key), "write it");
    } else {
      header_line(reader, table, seen, count, line, number);
    }
  }
  if (part == Part::header) reader.fault(number + 1, 1, "Begintable is missing", "write it above the rows");
  if (part == Part::rows) reader.fault(number + 1, 1, "EndTable is missing", "write it below the rows");
  if (part != Part::header && count >= 0 && rows != count)
    reader.fault(seen.at("lines"), 1, fmt::format("Lines = {}, but there are {}", count, rows),
                 fmt::format("write {}", rows));
  if (!reader.sound()) return std::nullopt;
  return table;
}

namespace {

const std::vector<std::string>& csv_keys() {
  static const std::vector<std::string> keys{"interpolation", "endless", "master_modulo",
                                             "slave_modulo",  "name",    "id"};
  return keys;
}

void csv_key(Reader& reader, CamCsv& cam, bool& named, std::string_view line, int number) {
  const std::size_t colon = line.find(':');
  if (colon == std::string_view::npos) return;  // a remark
  const Word key = trimmed(line, line.find('#') + 1, colon);
  const Word value = trimmed(line, colon + 1, line.size());
  const std::string name = lower(key.text);
  if (std::find(csv_keys().begin(), csv_keys().end(), name) == csv_keys().end()) {
    if (key.text.find(' ') != std::string_view::npos) return;
    const std::string guess = nearest(name, csv_keys());
    return reader.fault(number, key.column, fmt::format("unknown key '{}'", key.text),
                        guess.empty()
                            ? "known are interpolation, endless, master_modulo, slave_modulo, name, id"
                            : fmt::format("did you mean {}?", guess));
  }
  if (name == "name") cam.table.name = std::string(value.text);
  if (name == "id")
    cam.table.id = static_cast<std::uint16_t>(whole(reader, value, number, 1, 65535).value_or(1));
  if (name == "master_modulo")
    cam.master_modulo = whole(reader, value, number, 1, 2147483647).value_or(3600000);
  if (name == "slave_modulo")
    cam.slave_modulo = whole(reader, value, number, 0, 2147483647).value_or(3600000);
  if (name == "endless") {
    const std::string direction = lower(value.text);
    if (direction == "positive") cam.endless = Endless::positive;
    if (direction == "negative") cam.endless = Endless::negative;
    if (direction != "positive" && direction != "negative" && direction != "no")
      reader.fault(number, value.column, fmt::format("endless cannot be '{}'", value.text),
                   "write positive, negative or no");
  }
  if (name == "interpolation") {
    const std::optional<Interpolation> type = parse_interpolation(value.text);
    if (!type || *type == Interpolation::table_defined)
      reader.fault(number, value.column, fmt::format("'{}' is no interpolation (error 42006)", value.text),
                   "write STEP_DIRECT, LINEAR, POLYNOM_3, POLYNOM_3_KOEFF, LINE_POLY5 or POLY5_LINE");
    cam.interpolation = type.value_or(Interpolation::linear);
    named = true;
  }
}

/// The table's type by its header; 0 if it is none.
int csv_type(const std::vector<Word>& header) {
  std::string joined;
  for (const Word& word : header) joined += lower(word.text) + ' ';
  if (joined == "slave ") return 3;
  if (joined == "master slave ") return 7;
  return joined == "a0 a1 a2 a3 " ? 5 : 0;
}

}  // namespace

std::optional<CamCsv> parse_cam_csv(std::string_view text, const std::string& file, Problems& problems) {
  Reader reader(file, problems);
  CamCsv cam;
  cam.table = {.file = file, .name = {}, .id = 1, .type = 0, .values = {}};
  bool named = false;
  char separator = ',';
  int header = 0;
  int number = 0;
  for (const std::string_view line : lines_of(text)) {
    ++number;
    const Word whole_line = trimmed(line, 0, line.size());
    if (whole_line.text.empty()) continue;
    if (whole_line.text.front() == '#') {
      csv_key(reader, cam, named, line, number);
    } else if (header == 0) {
      header = number;
      separator = line.find(';') != std::string_view::npos ? ';' : ',';
      cam.table.type = csv_type(split(line, separator));
      if (cam.table.type == 0) {
        reader.fault(number, whole_line.column, fmt::format("unknown header '{}'", whole_line.text),
                     "write slave, or master,slave, or a0,a1,a2,a3");
        break;
      }
    } else {
      reader.row(cam.table, split(line, separator), number, separator == ';');
    }
  }
  if (header == 0)
    reader.fault(number + 1, 1, "there is no header", "write slave, or master,slave, or a0,a1,a2,a3");
  if (!named && cam.table.type == 7) cam.interpolation = Interpolation::poly5_line;
  if (!named && cam.table.type == 5) cam.interpolation = Interpolation::polynom_3_koeff;
  cam.table.interpolation = cam.interpolation;
  const bool pairs = cam.table.type == 7;
  if (cam.slave_modulo == 0 && (pairs || cam.endless != Endless::no))
    reader.fault(std::max(header, 1), 1, fmt::format("error 60181: {}", meaning_of(ErrorId::not_modulo)),
                 "give slave_modulo a length");
  if (reader.sound()) reader.judge(cam.table, cam.interpolation, cam.master_modulo, header);
  if (!reader.sound()) return std::nullopt;
  return cam;
}

}  // namespace drycut::devices::plcopen
