#include "sim/scenario/json_schema.hpp"

#include <fmt/format.h>

#include "base/json.hpp"
#include "sim/scenario/archive.hpp"

namespace drycut::sim::scenario {

namespace {

// Collects the keys of one map. What it visits is filled with defaults and thrown away.
class SchemaWriter final : public Archive {
 public:
  /// `whole`: false where another scenario gives what is missing.
  explicit SchemaWriter(bool whole = true) : whole_(whole) {}

  // A value, or a text with variables.
  void value(const Key& key, const Form& form) override { put(key, or_computed(json_from(form.schema()))); }

  void section(const Key& key, const Visit& visit) override { put(key, inner(visit)); }

  // A scenario that extends another may change entries of its lists by their names.
  void list(const Key& key, const Items& items) override {
    Json array = {{"type", "array"}, {"items", item_of(items, true)}};
    if (whole_) return put(key, std::move(array));
    Json by_name = {{"type", "object"}, {"additionalProperties", or_nothing(item_of(items, false))}};
    put(key, {{"anyOf", {std::move(array), std::move(by_name)}}});
  }

  void names(const Key& key, const Items& items) override {
    auto item = item_of(items, whole_);
    if (items.may_be_empty && whole_) item = or_nothing(std::move(item));
    put(key, {{"type", "object"}, {"additionalProperties", std::move(item)}});
  }

  // Nested maps are described; a name with dots is taken as it is.
  void table(const ParameterTable& table) override {
    for (const auto& row : table.rows) {
      auto* level = &properties_;
      std::string_view rest = row.name;
      for (auto dot = rest.find('.'); dot != std::string_view::npos; dot = rest.find('.')) {
        auto& group = (*level)[std::string(rest.substr(0, dot))];
        if (group.is_null()) group = object({}, true);
        level = &group["properties"];
        rest.remove_prefix(dot + 1);
      }
      auto& one = (*level)[std::string(rest)] = or_computed(json_from(row.form.schema()));
      one["description"] = row.meaning();
    }
    if (!table.open.empty()) properties_[table.open] = {{"type", "object"}};
    takes_dotted_ = true;
  }

  // By the word that is their type.
  void plants(const Key& key, std::vector<PlantEntry>&) override {
    Json types = Json::array();
    Json branches = Json::array();
    for (const auto& type : plants::plant_types()) {
      types.push_back(type.name);
      PlantEntry scratch{{}, {std::string(type.name), {}}, type.define(), {}};
      auto inside = inner([&](Archive& archive) { visit(archive, scratch); });
      inside["properties"]["type"] = {{"const", type.name}};
      branches.push_back(
          {{"if", {{"required", {"type"}}, {"properties", {{"type", {{"const", type.name}}}}}}},
           {"then", inside}});
    }
    Json plant = {{"type", "object"}, {"properties", {{"type", {{"enum", types}}}}}, {"allOf", branches}};
    if (whole_) plant["required"] = {"type"};
    put(key, {{"type", "object"}, {"additionalProperties", std::move(plant)}});
  }

  void controller(const Key& key, std::unique_ptr<ControllerSection>&) override {
    Json kinds = Json::object();
    for (const auto& kind : controller_kinds()) {
      const auto scratch = kind.make();
      kinds[std::string(kind.name)] = inner([&](Archive& archive) { scratch->visit(archive); });
    }
    auto one = object(std::move(kinds), false);
    if (whole_) one["minProperties"] = one["maxProperties"] = 1;
    put(key, std::move(one));
  }

  void alone(const Form& form) override { single_ = json_from(form.schema()); }
  bool instead(bool, const Form& form) override {
    alternative_ = or_computed(json_from(form.schema()));
    return false;
  }
  void require(std::string_view key, std::string_view) override {
    if (whole_) required_.push_back(key);
  }

  void require_one(const std::vector<std::string_view>& keys, std::string_view, std::string_view) override {
    if (!whole_) return;
    Json one = Json::array();
    for (const auto key : keys) one.push_back({{"required", Json::array({key})}});
    rules_.push_back({{"anyOf", std::move(one)}});
  }

  static Json of(const Visit& visit, bool whole) {
    SchemaWriter made(whole);
    visit(made);
    return made.take();
  }

 private:
  [[nodiscard]] Json inner(const Visit& visit) const { return of(visit, whole_); }

  static Json or_nothing(Json schema) { return {{"anyOf", {{{"type", "null"}}, std::move(schema)}}}; }
  // Every single value in it may be a text with variables.
  static Json or_computed(Json schema) {
    const auto type = schema.value("type", Json());
    if (type == "object" || type == "array") {
      auto& inside = schema[type == "object" ? "additionalProperties" : "items"];
      inside = or_computed(std::move(inside));
      return schema;
    }
    return {{"anyOf", {std::move(schema), {{"$ref", "#/$defs/computed"}}}}};
  }

  static Json object(Json properties, bool takes_dotted) {
    Json made = {{"type", "object"},
                 {"properties", properties.is_null() ? Json::object() : std::move(properties)},
                 {"additionalProperties", false}};
    if (takes_dotted) made["patternProperties"] = {{"[.]", {{"type", {"string", "number", "boolean"}}}}};
    return made;
  }

  static Json item_of(const Items& items, bool whole) {
    if (items.size == 0) items.add({});
    return of([&](Archive& archive) { items.visit(archive, 0); }, whole);
  }

  void put(const Key& key, Json schema) {
    if (!whole_) schema = or_nothing(std::move(schema));  // leaves out what is extended
    if (!key.meaning.empty()) schema["description"] = key.meaning;
    properties_[std::string(key.name)] = std::move(schema);
  }

  Json take() {
    if (!single_.is_null()) return or_computed(std::move(single_));
    auto made = object(std::move(properties_), takes_dotted_);
    if (!required_.empty()) made["required"] = std::move(required_);
    if (!rules_.empty()) made["allOf"] = std::move(rules_);
    if (alternative_.is_null()) return made;
    return {{"anyOf", {std::move(alternative_), std::move(made)}}};
  }

  Json properties_;
  Json required_ = Json::array();
  Json rules_ = Json::array();
  Json single_;
  Json alternative_;
  bool whole_;
  bool takes_dotted_ = false;
};

}  // namespace

std::string json_schema(const std::function<void(Archive&)>& comparison,
                        const std::function<void(Archive&)>& recording) {
  const auto scenario = [](Archive& archive) {
    Scenario scratch;
    visit(archive, scratch);
  };
  const auto extends = Json{{"required", {"extends"}}};
  const auto of = [&](const auto& visit) {
    return Json{
        {"if", extends}, {"then", SchemaWriter::of(visit, false)}, {"else", SchemaWriter::of(visit, true)}};
  };
  const Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                       {"title", "Drycut scenario"},
                       {"$defs", {{"computed", {{"type", "string"}, {"pattern", "[$][{]"}}}}},
                       {"if", {{"required", {"compare"}}}},
                       {"then", of(comparison)},
                       {"else",
                        {{"if", {{"required", {"file"}}}},
                         {"then", SchemaWriter::of(recording, true)},
                         {"else", of(scenario)}}}};
  return json_text(schema, 1);
}

}  // namespace drycut::sim::scenario
