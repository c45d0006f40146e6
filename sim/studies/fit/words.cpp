#include "sim/studies/fit/words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/studies/fit/signal.hpp"

namespace drycut::sim::studies {

Shows shows(const FitPath& path) {
  const auto ends = [&](std::string_view end) { return path.row.ends_with(end); };
  if (ends("mass") || ends("inertia")) return Shows::in_acceleration;
  if (ends(".coulomb") || ends(".backward") || ends(".coefficient") || path.plant.empty())
    return Shows::in_direction;
  if (ends(".viscous")) return Shows::in_speed;
  if (ends(".breakaway") || ends(".stribeck_speed")) return Shows::at_low_speed;
  if (path.row.starts_with("gear.") || path.row.starts_with("nut.")) return Shows::in_bending;
  if (path.row.starts_with("unbalance") || path.row == "inclination") return Shows::in_place;
  return Shows::in_all;
}

namespace {

const char* move_for(Shows what) {
  switch (what) {
    case Shows::in_acceleration:
      return "ramps up and down, with several times the torque of friction";
    case Shows::in_direction:
      return "the same constant speeds in both directions";
    case Shows::in_speed:
      return "several constant speeds, from slow to fast, in both directions";
    case Shows::at_low_speed:
      return "slow reversals, and speeds around the lowest";
    case Shows::in_bending:
      return "a chirp of torque or speed up to beyond the resonance, or the load's position too";
    case Shows::in_place:
      return "whole turns or the whole travel, slowly, in both directions";
    case Shows::in_all:
      break;
  }
  return "a motion in which it matters";
}

}  // namespace

std::string why_not_known(const FitPath& path, const std::vector<FitPath>& with, bool with_offset,
                          const std::vector<ReplaySeries>& recordings) {
  const auto* move = move_for(shows(path));
  if (with.empty() && !with_offset)
    return fmt::format("hardly anything in the recording depends on it; record {}", move);
  std::vector<std::string> names;
  names.reserve(with.size() + 1);
  for (const auto& other : with) names.push_back(other.row);
  if (with_offset) names.emplace_back("the offset of the torque");
  const bool one_way = std::ranges::all_of(recordings, &ReplaySeries::one_way);
  const bool of_direction = with_offset && shows(path) == Shows::in_direction;
  const auto because = one_way && of_direction ? "the motion goes one way only: " : "";
  // What parts them is what the other one shows in, where this one shows in all that moves.
  const auto& partner = with.empty() ? path : with.front();
  const auto* parts = shows(path) == shows(partner) || with.empty() ? move : move_for(shows(partner));
  return fmt::format("{}it and {} act as one torque, so only their sum is known; record {}", because,
                     fmt::join(names, " and "), one_way && of_direction ? move : parts);
}

double wakened(const FitPath& path, const std::vector<FitPath>& vary, const std::vector<double>& values) {
  constexpr double share = 0.1;
  double largest = 0;
  for (std::size_t i = 0; i < vary.size(); ++i) {
    const bool of_group =
        path.row.substr(0, path.row.find('.')) == vary[i].row.substr(0, vary[i].row.find('.'));
    if (vary[i].row.ends_with(".coulomb") && (of_group || path.row.find('.') == std::string::npos))
      largest = std::max(largest, values[i]);
  }
  return path.row.ends_with("angle") ? 0 : share * largest;
}

std::vector<Finding> doubts_of(const std::vector<ReplaySeries>& recordings) {
  std::vector<Finding> found;
  const auto steps_of = [](const recordings::Series& series) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i < series.value.size(); ++i) {
      const double step = std::abs(series.value[i] - series.value[i - 1]);
      if (step > 0) least = std::min(least, step);
    }
    const auto [low, high] = std::ranges::minmax(series.value);
    return (high - low) / least;
  };
  for (const auto& one : recordings) {
    for (const auto* series : {&one.torque, &one.motion}) {
      constexpr double fewest = 100;
      const double steps = steps_of(*series);
      if (steps < fewest)
        found.emplace_back(
            "fit.coarse"_code,
            fmt::format("{}: {} has {:.0f} steps from its least to its largest value; record it "
                        "with a finer resolution",
                        one.name(), series->channel, steps),
            Finding::Role::warning);
      if (!series->clipped.empty())
        found.emplace_back(
            "fit.clipped"_code,
            fmt::format("{}: {} samples of {} are at the limit of what could be recorded; what "
                        "happened around them was left out",
                        one.name(), series->clipped.size(), series->channel),
            Finding::Role::warning);
    }
    constexpr double almost = 0.14;
    if (bandwidth_of(one.torque) * one.sampling > almost / 1.25)
      found.emplace_back(
          "fit.slow"_code,
          fmt::format("{}: the torque changes as fast as it was sampled, every {:.3g} ms; record "
                      "at a higher rate, or move more gently",
                      one.name(), one.sampling * 1000),
          Finding::Role::warning);
    for (const auto& channel : one.unused)
      found.emplace_back("fit.unused-channel"_code, fmt::format("{}: {} is not used", one.name(), channel));
  }
  return found;
}

}  // namespace drycut::sim::studies
