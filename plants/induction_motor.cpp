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

Parameters winding_parameters(WindingData& data, std::string_view source) {
  return {
      row("synchronous_speed", "rpm", "speed of the field at rated frequency", data.synchronous_speed, 1, 1e5,
          source),
      row("rated_speed", "rpm", "speed at rated torque", data.rated_speed, 1, 1e5, source),
      row("rated_torque", "N m", "torque at rated speed", data.rated_torque, 1e-3, 1e5, source),
      row("pullout_torque", "N m", "largest torque of the curve", data.pullout_torque, 1e-3, 1e6, source),
  };
}

Parameters induction_motor_parameters(InductionMotorData& data) {
  constexpr std::string_view sheet = "usual values: 2.2 kW, 4 poles, frame 100 L";
  return joined(
      {
          row("rotor_inertia", "kg m2", "inertia of the rotor, a body of its own", data.rotor_inertia, 1e-6,
              100, sheet),
          row("rated_frequency", "Hz", "mains frequency for which it is made", data.rated_frequency, 10, 400,
              "Europe"),
      },
      winding_parameters(data.winding, sheet));
}

}  // namespace drycut::plants
