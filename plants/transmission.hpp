#pragma once
#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "plants/efficiency.hpp"
#include "plants/plant.hpp"
#include "plants/world.hpp"

namespace drycut::plants {

/// Gear, shaft and coupling between a rotor and its load. Both are bodies of their own; nothing is reflected.
struct TransmissionData {
  double ratio = 5;                ///< turns of the motor for one of the load
  double stiffness = 52e3;         ///< torsional, seen at the load [N m/rad]; 0 = not known: with_stiffness()
  double damping = 7;              ///< seen at the load [N m s/rad]
  double backlash = 0;             ///< whole play, seen at the load [rad]
  std::string type = "loss_free";  ///< of gear_types(): its efficiency unless that is given
  Efficiency efficiency = {};
};

/// Where a machine's defaults are from.
struct TransmissionSources {
  std::string_view stiffness = "estimate: planetary gear of the 2 kW class, 15 N m/arcmin";
  std::string_view ratio = {};
  std::string_view damping = "estimate: 5 % of critical";
};
/// Rows of the group `gear.`.
Parameters transmission_parameters(TransmissionData& data, const TransmissionSources& from = {});

/// Torque that a spring with damper and play exerts for a twist [rad] and its rate [rad/s]. With play the
/// flanks only push: damping neither pulls nor exceeds the spring (after Modelica's ElastoBacklash2).
[[nodiscard]] double transmission_torque(const TransmissionData& data, double twist, double twist_rate);

class Transmission {
 public:
  explicit Transmission(TransmissionData data) : data_(std::move(data)) {}
  /// Other data from now on; the twist is kept, and so must the ratio be.
  void take(const TransmissionData& data) { data_ = data; }

  /// Acts on both bodies for the coming step: +torque on the load, -torque/ratio on the motor.
  void drive(Shaft& motor, Shaft& load) {
    rate_ = motor.speed / data_.ratio - load.speed;
    torque_ = transmission_torque(data_, twist_, rate_);
    load.add_torque(torque_);
    motor.add_torque(-torque_ / data_.ratio);
  }
  /// Follows the bodies over the last step. The twist is summed up from the speeds, as Bullet sums up angles:
  /// a difference of two unwrapped angles would lose its digits over a long run.
  void sense(const Shaft& motor, const Shaft& load, double h) {
    twist_ += (motor.speed / data_.ratio - load.speed) * h;
  }

  [[nodiscard]] double torque() const { return torque_; }  ///< on the load [N m]
  [[nodiscard]] double twist() const { return twist_; }    ///< motor/ratio - load [rad]
  [[nodiscard]] double rate() const { return rate_; }  ///< of the twist when torque() was computed [rad/s]

  /// But the data, which whoever gives them keeps.
  void visit(StateArchive& archive);

 private:
  TransmissionData data_;
  double twist_ = 0;
  double rate_ = 0;
  double torque_ = 0;
};

/// The data with a stiffness that is known: where it is 0, that with which motor and load swing at 200 Hz,
/// and 5 % of critical damping. Inertias in kg m2, each on its own shaft.
[[nodiscard]] TransmissionData with_stiffness(TransmissionData data, double motor_inertia,
                                              double load_inertia);

/// Angular frequency of the free two-mass oscillation [rad/s], inertias in kg m2.
[[nodiscard]] double resonance(const TransmissionData& data, double motor_inertia, double load_inertia);

}  // namespace drycut::plants
