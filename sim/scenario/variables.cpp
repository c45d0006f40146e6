#include "sim/scenario/variables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <map>
#include <optional>
#include <set>

#include "base/text.hpp"
#include "sim/file.hpp"
#include "sim/scenario/archive.hpp"
#include "sim/scenario/constant.hpp"
#include "sim/scenario/units.hpp"

namespace drycut::sim::scenario {

namespace {

constexpr std::string_view opening = "${";
constexpr std::size_t longest_value = 10000;  // variables may double a text again and again
constexpr std::size_t deepest_use = 100;      // of variables in variables, which is looked up by calls

bool is_name(std::string_view text) {
  const auto fits = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  return !text.empty() && std::isdigit(static_cast<unsigned char>(text[0])) == 0 &&
         std::all_of(text.begin(), text.end(), fits);
}

bool is_quantity(std::string_view value) {
  const auto parsed = parse_quantity(value);
  return parsed && is_unit(parsed->unit);
}

using Report = std::function<void(Code code, const ScenePlace& place, std::string what, std::string remedy)>;
/// The value of a variable; nullptr if there is none, which has been told at the place.
using Lookup = std::function<const std::string*(const std::string& name, const ScenePlace& place)>;

/// A value taken apart: literal pieces of the text, and variables between them.
struct Piece {
  std::size_t begin = 0;
  std::size_t end = 0;
  const std::string* value = nullptr;  ///< of a variable
};

std::optional<std::vector<Piece>> pieces_of(const Text& text, const Lookup& lookup, const Report& report) {
  std::vector<Piece> pieces;
  bool sound = true;
  std::size_t at = 0;
  for (auto next = text.text.find(opening); next != std::string::npos; next = text.text.find(opening, at)) {
    if (next > at) pieces.push_back({at, next});
    const auto end = text.text.find('}', next);
    if (end == std::string::npos) {
      report("scenario.variable-syntax"_code, text.at(next), "this ${ is not closed", "write ${name}");
      return {};
    }
    const auto name = text.text.substr(next + opening.size(), end - next - opening.size());
    const std::string* value = nullptr;
    if (is_name(name))
      value = lookup(name, text.at(next));
    else
      report("scenario.variable-syntax"_code, text.at(next),
             fmt::format("'{}' is no name of a variable", name),
             "the name alone stands in ${ }, arithmetic around it: ${length} / 2");
    sound = sound && value != nullptr;
    at = end + 1;
    pieces.push_back({next, at, value});
  }
  if (at < text.text.size()) pieces.push_back({at, text.text.size()});
  if (!sound) return {};
  return pieces;
}

/// Puts a text together whose bytes keep their places.
class Joiner {
 public:
  explicit Joiner(const Text& from) : from_(from), made_{"", from.place} {}
  void literal(std::size_t begin, std::size_t end) {
    if (begin == end) return;
    const auto offset = made_.text.size();
    made_.breaks.push_back({offset, from_.at(begin)});
    for (const auto& old : from_.breaks)
      if (old.offset > begin && old.offset < end)
        made_.breaks.push_back({offset + old.offset - begin, old.place});
    made_.text.append(from_.text, begin, end - begin);
  }
  // All of it stands where the variable stands.
  void pinned(std::string_view text, std::size_t begin) {
    for (std::size_t i = 0; i < text.size(); ++i)
      made_.breaks.push_back({made_.text.size() + i, from_.at(begin)});
    made_.text += text;
  }
  [[nodiscard]] const Text& made() const { return made_; }

