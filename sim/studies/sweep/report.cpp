#include "sim/studies/sweep/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "sim/report/report.hpp"
#include "sim/studies/sweep/page.hpp"

namespace drycut::sim::studies {

namespace {

constexpr double least_share = 0.2;  ///< of a tolerance: a line of equal accuracy below it is noise

/// A table of points as a page has it: checks by their names, values of the axes as numbers.
Table named(const Table& table, const PointQuestion& question, const SweepAxes& axes,
            const std::vector<SweepPoint>& points) {
  auto columns = table.columns();
  const auto of_axes = named_columns(question, axes);
  std::copy(of_axes.begin(), of_axes.end(), columns.begin());
  Table made(std::move(columns));
  for (std::size_t i = 0; i < points.size(); ++i) {
    auto cells = table.rows()[i];
    const auto of_point = cells_of(points[i]);
    std::copy(of_point.begin(), of_point.end(), cells.begin());
    made.add(std::move(cells));
  }
  return made;
}

/// The rows as a page shows them.
Studied studied(const PointQuestion& question, const SweepAxes& axes, const std::vector<SweepPoint>& points,
                const std::vector<PointRow>& rows) {
  Studied study{question.file.stem().string(), question, axes, points,
                named(sweep_table(question, axes, points, rows), question, axes, points)};
  study.columns = question.columns;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& row = rows[i];
    const bool good = row.verdict == PointRow::Verdict::passed;
    study.good.push_back(good);
    study.kept.push_back(good);
    study.region.push_back(region_of(row));
    study.numbers.push_back(good ? row.numbers : std::vector<double>(question.columns.size(), unknown));
  }
  return study;
}

/// Lines that no point reaches need no place in a legend.
bool is_above_least(const renders::MapLines& lines) {
  return lines.levels.empty() || std::any_of(lines.values.begin(), lines.values.end(),
                                             [&](double value) { return value > lines.levels.front(); });
}

/// Which accuracies a map has no lines of, since all are so good.
std::string dust_of(const Studied& study) {
  std::string text;
  for (std::size_t column = 0; column < study.columns.size(); ++column) {
    for (const auto& piece : study.question.pieces) {
      if (piece.tolerance <= 0 || study.columns[column].key != piece_key(piece.source, "accuracy")) continue;
      const bool reached = std::any_of(study.numbers.begin(), study.numbers.end(), [&](const auto& numbers) {
        return numbers[column] > least_share * piece.tolerance;
      });
      if (!reached)
        text += fmt::format(" Where all holds, the accuracy of {} is better than {:.4g} {} everywhere.",
                            piece.source, least_share * piece.tolerance, piece.length_unit);
    }
  }
  return text;
}

/// Lines of equal accuracy and rms torque. Of the accuracy those that are near what is allowed: far below it
/// is the noise of a machine that does well.
std::vector<renders::MapLines> lines_of(const Studied& study) {
  std::vector<renders::MapLines> lines;
  for (std::size_t column = 0; column < study.columns.size(); ++column) {
    const auto& key = study.columns[column].key;
    renders::MapLines shown{study.columns[column].heading(), {}, {}};
    bool drawn = std::ranges::any_of(study.question.drives, [&](const std::string& drive) {
      return key == drive_key(drive, "rms_torque");
    });
    for (const auto& piece : study.question.pieces) {
      if (key != piece_key(piece.source, "accuracy")) continue;
      drawn = true;
      if (piece.tolerance > 0)
        for (const double share : {least_share, 0.5, 1.0}) shown.levels.push_back(share * piece.tolerance);
    }
    if (!drawn) continue;
    for (const auto& numbers : study.numbers) shown.values.push_back(numbers[column]);
    if (is_above_least(shown)) lines.push_back(std::move(shown));
  }
  return lines;
}

/// The points in the order of the one axis.
std::vector<std::size_t> sorted_points(const Studied& study) {
  std::vector<std::size_t> order(study.points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return number_in(study.points[a][0]) < number_in(study.points[b][0]);
  });
  return order;
}

