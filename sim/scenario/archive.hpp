#pragma once
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "sim/scenario/scenario.hpp"
#include "sim/scenario/yaml_node.hpp"

namespace drycut::sim::scenario {

// The schema of scenarios is written once: each section has one `visit(Archive&, section)` that names its
// keys, and what is done with them is an archive: reading (yaml_reader.hpp), writing (expand), a JSON Schema
// for editors (json_schema.hpp). Drake's Serialize is the model.

/// How one value stands in the file: a quantity, a word, a list of texts.
struct Form {
  /// What messages call a value, and where its key stands.
  struct Name {
    std::string full;  ///< "plants.web.speed"
    Place key;         ///< of an item of a list: of the item
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
  std::string help;    ///< where a reader finds the names: "'drycut plants web' lists its parameters"
  bool nested = true;  ///< written as nested maps
  /// What the file gives, and where: the value's place if `at_value`, else the key's.
  std::vector<std::pair<std::string, Place>>* places = nullptr;
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
void visit(Archive& archive, Variable& variable);
void visit(Archive& archive, PlantEntry& plant);
void visit(Archive& archive, Wire& wire);
void visit(Archive& archive, InputFilter& filter);
void visit(Archive& archive, Stimulus& stimulus);
void visit(Archive& archive, Disturbance& disturbance);
void visit(Archive& archive, Check& check);
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

}  // namespace drycut::sim::scenario
