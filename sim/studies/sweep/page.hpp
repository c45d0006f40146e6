#pragma once
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "renders/report.hpp"
#include "sim/output_folder.hpp"
#include "sim/studies/sweep/study.hpp"

namespace drycut::sim::studies {

// What the pages of drycut sweep and drycut envelope have in common.

inline constexpr std::string_view holds_nowhere = "holds nowhere";
inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// A study of one scene as its page sees it: a row a point with what it belongs to.
struct Studied {
  std::string scene;  ///< what it is called
  const PointQuestion& question;
  const SweepAxes& axes;
  const std::vector<SweepPoint>& points;
  Table table;                                    ///< a row a point, the axes' first
  std::vector<std::string> region = {};           ///< of each point
  std::vector<bool> good = {};                    ///< has numbers to show
  std::vector<bool> kept = {};                    ///< nothing fails: green
  std::vector<Column> columns = {};               ///< of `numbers`
  std::vector<std::vector<double>> numbers = {};  ///< a row a point; only of good points, else not a number
  std::vector<renders::MapLines> lines = {};      ///< that a map shows, with a value a point
};

/// The headings of a table as a page has them.
std::vector<Prose> page_headings(const Table& table);
/// The axes and what is sought as columns that say checks by their names, and numbers as cells show them.
std::vector<Column> named_columns(const PointQuestion& question, const SweepAxes& axes);
Column named_column(const PointQuestion& question, const TunedParameter& parameter);
std::string short_text(double value);
/// The point as cells of a table: numbers as numbers.
std::vector<Table::Cell> cells_of(const SweepPoint& point);
/// The point as cells show it: numbers in six digits.
std::vector<std::string> short_point(const SweepPoint& point);
double number_in(const std::string& text);

/// True of a grid over so many axes of numbers.
bool over_axes(const Studied& study, std::size_t count);
/// A command that repeats a point with pictures: `values` of the axes, then "PATH=VALUE" of `more`.
std::string point_command(const Studied& study, const std::vector<std::string>& values,
                          const std::vector<std::string>& more = {});
/// "variables.length=500 mm"
std::string setting(const TunedParameter& parameter, const std::string& value);

/// What the page says of where it comes from: scenarios, axes, what was set.
std::vector<renders::ReportRow> facts_of(const std::vector<const Studied*>& studies);

/// The kinds of regions in the order of their first point, those where nothing fails first, and how many
/// points are in each.
std::vector<renders::MapRegion> regions_of(const Studied& study);
renders::ReportTable counts_of(const Studied& study, const std::string& title);
/// Every point, folded.
renders::ReportTable rows_of(const Studied& study, const std::string& title);

/// The study over its two axes; `name` is the picture's in plots/. The command of a point repeats it; to what
/// it sets it also sets what is `sought`, if anything, to the point's number of it; where nothing is, marks
/// stand between points that hold and those that fail.
renders::ReportMap map_of(const Studied& study, const std::string& name, const std::string& title,
                          const std::string& caption, const TunedParameter* sought, OutputFolder& folder);

/// A number of the points over their one axis, in the axis' order.
renders::Curve curve_of(const Studied& study, std::size_t column, const std::string& label);
/// The columns that are worth a curve: margins are in the table, and number and mean length of the pieces say
/// nothing about a machine that works.
std::vector<Column> curve_columns(const Studied& study);
/// Where such a column is among those of the numbers.
std::optional<std::size_t> place_of(const Column& column, const Studied& study);
/// A column as title and unit. From 0 where nothing is below it; up to 1e-4 at least, for what is
/// less is the noise of numbers.
renders::Panel panel_of(const Column& column, std::vector<renders::Curve> curves);

}  // namespace drycut::sim::studies
