#pragma once
#include <string>
#include <vector>

#include "plants/delayed_contact.hpp"
#include "plants/induction_motor.hpp"
#include "plants/world.hpp"

namespace drycut::plants {

/// A frequency inverter with direction inputs and two preset speeds, no encoder feedback.
struct InverterData {
  double fast = 50;             ///< output frequency [Hz]
  double slow = 5;              ///< output frequency with the input slow [Hz]
  double acceleration = 0.5;    ///< time of the ramp from 0 to rated frequency [s]
  double deceleration = 0.5;    ///< time of the ramp from rated frequency to 0 [s]
  double torque_limit = 22;     ///< driving and braking [N m], at most the pull-out torque
  double input_filter = 5e-3;   ///< of the digital inputs [s]
  std::string stop = "ramp";    ///< when no direction is given: ramp, coast, dc_brake
  double hold_time = 0.1;       ///< at 0 Hz after a ramp, for the brake to engage [s]
  double dc_brake_torque = 15;  ///< largest torque of the DC brake [N m]
  double dc_brake_time = 0.5;   ///< [s]
  AmplifierData amplifier = {.overload_time = 60};  ///< 0: 115 % of the motor's current, and half more
  SupplyData supply = {.capacitance = 0.5e-3, .resistor = 100};
};

/// Rows of the group `inverter.`.
Parameters inverter_parameters(InverterData& data);

/// Inverter with its motor. Its frequency reference is a ramp that knows nothing of the rotor; torque comes
/// from slip at full flux, so that speed sinks under load. Where the slip would exceed the torque limit the
/// frequency follows the rotor (stall prevention) and the ramp goes on from there. Both directions at once
/// are none. It trips on a lost phase, and by its power stage; both inputs off reset that.
class Inverter {
 public:
  Inverter(const InverterData& data, const InductionMotorData& motor);

  CommandPort forward;
  CommandPort backward;
  CommandPort slow;

  /// Torque on the rotor for the coming step of `h` seconds. Behind contactors it is the rotor that they
  /// connect; with nothing connected the frequency goes on.
  void drive(Shaft& rotor, double h, const Feed& feed = {});

  enum class State { off, running, stopping, holding, dc_braking, tripped };
  [[nodiscard]] State state() const { return state_; }
  [[nodiscard]] bool moving() const { return state_ == State::running || state_ == State::stopping; }
  [[nodiscard]] const PowerStage::Step& given() const { return last_; }  ///< in this step
  [[nodiscard]] bool live() const { return live_; }        ///< there is voltage at its terminals
  [[nodiscard]] double torque() const { return torque_; }  ///< on the rotor [N m]
  [[nodiscard]] double field_speed() const {
    return field_;
  }                                                    ///< of the field, 0 while there is none [rad/s]
  [[nodiscard]] double slip() const { return slip_; }  ///< field less rotor, 0 while off [rad/s]
  [[nodiscard]] double frequency() const {
    return field_ / speed_per_hertz_;
  }  ///< output, < 0 backwards [Hz]
  [[nodiscard]] double rated_torque() const { return winding_.data().rated_torque; }
  [[nodiscard]] bool forward_on() const { return forward_filter_.closed(); }  ///< after the input filter
  [[nodiscard]] bool backward_on() const { return backward_filter_.closed(); }
  [[nodiscard]] bool slow_on() const { return slow_filter_.closed(); }
  [[nodiscard]] bool limited() const { return limited_; }  ///< the torque limit acts

  /// Faults for a plant's list, under "drive" and "drive.forward", ".backward", ".slow".
  void offer_faults(std::vector<Fault>& faults);

  [[nodiscard]] PowerStage& power() { return power_; }  ///< the electrical side
  [[nodiscard]] const PowerStage& power() const { return power_; }

  void visit(StateArchive& archive);

 private:
  void advance(int direction, double h);
  void ramp(double target, double h);

  const InverterData data_;
  PowerStage power_;
  PowerStage::Step last_;
  const Winding winding_;
  const double speed_per_hertz_;  // of the field [rad/s/Hz]
  const double rated_field_;      // [rad/s]
  DelayedContact forward_filter_;
  DelayedContact backward_filter_;
  DelayedContact slow_filter_;
  State state_ = State::off;
  double remaining_ = 0;  // of holding or DC braking [s]
  double field_ = 0;
  double slip_ = 0;
  double torque_ = 0;
  double limit_slip_;
  double target_ = 0;  // speed of the field at the end of the ramp
  PulloutWatch pullout_;
  bool limited_ = false;
  bool live_ = false;
  bool trip_ = false;
  bool phase_lost_ = false;
};

}  // namespace drycut::plants
