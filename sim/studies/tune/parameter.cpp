#include "sim/studies/tune/parameter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <variant>

#include "base/text.hpp"
#include "plants/plant.hpp"
#include "sim/loop/controller_loader.hpp"
#include "sim/loop/overwritten.hpp"
#include "sim/scenario/units.hpp"

namespace drycut::sim::studies {

namespace {

constexpr std::string_view integer_suffix = ":integer";

class VaryReader {
 public:
  VaryReader(const std::string& text, const std::string& option, Problems& problems)
      : text_(text), option_(option), problems_(problems) {}

  std::optional<TunedParameter> run(bool relative) {
    const auto equals = text_.find('=');
    if (equals == std::string::npos || equals == 0) {
      return refuse("study.argument"_code, 0, fmt::format("'{}' gives no range to a path", text_),
                    "write PATH=LO..HI, such as controller.qmove.set.AxisX.pgain=1..100");
    }
    TunedParameter made;
    made.option = option_;
    made.path = trimmed(std::string_view(text_).substr(0, equals));
    std::string_view range = std::string_view(text_).substr(equals + 1);
    if (range.ends_with(integer_suffix)) {
      made.integer = true;
      range.remove_suffix(integer_suffix.size());
    }
    if (relative && range.find("..") == std::string_view::npos) return percent(made, range, equals + 1);
    return bounds(made, range, equals + 1, relative);
  }

 private:
  std::nullopt_t refuse(Code code, std::size_t offset, std::string what, std::string remedy) {
    problems_.push_back({code, option_, 1, static_cast<int>(offset) + 1, std::move(what), std::move(remedy)});
    return std::nullopt;
  }

  std::optional<TunedParameter> percent(TunedParameter made, std::string_view range, std::size_t offset) {
    auto rest = trimmed(range);
    for (const std::string_view sign : {"±", "+/-", "+-"}) {
      if (!rest.starts_with(sign)) continue;
      rest.remove_prefix(sign.size());
      break;
    }
    const bool is_percent = rest.ends_with('%');
    if (is_percent) rest.remove_suffix(1);
    const auto number = scenario::parse_quantity(rest);
    if (!is_percent || !number || !number->unit.empty() || !(number->number > 0) ||
        !std::isfinite(number->number)) {
      return refuse("study.argument"_code, offset, fmt::format("'{}' is no spread", range),
                    "write ±30% or LO..HI");
    }
    made.relative = number->number / 100;
    made.low_column = made.high_column = static_cast<int>(offset) + 1;
    return made;
  }

  std::optional<TunedParameter> bounds(TunedParameter made, std::string_view range, std::size_t offset,
                                       bool relative) {
    const auto dots = range.find("..");
    if (dots == std::string_view::npos) {
      return refuse("study.argument"_code, offset, fmt::format("'{}' is no range", range),
                    relative ? "write ±30% or LO..HI" : "write LO..HI, such as 1..100 or 100..400 rad/s");
    }
    const auto high_at = offset + dots + 2;
    const auto low = scenario::parse_quantity(trimmed(range.substr(0, dots)));
    const auto high = scenario::parse_quantity(trimmed(range.substr(dots + 2)));
    if (!low || !std::isfinite(low->number))
      return refuse("study.argument"_code, offset, fmt::format("'{}' is no number", range.substr(0, dots)),
                    "such as 1 or 0.5");
    if (!high || !std::isfinite(high->number))
      return refuse("study.argument"_code, high_at, fmt::format("'{}' is no number", range.substr(dots + 2)),
                    "such as 100 or 400 rad/s");
    made.unit = high->unit.empty() ? low->unit : high->unit;
    if (!low->unit.empty() && low->unit != made.unit)
      return refuse("study.wrong-unit"_code, offset,
                    fmt::format("the ends are in {} and {}", low->unit, made.unit),
                    "give both ends in one unit");
    if (!(low->number < high->number))
      return refuse("study.argument"_code, offset, fmt::format("the range {} is empty", range),
                    "the lower end comes first");
    const bool whole = low->number == std::rint(low->number) && high->number == std::rint(high->number);
    if (made.integer && !whole)
      return refuse("study.argument"_code, offset, fmt::format("{} does not end at whole numbers", range),
                    "it is an integer");
    made.low = low->number;
    made.high = high->number;
    made.low_column = static_cast<int>(offset) + 1;
    made.high_column = static_cast<int>(high_at) + 1;
    return made;
  }

