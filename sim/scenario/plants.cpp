// plants: by name, their parameters read into the plant's own definition.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>
#include <unordered_map>

#include "sim/scenario/sections.hpp"
#include "sim/scenario/units.hpp"
#include "sim/scenario/yaml_reader.hpp"

namespace drycut::sim {

namespace {

using plants::Parameter;
using plants::Parameters;

// A number in the parameter's unit as a message shows it.
std::string shown(double number, std::string_view unit) {
  return unit.empty() ? fmt::format("{:.12g}", number) : fmt::format("{:.12g} {}", number, unit);
}

// Reads the parameters of one plant.
class ParameterReader {
 public:
  ParameterReader(PlantEntry& entry, Time step, Findings& findings)
      : entry_(entry), step_(step), parameters_(entry.definition->parameters()), findings_(findings) {}

  void read(const YamlNode& node) {
    read_level(node, "");
    if (findings_.count() != at_start_) return;  // an objection to a default would only be an echo
    for (const auto& objection : entry_.definition->objections(seconds(step_))) {
      findings_.add(place_of(objection.parameter),
                    fmt::format("{}.{}: {}", entry_.name.text, objection.parameter, objection.what),
                    objection.remedy);
    }
  }

 private:
  // A key is a parameter, or the first part of some: then its value is a map of the rest.
  void read_level(const YamlNode& node, const std::string& prefix) {
    const auto where = "plants." + entry_.name.text + (prefix.empty() ? "" : "." + prefix);
    refuse_duplicates(node, where, findings_);
    for (const auto& entry : node.entries) {
      const auto& key = entry.key;
      const auto& value = entry.value;
      if ((prefix.empty() && key.text == "type") || entry.is_repeated()) continue;
      const auto name = prefix.empty() ? key.text : prefix + "." + key.text;
      const auto full = "plants." + entry_.name.text + "." + name;
      if (auto* parameter = find(name)) {
        if (remember(name, key)) read_value(*parameter, value, key, full);
      } else if (!is_group(name)) {
        findings_.add(key.place, fmt::format("unknown key '{}' in {}", key.text, where),
                      suggestion(prefix, key.text));
      } else if (value.kind != YamlNode::Kind::map) {
        refuse_kind(value, full, YamlNode::Kind::map, findings_);
      } else {
        read_level(value, name);
      }
    }
  }

  Parameter* find(const std::string& name) {
    const auto found = std::find_if(parameters_.begin(), parameters_.end(),
                                    [&](const Parameter& parameter) { return parameter.name == name; });
    return found == parameters_.end() ? nullptr : &*found;
  }
  bool is_group(const std::string& name) const {
    return std::any_of(parameters_.begin(), parameters_.end(),
                       [&](const Parameter& parameter) { return parameter.name.starts_with(name + "."); });
  }

  // False if the parameter was given before: nested in one place and dotted in another.
  bool remember(const std::string& name, const Text& key) {
    for (const auto& [known, place] : entry_.places) {
      if (known != name) continue;
      findings_.add(key.place, fmt::format("plants.{}.{} is given twice", entry_.name.text, name),
                    fmt::format("keep one; the first is at line {}", place.line));
      return false;
    }
    entry_.places.emplace_back(name, key.place);
    return true;
  }

  std::string suggestion(const std::string& prefix, const std::string& key) const {
    std::vector<std::string> here;
    for (const auto& parameter : parameters_) {
      std::string_view rest = parameter.name;
      if (!prefix.empty()) {
        if (!rest.starts_with(prefix + ".")) continue;
        rest.remove_prefix(prefix.size() + 1);
      }
      const auto dot = rest.find('.');
      if (dot != std::string_view::npos) here.emplace_back(rest.substr(0, dot));
      here.emplace_back(rest);
    }
    if (const auto near = nearest(key, here); !near.empty()) {
      return fmt::format("did you mean {}?", near);
    }
    for (const auto& parameter : parameters_) {
      if (parameter.name.ends_with("." + key)) return fmt::format("did you mean {}?", parameter.name);
    }
    return fmt::format("'drycut plants {}' lists its parameters", entry_.type.text);
  }

  void read_value(const Parameter& parameter, const YamlNode& node, const Text& key,
                  const std::string& full) {
    if (node.kind == YamlNode::Kind::null) {
      findings_.add(key.place, fmt::format("{} has no value", full), "give it one, or leave the key out");
      return;
    }
    if (node.kind != YamlNode::Kind::scalar) {
      refuse_kind(node, full, YamlNode::Kind::scalar, findings_);
      return;
    }
    entry_.places.back().second = node.text.place;
    std::visit([&](auto* bound) { assign(parameter, *bound, node.text, full); }, parameter.value);
  }

