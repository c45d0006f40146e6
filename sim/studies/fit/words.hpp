#pragma once
#include <string>
#include <vector>

#include "base/problem.hpp"
#include "sim/studies/fit/machine.hpp"
#include "sim/studies/fit/replay.hpp"

namespace drycut::sim::studies {

/// In what of a motion a value shows.
enum class Shows { in_acceleration, in_direction, in_speed, at_low_speed, in_bending, in_place, in_all };
Shows shows(const FitPath& path);

/// Why a value is not known, and the move to record that would tell: `with` are those that it is joined with,
/// and the offset of the torque. A path without a plant is that offset itself.
std::string why_not_known(const FitPath& path, const std::vector<FitPath>& with, bool with_offset,
                          const std::vector<ReplaySeries>& recordings);

/// A value from which it shows in a replay, of a row that is 0: a share of the dry friction of its group, or
/// of all friction.
double wakened(const FitPath& path, const std::vector<FitPath>& vary, const std::vector<double>& values);

/// What is doubtful in recordings as such: coarse, slow, clipped, moved one way.
std::vector<Finding> doubts_of(const std::vector<ReplaySeries>& recordings);

}  // namespace drycut::sim::studies
