#include "sim/studies/sweep/study.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/text.hpp"
#include "sim/scenario/units.hpp"

namespace drycut::sim::studies {

namespace {

/// The variable's own dimension, which every unit of it must have.
bool has_own_dimension(const TunedParameter& parameter, const scenario::Scenario& scenario,
                       Problems& problems) {
  for (const auto& variable : scenario.variables) {
    if (parameter.path != "variables." + variable.name.text) continue;
    const auto present = scenario::parse_quantity(variable.value.text);
    if (!present || !scenario::is_unit(present->unit) || !scenario::is_unit(parameter.unit) ||
        scenario::same_dimension(present->unit, parameter.unit))
      continue;
    problems.push_back(
        {"study.wrong-unit"_code, parameter.option, 1, parameter.high_column,
         fmt::format("{} is {}, not {}", parameter.path, scenario::dimension_name(present->unit),
                     parameter.unit.empty() ? "a pure number" : scenario::dimension_name(parameter.unit)),
         fmt::format("its value is {}", variable.value.text)});
    return false;
  }
  return true;
}

/// What a scenario with this one value says against it.
Problems objections(const SweepAxis& axis, const std::string& value, const PointQuestion& question) {
  auto point = read_point(question, overrides_of({axis}, {value}));
  if (point.problems.empty()) const loop::Simulation probe(point.scenario, point.problems);
  return point.problems;
}

/// Every value that the scenario has, by its path, as far as it can be gone over.
std::vector<std::string> known_paths(const scenario::Scenario& scenario) {
  std::vector<std::string> paths;
  for (const auto& variable : scenario.variables) paths.push_back("variables." + variable.name.text);
  for (const auto& plant : scenario.plants)
    for (const auto& row : plant.definition->parameters())
      paths.push_back(fmt::format("plants.{}.{}", plant.name.text, row.name));
  if (scenario.controller)
    for (const auto& [name, number] : scenario.controller->set)
      paths.push_back(fmt::format("controller.{}.set.{}", scenario.controller->kind(), name.text));
  return paths;
}

/// A path begins with a section of the scenario: length is none, where there is a variables.length.
bool begins_with_section(const TunedParameter& parameter, const scenario::Scenario& scenario,
                         Problems& problems) {
  constexpr std::array sections = {"variables", "scene",        "plants", "controller", "wiring", "filters",
                                   "timeline",  "disturbances", "inputs", "record",     "drives", "checks"};
  const auto first = parameter.path.substr(0, parameter.path.find('.'));
  if (std::find(sections.begin(), sections.end(), first) != sections.end()) return true;
  problems.push_back({"study.unknown-name"_code, parameter.option, 1, 1,
                      fmt::format("the scenario has no {}", in_quotes(parameter.path)),
                      did_you_mean(parameter.path, known_paths(scenario),
                                   fmt::format("a path begins with {}", fmt::join(sections, ", ")))});
  return false;
}

/// A word that the scenario does not take is a slip; every one is tried.
void try_words(const SweepAxis& axis, const PointQuestion& question, Problems& problems) {
  for (std::size_t i = 0; i < axis.word_columns.size(); ++i) {
    const auto told = objections(axis, axis.values[i], question);
    if (told.empty()) continue;
    const auto path = with_check_names(question, axis.parameter.path);
    problems.push_back(
        {"study.out-of-range"_code, axis.parameter.option, 1, axis.word_columns[i],
         fmt::format("{} cannot be {}: {}", path, in_quotes(axis.values[i]), told.front().what),
         told.front().remedy});
  }
}

/// A number that cannot be set is a row that says so; an axis of which no end can be set is a mistake.
void try_ends(const SweepAxis& axis, const PointQuestion& question, Problems& problems) {
  if (!axis.word_columns.empty()) return try_words(axis, question, problems);
  const auto& parameter = axis.parameter;
  const auto first = axis.is_range() ? number_text(parameter.low) : axis.values.front();
  const auto last = axis.is_range() ? number_text(parameter.high) : axis.values.back();
  auto told = objections(axis, first, question);
  if (told.empty() || objections(axis, last, question).empty()) return;
  for (auto& problem : told) {
    if (problem.what.find(parameter.path) == std::string::npos)
      problem.what = fmt::format("{}: {}", parameter.path, problem.what);
    problem.what = with_check_names(question, problem.what);
    problem.file = parameter.option;
    problem.line = 1;
    problem.column = parameter.low_column;
    problems.push_back(std::move(problem));
  }
}

/// A sweep over values that the program overwrites would be so many equal runs. A program may leave a value
/// alone only where another one is given: each is tried with the others.
void refuse_without_effect(const SweepAxes& axes, const PointQuestion& question, Problems& problems) {
  SweepPoint first;
  for (const auto& axis : axes)
    first.push_back(axis.is_range() ? number_text(axis.parameter.low) : axis.values.front());
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const auto& parameter = axes[i].parameter;
    refuse_overwritten(
        parameter, first[i], axes[i].is_range() ? number_text(parameter.high) : axes[i].values.back(),
        [&](const std::string& value) {
          auto point = first;
          point[i] = value;
          return read_point(question, overrides_of(axes, point)).scenario;
        },
        problems);
  }
}

/// Nobody should have to know in which unit a number without one is read.
bool says_its_unit(const SweepAxis& axis, const scenario::Scenario& scenario, Problems& problems) {
  auto known = axis.parameter;
  present_value(known, scenario);
  if (!axis.parameter.unit.empty() || known.unit.empty()) return true;
  const auto kind = scenario::dimension_name(known.unit);
  const auto first = axis.is_range() ? number_text(known.low) : axis.values.front();
  if (!axis.is_range() && !scenario::parse_quantity(first))
    problems.push_back({"study.wrong-unit"_code, known.option, 1, known.low_column,
                        fmt::format("{} is {}, not '{}'", known.path, kind, first),
                        fmt::format("numbers, and behind the last the unit: 1,2 {}", known.unit)});
  else
    problems.push_back({"study.wrong-unit"_code, known.option, 1, known.low_column,
                        fmt::format("{} is {}, and no unit is given", known.path, kind),
                        axis.is_range()
                            ? fmt::format("such as {}..{} {}{}", first, number_text(known.high), known.unit,
                                          axis.steps ? fmt::format(":{}", *axis.steps) : "")
                            : fmt::format("such as {} {}", first, known.unit)});
  return false;
}

void check_axes(SweepAxes& axes, const PointQuestion& question, Problems& problems) {
  Problems told;  // by prepare()
  const auto scenario = scenario::read_scenario_text(question.text, question.file, question.set, told);
  for (auto axis = axes.begin(); axis != axes.end(); ++axis) {
    auto& parameter = axis->parameter;
    const auto same = [&](const SweepAxis& other) { return other.parameter.path == parameter.path; };
    if (std::any_of(axes.begin(), axis, same)) {
      problems.push_back(
          {"study.twice"_code, parameter.option, 1, 1, parameter.path + " is given twice", "keep one"});
      continue;
    }
    if (!begins_with_section(parameter, scenario, problems)) continue;
    if (!says_its_unit(*axis, scenario, problems)) continue;
    const auto before = problems.size();
    present_value(parameter, scenario);
    if (has_own_dimension(parameter, scenario, problems)) try_ends(*axis, question, problems);
    if (problems.size() == before) fill_axis(*axis, problems);
  }
  if (problems.empty()) refuse_without_effect(axes, question, problems);
}

/// Before axes of a million values are made.
void refuse_too_many(const SweepAxes& axes, Problems& problems) {
  if (grid_size(axes, most_points)) return;
  std::vector<std::string> counts;
  double size = 1;
  for (const auto& axis : axes) {
    const auto count = axis.steps ? static_cast<std::size_t>(*axis.steps) : axis.values.size();
    counts.push_back(fmt::format("{}", count));
    size *= static_cast<double>(count);
  }
  problems.push_back({"study.out-of-range"_code, axes.front().parameter.option, 1, 1,
                      fmt::format("{} are {:.3g} points", fmt::join(counts, " x "), size),
                      fmt::format("at most {}: fewer values an axis, or --sample sobol:1000", most_points)});
}

}  // namespace

