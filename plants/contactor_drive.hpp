#pragma once
#include <vector>

#include "plants/delayed_contact.hpp"
#include "plants/induction_motor.hpp"
#include "plants/world.hpp"

namespace drycut::plants {

/// Contactors of a pole-changing motor, direct on line.
struct ContactorData {
  double close_delay = 20e-3;  ///< [s]
  double open_delay = 15e-3;   ///< [s]
  double scatter = 0;          ///< standard deviation of both delays, from switching to switching [s]
  /// The slow winding; the fast one is that of the motor.
  WindingData slow = {375 * std::numbers::pi / 30, 330 * std::numbers::pi / 30, 14.8, 36};
};

/// Rows of the group `contactors.`.
Parameters contactor_parameters(ContactorData& data);

/// A motor with a fast and a slow winding on the mains, switched by contactors forward, backward and slow.
/// Where that one opens another closes onto the fast winding, as late as every contactor. With both
/// directions closed the mains are short-circuited and the breaker trips; its sensor in the winding trips it
/// too.
class ContactorDrive {
 public:
  /// `random`: what the delays of the contactors scatter by.
  ContactorDrive(const ContactorData& data, const InductionMotorData& motor, const Random& random = Random());

  CommandPort forward;
  CommandPort backward;
  CommandPort slow;

  /// Torque on the rotor for the coming step of `h` seconds.
  void drive(Shaft& rotor, double h);

  enum class State { off, running, tripped };
  [[nodiscard]] State state() const { return state_; }
  [[nodiscard]] bool moving() const { return state_ == State::running; }
  [[nodiscard]] double torque() const { return torque_; }  ///< on the rotor [N m]
  [[nodiscard]] double field_speed() const {
    return field_;
  }                                                    ///< of the field, 0 while there is none [rad/s]
  [[nodiscard]] double slip() const { return slip_; }  ///< field less rotor, 0 while off [rad/s]
  [[nodiscard]] double frequency() const {             ///< at the motor, < 0 backwards [Hz]
    return field_ == 0 ? 0 : field_ > 0 ? mains_ : -mains_;
  }
  [[nodiscard]] double rated_torque() const { return fast_.data().rated_torque; }
  [[nodiscard]] bool forward_on() const { return forward_contact_.closed(); }  ///< the contactor
  [[nodiscard]] bool backward_on() const { return backward_contact_.closed(); }
  [[nodiscard]] bool slow_on() const { return slow_contact_.closed(); }

  /// Faults for a plant's list, under "drive" and "drive.forward", ".backward", ".slow".
  void offer_faults(std::vector<Fault>& faults);

  [[nodiscard]] PowerStage& power() { return power_; }  ///< the electrical side
  [[nodiscard]] const PowerStage& power() const { return power_; }

  void visit(StateArchive& archive);

 private:
  PowerStage power_;
  PowerStage::Step last_;
  const Winding fast_;
  const Winding slow_winding_;
  const double mains_;  // [Hz]
  DelayedContact forward_contact_;
  DelayedContact backward_contact_;
  DelayedContact slow_contact_;
  DelayedContact fast_contact_;  // of the other winding, fed by the slow one's break contact
  Random random_;
  State state_ = State::off;
  double field_ = 0;
  double slip_ = 0;
  double torque_ = 0;
  bool phase_lost_ = false;
  PulloutWatch pullout_;
};

}  // namespace drycut::plants
