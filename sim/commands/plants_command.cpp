#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/text.hpp"

#include "plants/plant.hpp"
#include "plants/world.hpp"
#include "sim/commands/commands.hpp"
#include "sim/commands/table_names.hpp"
#include "sim/commands/text_table.hpp"
#include "sim/scenario/parameter_text.hpp"

namespace drycut::sim {

namespace {

using nlohmann::ordered_json;

/// A plant of the type with its defaults, built, to ask it what it offers; plants that it needs are built
/// too.
struct Specimen {
  plants::World world{1};
  std::vector<std::unique_ptr<plants::PlantDefinition>> definitions;
  std::vector<std::unique_ptr<plants::Plant>> plants;
  std::vector<std::string> names;

  plants::Plant* build(const plants::PlantType& type, const std::string& name,
                       const std::string& drive = "") {
    definitions.push_back(type.define());
    auto* definition = definitions.back().get();
    for (auto& parameter : definition->parameters()) {
      if (!drive.empty() && parameter.name == "drive") *std::get<std::string*>(parameter.value) = drive;
      if (parameter.reference.empty() || *std::get<std::string*>(parameter.value) == plants::no_plant)
        continue;
      const auto& types = plants::plant_types();
      const auto other = std::find_if(types.begin(), types.end(),
                                      [&](const auto& t) { return t.name == parameter.reference; });
      *std::get<std::string*>(parameter.value) = std::string(parameter.reference);
      if (std::find(names.begin(), names.end(), parameter.reference) == names.end())
        build(*other, std::string(parameter.reference));
    }
    auto plant = definition->build(world, [this](std::string_view wanted) -> plants::Plant* {
      const auto found = std::find(names.begin(), names.end(), wanted);
      return found == names.end() ? nullptr : plants[static_cast<std::size_t>(found - names.begin())].get();
    });
    plants.push_back(std::move(plant));
    names.push_back(name);
    return plants.back().get();
  }
};

/// Something that a plant of the type offers, and with which drives if not with all of them.
template <typename Item>
struct Offered {
  Item item;
  std::vector<std::string> drives;
};

/// A specimen for every choice of the parameter `drive`, the default one first; one if it has no such
/// choice. A drive brings plugs, channels and faults of its own.
class Specimens {
 public:
  explicit Specimens(const plants::PlantType& type) {
    for (const auto& p : type.define()->parameters()) {
      if (p.name != "drive" || p.choices.empty()) continue;
      drives_ = {*std::get<std::string*>(p.value)};
      for (const auto& choice : p.choices)
        if (choice != drives_.front()) drives_.push_back(choice);
    }
    if (drives_.empty()) drives_ = {""};
    for (const auto& drive : drives_) {
      specimens_.push_back(std::make_unique<Specimen>());
      built_.push_back(specimens_.back()->build(type, "it", drive));
    }
  }

  [[nodiscard]] plants::Parameters parameters() const {
    return specimens_.front()->definitions.front()->parameters();
  }

  /// What the specimens offer by `list`, each once: `same` tells whether two of them are one.
  template <typename Item, typename Same>
  std::vector<Offered<Item>> offered(std::vector<Item> (plants::Plant::*list)(), Same same) const {
    std::vector<Offered<Item>> all;
    for (std::size_t i = 0; i < built_.size(); ++i) {
      for (auto& item : (built_[i]->*list)()) {
        auto known = std::find_if(all.begin(), all.end(), [&](const auto& o) { return same(o.item, item); });
        if (known == all.end()) known = all.insert(all.end(), {std::move(item), {}});
        known->drives.push_back(drives_[i]);
      }
    }
    for (auto& one : all)
      if (one.drives.size() == drives_.size()) one.drives.clear();
    return all;
  }

  [[nodiscard]] auto ports() const {
    return offered(&plants::Plant::ports, [](const auto& a, const auto& b) {
      return a.name == b.name && a.plug.index() == b.plug.index();
    });
  }
  [[nodiscard]] auto channels() const { return offered(&plants::Plant::channels, same_name_and_unit); }
  [[nodiscard]] auto settings() const { return offered(&plants::Plant::settings, same_name_and_unit); }
  [[nodiscard]] auto faults() const {
    return offered(&plants::Plant::faults, [](const auto& a, const auto& b) {
      return a.component == b.component && same_name_and_unit(a, b);
    });
  }
  [[nodiscard]] auto parts() const {
    return offered(&plants::Plant::parts, [](const auto& a, const auto& b) { return a.name == b.name; });
  }
  [[nodiscard]] auto events() const {
    return offered(&plants::Plant::event_types,
                   [](const auto& a, const auto& b) { return a.name == b.name; });
  }

