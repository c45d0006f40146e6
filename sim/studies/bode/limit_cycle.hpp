#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "sim/studies/bode/loop.hpp"

namespace drycut::sim::studies {

// Where a limit cycle begins. Play, stiction and limits make the response depend on the amplitude of the
// sine. Measured at one amplitude after the other it is the describing function of the whole loop, and the
// harmonic balance says: an oscillation can keep itself up where the gain in force reaches the gain margin at
// that amplitude. The least margin over all amplitudes is the gain from which on a limit cycle exists; a
// disturbance that is too small for it still dies out there.
//
// A sine that is too small for the play does not move the load, and next to that edge the loop has two
// answers to one sine: so the least margin of the sines is an upper bound only. What is measured besides is
// the oscillation itself: hunting.hpp.

/// The gain margin as one amplitude finds it.
struct AmplitudeMargin {
  LoopResult loop;
  std::optional<AtFrequency> gain;  ///< [dB]; absent: not met, or not to be trusted there
  [[nodiscard]] double amplitude() const { return loop.plan.amplitude; }  ///< of the sine [V]
};

struct LimitCycle {
  std::vector<AmplitudeMargin> margins;  ///< in ascending order of amplitude
  std::optional<std::size_t> least;      ///< of `margins`
  bool at_end = false;                   ///< the least lies at an end of the amplitudes: beyond may be less
  std::optional<HuntingPoint> hunting;   ///< what pushes have found

  /// The amplitude of the least margin, where the next smaller one gave none: the bound may lie there [V];
  /// else 0.
  [[nodiscard]] double unknown_below() const;
  /// The gain from which an oscillation keeps itself up, times that in force: of the pushes, or else the
  /// least of the sines, which is an upper bound only. Absent: neither has found one.
  [[nodiscard]] std::optional<double> from() const;
};

/// Measures `scenario` with amplitudes from 0.05 V to 6.4 V in octaves, then twice between the neighbours of
/// the least. nullopt and problems if the request does not fit; its amplitude is not looked at.
std::optional<LimitCycle> find_limit_cycle(const scenario::Scenario& scenario, const LoopRequest& request,
                                           Problems& problems,
                                           const std::function<void(double)>& progress = {});

/// How many times the gain in force.
double factor_of(const AtFrequency& margin);

}  // namespace drycut::sim::studies
