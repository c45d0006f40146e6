#include "devices/plcopen/tab_file.hpp"

#include <algorithm>
#include <map>
#include <vector>

#include <fmt/format.h>

namespace drycut::devices::plcopen {
namespace {

const std::vector<std::string>& tab_keys() {
  static const std::vector<std::string> keys{"Tablename",    "Tabletype", "Table-ID",
                                             "Functiontype", "Lines",     "Begintable"};
  return keys;
}

void header_line(TableReader& reader, McCamTable& table, std::map<std::string, int>& seen, int& count,
                 std::string_view line, int number) {
  const std::size_t sign = line.find('=');
  const Word key = word_at(line, number, 0, std::min(sign, line.size()));
  const std::string name = lower(key.text);
  const auto known = std::find_if(tab_keys().begin(), tab_keys().end(),
                                  [&](const std::string& candidate) { return lower(candidate) == name; });
  if (known == tab_keys().end()) {
    const std::string guess = nearest(key.text, tab_keys());
    return reader.fault("cam.unknown-key"_code, key.place, fmt::format("unknown key '{}'", key.text),
                        guess.empty() ? "known are Tablename, Tabletype, Table-ID, Functiontype, Lines"
                                      : fmt::format("did you mean {}?", guess));
  }
  if (sign == std::string_view::npos)
    return reader.fault("cam.missing"_code, key.place, fmt::format("'{}' without a value", key.text),
                        fmt::format("write {} = ...", *known));
  if (const auto [first, is_new] = seen.try_emplace(name, number); !is_new)
    return reader.fault("cam.twice"_code, key.place, fmt::format("a second {}", *known),
                        fmt::format("the first is in line {}", first->second));
  const Word value = word_at(line, number, sign + 1, line.size());
  if (name == "tablename") {
    table.name = value.text;
  } else if (name == "tabletype") {
    table.type = reader.whole(value, 1, 7).value_or(0);
    if (table.type == 6)
      reader.fault("cam.table-form"_code, value.place, "type 6 is of the maker only", "use 1..5 or 7");
  } else if (name == "table-id") {
    table.id = static_cast<std::uint16_t>(reader.whole(value, 1, 65535).value_or(0));
  } else if (name == "functiontype") {
    const std::optional<Interpolation> type = parse_interpolation(value.text);
    if (!type || *type == Interpolation::table_defined)
      reader.fault("cam.interpolation"_code, value.place,
                   fmt::format("'{}' is no interpolation (error 42006)", value.text),
                   "write 0 STEP_DIRECT .. 5 POLY5_LINE");
    table.interpolation = type.value_or(Interpolation::table_defined);
  } else if (name == "lines") {
    count = reader.whole(value, 1, 1'000'000).value_or(-1);
  }
}

}  // namespace

std::optional<McCamTable> parse_tab(std::string_view text, const std::string& file, Problems& problems) {
  TableReader reader(file, problems);
  McCamTable table{.file = file, .name = {}, .type = 0, .values = {}};
  std::map<std::string, int> seen;
  int count = -1;
  enum class Part { header, rows, after } part = Part::header;
  int number = 0;
  int rows = 0;
  for (std::string_view line : split_lines(without_byte_order_mark(text))) {
    ++number;
    line = line.substr(0, std::min(line.find('#'), line.size()));
    const Words words = split_words(line, {number, 1}, " \t\r");
    if (words.empty()) continue;
    const std::string first = lower(words.front().text);
    if (part == Part::after) {
      reader.fault("cam.table-form"_code, words.front().place, "text after EndTable", "take it away");
      break;
    }
    if (part == Part::rows && first == "endtable") {
      part = Part::after;
    } else if (part == Part::rows) {
      ++rows;
      reader.row(table, words, true);
    } else if (first == "begintable") {
      part = Part::rows;
      for (const char* key : {"tabletype", "table-id", "lines"})
        if (!seen.contains(key))
          reader.fault("cam.missing"_code, words.front().place, fmt::format("{} is missing above", key),
                       "write it");
    } else {
      header_line(reader, table, seen, count, line, number);
    }
  }
  if (part == Part::header)
    reader.fault("cam.missing"_code, {std::max(number, 1), 1}, "Begintable is missing",
                 "write it above the rows");
  if (part == Part::rows)
    reader.fault("cam.missing"_code, {std::max(number, 1), 1}, "EndTable is missing",
                 "write it below the rows");
  if (part != Part::header && count >= 0 && rows != count)
    reader.fault("cam.table-form"_code, {seen.at("lines"), 1},
                 fmt::format("Lines = {}, but there are {}", count, rows), fmt::format("write {}", rows));
  if (!reader.sound()) return std::nullopt;
  table.places = reader.rows();
  return table;
}

}  // namespace drycut::devices::plcopen
