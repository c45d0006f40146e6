#include "sim/studies/sweep/study.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
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
        {parameter.option, 1, parameter.high_column,
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

/// A value that cannot be set is a row that says so; an axis of which no end can be set is a mistake.
void try_ends(const SweepAxis& axis, const PointQuestion& question, Problems& problems) {
  const auto& parameter = axis.parameter;
  const auto first = axis.is_range() ? number_text(parameter.low) : axis.values.front();
  const auto last = axis.is_range() ? number_text(parameter.high) : axis.values.back();
  auto told = objections(axis, first, question);
  if (told.empty() || objections(axis, last, question).empty()) return;
  for (auto& problem : told) {
    problem.what = fmt::format("{}: {}", parameter.path, problem.what);
    problem.file = parameter.option;
    problem.line = 1;
    problem.column = parameter.low_column;
    problems.push_back(std::move(problem));
  }
}

}  // namespace

void check_axes(SweepAxes& axes, const PointQuestion& question, Problems& problems) {
  Problems told;  // by prepare()
  const auto scenario = scenario::read_scenario_text(question.text, question.file, question.set, told);
  for (auto axis = axes.begin(); axis != axes.end(); ++axis) {
    auto& parameter = axis->parameter;
    const auto same = [&](const SweepAxis& other) { return other.parameter.path == parameter.path; };
    if (std::any_of(axes.begin(), axis, same)) {
      problems.push_back({parameter.option, 1, 1, parameter.path + " is given twice", "keep one"});
      continue;
    }
    const auto before = problems.size();
    present_value(parameter, scenario);
    if (has_own_dimension(parameter, scenario, problems)) try_ends(*axis, question, problems);
    if (problems.size() == before) fill_axis(*axis, problems);
  }
}

std::vector<SweepPoint> points_of(const SweepAxes& axes, std::optional<std::size_t> sampled,
                                  Problems& problems) {
  if (sampled) return sobol(axes, *sampled);
  if (grid_size(axes, most_points)) return grid(axes);
  std::vector<std::string> counts;
  double size = 1;
  for (const auto& axis : axes) {
    const auto count = axis.steps ? static_cast<std::size_t>(*axis.steps) : axis.values.size();
    counts.push_back(fmt::format("{}", count));
    size *= static_cast<double>(count);
  }
  problems.push_back({axes.front().parameter.option, 1, 1,
                      fmt::format("{} are {:.3g} points", fmt::join(counts, " x "), size),
                      fmt::format("at most {}: fewer values an axis, or --sample sobol:1000", most_points)});
  return {};
}

std::vector<PointRow> sweep(const PointQuestion& question, const SweepAxes& axes,
                            const std::vector<SweepPoint>& points, PointStore& store,
                            const StudyProgress& progress) {
  std::vector<std::vector<scenario::Override>> asked;
  asked.reserve(points.size());
  for (const auto& point : points) asked.push_back(overrides_of(axes, point));
  return store.rows(question, asked, progress);
}

std::string csv_heading(const PointQuestion& question, const SweepAxes& axes, const std::string& between) {
  std::string line;
  for (const auto& axis : axes) line += csv_cell(heading(axis.parameter)) + ",";
  line += between;
  for (const auto& column : question.columns) line += "," + csv_cell(column);
  return line + "\n";
}

std::string sweep_csv(const PointQuestion& question, const SweepAxes& axes,
                      const std::vector<SweepPoint>& points, const std::vector<PointRow>& rows) {
  auto text = csv_heading(question, axes, "verdict,limit");
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (const auto& value : points[i]) text += value + ",";
    text += row_text(rows[i]) + "\n";
  }
  return text;
}

}  // namespace drycut::sim::studies
