#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/scenario/scenario.hpp"
#include "sim/scenario/yaml_node.hpp"
#include "sim/time.hpp"

namespace drycut::sim {

/// What a duration may be.
enum class Sign { not_negative, positive };

// Readers of single values. Each says in `findings` what is wrong with `text` and what would be right;
// `name` is the full name of the value in messages ("plants.web.speed").

/// A number with a unit that is known: the unit's dimension is not looked at.
std::optional<Quantity> read_quantity(const Text& text, const std::string& name, Findings& findings);
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

/// The nearest of `candidates` as a remedy, or all of them.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& candidates);

/// Checked access to one map of the file: every key asked for is known, finish() refuses the others.
/// Duplicate keys and nodes of another kind are refused at once. A value that is absent leaves the default.
class MapReader {
 public:
  /// `name` is the map's full name in messages ("scene", "plants.web").
  MapReader(const YamlNode& node, std::string name, Findings& findings);

  void text(std::string_view key, std::string& value);
  void text(std::string_view key, Text& value);
  void texts(std::string_view key, std::vector<Text>& values);
  void expression(std::string_view key, Text& value);
  void time(std::string_view key, Time& value, Sign sign);
  void time(std::string_view key, std::optional<Time>& value, Sign sign);
  void integer(std::string_view key, int& value, int min, int max);

  /// The entry of `key`, or nullptr; an entry without a value counts as absent and is a problem.
  const YamlNode::Entry* find(std::string_view key);
  /// The value of `key` if it is a node of this kind; another kind is a problem.
  const YamlNode* map(std::string_view key) { return of_kind(key, YamlNode::Kind::map); }
  const YamlNode* list(std::string_view key) { return of_kind(key, YamlNode::Kind::sequence); }
  const Text* scalar(std::string_view key);

  [[nodiscard]] bool has(std::string_view key) const;
  /// Of the key, else of the map.
  [[nodiscard]] Place place(std::string_view key) const;
  [[nodiscard]] Place place() const { return node_.text.place; }
  [[nodiscard]] std::string full(std::string_view key) const;
  void missing(std::string_view key, std::string remedy);
  /// Refuses the keys that nothing asked for.
  void finish();

 private:
  const YamlNode* of_kind(std::string_view key, YamlNode::Kind kind);

  const YamlNode& node_;
  std::string name_;
  Findings& findings_;
  std::vector<std::string> known_;
};

/// Says that `node`, the value called `name`, should be of another kind.
void refuse_kind(const YamlNode& node, const std::string& name, YamlNode::Kind wanted, Findings& findings);
/// Refuses every key that stands twice in the map.
void refuse_duplicates(const YamlNode& map, const std::string& name, Findings& findings);
/// Texts of a list of single values.
std::vector<Text> read_texts(const YamlNode& list, const std::string& name, Findings& findings);

}  // namespace drycut::sim
