#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "devices/catalogue.hpp"
#include "devices/device.hpp"
#include "plants/plant.hpp"
#include "plants/world.hpp"
#include "sim/commands/commands.hpp"
#include "sim/commands/lx3vp_tables.hpp"
#include "sim/commands/text_table.hpp"
#include "sim/scenario/parameter_text.hpp"

namespace drycut::sim {

namespace {

using nlohmann::ordered_json;

int unknown(const std::string& kind, const std::string& name, const std::vector<std::string>& names) {
  const auto near = devices::nearest(name, names);
  std::string all;
  for (const auto& known : names) all += (all.empty() ? "" : ", ") + known;
  fmt::print(stderr, "drycut {}s: there is no {} type '{}'; {}\n", kind, kind, name,
             near.empty() ? "there are: " + all : fmt::format("did you mean {}?", near));
  return bad_input;
}

// Devices.

std::string condition_text(const devices::DeviceType& type, const devices::Condition& condition) {
  std::string text;
  for (std::size_t i = 0; i < type.states.size(); ++i) {
    if ((condition.mask >> i & 1) == 0) continue;
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", type.states[i].name, condition.value >> i & 1);
  }
  if (!condition.also.empty()) text += fmt::format("{}{}", text.empty() ? "" : ", ", condition.also);
  return text;
}

std::string_view retention_text(devices::Retention retention) {
  switch (retention) {
    case devices::Retention::retentive:
      return "retentive";
    case devices::Retention::zero:
      return "0";
    case devices::Retention::one:
      return "1";
  }
  return "";
}

std::string_view access_text(devices::Access access) {
  return access == devices::Access::read ? "read" : "read/write";
}

std::string variable_name(const devices::Variable& variable) {
  const auto name = std::string(variable.name);
  return variable.rows > 1 ? fmt::format("{}1..{}", name, variable.rows) : name;
}

ordered_json device_json(const devices::DeviceType& type) {
  ordered_json json = {{"name", type.name}, {"summary", type.summary}};
  for (const auto& field : type.fields)
    json["fields"].push_back({{"name", field.name}, {"meaning", field.meaning}});
  for (const auto& v : type.variables) {
    json["variables"].push_back({{"name", v.name},
                                 {"rows", v.rows},
                                 {"size", std::string(1, static_cast<char>(v.size))},
                                 {"min", v.min},
                                 {"max", v.max},
                                 {"unit", v.unit},
                                 {"access", access_text(v.access)},
                                 {"retention", retention_text(v.retention)},
                                 {"condition", condition_text(type, v.write)},
                                 {"meaning", v.meaning},
                                 {"section", v.section}});
  }
  for (const auto& s : type.states) {
    json["states"].push_back({{"name", s.name},
                              {"retention", retention_text(s.retention)},
                              {"meaning", s.meaning},
                              {"section", s.section}});
  }
  for (const auto& c : type.commands) {
    json["commands"].push_back({{"name", c.name},
                                {"condition", condition_text(type, c.condition)},
                                {"meaning", c.meaning},
                                {"section", c.section}});
  }
  for (const auto& alias : type.aliases) json["aliases"][std::string(alias.spelling)] = alias.name;
  return json;
}

void print_device(const devices::DeviceType& type) {
  fmt::print("{}: {}\n", type.name, type.summary);
  std::string record = std::string(type.name);
  for (const auto& field : type.fields) record += fmt::format(" {}", field.name);
  fmt::print("\nINTDEVICE record: <name> {}\n", record);
  TextTable variables(
      {"variable", "size", "range", "unit", "access", "power-up", "write condition", "meaning"});
  for (const auto& v : type.variables) {
    variables.add({variable_name(v), std::string(1, static_cast<char>(v.size)),
                   v.min == 0 && v.max == 0 ? "" : fmt::format("{:.10g}..{:.10g}", v.min, v.max),
                   std::string(v.unit), std::string(access_text(v.access)),
                   std::string(retention_text(v.retention)), condition_text(type, v.write),
                   std::string(v.meaning)});
  }
  variables.print("Parameters and variables");
  TextTable commands({"command", "condition", "meaning"});
  for (const auto& c : type.commands)
    commands.add({std::string(c.name), condition_text(type, c.condition), std::string(c.meaning)});
  commands.print("Commands, in order of priority");
  TextTable states({"state", "power-up", "meaning"});
  for (const auto& s : type.states)
    states.add({std::string(s.name), std::string(retention_text(s.retention)), std::string(s.meaning)});
  states.print("States");
}

// Plants.

/// A plant of the type with its defaults, built, to ask it what it offers; plants that it needs are built
/// too.
struct Specimen {
  plants::World world{1};
  std::vector<std::unique_ptr<plants::PlantDefinition>> definitions;
  std::vector<std::unique_ptr<plants::Plant>> plants;
  std::vector<std::string> names;

