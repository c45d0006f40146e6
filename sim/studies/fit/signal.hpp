#pragma once
#include <cstddef>
#include <vector>

#include "sim/recordings/recording.hpp"

namespace drycut::sim::studies {

/// A recorded series at equal intervals: the cubic through its samples and their slopes. Outside, it holds
/// its ends.
std::vector<double> resampled(const recordings::Series& series, double from_s, double step_s,
                              std::size_t count);
/// The same by straight lines: for what jumps.
std::vector<double> straight(const recordings::Series& series, double from_s, double step_s,
                             std::size_t count);
/// Usual time between two samples [s].
double sampling_of(const recordings::Series& series);

/// A low pass without phase, half the power at `cutoff` [Hz]: a Gaussian window. Its ends are those of what
/// there is.
std::vector<double> smoothed(const std::vector<double>& values, double step_s, double cutoff);
/// How far such a filter looks on either side [s].
double reach_of(double cutoff);

/// The frequency up to which a series is signal and not noise [Hz]: what is left above it is no more than
/// white noise of the size of its second differences.
double bandwidth_of(const recordings::Series& series);

}  // namespace drycut::sim::studies
