#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/text.hpp"
#include "devices/catalogue.hpp"
#include "devices/device.hpp"
#include "sim/commands/commands.hpp"
#include "sim/commands/controller_table.hpp"
#include "sim/commands/table_names.hpp"
#include "sim/commands/text_table.hpp"

namespace drycut::sim {

namespace {

using nlohmann::ordered_json;

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

// The reading of a row, nullptr if the manual says all of it.
const devices::Reading* reading_of(const devices::DeviceType& type, std::string_view row) {
  const auto found = std::ranges::find(type.readings, row, &devices::Reading::of);
  return found == type.readings.end() ? nullptr : &*found;
}

ordered_json reading_json(const devices::Reading& reading) {
  return {{"text", reading.text}, {"manual", reading.manual}};
}

void add_reading(ordered_json& row, const devices::DeviceType& type) {
  if (const auto* reading = reading_of(type, row["name"].get<std::string>()))
    row["reading"] = reading_json(*reading);
}

// Marks what a reading below the tables is about.
std::string marked(const devices::DeviceType& type, std::string_view row, std::string_view meaning) {
  return fmt::format("{}{}", meaning, reading_of(type, row) ? " (*)" : "");
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
    add_reading(json["variables"].back(), type);
  }
  for (const auto& s : type.states) {
    json["states"].push_back({{"name", s.name},
                              {"retention", retention_text(s.retention)},
                              {"meaning", s.meaning},
                              {"section", s.section}});
    add_reading(json["states"].back(), type);
  }
  for (const auto& c : type.commands) {
    json["commands"].push_back({{"name", c.name},
                                {"condition", condition_text(type, c.condition)},
                                {"meaning", c.meaning},
                                {"section", c.section}});
    add_reading(json["commands"].back(), type);
  }
  for (const auto& reading : type.readings)
    if (reading.of.empty()) json["readings"].push_back(reading_json(reading));
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
                   marked(type, v.name, v.meaning)});
  }
  variables.print("Parameters and variables");
  TextTable commands({"command", "condition", "meaning"});
  for (const auto& c : type.commands)
    commands.add({std::string(c.name), condition_text(type, c.condition), marked(type, c.name, c.meaning)});
  commands.print("Commands, in order of priority");
  TextTable states({"state", "power-up", "meaning"});
  for (const auto& s : type.states)
    states.add(
        {std::string(s.name), std::string(retention_text(s.retention)), marked(type, s.name, s.meaning)});
  states.print("States");
  TextTable readings({"of", "reading", "manual"});
  for (const auto& r : type.readings)
    readings.add({std::string(r.of), std::string(r.text), std::string(r.manual)});
  readings.print("(*) Readings of ours, where the manual leaves it open");
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
    if (!name.empty() && same_word(type.name, name)) {
      if (json) {
        fmt::print("{}\n", device_json(type).dump(2));
      } else {
        print_device(type);
      }
      return all_passed;
    }
  }
  auto tables = qmove_tables();
  for (auto& table : plcopen_tables()) tables.push_back(std::move(table));
  for (auto& table : lx3vp_tables()) tables.push_back(std::move(table));
  for (const auto& table : tables) {
    names.emplace_back(table.name);
    if (name.empty() && json) all.push_back(table.json());
    if (name.empty() && !json && table.listed) fmt::print("{:<14} {}\n", table.name, table.summary);
    if (!name.empty() && same_word(table.name, name)) {
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

}  // namespace drycut::sim
