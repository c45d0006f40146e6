#include "plants/inverter.hpp"

#include <algorithm>
#include <cmath>

#include "base/state_archive.hpp"

namespace drycut::plants {

namespace {

// The next size above the motor's.
AmplifierData amplifier_of(const InverterData& data, const InductionMotorData& motor) {
  AmplifierData amplifier = data.amplifier;
  if (amplifier.current == 0) amplifier.current = 1.15 * electrical(motor).rated_current;
  if (amplifier.peak_current == 0) amplifier.peak_current = 1.5 * amplifier.current;
  return amplifier;
}

}  // namespace

Inverter::Inverter(const InverterData& data, const InductionMotorData& motor)
    : data_(data),
      power_(motor_current(motor), motor.heat, ratings(motor, data.torque_limit), amplifier_of(data, motor),
             data.supply),
      winding_(motor.winding),
      speed_per_hertz_(motor.winding.synchronous_speed / motor.rated_frequency),
      rated_field_(motor.winding.synchronous_speed),
      forward_filter_(data.input_filter, data.input_filter),
      backward_filter_(data.input_filter, data.input_filter),
      slow_filter_(data.input_filter, data.input_filter),
      limit_slip_(winding_.slip(data.torque_limit)) {}

void Inverter::ramp(double target, double h) {
  target_ = target;
  if (field_ * target < 0) {  // a reversal goes down to 0 first and takes its second ramp from there
    const double to_zero = std::abs(field_) / rated_field_ * data_.deceleration;
    if (to_zero > h) {
      target = 0;
    } else {
      field_ = 0;
      h -= to_zero;
    }
  }
  const double time = std::abs(target) < std::abs(field_) ? data_.deceleration : data_.acceleration;
  const double most = rated_field_ / time * h;
  field_ += std::clamp(target - field_, -most, most);
}

// What the inverter does in the coming step, with the frequency that it gives.
void Inverter::advance(int direction, double h) {
  const bool was_off = state_ == State::off || state_ == State::dc_braking;
  if (direction != 0) {
    if (was_off) field_ = 0;
    state_ = State::running;
  } else if (state_ == State::running) {
    state_ = data_.stop == "ramp" ? State::stopping : data_.stop == "coast" ? State::off : State::dc_braking;
    remaining_ = data_.dc_brake_time;
  }
  switch (state_) {
    case State::running:
      ramp(direction * (slow_on() ? data_.slow : data_.fast) * speed_per_hertz_, h);
      break;
    case State::stopping:
      ramp(0, h);
      if (field_ != 0) break;
      state_ = State::holding;
      remaining_ = data_.hold_time;
      break;
    case State::holding:
    case State::dc_braking:
      if (remaining_ < h / 2) state_ = State::off;
      remaining_ -= h;
      break;
    case State::off:
    case State::tripped:
      break;
  }
}

void Inverter::drive(Shaft& rotor, double h, const Feed& feed) {
  power_.account(last_, feed.turned != nullptr ? *feed.turned : rotor, h, feed.other);
  const int forwards = forward_filter_.update(forward.level, h) ? 1 : 0;
  const int backwards = backward_filter_.update(backward.level, h) ? 1 : 0;
  slow_filter_.update(slow.level, h);
  if (phase_lost_ && moving()) trip_ = true;
  if (power_.tripped() && forwards == 0 && backwards == 0) {
    power_.reset();
    state_ = State::off;
  }
  if (trip_ || power_.tripped()) state_ = State::tripped;
  if (state_ != State::tripped) advance(forwards - backwards, h);

  limited_ = false;
  slip_ = torque_ = 0;
  last_ = {};
  const bool turns = moving() || state_ == State::holding;
  live_ = turns || state_ == State::dc_braking;
  if (feed.open) {
    if (!turns) field_ = 0;
  } else if (turns) {
    const double wanted = field_ - rotor.speed;
    slip_ = std::clamp(wanted, -limit_slip_, limit_slip_);
    limited_ = slip_ != wanted;
    if (limited_) field_ = rotor.speed + slip_;
    torque_ = winding_.torque(slip_);
    last_ = {torque_, torque_ * slip_, std::abs(wanted) / limit_slip_, true};
  } else {
    field_ = 0;
    if (state_ == State::dc_braking) {
      const double x = rotor.speed / winding_.pullout_slip();
      torque_ = -2 * data_.dc_brake_torque * x / (1 + x * x);
      last_ = {torque_, -torque_ * rotor.speed, 0, true};
    }
  }
  rotor.add_torque(torque_);
  if (pullout_.update(limited_, target_, rotor.speed, h)) power_.pulled_out(rotor.speed, slip_);
}

void Inverter::offer_faults(std::vector<Fault>& faults) {
  faults.push_back({"drive", "trip", "",
                    [this](double v) {
                      trip_ = v != 0;
                      if (!trip_ && state_ == State::tripped) state_ = State::off;
                    },
                    "1: the drive switches itself off, the motor coasts; 0 resets it"});
  faults.push_back({"drive",
                    "torque_limit",
                    "N m",
                    [this](double v) {
                      limit_slip_ =
                          winding_.slip(v != 0 ? std::min(v, data_.torque_limit) : data_.torque_limit);
                    },
                    "the torque is limited to this; 0 takes the limit away",
                    {0, 1e5, false},
                    {},
                    0.2});
  faults.push_back(fault_state("drive", "phase_lost", phase_lost_,
                               "1: a phase of the motor is interrupted: the drive trips when it runs"));
  power_.offer_faults(faults);
  forward_filter_.offer_faults(faults, "drive.forward");
  backward_filter_.offer_faults(faults, "drive.backward");
  slow_filter_.offer_faults(faults, "drive.slow");
}

void Inverter::visit(StateArchive& archive) {
  STATE(archive, forward, backward, slow, power_, last_, forward_filter_, backward_filter_, slow_filter_,
        state_, remaining_, field_, slip_, torque_, limit_slip_, target_, pullout_, limited_, live_, trip_,
        phase_lost_);
}

Parameters inverter_parameters(InverterData& data) {
  Parameters rows = {
      row("fast", "Hz", "output frequency; at most the motor's rated frequency", data.fast, 0.1, 400,
          "rated frequency"),
      row("slow", "Hz", "output frequency while the input slow is on", data.slow, 0.1, 400, "a tenth"),
      row("acceleration", "s", "ramp from 0 to rated frequency", data.acceleration, 1e-3, 100, "estimate"),
      row("deceleration", "s", "ramp from rated frequency to 0", data.deceleration, 1e-3, 100, "estimate"),
      row("torque_limit", "N m", "driving and braking; the frequency follows the rotor there",
          data.torque_limit, 1e-3, 1e5, "150 % of the default motor"),
      row("input_filter", "ms", "of the inputs forward, backward, slow", data.input_filter, 0, 1000,
          "usual: scan of the inputs"),
      row("stop", "when neither direction is on: ramp to 0 and hold, coast, or DC brake", data.stop,
          {"ramp", "coast", "dc_brake"}, "usual setting"),
      row("hold_time", "ms", "at 0 Hz after a ramp, while the brake engages", data.hold_time, 0, 10000,
          "estimate: longer than the brake takes"),
      row("dc_brake_torque", "N m", "largest torque of the DC brake, at the motor's pull-out slip",
          data.dc_brake_torque, 0, 1e5, "estimate: rated torque"),
      row("dc_brake_time", "ms", "duration of the DC brake", data.dc_brake_time, 0, 60000, "estimate"),
  };
  return joined(std::move(rows), amplifier_parameters(data.amplifier, "usual: inverter of 2.2 kW"),
                group("supply.", supply_parameters(data.supply)));
}

}  // namespace drycut::plants
