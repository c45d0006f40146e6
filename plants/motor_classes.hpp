#pragma once
#include <vector>

#include "plants/plant.hpp"

namespace drycut::plants {

/// Kinds of servo motors with the usual unevenness of their torque over a turn; values of the parameters
/// servo.cogging, as a share of servo.rated_torque, and servo.torque_ripple.
const std::vector<Preset>& motor_classes();

}  // namespace drycut::plants
