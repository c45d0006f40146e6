#include "plants/induction_motor.hpp"

#include <algorithm>
#include <cmath>

#include "base/state_archive.hpp"

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

InductionMotorData electrical(InductionMotorData data) {
  const double power = data.winding.rated_torque * data.winding.rated_speed;
  const auto estimate = [](double& value, double otherwise) {
    if (value == 0) value = otherwise;
  };
  estimate(data.rated_current, power / (std::sqrt(3.0) * 400 * 0.66));
  estimate(data.no_load_current, data.rated_current / 2);
  estimate(data.stator_resistance, 0.07 * power / (3 * data.rated_current * data.rated_current));
  return data;
}

MotorCurrent motor_current(const InductionMotorData& given) {
  const InductionMotorData data = electrical(given);
  const WindingData& winding = data.winding;
  const double rotor_loss = winding.rated_torque * (winding.synchronous_speed - winding.rated_speed);
  const double load = data.rated_current * data.rated_current - data.no_load_current * data.no_load_current;
  return {.per_rotor_loss = load / rotor_loss,
          .no_load = data.no_load_current,
          .resistance = 3 * data.stator_resistance,
          .rated_rotor_loss = rotor_loss};
}

DriveRatings ratings(const InductionMotorData& data, double peak) {
  const WindingData& winding = data.winding;
  return {.rotor_inertia = data.rotor_inertia,
          .stall_torque = winding.rated_torque,
          .rated_torque = winding.rated_torque,
          .peak_torque = peak,
          .torque_at_max_speed = peak,
          .rated_speed = winding.rated_speed,
          .max_speed = data.max_speed,
          .works_at_limit = true};
}

void PulloutWatch::visit(StateArchive& archive) { STATE(archive, wanted_, least_, no_nearer_, told_); }

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
      winding_parameters(data.winding, sheet),
      Parameters{
          row("max_speed", "rpm", "that the rotor bears", data.max_speed, 1, 1e5,
              "IEC 60034-1: safe speed of 4 poles, frames up to 100"),
          row("rated_current", "A", "rms current at rated torque, 0 = estimated from the power",
              data.rated_current, 0, 1e4, "estimate"),
          row("no_load_current", "A", "rms current without load, 0 = half the rated current",
              data.no_load_current, 0, 1e4, "estimate"),
          row("stator_resistance", "ohm",
              "of a phase in star at 20 degC, 0 = 7 % of the rated power is lost in it",
              data.stator_resistance, 0, 1e4, "estimate"),
      },
      motor_heat_parameters(data.heat, "estimate: frame 100 L"));
}

}  // namespace drycut::plants
