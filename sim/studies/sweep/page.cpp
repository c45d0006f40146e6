#include "sim/studies/sweep/page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sim/studies/recorded_csv.hpp"

namespace drycut::sim::studies {

namespace {

constexpr std::size_t most_rows = 2000;  // of the table in a page

/// In quotes for a shell.
std::string quoted(const std::string& words) {
  std::string text = "'";
  for (const char c : words) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
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

}  // namespace

Column named_column(const PointQuestion& question, const TunedParameter& parameter) {
  auto column = column_of(parameter);
  column.name = with_check_names(question, column.name);
  return column;
}

std::vector<Prose> page_headings(const Table& table) {
  const auto headings = table.headings();
  return {headings.begin(), headings.end()};
}

std::vector<Column> named_columns(const PointQuestion& question, const SweepAxes& axes) {
  std::vector<Column> columns;
  columns.reserve(axes.size());
  for (const auto& axis : axes) columns.push_back(named_column(question, axis.parameter));
  return columns;
}

std::string short_text(double value) { return std::isfinite(value) ? fmt::format("{:.6g}", value) : ""; }

std::vector<Table::Cell> cells_of(const SweepPoint& point) {
  std::vector<Table::Cell> cells;
  for (const auto& text : point) {
    const double number = number_in(text);
    cells.push_back(std::isfinite(number) ? Table::Cell(number) : Table::Cell(text));
  }
  return cells;
}

std::vector<std::string> short_point(const SweepPoint& point) {
  Table table(std::vector<Column>(point.size()));
  table.add(cells_of(point));
  return table.shown(0);
}

double number_in(const std::string& text) { return number_of(text).value_or(unknown); }

bool over_axes(const Studied& study, std::size_t count) {
  return study.axes.size() == count && std::all_of(study.axes.begin(), study.axes.end(),
                                                   [](const auto& a) { return !scale_of(a).empty(); });
}

std::string setting(const TunedParameter& parameter, const std::string& value) {
  return fmt::format("{}={}{}{}", parameter.path, value, parameter.unit.empty() ? "" : " ", parameter.unit);
}

std::string point_command(const Studied& study, const std::vector<std::string>& values,
                          const std::vector<std::string>& more) {
  std::string text = "drycut run " + quoted(study.question.file.string());
  for (const auto& [path, value] : study.question.set)
    text += " --set " + quoted(fmt::format("{}={}", path, value));
  for (std::size_t i = 0; i < values.size(); ++i)
    text += " --set " + quoted(setting(study.axes[i].parameter, values[i]));
  for (const auto& one : more) text += " --set " + quoted(one);
  return text;
}

std::vector<renders::ReportRow> facts_of(const std::vector<const Studied*>& studies) {
  std::vector<std::string> files;
  std::vector<std::string> over;  // each once
  for (const auto* study : studies) {
    files.push_back(study->question.file.string());
    for (const auto& axis : named_columns(study->question, study->axes))
      if (std::find(over.begin(), over.end(), axis.heading()) == over.end()) over.push_back(axis.heading());
  }
  std::vector<renders::ReportRow> facts;
  facts.push_back(
      {{files.size() == 1 ? "scenario" : "scenarios", fmt::format("{}", fmt::join(files, ", "))}});
  if (!over.empty()) facts.push_back({{"over", fmt::format("{}", fmt::join(over, ", "))}});
  for (const auto& [path, value] : studies.front()->question.set)
    facts.push_back(
        {{"set", fmt::format("{} = {}", with_check_names(studies.front()->question, path), value)}});
  facts.push_back({{"drycut", DRYCUT_VERSION}});
  return facts;
}

std::vector<renders::MapRegion> regions_of(const Studied& study) {
  std::vector<renders::MapRegion> regions;
  for (const bool kept : {true, false})
    for (std::size_t i = 0; i < study.region.size(); ++i) {
      const bool known = std::any_of(regions.begin(), regions.end(),
                                     [&](const auto& region) { return region.label == study.region[i]; });
      if (study.kept[i] != kept || known) continue;
      using Kind = renders::MapRegion::Kind;
      const bool none =
          study.region[i] == name_of(PointRow::Verdict::refused) || study.region[i] == holds_nowhere;
      regions.push_back({study.region[i], kept ? Kind::good : none ? Kind::none : Kind::bad});
    }
  return regions;
}

renders::ReportTable counts_of(const Studied& study, const std::string& title) {
  renders::ReportTable table{title, {"points", "verdict"}, {}};
  for (const auto& region : regions_of(study))
    table.rows.push_back(
        {{std::to_string(std::count(study.region.begin(), study.region.end(), region.label)), region.label}});
  return table;
}

renders::ReportTable rows_of(const Studied& study, const std::string& title) {
  renders::ReportTable rows{title, page_headings(study.table), {}, true};
  const auto count = study.table.rows().size();
  for (std::size_t i = 0; i < std::min(most_rows, count); ++i) rows.rows.push_back({study.table.shown(i)});
  if (count > most_rows) rows.title = fmt::format("{}: the first {}", title, most_rows);
  return rows;
}

renders::ReportMap map_of(const Studied& study, const std::string& name, const std::string& title,
                          const std::string& caption, const TunedParameter* sought, OutputFolder& folder) {
  renders::ReportMap shown;
  auto& map = shown.map;
  map.name = name;
  map.title = title;
  map.x = {study.table.columns()[0].heading(), scale_of(study.axes[0])};
  map.y = {study.table.columns()[1].heading(), scale_of(study.axes[1])};
  map.regions = regions_of(study);
  if (sought == nullptr) map.bound = "the bound: between these";
  const auto count = map.x.values.size() * map.y.values.size();
  map.region.resize(count);
  shown.cells.resize(count);
  map.lines = study.lines;
  for (auto& lines : map.lines) lines.values.assign(count, unknown);
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
    shown.cells[at] = study.table.shown(i);
    // Behind what is told, what the command sets: to the last digit.
    shown.cells[at].insert(shown.cells[at].end(), study.points[i].begin(), study.points[i].end());
    if (sought != nullptr) shown.cells[at].push_back(study.good[i] ? number_text(study.numbers[i][0]) : "");
    for (std::size_t k = 0; k < map.lines.size(); ++k) map.lines[k].values[at] = study.lines[k].values[i];
  }
  shown.headings = study.table.headings();
  const auto slot = [&](std::size_t behind) { return fmt::format("{{{}}}", shown.headings.size() + behind); };
  std::vector<std::string> more;
  if (sought != nullptr) more.push_back(setting(*sought, slot(2)));
  shown.command = point_command(study, {slot(0), slot(1)}, more);
  shown.caption = caption;
  shown.png = folder.add(fmt::format("plots/{}.png", name));
  draw_map(map, shown.png.parent_path());
  return shown;
}

renders::Curve curve_of(const Studied& study, std::size_t column, const std::string& label) {
  std::vector<std::size_t> order(study.points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto x = [&](std::size_t i) { return number_in(study.points[i][0]); };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return x(a) < x(b); });
  renders::Curve curve{label, {}, {}};
  for (const auto i : order) {
    curve.x.push_back(x(i));
    curve.y.push_back(study.numbers[i][column]);
  }
  return curve;
}

