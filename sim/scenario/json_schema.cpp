#include "sim/scenario/json_schema.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "sim/controllers/kinds.hpp"
#include "sim/scenario/archive.hpp"
#include "sim/studies/compare/scene.hpp"

namespace drycut::sim::scenario {

namespace {

using Json = nlohmann::ordered_json;

// Collects the keys of one map. What it visits is filled with defaults and thrown away.
class SchemaWriter final : public Archive {
 public:
  void value(const Key& key, const Form& form) override { put(key, Json::parse(form.schema())); }

  void section(const Key& key, const Visit& visit) override { put(key, of(visit)); }

  void list(const Key& key, const Items& items) override {
    put(key, {{"type", "array"}, {"items", item_of(items)}});
  }

  void names(const Key& key, const Items& items) override {
    auto item = item_of(items);
    if (items.may_be_empty) item = {{"anyOf", {{{"type", "null"}}, std::move(item)}}};
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
      auto& one = (*level)[std::string(rest)] = Json::parse(row.form.schema());
      one["description"] = row.meaning();
    }
    takes_dotted_ = true;
  }

  // By the word that is their type.
  void plants(const Key& key, std::vector<PlantEntry>&) override {
    Json types = Json::array();
    Json branches = Json::array();
    for (const auto& type : plants::plant_types()) {
      types.push_back(type.name);
      PlantEntry scratch{{}, {std::string(type.name), {}}, type.define(), {}};
      auto inside = of([&](Archive& archive) { visit(archive, scratch); });
      inside["properties"]["type"] = {{"const", type.name}};
      branches.push_back({{"if", {{"properties", {{"type", {{"const", type.name}}}}}}}, {"then", inside}});
    }
    put(key, {{"type", "object"},
              {"additionalProperties",
               {{"type", "object"},
                {"required", {"type"}},
                {"properties", {{"type", {{"enum", types}}}}},
                {"allOf", branches}}}});
  }

  void controller(const Key& key, std::unique_ptr<ControllerSection>&) override {
    Json kinds = Json::object();
    for (const auto& kind : controllers::controller_kinds()) {
      const auto scratch = kind.make();
      kinds[std::string(kind.name)] = of([&](Archive& archive) { scratch->visit(archive); });
    }
    auto one = object(std::move(kinds), false);
    one["minProperties"] = one["maxProperties"] = 1;
    put(key, std::move(one));
  }

  void alone(const Form& form) override { single_ = Json::parse(form.schema()); }
  bool instead(bool, const Form& form) override {
    alternative_ = Json::parse(form.schema());
    return false;
  }
  void require(std::string_view key, std::string_view) override { required_.push_back(key); }

  void require_one(const std::vector<std::string_view>& keys, std::string_view, std::string_view) override {
    Json one = Json::array();
    for (const auto key : keys) one.push_back({{"required", Json::array({key})}});
    rules_.push_back({{"anyOf", std::move(one)}});
  }

  static Json of(const Visit& visit) {
    SchemaWriter inner;
    visit(inner);
    return inner.take();
  }

 private:
  static Json object(Json properties, bool takes_dotted) {
    Json made = {{"type", "object"},
                 {"properties", properties.is_null() ? Json::object() : std::move(properties)},
                 {"additionalProperties", false}};
    if (takes_dotted) made["patternProperties"] = {{"[.]", {{"type", {"string", "number", "boolean"}}}}};
    return made;
  }

  static Json item_of(const Items& items) {
    if (items.size == 0) items.add({});
    return of([&](Archive& archive) { items.visit(archive, 0); });
  }

  void put(const Key& key, Json schema) {
    if (!key.meaning.empty()) schema["description"] = key.meaning;
    properties_[std::string(key.name)] = std::move(schema);
  }

  Json take() {
    if (!single_.is_null()) return std::move(single_);
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
  bool takes_dotted_ = false;
};

}  // namespace

std::string json_schema() {
  const auto scenario = SchemaWriter::of([](Archive& archive) {
    Scenario scratch;
    visit(archive, scratch);
  });
  const auto comparison = SchemaWriter::of([](Archive& archive) {
    studies::ComparisonScene scratch;
    studies::visit(archive, scratch);
  });
  const Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                       {"title", "Drycut scenario"},
                       {"if", {{"required", {"compare"}}}},
                       {"then", comparison},
                       {"else", scenario}};
  return schema.dump(1);
}

}  // namespace drycut::sim::scenario
