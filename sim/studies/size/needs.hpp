#pragma once
#include <array>
#include <vector>

#include "plants/power_stage.hpp"
#include "sim/studies/size/choices.hpp"
#include "sim/studies/sweep/rated_drive.hpp"

namespace drycut::sim::studies {

// What a corner needs of a motor that is too weak for it. Its own run cannot say: it was held back by the
// torque limit, or it ended before a piece was cut. The same machine with the same inertias runs there once
// more with a motor that knows no limits.

/// What takes the limits away, to be set behind what sets up a candidate. None of an induction motor, which
/// goes with its curve.
std::vector<scenario::Override> without_limits(const SizedDrive& drive);

/// Torque and speed that were needed, in that run, beside what the candidate is rated for; the share of all
/// other ratings is NaN. Peak torque is compared with that up to rated speed. Without `peaks` rms torque
/// alone.
std::array<RatedDrive::Figure, ratings.size()> needs_of(const RatedDrive& unlimited,
                                                        const plants::DriveRatings& rated, bool peaks);

}  // namespace drycut::sim::studies