/// The last of the first points that pass one after the other, and the one behind it that does not: the bound
/// lies between them, as drycut envelope has it. Nothing where there is none.
std::optional<std::pair<std::size_t, std::size_t>> first_bound(const Studied& study) {
  const auto order = sorted_points(study);
  for (std::size_t k = 0; k + 1 < order.size(); ++k)
    if (study.good[order[k]] && !study.good[order[k + 1]]) return std::pair(order[k], order[k + 1]);
  return {};
}

std::string shown_value(const Studied& study, std::size_t point) {
  return short_text(number_in(study.points[point][0]));
}

/// ": 60 to 120, 140 m/min; at 130 m/min follows the cam fails", of the values of the one axis; "" if none
/// passes.
std::string stretches_text(const Studied& study, const std::vector<PointRow>& rows) {
  const auto order = sorted_points(study);
  std::string text;
  for (std::size_t k = 0; k < order.size(); ++k) {
    if (!study.good[order[k]]) continue;
    const auto first = k;
    while (k + 1 < order.size() && study.good[order[k + 1]]) ++k;
    text += text.empty() ? ": " : ", ";
    text += shown_value(study, order[first]);
    if (k > first) text += " to " + shown_value(study, order[k]);
  }
  if (text.empty()) return text;
  const auto& unit = study.axes[0].parameter.unit;
  const auto in_unit = [&](const std::string& number) { return unit.empty() ? number : number + " " + unit; };
  text = in_unit(text);
  if (const auto bound = first_bound(study))
    text += fmt::format("; then at {}: {}", in_unit(shown_value(study, bound->second)),
                        limit_of(rows[bound->second]));
  return text;
}

/// Where a check fails a figure may be out of all proportion: what is many times what holds is left to the
/// table.
void leave_out_of_proportion(const renders::Curve& holds, renders::Curve& all) {
  constexpr double most = 4;
  double low = 0, high = 0;
  for (const double y : holds.y) {
    low = std::fmin(low, y);
    high = std::fmax(high, y);
  }
  if (high <= low) return;
  for (double& y : all.y)
    if (y < most * low || y > most * high) y = unknown;
}

/// Every figure over the one axis, a dot a run.
renders::Plot curves_of(const Studied& study, const std::vector<PointRow>& rows, const std::string& title) {
  renders::Plot plot{"curves", title, study.table.columns()[0].heading(), {}};
  plot.panel_height = 240;
  if (const auto bound = first_bound(study)) {
    plot.marks = {{number_in(study.points[bound->first][0]), "passes at " + shown_value(study, bound->first)},
                  {number_in(study.points[bound->second][0]),
                   fmt::format("{} at {}",
                               rows[bound->second].verdict == PointRow::Verdict::failed
                                   ? "fails"
                                   : name_of(rows[bound->second].verdict),
                               shown_value(study, bound->second)),
                   true}};
  }
  const auto has_points = [](const renders::Curve& curve) {
    return std::any_of(curve.y.begin(), curve.y.end(), [](double y) { return std::isfinite(y); });
  };
  auto failing = study;
  for (std::size_t i = 0; i < rows.size(); ++i)
    failing.numbers[i] =
        study.good[i] ? std::vector<double>(rows[i].numbers.size(), unknown) : rows[i].numbers;
  for (const auto& column : curve_columns(study)) {
    const auto place = *place_of(column, study);
    auto passes = curve_of(study, place, "passes");
    auto fails = curve_of(failing, place, "fails");
    leave_out_of_proportion(passes, fails);
    // What joins the dots is a guide for the eye; pale, and without a name.
    auto joined = passes;
    joined.label.clear();
    joined.faint = true;
    for (std::size_t i = 0; i < joined.y.size(); ++i)
      if (std::isnan(joined.y[i])) joined.y[i] = fails.y[i];
    if (!has_points(joined)) continue;
    // In this order red and green are theirs; who has no dot has no name.
    for (auto* curve : {&fails, &passes}) {
      curve->style = renders::Curve::Style::points;
      if (!has_points(*curve)) curve->label.clear();
    }
    plot.panels.push_back(panel_of(column, {std::move(joined), std::move(fails), std::move(passes)}));
  }
  return plot;
}

