#pragma once
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "sim/studies/compare/run_folder.hpp"

namespace drycut::sim::studies {

// Pieces of several runs are laid beside each other by their order behind each run's start-up.

/// When a run's events count [s], both ends included.
struct Window {
  double from = 0;
  double until = std::numeric_limits<double>::infinity();
};
/// For a value of an event, "knife.cut": from `from` on if it is given; else in the window of the plot that
/// states its limits, or those of another value of the event, but not before the first check begins that
/// looks at the event later than from the start.
Window window_of(const ComparedRun& run, const std::string& event, const std::string& value,
                 std::optional<double> from);

/// When the start-up of a run is over [s]: the last of its events to count begins to. For channels.
double settled(const ComparedRun& run);

/// Pieces of one length made one after the other, by their place in a list.
struct Lot {
  std::size_t first = 0;
  std::size_t count = 0;
};
/// A lot ends where two pieces in a row are another length than its own: further from its mean than
/// `lot_change` of it. One such piece alone is a bad one, not a lot.
inline constexpr double lot_change = 0.01;
std::vector<Lot> lots_of(const std::vector<double>& lengths);

}  // namespace drycut::sim::studies
