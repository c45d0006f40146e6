#pragma once
#include <fmt/format.h>

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "sim/scenario/archive.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/scenario/yaml_node.hpp"
#include "sim/time.hpp"

namespace drycut::sim::scenario {

/// What a duration may be.
enum class Sign { not_negative, positive };

// Readers of single values. Each says in `findings` what is wrong with `text` and what would be right;
// `name` is the full name of the value in messages ("plants.web.speed").

/// "0.4 mm" of "0,4 mm"; "" if it is nothing like that.
std::string with_decimal_point(std::string_view text);
/// Says what is wrong with the unit of `text`, a number with one that is not known.
void refuse_unit(const Text& text, const std::string& name, Findings& findings);
/// A number with a unit that is known: the unit's dimension is not looked at.
std::optional<Quantity> read_quantity(const Text& text, const std::string& name, Findings& findings);
/// A number without unit is understood where one is one: counts, codes, ratios; not %, mm or deg.
bool needs_unit(std::string_view unit);
/// A quantity of the dimension of `unit`, in SI; a number without unit passes only where `unit` is a count.
std::optional<double> read_si(const Text& text, const std::string& name, std::string_view unit,
                              Findings& findings);
/// A duration of whole nanoseconds.
std::optional<Time> read_time(const Text& text, const std::string& name, Sign sign, Findings& findings);
std::optional<long long> read_integer(const Text& text, const std::string& name, long long min, long long max,
                                      Findings& findings);
/// on, off, true, false.
std::optional<bool> read_switch(const Text& text, const std::string& name, Findings& findings);
/// One word of `choices`.
bool read_choice(const Text& text, const std::string& name, const std::vector<std::string>& choices,
                 Findings& findings);
/// An expression's syntax; names are looked up later, when the scenario's machines are built.
void check_expression(const Text& text, Findings& findings);
/// True if the expression looks at windows.
bool has_statistics(const Text& text);

/// Reads one map of the file: every key that is visited is known, finish() refuses the others. Duplicate keys
/// and nodes of another kind are refused. A value that is absent leaves the default.
class MapReader : public Archive {
 public:
  /// `name` is the map's full name in messages ("scene", "plants.web").
  MapReader(const YamlNode& node, std::string name, Findings& findings);

  void value(const Key& key, const Form& form) override;
  void section(const Key& key, const Visit& visit) override;
  void list(const Key& key, const Items& items) override;
  void names(const Key& key, const Items& items) override;
  void table(const ParameterTable& table) override;
  void plants(const Key&, std::vector<PlantEntry>&) override {}
  void controller(const Key&, std::unique_ptr<ControllerSection>&) override {}
  void alone(const Form& form) override;
  bool instead(bool written, const Form& form) override;
  void require(std::string_view key, std::string_view remedy) override;
  void require_one(const std::vector<std::string_view>& keys, std::string_view what,
                   std::string_view remedy) override;
  void judge(const std::function<void(MapReader&)>& judge) override { judges_.push_back(judge); }
  [[nodiscard]] bool reads() const override { return true; }

  /// The entry of `key`, or nullptr; an entry without a value counts as absent and is a problem.
  const YamlNode::Entry* find(std::string_view key);
  [[nodiscard]] bool has(std::string_view key) const;
  /// Of the key, else of the map.
  [[nodiscard]] Place place(std::string_view key) const;
  [[nodiscard]] Place place() const { return node_.text.place; }
  /// Of the value under the key, else of the map.
  [[nodiscard]] Place value_place(std::string_view key) const;
  [[nodiscard]] std::string full(std::string_view key) const;
  [[nodiscard]] const std::string& name() const { return name_; }
  /// A problem at the key, or at the map if it is not given.
  void refuse(std::string_view key, std::string what, std::string remedy);
  void missing(std::string_view key, std::string_view remedy);
  [[nodiscard]] Findings& findings() { return findings_; }
  /// True if nothing in it has been refused so far.
  [[nodiscard]] bool is_sound() const { return findings_.count() == at_start_; }
  /// Refuses the keys that nothing asked for, then judges the whole. False if it is no map, or a single value
  /// that is wrong.
  bool finish();

 protected:
  /// The value of `key` if it is a node of this kind; another kind is a problem.
  const YamlNode* of_kind(std::string_view key, YamlNode::Kind kind);

 private:
  void read_level(const ParameterTable& table, const YamlNode& node, const std::string& prefix);
  void read_parameter(const ParameterTable& table, const ParameterTable::Row& row,
                      const YamlNode::Entry& entry);
  [[nodiscard]] std::string meant(std::string_view remedy) const;

  const YamlNode& node_;
  std::string name_;
  Findings& findings_;
  std::size_t at_start_ = findings_.count();
  std::vector<std::string> known_;
  std::vector<std::function<void(MapReader&)>> judges_;
  bool has_table_ = false;  ///< its keys have been judged
  bool is_alone_ = false;   ///< it is a single value, and has been read
};

/// Says that `node`, the value called `name`, should be of another kind.
void refuse_kind(const YamlNode& node, const std::string& name, YamlNode::Kind wanted, Findings& findings);
/// Refuses every key that stands twice in the map.
void refuse_duplicates(const YamlNode& map, const std::string& name, Findings& findings);

/// Says that two items have one name; {} in `remedy` is the line of the first.
template <typename Item>
void refuse_same_name(const std::vector<Item>& items, std::string_view what, std::string_view remedy,
                      Findings& findings) {
  std::unordered_map<std::string_view, int> lines;
  for (const auto& item : items) {
    const auto& [text, place, breaks] = item.name;
    const auto [same, fresh] = lines.emplace(text, place.line);
    if (fresh || text.empty()) continue;
    findings.add(place, fmt::format("there are two {} named '{}'", what, text),
                 fmt::format(fmt::runtime(remedy), same->second));
  }
}

}  // namespace drycut::sim::scenario
