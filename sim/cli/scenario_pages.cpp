// What a scenario file may say, from the schema that reads it (sim/scenario/archive.hpp), and what a cam
// table may say, from its readers.
#include <fmt/format.h>

#include <deque>
#include <limits>
#include <memory>

#include "base/json.hpp"
#include "base/text.hpp"
#include "sim/cams/study.hpp"
#include "sim/cli/pages.hpp"
#include "sim/recordings/recording_file.hpp"
#include "sim/scenario/archive.hpp"
#include "sim/studies/compare/scene.hpp"

namespace drycut::sim::cli {

namespace {

using scenario::Archive;
using scenario::Form;
using scenario::Key;

/// What a value may be, in words, by its JSON Schema: "a whole number, 1 to 10000".
std::string value_in_words(const Json& schema) {
  if (schema == json_from(scenario::switch_schema)) return "on or off";
  if (schema == json_from(scenario::quantity_schema)) return "a number with its unit";
  if (schema == json_from(scenario::number_schema)) return "a number";
  if (schema == json_from(scenario::pair_schema)) return "two numbers: [A, B]";
  if (const auto words = schema.find("enum"); words != schema.end())
    return listed(words->get<std::vector<std::string>>());
  const auto type = schema.value("type", Json());
  if (type == "array") {
    const auto item = value_in_words(schema["items"]);
    return schema.contains("minItems") ? fmt::format("a list of {}: {}", json_text(schema["minItems"]), item)
                                       : fmt::format("a list: {}", item);
  }
  if (type == "object") return fmt::format("a map: {}", value_in_words(schema["additionalProperties"]));
  if (type.is_array() && type.front() == "number") return "a number, with its unit if it has one";
  if (!schema.contains("minimum")) return "a text";
  const auto most = schema.value("maximum", std::numeric_limits<int>::max());
  return most == std::numeric_limits<int>::max()
             ? fmt::format("a whole number from {}", json_text(schema["minimum"]))
             : fmt::format("a whole number, {} to {}", json_text(schema["minimum"]), most);
}

std::string value_in_words(const Form& form) { return value_in_words(json_from(form.schema())); }

/// The keys of one map of the file.
struct KeyMap {
  struct Row {
    std::string key;
    std::string value;
    std::string fallback;
    std::string meaning;
  };
  std::string path;  ///< "pictures.frames", "checks.N", "" of the whole file
  std::vector<Row> rows;
};

/// Lists the keys of a map and, behind it, those of the maps in it. What it visits is filled with defaults
/// and thrown away.
class KeyLister final : public Archive {
 public:
  KeyLister(const std::string& path, std::deque<KeyMap>& maps)
      : maps_(maps), map_(maps.emplace_back(KeyMap{path, {}})) {}

  void value(const Key& key, const Form& form) override {
    const auto written = form.write();
    add(key, value_in_words(form), written == "\"\"" ? "" : written);
  }
  void section(const Key& key, const Visit& visit) override { add(key, inside(key.name, visit)); }
  void list(const Key& key, const Items& items) override {
    add(key, "a list: " + item_of(fmt::format("{}.N", key.name), items));
  }
  void names(const Key& key, const Items& items) override {
    add(key, "names of yours: " + item_of(fmt::format("{}.NAME", key.name), items));
  }
  void table(const scenario::ParameterTable& table) override {
    map_.rows.push_back({"parameters", "", "", table.help});
  }
  void plants(const Key& key, std::vector<scenario::PlantEntry>&) override {
    add(key, "names of yours: a map");
    std::vector<std::string> types;
    for (const auto& type : plants::plant_types()) types.emplace_back(type.name);
    maps_.push_back({path_of("plants.NAME"),
                     {{"type", listed(types), "required", "what it is"},
                      {"parameters", "", "", "'drycut plants TYPE' lists them"}}});
  }
  void controller(const Key& key, std::unique_ptr<scenario::ControllerSection>&) override {
    add(key, "a map of one key");
    for (const auto& kind : scenario::controller_kinds()) {
      const auto scratch = kind.make();
      inside(fmt::format("controller.{}", kind.name), [&](Archive& inner) { scratch->visit(inner); });
    }
  }

