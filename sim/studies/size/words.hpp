#pragma once
#include <string>
#include <vector>

#include "sim/studies/size/study.hpp"

namespace drycut::sim::studies {

// A sizing in sentences, as the terminal and the page have them.

/// All of a sizing.
struct SizeResult {
  const PointQuestion& question;
  const SizeChoices& choices;
  const std::vector<Candidate>& candidates;
  const std::vector<Corner>& corners;
  const std::vector<Sized>& sized;
  const std::vector<std::size_t>& order;  ///< ranked()
};

/// It holds everywhere.
bool fits(const Sized& one);
std::size_t count_fitting(const SizeResult& result);

/// "first: HG-SR202, gear 5, 23 % left of rms torque at length=500 mm"; where none fits "no motor of the
/// catalogue fits; nearest: HG-SR702, gear 4, 119 % short of rms torque at length=500 mm".
std::string best_words(const SizeResult& result);
/// "HG-SR52, gear 4 does not fit at length=500 mm: why"
std::string candidate_words(const Candidate& candidate, const Sized& one);
/// What a reader should know besides: whose inertia ratio was judged, gears that are left out, what a gear's
/// ratio does not change.
std::vector<Finding> size_notes(const SizeResult& result);

}  // namespace drycut::sim::studies
