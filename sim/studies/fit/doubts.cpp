#include "sim/studies/fit/doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/studies/fit/signal.hpp"

namespace drycut::sim::studies {

namespace {

using Role = Finding::Role;

double steps_of(const recordings::Series& series) {
  double step = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < series.value.size(); ++i)
    if (series.value[i] != series.value[i - 1])
      step = std::min(step, std::abs(series.value[i] - series.value[i - 1]));
  const auto [low, high] = std::ranges::minmax(series.value);
  return (high - low) / step;
}

/// Work that the torque did on the motion over all work, whatever its direction: friction takes some, so it
/// is above 0.
double share_of_work(const ReplaySeries& series, double scale) {
  if (!(series.until > series.from)) return 0;
  const auto count = static_cast<std::size_t>((series.until - series.from) / series.sampling);
  const auto torque = resampled(series.torque, series.from, series.sampling, count);
  const auto motion = resampled(series.motion, series.from, series.sampling, count);
  double work = 0;
  double all = 0;
  for (std::size_t i = 1; i < count; ++i) {
    const double part = (torque[i] + torque[i - 1]) / 2 * (motion[i] - motion[i - 1]);
    work += part;
    all += std::abs(part);
  }
  return all > 0 ? (scale < 0 ? -work : work) / all : 0;
}

void doubt_signs(const FitBench& bench, std::size_t i, std::vector<Finding>& found) {
  constexpr double backwards = -0.1;
  constexpr double apart = 0.05;
  const auto& one = bench.recordings()[i];
  if (!bench.question().closed && share_of_work(one, bench.answer(i).scale) < backwards)
    found.emplace_back(
        "fit.sign"_code,
        fmt::format("{}: the torque works against the motion most of the time, as no friction would have "
                    "it: the sign of torque or motion is another (sign: -1 of one of them)",
                    one.name()),
        Role::warning);
  if (one.counts_over_speed && std::abs(*one.counts_over_speed - 1) > apart)
    found.emplace_back(
        "fit.contradiction"_code,
        fmt::format("{0}: {1}.encoder.count moves {2:.3g} times as far as {1}.motor.speed says: "
                    "encoder.lines of the scenario (counts are four times as many), or a unit or sign "
                    "is another",
                    one.name(), one.plant, *one.counts_over_speed),
        Role::warning);
}

void doubt_resolution(const FitBench& bench, std::size_t i, std::vector<Finding>& found) {
  const auto& one = bench.recordings()[i];
  for (const auto* series : {&one.torque, &one.motion}) {
    constexpr double fewest = 100;
    const double steps = steps_of(*series);
    if (steps < fewest)
      found.emplace_back("fit.coarse"_code,
                         fmt::format("{}: {} has {:.0f} steps from its least to its largest value; record it "
                                     "with a finer resolution",
                                     one.name(), series->channel, steps),
                         Role::warning);
    if (!series->clipped.empty())
      found.emplace_back("fit.clipped"_code,
                         fmt::format("{}: {} samples of {} are at the limit of what could be recorded; what "
                                     "happened around them was left out",
                                     one.name(), series->clipped.size(), series->channel),
                         Role::warning);
  }
  constexpr double almost = 0.14;
  const double bandwidth = bandwidth_of(one.torque);
  if (bandwidth * one.sampling > almost / 1.25)
    found.emplace_back(
        "fit.slow"_code,
        fmt::format("{}: the torque changes as fast as it was sampled, every {:.3g} ms; record "
                    "at a higher rate, or move more gently",
                    one.name(), one.sampling * 1000),
        Role::warning);
  for (const auto& channel : one.unused)
    found.emplace_back("fit.unused-channel"_code, fmt::format("{}: {} is not used", one.name(), channel));
  if (const double resolved = bench.resolved(i); resolved < bandwidth)
    found.emplace_back(
        "fit.coarse"_code,
        fmt::format(
            "{}: above {:.3g} Hz what the motion is rounded to is worth more than {:.0f} % of the torque; "
            "only what is below counts. Springs and play show above: record a finer position, or "
            "the speed that the drive measures",
            one.name(), resolved, bench.noise_share() * 100));
}

}  // namespace

std::vector<Finding> doubts_of(const FitBench& bench) {
  std::vector<Finding> found;
  for (std::size_t i = 0; i < bench.recordings().size(); ++i) {
    doubt_signs(bench, i, found);
    doubt_resolution(bench, i, found);
  }
  return found;
}

}  // namespace drycut::sim::studies
