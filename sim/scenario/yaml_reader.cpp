#include "sim/scenario/archive.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.hpp"

namespace drycut::sim::scenario {

namespace {

std::string below(const std::string& name, std::string_view key) {
  return name.empty() ? std::string(key) : fmt::format("{}.{}", name, key);
}

// What messages call an entry of a list.
std::string shown_name(const YamlNode& item, std::size_t number) {
  constexpr std::size_t longest = 60;
  const auto* name = name_of_item(item);
  const bool fits =
      name != nullptr && !name->text.empty() && name->text.size() <= longest && name->text.front() != '.';
  return fits ? name->text : std::to_string(number);
}

bool is_group(const ParameterTable& table, const std::string& name) {
  return std::any_of(table.rows.begin(), table.rows.end(),
                     [&](const auto& row) { return row.name.starts_with(name + "."); });
}

// A key without a value behind another entry of its line may be the rest of that one's text: a comma ends a
// value in {...}. What to write then; "" if it is nothing like that.
std::string torn_at_comma(const YamlNode& map, const YamlNode::Entry& entry) {
  const auto next =
      std::find_if(map.entries.begin(), map.entries.end(), [&](const auto& one) { return &one == &entry; });
  if (entry.value.kind != YamlNode::Kind::null || next == map.entries.begin() || next == map.entries.end())
    return "";
  const auto& [key, value, repeated] = *(next - 1);
  if (value.kind != YamlNode::Kind::scalar || value.text.place.line != entry.key.place.line) return "";
  return fmt::format("a text with a comma in it stands in quotes: {}: \"{}, {}\"", key.text, value.text.text,
                     entry.key.text);
}

// A table that is written as nested maps is suggested by the names of this map, another by whole names.
std::string nearest_row(const ParameterTable& table, const std::string& prefix, const std::string& key) {
  const auto map = table.nested ? prefix : std::string();
  std::vector<std::string> here;
  for (const auto& row : table.rows) {
    std::string_view rest = row.name;
    if (!map.empty()) {
      if (!rest.starts_with(map + ".")) continue;
      rest.remove_prefix(map.size() + 1);
    }
    const auto dot = table.nested ? rest.find('.') : std::string_view::npos;
    if (dot != std::string_view::npos) here.emplace_back(rest.substr(0, dot));
    here.emplace_back(rest);
  }
  const auto wanted = table.nested ? key : below(prefix, key);
  const auto elsewhere = std::find_if(table.rows.begin(), table.rows.end(),
                                      [&](const auto& row) { return row.name.ends_with("." + key); });
  return did_you_mean(
      wanted, here,
      elsewhere == table.rows.end() ? table.help : fmt::format("did you mean {}?", elsewhere->name));
}

// Of a key that is there under a wrong name it is told how it is written, not that it is missing.
bool misspells(const YamlNode& map, const std::vector<std::string>& known, std::string_view key) {
  return std::any_of(map.entries.begin(), map.entries.end(), [&](const auto& entry) {
    const bool sound = std::find(known.begin(), known.end(), entry.key.text) != known.end();
    return !sound && nearest(entry.key.text, known) == key;
  });
}

}  // namespace

void refuse_kind(const YamlNode& node, const std::string& name, YamlNode::Kind wanted, Findings& findings) {
  std::string form = "key: value, or {key: value}";
  if (wanted == YamlNode::Kind::sequence) form = "[first, second], or a line '- ...' for each";
  if (wanted == YamlNode::Kind::scalar) form = "one value";
  findings.add("scenario.wrong-kind"_code, node.text.place,
               fmt::format("{} must be {}, not {}", name, name_of(wanted), name_of(node.kind)),
               fmt::format("write {}", form));
}

void refuse_duplicates(const YamlNode& map, const std::string& name, Findings& findings) {
  for (const auto& entry : map.entries) {
    if (!entry.is_repeated()) continue;
    const auto where = name.empty() ? std::string("the file") : name;
    findings.add("scenario.twice"_code, entry.key.place,
                 fmt::format("'{}' is given twice in {}", entry.key.text, where),
                 fmt::format("keep one; the first is at line {}", entry.first_line));
  }
}

MapReader::MapReader(const YamlNode& node, std::string name, Findings& findings)
    : node_(node), name_(std::move(name)), findings_(findings) {
  refuse_duplicates(node, name_, findings);
}

std::string MapReader::full(std::string_view key) const { return below(name_, key); }

bool MapReader::has(std::string_view key) const { return child(node_, key) != nullptr; }

ScenePlace MapReader::place(std::string_view key) const {
  for (const auto& entry : node_.entries)
    if (entry.key.text == key) return entry.key.place;
  return node_.text.place;
}

ScenePlace MapReader::value_place(std::string_view key) const {
  const auto* value = child(node_, key);
  return value == nullptr ? node_.text.place : value->text.place;
}

const YamlNode::Entry* MapReader::find(std::string_view key) {
  const bool asked_before = std::find(known_.begin(), known_.end(), key) != known_.end();
  if (!asked_before) known_.emplace_back(key);
  for (const auto& entry : node_.entries) {
    if (entry.key.text != key) continue;
    if (entry.value.kind != YamlNode::Kind::null) return &entry;
    if (!asked_before) {
      findings_.add("scenario.no-value"_code, entry.key.place, fmt::format("{} has no value", full(key)),
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

void MapReader::value(const Key& key, const Form& form) {
  if (const auto* entry = find(key.name))
    form.read(entry->value, {full(key.name), entry->key.place}, findings_);
}

void MapReader::section(const Key& key, const Visit& visit) {
  const auto* entry = find(key.name);
  if (entry == nullptr) return;
  MapReader reader(entry->value, full(key.name), findings_);
  visit(reader);
  reader.finish();
}

void MapReader::list(const Key& key, const Items& items) {
  const auto* node = of_kind(key.name, YamlNode::Kind::sequence);
  if (node == nullptr) return;
  for (std::size_t i = 0; i < node->items.size(); ++i) {
    MapReader reader(node->items[i], below(full(key.name), shown_name(node->items[i], i)), findings_);
    items.add({});
    items.visit(reader, i);
    reader.finish();
  }
}

void MapReader::names(const Key& key, const Items& items) {
  const auto* node = of_kind(key.name, YamlNode::Kind::map);
  if (node == nullptr) return;
  const auto name = full(key.name);
  refuse_duplicates(*node, name, findings_);
  std::size_t count = 0;
  for (const auto& entry : node->entries) {
    if (entry.is_repeated()) continue;
    items.add(entry.key);
    auto empty = YamlNode(YamlNode::Kind::null, {"", entry.key.place});
    if (items.may_be_empty) empty.kind = YamlNode::Kind::map;
    const bool given = entry.value.kind != YamlNode::Kind::null;
    MapReader reader(given ? entry.value : empty, below(name, entry.key.text), findings_);
    items.visit(reader, count);
    if (reader.finish())
      ++count;
    else
      items.drop();
  }
}

void MapReader::table(const ParameterTable& table) {
  has_table_ = true;
  read_level(table, node_, "");
}

// A key is a parameter, or the first part of some: then its value is a map of the rest.
void MapReader::read_level(const ParameterTable& table, const YamlNode& node, const std::string& prefix) {
  const auto where = prefix.empty() ? name_ : full(prefix);
  if (!prefix.empty()) refuse_duplicates(node, where, findings_);
  for (const auto& entry : node.entries) {
    const auto& key = entry.key;
    const bool known = prefix.empty() && std::find(known_.begin(), known_.end(), key.text) != known_.end();
    if (known || entry.is_repeated()) continue;
    const auto name = below(prefix, key.text);
    const auto row = std::find_if(table.rows.begin(), table.rows.end(),
                                  [&](const auto& candidate) { return candidate.name == name; });
    if (row != table.rows.end()) {
      read_parameter(table, *row, entry);
    } else if (!is_group(table, name)) {
      const auto torn = torn_at_comma(node, entry);
      findings_.add("scenario.unknown-key"_code, key.place,
                    fmt::format("unknown key '{}' in {}", key.text, where),
                    torn.empty() ? nearest_row(table, prefix, key.text) : torn);
    } else if (entry.value.kind != YamlNode::Kind::map) {
      refuse_kind(entry.value, full(name), YamlNode::Kind::map, findings_);
    } else {
      read_level(table, entry.value, name);
    }
  }
}

void MapReader::read_parameter(const ParameterTable& table, const ParameterTable::Row& row,
                               const YamlNode::Entry& entry) {
  const auto name = full(row.name);
  // It may be nested in one place and dotted in another.
  for (const auto& covered : row.covers.empty() ? std::vector{row.name} : row.covers) {
    for (const auto& [known, place] : *table.places) {
      if (known != covered) continue;
      findings_.add("scenario.twice"_code, entry.key.place, fmt::format("{} is given twice", full(covered)),
                    fmt::format("keep one; the first is at line {}", place.line));
      return;
    }
    const bool at_value = table.at_value && entry.value.kind == YamlNode::Kind::scalar;
    table.places->emplace_back(covered, at_value ? entry.value.text.place : entry.key.place);
  }
  if (entry.value.kind != YamlNode::Kind::null)
    return row.form.read(entry.value, {name, entry.key.place}, findings_);
  findings_.add("scenario.no-value"_code, entry.key.place, fmt::format("{} has no value", name),
                "give it one, or leave the key out");
}

void MapReader::alone(const Form& form) {
  is_alone_ = true;
  form.read(node_, {name_, node_.text.place}, findings_);
}

bool MapReader::instead(bool, const Form& form) {
  if (node_.kind != YamlNode::Kind::map) alone(form);
  return is_alone_;
}

void MapReader::refuse(Code code, std::string_view key, std::string what, std::string remedy) {
  findings_.add(code, place(key), std::move(what), std::move(remedy));
}

void MapReader::missing(std::string_view key, std::string_view remedy) {
  findings_.add("scenario.missing-key"_code, node_.text.place, fmt::format("{} is missing", full(key)),
                meant(remedy));
}

// What lacks something and stands beside others of nearly its name was to change one of them.
std::string MapReader::meant(std::string_view remedy) const {
  const auto* name = name_of_item(node_);
  return name == nullptr ? std::string(remedy) : did_you_mean(name->text, node_.beside, std::string(remedy));
}

void MapReader::require(std::string_view key, std::string_view remedy) {
  judge([key, remedy](MapReader& reader) {
    if (!reader.has(key) && (reader.has_table_ || !misspells(reader.node_, reader.known_, key)))
      reader.missing(key, remedy);
  });
}

void MapReader::require_one(const std::vector<std::string_view>& keys, std::string_view what,
                            std::string_view remedy) {
  judge([keys, what, remedy](MapReader& reader) {
    if (std::any_of(keys.begin(), keys.end(), [&](auto key) {
          return reader.has(key) || (!reader.has_table_ && misspells(reader.node_, reader.known_, key));
        }))
      return;
    reader.findings_.add("scenario.missing-key"_code, reader.place(),
                         fmt::format("{} {}", reader.name(), what), reader.meant(remedy));
  });
}

bool MapReader::finish() {
  if (is_alone_) return is_sound();
  if (node_.kind != YamlNode::Kind::map) {
    refuse_kind(node_, name_, YamlNode::Kind::map, findings_);
    return false;
  }
  for (const auto& entry : node_.entries) {
    if (has_table_ || std::find(known_.begin(), known_.end(), entry.key.text) != known_.end()) continue;
    const auto where = name_.empty() ? std::string() : fmt::format(" in {}", name_);
    const bool in_expression =
        entry.key.text.find_first_of("()") != std::string::npos;  // max(a, b) in a {...}
    const auto torn = torn_at_comma(node_, entry);
    findings_.add("scenario.unknown-key"_code, entry.key.place,
                  fmt::format("unknown key '{}'{}", entry.key.text, where),
                  in_expression   ? "an expression with a comma in it stands in quotes"
                  : !torn.empty() ? torn
                                  : did_you_mean(entry.key.text, known_));
  }
  for (const auto& judge : judges_) judge(*this);
  return true;
}

}  // namespace drycut::sim::scenario
