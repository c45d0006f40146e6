// `drycut plants --motors`.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "base/text.hpp"
#include "sim/cli/commands.hpp"
#include "sim/cli/pages.hpp"
#include "sim/scenario/motor_catalogue.hpp"
#include "sim/scenario/units.hpp"

namespace drycut::sim::cli {

namespace {

std::string title_of(std::string_view kind) {
  return kind == scenario::motor_kinds[0] ? "Servo motors, for servo: {model: ...}"
                                          : "Induction motors, for induction_motor: {model: ...}";
}

// What the short table shows, where a motor of the kind has it.
constexpr std::string_view told[] = {
    "rated_power",        "rated_torque",      "stall_torque",      "peak_torque",          "pullout_torque",
    "rated_speed",        "max_speed",         "rotor_inertia",     "torque_constant",      "rated_current",
    "winding_resistance", "stator_resistance", "amplifier_current", "largest_inertia_ratio"};

// "9.55 N m" in two: number and unit.
std::pair<std::string, std::string> split(const std::string& shown) {
  const auto space = shown.find(' ');
  return space == std::string::npos ? std::pair(shown, std::string())
                                    : std::pair(shown.substr(0, space), shown.substr(space + 1));
}

// A value from a sheet in other units has all digits of a double.
std::string short_number(const std::string& number) {
  constexpr std::size_t readable = 8;
  const auto quantity = scenario::parse_quantity(number);
  return quantity && number.size() > readable ? fmt::format("{:.6g}", quantity->number) : number;
}

std::string heading(const std::string& parameter, const std::string& shown) {
  auto words = parameter;
  std::replace(words.begin(), words.end(), '_', ' ');
  const auto unit = split(shown).second;
  return unit.empty() ? words : fmt::format("{} [{}]", words, unit);
}

Sheet table_of(const std::vector<scenario::MotorModel>& motors, std::string_view kind) {
  std::vector<std::string> columns = {"model"};
  std::vector<std::string_view> parameters;
  for (const auto& parameter : told) {
    const auto has = std::find_if(motors.begin(), motors.end(), [&](const auto& motor) {
      return motor.kind == kind && motor.find(parameter) != nullptr;
    });
    if (has == motors.end()) continue;
    parameters.push_back(parameter);
    columns.push_back(heading(std::string(parameter), has->find(parameter)->shown));
  }
  columns.insert(columns.end(), {"values", "vendor", "series"});
  Sheet sheet(std::string(kind), title_of(kind), columns);
  for (const auto& motor : motors) {
    if (motor.kind != kind) continue;
    std::vector<Sheet::Cell> row = {motor.name.text};
    for (const auto& parameter : parameters) {
      const auto* const value = motor.find(parameter);
      row.emplace_back(value == nullptr
                           ? std::string()
                           : (value->is_estimate() ? "~" : "") + short_number(split(value->shown).first));
    }
    row.insert(row.end(), {motor.standing(), motor.vendor, motor.series});
    sheet.add(std::move(row));
  }
  return sheet;
}

std::vector<Sheet> tables_of(const std::vector<scenario::MotorModel>& motors) {
  std::vector<Sheet> tables;
  for (const auto kind : scenario::motor_kinds) tables.push_back(table_of(motors, kind));
  return tables;
}

Page page_of(const scenario::MotorModel& motor) {
  auto kind = motor.kind;
  std::replace(kind.begin(), kind.end(), '_', ' ');
  Sheet values("values", fmt::format("Values, for {}: {{model: {}}}", motor.kind, motor.name.text),
               {"name=parameter", "value", "source=from"});
  for (const auto& value : motor.values) {
    const auto [number, unit] = split(value.shown);
    values.add({value.parameter, short_number(number) + (unit.empty() ? "" : " " + unit), value.from});
  }
  return {motor.name.text,
          fmt::format("{}, {} {}; values {}", kind, motor.vendor, motor.series, motor.standing()),
          "",
          {values}};
}

}  // namespace

int print_motor_template(const std::string& kind) {
  const auto& kinds = scenario::motor_kinds;
  const auto found = std::find(std::begin(kinds), std::end(kinds), kind.empty() ? kinds[0] : kind);
  if (found == std::end(kinds)) {
    fmt::print(stderr,
               "drycut plants --motor-template: there is no kind of motor '{}'; {} [option.unknown-choice]\n",
               kind,
               did_you_mean(kind, {kinds[0].data(), kinds[1].data()},
                            fmt::format("there are: {}, {}", kinds[0], kinds[1])));
    return bad_input;
  }
  fmt::print("{}", scenario::motor_template(*found));
  return all_passed;
}

std::vector<Sheet> motor_tables() { return tables_of(scenario::shipped_motors()); }

int list_motors(const std::string& name, bool json) {
  scenario::Findings findings({});
  const auto motors = read_motors({}, findings);
  if (!findings.empty()) {
    print_problems(findings.sorted());
    return bad_input;
  }
  std::vector<Page> pages;
  pages.reserve(motors.size());
  for (const auto& motor : motors) pages.push_back(page_of(motor));
  return show({"drycut plants --motors", "motor"}, pages, name, json, tables_of(motors));
}

}  // namespace drycut::sim::cli
