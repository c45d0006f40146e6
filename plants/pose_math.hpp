#pragma once
#include "plants/plant.hpp"

namespace drycut::plants {

// Poses, as frames that stand in each other: `carriage * at(0, 0.1, 0) * about_z(angle)`.

[[nodiscard]] inline Pose at(double x, double y, double z) { return {{x, y, z}, {0, 0, 0, 1}}; }
[[nodiscard]] inline Pose at(const std::array<double, 3>& place) { return {place, {0, 0, 0, 1}}; }

// Turned by `angle` [rad].
[[nodiscard]] Pose about_x(double angle);
[[nodiscard]] Pose about_y(double angle);
[[nodiscard]] Pose about_z(double angle);

/// The pose in the world of what is at `inner` in the frame `outer`.
[[nodiscard]] Pose operator*(const Pose& outer, const Pose& inner);

}  // namespace drycut::plants