std::vector<SweepPoint> planned(SweepAxes& axes, std::optional<std::size_t> sampled,
                                const PointQuestion& question, Problems& problems) {
  if (problems.empty() && !sampled) refuse_too_many(axes, problems);
  if (problems.empty()) check_axes(axes, question, problems);
  if (!problems.empty()) return {};
  return sampled ? sobol(axes, *sampled) : grid(axes);
}

std::vector<SweepPoint> planned(Envelope& envelope, Problems& problems) {
  refuse_too_many(envelope.axes, problems);
  if (!problems.empty()) return {};
  auto all = envelope.axes;
  all.push_back({envelope.request.parameter, {}});
  check_axes(all, envelope.question, problems);
  envelope.request.parameter = all.back().parameter;
  all.pop_back();
  envelope.axes = std::move(all);
  return problems.empty() ? grid(envelope.axes) : std::vector<SweepPoint>();
}

std::vector<PointRow> sweep(const PointQuestion& question, const SweepAxes& axes,
                            const std::vector<SweepPoint>& points, PointStore& store,
                            const StudyProgress& progress) {
  std::vector<std::vector<scenario::Override>> asked;
  asked.reserve(points.size());
  for (const auto& point : points) asked.push_back(overrides_of(axes, point));
  return store.rows(question, asked, progress);
}

Table sweep_table(const PointQuestion& question, const SweepAxes& axes, const std::vector<SweepPoint>& points,
                  const std::vector<PointRow>& rows) {
  auto columns = columns_of(axes);
  columns.insert(columns.end(), {{"verdict", "verdict"}, {"limit", "limit"}, {"rating", "rating"}});
  columns.insert(columns.end(), question.columns.begin(), question.columns.end());
  Table table(std::move(columns));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& row = rows[i];
    std::vector<Table::Cell> cells(points[i].begin(), points[i].end());
    cells.emplace_back(std::string(name_of(row.verdict)));
    cells.emplace_back(in_one_line(row.limit));
    cells.emplace_back(row.rating);
    cells.insert(cells.end(), row.numbers.begin(), row.numbers.end());
    table.add(std::move(cells));
  }
  return table;
}

}  // namespace drycut::sim::studies
