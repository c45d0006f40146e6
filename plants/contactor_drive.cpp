#include "plants/contactor_drive.hpp"

#include <cmath>

#include "base/state_archive.hpp"

namespace drycut::plants {

ContactorDrive::ContactorDrive(const ContactorData& data, const InductionMotorData& motor,
                               const Random& random)
    : power_(motor_current(motor), motor.heat, ratings(motor, motor.winding.pullout_torque), {}, {}),
      fast_(motor.winding),
      slow_winding_(data.slow),
      mains_(motor.rated_frequency),
      forward_contact_(data.close_delay, data.open_delay, data.scatter),
      backward_contact_(data.close_delay, data.open_delay, data.scatter),
      slow_contact_(data.close_delay, data.open_delay, data.scatter),
      fast_contact_(data.close_delay, 0),
      random_(random) {}

void ContactorDrive::drive(Shaft& rotor, double h) {
  power_.account(last_, rotor, h);
  const bool forwards = forward_contact_.update(forward.level, h, &random_);
  const bool backwards = backward_contact_.update(backward.level, h, &random_);
  const bool slowly = slow_contact_.update(slow.level, h, &random_);
  const bool fast = fast_contact_.update(!slowly, h);
  const Winding& winding = slowly ? slow_winding_ : fast_;
  if ((forwards && backwards) || power_.tripped())
    state_ = State::tripped;
  else if (state_ != State::tripped)
    state_ = forwards || backwards ? State::running : State::off;

  field_ = slip_ = torque_ = 0;
  last_ = {};
  if (state_ == State::running && (slowly || fast)) {
    field_ = forwards ? winding.data().synchronous_speed : -winding.data().synchronous_speed;
    slip_ = field_ - rotor.speed;
    torque_ = phase_lost_ ? winding.single_phase_torque(field_, rotor.speed) : winding.torque(slip_);
    const double loss = phase_lost_ ? winding.single_phase_loss(field_, rotor.speed) : torque_ * slip_;
    last_ = {torque_, loss, 0, true};
  }
  rotor.add_torque(torque_);
  const bool beyond = !phase_lost_ && std::abs(slip_) > winding.pullout_slip();
  if (pullout_.update(beyond, field_, rotor.speed, h)) power_.pulled_out(rotor.speed, slip_);
}

void ContactorDrive::offer_faults(std::vector<Fault>& faults) {
  faults.push_back({"drive", "trip", "",
                    [this](double v) {
                      state_ = v != 0 ? State::tripped : State::off;
                      power_.reset();
                    },
                    "1: the motor's breaker trips, the motor coasts; 0 resets it"});
  faults.push_back(
      fault_state("drive", "phase_lost", phase_lost_, "1: a phase is lost: less torque, none at standstill"));
  forward_contact_.offer_faults(faults, "drive.forward");
  backward_contact_.offer_faults(faults, "drive.backward");
  slow_contact_.offer_faults(faults, "drive.slow");
}

void ContactorDrive::visit(StateArchive& archive) {
  STATE(archive, forward, backward, slow, power_, last_, forward_contact_, backward_contact_, slow_contact_,
        fast_contact_, random_, state_, field_, slip_, torque_, phase_lost_, pullout_);
}

Parameters contactor_parameters(ContactorData& data) {
  return joined(
      {
          row("close_delay", "ms", "from coil on to contacts closed", data.close_delay, 0, 1000,
              "usual: contactors of the 2 kW class"),
          row("open_delay", "ms", "from coil off to the end of the arc", data.open_delay, 0, 1000,
              "usual: contactors of the 2 kW class"),
          row("scatter", "ms", "standard deviation of both delays, from switching to switching", data.scatter,
              0, 100, "none: set it to see what a placement's tolerance is made of"),
      },
      group("slow.", winding_parameters(data.slow, "usual values: 4/16 poles, wound to brake well")));
}

}  // namespace drycut::plants
