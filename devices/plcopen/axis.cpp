#include "devices/plcopen/axis.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/state_archive.hpp"
#include "base/units.hpp"
#include "devices/axis/regulator.hpp"

namespace drycut::devices::plcopen {
namespace {

__extension__ using Wide = __int128;

bool in_range(double value, double min) { return value >= min && value <= pin_max; }
/// 0 takes the axis' own; the vendor's ranges begin at 1.
bool slope_in_range(double value) { return value == 0 || in_range(value, 1); }

}  // namespace

Axis::Axis(std::string name, const AxisParameters& parameters)
    : name_(std::move(name)), parameters_(parameters) {
  homed_ = parameters.homed_at_start;
}

bool Axis::set_parameter(const AxisParameter& parameter, double value) {
  // What the axis is made of cannot change under a running axis.
  const bool build = parameter.is(&AxisParameters::kind) || parameter.is(&AxisParameters::modulo);
  if (build && state_ != AxisState::disabled) return false;
  return plcopen::set_parameter(parameters_, parameter, value);
}

AxisMotion Axis::as_master(bool actual_values, double delay) const {
  if (!actual_values) return set_;
  return {advanced(actual_, actual_velocity_ * delay, modulo()), actual_velocity_, 0};
}

ErrorId Axis::limits_of(const Dynamics& dynamics, JerkLimits& limits) const {
  if (!in_range(dynamics.velocity, 0)) return ErrorId::velocity_range;
  if (!slope_in_range(dynamics.acceleration)) return ErrorId::acceleration_range;
  if (!slope_in_range(dynamics.deceleration)) return ErrorId::deceleration_range;
  if (!slope_in_range(dynamics.jerk)) return ErrorId::jerk_range;
  const double half = parameters_.a_max / 2;
  const auto own = [](double pin, double axis) { return pin > 0 ? pin : axis; };
  limits.velocity =
      std::min(own(dynamics.velocity, parameters_.vb_max), parameters_.vb_max) * increments_per_speed;
  limits.acceleration =
      std::min(own(dynamics.acceleration, half), parameters_.a_max) * increments_per_acceleration;
  limits.deceleration =
      std::min(own(dynamics.deceleration, half), parameters_.a_max) * increments_per_acceleration;
  limits.jerk =
      own(dynamics.jerk, half / (parameters_.tr_min * units::microsecond)) * increments_per_acceleration;
  return ErrorId::none;
}

void Axis::run(const JerkProfile& profile) {
  profile_ = profile;
  profile_origin_ = base_.position;
  profile_time_ = 0;
}

Order Axis::begin(AxisState to, std::uint64_t ticket) {
  remember(ticket_, state_of(ticket_));
  if (ticket == 0) {
    abort_waiting({Progress::aborted});
    end_overlay({Progress::aborted});
    ticket = ++last_ticket_;
  } else {
    base_ = start_of(ticket);
    overlay_sum_ = 0;
  }
  state_ = to;
  ticket_ = ticket;
  coupling_.reset();
  profile_.reset();
  target_.reset();
  stop_held_ = false;
  speed_cut_ = false;
  profile_ends_ = 0;
  done_ = false;
  return {ErrorId::none, ticket_};
}

Order Axis::power(bool on) {
  powered_ = on;
  outputs_ = {};
  const AxisState to = judge(state_, on ? Command::power_on : Command::power_off).to;
  if (to == state_) return {};
  begin(to);
  stand_on_actual();
  return {};
}

Order Axis::home(double position) {
  const CommandVerdict verdict = judge(state_, Command::home);
  if (verdict.error != ErrorId::none) return {verdict.error};
  if (!(std::abs(position) <= pin_max)) return {ErrorId::position_range};
  home_to_ = position;
  return begin(verdict.to);
}

ErrorId Axis::set_position(double position, bool relative) {
  const CommandVerdict verdict = judge(state_, Command::set_position);
  if (verdict.error != ErrorId::none) return verdict.error;
  if (!(std::abs(position) <= pin_max)) return ErrorId::position_range;
  move_zero(relative ? position : position - actual_.part);
  return ErrorId::none;
}

ErrorId Axis::set_override(double factor) {
  if (!(factor >= 0 && factor <= 1)) return ErrorId::override_range;
  program_override_ = factor;
  return ErrorId::none;
}

Order Axis::slow_down(Command command, const Dynamics& dynamics) {
  const CommandVerdict verdict = judge(state_, command);
  if (verdict.error != ErrorId::none) return {verdict.error};
  JerkLimits limits;
  if (const ErrorId error = limits_of(dynamics, limits); error != ErrorId::none) return {error};
  const MotionState now = plan_from(set_);
  const Order order = begin(verdict.to);
  stop_held_ = command == Command::stop;
  limits_ = limits;
  run(*to_velocity(now, 0, limits));
  return order;
}

void Axis::release_stop(std::uint64_t ticket) {
  if (ticket != ticket_ || state_ != AxisState::stopping) return;
  stop_held_ = false;
  if (!profile_) state_ = AxisState::standstill;
}

Order Axis::reset() {
  const CommandVerdict verdict = judge(state_, Command::reset);
  if (verdict.error != ErrorId::none) return {verdict.error};
  remember(ticket_, state_of(ticket_));
  resetting_ = true;
  done_ = false;
  return {ErrorId::none, ticket_ = ++last_ticket_};
}

Order Axis::couple(Coupling coupling, const CouplingLink& link, Command command, std::uint64_t ticket) {
  const CommandVerdict verdict = judge(state_, command);
  if (verdict.error != ErrorId::none) return {verdict.error};
  const Order order = begin(verdict.to, ticket);
  coupling_ = std::move(coupling);
  link_ = link;
  override_ = 1;
  return order;
}

Order Axis::uncouple(Command command) {
  const CommandVerdict verdict = judge(state_, command);
  if (verdict.error != ErrorId::none) return {verdict.error};
  // Each block lets go of its own kind of coupling.
  const bool cam = coupling_ && coupling_->cam() != nullptr;
  if (cam != (command == Command::cam_out)) return {ErrorId::in_synchronized_motion};
  const Order order = begin(verdict.to);
  base_.acceleration = set_.acceleration = 0;
  JerkProfile onward;
  onward.start = onward.end = {0, base_.velocity, 0};
  override_ = 1;
  run(onward);
  done_ = true;
  return order;
}

void Axis::fault(ErrorId error) {
  if (state_ == AxisState::disabled || state_ == AxisState::errorstop) return;
  error_ = error;
  state_ = AxisState::errorstop;
  abort_waiting({Progress::failed, error});
  end_overlay({Progress::failed, error});
  coupling_.reset();
  profile_.reset();
  resetting_ = false;
}

void Axis::regulate() {
  outputs_ = {};
  if (parameters_.kind == AxisKind::virtual_axis) {
    actual_ = set_.position;
    actual_velocity_ = set_.velocity;
  }
  if (parameters_.kind != AxisKind::drive || !powered_ || !drive.ready) return;
  const double lag = following_error();
  if (parameters_.following_error_max > 0 && std::abs(lag) > parameters_.following_error_max)
    fault(ErrorId::following_error);
  const double speed = parameters_.kv / 100 * lag + parameters_.feed_forward / 1000 * set_.velocity;
  const double share = speed / (parameters_.v_at_10v * increments_per_speed);
  outputs_ = {drycut::devices::axis::to_dac(share * dac_full_scale).word, true};
}

Position Axis::position_of(std::int64_t counts) const {
  const auto increments = static_cast<Wide>(parameters_.path_increments) * counts;
  const auto per = static_cast<Wide>(parameters_.path_counts);
  if (modulo() <= 0) {
    const Wide whole = increments / per;
    return {0, static_cast<double>(whole) +
                   static_cast<double>(increments - whole * per) / static_cast<double>(per) + home_offset_};
  }
  const Wide turn = static_cast<Wide>(modulo()) * per;
  Wide turns = increments / turn;
  Wide rest = increments - turns * turn;
  if (rest < 0) {
    rest += turn;
    --turns;
  }
  return advanced({static_cast<std::int64_t>(turns), static_cast<double>(rest) / static_cast<double>(per)},
                  home_offset_, modulo());
}

void DriveInputs::visit(StateArchive& archive) {
  STATE(archive, counts, ready, emergency_stop, probe_counts, probe_edges);
}
void DriveOutputs::visit(StateArchive& archive) { STATE(archive, reference, enable); }
void AxisControl::visit(StateArchive& archive) { STATE(archive, feed_enable, feed_hold, override_percent); }
void CouplingLink::visit(StateArchive& archive) {
  STATE(archive, master, actual_values, table, revision, locks_table, own_copy, endless, interpolation);
}
void CommandState::visit(StateArchive& archive) { STATE(archive, progress, error); }
void WaitingCommand::visit(StateArchive& archive) { STATE(archive, ticket, mode, request); }
void AxisRemark::visit(StateArchive& archive) { STATE(archive, event, text); }
void Overlay::visit(StateArchive& archive) { STATE(archive, profile, time, ticket); }
void Axis::Ended::visit(StateArchive& archive) { STATE(archive, ticket, state); }

void Axis::visit(StateArchive& archive) {
  STATE(archive, drive, control, parameters_, last_ticket_, ticket_, probe_ticket_, waiting_, ended_);
  STATE(archive, remarks_, base_, set_, acceleration_before_, cycle_time_, actual_, home_offset_, home_to_);
  STATE(archive, actual_velocity_, velocities_, profile_, profile_origin_, profile_time_, override_);
  STATE(archive, program_override_, leftover_, limits_, target_, overlay_, overlay_sum_, coupling_, link_);
  STATE(archive, profile_ends_, gear_dynamics_, error_, outputs_, state_, powered_, homed_, resetting_);
  STATE(archive, done_, latched_, stop_held_, speed_cut_, profile_ended_);
}

}  // namespace drycut::devices::plcopen
