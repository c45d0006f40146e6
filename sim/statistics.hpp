#pragma once
#include <array>
#include <vector>

namespace drycut::sim {

/// Statistics of a series of event values, as an `all` check names them: mean_length, sd_length ...
/// slope is the least-squares change from one event to the next, slope_error its standard error.
inline constexpr std::array<const char*, 6> statistic_names = {"mean", "min",   "max",
                                                               "sd",   "slope", "slope_error"};

/// In the order of statistic_names; sd and slope_error are those of a sample (n - 1, n - 2). Empty series
/// give zeros, and so does what too short a series cannot give.
std::array<double, 6> statistics(const std::vector<double>& numbers);

}  // namespace drycut::sim
