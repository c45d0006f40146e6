#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "sim/studies/size/candidate.hpp"
#include "sim/studies/size/corner.hpp"
#include "sim/studies/sweep/rated_drive.hpp"
#include "sim/studies/sweep/store.hpp"

namespace drycut::sim::studies {

/// What came of a candidate.
struct Sized {
  enum class Kind {
    fits,          ///< every check and every rating holds at every corner, with `good_reserve` or more
    close,         ///< the same with less
    does_not_fit,  ///< one does not hold
    ruled_out      ///< it cannot be set up, or there is no run of it
  };
  Kind kind = Kind::ruled_out;
  std::string reason;  ///< why it does not fit, at the corner that is farthest from it
  std::string where;   ///< that corner, and how many more
  // Over all corners. NaN where a run ended early at one of them: what it would use there is not known.
  double reserve = 0;                              ///< least distance to a rating, below 0: beyond it [%]
  std::string nearest;                             ///< that rating
  std::string hardest;                             ///< its corner
  std::array<double, ratings.size()> shares = {};  ///< the largest [%]; NaN also: not judged
  double energy = 0;                               ///< of a cycle, the largest [J]
  std::vector<std::optional<RatedDrive>> drives;   ///< at each corner; none where a run ended early
  /// How far it is from fitting, where it does not.
  struct Distance {
    std::size_t unknown = 0;  ///< corners of which nobody can say: it would stop there with any motor
    /// The largest share of a rating beyond 100 %, 0 = none: as measured, or as needs.hpp finds it [%].
    double short_by = 0;
    std::string rating;       ///< that one; "" = none
    std::string corner;       ///< its corner
    std::size_t corners = 0;  ///< where something does not hold
  } distance = {};
};
inline constexpr double good_reserve = 10;  // [%]
std::string_view name_of(Sized::Kind kind);

/// Runs all candidates at all corners and judges them, in their order. What does not hold runs once more with
/// a motor without limits (needs.hpp).
std::vector<Sized> size_drives(const PointQuestion& question, const SizedDrive& drive,
                               const std::vector<Candidate>& candidates, const std::vector<Corner>& corners,
                               PointStore& store, const StudyProgress& progress);

/// Who comes first: what fits with good reserve, what fits, what does not fit, what is ruled out; of what
/// fits the smallest motor (rated power), the smallest brake resistor, the largest reserve, the least energy;
/// of what does not fit the nearest to fitting: the fewest corners of which nothing is known, then short by
/// the least, then the fewest corners where something does not hold; of what is ruled out the nearest to the
/// limit of the inertia ratio. Equal ones stay as they are.
std::vector<std::size_t> ranked(const std::vector<Candidate>& candidates, const std::vector<Sized>& sized);

/// size.csv: a row a candidate, in that order.
Table size_table(const std::vector<Candidate>& candidates, const std::vector<Sized>& sized,
                 const std::vector<std::size_t>& order);

}  // namespace drycut::sim::studies
