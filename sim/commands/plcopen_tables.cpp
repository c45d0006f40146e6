// `drycut devices` for the PLCopen controller.
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "devices/plcopen/axis_values.hpp"
#include "devices/plcopen/errors.hpp"
#include "devices/plcopen/kernel.hpp"
#include "devices/plcopen/numbered_parameters.hpp"
#include "devices/plcopen/pins.hpp"
#include "devices/plcopen/readings.hpp"
#include "devices/plcopen/terminals.hpp"
#include "sim/commands/controller_table.hpp"
#include "sim/commands/text_table.hpp"
#include "sim/scenario/axis_units.hpp"

namespace drycut::sim {

namespace {

namespace plcopen = devices::plcopen;
using nlohmann::ordered_json;
using plcopen::Measure;

constexpr std::string_view plcopen_summary =
    "PLCopen motion controller: function blocks, start modes, errors";
constexpr std::string_view axis_summary = "axis of the PLCopen controller: parameters, values, terminals";

/// "mm or deg", "us", "" by what people write.
std::string people_unit(const plcopen::AxisParameter& parameter) {
  const auto length = axis_unit(parameter, Measure::length).unit;
  const auto angle = axis_unit(parameter, Measure::angle).unit;
  return length == angle ? std::string(length) : fmt::format("{} or {}", length, angle);
}

std::string value_unit(const plcopen::AxisValue& value) {
  const auto length = unit_of(value.quantity, Measure::length);
  const auto angle = unit_of(value.quantity, Measure::angle);
  return length == angle ? std::string(length) : fmt::format("{} or {}", length, angle);
}

std::string default_text(const plcopen::AxisParameter& parameter) {
  return axis_value_text(parameter, plcopen::AxisParameters{}.*parameter.member, Measure::angle);
}

std::string range_text(const plcopen::AxisParameter& parameter) {
  if (parameter.member == &plcopen::AxisParameters::kind) return "drive | virtual | encoder";
  return fmt::format("{:.10g}..{:.10g}", parameter.min, parameter.max);
}

std::string offered_by(const plcopen::AxisTerminal& terminal) {
  std::string text;
  for (const auto kind :
       {plcopen::AxisKind::drive, plcopen::AxisKind::virtual_axis, plcopen::AxisKind::encoder})
    if (terminal.offered_by(kind))
      text += fmt::format("{}{}", text.empty() ? "" : ", ", axis_kind_text(static_cast<double>(kind)));
  return text;
}

std::string_view direction_text(plcopen::PinDirection direction) {
  switch (direction) {
    case plcopen::PinDirection::in_out:
      return "in_out";
    case plcopen::PinDirection::input:
      return "input";
    case plcopen::PinDirection::output:
      return "output";
  }
  return "";
}

template <class Wanted>
void print_readings(Wanted wanted) {
  TextTable table({"of", "reading", "left open by"});
  for (const auto& r : plcopen::readings)
    if (wanted(r)) table.add({std::string(r.of), std::string(r.text), std::string(r.manual)});
  table.print("Readings of ours, where the documents leave it open");
}

template <class Wanted>
void add_readings(ordered_json& json, Wanted wanted) {
  for (const auto& r : plcopen::readings)
    if (wanted(r)) json["readings"].push_back({{"of", r.of}, {"reading", r.text}, {"manual", r.manual}});
}

bool of_axis(const devices::Reading& reading) {
  return std::ranges::any_of(plcopen::axis_parameter_table(),
                             [&](const auto& row) { return row.name == reading.of; });
}
bool any(const devices::Reading&) { return true; }

void print_axis() {
  fmt::print(
      "AXIS: {}\n\nA bare number is in the kernel's unit; with a unit (1.2 m/s, 360 deg, 50 ms) it is "
      "converted.\npath: [500 mm, 10000] gives path_increments and path_counts together.\n",
      axis_summary);
  TextTable parameters(
      {"parameter", "default", "write in", "kernel's unit", "range there", "number", "meaning"});
  for (const auto& row : plcopen::axis_parameter_table())
    parameters.add({std::string(row.name), default_text(row), people_unit(row), std::string(row.unit),
                    range_text(row), std::string(row.number), std::string(row.meaning)});
  parameters.print("Parameters, for controller.plcopen.axes; as values (Knife.kv) in the kernel's unit");
  TextTable values({"value", "unit", "access", "meaning"});
  for (const auto& row : plcopen::axis_value_table())
    values.add({std::string(row.name), value_unit(row), row.write == nullptr ? "read" : "read/write",
                std::string(row.meaning)});
  values.print("Values, for record, checks and timeline");
  TextTable terminals({"terminal", "kind", "of axes", "meaning"});
  for (const auto& row : plcopen::axis_terminal_table())
    terminals.add(
        {std::string(row.name), std::string(name_of(row.kind)), offered_by(row), std::string(row.meaning)});
  terminals.print("Terminals, for wiring");
  print_readings(of_axis);
}

ordered_json axis_json() {
  ordered_json json = {{"name", "AXIS"}, {"summary", axis_summary}};
  for (const auto& row : plcopen::axis_parameter_table())
    json["parameters"].push_back({{"name", row.name},
                                  {"default", default_text(row)},
                                  {"unit", people_unit(row)},
                                  {"kernel_unit", row.unit},
                                  {"min", row.min},
                                  {"max", row.max},
                                  {"whole", row.whole},
                                  {"number", row.number},
                                  {"meaning", row.meaning}});
  for (const auto& row : plcopen::axis_value_table())
    json["values"].push_back({{"name", row.name},
                              {"unit", value_unit(row)},
                              {"access", row.write == nullptr ? "read" : "read/write"},
                              {"meaning", row.meaning}});
  for (const auto& row : plcopen::axis_terminal_table())
    json["terminals"].push_back({{"name", row.name},
                                 {"kind", name_of(row.kind)},
                                 {"axes", offered_by(row)},
                                 {"meaning", row.meaning}});
  add_readings(json, of_axis);
  return json;
}

void print_plcopen() {
  fmt::print("PLCOPEN: {}\n", plcopen_summary);
  TextTable blocks({"block", "meaning"});
  for (const auto& type : plcopen::block_types())
    blocks.add({std::string(type.name), std::string(type.meaning)});
  blocks.print("Function blocks; 'drycut devices MC_CamIn' lists pins");
  TextTable modes({"start mode", "bit", "meaning"});
  for (const auto& mode : plcopen::start_mode_table)
    modes.add({std::string(mode.name), fmt::format("16#{:02X}", mode.bit), std::string(mode.meaning)});
  modes.print("StartMode of MC_CamIn");
  TextTable parameters({"number", "parameter", "unit", "access", "meaning"});
  for (const auto& row : plcopen::numbered_parameters())
    parameters.add({std::to_string(row.number), std::string(row.name), std::string(row.unit),
                    row.written == nullptr ? "read" : "read/write", std::string(row.meaning)});
  parameters.print("Parameters of MC_ReadParameter and MC_WriteParameter, by PLCopen's numbers");
  TextTable errors({"error", "meaning"});
  for (const auto& row : plcopen::error_table)
    errors.add({fmt::format("{}", static_cast<std::uint32_t>(row.id)), std::string(row.meaning)});
  errors.print("Errors");
  print_readings(any);
}

ordered_json plcopen_json() {
  ordered_json json = {{"name", "PLCOPEN"}, {"summary", plcopen_summary}};
  for (const auto& type : plcopen::block_types())
    json["blocks"].push_back({{"name", type.name}, {"meaning", type.meaning}});
  for (const auto& mode : plcopen::start_mode_table)
    json["start_modes"].push_back({{"name", mode.name}, {"bit", mode.bit}, {"meaning", mode.meaning}});
  for (const auto& row : plcopen::numbered_parameters())
    json["parameters"].push_back({{"number", row.number},
                                  {"name", row.name},
                                  {"unit", row.unit},
                                  {"access", row.written == nullptr ? "read" : "read/write"},
                                  {"meaning", row.meaning}});
  for (const auto& row : plcopen::error_table)
    json["errors"].push_back({{"id", static_cast<std::uint32_t>(row.id)}, {"meaning", row.meaning}});
  add_readings(json, any);
  return json;
}

void print_block(const plcopen::BlockType& type) {
  fmt::print("{}: {}\n", type.name, type.meaning);
  TextTable pins({"pin", "type", "direction", "meaning"});
  for (const auto& pin : type.pins)
    pins.add({std::string(pin.name), std::string(pin.type), std::string(direction_text(pin.direction)),
              std::string(pin.meaning)});
  pins.print("Pins");
  print_readings([&](const devices::Reading& reading) { return reading.of == type.name; });
}

ordered_json block_json(const plcopen::BlockType& type) {
  ordered_json json = {{"name", type.name}, {"summary", type.meaning}};
  for (const auto& pin : type.pins)
    json["pins"].push_back({{"name", pin.name},
                            {"type", pin.type},
                            {"direction", direction_text(pin.direction)},
                            {"meaning", pin.meaning}});
  add_readings(json, [&](const devices::Reading& reading) { return reading.of == type.name; });
  return json;
}

}  // namespace

std::vector<ControllerTable> plcopen_tables() {
  std::vector<ControllerTable> tables = {{"PLCOPEN", plcopen_summary, print_plcopen, plcopen_json},
                                         {"AXIS", axis_summary, print_axis, axis_json}};
  for (const auto& type : plcopen::block_types())
    tables.push_back({type.name, type.meaning, [&type] { print_block(type); },
                      [&type] { return block_json(type); }, false});
  return tables;
}

}  // namespace drycut::sim
