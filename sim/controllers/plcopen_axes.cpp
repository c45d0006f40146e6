// controller: plcopen: axes: the parameters of an axis, in units for people.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "sim/controllers/kinds.hpp"
#include "sim/scenario/archive.hpp"
#include "sim/scenario/axis_units.hpp"
#include "sim/scenario/units.hpp"

namespace drycut::sim::controllers {

namespace plcopen = devices::plcopen;
using plcopen::AxisParameter;
using plcopen::AxisParameters;
using plcopen::Measure;

namespace {

// Takes the parameters of one axis, and finds out from their units what it measures.
class AxisUnits {
 public:
  explicit AxisUnits(AxisParameters& parameters) : parameters_(parameters) {}

  /// Nothing if no unit says it.
  [[nodiscard]] std::optional<Measure> measure() const {
    return measured_by_ ? std::optional(measure_) : std::nullopt;
  }
  /// Who writes units means one everywhere: what the bare numbers beside them come to.
  [[nodiscard]] std::vector<Finding> bare_numbers(const std::string& axis,
                                                  const scenario::Findings& findings) const {
    std::vector<Finding> notes;
    if (!measured_by_) return notes;
    for (const auto& [parameter, text] : bare_) {
      const auto& place = text.place;
      notes.emplace_back(
          "controller.bare-number"_code,
          fmt::format("{}:{}:{}: {}.{} is {} without a unit, in {}: {}; write {} {} if that is meant",
                      findings.sources().at(static_cast<std::size_t>(place.source)), place.line, place.column,
                      axis, parameter->name, text.text, parameter->unit,
                      scenario::axis_value_text(*parameter, parameters_, measure_), text.text,
                      scenario::axis_unit(*parameter, measure_).unit));
    }
    return notes;
  }

  // A bare number is in the kernel's own unit.
  void assign(const AxisParameter& parameter, const scenario::Text& text, const std::string& full,
              scenario::Findings& findings) {
    if (parameter.is_switch() && !scenario::parse_quantity(text.text)) {
      if (const auto on = scenario::read_switch(text, full, findings))
        plcopen::set_parameter(parameters_, parameter, *on ? 1 : 0);
      return;
    }
    const auto quantity = scenario::read_quantity(text, full, findings);
    if (!quantity) return;
    scenario::AxisUnit people;
    double value = quantity->number;
    if (!quantity->unit.empty()) {
      const auto unit = unit_for(parameter, *quantity, text, full, findings);
      if (!unit) return;
      people = *unit;
      value = scenario::to_kernel(quantity->number, quantity->unit, people);
    } else if (value != 0 && !scenario::axis_unit(parameter, Measure::length).unit.empty()) {
      bare_.emplace_back(&parameter, text);
    }
    if (plcopen::set_parameter(parameters_, parameter, value)) return;
    const bool in_range = value >= parameter.min && value <= parameter.max;
    const auto limit = [&](double number) {
      return fmt::format("{:.12g}{}{}", number / people.factor, people.unit.empty() ? "" : " ", people.unit);
    };
    findings.add("controller.axis-value"_code, text.place,
                 in_range ? fmt::format("{} is {}, not a whole number of {}", full, text.text,
                                        parameter.unit.empty() ? "ones" : parameter.unit)
                          : fmt::format("{} is {}, out of range", full, text.text),
                 fmt::format("{} to {}", limit(parameter.min), limit(parameter.max)));
  }

 private:
  // The unit in which people give the parameter; nullopt if `quantity` is of another dimension. An axis
  // measures lengths or angles, not both.
  std::optional<scenario::AxisUnit> unit_for(const AxisParameter& parameter,
                                             const scenario::Quantity& quantity, const scenario::Text& text,
                                             const std::string& full, scenario::Findings& findings) {
    const scenario::AxisUnit length = scenario::axis_unit(parameter, Measure::length);
    const scenario::AxisUnit angle = scenario::axis_unit(parameter, Measure::angle);
    const auto place = text.at(scenario::parse_quantity(text.text)->unit_offset);
    const bool is_length = !length.unit.empty() && scenario::same_dimension(quantity.unit, length.unit);
    const bool is_angle = !angle.unit.empty() && scenario::same_dimension(quantity.unit, angle.unit);
    if (!is_length && !is_angle) {
      const auto wanted = length.unit.empty() ? std::string("a pure number")
                          : length.unit == angle.unit
                              ? scenario::dimension_name(length.unit)
                              : fmt::format("{} or {}", scenario::dimension_name(length.unit),
                                            scenario::dimension_name(angle.unit));
      findings.add("controller.axis-value"_code, place,
                   fmt::format("{} is {}, not {} ({})", full, wanted, scenario::dimension_name(quantity.unit),
                               quantity.unit),
                   length.unit.empty() ? std::string("write a number without unit")
                   : length.unit == angle.unit
                       ? fmt::format("for example 1 {}", length.unit)
                       : fmt::format("for example 1 {} or 1 {}", length.unit, angle.unit));
      return {};
    }
    if (length.unit == angle.unit) return length;
    const Measure measure = is_length ? Measure::length : Measure::angle;
    if (measured_by_ && measure != measure_) {
      findings.add("controller.axis-value"_code, place,
                   fmt::format("{} is {}, but {} is {}", full, scenario::dimension_name(quantity.unit),
                               *measured_by_, measured_unit_),
                   "an axis measures lengths or angles: give all its quantities in one of them");
      return {};
    }
    if (!measured_by_) {
      measured_by_ = parameter.name;
      measured_unit_ = scenario::dimension_name(quantity.unit);
    }
    measure_ = measure;
    return is_length ? length : angle;
  }

