#include "plants/power_stage.hpp"

#include <algorithm>
#include <limits>

#include "base/state_archive.hpp"

namespace drycut::plants {

MotorHeat::MotorHeat(const MotorHeatData& data, double cold_loss, double rotor_loss) {
  const double hot = cold_loss * (1 + copper * (ambient + data.temperature_rise - reference)) + rotor_loss;
  const double to_air = data.temperature_rise / hot;
  to_housing_ = share_of_winding * to_air;
  to_air_ = to_air - to_housing_;
  winding_capacity_ = data.winding_time_constant / to_housing_;
  housing_capacity_ = data.housing_time_constant / to_air_;
}

void MotorHeat::warm(double loss, double seconds) {
  const double into_housing = (winding_ - housing_) / to_housing_;
  const double into_air = (housing_ - ambient) / to_air_;
  winding_ += (loss - into_housing) / winding_capacity_ * seconds;
  housing_ += (into_housing - into_air) / housing_capacity_ * seconds;
}

double MotorHeat::steady(double cold_loss, double other) const {
  const double to_air = to_housing_ + to_air_;
  const double feedback = to_air * cold_loss * copper;
  if (feedback >= 1) return std::numeric_limits<double>::infinity();
  return ambient + to_air * (cold_loss * (1 + copper * (ambient - reference)) + other) / (1 - feedback);
}

double MotorHeat::cold_loss_for(double winding, double other) const {
  const double loss = (winding - ambient) / (to_housing_ + to_air_) - other;
  return std::max(0.0, loss / (1 + copper * (winding - reference)));
}

void MotorHeat::visit(StateArchive& archive) { STATE(archive, winding_, housing_); }

Parameters motor_heat_parameters(MotorHeatData& data, std::string_view source) {
  return {
      row("winding_time_constant", "s", "thermal time constant of the winding against its housing",
          data.winding_time_constant, 1, 1e5, source),
      row("housing_time_constant", "s", "thermal time constant of the housing against the air",
          data.housing_time_constant, 1, 1e6, source),
      row("temperature_rise", "K",
          "temperature rise of the winding over an ambient of 40 degC, at continuous stall torque",
          data.temperature_rise, 1, 300, "insulation class F"),
      row("temperature_limit", "degC", "of the winding: its sensor trips the drive", data.temperature_limit,
          41, 400, "insulation class F"),
  };
}

}  // namespace drycut::plants
