#include "sim/studies/tune/plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text.hpp"
#include "renders/decimate.hpp"
#include "sim/report/gallery_plots.hpp"

namespace drycut::sim::studies {

namespace {

std::string with_unit(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : fmt::format("{} [{}]", name, unit);
}

renders::Curve curve_of(const record::Recording& recording, const MetricName& name, Time from,
                        std::string label, std::string& unit) {
  renders::Curve curve;
  curve.label = std::move(label);
  if (!name.event.empty()) {
    auto found = loop::event_numbers(recording.events(), name.event, name.value, seconds(from));
    renders::thin(found.times, found.numbers);
    unit = found.unit;
    curve.style = renders::Curve::Style::points;
    curve.x = std::move(found.times);
    curve.y = std::move(found.numbers);
    return curve;
  }
  const auto* column = recording.column(name.text);
  if (column == nullptr) return curve;
  unit = column->unit;
  auto of_time = report::channel_curve(recording, *column, report::rows_between(recording, from, {}));
  of_time.label = std::move(curve.label);
  return of_time;
}

renders::Plot before_after(const Tuning& tuning, std::size_t index) {
  const auto& entry = tuning.study.cases[index];
  renders::Plot plot;
  const auto stem = entry.file.stem().string();
  plot.name =
      tuning.study.cases.size() == 1 ? "before_after" : fmt::format("before_after_{}_{}", index + 1, stem);
  plot.title = fmt::format("Before and after: {}", stem);
  const auto& times = tuning.runs_before[index].recording;
  plot.x_label = report::time_label(times, report::rows_between(times, tuning.study.from, {}));
  for (const auto& name : names_of(tuning.study, entry)) {
    renders::Panel panel;
    std::string unit;
    for (const bool after : {false, true}) {
      const auto& runs = after ? tuning.runs_after : tuning.runs_before;
      auto curve = curve_of(runs[index].recording, name, tuning.study.from, after ? "after" : "before", unit);
      if (!curve.x.empty()) panel.curves.push_back(std::move(curve));
    }
    panel.title = name.text;
    panel.y_label = with_unit(name.text, unit);
    if (!panel.curves.empty()) plot.panels.push_back(std::move(panel));
  }
  return plot;
}

/// Kept all limits, beyond one, or not known: by their place among the panel's curves green, vermilion and
/// the fourth colour. The first curve, blue, is `line`.
struct TrialPoints {
  renders::Curve kept;
  renders::Curve beyond;
  renders::Curve unknown;