  void assign(const Parameter& parameter, double& bound, const Text& text, const std::string& full) {
    const auto si = read_si(text, full, parameter.unit, findings_);
    if (!si) return;
    const auto quantity = parse_quantity(text.text);
    const bool same_unit = quantity->unit.empty() || quantity->unit == parameter.unit;
    const double number = same_unit ? quantity->number : from_si(*si, parameter.unit);
    // Another unit's conversion may miss a limit by its last digit.
    const double slack = same_unit ? 0 : 1e-12 * std::max(std::abs(parameter.min), std::abs(parameter.max));
    if (!(number >= parameter.min - slack && number <= parameter.max + slack)) {
      findings_.add(text.place, fmt::format("{} is {}, out of range", full, shown(number, parameter.unit)),
                    range(parameter));
      return;
    }
    bound = *si;
  }

  void assign(const Parameter& parameter, int& bound, const Text& text, const std::string& full) {
    const auto si = read_si(text, full, parameter.unit, findings_);
    if (!si) return;
    const double number = from_si(*si, parameter.unit);
    if (number != std::round(number)) {
      findings_.add(text.place, fmt::format("{} is {}, not a whole number", full, text.text),
                    range(parameter));
    } else if (!(number >= parameter.min && number <= parameter.max)) {
      findings_.add(text.place, fmt::format("{} is {}, out of range", full, shown(number, parameter.unit)),
                    range(parameter));
    } else {
      bound = static_cast<int>(number);
    }
  }

  void assign(const Parameter&, bool& bound, const Text& text, const std::string& full) {
    if (const auto on = read_switch(text, full, findings_)) bound = *on;
  }

  void assign(const Parameter& parameter, std::string& bound, const Text& text, const std::string& full) {
    if (!parameter.choices.empty() && !read_choice(text, full, parameter.choices, findings_)) return;
    bound = text.text;
  }

  static std::string range(const Parameter& parameter) {
    return fmt::format("{} to {}", shown(parameter.min, parameter.unit),
                       shown(parameter.max, parameter.unit));
  }

  Place place_of(const std::string& parameter) const {
    for (const auto& [name, place] : entry_.places) {
      if (name == parameter) return place;
    }
    return entry_.name.place;
  }

