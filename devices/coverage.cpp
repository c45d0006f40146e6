#include "devices/coverage.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.hpp"

namespace drycut::devices {

namespace {

/// The header and every record line of a summary: how many there are, how many ran.
std::string summary(const char* found, std::size_t all, const char* hit, std::size_t run) {
  return fmt::format("{}:{}\n{}:{}\n", found, all, hit, run);
}

}  // namespace

void Coverage::File::line(int number, Count count) {
  Count& known = lines[number];
  known = std::max(known, count);
}

void Coverage::add(const Coverage& other) {
  for (const auto& [name, from] : other.files) {
    File& file = files[name];
    for (const auto& [line, count] : from.lines) file.lines[line] += count;
    for (const auto& [function, count] : from.functions) file.functions[function] += count;
    for (const auto& [line, decisions] : from.decisions) {
      auto& mine = file.decisions[line];
      mine.resize(std::max(mine.size(), decisions.size()));
      for (std::size_t i = 0; i < decisions.size(); ++i) {
        mine[i].resize(std::max(mine[i].size(), decisions[i].size()));
        for (std::size_t way = 0; way < decisions[i].size(); ++way) mine[i][way] += decisions[i][way];
      }
    }
  }
}

CoverageFigures figures_of(const Coverage::File& file) {
  CoverageFigures figures;
  int first = 0;
  int last = 0;
  const auto end_range = [&] {
    if (first == 0) return;
    figures.never += fmt::format("{}{}", figures.never.empty() ? "" : ", ", first);
    if (last > first) figures.never += fmt::format("-{}", last);
    first = 0;
  };
  for (const auto& [line, count] : file.lines) {
    ++figures.lines;
    if (count > 0) {
      ++figures.lines_run;
      end_range();
      continue;
    }
    if (first == 0) first = line;
    last = line;
  }
  end_range();
  for (const auto& [line, decisions] : file.decisions)
    for (const auto& ways : decisions) {
      figures.ways += ways.size();
      figures.ways_taken += static_cast<std::size_t>(
          std::count_if(ways.begin(), ways.end(), [](Coverage::Count count) { return count > 0; }));
    }
  return figures;
}

std::string lcov_text(const Coverage& coverage) {
  std::string text;
  for (const auto& [name, file] : coverage.files) {
    const auto figures = figures_of(file);
    text += fmt::format("{}\nSF:{}\n", lcov_header, name);
    std::size_t called = 0;
    for (const auto& [function, count] : file.functions)
      text += fmt::format("FN:{},{}\n", function.first, function.second);
    for (const auto& [function, count] : file.functions) {
      text += fmt::format("FNDA:{},{}\n", count, function.second);
      called += count > 0 ? 1 : 0;
    }
    text += summary("FNF", file.functions.size(), "FNH", called);
    for (const auto& [line, decisions] : file.decisions)
      for (std::size_t i = 0; i < decisions.size(); ++i) {
        const auto& ways = decisions[i];
        const bool come_by = std::any_of(ways.begin(), ways.end(), [](auto count) { return count > 0; });
        for (std::size_t way = 0; way < ways.size(); ++way)
          text += come_by ? fmt::format("BRDA:{},{},{},{}\n", line, i, way, ways[way])
                          : fmt::format("BRDA:{},{},{},-\n", line, i, way);
      }
    text += summary("BRF", figures.ways, "BRH", figures.ways_taken);
    for (const auto& [line, count] : file.lines) text += fmt::format("DA:{},{}\n", line, count);
    text += summary("LF", figures.lines, "LH", figures.lines_run) + "end_of_record\n";
  }
  return text;
}

bool is_test(std::string_view name) {
  constexpr std::string_view mark = "TEST_";
  return same_word(name.substr(0, mark.size()), mark);
}

}  // namespace drycut::devices
