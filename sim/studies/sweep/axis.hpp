#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/problem.hpp"
#include "base/table.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/studies/tune/parameter.hpp"

namespace drycut::sim::studies {

/// A value of the scenario that a sweep goes over, by its override path.
struct SweepAxis {
  TunedParameter parameter;            ///< path, unit, ends and their columns
  std::vector<std::string> values;     ///< without unit, as a row has them; none of a range that is sampled
  std::vector<int> word_columns = {};  ///< of `values` that are words
  std::optional<int> steps = {};       ///< of a range
  bool logarithmic = false;            ///< of a range
  std::string fit = {};                ///< the range is the limits in this fit.json, "" = it was given
  [[nodiscard]] bool is_range() const { return parameter.low < parameter.high; }
};
using SweepAxes = std::vector<SweepAxis>;
/// A value of each axis, without unit.
using SweepPoint = std::vector<std::string>;

/// Reads PATH=A..B UNIT:N, PATH=A..B UNIT:N:log, or a list PATH=1,2,5 UNIT or PATH=word,word. `sampled`: N is
/// not needed. What is wrong goes to `problems` by option and column.
std::optional<SweepAxis> parse_axis(const std::string& text, const std::string& option, bool sampled,
                                    Problems& problems);
/// The axes of `text`: one as above, or of a fit.json (fitted.hpp, as is `given`) one for each value that it
/// knows, from limit to limit: a grid has both limits, a sample what lies between them.
SweepAxes parse_over(const std::string& text, const std::string& option, bool sampled,
                     const std::vector<std::string>& given, Problems& problems);
/// Those of all texts.
SweepAxes parse_axes(const std::vector<std::string>& texts, const std::string& option, bool sampled,
                     Problems& problems);
/// Fills `values` of a range, now that its unit is known.
void fill_axis(SweepAxis& axis, Problems& problems);

/// As a row has it: 15 digits, so that 0.1 + 0.2 is 0.3.
std::string number_text(double value);
/// How the axis is headed in a table: "variables.length [mm]".
std::string heading(const TunedParameter& parameter);
/// The same as a column: its path is its key.
Column column_of(const TunedParameter& parameter);
std::vector<Column> columns_of(const SweepAxes& axes);
/// The point as overrides of the scenario.
std::vector<scenario::Override> overrides_of(const SweepAxes& axes, const SweepPoint& point);

/// How many points a grid has; nothing if they are more than `most`.
std::optional<std::size_t> grid_size(const SweepAxes& axes, std::size_t most);
/// All points of the grid, the last axis fastest.
std::vector<SweepPoint> grid(const SweepAxes& axes);
/// The first `count` points of a Sobol sequence over the ranges: they fill them evenly, whatever the count.
std::vector<SweepPoint> sobol(const SweepAxes& axes, std::size_t count);
/// Those points as shares of so many ranges, at most sobol_axes: 0 to below 1.
std::vector<std::vector<double>> sobol_shares(std::size_t axes, std::size_t count);
inline constexpr std::size_t sobol_axes = 3667;

}  // namespace drycut::sim::studies
