#include "sim/studies/fit/words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

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

}  // namespace drycut::sim::studies
