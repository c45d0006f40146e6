#include "sim/studies/bode/limit_cycle.hpp"

#include <algorithm>
#include <cmath>

namespace drycut::sim::studies {

namespace {

constexpr double lowest_amplitude = 0.05;  // some tens of steps of a 14 bit converter [V]
constexpr int octaves = 7;
constexpr int refinements = 2;
constexpr double least_sure = 0.1;  // error of a gain that a margin is read from: 1 dB

/// The gain margin, if both points beside it are sound.
std::optional<AtFrequency> sound_margin(const LoopResult& result) {
  const auto& margin = result.margins.gain;
  if (!margin || result.sweep.loop != Sweep::Loop::closed) return {};
  const auto& points = result.sweep.points;
  const auto after = std::find_if(points.begin(), points.end(), [&](const BodePoint& point) {
    return point.frequency >= margin->frequency;
  });
  if (after == points.begin() || after == points.end()) return {};
  for (const auto* point : {&*after, &*std::prev(after)})
    if (point->silent || point->saturated || !(point->error <= least_sure) ||
        !(point->doubt() <= bode_error_limit))
      return {};
  return margin;
}

void find_least(LimitCycle& cycle) {
  cycle.least.reset();
  for (std::size_t i = 0; i < cycle.margins.size(); ++i) {
    const auto& gain = cycle.margins[i].gain;
    if (gain && (!cycle.least || gain->value < cycle.margins[*cycle.least].gain->value)) cycle.least = i;
  }
  cycle.at_end = cycle.least && (*cycle.least == 0 || *cycle.least + 1 == cycle.margins.size());
}

}  // namespace

double LimitCycle::unknown_below() const {
  if (!least || *least == 0 || margins[*least - 1].gain) return 0;
  return margins[*least].amplitude();
}

std::optional<double> LimitCycle::from() const {
  if (hunting && hunting->from) return hunting->from;
  return least ? std::optional(factor_of(*margins[*least].gain)) : std::nullopt;
}

double factor_of(const AtFrequency& margin) { return std::pow(10, margin.value / 20); }

std::optional<LimitCycle> find_limit_cycle(const scenario::Scenario& scenario, const LoopRequest& request,
                                           Problems& problems, const std::function<void(double)>& progress) {
  constexpr double all = octaves + 1 + 2 * refinements;
  LimitCycle cycle;
  const auto measure_at = [&](double amplitude) {
    auto at = request;
    at.amplitude = amplitude;
    at.pushes = false;
    const auto before = static_cast<double>(cycle.margins.size());
    auto result = measure_loop(scenario, at, problems, [&](double done) {
      if (progress) progress((before + done) / all);
    });
    if (!result) return false;
    const auto gain = sound_margin(*result);
    cycle.margins.push_back({std::move(*result), gain});
    return true;
  };
  for (int i = 0; i <= octaves; ++i)
    if (!measure_at(lowest_amplitude * std::exp2(i))) return {};
  find_least(cycle);
  for (int i = 0; i < refinements && cycle.least; ++i) {
    const auto amplitude = [&](std::size_t index) { return cycle.margins[index].amplitude(); };
    const auto least = *cycle.least;
    std::vector<double> between;
    if (least > 0) between.push_back(std::sqrt(amplitude(least - 1) * amplitude(least)));
    if (least + 1 < cycle.margins.size())
      between.push_back(std::sqrt(amplitude(least) * amplitude(least + 1)));
    for (const double next : between)
      if (!measure_at(next)) return {};
    std::sort(cycle.margins.begin(), cycle.margins.end(),
              [](const auto& a, const auto& b) { return a.amplitude() < b.amplitude(); });
    find_least(cycle);
  }
  const double period = cycle.least ? 1 / cycle.margins[*cycle.least].gain->frequency : 0;
  cycle.hunting = push_loop(scenario, request, period, problems);
  return cycle;
}

}  // namespace drycut::sim::studies
