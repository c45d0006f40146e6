#include "sim/studies/tune/present.hpp"

#include <algorithm>

#include "sim/scenario/archive.hpp"
#include "sim/scenario/extends.hpp"
#include "sim/scenario/units.hpp"

namespace drycut::sim::studies {

namespace {

/// The value that a path names in a scenario's tree, names with dots as nested maps; nullptr if there is
/// none.
const scenario::YamlNode* scalar_at(const scenario::YamlNode& tree, std::string_view path) {
  if (path.empty()) return tree.kind == scenario::YamlNode::Kind::scalar ? &tree : nullptr;
  for (const auto& entry : tree.entries) {
    const auto& key = entry.key.text;
    if (!path.starts_with(key)) continue;
    const bool whole = path.size() == key.size();
    if (!whole && path[key.size()] != '.') continue;
    if (const auto* found = scalar_at(entry.value, whole ? "" : path.substr(key.size() + 1))) return found;
  }
  return nullptr;
}

bool is_written(const std::string& path, const Study::Case& entry) {
  scenario::Findings ignored({entry.file.string()});
  return scalar_at(scenario::read_tree(entry.text, entry.file, ignored), path) != nullptr;
}

/// Any other value, as the scenario with all its defaults has it, in the parameter's unit or, if it has none,
/// in its own.
std::optional<double> expanded_value(TunedParameter& parameter, const scenario::Scenario& scenario) {
  scenario::Findings ignored({"expanded"});
  const auto tree = scenario::parse_yaml(scenario::expand(scenario), 0, ignored);
  const auto* found = scalar_at(tree, parameter.path);
  const auto quantity = found != nullptr ? scenario::parse_quantity(found->text.text) : std::nullopt;
  if (!quantity || !scenario::is_unit(quantity->unit)) return {};
  if (parameter.unit.empty() && scenario::needs_unit(quantity->unit)) parameter.unit = quantity->unit;
  if (!scenario::is_unit(parameter.unit) || !scenario::same_dimension(parameter.unit, quantity->unit))
    return {};
  if (parameter.unit == quantity->unit) return quantity->number;
  return scenario::from_si(scenario::to_si(quantity->number, quantity->unit), parameter.unit);
}

std::string setter_of(const std::string& path, const Study& study, const Study::Case& entry, bool known) {
  const bool overridden = std::any_of(study.set.begin(), study.set.end(),
                                      [&](const scenario::Override& given) { return given.path == path; });
  if (overridden) return "--set";
  if (!known) return "program";
  // A value of an axis by its manual's name may stand in the axis' own section.
  const auto preset = preset_name(path);
  const bool in_axes =
      preset && preset->section == "plcopen" && is_written("controller.plcopen.axes." + preset->value, entry);
  return in_axes || is_written(path, entry) ? "scenario" : "default";
}

}  // namespace

PresentValue present_of(TunedParameter& parameter, const Study& study, const Study::Case& entry,
                        const scenario::Scenario& scenario) {
  auto value = present_value(parameter, scenario);
  if (!value && !preset_name(parameter.path)) value = expanded_value(parameter, scenario);
  return {value, setter_of(parameter.path, study, entry, value.has_value())};
}

std::optional<Point> set_by_program(const Study& study, const TunedParameters& parameters,
                                    const std::vector<PresentValue>& present) {
  const auto& entry = study.cases.front();
  Problems problems;
  const auto scenario = scenario::read_scenario_text(entry.text, entry.file, study.set, problems);
  loop::Simulation simulation(scenario, problems);
  if (!problems.empty()) return {};
  simulation.keep_nothing();
  simulation.run();
  Point point;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const auto preset = preset_name(parameters[i].path);
    const auto reading = preset ? simulation.names().reading(preset->value) : std::nullopt;
    if (!present[i].value && !reading) return {};
    point.push_back(present[i].value ? *present[i].value : reading->read());
  }
  return point;
}

}  // namespace drycut::sim::studies
