#pragma once
#include <array>
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
    fits,       ///< every check and every rating holds at every corner, with `good_reserve` or more
    close,      ///< the same with less
    falls_out,  ///< one does not hold
    ruled_out   ///< it cannot be set up, or there is no run of it
  };
  Kind kind = Kind::ruled_out;
  std::string reason;   ///< why it falls out
  std::string where;    ///< at which corner, and at how many more
  double reserve = 0;   ///< least distance to a rating over all corners, below 0: beyond it [%]; NaN = none
  std::string nearest;  ///< that rating
  std::string hardest;  ///< its corner
  std::array<double, ratings.size()> shares = {};  ///< the largest over the corners [%]; NaN = none
  double energy = 0;               ///< of a cycle, the largest over the corners [J]; NaN = none
  std::vector<RatedDrive> drives;  ///< at each corner, where it ran
};
inline constexpr double good_reserve = 10;  // [%]
std::string_view name_of(Sized::Kind kind);

/// Runs all candidates at all corners and judges them, in their order.
std::vector<Sized> size_drives(const PointQuestion& question, const std::vector<Candidate>& candidates,
                               const std::vector<Corner>& corners, PointStore& store,
                               const StudyProgress& progress);

/// Who comes first: what fits with good reserve, what fits, what falls out, what is ruled out; of what fits
/// the smallest motor (rated power), the smallest brake resistor, the largest reserve, the least energy; of
/// what falls out the nearest to its limits. Equal ones stay as they are.
std::vector<std::size_t> ranked(const std::vector<Candidate>& candidates, const std::vector<Sized>& sized);

/// size.csv: a row a candidate, in that order.
std::string size_csv(const std::vector<Candidate>& candidates, const std::vector<Sized>& sized,
                     const std::vector<std::size_t>& order);

}  // namespace drycut::sim::studies
