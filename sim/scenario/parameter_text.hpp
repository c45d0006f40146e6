#pragma once
#include <string>

#include "plants/plant.hpp"

namespace drycut::sim::scenario {

/// The present value of a parameter as a scenario writes it: "600 mm", "5", "true", "web".
std::string value_text(const plants::Parameter& parameter);

}  // namespace drycut::sim::scenario