  renders::Curve& of(const Verdict& verdict) {
    const bool measured = std::ranges::none_of(verdict.room, [](double room) { return std::isnan(room); });
    if (verdict.unmeasured() || (verdict.feasible() && !measured)) return unknown;
    return verdict.feasible() ? kept : beyond;
  }
  [[nodiscard]] bool empty() const { return kept.x.empty() && beyond.x.empty() && unknown.x.empty(); }
  void draw(renders::Panel& panel, renders::Curve line) {
    if (line.x.empty()) line.label.clear();  // nothing in the legend
    if (!kept.x.empty()) kept.label = "kept all limits";
    if (!beyond.x.empty()) beyond.label = "beyond a limit";
    if (!unknown.x.empty()) unknown.label = "not all limits measured";
    kept.style = beyond.style = unknown.style = renders::Curve::Style::points;
    panel.curves = {std::move(line), std::move(beyond), std::move(kept), std::move(unknown)};
  }
};

renders::Plot way(const Tuning& tuning) {
  TrialPoints points;
  renders::Curve least{"best so far", {}, {}, renders::Curve::Style::steps};
  double best = std::numeric_limits<double>::infinity();
  double number = 0;
  for (const auto& trial : tuning.trials.trials()) {
    ++number;
    if (trial.verdict.stopped) continue;
    auto& curve = points.of(trial.verdict);
    curve.x.push_back(number);
    curve.y.push_back(trial.verdict.metric);
    if (!trial.verdict.feasible()) continue;
    best = std::min(best, trial.verdict.metric);
    least.x.push_back(number);
    least.y.push_back(best);
  }
  renders::Panel panel;
  panel.title = tuning.study.minimise;
  panel.y_label = with_unit(tuning.study.minimise, tuning.study.metric_unit);
  const auto sorted_of = [&] {
    auto sorted = points.kept.y;
    sorted.insert(sorted.end(), points.unknown.y.begin(), points.unknown.y.end());
    std::sort(sorted.begin(), sorted.end());
    return sorted;
  };
  const auto sorted = sorted_of();
  const auto all = points;
  points.draw(panel, least);
  if (!tuning.before.stopped)
    panel.bands.push_back({"present values", tuning.before.metric, tuning.before.metric});
  // The first samples, far off, would press the rest flat.
  if (!sorted.empty()) {
    const double present = tuning.before.stopped ? sorted.front() : tuning.before.metric;
    const double low = std::min(sorted.front(), present);
    const double most = sorted[(sorted.size() - 1) * 4 / 5];
    const double room = (most - low) / 10;
    if (room > 0) {
      panel.y_range = {low - room, most + room};
      std::ptrdiff_t above = 0;
      std::ptrdiff_t below = 0;
      for (const auto* curve : {&all.kept, &all.beyond, &all.unknown})
        for (const double y : curve->y) {
          above += y > most + room ? 1 : 0;
          below += y < low - room ? 1 : 0;
        }
      if (above > 0) panel.title += fmt::format("; above the picture: {}", counted(above, "trial"));
      if (below > 0) panel.title += fmt::format("; below it: {}, beyond a limit", counted(below, "trial"));
      if (!tuning.before.stopped && present > most + room)
        panel.bands.back().label = fmt::format("present values, above the picture: {:.4g}", present);
    }
  }
  renders::Plot plot{"search", "The way to the optimum", "trial", {}};
  if (!all.empty()) plot.panels.push_back(std::move(panel));
  return plot;
}

renders::Plot surroundings(const Tuning& tuning) {
  renders::Plot plot{"around",
                     "Around the optimum, one parameter at a time",
                     "change of the parameter [% of its range]",
                     {}};
  renders::Panel panel;
  panel.title = tuning.study.minimise;
  panel.y_label = with_unit(tuning.study.minimise, tuning.study.metric_unit);
  const auto& optimum = tuning.trials.at(tuning.best);
  renders::Curve refused{"beyond a limit", {}, {}, renders::Curve::Style::points};
  for (std::size_t i = 0; i < tuning.trials.parameters().size(); ++i) {
    const auto& parameter = tuning.trials.parameters()[i];
    std::vector<std::pair<double, double>> places = {{0, optimum.verdict.metric}};
    for (const auto& slice : tuning.slices) {
      const auto& trial = tuning.trials.at(slice.trial);
      if (slice.parameter != i || trial.verdict.stopped) continue;
      const double moved = (trial.point[i] - optimum.point[i]) / (parameter.high - parameter.low);
      places.emplace_back(moved * 100, trial.verdict.metric);
      if (trial.verdict.feasible()) continue;
      refused.x.push_back(moved * 100);
      refused.y.push_back(trial.verdict.metric);
    }
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    renders::Curve curve{short_name(parameter), {}, {}};
    for (const auto& [x, y] : places) {
      curve.x.push_back(x);
      curve.y.push_back(y);
    }
    if (places.size() > 1) panel.curves.push_back(std::move(curve));
  }
  if (!refused.x.empty() && !panel.curves.empty())  // the second is vermilion
    panel.curves.insert(panel.curves.begin() + 1, std::move(refused));
  if (!optimum.verdict.stopped && !panel.curves.empty()) plot.panels.push_back(std::move(panel));
  return plot;
}

renders::Plot spread(const Tuning& tuning) {
  renders::Plot plot{
      "spread", "The tuned values over the spread of the machine", "sample, best to worst", {}};
  std::vector<double> kept;
  std::vector<double> refused;
  for (const auto& trial : tuning.spread->trials())
    if (!trial.verdict.stopped) (trial.verdict.feasible() ? kept : refused).push_back(trial.verdict.metric);
  renders::Panel panel;
  panel.title = tuning.study.minimise;
  panel.y_label = with_unit(tuning.study.minimise, tuning.study.metric_unit);
  double number = 0;
  const auto sorted = [&](std::vector<double>& numbers) {
    std::sort(numbers.begin(), numbers.end());
    renders::Curve curve{"", {}, numbers};
    for (std::size_t i = 0; i < numbers.size(); ++i) curve.x.push_back(++number);
    return curve;
  };
  TrialPoints points;
  points.kept = sorted(kept);
  points.beyond = sorted(refused);
  points.draw(panel, {});
  const auto& tuned = tuning.after();
  if (!tuned.stopped) panel.bands.push_back({"tuned, nominal", tuned.metric, tuned.metric});
  if (number > 0) plot.panels.push_back(std::move(panel));
  return plot;
}

}  // namespace

std::vector<renders::Plot> tuning_plots(const Tuning& tuning) {
  std::vector<renders::Plot> plots;
  for (std::size_t i = 0; i < tuning.runs_after.size(); ++i) plots.push_back(before_after(tuning, i));
  plots.push_back(way(tuning));
  plots.push_back(surroundings(tuning));
  if (tuning.spread != nullptr) plots.push_back(spread(tuning));
  std::erase_if(plots, [](const renders::Plot& plot) { return plot.panels.empty(); });
  return plots;
}

}  // namespace drycut::sim::studies
