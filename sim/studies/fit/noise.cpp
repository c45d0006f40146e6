#include "sim/studies/fit/noise.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "plants/random.hpp"
#include "sim/studies/fit/signal.hpp"

namespace drycut::sim::studies {

namespace {

/// What was read of the motor or load: places, or what each speed adds to them.
std::vector<double> readings_of(const ReplaySeries& series) {
  auto readings = series.motion.value;
  if (series.summed)
    for (std::size_t i = readings.size(); i-- > 1;) readings[i] -= readings[i - 1];
  return readings;
}

/// What readings are rounded to: the least by which their differences differ, whatever the speed; 0 where
/// they never do.
double step_of(const std::vector<double>& readings) {
  constexpr double rounding = 1e-7;  // of a double, over the largest
  std::vector<double> bends;
  for (std::size_t i = 2; i < readings.size(); ++i)
    bends.push_back(std::abs(readings[i] - 2 * readings[i - 1] + readings[i - 2]));
  const double most = bends.empty() ? 0 : std::ranges::max(bends);
  double least = most;
  for (const double bend : bends)
    if (bend > rounding * most) least = std::min(least, bend);
  return least;
}

}  // namespace

double motion_noise(const ReplaySeries& series) {
  const auto readings = readings_of(series);
  std::vector<double> bends;
  for (std::size_t i = 4; i < readings.size(); ++i)
    bends.push_back(std::abs(readings[i] - 4 * readings[i - 1] + 6 * readings[i - 2] - 4 * readings[i - 3] +
                             readings[i - 4]));
  // Of white noise fourth differences have 70 times the variance; half of them are below 0.6745 deviations.
  const double white = bends.empty() ? 0 : middle_of(std::move(bends)) / 0.6745 / std::sqrt(70.0);
  return std::max(white, step_of(readings) / std::sqrt(12.0));
}

double resolved_up_to(const ReplaySeries& series, const Plausible& about, double share) {
  const double gain = about.inertia / std::abs(about.scale);
  const double noise = motion_noise(series);
  if (!(gain * noise > 0)) return std::numeric_limits<double>::infinity();
  // The torque of a place that swings is inertia times the square of its frequency, that of a speed inertia
  // times frequency.
  const double allowed = share * rms_of(series.torque.value) / gain;
  const double omega = series.summed ? allowed / (noise / series.sampling) : std::sqrt(allowed / noise);
  return omega / (2 * std::numbers::pi);
}

ReplaySeries with_noise_again(ReplaySeries series, std::uint64_t seed) {
  plants::Random random(seed, "motion");
  const double deviation = motion_noise(series);
  double sum = 0;
  for (double& value : series.motion.value) {
    const double noise = deviation * random.gaussian();
    value += series.summed ? sum += noise : noise;
  }
  return series;
}

}  // namespace drycut::sim::studies
