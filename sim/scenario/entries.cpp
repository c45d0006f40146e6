// timeline and checks: lists of small maps.
#include <fmt/format.h>

#include <limits>
#include <unordered_map>

#include "sim/scenario/sections.hpp"
#include "sim/scenario/yaml_reader.hpp"

namespace drycut::sim {

namespace {

// A value that the timeline writes: a quantity, or a switch position as 1 or 0.
std::optional<Quantity> read_action(const YamlNode::Entry& entry, const std::string& name,
                                    Findings& findings) {
  if (entry.value.kind == YamlNode::Kind::null) {
    findings.add(entry.key.place, fmt::format("{} has no value", name), "write the value to set");
    return {};
  }
  if (entry.value.kind != YamlNode::Kind::scalar) {
    refuse_kind(entry.value, name, YamlNode::Kind::scalar, findings);
    return {};
  }
  const auto& text = entry.value.text;
  if (text.text == "on" || text.text == "true") return Quantity{1, "", text.place};
  if (text.text == "off" || text.text == "false") return Quantity{0, "", text.place};
  return read_quantity(text, name, findings);
}

void read_actions(const YamlNode& map, const std::string& name,
                  std::vector<std::pair<Text, Quantity>>& actions, Findings& findings) {
  refuse_duplicates(map, name, findings);
  for (const auto& entry : map.entries) {
    const auto quantity = read_action(entry, name + "." + entry.key.text, findings);
    if (quantity) actions.emplace_back(entry.key, *quantity);
  }
}

// fault: {knife.encoder: {lose_counts: 200}}
void read_faults(const YamlNode& map, const std::string& name, Stimulus& stimulus, Findings& findings) {
  refuse_duplicates(map, name, findings);
  for (const auto& component : map.entries) {
    const auto full = name + "." + component.key.text;
    if (component.value.kind != YamlNode::Kind::map || component.value.entries.empty()) {
      findings.add(
          component.key.place, fmt::format("{} names no fault", full),
          fmt::format("write {}: {{fault: value}}; 'drycut plants' lists the faults", component.key.text));
      continue;
    }
    refuse_duplicates(component.value, full, findings);
    for (const auto& fault : component.value.entries) {
      const auto value = read_action(fault, full + "." + fault.key.text, findings);
      if (value) stimulus.faults.push_back({component.key, fault.key, *value});
    }
  }
}

Stimulus read_stimulus(const YamlNode& node, const std::string& name, Findings& findings) {
  Stimulus stimulus;
  stimulus.place = node.text.place;
  MapReader reader(node, name, findings);
  reader.time("at", stimulus.at, Sign::not_negative);
  if (reader.find("when") != nullptr) reader.expression("when", stimulus.when.emplace());
  reader.time("after", stimulus.after, Sign::not_negative);
  reader.time("every", stimulus.every, Sign::positive);
  reader.time("over", stimulus.over, Sign::positive);
  if (const auto* map = reader.map("set")) read_actions(*map, name + ".set", stimulus.set, findings);
  if (const auto* map = reader.map("ramp")) read_actions(*map, name + ".ramp", stimulus.ramp, findings);
  if (const auto* map = reader.map("fault")) read_faults(*map, name + ".fault", stimulus, findings);
  if (const auto* text = reader.scalar("power")) {
    stimulus.power = read_switch(*text, name + ".power", findings);
  }
  reader.finish();
  if (node.kind != YamlNode::Kind::map) return stimulus;
  if (!reader.has("at") && !reader.has("when")) {
    findings.add(node.text.place, fmt::format("{} does not say when", name),
                 "add at: 0.5 s, or when: \"...\"");
  }
  if (!reader.has("set") && !reader.has("ramp") && !reader.has("fault") && !reader.has("power")) {
    findings.add(node.text.place, fmt::format("{} does nothing", name), "add set, ramp, fault or power");
  }
  if (reader.has("ramp") && !reader.has("over")) {
    findings.add(reader.place("ramp"), fmt::format("{}.ramp has no duration", name), "add over: 1 s");
  }
  if (reader.has("over") && !reader.has("ramp")) {
    findings.add(reader.place("over"), fmt::format("{}.over stands without ramp", name),
                 "write ramp instead of set, or leave over out");
  }
  return stimulus;
}

struct KindName {
  std::string_view key;
  Check::Kind kind;
};
constexpr KindName kinds[] = {{"each", Check::Kind::each},
                              {"all", Check::Kind::all},
                              {"always", Check::Kind::always},
                              {"eventually", Check::Kind::eventually},
                              {"never", Check::Kind::never}};

// A key that belongs to other kinds of check only.
void refuse_misplaced(MapReader& reader, std::string_view key, std::string_view belongs_to,
                      Findings& findings) {
  if (!reader.has(key)) return;
  findings.add(reader.place(key), fmt::format("{} does not go with this kind of check", reader.full(key)),
               fmt::format("{} belongs to {}", key, belongs_to));
}

void read_window(MapReader& reader, Check& check, Findings& findings) {
  const bool counts = check.kind == Check::Kind::each || check.kind == Check::Kind::all;
  const bool eventually = check.kind == Check::Kind::eventually;
  reader.time("from", check.from, Sign::not_negative);
  reader.time("until", check.until, Sign::positive);
  reader.time("within", check.within, Sign::positive);
  reader.integer("at_least", check.at_least, 0, std::numeric_limits<int>::max());
  if (!eventually) refuse_misplaced(reader, "within", "eventually", findings);
  if (eventually) refuse_misplaced(reader, "until", "each, all, always and never", findings);
  if (!counts) refuse_misplaced(reader, "at_least", "each and all", findings);
  if (check.until && *check.until <= check.from && reader.has("from")) {
    findings.add(reader.place("until"), fmt::format("{} is not after from", reader.full("until")),
                 "let until be later than from");
  }
}

Check read_check(const YamlNode& node, const std::string& name, Findings& findings) {
  Check check;
  MapReader reader(node, name, findings);
  reader.text("name", check.name);
  std::vector<KindName> given;
  for (const auto& kind : kinds) {
    if (reader.find(kind.key) != nullptr) given.push_back(kind);
  }
  if (given.size() > 1) {
    findings.add(reader.place(given[1].key),
                 fmt::format("{} is both {} and {}", name, given[0].key, given[1].key),
                 "make two checks of it");
  } else if (given.empty() && node.kind == YamlNode::Kind::map) {
    findings.add(node.text.place, fmt::format("{} does not say what it checks", name),
                 "add one of each, all, always, eventually, never");
  }
  if (!given.empty()) {
    check.kind = given[0].kind;
    const bool of_time = check.kind == Check::Kind::always || check.kind == Check::Kind::eventually;
    if (of_time) {
      reader.expression(given[0].key, check.expression);
    } else {
      reader.text(given[0].key, check.event);
    }
    if (check.kind == Check::Kind::each || check.kind == Check::Kind::all) {
      reader.expression("expect", check.expression);
      if (!reader.has("expect")) {
        reader.missing("expect", "add expect: \"abs(length - 500) <= 0.2\" or the like");
      }
    } else {
      reader.find("expect");
      refuse_misplaced(reader, "expect", "each and all", findings);
    }
  } else {
    reader.find("expect");
  }
  read_window(reader, check, findings);
  reader.finish();
  if (!reader.has("name") && node.kind == YamlNode::Kind::map) {
    reader.missing("name", "a check needs a name of its own");
  }
  return check;
}

}  // namespace

std::vector<Stimulus> read_timeline(const YamlNode& node, Findings& findings) {
  std::vector<Stimulus> timeline;
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    timeline.push_back(read_stimulus(node.items[i], fmt::format("timeline.{}", i), findings));
  }
  return timeline;
}

std::vector<Check> read_checks(const YamlNode& node, Findings& findings) {
  std::vector<Check> checks;
  std::unordered_map<std::string, int> lines;  // of the names
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    auto check = read_check(node.items[i], fmt::format("checks.{}", i), findings);
    const auto [same, fresh] = lines.emplace(check.name.text, check.name.place.line);
    if (!fresh && !check.name.text.empty()) {
      findings.add(check.name.place, fmt::format("there are two checks named '{}'", check.name.text),
                   fmt::format("rename one; the first is at line {}", same->second));
    }
    checks.push_back(std::move(check));
  }
  return checks;
}

}  // namespace drycut::sim