 private:
  const Text& from_;
  Text made_;
};

enum class Parentheses { none, needed, all };

// Where what stands beside a quantity would bind to its number or its unit alone.
bool binds(const std::string& text, const Piece& piece) {
  const auto strong = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || std::string_view("*/^_.[%").find(c) < 7;
  };
  const auto before = text.find_last_not_of(' ', piece.begin == 0 ? std::string::npos : piece.begin - 1);
  const auto after = text.find_first_not_of(' ', piece.end);
  return (piece.begin > 0 && before != std::string::npos && strong(text[before])) ||
         (after != std::string::npos && strong(text[after]));
}

Text joined(const Text& text, const std::vector<Piece>& pieces, Parentheses parentheses) {
  Joiner joiner(text);
  for (const auto& piece : pieces) {
    if (piece.value == nullptr) {
      joiner.literal(piece.begin, piece.end);
      continue;
    }
    const bool enclosed =
        is_quantity(*piece.value) &&
        (parentheses == Parentheses::all ||
         (parentheses == Parentheses::needed && (piece.value->front() == '-' || binds(text.text, piece))));
    joiner.pinned(enclosed ? fmt::format("({})", *piece.value) : *piece.value, piece.begin);
  }
  return joiner.made();
}

Text pinned(const Text& text, const std::string& value) {
  Joiner joiner(text);
  joiner.pinned(value, 0);
  return joiner.made();
}

/// What pieces of a text come to; nothing if something is wrong with it, which is told.
std::optional<Text> put_together(const Text& text, const std::vector<Piece>& pieces, const Report& report) {
  if (pieces.size() == 1) return pinned(text, *pieces.front().value);
  const auto whole = joined(text, pieces, Parentheses::all);
  const auto constant = read_constant(whole.text);
  for (const auto& fault : constant.faults)
    report(fault.code, whole.at(fault.offset), fault.what, fault.remedy);
  switch (constant.kind) {
    case Constant::Kind::value:
      if (!constant.faults.empty()) return {};
      return pinned(text, constant.value);
    case Constant::Kind::condition:
    case Constant::Kind::formula:
      return joined(text, pieces, Parentheses::needed);
    case Constant::Kind::text:
      return joined(text, pieces, Parentheses::none);
  }
  return {};
}

/// What a value with variables comes to; nothing if something is wrong with it, which is told.
std::optional<Text> computed(const Text& text, const Lookup& lookup, const Report& report) {
  const auto pieces = pieces_of(text, lookup, report);
  if (!pieces) return {};
  std::size_t length = 0;
  for (const auto& piece : *pieces)
    length += piece.value == nullptr ? piece.end - piece.begin : piece.value->size();
  if (length > longest_value) {
    report("scenario.variable-circle"_code, text.place, fmt::format("this comes to {} characters", length),
           fmt::format("at most {}", longest_value));
    return {};
  }
  auto made = put_together(text, *pieces, report);
  if (!made || made->text.find(opening) == std::string::npos) return made;
  report("scenario.variable-syntax"_code, text.place, "this comes to a text with ${ in it",
         "a value has no ${ but those of its variables");
  return {};
}

// A number and behind it what can only be a unit that there is not: 60 m/mn, which arithmetic would read as
// 60 m divided by something called mn. A text begins with a letter.
bool looks_like_quantity(const std::string& text, Constant::Kind kind) {
  const auto quantity = parse_quantity(text);
  if (!quantity) return false;
  if (kind == Constant::Kind::text) return true;
  const auto& unit = quantity->unit;
  return kind == Constant::Kind::formula && !unit.empty() && is_letter(unit.front()) &&
         unit.find_first_of("*.+-()<>=") == std::string::npos;
}

/// What values of variables come to, by name.
using Values = std::map<std::string, Text>;

/// "a length", "a number", "a text".
std::string measure_of(const std::string& value) {
  if (!is_quantity(value)) return "a text";
  const auto unit = parse_quantity(value)->unit;
  return needs_unit(unit) ? dimension_name(unit) : "a number without unit";
}

/// The variables of a tree, each computed when it is first asked for.
class Resolver {
 public:
  /// `first`: of variables that had another value, which says what they measure.
  Resolver(YamlNode* section, Values first, Findings& findings)
      : section_(section), first_(std::move(first)), findings_(findings) {
    if (section_ == nullptr || section_->kind != YamlNode::Kind::map) return;
    for (auto& entry : section_->entries) {
      if (entry.is_repeated()) continue;
      entries_.emplace(entry.key.text, &entry);
      names_.push_back(entry.key.text);
      if (!is_name(entry.key.text))
        findings_.add("scenario.variable-syntax"_code, entry.key.place,
                      fmt::format("'{}' is no name of a variable", entry.key.text),
                      "letters, digits and underscores, a letter first");
    }
  }

