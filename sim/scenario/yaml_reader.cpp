#include "sim/scenario/yaml_reader.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sim/scenario/format.hpp"

namespace drycut::sim {

void refuse_kind(const YamlNode& node, const std::string& name, YamlNode::Kind wanted, Findings& findings) {
  std::string form = "key: value, or {key: value}";
  if (wanted == YamlNode::Kind::sequence) form = "[first, second], or a line '- ...' for each";
  if (wanted == YamlNode::Kind::scalar) form = "one value";
  findings.add(node.text.place,
               fmt::format("{} must be {}, not {}", name, name_of(wanted), name_of(node.kind)),
               fmt::format("write {}", form));
}

void refuse_duplicates(const YamlNode& map, const std::string& name, Findings& findings) {
  for (const auto& entry : map.entries) {
    if (!entry.is_repeated()) continue;
    const auto where = name.empty() ? std::string("the file") : name;
    findings.add(entry.key.place, fmt::format("'{}' is given twice in {}", entry.key.text, where),
                 fmt::format("keep one; the first is at line {}", entry.first_line));
  }
}

std::vector<Text> read_texts(const YamlNode& list, const std::string& name, Findings& findings) {
  std::vector<Text> texts;
  for (std::size_t i = 0; i < list.items.size(); ++i) {
    const auto& item = list.items[i];
    if (item.kind == YamlNode::Kind::scalar) {
      texts.push_back(item.text);
    } else {
      refuse_kind(item, fmt::format("{}.{}", name, i), YamlNode::Kind::scalar, findings);
    }
  }
  return texts;
}

MapReader::MapReader(const YamlNode& node, std::string name, Findings& findings)
    : node_(node), name_(std::move(name)), findings_(findings) {
  if (node.kind == YamlNode::Kind::map) {
    refuse_duplicates(node, name_, findings);
  } else {
    refuse_kind(node, name_, YamlNode::Kind::map, findings);
  }
}

std::string MapReader::full(std::string_view key) const {
  return name_.empty() ? std::string(key) : fmt::format("{}.{}", name_, key);
}

bool MapReader::has(std::string_view key) const {
  return std::any_of(node_.entries.begin(), node_.entries.end(),
                     [&](const YamlNode::Entry& entry) { return entry.key.text == key; });
}

Place MapReader::place(std::string_view key) const {
  for (const auto& entry : node_.entries) {
    if (entry.key.text == key) return entry.key.place;
  }
  return node_.text.place;
}

const YamlNode::Entry* MapReader::find(std::string_view key) {
  const bool asked_before = std::find(known_.begin(), known_.end(), key) != known_.end();
  if (!asked_before) known_.emplace_back(key);
  for (const auto& entry : node_.entries) {
    if (entry.key.text != key) continue;
    if (entry.value.kind != YamlNode::Kind::null) return &entry;
    if (!asked_before) {
      findings_.add(entry.key.place, fmt::format("{} has no value", full(key)),
                    "give it one, or leave the key out");
    }
    return nullptr;
  }
  return nullptr;
}

const YamlNode* MapReader::of_kind(std::string_view key, YamlNode::Kind kind) {
  const auto* entry = find(key);
  if (entry == nullptr) return nullptr;
  if (entry->value.kind == kind) return &entry->value;
  refuse_kind(entry->value, full(key), kind, findings_);
  return nullptr;
}

const Text* MapReader::scalar(std::string_view key) {
  const auto* node = of_kind(key, YamlNode::Kind::scalar);
  return node == nullptr ? nullptr : &node->text;
}

void MapReader::text(std::string_view key, std::string& value) {
  if (const auto* text = scalar(key)) value = text->text;
}

void MapReader::text(std::string_view key, Text& value) {
  if (const auto* text = scalar(key)) value = *text;
}

void MapReader::texts(std::string_view key, std::vector<Text>& values) {
  if (const auto* node = list(key)) values = read_texts(*node, full(key), findings_);
}

void MapReader::expression(std::string_view key, Text& value) {
  if (const auto* text = scalar(key)) {
    value = *text;
    check_expression(*text, findings_);
  }
}

void MapReader::time(std::string_view key, Time& value, Sign sign) {
  if (const auto* text = scalar(key)) {
    if (const auto time = read_time(*text, full(key), sign, findings_)) value = *time;
  }
}

void MapReader::time(std::string_view key, std::optional<Time>& value, Sign sign) {
  if (const auto* text = scalar(key)) {
    // A wrong value still counts as given, so that nothing else complains that it is missing.
    value = read_time(*text, full(key), sign, findings_).value_or(0);
  }
}

void MapReader::integer(std::string_view key, int& value, int min, int max) {
  if (const auto* text = scalar(key)) {
    if (const auto number = read_integer(*text, full(key), min, max, findings_)) {
      value = static_cast<int>(*number);
    }
  }
}

void MapReader::missing(std::string_view key, std::string remedy) {
  findings_.add(node_.text.place, fmt::format("{} is missing", full(key)), std::move(remedy));
}

void MapReader::finish() {
  for (const auto& entry : node_.entries) {
    if (std::find(known_.begin(), known_.end(), entry.key.text) != known_.end()) continue;
    const auto where = name_.empty() ? std::string() : fmt::format(" in {}", name_);
    const bool torn = entry.key.text.find_first_of("()") != std::string::npos;  // max(a, b) in a {...}
    findings_.add(
        entry.key.place, fmt::format("unknown key '{}'{}", entry.key.text, where),
        torn ? "an expression with a comma in it stands in quotes" : did_you_mean(entry.key.text, known_));
  }
}

}  // namespace drycut::sim
