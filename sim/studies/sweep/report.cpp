#include "sim/studies/sweep/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/report/report.hpp"
#include "sim/studies/sweep/page.hpp"

namespace drycut::sim::studies {

namespace {

constexpr double least_share = 0.2;  ///< of a tolerance: a line of equal accuracy below it is noise

/// The rows as a page shows them.
Studied studied(const PointQuestion& question, const SweepAxes& axes, const std::vector<SweepPoint>& points,
                const std::vector<PointRow>& rows) {
  Studied study{question.file.stem().string(), question, axes, points, axis_headings(question, axes)};
  study.columns = question.columns;
  study.headings.insert(study.headings.end(), {"verdict", "limit"});
  study.headings.insert(study.headings.end(), question.columns.begin(), question.columns.end());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& row = rows[i];
    const bool good = row.verdict == PointRow::Verdict::passed;
    auto& cells = study.cells.emplace_back(short_point(points[i]));
    cells.emplace_back(name_of(row.verdict));
    cells.push_back(row.limit);
    for (const double number : row.numbers) cells.push_back(short_text(number));
    study.good.push_back(good);
    study.kept.push_back(good);
    study.region.emplace_back(row.verdict == PointRow::Verdict::failed && !row.limit.empty()
                                  ? row.limit
                                  : std::string(name_of(row.verdict)));
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
      if (piece.tolerance <= 0 || !study.columns[column].starts_with(piece.source + ".cut accuracy ["))
        continue;
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
    const auto& name = study.columns[column];
    renders::MapLines shown{name, {}, {}};
    bool drawn = name.find(" rms torque [") != std::string::npos;
    for (const auto& piece : study.question.pieces) {
      if (!name.starts_with(piece.source + ".cut accuracy [")) continue;
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

/// The values of the one axis in order, and whether all holds there.
std::vector<std::pair<double, bool>> sorted_axis(const Studied& study) {
  std::vector<std::pair<double, bool>> order;
  order.reserve(study.points.size());
  for (std::size_t i = 0; i < study.points.size(); ++i)
    order.emplace_back(number_in(study.points[i][0]), study.good[i]);
  std::sort(order.begin(), order.end());
  return order;
}

/// The stretches of the one axis where all holds.
std::vector<renders::Zone> good_zones(const Studied& study) {
  const auto order = sorted_axis(study);
  std::vector<renders::Zone> zones;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const auto& [here, good] = order[k];
    if (!good) continue;
    const double from = k > 0 ? (order[k - 1].first + here) / 2 : here;
    const double until = k + 1 < order.size() ? (here + order[k + 1].first) / 2 : here;
    if (!zones.empty() && zones.back().to >= from)
      zones.back().to = until;
    else
      zones.push_back({from, until, true});
  }
  return zones;
}

/// ": 60 to 120, 140 m/min", the values of the one axis that hold; "" if none does.
std::string stretches_text(const Studied& study) {
  const auto order = sorted_axis(study);
  std::string text;
  for (std::size_t k = 0; k < order.size(); ++k) {
    if (!order[k].second) continue;
    const auto first = k;
    while (k + 1 < order.size() && order[k + 1].second) ++k;
    text += text.empty() ? ": " : ", ";
    text += first == k ? fmt::format("{:g}", order[k].first)
                       : fmt::format("{:g} to {:g}", order[first].first, order[k].first);
  }
  const auto& heading = study.headings[0];
  const auto bracket = heading.rfind(" [");
  if (text.empty() || bracket == std::string::npos) return text;
  return text + " " + heading.substr(bracket + 2, heading.size() - bracket - 3);
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

/// Every figure over the one axis; `rows` has those of points that fail too.
renders::Plot curves_of(const Studied& study, const std::vector<PointRow>& rows, const std::string& title) {
  renders::Plot plot{"curves", title, study.headings[0], {}};
  plot.panel_height = 240;
  plot.zones = good_zones(study);
  auto every = study;
  for (std::size_t i = 0; i < rows.size(); ++i) every.numbers[i] = rows[i].numbers;
  const auto has_points = [](const renders::Curve& curve) {
    return std::any_of(curve.y.begin(), curve.y.end(), [](double y) { return std::isfinite(y); });
  };
  for (const auto& name : curve_columns(study)) {
    const auto column = static_cast<std::size_t>(std::find(study.columns.begin(), study.columns.end(), name) -
                                                 study.columns.begin());
    auto holds = curve_of(study, column, "all holds");
    auto all = curve_of(every, column, "beyond: a check fails");
    if (!has_points(all)) continue;
    leave_out_of_proportion(holds, all);
    std::vector<renders::Curve> curves;
    const bool fails = std::count(study.good.begin(), study.good.end(), false) > 0;
    if (fails) curves.push_back(std::move(all));
    if (has_points(holds)) curves.push_back(std::move(holds));
    if (fails && curves.size() == 2) curves.front().faint = true;
    plot.panels.push_back(panel_of(name, std::move(curves)));
  }
  return plot;
}

}  // namespace

void write_sweep_report(const PointQuestion& question, const SweepAxes& axes,
                        const std::vector<SweepPoint>& points, const std::vector<PointRow>& rows,
                        OutputFolder& folder) {
  auto study = studied(question, axes, points, rows);
  study.lines = lines_of(study);
  const auto title = "Sweep of " + study.scene;
  renders::Report report;
  report.title = title;
  report.scenario = question.file.filename().string();
  report.passed = true;
  report.word = fmt::format("{}", points.size());
  report.verdict =
      fmt::format("points, {} of them passed{}", std::count(study.good.begin(), study.good.end(), true),
                  over_axes(study, 1) ? stretches_text(study) : "");
  report.facts = facts_of({&study});
  report.summary = {counts_of(study, "What gives way first")};
  report.tables = {rows_of(study, "Every point")};
  std::vector<renders::Plot> plots;
  if (over_axes(study, 2)) {
    const auto caption =
        "Green: every check and every rating holds. The other colours say what gives way first." +
        dust_of(study);
    report.maps.push_back(map_of(study, "map", title, caption, nullptr, folder));
  } else if (!points.empty()) {
    report.texts.push_back(
        {"The command that repeats the first point with pictures", point_command(study, points.front())});
  }
  if (over_axes(study, 1)) plots.push_back(curves_of(study, rows, title + "; green: all holds"));
  std::erase_if(plots, [](const renders::Plot& plot) { return plot.panels.empty(); });
  report::write_report(std::move(report), std::move(plots), folder);
}

}  // namespace drycut::sim::studies