  AxisParameters& parameters_;
  Measure measure_ = Measure::angle;
  std::optional<std::string> measured_by_;  ///< the parameter whose unit tells it
  std::string measured_unit_;
  std::vector<std::pair<const AxisParameter*, scenario::Text>> bare_;
};

scenario::Form parameter_form(const AxisParameter& parameter, plcopen::AxisConfiguration& axis,
                              const std::shared_ptr<AxisUnits>& units) {
  if (parameter.is(&AxisParameters::kind))
    return scenario::choice_form(scenario::axis_kinds(), axis.parameters.kind);
  auto made = scenario::single(
      [&parameter, units](const scenario::Text& text, const std::string& name, scenario::Findings& findings) {
        units->assign(parameter, text, name, findings);
      },
      [&parameter, &axis] { return scenario::axis_value_text(parameter, axis.parameters, axis.measure); },
      "");
  made.schema = [&parameter] {
    return std::string(parameter.is_switch()
                           ? R"({"enum": [0, 1, true, false, "on", "off", "true", "false"]})"
                           : scenario::number_schema);
  };
  return made;
}

// path: [500 mm, 10000], the way of so many counts.
scenario::ParameterTable::Row path_row(const std::shared_ptr<AxisUnits>& units) {
  const auto& way = *plcopen::find_axis_parameter("path_increments");
  const auto& counts = *plcopen::find_axis_parameter("path_counts");
  const auto read = [&way, &counts, units](const scenario::YamlNode& node, const scenario::Form::Name& name,
                                           scenario::Findings& findings) {
    const auto& items = node.items;
    const bool pair = node.kind == scenario::YamlNode::Kind::sequence && items.size() == 2 &&
                      items[0].kind == scenario::YamlNode::Kind::scalar &&
                      items[1].kind == scenario::YamlNode::Kind::scalar;
    if (!pair) {
      findings.add("controller.axis-value"_code, node.text.place,
                   fmt::format("{} is not a way and its counts", name.full),
                   "write [500 mm, 10000]: the way of so many counts (x4) of the encoder");
      return;
    }
    units->assign(way, items[0].text, name.full, findings);
    units->assign(counts, items[1].text, name.full, findings);
  };
  return {"path",
          [] { return "the way of so many counts (x4) of the encoder: [500 mm, 10000]"; },
          {read, {}, [] { return std::string(scenario::pair_schema); }},
          {std::string(way.name), std::string(counts.name)}};
}

bool is_given(const PlcopenSection::Axis& axis, std::string_view parameter) {
  return std::any_of(axis.places.begin(), axis.places.end(),
                     [&](const auto& place) { return place.first == parameter; });
}

// Equal limits are none.
void judge_software_limits(scenario::MapReader& reader, const PlcopenSection::Axis& axis) {
  const auto& parameters = axis.configuration.parameters;
  if (parameters.swe_neg <= parameters.swe_pos) return;
  const auto& low = *plcopen::find_axis_parameter("kenngr.swe_neg");
  const auto& high = *plcopen::find_axis_parameter("kenngr.swe_pos");
  // One of them has been given: the defaults are equal.
  const auto place = std::find_if(axis.places.begin(), axis.places.end(), [&](const auto& given) {
    return given.first == low.name || given.first == high.name;
  });
  reader.findings().add("controller.axis-value"_code, place->second,
                        fmt::format("{}: {} {} is above {} {}", reader.name(), low.name,
                                    scenario::axis_value_text(low, parameters, Measure::length), high.name,
                                    scenario::axis_value_text(high, parameters, Measure::length)),
                        "give the lower limit as kenngr.swe_neg; equal limits are none");
}

std::string described(const AxisParameter& parameter) {
  const auto people = scenario::axis_unit(parameter, Measure::length).unit;
  return fmt::format("{}{}; a bare number{}; default {}", parameter.meaning,
                     people.empty() ? "" : fmt::format(" [{}]", people),
                     parameter.unit.empty() ? "" : fmt::format(" is in {}", parameter.unit),
                     scenario::axis_value_text(parameter, {}, Measure::angle));
}

}  // namespace

void visit(scenario::Archive& archive, PlcopenSection::Axis& axis) {
  auto& configuration = axis.configuration;
  const auto units = std::make_shared<AxisUnits>(configuration.parameters);
  scenario::ParameterTable table;
  table.help = "'drycut devices AXIS' lists the parameters";
  table.nested = false;
  table.places = &axis.places;
  table.at_value = false;
  table.rows.push_back(path_row(units));
  for (const auto& parameter : plcopen::axis_parameter_table())
    table.rows.push_back({std::string(parameter.name), [&parameter] { return described(parameter); },
                          parameter_form(parameter, configuration, units)});
  archive.table(table);
  if (archive.reads()) configuration.name = axis.name.text;
  archive.judge([&axis, units](scenario::MapReader& reader) {
    auto& [name, parameters, measure] = axis.configuration;
    if (reader.is_sound()) judge_software_limits(reader, axis);
    axis.notes = units->bare_numbers(axis.name.text, reader.findings());
    // A virtual axis has no zero to look for, unless the scenario wants it to be homed by the program.
    if (!is_given(axis, "homed_at_start") && parameters.kind == plcopen::AxisKind::virtual_axis)
      parameters.homed_at_start = true;
    if (units->measure())
      measure = *units->measure();
    else if (parameters.modulo == 0)
      measure = Measure::length;  // no unit says it: a linear axis
  });
}

}  // namespace drycut::sim::controllers