  plants::Plant* build(const plants::PlantType& type, const std::string& name) {
    definitions.push_back(type.define());
    auto* definition = definitions.back().get();
    for (auto& parameter : definition->parameters()) {
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

std::string_view plug_text(const plants::Port& port) {
  constexpr std::string_view names[] = {"encoder (to a counter)", "signal (to an input or interrupt line)",
                                        "command (from an output)", "reference (from an analogue output)",
                                        "pulse train (from a pulse output)"};
  return names[port.plug.index()];
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

ordered_json plant_json(const plants::PlantType& type) {
  ordered_json json = {{"name", type.name}, {"summary", type.summary}};
  Specimen specimen;
  auto* plant = specimen.build(type, "it");
  for (const auto& p : specimen.definitions.front()->parameters()) {
    json["parameters"].push_back({{"name", p.name},
                                  {"default", value_text(p)},
                                  {"unit", p.unit},
                                  {"range", range_text(p)},
                                  {"meaning", p.meaning},
                                  {"source", p.source}});
  }
  for (const auto& p : plant->ports())
    json["ports"].push_back({{"name", p.name}, {"kind", plug_text(p)}, {"meaning", p.meaning}});
  for (const auto& c : plant->channels())
    json["channels"].push_back({{"name", c.name}, {"unit", c.unit}, {"meaning", c.meaning}});
  for (const auto& s : plant->settings())
    json["settings"].push_back({{"name", s.name}, {"unit", s.unit}, {"meaning", s.meaning}});
  for (const auto& f : plant->faults())
    json["faults"].push_back(
        {{"component", f.component}, {"name", f.name}, {"unit", f.unit}, {"meaning", f.meaning}});
  for (const auto& e : plant->event_types()) {
    ordered_json values = ordered_json::array();
    for (const auto& v : e.values) values.push_back({{"name", v.name}, {"unit", v.unit}});
    json["events"].push_back({{"name", e.name}, {"values", values}, {"meaning", e.meaning}});
  }
  return json;
}

void print_plant(const plants::PlantType& type) {
  fmt::print("{}: {}\n", type.name, type.summary);
  Specimen specimen;
  auto* plant = specimen.build(type, "it");
  TextTable parameters({"parameter", "default", "range", "meaning", "from"});
  for (const auto& p : specimen.definitions.front()->parameters()) {
    auto range = range_text(p);
    if (!p.unit.empty() && !range.empty()) range += fmt::format(" {}", p.unit);
    parameters.add({p.name, value_text(p), range, std::string(p.meaning), std::string(p.source)});
  }
  parameters.print("Parameters");
  TextTable ports({"plug", "kind", "meaning"});
  for (const auto& p : plant->ports()) ports.add({p.name, std::string(plug_text(p)), p.meaning});
  ports.print("Plugs, for wiring");
  TextTable channels({"channel", "unit", "meaning"});
  for (const auto& c : plant->channels()) channels.add({c.name, c.unit, c.meaning});
  channels.print("Channels, for record, checks and plots");
  TextTable settings({"setting", "unit", "meaning"});
  for (const auto& s : plant->settings()) settings.add({s.name, std::string(s.unit), s.meaning});
  settings.print("Settings, for the timeline");
  TextTable faults({"component", "fault", "unit", "meaning"});
  for (const auto& f : plant->faults()) faults.add({f.component, f.name, std::string(f.unit), f.meaning});
  faults.print("Faults, for the timeline");
  TextTable events({"event", "values", "meaning"});
  for (const auto& e : plant->event_types()) {
    std::string values;
    for (const auto& v : e.values)
      values += fmt::format("{}{}{}", values.empty() ? "" : ", ", v.name,
                            v.unit.empty() ? "" : fmt::format(" [{}]", v.unit));
    events.add({std::string(e.name), values, std::string(e.meaning)});
  }
  events.print("Events, for checks");
}

bool same_name(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

}  // namespace

int list_devices(const std::string& name, bool json) {
  std::vector<std::string> names;
  ordered_json all = ordered_json::array();
  for (const auto& entry : devices::catalogue()) {
    const auto& type = *entry.type;
    names.emplace_back(type.name);
    if (name.empty() && json) all.push_back(device_json(type));
    if (name.empty() && !json) fmt::print("{:<14} {}\n", type.name, type.summary);
    if (!name.empty() && same_name(type.name, name)) {
      if (json) {
        fmt::print("{}\n", device_json(type).dump(2));
      } else {
        print_device(type);
      }
      return all_passed;
    }
  }
  for (const auto& table : lx3vp_tables()) {
    names.emplace_back(table.name);
    if (name.empty() && json) all.push_back(table.json());
    if (name.empty() && !json) fmt::print("{:<14} {}\n", table.name, table.summary);
    if (!name.empty() && same_name(table.name, name)) {
      if (json)
        fmt::print("{}\n", table.json().dump(2));
      else
        table.print();
      return all_passed;
    }
  }
  if (!name.empty()) return unknown("device", name, names);
  if (json) fmt::print("{}\n", all.dump(2));
  return all_passed;
}

int list_plants(const std::string& name, bool json) {
  std::vector<std::string> names;
  ordered_json all = ordered_json::array();
  for (const auto& type : plants::plant_types()) {
    names.emplace_back(type.name);
    if (name.empty() && json) all.push_back(plant_json(type));
    if (name.empty() && !json) fmt::print("{:<14} {}\n", type.name, type.summary);
    if (!name.empty() && same_name(type.name, name)) {
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