  Values values() {
    Values sound;
    for (const auto& name : names_)
      if (value_of(*entries_.at(name)) != nullptr) sound[name] = entries_.at(name)->value.text;
    return sound;
  }
  std::map<std::string, std::vector<ScenePlace>> run(YamlNode& root) {
    note_names(root);
    values();
    for (auto& entry : root.entries)
      if (&entry.value != section_) walk(entry.value);
    return std::move(used_);
  }

 private:
  void note_names(const YamlNode& node) {
    const auto& text = node.text.text;
    for (auto at = text.find(opening); at != std::string::npos; at = text.find(opening, at + 1)) {
      const auto end = text.find('}', at);
      if (end != std::string::npos) ++named_[text.substr(at + opening.size(), end - at - opening.size())];
    }
    for (const auto& item : node.items) note_names(item);
    for (const auto& entry : node.entries) note_names(entry.value);
  }
  // Of several uses and a variable of nearly this name that nothing uses that one is the slip.
  void refuse_unknown(const std::string& name, const ScenePlace& place) {
    const auto meant = nearest(name, names_);
    if (meant.empty() || named_.contains(meant) || named_[name] < 2) {
      findings_.add("scenario.unknown-variable"_code, place, fmt::format("there is no variable '{}'", name),
                    did_you_mean(name, names_, fmt::format("add variables: {{{}: 800 mm}}", name)));
      return;
    }
    if (!misspelt_.insert(name).second) return;
    findings_.add("scenario.unknown-variable"_code, entries_.at(meant)->key.place,
                  fmt::format("the variable '{}' is not used, and there is no '{}', which {}:{} uses", meant,
                              name, place.line, place.column),
                  fmt::format("did you mean {}?", name));
  }
  void walk(YamlNode& node) {
    if (node.kind == YamlNode::Kind::scalar) compute(node.text);
    for (auto& item : node.items) walk(item);
    for (auto& entry : node.entries) {
      if (entry.key.text.find(opening) != std::string::npos)
        findings_.add("scenario.variable-syntax"_code, entry.key.place, "a variable cannot stand in a key",
                      "write the key out");
      walk(entry.value);
    }
  }

  bool compute(Text& text) {
    if (text.text.find(opening) == std::string::npos) return true;
    const auto made = computed(
        text, [this](const std::string& name, const ScenePlace& place) { return find(name, place); },
        [this](Code code, const ScenePlace& place, std::string what, std::string remedy) {
          findings_.add(code, place, std::move(what), std::move(remedy));
        });
    if (made)
      text = *made;
    else
      findings_.silence((text = pinned(text, text.text)).place);
    return made.has_value();
  }

  const std::string* find(const std::string& name, const ScenePlace& place) {
    used_[name].push_back(place);
    const auto entry = entries_.find(name);
    if (entry == entries_.end()) {
      refuse_unknown(name, place);
      return nullptr;
    }
    const auto waiting = std::find(open_.begin(), open_.end(), name);
    if (waiting != open_.end()) {
      auto cycle = std::vector<std::string>(waiting, open_.end());
      cycle.push_back(name);
      findings_.add("scenario.variable-circle"_code, place,
                    fmt::format("the variable '{}' needs itself: {}", name, fmt::join(cycle, " -> ")),
                    "give one of them a value of its own");
      return nullptr;
    }
    if (open_.size() < deepest_use) return value_of(*entry->second);
    findings_.add("scenario.variable-circle"_code, place,
                  fmt::format("variables in variables, more than {} deep", deepest_use), "nest less");
    return nullptr;
  }

  // Nullptr if it has none, which has been told.
  const std::string* value_of(YamlNode::Entry& entry) {
    auto& text = entry.value.text;
    const auto known = sound_.find(entry.key.text);
    if (known != sound_.end()) return known->second ? &text.text : nullptr;
    open_.push_back(entry.key.text);
    const bool sound = make_value(entry) && measures_the_same(entry);
    open_.pop_back();
    sound_[entry.key.text] = sound;
    return sound ? &text.text : nullptr;
  }