  void alone(const Form& form) override { single_ = value_in_words(form); }
  bool instead(bool, const Form& form) override {
    alternative_ = value_in_words(form) + ", or ";
    return false;
  }
  void require(std::string_view key, std::string_view) override { mark(key, "required"); }
  void require_one(const std::vector<std::string_view>& keys, std::string_view, std::string_view) override {
    for (const auto key : keys) mark(key, fmt::format("one of {}", fmt::join(keys, ", ")));
  }

 private:
  void add(const Key& key, std::string value, std::string fallback = "") {
    map_.rows.push_back(
        {std::string(key.name), std::move(value), std::move(fallback), std::string(key.meaning)});
  }
  void mark(std::string_view key, const std::string& need) {
    for (auto& row : map_.rows)
      if (row.key == key) row.fallback = need;
  }
  [[nodiscard]] std::string path_of(std::string_view key) const {
    return map_.path.empty() ? std::string(key) : fmt::format("{}.{}", map_.path, key);
  }
  /// What the map is, in words; its keys are listed.
  std::string inside(std::string_view key, const Visit& visit) {
    KeyLister inner(path_of(key), maps_);
    visit(inner);
    return inner.single_.empty() ? inner.alternative_ + "a map" : inner.single_;
  }
  std::string item_of(const std::string& key, const Items& items) {
    if (items.size == 0) items.add({});
    return inside(key, [&](Archive& inner) { items.visit(inner, 0); });
  }

  std::deque<KeyMap>& maps_;
  KeyMap& map_;
  std::string single_;
  std::string alternative_;
};

std::vector<Sheet> sheets_of(const Archive::Visit& visit) {
  std::deque<KeyMap> maps;
  KeyLister lister("", maps);
  visit(lister);
  std::vector<Sheet> sheets;
  for (const auto& map : maps) {
    Sheet sheet("", map.path.empty() ? "The file" : map.path, {"key", "value", "default", "meaning"});
    for (const auto& row : map.rows) sheet.add({row.key, row.value, row.fallback, row.meaning});
    sheets.push_back(std::move(sheet));
  }
  return sheets;
}

Sheet sheet_of(const std::string& title, const std::string& heading, const std::vector<cams::CamKey>& keys) {
  Sheet sheet("", title, {heading, "values", "default", "meaning"});
  for (const auto& key : keys) sheet.add({key.name, key.values, key.fallback, key.meaning});
  return sheet;
}

}  // namespace

std::vector<Page> scenario_pages() {
  return {
      {"scenario",
       "What a scenario file may say. NAME is a name of yours, N a place in a list, from 0: `--set` names "
       "values likewise. `drycut check --expand` shows a scenario with all its defaults.",
       "", sheets_of([](Archive& archive) {
         scenario::Scenario scratch;
         visit(archive, scratch);
       })},
      {"comparison", "What a scene may say that runs several scenarios and lays them over each other.", "",
       sheets_of([](Archive& archive) {
         studies::ComparisonScene scratch;
         visit(archive, scratch);
       })},
      {"recording",
       "What the YAML of a recording of a real machine may say. NAME is a channel of the machine.", "",
       sheets_of([](Archive& archive) {
         recordings::RecordingFile scratch;
         visit(archive, scratch);
       })}};
}

Page cam_table_page() {
  Page page{"cam_tables",
            "What a cam table may say. Lines `# key: value` stand above the header; `##` begins a remark.",
            "",
            {}};
  for (const auto& kind : cams::cam_kinds()) {
    page.preamble += fmt::format("{}{}: {}", page.preamble.empty() ? "" : "\n", kind.name, kind.header);
    page.sheets.push_back(sheet_of(fmt::format("{}: columns", kind.name), "column", kind.columns()));
    page.sheets.push_back(sheet_of(fmt::format("{}: keys", kind.name), "key", kind.keys()));
  }
  return page;
}

}  // namespace drycut::sim::cli
