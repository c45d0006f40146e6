#pragma once
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "plants/plant.hpp"
#include "plants/power_stage.hpp"

namespace drycut::plants {

/// One winding of a three-phase induction motor, as on its data sheet.
struct WindingData {
  double synchronous_speed = 1500 * std::numbers::pi / 30;  ///< of the field at rated frequency [rad/s]
  double rated_speed = 1420 * std::numbers::pi / 30;        ///< at rated torque [rad/s]
  double rated_torque = 14.8;                               ///< [N m]
  double pullout_torque = 40;                               ///< largest of the torque curve [N m]
};

/// A motor of 2.2 kW, 4 poles.
struct InductionMotorData {
  double rotor_inertia = 5e-3;  ///< [kg m2]
  double rated_frequency = 50;  ///< of the mains [Hz]
  WindingData winding;
  double max_speed = 3600 * std::numbers::pi / 30;  ///< that the rotor bears [rad/s]
  // 0 = not known, estimated: see electrical()
  double rated_current = 0;      ///< rms at rated torque [A]
  double no_load_current = 0;    ///< rms without load [A]
  double stator_resistance = 0;  ///< of a phase, star, cold (20 degC) [ohm]
  MotorHeatData heat = {.winding_time_constant = 120, .housing_time_constant = 1800};
};

/// The data with estimates for what is not known: at 400 V two thirds of the apparent power reach the shaft,
/// half the rated current flows without load, 7 % of the rated power are lost in the cold stator.
[[nodiscard]] InductionMotorData electrical(InductionMotorData data);

/// Current and losses of the motor, and its torque for ever and at most (`peak` [N m]).
[[nodiscard]] MotorCurrent motor_current(const InductionMotorData& data);
[[nodiscard]] DriveRatings ratings(const InductionMotorData& data, double peak);

/// Rows of the group `induction_motor.`, and those of one winding; `source` is that of its defaults.
Parameters induction_motor_parameters(InductionMotorData& data);
Parameters winding_parameters(WindingData& data, std::string_view source);

/// The torque curve of a winding at full flux after Kloss: pull-out torque at the pull-out slip, which
/// follows from the rated point. Slip is the speed of the field less that of the rotor [rad/s]. No electrical
/// transients.
class Winding {
 public:
  explicit Winding(const WindingData& data);

  [[nodiscard]] double torque(double slip) const {
    const double x = slip / pullout_slip_;
    return 2 * data_.pullout_torque * x / (1 + x * x);
  }
  /// Torque with one phase lost, when field and counter-field of half the power are left: none at standstill.
  [[nodiscard]] double single_phase_torque(double field, double speed) const {
    return 0.5 * (torque(field - speed) + torque(-field - speed));
  }
  /// What the rotor loses then [W].
  [[nodiscard]] double single_phase_loss(double field, double speed) const {
    return 0.5 * (torque(field - speed) * (field - speed) + torque(-field - speed) * (-field - speed));
  }
  /// Slip for a torque on the stable branch; of the pull-out torque for more than that.
  [[nodiscard]] double slip(double torque) const;
  [[nodiscard]] double pullout_slip() const { return pullout_slip_; }
  [[nodiscard]] const WindingData& data() const { return data_; }

 private:
  WindingData data_;
  double pullout_slip_;
};

/// Finds out that an induction motor has lost its load: with all the torque that it has it comes no nearer to
/// the speed that it is to have, for it stands, or the load drives it away. A run-up is none: it comes
/// nearer.
class PulloutWatch {
 public:
  /// A step of `h` seconds; speeds in rad/s. `beyond`: pull-out or the torque limit is passed. True once each
  /// time.
  bool update(bool beyond, double wanted, double speed, double h) {
    if (!beyond || wanted != wanted_) {
      wanted_ = wanted;
      least_ = std::numeric_limits<double>::infinity();
      told_ = told_ && beyond;
    }
    if (!beyond) return false;
    const double distance = std::abs(wanted - speed);
    if (distance < least_) {
      least_ = distance;
      no_nearer_ = 0;
      return false;
    }
    no_nearer_ += h;
    if (told_ || no_nearer_ < (distance > least_ + away ? soon : late)) return false;
    return told_ = true;
  }

  void visit(StateArchive& archive);

 private:
  static constexpr double away = 5;      // [rad/s]
  static constexpr double soon = 50e-3;  // [s] that the load drives it away
  static constexpr double late = 0.5;    // [s] that it stands

  double wanted_ = 0;
  double least_ = 0;      // distance from there
  double no_nearer_ = 0;  // [s]
  bool told_ = false;
};

}  // namespace drycut::plants
