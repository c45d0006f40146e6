#include "sim/scenario/variable_slips.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "sim/scenario/archive.hpp"
#include "sim/scenario/units.hpp"

namespace drycut::sim::scenario {

namespace {

/// What a variable may measure, with the units that people write for small and for large numbers.
struct TriedUnit {
  std::string_view small;
  std::string_view large;
};
constexpr std::array<TriedUnit, 14> tried_units = {{{"m", "mm"},
                                                    {"m/s", "m/min"},
                                                    {"s", "ms"},
                                                    {"deg", "deg"},
                                                    {"kg", "kg"},
                                                    {"N", "N"},
                                                    {"N m", "N m"},
                                                    {"rpm", "rpm"},
                                                    {"m/s^2", "m/s^2"},
                                                    {"kg m^2", "kg m^2"},
                                                    {"1/s", "1/s"},
                                                    {"V", "V"},
                                                    {"", ""},
                                                    {"%", "%"}}};

/// Another value, and what would be wrong with the present one if that is right.
struct SlipCandidate {
  std::string value;
  std::string what;
};

std::string written(double number, std::string_view unit) {
  return fmt::format("{:.15g}{}{}", number, unit.empty() ? "" : " ", unit);
}

std::vector<SlipCandidate> candidates_for(const ParsedQuantity& present) {
  const auto& [number, unit, offset] = present;
  const auto is = written(number, unit);
  std::vector<SlipCandidate> candidates;
  if (number < 0) candidates.push_back({written(-number, unit), fmt::format("is {}, below 0", is)});
  if (number == 0)
    for (const double other : {1, 100})
      candidates.push_back({written(other, unit), fmt::format("is {}, and more is needed", is)});
  if (unit.empty() && number != std::round(number))
    candidates.push_back(
        {written(std::round(number), unit), fmt::format("is {}, and a whole number is needed", is)});
  const auto kind = needs_unit(unit) ? fmt::format("is {} ({})", dimension_name(unit), is)
                                     : fmt::format("is {}, without a unit", is);
  for (const auto& [small, large] : tried_units)
    for (const auto other : {small, large})
      if (needs_unit(unit) && other != unit && same_dimension(other, unit))
        candidates.push_back({written(number, other), fmt::format("is {}, which is out of range", is)});
  for (const auto& [small, large] : tried_units) {
    const auto other = std::abs(number) < 10 ? small : large;
    if (needs_unit(other) ? same_dimension(other, unit) && needs_unit(unit) : !needs_unit(unit)) continue;
    candidates.push_back({written(number, other),
                          fmt::format("{}; it is used as {}", kind,
                                      other.empty() ? "a number without unit" : dimension_name(other))});
  }
  return candidates;
}

auto place_of(const auto& of) { return std::tie(of.file, of.line, of.column); }

bool stands_in(const Problem& problem, const auto& places) {
  return std::any_of(places.begin(), places.end(),
                     [&](const auto& other) { return place_of(other) == place_of(problem); });
}

// Where a variable that was given anew stands: what is wrong there is the new value's own.
std::vector<NamedAt> places_given_anew(const Scenario& scenario) {
  std::vector<NamedAt> places;
  for (const auto& variable : scenario.variables)
    if (variable.given_anew) places.push_back(named_at(scenario, variable.value.place));
  return places;
}

// Whether one of the problems is in a line that uses the variable, or in a table, where uses are not known.
bool may_be_to_blame(const VariableEntry& variable, const Scenario& scenario, const Problems& problems) {
  return std::any_of(problems.begin(), problems.end(), [&](const Problem& problem) {
    const auto source = std::find(scenario.sources.begin(), scenario.sources.end(), problem.file);
    if (source == scenario.sources.end()) return true;
    return std::any_of(variable.uses.begin(), variable.uses.end(), [&](const ScenePlace& use) {
      return use.line == problem.line && use.source == source - scenario.sources.begin();
    });
  });
}

// "39:41, 93:71 and 2 more"
std::string places_text(const Problems& problems, const std::string& file) {
  constexpr std::size_t shown = 3;
  std::vector<std::string> places;
  for (const auto& problem : problems) {
    auto place = fmt::format("{}:{}", problem.line, problem.column);
    if (problem.file != file) place = fmt::format("{}:{}", problem.file, place);
    if (std::find(places.begin(), places.end(), place) == places.end()) places.push_back(std::move(place));
  }
  const auto more = places.size() > shown ? places.size() - shown : 0;
  places.resize(places.size() - more);
  return fmt::format("{}{}", fmt::join(places, ", "), more == 0 ? "" : fmt::format(" and {} more", more));
}

// In order of place among those of its file.
void insert(Problems& problems, std::size_t first, Problem problem) {
  const auto behind = std::find_if(
      problems.begin() + static_cast<std::ptrdiff_t>(first), problems.end(), [&](const Problem& other) {
        return other.file == problem.file &&
               std::tie(other.line, other.column) > std::tie(problem.line, problem.column);
      });
  problems.insert(behind, std::move(problem));
}

}  // namespace

void put_on_trial(YamlNode& root, const Trial& trial) {
  for (auto& section : root.entries) {
    if (section.key.text != "variables") continue;
    for (auto& entry : section.value.entries)
      if (entry.key.text == trial.variable)
        entry.value = YamlNode(YamlNode::Kind::scalar, {trial.value, entry.value.text.place});
  }
}

void blame_variables(const Scenario& scenario, Problems& problems, std::size_t first,
                     const std::function<Problems(const Trial&)>& again) {
  if (scenario.on_trial) return;
  const auto anew = places_given_anew(scenario);
  const auto is_its_own = [&](const Problem& problem) { return stands_in(problem, anew); };
  for (const auto& variable : scenario.variables) {
    Problems told(problems.begin() + static_cast<std::ptrdiff_t>(first), problems.end());
    std::erase_if(told, is_its_own);
    const auto present = parse_quantity(variable.value.text);
    if (told.empty()) return;
    if (!present || !is_unit(present->unit) || !may_be_to_blame(variable, scenario, told)) continue;
    auto least = told;
    SlipCandidate best;
    for (auto& candidate : candidates_for(*present)) {
      auto left = again({variable.name.text, candidate.value});
      std::erase_if(left, is_its_own);
      // It has to take some away and to bring none.
      const bool brings_none = std::all_of(left.begin(), left.end(),
                                           [&](const Problem& problem) { return stands_in(problem, told); });
      if (!brings_none || left.size() >= least.size()) continue;
      least = std::move(left);
      best = std::move(candidate);
    }
    if (best.value.empty()) continue;
    Problems gone;
    for (const auto& problem : told)
      if (!stands_in(problem, least)) gone.push_back(problem);
    if (gone.empty()) continue;
    const auto place = named_at(scenario, variable.value.place);
    std::erase_if(problems, [&](const Problem& problem) { return stands_in(problem, gone); });
    insert(problems, std::min(first, problems.size()),
           problem_at("scenario.variable-value"_code, scenario, variable.value.place,
                      fmt::format("variables.{} {} (at {})", variable.name.text, best.what,
                                  places_text(gone, place.file)),
                      fmt::format("write {}", best.value)));
  }
}

}  // namespace drycut::sim::scenario
