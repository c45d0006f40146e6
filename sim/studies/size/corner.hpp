#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/problem.hpp"
#include "sim/studies/sweep/point.hpp"

namespace drycut::sim::studies {

/// What the line must do: values of the scenario.
struct Corner {
  std::string name;  ///< "length=500 mm, web.speed=120 m/min"
  std::vector<scenario::Override> overrides;
};

/// What the one corner is called where none is given.
inline constexpr std::string_view scenario_itself = "as the scenario is";

/// Reads each text of `--at`, PATH=VALUE with commas between, and the points of `file`, "" = none, an
/// envelope.csv: of each the largest value found. Where neither gives one, the scenario as it is. A corner
/// that the scenario does not take is told; so is one that sets a path that `sized` begins with.
std::vector<Corner> read_corners(const std::vector<std::string>& texts, const std::filesystem::path& file,
                                 const PointQuestion& question, const std::vector<std::string>& sized,
                                 Problems& problems);

}  // namespace drycut::sim::studies
