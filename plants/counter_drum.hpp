#pragma once
#include <string>

#include "plants/motor_load.hpp"
#include "plants/plant.hpp"

namespace drycut::plants {

/// What runs under the web against the blades of a rotary knife, geared to its drum without play or twist:
/// the two are one body on the knife drum's shaft. A gear pair stands far stiffer than the motor's gear.
struct CounterDrumData {
  std::string kind =
      "none";             ///< none: the anvil costs no torque; smooth: an anvil drum; blades: a second knife
  double inertia = 0.41;  ///< on its own axis [kg m2]
  double ratio = 1;       ///< its turns for one of the knife drum, > 0
  Friction friction = {2, 0.1, 0, 0};  ///< on its own axis

  [[nodiscard]] bool turns() const { return kind != "none"; }
  [[nodiscard]] bool cuts() const { return kind == "blades"; }
};

/// Rows of the group `counter.`.
Parameters counter_drum_parameters(CounterDrumData& data);

/// Inertia of knife drum and counter drum on the shaft of the knife drum [kg m2].
[[nodiscard]] double geared_inertia(double knife_drum, const CounterDrumData& counter);
/// Friction of the two there.
[[nodiscard]] Friction geared_friction(const Friction& knife_drum, const CounterDrumData& counter);

}  // namespace drycut::plants
