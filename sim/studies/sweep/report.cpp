#include "sim/studies/sweep/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>

#include "sim/report/report.hpp"
#include "sim/studies/compare/recorded_csv.hpp"

namespace drycut::sim::studies {

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t most_rows = 2000;  // of the table in a page

/// A study as its pages see it: a row a point with what it belongs to.
struct Studied {
  const PointQuestion& question;
  const SweepAxes& axes;
  const std::vector<SweepPoint>& points;
  std::vector<std::string> headings;            ///< of `cells`
  std::vector<std::vector<std::string>> cells;  ///< a row a point, the axes' first
  std::vector<std::string> region;              ///< of each point
  std::vector<bool> good;
  std::vector<std::string> columns;          ///< of `numbers`
  std::vector<std::vector<double>> numbers;  ///< a row a point; only of good points, else not a number
  std::vector<std::size_t> lines = {};       ///< columns that a map shows as lines of equal value
};

std::string short_text(double value) { return std::isfinite(value) ? fmt::format("{:.6g}", value) : ""; }

double number_in(const std::string& text) { return number_of(text).value_or(unknown); }

/// In quotes for a shell.
std::string quoted(const std::string& words) {
  std::string text = "'";
  for (const char c : words) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

/// Repeats a point with pictures; `values` of the axes, as a shell takes them.
std::string command(const Studied& study, const std::vector<std::string>& values) {
  std::string text = "drycut run " + quoted(study.question.file.string());
  for (const auto& [path, value] : study.question.set)
    text += " --set " + quoted(fmt::format("{}={}", path, value));
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto& parameter = study.axes[i].parameter;
    text += " --set " + quoted(fmt::format("{}={}{}{}", parameter.path, values[i],
                                           parameter.unit.empty() ? "" : " ", parameter.unit));
  }
  return text;
}

/// The values of an axis that are numbers, ascending, each once.
std::vector<double> scale_of(const SweepAxis& axis) {
  std::vector<double> values;
  values.reserve(axis.values.size());
  for (const auto& text : axis.values) values.push_back(number_in(text));
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  const bool numbers = std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
  return numbers && values.size() > 1 ? values : std::vector<double>();
}

bool over_axes(const Studied& study, std::size_t count) {
  return study.axes.size() == count && std::all_of(study.axes.begin(), study.axes.end(),
                                                   [](const auto& a) { return !scale_of(a).empty(); });
}

/// The kinds of regions in the order of their first point, good ones first.
std::vector<renders::MapRegion> regions_of(const Studied& study) {
  std::vector<renders::MapRegion> regions;
  for (const bool good : {true, false})
    for (std::size_t i = 0; i < study.region.size(); ++i) {
      const bool known = std::any_of(regions.begin(), regions.end(),
                                     [&](const auto& region) { return region.label == study.region[i]; });
      if (study.good[i] != good || known) continue;
      using Kind = renders::MapRegion::Kind;
      const bool none = study.region[i] == name_of(PointRow::Verdict::refused);
      regions.push_back({study.region[i], good ? Kind::good : none ? Kind::none : Kind::bad});
    }
  return regions;
}

renders::ReportMap map_of(const Studied& study, const std::string& title, OutputFolder& folder) {
  renders::ReportMap shown;
  auto& map = shown.map;
  map.name = "map";
  map.title = title;
  map.x = {heading(study.axes[0].parameter), scale_of(study.axes[0])};
  map.y = {heading(study.axes[1].parameter), scale_of(study.axes[1])};
  map.regions = regions_of(study);
  const auto count = map.x.values.size() * map.y.values.size();
  map.region.resize(count);
  shown.cells.resize(count);
  const auto& lines = study.lines;
  for (const auto column : lines)
    map.lines.push_back({study.columns[column], std::vector<double>(count, unknown)});
  for (std::size_t i = 0; i < study.points.size(); ++i) {
    const auto place = [&](const renders::MapAxis& axis, const std::string& text) {
      return static_cast<std::size_t>(
          std::lower_bound(axis.values.begin(), axis.values.end(), number_in(text)) - axis.values.begin());
    };
    const auto at = place(map.y, study.points[i][1]) * map.x.values.size() + place(map.x, study.points[i][0]);
    map.region[at] = static_cast<std::size_t>(
        std::find_if(map.regions.begin(), map.regions.end(),
                     [&](const auto& region) { return region.label == study.region[i]; }) -
        map.regions.begin());
    shown.cells[at] = study.cells[i];
    for (std::size_t k = 0; k < lines.size(); ++k) map.lines[k].values[at] = study.numbers[i][lines[k]];
  }
  shown.headings = study.headings;
  shown.command = command(study, {"{x}", "{y}"});
  shown.caption = "Green: every check and every rating holds. The other colours say what gives way first.";
  shown.png = folder.add("plots/map.png");
  draw_map(map, shown.png.parent_path());
  return shown;
}

/// A curve of every number over the one axis; where all holds the ground is green.
renders::Plot curves_of(const Studied& study, const std::string& title, std::size_t most) {
  renders::Plot plot;
  plot.name = "curves";
  plot.title = title;
  plot.x_label = heading(study.axes[0].parameter);
  plot.panel_height = 240;
  std::vector<std::size_t> order(study.points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto x = [&](std::size_t i) { return number_in(study.points[i][0]); };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return x(a) < x(b); });
  for (std::size_t k = 0; k < order.size(); ++k) {
    if (!study.good[order[k]]) continue;
    const double here = x(order[k]);
    const double from = k > 0 ? (x(order[k - 1]) + here) / 2 : here;
    const double until = k + 1 < order.size() ? (here + x(order[k + 1])) / 2 : here;
    if (!plot.zones.empty() && plot.zones.back().to >= from)
      plot.zones.back().to = until;
    else
      plot.zones.push_back({from, until, true});
  }
  for (std::size_t column = 0; column < study.columns.size() && plot.panels.size() < most; ++column) {
    const auto& name = study.columns[column];
    if (name.starts_with("margin of ")) continue;  // the table has them
    const auto bracket = std::min(name.rfind(" ["), name.size());
    renders::Panel panel{
        name.substr(0, bracket), std::string(name, std::min(bracket + 1, name.size())), {}, {}, {}};
    renders::Curve curve{"", {}, {}};
    bool any = false;
    for (const auto i : order) {
      curve.x.push_back(x(i));
      curve.y.push_back(study.numbers[i][column]);
      any = any || std::isfinite(curve.y.back());
    }
    if (!any) continue;
    panel.curves.push_back(std::move(curve));
    plot.panels.push_back(std::move(panel));
  }
  return plot;
}

