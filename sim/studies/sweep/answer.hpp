#pragma once
#include <string>
#include <vector>

#include "sim/studies/sweep/study.hpp"

namespace drycut::sim::studies {

// What an envelope answers, in words: the same on the console and on its page.

/// The bound in digits that the tolerance warrants, on the side that holds: a largest value is rounded down,
/// a smallest up. "none" where it holds nowhere.
std::string bound_text(const BoundRequest& request, const Bound& bound);
/// "Largest variables.speed"
std::string sought_text(const Envelope& envelope);
/// "; holds from 23.5 m/min, not below; holds again at 120.3 m/min"; "" where all but the bound is plain.
std::string elsewhere_text(const BoundRequest& request, const Bound& bound);
/// "500 mm: 105.8 m/min, then blade at web speed in the cut", of one of its points.
std::string point_answer(const Envelope& envelope, std::size_t point);
/// "86.2 to 140 m/min", of all points that have a bound; "none".
std::string span_text(const Envelope& envelope);
/// "Largest variables.speed: 105.8 m/min (± 0.9 m/min, rounded down); above it fails: blade at web speed in
/// the cut". Of several points the span, and how many fail of what.
std::string headline(const Envelope& envelope);
/// Of all values that were looked at.
std::vector<PointRow::Verdict> verdicts_of(const Envelope& envelope);

}  // namespace drycut::sim::studies
