#pragma once
#include <fmt/format.h>
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "plants/plant.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/scenario/yaml_node.hpp"
#include "sim/time.hpp"

namespace drycut::sim::scenario {

// The schema of scenarios is written once: each section has one `visit(Archive&, section)` that names its
// keys, and what is done with them is an archive: reading (yaml_reader.hpp), writing (expand), a JSON Schema
// for editors (json_schema.hpp). Drake's Serialize is the model.

/// How one value stands in the file: a quantity, a word, a list of texts.
struct Form {
  /// What messages call a value, and where its key stands.
  struct Name {
    std::string full;  ///< "plants.web.speed"
    ScenePlace key;    ///< of an item of a list: of the item
  };
  /// Takes the value from `node`, which is something. Says in `findings` what is wrong with it.
  std::function<void(const YamlNode& node, const Name& name, Findings& findings)> read;
  /// As YAML in one line; "" if there is nothing to write.
  std::function<std::string()> write;
  /// What an editor may know of it: JSON Schema, as JSON.
  std::function<std::string()> schema;
};

/// A key of a section.
struct Key {
  std::string_view name;
  std::string_view meaning;  ///< one sentence, for editors; "" where the key says it all
  bool shown = true;         ///< false: it is not written, for it says nothing here
};

/// Values under names with dots, given as nested maps, by their whole names, or both: the parameters of a
/// plant or an axis.
struct ParameterTable {
  struct Row {
    std::string name;
    std::function<std::string()> meaning;  ///< with unit, range and default
    Form form;
    std::vector<std::string> covers = {};  ///< of one that stands for others, and is not written: these
  };
  std::vector<Row> rows;
  std::string help;       ///< where a reader finds the names: "'drycut plants web' lists its parameters"
  bool nested = true;     ///< written as nested maps
  std::string open = {};  ///< a group whose rows are known with the file only: editors take any
  /// What the file gives, and where: the value's place if `at_value`, else the key's.
  std::vector<std::pair<std::string, ScenePlace>>* places = nullptr;
  bool at_value = true;
};

class MapReader;

/// Visits one map of a scenario.
class Archive {
 public:
  using Visit = std::function<void(Archive&)>;
  /// Items of a list or a map that grow while they are read.
  struct Items {
    std::size_t size = 0;
    std::function<std::string(std::size_t)> name;  ///< of a map's
    std::function<void(const Text&)> add;          ///< while reading: takes another one, of this name
    std::function<void()> drop;                    ///< of a map's: the last one cannot be read
    std::function<void(Archive&, std::size_t)> visit;
    bool may_be_empty = false;  ///< of a map's: `name:` without a value is one with all defaults
    bool in_line = false;       ///< written in one line
  };

  Archive() = default;
  virtual ~Archive() = default;
  Archive(const Archive&) = delete;
  Archive& operator=(const Archive&) = delete;

  virtual void value(const Key& key, const Form& form) = 0;
  /// A map under a key.
  virtual void section(const Key& key, const Visit& visit) = 0;
  /// A list under a key, a map or a single value each.
  virtual void list(const Key& key, const Items& items) = 0;
  /// A map under a key whose own keys are the user's names.
  virtual void names(const Key& key, const Items& items) = 0;
  /// Keys of this map that a table says.
  virtual void table(const ParameterTable& table) = 0;
  /// The two sections whose content hangs on a word of the user.
  virtual void plants(const Key& key, std::vector<PlantEntry>& plants) = 0;
  virtual void controller(const Key& key, std::unique_ptr<ControllerSection>& controller) = 0;

  /// What is visited is a single value, not a map.
  virtual void alone(const Form& form) = 0;
  /// A single value may stand in place of this map: true if one does (`written` says so while writing).
  virtual bool instead(bool written, const Form& form) = 0;
  /// The key must be given; else `remedy` is told.
  virtual void require(std::string_view key, std::string_view remedy) = 0;
  /// One of the keys at least must be given; else `what` is told of the map: "timeline.0 does nothing".
  virtual void require_one(const std::vector<std::string_view>& keys, std::string_view what,
                           std::string_view remedy) = 0;
  /// Written in one line: {key: value, key: value}
  virtual void in_line() {}
  /// While reading: what can be said only once the whole map has been read.
  virtual void judge(const std::function<void(MapReader&)>&) {}
  [[nodiscard]] virtual bool reads() const { return false; }

