#include "plants/stiff_pair.hpp"

#include <cmath>
#include <limits>

namespace drycut::plants {

double longest_step_of_spring(const StiffPair& pair) {
  if (pair.stiffness <= 0) return std::numeric_limits<double>::infinity();
  return most_turn * std::sqrt(pair.inertia / pair.stiffness);
}

double longest_step_of_damper(const StiffPair& pair) {
  if (pair.damping <= 0) return std::numeric_limits<double>::infinity();
  return most_decay * pair.inertia / pair.damping;
}

}  // namespace drycut::plants
