#pragma once
#include <cstdint>

#include "sim/studies/fit/replay.hpp"

namespace drycut::sim::studies {

// A recorded motion is rounded to counts, or noisy. A replay takes that for motion: what accelerates by it,
// such as a mass, comes out too small, and nothing in the residuals tells. So a fit is done again with as
// much noise added; what moves a value then has moved it already.

/// Standard deviation of what is no motion in a recorded one: of rounding to its steps, or of the noise that
/// its fourth differences tell, whichever is larger [its unit]; where speeds were added up, that of what each
/// sample adds.
double motion_noise(const ReplaySeries& series);

/// Up to where such noise is worth less than `share` of the torque [Hz], infinite where there is none.
double resolved_up_to(const ReplaySeries& series, const Plausible& about, double share);

/// The series with as much noise again in its motion, another one a `seed`.
ReplaySeries with_noise_again(ReplaySeries series, std::uint64_t seed);

}  // namespace drycut::sim::studies
