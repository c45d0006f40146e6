#include "sim/loop/hunting.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/state_archive.hpp"

namespace drycut::sim::loop {

namespace {

constexpr std::int64_t least_swing = 8;  // [bits x4] more than an encoder's last digit
constexpr std::size_t turns_kept = 7;    // three periods
constexpr double longest = 1.5;          // [s] they take: what goes to and fro slower works
constexpr double even = 0.6;             // of the largest swing is the smallest: less dies away, or moves

}  // namespace

Hunting::Hunting(devices::Controller& controller) {
  for (auto& loop : controller.position_loops())
    axes_.push_back({std::move(loop.name), std::move(loop.counts)});
}

void Hunting::sample(Time now) {
  for (auto& axis : axes_) {
    if (axis.since) continue;
    const auto counts = axis.counts();
    const auto ahead = axis.forward ? counts - axis.extreme.counts : axis.extreme.counts - counts;
    if (ahead >= 0) {
      if (ahead > 0 || axis.turns.empty()) axis.extreme = {seconds(now), counts};
      continue;
    }
    if (-ahead < least_swing) continue;
    axis.turns.push_back(axis.extreme);
    if (axis.turns.size() > turns_kept) axis.turns.pop_front();
    axis.forward = !axis.forward;
    axis.extreme = {seconds(now), counts};
    if (axis.turns.size() < turns_kept) continue;
    std::int64_t least = std::abs(axis.turns[1].counts - axis.turns[0].counts);
    std::int64_t most = least;
    for (std::size_t i = 2; i < axis.turns.size(); ++i) {
      const auto swing = std::abs(axis.turns[i].counts - axis.turns[i - 1].counts);
      least = std::min(least, swing);
      most = std::max(most, swing);
    }
    const double took = axis.turns.back().at - axis.turns.front().at;
    if (took > longest || static_cast<double>(least) < even * static_cast<double>(most)) continue;
    axis.since = axis.turns.front().at;
    axis.swing = most;
    axis.rate = (turns_kept - 1) / 2.0 / took;
  }
}

std::optional<std::pair<double, Finding>> Hunting::found() const {
  const Axis* first = nullptr;
  for (const auto& axis : axes_)
    if (axis.since && (first == nullptr || *axis.since < *first->since)) first = &axis;
  if (first == nullptr) return {};
  return {{*first->since,
           {"loop.axis-hunts"_code,
            fmt::format("{} hunts from {:.4g} s on: it swings by {} bits x4, {:.2g} times a second",
                        first->name, *first->since, first->swing, first->rate)}}};
}

void Hunting::visit(StateArchive& archive) {
  archive.each("axes_", axes_, [&](Axis& axis) {
    STATE(archive, axis.extreme.at, axis.extreme.counts, axis.forward, axis.since, axis.swing, axis.rate);
    archive.list("turns", axis.turns, [&](Turn& turn) { STATE(archive, turn.at, turn.counts); });
  });
}

}  // namespace drycut::sim::loop
