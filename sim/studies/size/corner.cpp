#include "sim/studies/size/corner.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/text.hpp"
#include "sim/file.hpp"
#include "sim/loop/simulation.hpp"
#include "sim/studies/recorded_csv.hpp"

namespace drycut::sim::studies {

namespace {

constexpr auto* at_option = "--at";

std::string corner_name(const std::vector<scenario::Override>& overrides) {
  std::vector<std::string> words;
  for (const auto& [path, value] : overrides) {
    std::string_view name = path;
    for (const std::string_view root : {"variables.", "plants."})
      if (name.starts_with(root)) name.remove_prefix(root.size());
    words.push_back(fmt::format("{}={}", name, value));
  }
  return fmt::format("{}", fmt::join(words, ", "));
}

void add_corner(Corner corner, std::vector<Corner>& corners) {
  corner.name = corner_name(corner.overrides);
  const bool known = std::any_of(corners.begin(), corners.end(),
                                 [&](const auto& other) { return other.name == corner.name; });
  if (!known) corners.push_back(std::move(corner));
}

void read_corner(const std::string& text, std::vector<Corner>& corners, Problems& problems) {
  Corner corner;
  const auto before = problems.size();
  for (std::size_t at = 0; at <= text.size(); ++at) {
    const auto comma = std::min(text.find(',', at), text.size());
    const auto item = text.substr(at, comma - at);
    const auto equals = item.find('=');
    const std::string path(trimmed(std::string_view(item).substr(0, equals)));
    if (equals == std::string::npos || path.empty())
      problems.push_back({"study.argument"_code, at_option, 1, static_cast<int>(at) + 1,
                          fmt::format("'{}' is no PATH=VALUE", trimmed(item)),
                          "such as --at \"variables.length=500 mm,plants.web.speed=120 m/min\""});
    else if (std::any_of(corner.overrides.begin(), corner.overrides.end(),
                         [&](const auto& other) { return other.path == path; }))
      problems.push_back({"study.twice"_code, at_option, 1, static_cast<int>(at) + 1,
                          fmt::format("{} is given twice", path), "keep one"});
    else
      corner.overrides.push_back({path, std::string(trimmed(std::string_view(item).substr(equals + 1)))});
    at = comma;
  }
  if (problems.size() == before) add_corner(std::move(corner), corners);
}

/// "variables.length [mm]" in two.
std::pair<std::string, std::string> path_and_unit(const std::string& heading) {
  const auto bracket = heading.rfind(" [");
  if (bracket == std::string::npos || !heading.ends_with(']')) return {heading, ""};
  return {heading.substr(0, bracket), heading.substr(bracket + 2, heading.size() - bracket - 3)};
}

/// `scene` is what the scenario is called in an envelope of several.
void read_envelope(const std::filesystem::path& file, const std::string& scene, std::vector<Corner>& corners,
                   Problems& problems) {
  const auto text = read_file(file, problems);
  if (!text) return;
  cams::TableProblems broken(file.string(), problems);
  CsvRows rows(*text, broken);
  CsvRow row;
  const bool any = rows.next(row);
  const auto heading = row.cells;
  const auto find = [&](std::string_view name) {
    return static_cast<std::size_t>(
        std::find_if(heading.begin(), heading.end(),
                     [&](const auto& cell) { return cell.text.starts_with(name); }) -
        heading.begin());
  };
  const auto verdict = any ? find("verdict") : 0;
  const bool has_stretch = find("holds from") < heading.size() || find("holds to") < heading.size();
  if (verdict == 0 || verdict >= heading.size() || !has_stretch) {
    if (broken.none())
      broken.add("file.other-kind"_code, 1, 1, "this is no envelope.csv", "drycut envelope writes one");
    return;
  }
  const std::size_t first = heading.front().text == "scene" ? 1 : 0;
  std::size_t taken = 0;
  std::size_t own = 0;
  while (rows.next(row)) {
    const auto& cells = row.cells;
    if (cells.size() != heading.size()) {
      broken.add("record.damaged"_code, row.line, 1,
                 fmt::format("{} cells, where the heading has {}", cells.size(), heading.size()),
                 "run the envelope again: it writes the file");
      continue;
    }
    if (first == 1 && cells.front().text != scene) continue;
    ++own;
    if (cells[verdict].text == "nowhere") continue;
    Corner corner;
    for (std::size_t i = first; i < verdict; ++i) {
      const auto [path, unit] = path_and_unit(heading[i].text);
      if (cells[i].text.empty())
        broken.add("record.damaged"_code, row.line, cells[i].column, fmt::format("{} has no value", path),
                   "a number, as the envelope found it");
      corner.overrides.push_back({path, unit.empty() ? cells[i].text : cells[i].text + " " + unit});
    }
    ++taken;
    add_corner(std::move(corner), corners);
  }
  if (own == 0 && broken.none())
    broken.add("study.unknown-name"_code, 1, 1, fmt::format("it has no points of the scene {}", scene),
               "the envelope of this scenario, or the scenario of this envelope");
  else if (taken == 0 && broken.none())
    broken.add("study.argument"_code, 1, 1, "at none of its points everything holds",
               "an envelope with a point at which it does");
}

/// What the scenario says against it; an override's problems come under the corner's name.
void check_corner(const Corner& corner, const std::string& from, const PointQuestion& question,
                  const std::vector<std::string>& sized, Problems& problems) {
  for (const auto& override : corner.overrides) {
    const bool is_sized = std::any_of(sized.begin(), sized.end(),
                                      [&](const auto& begin) { return override.path.starts_with(begin); });
    if (is_sized)
      problems.push_back({"option.does-not-apply"_code, from, 1, 1,
                          fmt::format("{} is what is sized", override.path),
                          "a corner says what the line must do; --set is for what stays as it is"});
  }
  auto point = read_point(question, corner.overrides);
  if (point.problems.empty()) const loop::Simulation machine(point.scenario, point.problems);
  for (auto& problem : point.problems) {
    problem.what = fmt::format("{}: {}", corner.name, problem.what);
    problem.file = from;
    problem.line = problem.column = 1;
    problems.push_back(std::move(problem));
  }
}

}  // namespace

std::vector<Corner> read_corners(const std::vector<std::string>& texts, const std::filesystem::path& file,
                                 const PointQuestion& question, const std::vector<std::string>& sized,
                                 Problems& problems) {
  std::vector<Corner> corners;
  const auto before = problems.size();
  for (const auto& text : texts) read_corner(text, corners, problems);
  const auto typed = corners.size();
  if (!file.empty()) read_envelope(file, question.file.stem().string(), corners, problems);
  if (problems.size() == before)
    for (std::size_t i = 0; i < corners.size(); ++i)
      check_corner(corners[i], i < typed ? at_option : file.string(), question, sized, problems);
  if (texts.empty() && file.empty()) corners.push_back({std::string(scenario_itself), {}});
  return corners;
}

}  // namespace drycut::sim::studies
