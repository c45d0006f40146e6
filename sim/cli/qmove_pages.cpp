// `drycut devices` for the QMOVE: its devices and its language.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "base/json.hpp"
#include "base/text.hpp"
#include "devices/device.hpp"
#include "devices/qmove/catalogue.hpp"
#include "devices/qmove/language.hpp"
#include "devices/qmove/machine.hpp"
#include "sim/cli/pages.hpp"

namespace drycut::sim::cli {

namespace {

std::string condition_text(const devices::DeviceType& type, const devices::Condition& condition) {
  std::vector<std::string> needed;
  for (std::size_t i = 0; i < type.states.size(); ++i)
    if (condition.mask >> i & 1)
      needed.push_back(fmt::format("{} = {}", type.states[i].name, condition.value >> i & 1));
  if (!condition.also.empty()) needed.emplace_back(condition.also);
  return listed(needed);
}

std::string_view retention_text(devices::Retention retention) {
  if (retention == devices::Retention::retentive) return "retentive";
  return retention == devices::Retention::zero ? "0" : "1";
}

std::string_view access_text(devices::Access access) {
  return access == devices::Access::read ? "read" : "read/write";
}

/// The reading of a row, nullptr if the manual says all of it.
const devices::ManualReading* reading_of(const devices::DeviceType& type, std::string_view row) {
  const auto found = std::ranges::find(type.readings, row, &devices::ManualReading::of);
  return found == type.readings.end() ? nullptr : &*found;
}

/// In text a mark: the reading stands below the tables.
Sheet::Cell reading_cell(const devices::DeviceType& type, std::string_view row) {
  const auto* reading = reading_of(type, row);
  if (reading == nullptr) return nullptr;
  return Json{{"text", reading->text}, {"manual", reading->manual}};
}

Sheet::Cell meaning_cell(const devices::DeviceType& type, std::string_view row, std::string_view meaning) {
  return {meaning, fmt::format("{}{}", meaning, reading_of(type, row) ? " (*)" : "")};
}

Sheet fields_of(const devices::DeviceType& type) {
  Sheet sheet("fields", "", {"name", "meaning"});
  for (const auto& field : type.fields) sheet.add({field.name, field.meaning});
  return sheet;
}

Sheet variables_of(const devices::DeviceType& type) {
  Sheet sheet("variables", "Parameters and variables",
              {"name=variable", "rows=", "size", "min=", "max=", "=range", "unit", "access",
               "retention=power-up", "condition=write condition", "meaning", "section=", "reading="});
  for (const auto& v : type.variables)
    sheet.add({{v.name, v.rows > 1 ? fmt::format("{}1..{}", v.name, v.rows) : std::string(v.name)},
               v.rows,
               std::string(1, static_cast<char>(v.size)),
               v.min,
               v.max,
               v.min == 0 && v.max == 0 ? "" : fmt::format("{:.10g}..{:.10g}", v.min, v.max),
               v.unit,
               access_text(v.access),
               retention_text(v.retention),
               condition_text(type, v.write),
               meaning_cell(type, v.name, v.meaning),
               v.section,
               reading_cell(type, v.name)});
  return sheet;
}

Sheet states_of(const devices::DeviceType& type, const std::string& key, const std::string& title) {
  Sheet sheet(key, title, {"name=state", "retention=power-up", "meaning", "section=", "reading="});
  for (const auto& s : type.states)
    sheet.add({s.name, retention_text(s.retention), meaning_cell(type, s.name, s.meaning), s.section,
               reading_cell(type, s.name)});
  return sheet;
}

Sheet commands_of(const devices::DeviceType& type) {
  Sheet sheet("commands", "Commands, in order of priority",
              {"name=command", "condition", "meaning", "section=", "reading="});
  for (const auto& c : type.commands)
    sheet.add({c.name, condition_text(type, c.condition), meaning_cell(type, c.name, c.meaning), c.section,
               reading_cell(type, c.name)});
  return sheet;
}

/// In JSON those of the whole device; the others stand with their rows there.
Sheet readings_of(const devices::DeviceType& type) {
  Sheet sheet("readings", "(*) Readings of ours, where the manual leaves it open",
              {"=of", "text=reading", "manual"});
  for (const auto& [of, text, manual] : type.readings) {
    if (of.empty())
      sheet.add({of, text, manual});
    else
      sheet.add({of, {nullptr, std::string(text)}, {nullptr, std::string(manual)}});
  }
  return sheet;
}

Page device_page(const devices::DeviceType& type) {
  Page page{std::string(type.name),
            std::string(type.summary),
            fmt::format("INTDEVICE record: <name> {}", type.name),
            // JSON has the states before the commands, text behind them.
            {fields_of(type), variables_of(type), states_of(type, "states", ""), commands_of(type),
             states_of(type, "", "States")}};
  if (type.name == "CAMMING4") std::ranges::move(camming4_sheets(), std::back_inserter(page.sheets));
  page.sheets.push_back(readings_of(type));
  for (const auto& field : type.fields) page.preamble += fmt::format(" {}", field.name);
  for (const auto& alias : type.aliases) page.aliases[std::string(alias.spelling)] = alias.name;
  return page;
}

template <std::size_t count>
Sheet rows_of(const std::string& key, const std::string& title,
              const std::array<devices::qmove::QclRow, count>& rows) {
  Sheet sheet(key, title, {"form", "meaning", "reading=reading of ours, where the manuals leave it open"});
  for (const auto& [form, meaning, reading] : rows)
    sheet.add({form, meaning, reading.empty() ? Sheet::Cell(nullptr) : Sheet::Cell(reading)});
  return sheet;
}

Page language_page() {
  using devices::qmove::RunTimeError;
  Sheet errors("errors", "Run-time errors: all tasks stop, the run tells the line",
               {"number=error", "meaning"});
  for (const auto error :
       {RunTimeError::index_out_of_bound, RunTimeError::recipe_out_of_range, RunTimeError::step_out_of_range,
        RunTimeError::division_by_zero, RunTimeError::watchdog, RunTimeError::stack})
    errors.add({static_cast<int>(error), name_of(error)});
  return {"QMOVE",
          "QEM QMOVE: the language QCL of its tasks and their schedule",
          "",
          {rows_of("language", "QCL", devices::qmove::language), errors}};
}

Page configuration_page() {
  return {"CNF",
          "QEM QMOVE: the configuration file that goes into the controller with the tasks",
          "A section's name stands alone on its line, its entries below; ';' begins a remark.",
          {rows_of("sections", "Sections", devices::qmove::configuration_sections),
           rows_of("words", "Words of an entry", devices::qmove::configuration_words)}};
}

}  // namespace

std::vector<Page> qmove_pages() {
  std::vector<Page> pages;
  for (const auto& entry : devices::catalogue()) pages.push_back(device_page(*entry.type));
  pages.push_back(language_page());
  pages.push_back(configuration_page());
  return pages;
}

}  // namespace drycut::sim::cli
