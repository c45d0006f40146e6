#include "plants/servo_drive.hpp"

namespace drycut::plants {

const std::vector<Preset>& motor_classes() {
  constexpr std::string_view cogging = "servo.cogging";
  constexpr std::string_view ripple = "servo.torque_ripple";
  constexpr std::string_view rated = "servo.rated_torque";
  constexpr std::string_view even = "an even torque: that of a real machine is not";
  static const std::vector<Preset> all = {
      {"ideal", "torque without cogging and ripple", {{cogging, 0, even}, {ripple, 0, even}}},
      {"iron_core",
       "wound on iron teeth, neither they nor the magnets are skewed",
       {{cogging, 0.01, "estimate: 1 % of rated torque, few sheets tell it", rated},
        {ripple, 0.02, "estimate: 1 to 2 % are usual"}}},
      {"skewed",
       "the same with skewed teeth or magnets, as good servo motors are",
       {{cogging, 0.005, "estimate: 0.5 % of rated torque, half of that without skew", rated},
        {ripple, 0.01, "estimate: 1 to 2 % are usual"}}},
      {"slotless",
       "wound without teeth or without iron",
       {{cogging, 0, "no teeth, no cogging: Celera Motion, What is cogging torque?"},
        {ripple, 0.01, "estimate: as skewed, for it is the winding's and the current's"}}},
  };
  return all;
}

}  // namespace drycut::plants
