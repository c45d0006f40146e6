// plants: by name, their parameters read into the plant's own definition.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string_view>
#include <unordered_map>

#include "base/text.hpp"
#include "sim/file.hpp"
#include "sim/scenario/archive.hpp"
#include "sim/scenario/guests.hpp"
#include "sim/scenario/motor_catalogue.hpp"
#include "sim/scenario/parameter_text.hpp"

namespace drycut::sim::scenario {

namespace {

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
    findings.add(
        "scenario.missing-key"_code, entry.key.place, fmt::format("{}.type is missing", full),
        did_you_mean(entry.key.text, entry.value.beside, fmt::format("known: {}", fmt::join(names, ", "))));
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
    findings.add("plant.unknown-type"_code, wanted.place, fmt::format("unknown plant type '{}'", wanted.text),
                 did_you_mean(wanted.text, names));
    return {};
  }
  return PlantEntry{entry.key, wanted, known->define(), {}};
}

ScenePlace place_of(const PlantEntry& plant, const std::string& parameter) {
  for (const auto& [name, place] : plant.places) {
    if (name == parameter) return place;
  }
  for (const auto& value : plant.modelled) {
    if (value.parameter == parameter) return value.place;
  }
  return plant.name.place;
}

// The value of a name with dots, given whole or as nested maps; nullptr if there is none.
const YamlNode* value_of(const YamlNode& map, std::string_view name) {
  if (const auto* value = child(map, name)) return value;
  for (auto dot = name.find('.'); dot != std::string_view::npos; dot = name.find('.', dot + 1)) {
    const auto* const group = child(map, name.substr(0, dot));
    if (group == nullptr) continue;
    if (const auto* value = value_of(*group, name.substr(dot + 1))) return value;
  }
  return nullptr;
}

// The values of the models that a plant names, before those that the scenario gives beside them.
void take_models(const YamlNode& node, PlantEntry& plant, MotorCatalogue& catalogue, Findings& findings) {
  const auto parameters = plant.definition->parameters();
  for (const auto& row : parameters) {
    const auto kind = motor_kind(row.name);
    const auto* const model = kind.empty() ? nullptr : value_of(node, row.name);
    if (model == nullptr || model->kind != YamlNode::Kind::scalar || model->text.text == plants::no_model)
      continue;
    const auto full = fmt::format("plants.{}.{}", plant.name.text, row.name);
    const auto* const motor = catalogue.find(kind, model->text, full);
    if (motor == nullptr) continue;
    const auto group = row.name.substr(0, row.name.size() - std::string_view("model").size());
    for (const auto& value : motor->values) {
      const auto parameter = std::find_if(parameters.begin(), parameters.end(), [&](const auto& candidate) {
        return candidate.name == group + value.parameter;
      });
      if (parameter == parameters.end()) continue;  // on the name plate only
      form(*parameter)
          .read(YamlNode(YamlNode::Kind::scalar, value.text), {full, model->text.place}, findings);
      const auto* const* const number = std::get_if<double*>(&parameter->value);
      plant.modelled.push_back({parameter->name, fmt::format("{}, {}", motor->name.text, value.from),
                                model->text.place, false, number == nullptr ? 0 : **number});
    }
  }
}