/// How many points are in each region.
renders::ReportTable counts_of(const Studied& study, const std::string& title) {
  renders::ReportTable table{title, {"points", "what came of them"}, {}};
  for (const auto& region : regions_of(study))
    table.rows.push_back(
        {{std::to_string(std::count(study.region.begin(), study.region.end(), region.label)), region.label}});
  return table;
}

renders::Report page_of(const Studied& study, const std::string& title, const std::string& verdict) {
  renders::Report report;
  report.title = title;
  report.scenario = study.question.file.filename().string();
  report.passed = true;
  report.word = fmt::format("{}", study.points.size());
  report.verdict = verdict;
  std::string over;
  for (const auto& axis : study.axes) over += (over.empty() ? "" : ", ") + heading(axis.parameter);
  report.facts = {
      {{"scenario", study.question.file.string()}}, {{"over", over}}, {{"drycut", DRYCUT_VERSION}}};
  for (const auto& [path, value] : study.question.set)
    report.facts.push_back({{"set", fmt::format("{} = {}", path, value)}});
  renders::ReportTable rows{"Every point", study.headings, {}, true};
  for (std::size_t i = 0; i < std::min(most_rows, study.cells.size()); ++i)
    rows.rows.push_back({study.cells[i]});
  if (study.cells.size() > most_rows) rows.title = fmt::format("The first {} points", most_rows);
  report.tables = {std::move(rows)};
  return report;
}

void write(const Studied& study, renders::Report report, std::vector<renders::Plot> plots,
           const std::string& title, OutputFolder& folder) {
  if (over_axes(study, 2)) report.maps.push_back(map_of(study, title, folder));
  std::erase_if(plots, [](const renders::Plot& plot) { return plot.panels.empty(); });
  if (!study.points.empty() && !over_axes(study, 2))
    report.texts.push_back(
        {"The command that repeats the first point with pictures", command(study, study.points.front())});
  report::write_report(std::move(report), std::move(plots), folder);
}

std::vector<std::string> axis_headings(const SweepAxes& axes) {
  std::vector<std::string> headings;
  headings.reserve(axes.size());
  for (const auto& axis : axes) headings.push_back(heading(axis.parameter));
  return headings;
}

