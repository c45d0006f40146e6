#pragma once
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "plants/motor_load.hpp"
#include "plants/plant.hpp"

namespace drycut::plants {

/// What a gear, a screw, a belt or a rack leaves of the torque that goes through it. What it takes is dry
/// friction on the motor's shaft, in proportion to that torque.
struct Efficiency {
  static constexpr double follows = -20;  ///< `driven` as the same friction both ways has it

  double driving = 1;       ///< while the motor drives its load; over 0, to 1
  double driven = follows;  ///< while the load drives the motor; to 1; 0 or less: self-locking

  /// `driven`, which is 2 - 1/driving where it follows: what is lost of the torque behind is lost again.
  [[nodiscard]] double backwards() const { return driven > follows ? driven : 2 - 1 / driving; }
};

/// Of a gear and of what is behind it.
[[nodiscard]] Efficiency in_series(const Efficiency& gear, const Efficiency& behind);

/// What resists on the motor's shaft, where `torque` [N m] would go through without losses: against a motion
/// that the motor must drive (1 / driving - 1) of it, against one that its load drives (1 - backwards) of it,
/// less than the torque itself unless self-locking.
[[nodiscard]] inline DryResistance losses(const Efficiency& efficiency, double torque) {
  const double driving = std::abs(torque) * (1 / efficiency.driving - 1);
  const double driven = std::abs(torque) * (1 - efficiency.backwards());
  return torque > 0 ? DryResistance{driving, driven} : DryResistance{driven, driving};
}

/// Kinds of gears, and of what turns a motor's turns into travel, with their usual efficiencies; values of
/// the parameters gear.efficiency and gear.back_efficiency, or of efficiency and back_efficiency.
const std::vector<Preset>& gear_types();
const std::vector<Preset>& slide_types();

/// Rows `efficiency` and `back_efficiency` of `what`, "gear". `source`: where the defaults are from.
Parameters efficiency_parameters(Efficiency& efficiency, std::string_view source);

/// An efficiency backwards that no friction has beside the one forwards; `group`: "gear." or "".
std::vector<PlantDefinition::Objection> efficiency_objections(const Efficiency& efficiency,
                                                              const std::string& group);

}  // namespace drycut::plants
