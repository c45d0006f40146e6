#include "sim/studies/fit/signal.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace drycut::sim::studies {

namespace {

/// Standard deviation of the Gaussian window [s].
double width_of(double cutoff) { return std::sqrt(std::numbers::ln2) / (2 * std::numbers::pi * cutoff); }
constexpr double widths = 4;

double middle_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

double rms_of(const std::vector<double>& values) {
  return std::sqrt(std::inner_product(values.begin(), values.end(), values.begin(), 0.0) /
                   static_cast<double>(values.size()));
}

}  // namespace

std::vector<double> resampled(const recordings::Series& series, double from_s, double step_s,
                              std::size_t count) {
  const auto& times = series.time_s;
  const auto& values = series.value;
  const std::size_t last = times.size() - 1;
  // By the parabola through a sample and its neighbours.
  const auto slope = [&](std::size_t i) {
    if (i == 0) return (values[1] - values[0]) / (times[1] - times[0]);
    if (i == last) return (values[last] - values[last - 1]) / (times[last] - times[last - 1]);
    const double before = times[i] - times[i - 1];
    const double after = times[i + 1] - times[i];
    return ((values[i] - values[i - 1]) / before * after + (values[i + 1] - values[i]) / after * before) /
           (before + after);
  };
  std::vector<double> at(count);
  std::size_t i = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double t = from_s + static_cast<double>(k) * step_s;
    if (t <= times.front()) {
      at[k] = values.front();
      continue;
    }
    if (t >= times.back()) {
      at[k] = values.back();
      continue;
    }
    while (times[i + 1] < t) ++i;
    const double wide = times[i + 1] - times[i];
    const double share = (t - times[i]) / wide;
    const double rest = 1 - share;
    at[k] = rest * rest * (1 + 2 * share) * values[i] + share * share * (3 - 2 * share) * values[i + 1] +
            wide * share * rest * (rest * slope(i) - share * slope(i + 1));
  }
  return at;
}

std::vector<double> straight(const recordings::Series& series, double from_s, double step_s,
                             std::size_t count) {
  std::vector<double> at(count, series.value.front());
  if (series.time_s.size() == 1) return at;
  std::size_t i = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double t =
        std::clamp(from_s + static_cast<double>(k) * step_s, series.time_s.front(), series.time_s.back());
    while (i + 2 < series.time_s.size() && series.time_s[i + 1] < t) ++i;
    const double share = (t - series.time_s[i]) / (series.time_s[i + 1] - series.time_s[i]);
    at[k] = std::lerp(series.value[i], series.value[i + 1], share);
  }
  return at;
}

double sampling_of(const recordings::Series& series) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < series.time_s.size(); ++i)
    steps.push_back(series.time_s[i] - series.time_s[i - 1]);
  return middle_of(std::move(steps));
}

double reach_of(double cutoff) { return widths * width_of(cutoff); }

std::vector<double> smoothed(const std::vector<double>& values, double step_s, double cutoff) {
  const double width = width_of(cutoff) / step_s;
  const auto reach = static_cast<std::ptrdiff_t>(std::ceil(widths * width));
  std::vector<double> weights;
  for (std::ptrdiff_t i = 0; i <= reach; ++i)
    weights.push_back(std::exp(-0.5 * std::pow(static_cast<double>(i) / width, 2)));
  const auto size = static_cast<std::ptrdiff_t>(values.size());
  std::vector<double> smooth(values.size());
  for (std::ptrdiff_t k = 0; k < size; ++k) {
    double sum = 0;
    double whole = 0;
    for (std::ptrdiff_t j = std::max<std::ptrdiff_t>(0, k - reach); j <= std::min(size - 1, k + reach); ++j) {
      const double weight = weights[static_cast<std::size_t>(std::abs(j - k))];
      sum += weight * values[static_cast<std::size_t>(j)];
      whole += weight;
    }
    smooth[static_cast<std::size_t>(k)] = sum / whole;
  }
  return smooth;
}

double bandwidth_of(const recordings::Series& series) {
  const double step = sampling_of(series);
  const auto count = static_cast<std::size_t>((series.time_s.back() - series.time_s.front()) / step) + 1;
  const auto values = resampled(series, series.time_s.front(), step, count);
  std::vector<double> bends;
  for (std::size_t i = 2; i < values.size(); ++i)
    bends.push_back(std::abs(values[i] - 2 * values[i - 1] + values[i - 2]));
  // Of white noise the second differences have six times the variance; half of them are below 0.6745 times
  // their standard deviation.
  const double noise = bends.empty() ? 0 : middle_of(std::move(bends)) / 0.6745 / std::sqrt(6.0);
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(count);
  auto apart = values;
  for (double& value : apart) value -= mean;
  const double allowed = std::max(1.2 * noise, 0.02 * rms_of(apart));
  constexpr double least = 5;
  constexpr double finer = 1.25;
  const double most = 0.15 / step;
  double cutoff = std::min(least, most);
  while (cutoff * finer < most) {
    auto left = smoothed(apart, step, cutoff);
    for (std::size_t i = 0; i < count; ++i) left[i] -= apart[i];
    if (rms_of(left) <= allowed) break;
    cutoff *= finer;
  }
  return cutoff;
}

}  // namespace drycut::sim::studies
