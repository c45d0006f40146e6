// --set path=value, put into the tree before the scenario is read.
#include <fmt/format.h>

#include <algorithm>

#include "base/text.hpp"
#include "sim/scenario/archive.hpp"
#include "sim/scenario/sections.hpp"
#include "sim/scenario/units.hpp"

namespace drycut::sim::scenario {

namespace {

class OverrideSetter {
 public:
  OverrideSetter(const Override& override, int source, Findings& findings)
      : override_(override), place_{1, 1, source}, findings_(findings) {}

  void apply(YamlNode& root) {
    if (override_.path == "extends")
      return refuse("option.set-path"_code, "what a scenario extends cannot be set",
                    "write extends into a scenario of its own");
    const auto before = findings_.count();
    value_ = parse_yaml(override_.value, place_.source, findings_);
    if (findings_.count() != before) return;
    root_ = &root;
    if (root.kind == YamlNode::Kind::map) set(root, override_.path, "");
  }

 private:
  // Follows `rest` below `node`, which is called `name`.
  void set(YamlNode& node, std::string_view rest, const std::string& name) {
    if (rest.empty())
      return refuse("option.set-path"_code, "the path ends with a dot or is empty",
                    "write section.key=value");
    switch (node.kind) {
      case YamlNode::Kind::map:
        return set_in_map(node, rest, name);
      case YamlNode::Kind::sequence:
        return set_in_list(node, rest, name);
      case YamlNode::Kind::scalar:
      case YamlNode::Kind::null:
        refuse("option.set-path"_code, fmt::format("{} is {}; nothing is below it", name, name_of(node.kind)),
               fmt::format("--set {}=value", name));
    }
  }

  static bool begins_with(std::string_view path, const std::string& key) {
    return path == key || (path.starts_with(key) && path.substr(key.size()).starts_with('.'));
  }

  // Keys may contain dots themselves (wiring.2.CNT01): the longest that fits is meant.
  void set_in_map(YamlNode& map, std::string_view rest, const std::string& name) {
    YamlNode::Entry* best = nullptr;
    for (auto& entry : map.entries) {
      const auto& key = entry.key.text;
      if (begins_with(rest, key) && (best == nullptr || key.size() > best->key.text.size())) best = &entry;
    }
    if (best == nullptr) return add(map, rest, name);
    const auto full = name.empty() ? best->key.text : name + "." + best->key.text;
    if (rest == best->key.text && name == "variables") {
      give(*best, value_);
    } else if (rest == best->key.text) {
      replace(best->value, full);
    } else {
      // A key that stands without a value is as good as absent.
      if (best->value.kind == YamlNode::Kind::null) best->value.kind = YamlNode::Kind::map;
      set(best->value, rest.substr(best->key.text.size() + 1), full);
    }
  }

  // A key that the file leaves at its default, and the maps on the way to it. The readers refuse what they do
  // not know, except where any name would do: sections and plants are not made up here.
  void add(YamlNode& map, std::string_view rest, const std::string& name) {
    const auto dot = rest.find('.');
    const std::string first(rest.substr(0, dot));
    const auto& sections = section_names();
    const bool section = std::find(sections.begin(), sections.end(), first) != sections.end();
    if (dot == std::string_view::npos && name.empty() && !section && is_variable(map, rest))
      return refuse("option.set-path"_code, fmt::format("there is no '{}' in the scenario", rest),
                    fmt::format("it is a variable: --set variables.{}={}", rest, override_.value));
    if ((dot == std::string_view::npos && name != "variables") || takes_dotted_keys(name)) {
      map.entries.push_back({Text{std::string(rest), place_}, value_});
    } else if (name.empty() ? section : name != "plants" && name != "variables") {
      map.entries.push_back({Text{first, place_}, YamlNode{YamlNode::Kind::map, {"", place_}}});
      set(map.entries.back().value, rest.substr(dot + 1), name.empty() ? first : name + "." + first);
    } else {
      std::vector<std::string> keys = name.empty() ? sections : std::vector<std::string>();
      for (const auto& entry : map.entries) keys.push_back(entry.key.text);
      std::sort(keys.begin(), keys.end());
      keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
      const auto remedy = did_you_mean(first, keys);
      const auto* controller = name.empty() ? child(map, "controller") : nullptr;
      const bool is_value =
          controller != nullptr && controller->entries.size() == 1 && nearest(first, keys).empty();
      const auto* plants = name.empty() ? child(map, "plants") : nullptr;
      const bool is_plant =
          plants != nullptr && std::any_of(plants->entries.begin(), plants->entries.end(),
                                           [&](const auto& entry) { return entry.key.text == first; });
      refuse("option.set-path"_code,
             fmt::format("there is no '{}' in {}", first, name.empty() ? "the scenario" : name),
             is_plant   ? fmt::format("it is a plant: --set plants.{}={}", override_.path, override_.value)
             : is_value ? fmt::format("of the controller's values write controller.{}.set.{}; {}",
                                      controller->entries.front().key.text, rest, remedy)
                        : remedy);
    }
  }

