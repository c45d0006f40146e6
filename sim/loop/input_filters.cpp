#include "sim/loop/bus.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/state_archive.hpp"

namespace drycut::sim::loop {

namespace {

constexpr double calm_time = 0.1;  // [s]
constexpr double rounding = 1e-9;  // [s]: a sum of steps misses a whole time by less

}  // namespace

const plants::EncoderPort* InputFilters::counter(const plants::EncoderPort* from, std::string terminal,
                                                 double hertz) {
  return &counters_.emplace_back(CounterFilter{from, std::move(terminal), hertz}).to;
}

const plants::SignalPort* InputFilters::zero_pulse(const plants::SignalPort* from, std::string terminal,
                                                   double seconds) {
  return &pulses_.emplace_back(PulseFilter{from, std::move(terminal), seconds}).to;
}

const plants::SignalPort* InputFilters::input(const plants::SignalPort* from, double seconds) {
  auto& filter = levels_.emplace_back(LevelFilter{from, seconds});
  filter.to.level = from->level;
  return &filter.to;
}

void InputFilters::pass(double h) {
  for (auto& filter : counters_) pass(filter, h);
  for (auto& filter : pulses_) pass(filter, h);
  for (auto& filter : levels_) pass(filter, h);
}

void InputFilters::pass(CounterFilter& filter, double h) {
  const auto& from = *filter.from;
  const double most = 4 * filter.hertz * h;
  const double way = from.now - from.before;
  const double beyond = way - std::clamp(way, -most, most);
  filter.to.before = from.before - filter.behind;
  filter.behind += beyond;
  filter.to.now = from.now - filter.behind;
  filter.to.count = filter.to.count_at(1);
  if (beyond == 0) {
    filter.calm += h;
    return;
  }
  filter.lost += std::abs(beyond);
  if (std::exchange(filter.calm, 0) >= calm_time)
    losses_.push_back({"counts_lost", fmt::format("{}: {:.4g} Hz of one phase, the card follows {:g} Hz",
                                                  filter.terminal, std::abs(way) / (4 * h), filter.hertz)});
}

void InputFilters::pass(PulseFilter& filter, double h) {
  filter.to.edges.clear();
  filter.to.level = filter.from->level;
  bool swallow = false;
  for (const auto& edge : filter.from->edges) {
    const bool tells_width = edge.rising && edge.width > 0;
    if (edge.rising) swallow = tells_width && edge.width * h < filter.least;
    if (!swallow) {
      filter.to.edges.push_back(edge);
      filter.losing = false;
    } else if (edge.rising) {
      ++filter.lost;
      if (!std::exchange(filter.losing, true))
        losses_.push_back(
            {"pulse_lost", fmt::format("{}: a zero pulse of {:.3g} us, the card needs {:g} us",
                                       filter.terminal, edge.width * h * 1e6, filter.least * 1e6)});
    }
  }
}

void InputFilters::pass(LevelFilter& filter, double h) {
  const auto& from = *filter.from;
  if (from.level == filter.to.level) {
    filter.lasted = 0;
    return;
  }
  filter.lasted = from.edges.empty() ? filter.lasted + h : (1 - from.edges.back().fraction) * h;
  if (filter.lasted + rounding >= filter.delay) {
    filter.to.level = from.level;
    filter.lasted = 0;
  }
}

std::vector<Finding> InputFilters::lost() const {
  std::vector<Finding> all;
  for (const auto& filter : counters_)
    if (filter.lost > 0)
      all.emplace_back("controller.counts-lost"_code,
                       fmt::format("{} lost {:.0f} counts beyond {:g} Hz of one phase", filter.terminal,
                                   filter.lost, filter.hertz));
  for (const auto& filter : pulses_)
    if (filter.lost > 0)
      all.emplace_back("controller.pulses-lost"_code,
                       fmt::format("{} lost {} zero pulses shorter than {:g} us", filter.terminal,
                                   filter.lost, filter.least * 1e6));
  return all;
}

void InputFilters::visit(StateArchive& archive) {
  archive.each("counters_", counters_, [&](CounterFilter& filter) {
    STATE(archive, filter.to, filter.behind, filter.lost, filter.calm);
  });
  archive.each("pulses_", pulses_,
               [&](PulseFilter& filter) { STATE(archive, filter.to, filter.lost, filter.losing); });
  archive.each("levels_", levels_, [&](LevelFilter& filter) { STATE(archive, filter.to, filter.lasted); });
  archive.list("losses_", losses_, [&](Loss& loss) { STATE(archive, loss.event, loss.text); });
}

}  // namespace drycut::sim::loop