  template <typename Item>
  void list(const Key& key, std::vector<Item>& items, bool in_line = false) {
    list(key, {items.size(),
               {},
               [&](const Text&) { items.emplace_back(); },
               {},
               [&](Archive& archive, std::size_t i) { visit(archive, items[i]); },
               false,
               in_line});
  }
  /// A map of items by their member `name`.
  template <typename Item>
  void names(const Key& key, std::vector<Item>& items, Text Item::*name, bool may_be_empty = false) {
    names(key,
          {items.size(), [&, name](std::size_t i) { return (items[i].*name).text; },
           [&, name](const Text& given) { items.emplace_back().*name = given; }, [&] { items.pop_back(); },
           [&](Archive& archive, std::size_t i) { visit(archive, items[i]); }, may_be_empty});
  }
};

void visit(Archive& archive, Scenario& scenario);
void visit(Archive& archive, VariableEntry& variable);
void visit(Archive& archive, PlantEntry& plant);
void visit(Archive& archive, FittedEntry& entry);
void visit(Archive& archive, Wire& wire);
void visit(Archive& archive, InputFilter& filter);
void visit(Archive& archive, Stimulus& stimulus);
void visit(Archive& archive, Disturbance& disturbance);
void visit(Archive& archive, RecordedInput& input);
void visit(Archive& archive, CheckRequest& check);
void visit(Archive& archive, OpcuaSection& opcua);
void visit(Archive& archive, OpcuaSection::Cutter& cutter);
void visit(Archive& archive, PicturesSection& pictures);
void visit(Archive& archive, PicturesSection::Camera& camera);
void visit(Archive& archive, PicturesSection::MeshRequest& mesh);
void visit(Archive& archive, PicturesSection::OwnUnit& own);
void visit(Archive& archive, PlotRequest::Panel& panel);
void visit(Archive& archive, PlotRequest& plot);
/// The same with a window about an event, which may stand in place of the plot's own.
void visit(Archive& archive, PlotRequest& plot, std::optional<PicturesSection::Around>& around);
/// from and until; around, before and after in their place where `around` is not nullptr.
void visit_window(Archive& archive, Time& from, std::optional<Time>& until,
                  std::optional<PicturesSection::Around>* around);

/// The sections of a scenario, in the order in which they are written.
const std::vector<std::string>& section_names();

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
  [[nodiscard]] ScenePlace place(std::string_view key) const;
  [[nodiscard]] ScenePlace place() const { return node_.text.place; }
  /// Of the value under the key, else of the map.
  [[nodiscard]] ScenePlace value_place(std::string_view key) const;
  [[nodiscard]] std::string full(std::string_view key) const;
  [[nodiscard]] const std::string& name() const { return name_; }
  /// A problem at the key, or at the map if it is not given.
  void refuse(Code code, std::string_view key, std::string what, std::string remedy);
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
    findings.add("scenario.twice"_code, place, fmt::format("there are two {} named '{}'", what, text),
                 fmt::format(fmt::runtime(remedy), same->second));
  }
}

// The forms that values have in a scenario. Each is bound to what it reads and writes, which outlives it.

Form form(std::string& value);
Form form(Text& value);
/// A file, relative to the scenario's folder; in the file that names it, to that one's.
Form path_form(Text& value);
Form path_form(std::vector<Text>& values);
/// One path, or several.
Form paths_form(std::vector<Text>& values);
/// on, off, true, false.
Form form(bool& value);
Form form(std::optional<bool>& value);
Form form(std::vector<Text>& values);
Form form(std::optional<std::vector<Text>>& values);
/// A duration of whole nanoseconds. A wrong one still counts as given where it is optional, so that nothing
/// else complains that it is missing.
Form form(Time& value, Sign sign);
Form form(std::optional<Time>& value, Sign sign);
Form form(int& value, int min, int max);
Form form(std::uint64_t& value);
Form form(std::optional<std::uint64_t>& value);
/// A number with its unit; what it must measure is seen later.
Form form(Quantity& value);
/// A quantity of the dimension of `unit`, `value` in SI. Outside min..max (SI), `range` is told.
Form form(double& value, std::string_view unit, double min, double max, std::string_view range);
/// Three quantities along x, y and z, in SI: [0 mm, 20 mm, 0 mm]
Form form(std::array<double, 3>& values, std::string_view unit);
/// A lower and an upper limit: [499.8, 500.2]
Form form(std::optional<std::pair<double, double>>& values);
/// Names with pure numbers: {slLength: 800}
Form form(std::vector<std::pair<Text, double>>& values);
/// A parameter of a plant, bound to its member.
Form form(const plants::Parameter& parameter);
/// An expression's syntax; names are looked up later.
Form expression_form(Text& value);
Form expression_form(std::optional<Text>& value);
/// A formula that is looked at later.
Form quoted_form(Text& value);
/// One word of `words`: `get` and `set` take its number.
Form choice_form(std::vector<std::string> words, std::function<std::size_t()> get,
                 std::function<void(std::size_t)> set);
template <typename Choice>
Form choice_form(std::vector<std::string> words, Choice& choice) {
  return choice_form(
      std::move(words), [&choice] { return static_cast<std::size_t>(choice); },
      [&choice](std::size_t number) { choice = static_cast<Choice>(number); });
}

/// A form of a single value: another kind of node is refused before `read`.
Form single(std::function<void(const Text&, const std::string&, Findings&)> read,
            std::function<std::string()> write, std::string schema);
/// A form that is a map or a list: another kind is refused before `read`.
Form whole(YamlNode::Kind kind, std::function<void(const YamlNode&, const Form::Name&, Findings&)> read,
           std::function<std::string()> write, std::string schema);
/// The pure numbers of a list; nothing if one of them is none, which is told.
std::optional<std::vector<double>> read_numbers(const YamlNode& list, const std::string& name,
                                                Findings& findings);

// JSON Schemas of single values.
inline constexpr std::string_view any_text_schema = R"({"type": ["string", "number", "boolean"]})";
inline constexpr std::string_view switch_schema = R"({"enum": [true, false, "on", "off", "true", "false"]})";
inline constexpr std::string_view texts_schema =
    R"({"type": "array", "items": {"type": ["string", "number", "boolean"]}})";
/// Of a number, with or without a unit.
inline constexpr std::string_view number_schema =
    R"({"type": ["number", "string"], "pattern": "^[+-]?([0-9]+[.]?[0-9]*|[.][0-9]+)([eE][+-]?[0-9]+)?"})";
/// Of a number that must have a unit.
inline constexpr std::string_view quantity_schema =
    R"({"type": "string", "pattern": "^[+-]?([0-9]+[.]?[0-9]*|[.][0-9]+)([eE][+-]?[0-9]+)? *(1/)?[^ 0-9.+-]"})";

/// Of a lower and an upper limit, of a place in a plane.
inline constexpr std::string_view pair_schema =
    R"({"type": "array", "items": {"type": ["number", "string"]}, "minItems": 2, "maxItems": 2})";
/// Of a map of the user's names, each with an `item`.
std::string map_schema(std::string_view item);

}  // namespace drycut::sim::scenario