  bool make_value(YamlNode::Entry& entry) {
    auto& text = entry.value.text;
    if (entry.value.kind != YamlNode::Kind::scalar) return false;  // the reader says so
    if (text.text.find(opening) != std::string::npos) return compute(text);
    if (is_quantity(text.text)) return true;
    auto constant = read_constant(text.text);
    if (looks_like_quantity(text.text, constant.kind)) {
      refuse_unit(text, "variables." + entry.key.text, findings_);
      return false;
    }
    for (const auto& fault : constant.faults)
      findings_.add(fault.code, text.at(fault.offset), fault.what, fault.remedy);
    if (constant.kind == Constant::Kind::value && constant.faults.empty())
      text = pinned(text, constant.value);
    return constant.faults.empty();
  }

  bool measures_the_same(const YamlNode::Entry& entry) {
    const auto first = first_.find(entry.key.text);
    if (first == first_.end() || !is_quantity(first->second.text)) return true;
    const auto& [was, place, breaks] = first->second;
    const auto& value = entry.value.text;
    const auto unit = parse_quantity(was)->unit;
    if (is_quantity(value.text) && same_dimension(parse_quantity(value.text)->unit, unit)) return true;
    const auto& source = findings_.sources().at(static_cast<std::size_t>(place.source));
    findings_.add("scenario.variable-value"_code, value.place,
                  fmt::format("variables.{} is {} ({}, {}:{}:{}), not {}", entry.key.text, measure_of(was),
                              was, source, place.line, place.column, measure_of(value.text)),
                  fmt::format("for example {}", was));
    return false;
  }

  YamlNode* section_;
  Values first_;
  Findings& findings_;
  std::vector<std::string> names_;
  std::map<std::string, YamlNode::Entry*> entries_;
  std::map<std::string, bool> sound_;  ///< that have been computed
  std::vector<std::string> open_;      ///< being computed, each for the one before
  std::map<std::string, std::vector<ScenePlace>> used_;
  std::map<std::string, int> named_;  ///< in ${ }, how often
  std::set<std::string> misspelt_;    ///< told at the variable that was meant
};

/// The first values of variables that were given another, with those of the others.
Values first_values(const YamlNode* section, const Findings& findings) {
  Values first;
  if (section == nullptr) return first;
  const auto has_first = [](const YamlNode::Entry& entry) { return !entry.value.first.empty(); };
  if (std::none_of(section->entries.begin(), section->entries.end(), has_first)) return first;
  auto before = *section;
  for (auto& entry : before.entries)
    if (has_first(entry)) entry.value = YamlNode(entry.value.first.front());
  Findings unheard(findings.sources());
  first = Resolver(&before, {}, unheard).values();
  for (const auto& entry : section->entries)
    if (!has_first(entry)) first.erase(entry.key.text);
  return first;
}

// True if `at` stands in a remark, which is left alone: of the lines with # only "# key: value" says
// something.
bool is_remark(std::string_view table, std::size_t at) {
  const auto start = table.substr(0, at).rfind('\n') + 1;
  auto line = table.substr(start, at - start);
  line.remove_prefix(std::min(line.find_first_not_of(" \t\""), line.size()));
  if (!line.starts_with('#')) return false;
  const auto colon = line.find(':');
  return colon == std::string_view::npos || line.starts_with("##") ||
         !is_name(trimmed(line.substr(1, colon - 1)));
}

bool is_separator(char c) { return std::string_view(",;\t=:\"\n\r").find(c) != std::string_view::npos; }

/// By the scenario or a file of its controller.
std::vector<const VariableEntry*> unused(const Scenario& scenario) {
  std::vector<const VariableEntry*> found;
  for (const auto& variable : scenario.variables)
    if (variable.uses.empty()) found.push_back(&variable);
  if (found.empty() || !scenario.controller) return found;
  std::string files;
  Problems ignored;
  for (const auto& file : scenario.controller->files())
    files += read_file(scenario.file.parent_path() / file.text, ignored).value_or("");
  std::erase_if(found, [&](const VariableEntry* variable) {
    return files.find("${" + variable->name.text + "}") != std::string::npos;
  });
  return found;
}

}  // namespace

