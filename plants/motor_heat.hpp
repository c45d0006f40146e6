#pragma once
#include "plants/parameters.hpp"

namespace drycut::plants {

/// What a winding and its housing bear. Ambient is the 40 degC for which data sheets rate motors.
struct MotorHeatData {
  double winding_time_constant = 60;    ///< of the winding against its housing [s]
  double housing_time_constant = 2400;  ///< of the housing against the air [s]
  double temperature_rise = 100;        ///< of the winding over ambient, at stall torque for ever [K]
  double temperature_limit = 428.15;    ///< of the winding: its sensor trips the drive [K]
};

/// Rows of the groups `servo.` and `induction_motor.`.
Parameters motor_heat_parameters(MotorHeatData& data, std::string_view source);

/// Temperatures of a motor: winding, housing, air in a row. Of the thermal resistance from winding to air
/// 35 % lie before the housing (usual for flanged servo motors); capacities follow from the time constants.
class MotorHeat {
 public:
  static constexpr double ambient = 313.15;         ///< [K]
  static constexpr double copper = 0.00393;         ///< more resistance a kelvin over 20 degC
  static constexpr double reference = 293.15;       ///< 20 degC, at which resistances are given [K]
  static constexpr double share_of_winding = 0.35;  ///< of the thermal resistance

  /// At stall torque, the loss in the cold winding (20 degC) and what the rotor loses [W].
  MotorHeat(const MotorHeatData& data, double cold_loss, double rotor_loss);

  /// `seconds` with such a mean loss in the winding [W]. Short against the time constants.
  void warm(double loss, double seconds);

  [[nodiscard]] double winding() const { return winding_; }  ///< [K]
  [[nodiscard]] double housing() const { return housing_; }  ///< [K]
  /// Resistance of the winding now over that at 20 degC.
  [[nodiscard]] double resistance() const { return 1 + copper * (winding_ - reference); }
  /// Where the winding ends that has this loss when cold (20 degC) and `other` besides for ever [W]: [K],
  /// infinite where its resistance grows faster than it cools.
  [[nodiscard]] double steady(double cold_loss, double other) const;
  /// The inverse: loss in the cold winding that ends at `winding` [K], at least 0.
  [[nodiscard]] double cold_loss_for(double winding, double other) const;

 private:
  double to_housing_;  // thermal resistance [K/W]
  double to_air_;
  double winding_capacity_;  // [J/K]
  double housing_capacity_;
  double winding_ = ambient;
  double housing_ = ambient;
};

}  // namespace drycut::plants