  // Parameters of a plant (servo.rated_torque) or an axis and names of terminals, targets and variables.
  static bool takes_dotted_keys(const std::string& name) {
    return name.starts_with("plants.") || name.starts_with("controller.plcopen.axes.") || name == "wiring" ||
           name == "inputs" || (name.starts_with("controller.") && name.ends_with(".set")) ||
           (name.starts_with("timeline.") && (name.ends_with(".set") || name.ends_with(".ramp")));
  }

  static bool is_variable(const YamlNode& root, std::string_view name) {
    const auto* variables = child(root, "variables");
    return variables != nullptr && child(*variables, name) != nullptr;
  }

  // By the name of an entry, which may contain dots itself, or by its number.
  void set_in_list(YamlNode& list, std::string_view rest, const std::string& name) {
    auto part = rest.substr(0, rest.find('.'));
    auto index = parsed<std::size_t>(part).value_or(list.items.size());
    std::vector<std::string> names;
    for (std::size_t i = 0; i < list.items.size(); ++i) {
      const auto* own = name_of_item(list.items[i]);
      if (own == nullptr) continue;
      names.push_back(own->text);
      if (!begins_with(rest, own->text) || own->text.size() < part.size()) continue;
      part = rest.substr(0, own->text.size());
      index = i;
    }
    if (index >= list.items.size()) {
      const auto numbers =
          list.items.empty() ? std::string("it is empty") : fmt::format("0 to {}", list.items.size() - 1);
      return refuse("option.set-path"_code, fmt::format("'{}' is no entry of the list {}", part, name),
                    did_you_mean(part, names, names.empty() ? numbers : numbers + ", or " + listed(names)));
    }
    auto& item = list.items[index];
    if (part.size() == rest.size()) {
      replace(item, fmt::format("{}.{}", name, part));
    } else {
      set(item, rest.substr(part.size() + 1), fmt::format("{}.{}", name, part));
    }
  }

  // Nobody should have to know in which unit a number without one is read where the scenario writes one.
  void replace(YamlNode& node, const std::string& name) {
    const auto written = unit_of(node);
    const auto given =
        value_.kind == YamlNode::Kind::scalar ? parse_quantity(value_.text.text) : std::nullopt;
    if (!written.empty() && given && given->unit.empty()) {
      const auto& place = node.text.place;
      return refuse(
          "scenario.wrong-unit"_code,
          fmt::format("{} has a unit in the scenario ({}, {}:{}:{}), and {} has none", name, node.text.text,
                      findings_.sources().at(static_cast<std::size_t>(place.source)), place.line,
                      place.column, value_.text.text),
          fmt::format("write {} {} if that is meant", value_.text.text, written));
    }
    node = value_;
  }

  // Of a quantity that needs one, or of the variable that stands for it; else "".
  [[nodiscard]] std::string unit_of(const YamlNode& node) const {
    if (node.kind != YamlNode::Kind::scalar) return "";
    const auto& text = node.text.text;
    if (text.starts_with("${") && text.find('}') + 1 == text.size()) {
      const auto* variables = child(*root_, "variables");
      const auto* value = variables == nullptr ? nullptr : child(*variables, text.substr(2, text.size() - 3));
      return value == nullptr || value->text.text.starts_with("${") ? "" : unit_of(*value);
    }
    const auto quantity = parse_quantity(text);
    return quantity && is_unit(quantity->unit) && needs_unit(quantity->unit) ? quantity->unit : "";
  }

  void refuse(Code code, std::string what, std::string remedy) {
    findings_.add(code, place_, std::move(what), std::move(remedy));
  }

  const Override& override_;
  ScenePlace place_;
  Findings& findings_;
  YamlNode value_;
  const YamlNode* root_ = nullptr;
};

}  // namespace

void apply_override(YamlNode& root, const Override& override, int source, Findings& findings) {
  OverrideSetter(override, source, findings).apply(root);
}

}  // namespace drycut::sim::scenario
