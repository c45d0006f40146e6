#pragma once
#include <vector>

#include "plants/plant.hpp"

namespace drycut::plants {

/// What a web can be made of: choices of its parameter `material`, each with density, shear_strength,
/// elasticity and retardation.
[[nodiscard]] const std::vector<Preset>& materials();

}  // namespace drycut::plants
