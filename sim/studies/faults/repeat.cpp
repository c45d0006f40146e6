#include "sim/studies/faults/repeat.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/text.hpp"
#include "sim/scenario/format.hpp"

namespace drycut::sim::studies {

namespace {

/// Lines of a section of a scenario with every default, without its own.
std::string section_in(const std::string& expanded, const std::string& name) {
  std::string lines;
  bool inside = false;
  for (const auto line : split_lines(expanded)) {
    if (inside && !line.starts_with(' ')) break;
    if (inside) lines += std::string(line) + "\n";
    inside = inside || line == name + ":";
  }
  return lines;
}

/// A map in which overrides come to stand: plants: {web: {speed: 80 m/min}}.
struct SetMap {
  std::string name;
  std::vector<SetMap> branches;
  std::string value;

  SetMap& at(const std::string& key) {
    for (auto& branch : branches)
      if (branch.name == key) return branch;
    branches.push_back({key, {}, ""});
    return branches.back();
  }
  [[nodiscard]] std::string text() const {
    if (branches.empty()) return value;
    std::vector<std::string> entries;
    for (const auto& branch : branches)
      entries.push_back(fmt::format("{}: {}", scenario::yaml_text(branch.name), branch.text()));
    return scenario::yaml_map(entries);
  }
};

std::vector<std::string> parts_of(const std::string& path) {
  std::vector<std::string> parts(1);
  for (const char c : path) {
    if (c == '.')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

/// A map cannot name the place in a list, nor a terminal with a dot.
bool goes_into_maps(const std::vector<std::string>& parts) {
  return std::ranges::none_of(parts, [](const std::string& part) {
    return part.empty() || part.find('[') != std::string::npos || std::ranges::all_of(part, is_digit);
  });
}

}  // namespace

CellScenarios::CellScenarios(const FaultQuestion& question, const std::filesystem::path& folder) {
  std::error_code ignored;
  const auto from_there = std::filesystem::relative(question.file, folder, ignored);
  line_ = (from_there.empty() ? question.file : from_there).generic_string();
  Problems none;
  const auto line = scenario::read_scenario_text(question.text, question.file, question.set, none);
  around_ = line.pictures.around.has_value();
  entries_ = section_in(scenario::expand(line), "timeline");
  SetMap root;
  for (const auto& [path, value] : question.set) {
    const auto parts = parts_of(path);
    // The timeline has them already, the pictures are its own.
    if (parts.front() == "timeline" || parts.front() == "pictures" || path == "scene.duration") continue;
    if (!goes_into_maps(parts)) {
      also_.push_back(fmt::format("{}={}", path, value));
      continue;
    }
    auto* branch = &root;
    for (const auto& part : parts) branch = &branch->at(part);
    branch->value = value;
  }
  root.at("scene").at("duration");
  for (const auto& branch : root.branches)
    if (branch.name != "scene")
      sections_.push_back(fmt::format("{}: {}\n", scenario::yaml_text(branch.name), branch.text()));
  std::string scene;
  for (const auto& branch : root.at("scene").branches)
    if (branch.name != "duration") scene += fmt::format(", {}: {}", branch.name, branch.text());
  sections_.insert(sections_.begin(), scene);
}

std::string CellScenarios::text(const Values& values) const {
  auto text = fmt::format("# {}\n# Made by drycut faults. The fault is the last entry of the timeline.\n",
                          values.comment);
  for (const auto& set : also_) text += fmt::format("# Run it with --set {}\n", scenario::yaml_quoted(set));
  text += fmt::format("extends: {}\nscene: {{duration: {}{}}}\n", scenario::yaml_text(line_), values.until,
                      sections_.front());
  for (auto section = sections_.begin() + 1; section != sections_.end(); ++section) text += *section;
  text += fmt::format("timeline:\n{}  - {{at: {}, fault: {{{}: {{{}: {}}}}}}}\n", entries_, values.at,
                      values.component, values.fault, values.quantity);
  text += fmt::format("pictures:\n  frames: {{{}from: {}, until: {}, every: 40 ms}}\n  video: on\n",
                      around_ ? "around: ~, before: ~, after: ~, " : "", values.at, values.until);
  return text;
}

CellScenarios::Values CellScenarios::values_of(const TriedFault& fault, const FaultMoment& moment,
                                               std::string comment) {
  return {std::move(comment),
          fault.component,
          fault.name,
          fault.quantity(),
          scenario::format_time(moment.at),
          scenario::format_time(moment.until)};
}

std::string CellScenarios::file_name(const TriedFault& fault, const FaultMoment& moment) {
  std::string name = fault.full() + "_" + moment.name;
  std::erase(name, '%');
  while (name.ends_with(' ')) name.pop_back();
  std::ranges::replace_if(
      name, [](char c) { return !is_letter(c) && !is_digit(c) && c != '.' && c != '-'; }, '_');
  return name + ".yaml";
}

}  // namespace drycut::sim::studies