  PlantEntry& entry_;
  Time step_;
  Parameters parameters_;
  Findings& findings_;
  std::size_t at_start_ = findings_.count();
};

std::optional<PlantEntry> read_plant(const YamlNode::Entry& entry, std::span<const plants::PlantType> types,
                                     Findings& findings) {
  const auto full = "plants." + entry.key.text;
  std::vector<std::string> names;
  for (const auto& type : types) names.emplace_back(type.name);
  if (entry.value.kind != YamlNode::Kind::map) {
    auto node = entry.value;
    if (node.kind == YamlNode::Kind::null) node.text.place = entry.key.place;
    refuse_kind(node, full, YamlNode::Kind::map, findings);
    return {};
  }
  const auto type = std::find_if(entry.value.entries.begin(), entry.value.entries.end(),
                                 [](const YamlNode::Entry& given) { return given.key.text == "type"; });
  if (type == entry.value.entries.end() || type->value.kind == YamlNode::Kind::null) {
    findings.add(entry.key.place, fmt::format("{}.type is missing", full),
                 fmt::format("known: {}", fmt::join(names, ", ")));
    return {};
  }
  if (type->value.kind != YamlNode::Kind::scalar) {
    refuse_kind(type->value, full + ".type", YamlNode::Kind::scalar, findings);
    return {};
  }
  const auto& wanted = type->value.text;
  const auto known = std::find_if(types.begin(), types.end(),
                                  [&](const plants::PlantType& t) { return t.name == wanted.text; });
  if (known == types.end()) {
    findings.add(wanted.place, fmt::format("unknown plant type '{}'", wanted.text),
                 did_you_mean(wanted.text, names));
    return {};
  }
  return PlantEntry{entry.key, wanted, known->define(), {}};
}

Place place_of(const PlantEntry& plant, const std::string& parameter) {
  for (const auto& [name, place] : plant.places) {
    if (name == parameter) return place;
  }
  return plant.name.place;
}

// Where each plant is in a list.
using Index = std::unordered_map<std::string_view, std::size_t>;

Index index_of(const std::vector<PlantEntry>& plants) {
  Index index;
  for (std::size_t i = 0; i < plants.size(); ++i) index.emplace(plants[i].name.text, i);
  return index;
}

// The plants that one could refer to.
std::string fitting(const std::vector<PlantEntry>& all, const std::string& type) {
  constexpr std::size_t most = 10;
  std::vector<std::string> names;
  for (const auto& plant : all) {
    if (plant.type.text != type) continue;
    names.push_back(names.size() < most ? plant.name.text : "...");
    if (names.size() > most) break;
  }
  return names.empty() ? fmt::format("add a plant of type {}", type)
                       : fmt::format("name one of: {}", fmt::join(names, ", "));
}

// The plants that `plant` refers to; names that lead nowhere are problems. `given` are the names of the
// section, of plants that could not be read as well.
std::vector<std::size_t> references(const std::vector<PlantEntry>& all, const Index& index,
                                    const PlantEntry& plant, const std::set<std::string_view>& given,
                                    Findings& findings) {
  std::vector<std::size_t> found;
  for (const auto& parameter : plant.definition->parameters()) {
    if (parameter.reference.empty()) continue;
    const auto& name = *std::get<std::string*>(parameter.value);
    if (name == plants::no_plant) continue;
    const auto place = place_of(plant, parameter.name);
    const auto full = fmt::format("plants.{}.{}", plant.name.text, parameter.name);
    const auto target = index.find(name);
    if (target != index.end() && all[target->second].type.text == parameter.reference) {
      found.push_back(target->second);
      continue;
    }
    const auto remedy = fitting(all, std::string(parameter.reference));
    if (target != index.end()) {
      findings.add(place,
                   fmt::format("{}: {} is a {}, not a {}", full, name, all[target->second].type.text,
                               parameter.reference),
                   remedy);
    } else if (name.empty()) {
      findings.add(place, fmt::format("{} names no plant", full), remedy);
    } else if (!given.contains(name)) {
      findings.add(place, fmt::format("{}: there is no plant '{}'", full, name), remedy);
    }
  }
  return found;
}

// Every plant behind those that it refers to, else in the order of the file; a circle is a problem.
std::vector<PlantEntry> sorted(std::vector<PlantEntry> plants, const YamlNode& section, Findings& findings) {
  std::set<std::string_view> given;
  for (const auto& entry : section.entries) given.insert(entry.key.text);
  const auto index = index_of(plants);
  std::vector<std::size_t> open(plants.size());  // plants that each one waits for
  std::vector<std::vector<std::size_t>> waiting(plants.size());
  std::set<std::size_t> ready;
  for (std::size_t i = 0; i < plants.size(); ++i) {
    const auto needs = references(plants, index, plants[i], given, findings);
    open[i] = needs.size();
    for (const auto need : needs) waiting[need].push_back(i);
    if (needs.empty()) ready.insert(i);
  }
  std::vector<PlantEntry> order;
  std::vector<bool> placed(plants.size(), false);
  while (!ready.empty()) {
    const auto next = *ready.begin();
    ready.erase(ready.begin());
    placed[next] = true;
    order.push_back(std::move(plants[next]));
    for (const auto other : waiting[next])
      if (--open[other] == 0) ready.insert(other);
  }
  for (std::size_t i = 0; i < plants.size(); ++i) {
    if (placed[i]) continue;
    findings.add(plants[i].name.place,
                 fmt::format("plants.{} refers to itself in a circle", plants[i].name.text),
                 "let one of the plants stand alone");
    order.push_back(std::move(plants[i]));
  }
  return order;
}

// What plants object to in each other.
void object_to_each_other(const std::vector<PlantEntry>& all, Time step, Findings& findings) {
  const auto index = index_of(all);
  const auto find = [&](std::string_view name) -> plants::PlantDefinition* {
    const auto found = index.find(name);
    return found == index.end() ? nullptr : all[found->second].definition.get();
  };
  for (const auto& plant : all)
    for (const auto& objection : plant.definition->objections_with(find, seconds(step)))
      findings.add(place_of(plant, objection.parameter),
                   fmt::format("{}.{}: {}", plant.name.text, objection.parameter, objection.what),
                   objection.remedy);
}

// A reference that is `sole` is a place for one: a web has one cut.
void refuse_shared_places(const std::vector<PlantEntry>& all, Findings& findings) {
  std::vector<std::pair<std::string, const PlantEntry*>> taken;
  for (const auto& plant : all) {
    for (const auto& parameter : plant.definition->parameters()) {
      if (!parameter.sole) continue;
      const auto& name = *std::get<std::string*>(parameter.value);
      const auto other =
          std::find_if(taken.begin(), taken.end(), [&](const auto& place) { return place.first == name; });
      if (other == taken.end()) {
        taken.emplace_back(name, &plant);
        continue;
      }
      findings.add(place_of(plant, parameter.name),
                   fmt::format("plants.{}.{}: {} has the {} {} already", plant.name.text, parameter.name,
                               name, other->second->type.text, other->second->name.text),
                   fmt::format("give it a {} of its own: behind one cut the {} is in pieces",
                               parameter.reference, parameter.reference));
    }
  }
}

}  // namespace

std::vector<PlantEntry> read_plants(const YamlNode& node, std::span<const plants::PlantType> types, Time step,
                                    Findings& findings) {
  const auto before = findings.count();
  std::vector<PlantEntry> plants;
  refuse_duplicates(node, "plants", findings);
  for (const auto& entry : node.entries) {
    const auto& name = entry.key.text;
    if (name == "panel" || name.empty() ||
        name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_") !=
            std::string::npos) {
      findings.add(entry.key.place, fmt::format("'{}' cannot name a plant", name),
                   "letters, digits and underscores; panel is the operator's panel");
      continue;
    }
    if (entry.is_repeated()) continue;
    auto plant = read_plant(entry, types, findings);
    if (!plant) continue;
    ParameterReader(*plant, step, findings).read(entry.value);
    plants.push_back(std::move(*plant));
  }
  auto order = sorted(std::move(plants), node, findings);
  if (findings.count() == before) refuse_shared_places(order, findings);
  if (findings.count() == before) object_to_each_other(order, step, findings);
  return order;
}

}  // namespace drycut::sim