void add_numbers(const std::vector<double>& numbers, std::vector<std::string>& cells) {
  for (const double number : numbers) cells.push_back(short_text(number));
}

}  // namespace

void write_sweep_report(const PointQuestion& question, const SweepAxes& axes,
                        const std::vector<SweepPoint>& points, const std::vector<PointRow>& rows,
                        OutputFolder& folder) {
  Studied study{question, axes, points, axis_headings(axes), {}, {}, {}, question.columns, {}};
  study.headings.insert(study.headings.end(), {"verdict", "limit"});
  study.headings.insert(study.headings.end(), question.columns.begin(), question.columns.end());
  std::size_t passed = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& row = rows[i];
    const bool good = row.verdict == PointRow::Verdict::passed;
    passed += good ? 1 : 0;
    auto& cells = study.cells.emplace_back(points[i]);
    cells.emplace_back(name_of(row.verdict));
    cells.push_back(row.limit);
    add_numbers(row.numbers, cells);
    study.good.push_back(good);
    study.region.emplace_back(row.verdict == PointRow::Verdict::failed && !row.limit.empty()
                                  ? row.limit
                                  : std::string(name_of(row.verdict)));
    study.numbers.push_back(good ? row.numbers : std::vector<double>(question.columns.size(), unknown));
  }
  for (std::size_t i = 0; i < study.columns.size(); ++i)
    for (const auto* words : {" accuracy [", " rms torque ["})
      if (study.columns[i].find(words) != std::string::npos) study.lines.push_back(i);
  const auto title = "Sweep of " + question.file.stem().string();
  auto report = page_of(study, title, fmt::format("points, {} of them passed", passed));
  report.summary = {counts_of(study, "What gives way first")};
  std::vector<renders::Plot> plots;
  constexpr std::size_t most_panels = 12;
  if (over_axes(study, 1)) plots.push_back(curves_of(study, title + "; green: all holds", most_panels));
  write(study, std::move(report), std::move(plots), title, folder);
}

void write_envelope_report(const PointQuestion& question, const SweepAxes& axes,
                           const std::vector<SweepPoint>& points, const BoundRequest& request,
                           const std::vector<Bound>& bounds, OutputFolder& folder) {
  const auto sought = heading(request.parameter);
  Studied study{question, axes, points, axis_headings(axes), {}, {}, {}, {sought}, {}};
  study.columns.insert(study.columns.end(), question.columns.begin(), question.columns.end());
  study.headings.insert(study.headings.end(), {"bound", "what gives way beyond it"});
  study.headings.insert(study.headings.end(), study.columns.begin(), study.columns.end());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& bound = bounds[i];
    const bool good = bound.kind != Bound::Kind::nowhere;
    auto& cells = study.cells.emplace_back(points[i]);
    cells.emplace_back(name_of(bound.kind));
    cells.push_back(bound.limit);
    auto& numbers = study.numbers.emplace_back();
    numbers = {good ? bound.value : unknown};
    numbers.insert(numbers.end(), bound.numbers.begin(), bound.numbers.end());
    numbers.resize(study.columns.size(), unknown);
    add_numbers(numbers, cells);
    study.good.push_back(good);
    study.region.push_back(bound.limit.empty() ? std::string(name_of(bound.kind)) : bound.limit);
  }
  study.lines = {0};  // the bound itself
  const auto title = fmt::format("Envelope of {}: largest {}", question.file.stem().string(), sought);
  auto report = page_of(
      study, title,
      fmt::format("points; {} found to {:.6g} {}", sought, request.tolerance, request.parameter.unit));
  report.summary = {counts_of(study, "What gives way beyond the bound")};
  std::vector<renders::Plot> plots;
  if (over_axes(study, 1)) {
    auto plot = curves_of(study, title, 12);
    plot.zones.clear();
    // On the curve of the bound: what gives way beyond it.
    if (!plot.panels.empty())
      for (const auto& region : regions_of(study)) {
        renders::Curve limited{region.label, {}, {}, renders::Curve::Style::points};
        for (std::size_t i = 0; i < points.size(); ++i) {
          if (study.region[i] != region.label) continue;
          limited.x.push_back(number_in(points[i][0]));
          limited.y.push_back(study.numbers[i][0]);
        }
        plot.panels[0].curves.push_back(std::move(limited));
      }
    plots.push_back(std::move(plot));
  }
  write(study, std::move(report), std::move(plots), title, folder);
}

}  // namespace drycut::sim::studies
