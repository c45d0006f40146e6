// `drycut devices` for the PLCopen controller.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "base/text.hpp"
#include "devices/plcopen/axis.hpp"
#include "devices/plcopen/errors.hpp"
#include "devices/plcopen/kernel.hpp"
#include "devices/plcopen/pins.hpp"
#include "devices/plcopen/readings.hpp"
#include "devices/plcopen/st/dialect.hpp"
#include "devices/plcopen/st/language.hpp"
#include "devices/plcopen/terminals.hpp"
#include "sim/cli/pages.hpp"
#include "sim/scenario/axis_units.hpp"

namespace drycut::sim::cli {

namespace {

namespace plcopen = devices::plcopen;
using plcopen::Measure;

/// "mm or deg", "us", "": of an axis that moves along, and of one that turns.
std::string either(std::string_view length, std::string_view angle) {
  return length == angle ? std::string(length) : fmt::format("{} or {}", length, angle);
}

/// By what people write.
std::string people_unit(const plcopen::AxisParameter& parameter) {
  return either(scenario::axis_unit(parameter, Measure::length).unit,
                scenario::axis_unit(parameter, Measure::angle).unit);
}

std::string value_unit(const plcopen::AxisValue& value) {
  return either(unit_of(value.quantity, Measure::length), unit_of(value.quantity, Measure::angle));
}

std::string default_text(const plcopen::AxisParameter& parameter) {
  return scenario::axis_value_text(parameter, {}, Measure::angle);
}

std::string range_text(const plcopen::AxisParameter& parameter) {
  if (parameter.is(&plcopen::AxisParameters::kind)) return "drive | virtual | encoder";
  return fmt::format("{:.10g}..{:.10g}", parameter.min, parameter.max);
}

std::string offered_by(const plcopen::AxisTerminal& terminal) {
  std::vector<std::string> kinds;
  for (const auto kind :
       {plcopen::AxisKind::drive, plcopen::AxisKind::virtual_axis, plcopen::AxisKind::encoder})
    if (terminal.offered_by(kind)) kinds.emplace_back(scenario::axis_kind_text(kind));
  return listed(kinds);
}

std::string_view direction_text(plcopen::PinDirection direction) {
  if (direction == plcopen::PinDirection::in_out) return "in_out";
  return direction == plcopen::PinDirection::input ? "input" : "output";
}

/// The readings that are about one of `names`; all of them if there are none.
Sheet readings_about(const std::vector<std::string_view>& names) {
  Sheet sheet("readings", "Readings of ours, where the documents leave it open",
              {"of", "reading", "manual=left open by"});
  for (const auto& [of, text, manual] : plcopen::readings)
    if (names.empty() || std::ranges::find(names, of) != names.end()) sheet.add({of, text, manual});
  return sheet;
}

Page axis_page() {
  Sheet parameters("parameters",
                   "Parameters, for controller.plcopen.axes; as values (Knife.kv) in the kernel's unit",
                   {"name=parameter", "default", "unit=write in", "kernel_unit=kernel's unit",
                    "min=", "max=", "=range there", "whole=", "number", "meaning"});
  std::vector<std::string_view> names;
  for (const auto& row : plcopen::axis_parameter_table()) {
    parameters.add({row.name, default_text(row), people_unit(row), row.unit, row.min, row.max,
                    range_text(row), row.whole, row.number, row.meaning});
    names.push_back(row.name);
  }
  Sheet values("values", "Values, for record, checks and timeline",
               {"name=value", "unit", "access", "meaning"});
  for (const auto& row : plcopen::axis_value_table())
    values.add({row.name, value_unit(row), row.write == nullptr ? "read" : "read/write", row.meaning});
  Sheet terminals("terminals", "Terminals, for wiring", {"name=terminal", "kind", "axes=of axes", "meaning"});
  for (const auto& row : plcopen::axis_terminal_table())
    terminals.add({row.name, name_of(row.kind), offered_by(row), row.meaning});
  return {"AXIS",
          "axis of the PLCopen controller: parameters, values, terminals",
          "A bare number is in the kernel's unit; with a unit (1.2 m/s, 360 deg, 50 ms) it is "
          "converted.\npath: [500 mm, 10000] gives path_increments and path_counts together.",
          {parameters, values, terminals, readings_about(names)}};
}

Page plcopen_page() {
  Sheet blocks("blocks", "Function blocks; 'drycut devices MC_CamIn' lists pins", {"name=block", "meaning"});
  for (const auto& type : plcopen::block_types()) blocks.add({type.name, type.meaning});
  Sheet modes("start_modes", "StartMode of MC_CamIn", {"name=start mode", "bit", "meaning"});
  for (const auto& mode : plcopen::start_mode_table)
    modes.add({mode.name, {mode.bit, fmt::format("16#{:02X}", mode.bit)}, mode.meaning});
  Sheet parameters("parameters", "Parameters of MC_ReadParameter and MC_WriteParameter, by PLCopen's numbers",
                   {"number", "name=parameter", "unit", "access", "meaning"});
  for (const auto& row : plcopen::numbered_parameters())
    parameters.add(
        {row.number, row.name, row.unit, row.written == nullptr ? "read" : "read/write", row.meaning});
  Sheet errors("errors", "Errors", {"id=error", "meaning"});
  for (const auto& row : plcopen::error_table) errors.add({static_cast<std::uint32_t>(row.id), row.meaning});
  return {"PLCOPEN",
          "PLCopen motion controller: function blocks, start modes, errors",
          "",
          {blocks, modes, parameters, errors, readings_about({})}};
}

template <std::size_t count>
Sheet rows_of(const std::string& key, const std::string& title,
              const std::array<plcopen::st::StRow, count>& rows) {
  Sheet sheet(key, title, {"form", "meaning"});
  for (const auto& [form, meaning] : rows) sheet.add({form, meaning});
  return sheet;
}

Sheet dialects_sheet() {
  Sheet sheet("dialects", "Where IEC 61131-3 and CODESYS differ: controller.plcopen.dialect",
              {"of", "iec", "codesys"});
  for (const auto& [of, iec, codesys] : plcopen::st::differences) sheet.add({of, iec, codesys});
  return sheet;
}

Page structured_text_page() {
  return {"ST",
          "Structured Text of IEC 61131-3, as the PLCopen controller takes it",
          "Names and words in any case. (* a remark *), // to the end of the line.",
          {rows_of("types", "Types", plcopen::st::types),
           rows_of("declarations", "Units and variables", plcopen::st::declarations),
           rows_of("statements", "Statements and operators", plcopen::st::statements),
           rows_of("functions", "Standard functions", plcopen::st::standard_functions),
           rows_of("blocks", "Standard blocks; those of motion are PLCOPEN's",
                   plcopen::st::standard_function_blocks),
           dialects_sheet(), readings_about({"ST"})}};
}

Page block_page(const plcopen::BlockType& type) {
  Sheet pins("pins", "Pins", {"name=pin", "type", "direction", "meaning"});
  for (const auto& pin : type.pins)
    pins.add({pin.name, pin.type, direction_text(pin.direction), pin.meaning});
  Page page{std::string(type.name), std::string(type.meaning), "", {pins, readings_about({type.name})}};
  page.listed = false;
  return page;
}

}  // namespace

std::vector<Page> plcopen_pages() {
  std::vector<Page> pages = {plcopen_page(), axis_page(), structured_text_page()};
  for (const auto& type : plcopen::block_types()) pages.push_back(block_page(type));
  return pages;
}

}  // namespace drycut::sim::cli
