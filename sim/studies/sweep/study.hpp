#pragma once
#include <string>
#include <vector>

#include "sim/studies/sweep/axis.hpp"
#include "sim/studies/sweep/point.hpp"
#include "sim/studies/sweep/store.hpp"

namespace drycut::sim::studies {

/// A study of more points than this is a slip of the keyboard.
inline constexpr std::size_t most_points = 1'000'000;

/// The points of a grid over the axes, or `sampled` of a Sobol sequence. Fills the axes in from the scenario
/// (units, whole numbers, values) and tells what is wrong with them: a path that the scenario does not know,
/// a unit of another dimension or none, ends none of which it takes, too many points. Nothing if there are
/// `problems` already.
std::vector<SweepPoint> planned(SweepAxes& axes, std::optional<std::size_t> sampled,
                                const PointQuestion& question, Problems& problems);

/// The rows of points, in their order, whoever runs them when.
std::vector<PointRow> sweep(const PointQuestion& question, const SweepAxes& axes,
                            const std::vector<SweepPoint>& points, PointStore& store,
                            const StudyProgress& progress);
/// A row a point: its values on the axes, verdict, limit, rating, the question's numbers.
Table sweep_table(const PointQuestion& question, const SweepAxes& axes, const std::vector<SweepPoint>& points,
                  const std::vector<PointRow>& rows);

/// A value of the sought parameter that was looked at.
struct ValueLook {
  double value = 0;
  PointRow::Verdict verdict = PointRow::Verdict::passed;
};

/// The largest value of a parameter up to which every check and every rating holds, or the smallest down to
/// which: what is said of the largest is then meant the other way round.
struct Bound {
  enum class Kind {
    found,       ///< it holds up to `value`, and no more than `tolerance` above it does not
    throughout,  ///< it holds up to the end of the range
    nowhere      ///< it holds at none of the values that were looked at
  };
  Kind kind = Kind::nowhere;
  double value = 0;  ///< NaN = nowhere
  double from = 0;   ///< the least value looked at that holds, as all do from there to `value`; NaN = nowhere
  PointRow beyond;   ///< the row just above the bound, or of a value that fails
  std::vector<double> numbers;                  ///< of the row at `value`
  std::vector<std::pair<double, double>> gaps;  ///< beyond the bound: fails from here to there, then holds
  std::optional<double> again;                  ///< beyond the bound it holds again, here
  std::vector<ValueLook> looks;                 ///< all of them, ascending
};
std::string_view name_of(Bound::Kind kind);

/// What is sought at every point.
struct BoundRequest {
  TunedParameter parameter;
  double tolerance = 0;  ///< in the parameter's unit
  bool least = false;    ///< the smallest value is sought, else the largest
};
/// The decimal that a tolerance warrants: 0.1 of 0.9, 1 of 5.
double warranted_step(double tolerance);
/// Reads PATH=LO..HI UNIT[:TOLERANCE]; the tolerance is a two-hundredth of the range unless it is given.
std::optional<BoundRequest> parse_bound(const std::string& text, const std::string& option, bool least,
                                        Problems& problems);

/// What is sought of one scene, and what was found.
struct Envelope {
  std::string scene;  ///< what it is called among others
  PointQuestion question;
  SweepAxes axes;
  BoundRequest request;
  std::vector<SweepPoint> points = {};
  std::vector<Bound> bounds = {};  ///< one a point
};

/// Why one of them may hold again beyond its bound; "" where none does.
std::string_view why_again(const std::vector<Envelope>& envelopes);

/// The points of its axes, as above, with what is sought in place of a last axis.
std::vector<SweepPoint> planned(Envelope& envelope, Problems& problems);

/// Looks at nine values from end to end, at 17 and 33 where none of them holds, and halves the interval in
/// which what held first gives way. Then it looks below the bound: no stretch stays that is wider than a
/// sixteenth of the range, or than a quarter of what lies between its lower end and the bound, so that what
/// an offer would use is looked at closest. What fails there is the end of a lower bound, and so on. Of a
/// smallest value all this is the other way round.
inline constexpr int scanned_values = 9;
inline constexpr double widest_share = 1.0 / 16;   ///< of the range
inline constexpr double distance_share = 1.0 / 4;  ///< of the way to the bound
void seek(Envelope& envelope, PointStore& store, const StudyProgress& progress);
/// A row a point; of several scenes with the columns of all of them, the first of them "scene".
Table envelope_table(const std::vector<Envelope>& envelopes);

}  // namespace drycut::sim::studies
