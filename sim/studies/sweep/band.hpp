#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "renders/plots.hpp"
#include "renders/report.hpp"
#include "sim/studies/sweep/study.hpp"

namespace drycut::sim::studies {

// Where an envelope goes over the limits of a fit, its bound has a band: the least and the largest of the
// bounds at the corners of the limits.

/// The bounds at one point of the other axes.
struct BoundBand {
  SweepPoint at;                     ///< a value of each axis that is no limit of a fit
  std::vector<std::size_t> corners;  ///< the envelope's points there
  std::size_t nowhere = 0;           ///< how many of them hold nowhere
  /// Those of `corners` with the least and the largest bound; none where no corner has one.
  std::optional<std::size_t> lowest = {};
  std::optional<std::size_t> highest = {};
};

/// One a point of the other axes, in their order; empty where no axis is a limit of a fit.
std::vector<BoundBand> bands_of(const Envelope& envelope);

/// "500 mm: 86.2 to 88.1 m/min", of one of the bands; "none at 2 of 4 corners, else 86.2 m/min".
std::string band_answer(const Envelope& envelope, const BoundBand& band);
/// " at the 4 corners of the limits of out/fit/fit.json", behind what is said of all points; "" without.
std::string corners_text(const Envelope& envelope);

/// A row a band: its point, both ends, and the corner with the lower one.
renders::ReportTable band_table(const Envelope& envelope);
/// Both ends over the other axis; no panel where there is none, or more than one.
renders::Plot band_plot(const Envelope& envelope, const std::string& name);
/// What a corner is, and what it does not tell; "" where no envelope has a band.
std::string_view band_note(const std::vector<Envelope>& envelopes);

}  // namespace drycut::sim::studies