 private:
  static constexpr auto same_name_and_unit = [](const auto& a, const auto& b) {
    return a.name == b.name && a.unit == b.unit;
  };
  std::vector<std::string> drives_;
  std::vector<std::unique_ptr<Specimen>> specimens_;
  std::vector<plants::Plant*> built_;
};

/// The meaning, with the drives that have it: "runs forward (drive: inverter, contactors)".
template <typename Item>
std::string meaning_text(const Offered<Item>& offered) {
  std::string text(offered.item.meaning);
  if (!offered.drives.empty()) text += fmt::format(" (drive: {})", fmt::join(offered.drives, ", "));
  return text;
}

std::string_view plug_text(const plants::Port& port) {
  constexpr std::string_view names[] = {"encoder (to a counter)", "signal (to an input or interrupt line)",
                                        "command (from an output)", "reference (from an analogue output)",
                                        "pulse train (from a pulse output)"};
  return names[port.plug.index()];
}

std::string range_text(const plants::Range& range) {
  return fmt::format("{:.12g} {} {:.12g}", range.min, range.whole && range.max == 1 ? "or" : "to", range.max);
}
std::string range_text(const plants::Parameter& parameter) {
  if (!parameter.choices.empty()) {
    std::string text;
    for (const auto& choice : parameter.choices) text += (text.empty() ? "" : " | ") + choice;
    return text;
  }
  if (!parameter.reference.empty()) return fmt::format("name of a {}", parameter.reference);
  if (std::holds_alternative<bool*>(parameter.value)) return "true | false";
  if (std::holds_alternative<std::string*>(parameter.value)) return "";
  return fmt::format("{:g}..{:g}", parameter.min, parameter.max);
}

template <typename Item>
ordered_json with_drives(ordered_json json, const Offered<Item>& offered) {
  if (!offered.drives.empty()) json["drives"] = offered.drives;
  return json;
}

/// "600 x 75 x 40 mm" of the part with the default parameters.
std::string part_size(const plants::Part& part) {
  return fmt::format("{:.4g} x {:.4g} x {:.4g} mm", part.size[0] * 1e3, part.size[1] * 1e3,
                     part.size[2] * 1e3);
}

ordered_json plant_json(const plants::PlantType& type) {
  ordered_json json = {{"name", type.name}, {"summary", type.summary}};
  const Specimens specimens(type);
  for (const auto& p : specimens.parameters()) {
    json["parameters"].push_back({{"name", p.name},
                                  {"default", value_text(p)},
                                  {"unit", p.unit},
                                  {"range", range_text(p)},
                                  {"meaning", p.meaning},
                                  {"source", p.source}});
  }
  for (const auto& o : specimens.ports())
    json["ports"].push_back(
        with_drives({{"name", o.item.name}, {"kind", plug_text(o.item)}, {"meaning", o.item.meaning}}, o));
  for (const auto& o : specimens.channels())
    json["channels"].push_back(
        with_drives({{"name", o.item.name}, {"unit", o.item.unit}, {"meaning", o.item.meaning}}, o));
  for (const auto& o : specimens.settings())
    json["settings"].push_back(with_drives({{"name", o.item.name},
                                            {"unit", o.item.unit},
                                            {"range", range_text(o.item.range)},
                                            {"meaning", o.item.meaning}},
                                           o));
  for (const auto& o : specimens.faults()) {
    const auto& f = o.item;
    json["faults"].push_back(with_drives({{"component", f.component},
                                          {"name", f.name},
                                          {"unit", f.unit},
                                          {"range", range_text(f.range)},
                                          {"meaning", f.meaning}},
                                         o));
  }
  for (const auto& o : specimens.events()) {
    ordered_json values = ordered_json::array();
    for (const auto& v : o.item.values) values.push_back({{"name", v.name}, {"unit", v.unit}});
    json["events"].push_back(
        with_drives({{"name", o.item.name}, {"values", values}, {"meaning", o.item.meaning}}, o));
  }
  for (const auto& o : specimens.parts())
    json["parts"].push_back(with_drives({{"name", o.item.name}, {"size", part_size(o.item)}}, o));
  return json;
}

/// "blade 3": what is before the number; the number, 0 = none.
std::pair<std::string, int> stem_of(const std::string& name) {
  const auto space = name.find_last_not_of("0123456789");
  if (space == std::string::npos || space + 1 == name.size() || name[space] != ' ') return {name, 0};
  return {name.substr(0, space), std::stoi(name.substr(space + 1))};
}

/// Parts that differ only in their number share a row: "piece 1..24".
void print_parts(const Specimens& specimens) {
  TextTable table({"part", "size x y z"});
  const auto parts = specimens.parts();
  for (std::size_t i = 0; i < parts.size();) {
    const auto& first = parts[i].item;
    const auto named = stem_of(first.name);
    const int number = named.second;
    std::size_t next = i + 1;
    const auto follows = [&](const plants::Part& part) {
      return number > 0 &&
             stem_of(part.name) == std::pair(named.first, number + static_cast<int>(next - i)) &&
             part.size == first.size;
    };
    while (next < parts.size() && follows(parts[next].item)) ++next;
    const auto last = number + static_cast<int>(next - i) - 1;
    table.add({last > number ? fmt::format("{}..{}", first.name, last) : first.name, part_size(first)});
    i = next;
  }
  table.print("Parts, for pictures.meshes, from their middle");
}

void print_plant(const plants::PlantType& type) {
  fmt::print("{}: {}\n", type.name, type.summary);
  const Specimens specimens(type);
  TextTable parameters({"parameter", "default", "range", "meaning", "from"});
  for (const auto& p : specimens.parameters()) {
    auto range = range_text(p);
    if (!p.unit.empty() && !range.empty()) range += fmt::format(" {}", p.unit);
    parameters.add({p.name, value_text(p), range, std::string(p.meaning), std::string(p.source)});
  }
  parameters.print("Parameters");
  TextTable ports({"plug", "kind", "meaning"});
  for (const auto& o : specimens.ports())
    ports.add({o.item.name, std::string(plug_text(o.item)), meaning_text(o)});
  ports.print("Plugs, for wiring");
  TextTable channels({"channel", "unit", "meaning"});
  for (const auto& o : specimens.channels()) channels.add({o.item.name, o.item.unit, meaning_text(o)});
  channels.print("Channels, for record, checks and plots");
  TextTable settings({"setting", "unit", "range", "meaning"});
  for (const auto& o : specimens.settings())
    settings.add({o.item.name, std::string(o.item.unit), range_text(o.item.range), meaning_text(o)});
  settings.print("Settings, for the timeline");
  TextTable faults({"component", "fault", "unit", "range", "meaning"});
  for (const auto& o : specimens.faults())
    faults.add(
        {o.item.component, o.item.name, std::string(o.item.unit), range_text(o.item.range), meaning_text(o)});
  faults.print("Faults, for the timeline");
  TextTable events({"event", "values", "meaning"});
  for (const auto& o : specimens.events()) {
    std::string values;
    for (const auto& v : o.item.values)
      values += fmt::format("{}{}{}", values.empty() ? "" : ", ", v.name,
                            v.unit.empty() ? "" : fmt::format(" [{}]", v.unit));
    events.add({std::string(o.item.name), values, meaning_text(o)});
  }
  events.print("Events, for checks");
  print_parts(specimens);
}

}  // namespace

int list_plants(const std::string& name, bool json) {
  std::vector<std::string> names;
  ordered_json all = ordered_json::array();
  for (const auto& type : plants::plant_types()) {
    names.emplace_back(type.name);
    if (name.empty() && json) all.push_back(plant_json(type));
    if (name.empty() && !json) fmt::print("{:<14} {}\n", type.name, type.summary);
    if (!name.empty() && same_word(type.name, name)) {
      if (json) {
        fmt::print("{}\n", plant_json(type).dump(2));
      } else {
        print_plant(type);
      }
      return all_passed;
    }
  }
  if (!name.empty()) return unknown("plant", name, names);
  if (json) fmt::print("{}\n", all.dump(2));
  return all_passed;
}

}  // namespace drycut::sim
