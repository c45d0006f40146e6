#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "sim/loop/statistics.hpp"

namespace drycut::sim::report {

// What comes back regularly in the values of an event, found by least squares (Lomb, floating mean) from
// where on the web they were: pieces sample an error once each, so that several periods fit pieces of one
// length.

/// Values over places. Places are counted in metres of web, or in events.
struct SampledValues {
  std::vector<double> places;       ///< of the middle of what the value is about, ascending
  std::vector<double> values;       ///< less the mean of their order
  std::vector<std::size_t> orders;  ///< number of the order that each belongs to: pieces of one length
  std::size_t order_count = 0;
};

/// The last 500 at most of `numbers`, each that of a piece of these `lengths` [m], as many, in their order;
/// or without lengths of one event after the other. An order ends where the length goes by more than a
/// fiftieth; orders of less than five pieces are left out.
SampledValues sampled(const std::vector<double>& numbers, const std::vector<double>& lengths);

/// A sine among the values.
struct Sine {
  double frequency = 0;  ///< [1/place]
  double amplitude = 0;  ///< in the values' unit
  double explains = 0;   ///< share of the values' variance, 0..1
};
/// The sine of that frequency that fits best; explains nothing where the values cannot tell one.
Sine fitted(const SampledValues& values, double frequency);

/// A sine that chance does not make (once in a thousand times) and that is a thousandth of the variance at
/// least, strongest first.
struct SpectrumPeak {
  Sine sine;
  std::vector<double> others;  ///< frequencies that fit as well, from the lowest on: the pieces fold them
  /// Of the frequencies asked about, those that it may be.
  std::vector<std::size_t> known;
};

struct Spectrum {
  std::vector<double> frequencies;  ///< [1/place], evenly, from the lowest that the values can tell
  std::vector<double> amplitudes;   ///< of the sines that fit best, one a frequency
  std::vector<SpectrumPeak> peaks;
};
/// Up to `highest` [1/place]; at most four peaks. Nothing for less than ten values.
Spectrum spectrum_of(const SampledValues& values, double highest, const std::vector<double>& known);

}  // namespace drycut::sim::report