std::vector<Column> curve_columns(const Studied& study) {
  std::vector<Column> worth;
  for (const auto& column : study.columns) {
    const auto tells = [&](const auto& piece) {
      return column.key == piece_key(piece.source, "number") ||
             column.key == piece_key(piece.source, "mean_length");
    };
    if (!column.key.starts_with(margin_key) && std::ranges::none_of(study.question.pieces, tells))
      worth.push_back(column);
  }
  return worth;
}

std::optional<std::size_t> place_of(const Column& column, const Studied& study) {
  const auto found =
      std::ranges::find_if(study.columns, [&](const Column& one) { return one.is_same(column); });
  if (found == study.columns.end()) return {};
  return static_cast<std::size_t>(found - study.columns.begin());
}

renders::Panel panel_of(const Column& column, std::vector<renders::Curve> curves) {
  renders::Panel panel{column.name, column.unit.empty() ? "" : fmt::format("[{}]", column.unit), {}, {}, {}};
  double low = 0;
  double high = 0;
  for (const auto& curve : curves) {
    for (const double y : curve.y) {
      if (!std::isfinite(y)) continue;
      low = std::min(low, y);
      high = std::max(high, y);
    }
  }
  constexpr double headroom = 1.08;
  constexpr double least = 1e-4;
  if (low == 0 && high > 0) panel.y_range = {0, std::max(least, headroom * high)};
  panel.curves = std::move(curves);
  return panel;
}

}  // namespace drycut::sim::studies