// The values of the presets that a plant names, but those that are given: after all has been read, for some
// are shares of others. What a model gives is given, unless the scenario itself names the preset.
void take_presets(PlantEntry& plant) {
  const auto parameters = plant.definition->parameters();
  const auto number = [&](std::string_view name) -> double& {
    return *std::get<double*>(std::ranges::find(parameters, name, &plants::Parameter::name)->value);
  };
  const auto given = [&](std::string_view name) {
    return std::ranges::find(plant.places, name, &decltype(plant.places)::value_type::first);
  };
  const auto modelled = [&](std::string_view name) {
    return std::ranges::find(plant.modelled, name, &PlantEntry::Modelled::parameter);
  };
  for (const auto& row : parameters) {
    if (row.presets == nullptr) continue;
    const auto named = given(row.name);
    const bool by_model = named == plant.places.end();
    if (by_model && modelled(row.name) == plant.modelled.end()) continue;
    const auto place = by_model ? modelled(row.name)->place : named->second;
    const auto preset =
        std::ranges::find(*row.presets, *std::get<std::string*>(row.value), &plants::Preset::name);
    if (preset == row.presets->end()) continue;  // refused where the word itself was read
    for (const auto& value : preset->values) {
      if (given(value.parameter) != plant.places.end()) continue;
      const auto known = modelled(value.parameter);
      if (known != plant.modelled.end() && by_model) continue;
      number(value.parameter) = value.of.empty() ? value.value : value.value * number(value.of);
      PlantEntry::Modelled made{std::string(value.parameter),
                                fmt::format("{}, {}", preset->name, value.source), place, true};
      if (known == plant.modelled.end())
        plant.modelled.push_back(std::move(made));
      else
        *known = std::move(made);
    }
  }
}

// A motor on mains of another class than its sheet is for would have another torque over speed.
void object_to_mains(const PlantEntry& plant, Findings& findings) {
  constexpr double same_class = 0.2;  // 380 V to 480 V beside 400 V
  for (const auto& row : plant.definition->parameters()) {
    if (!row.name.ends_with(".supply.voltage")) continue;
    const auto rated = std::ranges::find(plant.modelled, row.name, &PlantEntry::Modelled::parameter);
    if (rated == plant.modelled.end()) continue;
    const double mains = *std::get<double*>(row.value);
    if (std::abs(mains / rated->value - 1) <= same_class) continue;
    findings.add("plant.parameters-contradict"_code, place_of(plant, row.name),
                 fmt::format("{}.{}: {} is for mains of {:g} V, not of {:g} V", plant.name.text, row.name,
                             rated->from.substr(0, rated->from.find(", ")), rated->value, mains),
                 "leave it out: the motor's comes with it; or another motor");
  }
}

void object(const PlantEntry& plant, const std::vector<plants::PlantDefinition::Objection>& objections,
            Findings& findings) {
  for (const auto& objection : objections)
    findings.add(objection.code, place_of(plant, objection.parameter),
                 fmt::format("{}.{}: {}", plant.name.text, objection.parameter, objection.what),
                 objection.remedy);
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
      findings.add("plant.wrong-reference"_code, place,
                   fmt::format("{}: {} is a {}, not a {}", full, name, all[target->second].type.text,
                               parameter.reference),
                   remedy);
    } else if (name.empty()) {
      findings.add("plant.unknown-plant"_code, place, fmt::format("{} names no plant", full), remedy);
    } else if (!given.contains(name)) {
      findings.add("plant.unknown-plant"_code, place, fmt::format("{}: there is no plant '{}'", full, name),
                   remedy);
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
    findings.add("plant.reference-circle"_code, plants[i].name.place,
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
    object(plant, plant.definition->objections_with(find, seconds(step)), findings);
}

// One that refers to the same plant by a parameter that is `sole`, and what it takes of it.
struct StandingPlant {
  const PlantEntry* plant;
  std::string target;
  plants::PlantDefinition::Stretch stretch;
};

std::string millimetres(const plants::PlantDefinition::Stretch& stretch) {
  return fmt::format("{:.0f} to {:.0f} mm", stretch.from * 1000, stretch.to * 1000);
}

// A reference that is `sole` is a place for one: two machines cannot stand in one place on a line.
void refuse_shared_places(const std::vector<PlantEntry>& all, Findings& findings) {
  std::vector<StandingPlant> taken;
  for (const auto& plant : all) {
    for (const auto& parameter : plant.definition->parameters()) {
      if (!parameter.sole) continue;
      const auto everywhere = std::numeric_limits<double>::infinity();
      const StandingPlant one = {
          &plant, *std::get<std::string*>(parameter.value),
          plant.definition->stretch().value_or(plants::PlantDefinition::Stretch{-everywhere, everywhere})};
      const auto other = std::find_if(taken.begin(), taken.end(), [&](const StandingPlant& there) {
        return there.target == one.target && there.stretch.from < one.stretch.to &&
               one.stretch.from < there.stretch.to;
      });
      if (other == taken.end()) {
        taken.push_back(one);
        continue;
      }
      const bool placed = std::ranges::find(plant.places, "place",
                                            &decltype(plant.places)::value_type::first) != plant.places.end();
      const std::string_view named = placed ? std::string_view("place") : std::string_view(parameter.name);
      findings.add(
          "plant.no-room"_code, place_of(plant, std::string(named)),
          fmt::format("plants.{}.{}: it takes {} of {}, where the {} {} stands, {}", plant.name.text, named,
                      millimetres(one.stretch), one.target, other->plant->type.text, other->plant->name.text,
                      millimetres(other->stretch)),
          fmt::format("'place' {:.0f} mm or more further down the line, or a {} of its own",
                      std::ceil((other->stretch.to - one.stretch.from) * 1000), parameter.reference));
    }
  }
}

// What an editor shows of a parameter.
std::string described(const plants::Parameter& parameter) {
  const auto unit = parameter.unit.empty() ? std::string() : fmt::format(" [{}]", parameter.unit);
  const bool number = parameter.value.index() < 2;
  const auto range =
      number ? fmt::format("; {:.12g} to {:.12g}", parameter.min, parameter.max) : std::string();
  return fmt::format("{}{}{}; default {}", parameter.meaning, unit, range, value_text(parameter));
}

}  // namespace