std::map<std::string, std::vector<ScenePlace>> resolve_variables(YamlNode& root, Findings& findings) {
  YamlNode* section = nullptr;
  for (auto& entry : root.entries)
    if (entry.key.text == "variables" && !entry.is_repeated()) section = &entry.value;
  return Resolver(section, first_values(section, findings), findings).run(root);
}

std::string with_variables(std::string_view table, const std::vector<VariableEntry>& variables,
                           const std::string& file, Problems& problems) {
  std::vector<std::string> names;
  for (const auto& variable : variables) names.push_back(variable.name.text);
  const Report report = [&](Code code, const ScenePlace& place, std::string what, std::string remedy) {
    problems.push_back({code, file, place.line, place.column, std::move(what), std::move(remedy)});
  };
  const Lookup lookup = [&](const std::string& name, const ScenePlace& place) -> const std::string* {
    for (const auto& variable : variables)
      if (variable.name.text == name) return &variable.value.text;
    report("scenario.unknown-variable"_code, place, fmt::format("the scenario has no variable '{}'", name),
           did_you_mean(name, names, "add it to the scenario's variables"));
    return nullptr;
  };
  std::string made;
  std::size_t at = 0;
  for (auto next = table.find(opening); next != std::string_view::npos; next = table.find(opening, at)) {
    if (is_remark(table, next)) {
      const auto end = std::min(table.find('\n', next), table.size());
      made += table.substr(at, end - at);
      at = end;
      continue;
    }
    auto begin = next;
    while (begin > at && !is_separator(table[begin - 1]) && table[begin - 1] != '#') --begin;
    auto end = next;
    while (end < table.size() && !is_separator(table[end])) ++end;
    while (table[begin] == ' ') ++begin;
    made += table.substr(at, begin - at);
    at = end;
    const auto line_start = table.substr(0, begin).rfind('\n') + 1;
    const auto cell = std::string(table.substr(begin, end - begin));
    const auto line = 1 + static_cast<int>(std::count(
                              table.begin(), table.begin() + static_cast<std::ptrdiff_t>(begin), '\n'));
    const Text text{std::string(trimmed(cell)), {line, static_cast<int>(begin - line_start) + 1, 0}};
    const auto value = computed(text, lookup, report);
    const auto number = value ? parse_quantity(value->text) : std::nullopt;
    if (value && (!number || !number->unit.empty()))
      report("scenario.variable-value"_code, text.place,
             fmt::format("'{}' is {}, not a plain number", text.text, value->text),
             "divide by the table's unit: ${length} / 0.1 mm");
    made += fmt::format("{:{}}", value ? value->text : cell, cell.size());
  }
  made += table.substr(at);
  return made;
}

std::vector<Finding> unused_variables(const Scenario& scenario) {
  std::vector<Finding> notes;
  for (const auto* variable : unused(scenario)) {
    const auto& beside = variable->beside;
    notes.emplace_back(
        "scenario.unused-variable"_code,
        fmt::format("the variable '{}' is not used{}", variable->name.text,
                    beside.empty() ? ""
                                   : fmt::format(", and what is extended has none of this name: "
                                                 "it has {}",
                                                 listed(beside))));
  }
  return notes;
}

void refuse_slips(const Scenario& scenario, Findings& findings) {
  const auto meant = [](const VariableEntry& variable) {
    return did_you_mean(variable.name.text, variable.beside, "");
  };
  const auto is_slip = [&](const VariableEntry& variable) {
    return variable.uses.empty() && !variable.beside.empty() && !meant(variable).empty();
  };
  if (std::none_of(scenario.variables.begin(), scenario.variables.end(), is_slip)) return;
  for (const auto* variable : unused(scenario))
    if (is_slip(*variable))
      findings.add("scenario.unknown-variable"_code, variable->name.place,
                   fmt::format("the variable '{}' is not used, and what is extended has none of this name",
                               variable->name.text),
                   meant(*variable));
}

}  // namespace drycut::sim::scenario
