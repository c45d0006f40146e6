#pragma once
#include <string>
#include <vector>

#include "sim/studies/sweep/axis.hpp"
#include "sim/studies/sweep/point.hpp"
#include "sim/studies/sweep/store.hpp"

namespace drycut::sim::studies {

/// A study of more points than this is a slip of the keyboard.
inline constexpr std::size_t most_points = 1'000'000;

/// Fills the axes in from the scenario (units, whole numbers, values) and tells what is wrong with them: a
/// path that the scenario does not know, a unit of another dimension, ends none of which it takes.
void check_axes(SweepAxes& axes, const PointQuestion& question, Problems& problems);
/// The points of a grid, or `sampled` of a Sobol sequence; too many are a problem.
std::vector<SweepPoint> points_of(const SweepAxes& axes, std::optional<std::size_t> sampled,
                                  Problems& problems);

/// The rows of points, in their order, whoever runs them when.
std::vector<PointRow> sweep(const PointQuestion& question, const SweepAxes& axes,
                            const std::vector<SweepPoint>& points, PointStore& store,
                            const StudyProgress& progress);
/// The heading of a table of points: the axes, `between`, the question's numbers.
std::string csv_heading(const PointQuestion& question, const SweepAxes& axes, const std::string& between);
/// As sweep.csv: a line a point, headed "variables.length [mm],verdict,limit,...".
std::string sweep_csv(const PointQuestion& question, const SweepAxes& axes,
                      const std::vector<SweepPoint>& points, const std::vector<PointRow>& rows);

/// The largest value of an axis at which every check and every rating holds.
struct Bound {
  enum class Kind {
    found,       ///< it holds up to `value`, and `tolerance` above it does not
    throughout,  ///< it holds up to the end of the range
    nowhere      ///< it holds at none of the values that were looked at
  };
  Kind kind = Kind::nowhere;
  double value = 0;             ///< NaN = nowhere
  double from = 0;              ///< the least value looked at from which on it holds; NaN = nowhere
  std::optional<double> again;  ///< beyond the bound it holds again, here
  std::string limit;            ///< what gives way behind the bound
  std::vector<double> numbers;  ///< of the row at `value`
};
std::string_view name_of(Bound::Kind kind);

/// What is sought at every point.
struct BoundRequest {
  TunedParameter parameter;
  double tolerance = 0;  ///< in the parameter's unit
};
/// Reads PATH=LO..HI UNIT[:TOLERANCE]; the tolerance is a two-hundredth of the range unless it is given.
std::optional<BoundRequest> parse_bound(const std::string& text, const std::string& option,
                                        Problems& problems);

/// Looks at nine values from end to end, at 17 and 33 where none of them holds, then halves the interval in
/// which what held first gives way.
inline constexpr int scanned_values = 9;
std::vector<Bound> envelope(const PointQuestion& question, const SweepAxes& axes,
                            const std::vector<SweepPoint>& points, const BoundRequest& request,
                            PointStore& store, const StudyProgress& progress);
std::string envelope_csv(const PointQuestion& question, const SweepAxes& axes,
                         const std::vector<SweepPoint>& points, const BoundRequest& request,
                         const std::vector<Bound>& bounds);

}  // namespace drycut::sim::studies