void visit(Archive& archive, PlantEntry& plant) {
  archive.value({"type", "what it is"}, form(plant.type));
  const auto parameters = plant.definition->parameters();
  ParameterTable table{{}, fmt::format("'drycut plants {}' lists its parameters", plant.type.text)};
  table.places = &plant.places;
  if (auto* const guest = dynamic_cast<plants::GuestDefinition*>(plant.definition.get())) {
    if (!guest->file().empty())
      table.help = fmt::format("'drycut plants {}' lists its variables", guest->file());
    table.open = "parameters";
    archive.value({"units", "units of variables of the FMU that declare none, {u: V, y: mm/s}"},
                  guest_units_form(plant.units));
  }
  for (const auto& parameter : parameters)
    table.rows.push_back({parameter.name, [&parameter] { return described(parameter); },
                          motor_kind(parameter.name).empty() ? form(parameter) : model_form(parameter)});
  archive.table(table);
}

std::vector<PlantEntry> read_plants(const YamlNode& node, std::span<const plants::PlantType> types, Time step,
                                    const std::filesystem::path& folder, Findings& findings) {
  const auto before = findings.count();
  MotorCatalogue catalogue(folder, findings);
  std::vector<PlantEntry> plants;
  refuse_duplicates(node, "plants", findings);
  for (const auto& entry : node.entries) {
    const auto& name = entry.key.text;
    if (name == "panel" || name.empty() ||
        name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_") !=
            std::string::npos) {
      findings.add("scenario.bad-name"_code, entry.key.place, fmt::format("'{}' cannot name a plant", name),
                   "letters, digits and underscores; panel is the operator's panel");
      continue;
    }
    if (entry.is_repeated()) continue;
    auto plant = read_plant(entry, types, findings);
    if (!plant) continue;
    if (!read_guest(entry.value, *plant, folder, findings)) continue;
    MapReader reader(entry.value, "plants." + name, findings);
    take_models(entry.value, *plant, catalogue, findings);
    visit(reader, *plant);
    if (auto* const guest = dynamic_cast<plants::GuestDefinition*>(plant->definition.get()))
      guest->file() = findings.path_from(child(entry.value, "file")->text);
    take_presets(*plant);
    object_to_mains(*plant, findings);
    // An objection to a default would only be an echo.
    if (reader.is_sound()) object(*plant, plant->definition->objections(seconds(step)), findings);
    plants.push_back(std::move(*plant));
  }
  auto order = sorted(std::move(plants), node, findings);
  if (findings.count() == before) refuse_shared_places(order, findings);
  if (findings.count() == before) object_to_each_other(order, step, findings);
  return order;
}

}  // namespace drycut::sim::scenario
