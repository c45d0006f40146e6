#include "sim/studies/faults/accept.hpp"

#include <fmt/format.h>
#include <fnmatch.h>

#include <optional>

#include "base/text.hpp"
#include "sim/file.hpp"
#include "sim/record/visit.hpp"
#include "sim/scenario/yaml_node.hpp"

namespace drycut::sim::studies {

namespace {

using scenario::YamlNode;

constexpr std::string_view form = "write {fault: ..., when: ..., cell: wrong, why: ...}";

/// "20..45 %"
std::optional<std::pair<double, double>> stretch_in(const std::string& text) {
  const auto dots = text.find("..");
  if (dots == std::string::npos || !text.ends_with('%')) return {};
  const auto low = parsed<double>(trimmed(text.substr(0, dots)));
  const auto high = parsed<double>(trimmed(text.substr(dots + 2, text.size() - dots - 3)));
  if (!low || !high || *low < 0 || *low > *high || *high > 100) return {};
  return std::pair(*low, *high);
}

class EntryReader {
 public:
  EntryReader(const YamlNode& node, scenario::Findings& findings) : node_(node), findings_(findings) {}

  AcceptedCells run() {
    AcceptedCells entry;
    entry.line = node_.text.place.line;
    if (node_.kind != YamlNode::Kind::map) {
      refuse(node_.text.place, "an entry is no map", form);
      return entry;
    }
    entry.fault = word("fault");
    entry.when = word("when");
    entry.why = word("why");
    if (entry.when.find("..") != std::string::npos && !stretch_in(entry.when))
      refuse(place("when"), fmt::format("'{}' is no stretch of a cycle", entry.when),
             "such as 20..45 %, from 0 to 100, or the name of a moment as faults.csv has it");
    const auto cell = word("cell");
    if (cell == record::word_of(FaultCell::Kind::damage))
      entry.cell = FaultCell::Kind::damage;
    else if (!cell.empty() && cell != record::word_of(FaultCell::Kind::wrong))
      refuse(place("cell"), fmt::format("'{}' is no kind of cell that needs to be accepted", cell),
             "wrong or damage");
    for (const auto& [key, value, line] : node_.entries)
      if (key.text != "fault" && key.text != "when" && key.text != "why" && key.text != "cell")
        refuse(key.place, fmt::format("an entry has no key '{}'", key.text), form);
    return entry;
  }

 private:
  void refuse(const scenario::ScenePlace& place, std::string what, std::string_view remedy) {
    findings_.add("faults.bad-entry"_code, place, std::move(what), std::string(remedy));
  }

  [[nodiscard]] const YamlNode* find(std::string_view name) const {
    for (const auto& entry : node_.entries)
      if (entry.key.text == name) return &entry.value;
    return nullptr;
  }
  [[nodiscard]] scenario::ScenePlace place(std::string_view name) const {
    const auto* found = find(name);
    return found == nullptr ? node_.text.place : found->text.place;
  }

  std::string word(std::string_view name) {
    const auto* found = find(name);
    if (found == nullptr) {
      refuse(node_.text.place, fmt::format("an entry lacks {}", name), form);
      return "";
    }
    if (found->kind == YamlNode::Kind::scalar && !found->text.text.empty()) return found->text.text;
    refuse(found->text.place, fmt::format("{} is no text", name), form);
    return "";
  }

  const YamlNode& node_;
  scenario::Findings& findings_;
};

}  // namespace

bool AcceptedCells::covers(const TriedFault& tried, const FaultMoment& moment, const FaultCell& came) const {
  if (came.kind != cell || fnmatch(fault.c_str(), tried.full().c_str(), 0) != 0) return false;
  if (const auto stretch = stretch_in(when))
    return moment.phase && *moment.phase >= stretch->first && *moment.phase <= stretch->second;
  return fnmatch(when.c_str(), moment.name.c_str(), 0) == 0;
}

std::vector<AcceptedCells> read_accepted(const std::filesystem::path& file, Problems& problems) {
  std::vector<AcceptedCells> accepted;
  const auto text = read_file(file, problems);
  if (!text) return accepted;
  scenario::Findings findings({file.string()});
  const auto root = scenario::parse_yaml(*text, 0, findings);
  if (findings.empty() && root.kind != YamlNode::Kind::sequence)
    findings.add("faults.bad-entry"_code, {1, 1, 0}, "it is no list of accepted cells",
                 fmt::format("- {}", form.substr(form.find('{'))));
  if (findings.empty())
    for (const auto& item : root.items) accepted.push_back(EntryReader(item, findings).run());
  for (auto& problem : findings.sorted()) problems.push_back(std::move(problem));
  return accepted;
}

}  // namespace drycut::sim::studies
