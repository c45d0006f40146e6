#include "plants/induction_motor.hpp"

#include <algorithm>
#include <cmath>

namespace drycut::plants {

namespace {

// Kloss backwards: share of the pull-out slip at which the torque is 1/ratio of the pull-out torque.
double share_of_pullout_slip(double ratio) { return ratio - std::sqrt(ratio * ratio - 1); }

}  // namespace

Winding::Winding(const WindingData& data)
    : data_(data),
      pullout_slip_((data.synchronous_speed - data.rated_speed) /
                    share_of_pullout_slip(data.pullout_torque / data.rated_torque)) {}

double Winding::slip(double torque) const {
  if (torque == 0) return 0;
  const double ratio = std::max(1.0, data_.pullout_torque / std::abs(torque));
  return std::copysign(pullout_slip_ * share_of_pullout_slip(ratio), torque);
}

Parameters winding_parameters(WindingData& data, const std::string& prefix, std::string_view source) {
  const auto row = [&](const char* name, std::string_view unit, std::string_view meaning, double& value,
                       double min, double max) {
    return Parameter{prefix + name, unit, meaning, &value, min, max, {}, {}, source};
  };
  return {
      row("synchronous_speed", "rpm", "speed of the field at rated frequency", data.synchronous_speed, 1,
          1e5),
      row("rated_speed", "rpm", "speed at rated torque", data.rated_speed, 1, 1e5),
      row("rated_torque", "N m", "torque at rated speed", data.rated_torque, 1e-3, 1e5),
      row("pullout_torque", "N m", "largest torque of the curve", data.pullout_torque, 1e-3, 1e6),
  };
}

Parameters induction_motor_parameters(InductionMotorData& data, const std::string& prefix) {
  constexpr std::string_view sheet = "usual values: 2.2 kW, 4 poles, frame 100 L";
  Parameters table = {
      {prefix + "rotor_inertia",
       "kg m2",
       "inertia of the rotor, a body of its own",
       &data.rotor_inertia,
       1e-6,
       100,
       {},
       {},
       sheet},
      {prefix + "rated_frequency",
       "Hz",
       "mains frequency for which it is made",
       &data.rated_frequency,
       10,
       400,
       {},
       {},
       "Europe"},
  };
  for (Parameter& row : winding_parameters(data.winding, prefix, sheet)) table.push_back(std::move(row));
  return table;
}

}  // namespace drycut::plants