/// The points that did not pass, by verdict; "" if there are none.
std::string others_text(const std::vector<PointRow>& rows) {
  std::vector<PointRow::Verdict> others;
  for (const auto& row : rows)
    if (row.verdict != PointRow::Verdict::passed) others.push_back(row.verdict);
  return counts_of(others);
}

/// The first that failed, else the first that ran.
std::optional<std::size_t> point_to_repeat(const std::vector<PointRow>& rows) {
  using Verdict = PointRow::Verdict;
  const auto first = [&](const std::vector<Verdict>& of) -> std::optional<std::size_t> {
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (std::find(of.begin(), of.end(), rows[i].verdict) != of.end()) return i;
    return {};
  };
  const auto failed = first({Verdict::failed, Verdict::diverged, Verdict::lost});
  return failed ? failed : first({Verdict::passed});
}

}  // namespace

record::Verdict write_sweep_report(const PointQuestion& question, const SweepAxes& axes,
                                   const std::vector<SweepPoint>& points, const std::vector<PointRow>& rows,
                                   OutputFolder& folder) {
  auto study = studied(question, axes, points, rows);
  study.lines = lines_of(study);
  const auto title = "Sweep of " + study.scene;
  const auto passed = std::count(study.good.begin(), study.good.end(), true);
  record::Verdict verdict;
  verdict.title = title;
  verdict.word = fmt::format("{} of {}", passed, points.size());
  verdict.sentence = "points passed" + (over_axes(study, 1) ? stretches_text(study, rows) : "");
  if (const auto others = others_text(rows); !others.empty()) verdict.sentence += "; " + others;
  verdict.counts["points"] = std::ssize(points);
  for (const auto& row : rows) ++verdict.counts[std::string(name_of(row.verdict))];
  verdict.scenarios = {question.file.generic_string()};
  auto report = report::page_of(verdict);
  report.scenario = question.file.filename().string();
  report.facts = facts_of({&study});
  report.summary = {counts_of(study, "What fails first")};
  report.tables = {rows_of(study, "Every point")};
  std::vector<renders::Plot> plots;
  constexpr auto* between = "What lies between the points was not run: drycut envelope finds the bound.";
  if (over_axes(study, 2)) {
    const auto caption = fmt::format(
        "A dot a run: round and green where every check and every rating holds; the other colours say what "
        "fails first. {} Lines of equal value are drawn between points that pass.{}",
        between, dust_of(study));
    report.maps.push_back(map_of(study, "map", title, caption, nullptr, folder));
  } else if (const auto point = point_to_repeat(rows)) {
    report.texts.push_back({rows[*point].verdict == PointRow::Verdict::passed
                                ? "The first point, once more with pictures"
                                : "The first point that failed, once more with pictures",
                            point_command(study, points[*point])});
  }
  if (over_axes(study, 1)) {
    plots.push_back(curves_of(study, rows, title));
    report.notes.emplace_back(std::string("A dot is a run. ") + between);
  }
  std::erase_if(plots, [](const renders::Plot& plot) { return plot.panels.empty(); });
  report::write_report(std::move(report), std::move(plots), folder);
  return verdict;
}

int finish(record::Verdict verdict, const PointStore& store, OutputFolder& folder) {
  verdict.counts["simulated"] = static_cast<std::int64_t>(store.simulated());
  if (!store.lost().empty()) verdict.stopped();
  record::write_verdict(verdict, folder);
  folder.finish();
  return verdict.exit;
}

}  // namespace drycut::sim::studies
