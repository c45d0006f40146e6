#pragma once
#include <string>
#include <string_view>

#include "plants/motor_load.hpp"
#include "plants/plant.hpp"

namespace drycut::plants {

/// Of what a friction is, and where the defaults are from.
struct FrictionSources {
  std::string_view dry;      ///< "dry friction of the guides"
  std::string_view viscous;  ///< "viscous friction of the guides"
  std::string_view coulomb_from = "estimate";
  std::string_view viscous_from = "estimate";
  std::string_view breakaway_from = "none: set it to study stick-slip";
};

/// Rows `coulomb`, `viscous`, `breakaway`, `stribeck_speed` and `backward` of a shaft and of a guided part.
Parameters shaft_friction_parameters(Friction& friction, const FrictionSources& from);
Parameters guide_friction_parameters(Friction& friction, const FrictionSources& from);

}  // namespace drycut::plants