  const std::string& text_;
  const std::string& option_;
  Problems& problems_;
};

/// What the scenario sets before power-up; nullptr without a controller.
const std::vector<std::pair<scenario::Text, double>>* preset_of(const scenario::Scenario& scenario) {
  return scenario.controller ? &scenario.controller->set : nullptr;
}

/// A controller just loaded and one of its values, which lives as long; no value if it has none of that name.
struct StartValue {
  std::unique_ptr<devices::Controller> controller;
  std::optional<devices::ControllerValue> value;
};
StartValue value_at_start(const scenario::Scenario& scenario, const std::string& name) {
  Problems ignored;  // the scenario's own problems have been told
  StartValue start{loop::load_controller(scenario, ignored), {}};
  if (start.controller) start.value = start.controller->find(name);
  return start;
}

/// The row of a plant's table that a path names, and the value it holds, in SI.
struct PlantValue {
  plants::Parameter row;
  double si = 0;
  bool integer = false;
};
std::optional<PlantValue> plant_value(const std::string& path, const scenario::Scenario& scenario) {
  for (const auto& plant : scenario.plants) {
    const auto prefix = "plants." + plant.name.text + ".";
    if (!path.starts_with(prefix)) continue;
    for (const auto& row : plant.definition->parameters()) {
      if (row.name != path.substr(prefix.size())) continue;
      if (const auto* number = std::get_if<double*>(&row.value)) return PlantValue{row, **number, false};
      if (const auto* number = std::get_if<int*>(&row.value))
        return PlantValue{row, scenario::to_si(static_cast<double>(**number), row.unit), true};
    }
  }
  return {};
}

/// The variable that a path names, in the parameter's unit or, if it has none, in its own.
std::optional<double> variable_value(TunedParameter& parameter, const scenario::Scenario& scenario) {
  for (const auto& variable : scenario.variables) {
    if (parameter.path != "variables." + variable.name.text) continue;
    const auto quantity = scenario::parse_quantity(variable.value.text);
    if (!quantity || !scenario::is_unit(quantity->unit)) return {};
    if (parameter.unit.empty()) parameter.unit = quantity->unit;
    if (!scenario::is_unit(parameter.unit) || !scenario::same_dimension(parameter.unit, quantity->unit))
      return {};
    return scenario::from_si(scenario::to_si(quantity->number, quantity->unit), parameter.unit);
  }
  return {};
}

}  // namespace

std::optional<TunedParameter> parse_parameter(const std::string& text, const std::string& option,
                                              bool relative, Problems& problems) {
  return VaryReader(text, option, problems).run(relative);
}

std::string value_text(const TunedParameter& parameter, double value) {
  return parameter.unit.empty() ? fmt::format("{}", value) : fmt::format("{} {}", value, parameter.unit);
}

const std::string& shown_unit(const TunedParameter& parameter) {
  return parameter.unit.empty() ? parameter.own_unit : parameter.unit;
}

std::string shown_value(const TunedParameter& parameter, double value) {
  const auto& unit = parameter.unit;
  return fmt::format("{:.6g}{}{}", value, unit.empty() ? "" : " ", unit);
}

std::string shown_range(const TunedParameter& parameter) {
  return fmt::format("{:.6g}..{}", parameter.low, shown_value(parameter, parameter.high));
}

std::string shown_heading(const TunedParameter& parameter) {
  const auto& unit = shown_unit(parameter);
  return unit.empty() ? short_name(parameter) : fmt::format("{} [{}]", short_name(parameter), unit);
}

std::vector<scenario::Override> overrides_of(const TunedParameters& parameters, const Point& point) {
  std::vector<scenario::Override> overrides;
  for (std::size_t i = 0; i < parameters.size(); ++i)
    overrides.push_back({parameters[i].path, value_text(parameters[i], point[i])});
  return overrides;
}

std::optional<PresetName> preset_name(const std::string& path) {
  for (const auto& kind : scenario::controller_kinds()) {
    const auto prefix = fmt::format("controller.{}.set.", kind.name);
    if (path.starts_with(prefix)) return PresetName{std::string(kind.name), path.substr(prefix.size())};
  }
  return {};
}

std::string short_name(const TunedParameter& parameter) {
  if (const auto preset = preset_name(parameter.path)) return preset->value;
  constexpr std::string_view plants = "plants.";
  return parameter.path.starts_with(plants) ? parameter.path.substr(plants.size()) : parameter.path;
}

std::optional<double> present_value(TunedParameter& parameter, const scenario::Scenario& scenario) {
  if (const auto found = plant_value(parameter.path, scenario)) {
    if (found->integer) parameter.integer = true;
    if (parameter.unit.empty()) parameter.unit = found->row.unit;
    if (!scenario::is_unit(parameter.unit) || !scenario::same_dimension(parameter.unit, found->row.unit))
      return {};
    return scenario::from_si(found->si, parameter.unit);
  }
  if (const auto found = variable_value(parameter, scenario)) return found;
  const auto preset = preset_name(parameter.path);
  const auto* values = preset ? preset_of(scenario) : nullptr;
  if (values == nullptr) return {};
  for (const auto& [name, number] : *values)
    if (name.text == preset->value) return number;
  if (preset->section != "plcopen") return {};
  // An axis parameter has a value at the start that no program gives it.
  const auto start = value_at_start(scenario, preset->value);
  return start.value ? std::optional(start.value->read()) : std::nullopt;
}

void check_against_controller(TunedParameter& parameter, const scenario::Scenario& scenario,
                              Problems& problems) {
  const auto preset = preset_name(parameter.path);
  if (!preset) return;
  const auto [controller, value] = value_at_start(scenario, preset->value);
  if (value) parameter.own_unit = value->unit;
  if (!value || !value->write || !value->range) return;
  parameter.integer = parameter.integer || value->range->whole;
  for (const bool upper : {false, true}) {
    const auto fault = value->misfit(upper ? parameter.high : parameter.low);
    const int column = upper ? parameter.high_column : parameter.low_column;
    if (fault) problems.push_back({fault->code, parameter.option, 1, column, fault->what, fault->remedy});
  }
}

void refuse_overwritten(const TunedParameter& parameter, const std::string& low, const std::string& high,
                        const std::function<scenario::Scenario(const std::string& value)>& scenario_with,
                        Problems& problems) {
  const auto preset = preset_name(parameter.path);
  if (!preset) return;
  for (const auto& value : {low, high}) {
    const auto told = loop::overwritten(scenario_with(value), preset->value);
    if (!told) continue;
    problems.push_back({"controller.value-overwritten"_code, parameter.option, 1, 1, told->text,
                        "take that line out of the program, or let it write only where the value is 0"});
    return;
  }
}

Point from_unit(const TunedParameters& parameters, const std::vector<double>& unit) {
  Point point;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const auto& p = parameters[i];
    const double x = p.low + std::clamp(unit[i], 0.0, 1.0) * (p.high - p.low);
    point.push_back(p.integer ? std::rint(x) : std::clamp(x, p.low, p.high));
  }
  return point;
}

std::vector<double> to_unit(const TunedParameters& parameters, const Point& point) {
  std::vector<double> unit;
  for (std::size_t i = 0; i < parameters.size(); ++i)
    unit.push_back((point[i] - parameters[i].low) / (parameters[i].high - parameters[i].low));
  return unit;
}

std::vector<Point> latin_hypercube(const TunedParameters& parameters, int count, plants::Random random) {
  const auto n = static_cast<std::size_t>(count);
  std::vector<std::vector<double>> units(n, std::vector<double>(parameters.size()));
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    std::vector<std::size_t> parts(n);
    std::iota(parts.begin(), parts.end(), 0);
    // Not std::shuffle: it is not the same in every library.
    for (std::size_t k = n; k > 1; --k)
      std::swap(parts[k - 1], parts[static_cast<std::size_t>(random.uniform() * static_cast<double>(k))]);
    for (std::size_t k = 0; k < n; ++k)
      units[k][i] = (static_cast<double>(parts[k]) + random.uniform()) / static_cast<double>(n);
  }
  std::vector<Point> points;
  points.reserve(n);
  for (const auto& unit : units) points.push_back(from_unit(parameters, unit));
  return points;
}

}  // namespace drycut::sim::studies
