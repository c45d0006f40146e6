#pragma once
#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "sim/record/recording.hpp"

namespace drycut::sim::loop {

/// The numbers of a value of an event, in the order in which it happened.
struct EventNumbers {
  std::vector<double> times;  ///< [s]
  std::vector<double> order;  ///< which of the events each was, from 1 on, those of all times counted
  std::vector<double> numbers;
  std::string unit;
};
/// Of "cut" or "knife.cut", from one time to another [s], both included.
EventNumbers event_numbers(const record::EventLog& events, const std::string& event, const std::string& value,
                           double from = 0, double until = std::numeric_limits<double>::infinity());

/// Statistics of a series of event values, as an `all` check names them: mean_length, sd_length ...
/// slope is the least-squares change from one event to the next, slope_error its standard error.
inline constexpr std::array<const char*, 6> statistic_names = {"mean", "min",   "max",
                                                               "sd",   "slope", "slope_error"};

/// In the order of statistic_names; sd and slope_error are those of a sample (n - 1, n - 2). Empty series
/// give zeros, and so does what too short a series cannot give.
std::array<double, 6> statistics(const std::vector<double>& numbers);

/// How well a series lies between two limits: their distance over six standard deviations, and that of the
/// mean to the nearer one over three.
struct Capability {
  double cp = 0;
  double cpk = 0;
};
/// From the series' statistics(); nothing where it has no spread, as of one number.
std::optional<Capability> capability(const std::array<double, 6>& statistics, double low, double high);

}  // namespace drycut::sim::loop
