#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "base/units.hpp"

#include "devices/plcopen/axis.hpp"

// What an axis does in each cycle.
namespace drycut::devices::plcopen {
namespace {}  // namespace

void Axis::latch(double dt) {
  acceleration_before_ = set_.acceleration;
  cycle_time_ = dt;
  profile_ended_ = false;
  if (parameters_.kind == AxisKind::virtual_axis) return;
  const Position before = actual_;
  actual_ = position_of(drive.counts);
  double velocity = latched_ ? difference(actual_, before, modulo()) / dt : 0;
  latched_ = true;
  velocities_.push_back(velocity);
  const std::size_t keep =
      parameters_.average_filter ? static_cast<std::size_t>(parameters_.filter_cycles) : 1;
  while (velocities_.size() > keep) velocities_.pop_front();
  actual_velocity_ =
      std::accumulate(velocities_.begin(), velocities_.end(), 0.0) / static_cast<double>(velocities_.size());
}

void Axis::stand_on_actual() {
  if (parameters_.kind != AxisKind::virtual_axis) set_.position = actual_;
  set_.velocity = 0;
  set_.acceleration = 0;
  base_ = set_;
}

bool Axis::limited() const { return modulo() <= 0 && homed_ && parameters_.swe_neg < parameters_.swe_pos; }

bool Axis::passes_limit(const AxisMotion& next, bool with_braking) const {
  if (!limited()) return false;
  double end = next.position.part;
  if (with_braking) {
    const double braking = next.velocity * std::abs(next.velocity) /
                           (2 * parameters_.a_grenz_stufe_1 * increments_per_acceleration);
    end += braking;
  }
  constexpr double rounding = 1e-3;
  return end > parameters_.swe_pos + rounding || end < parameters_.swe_neg - rounding;
}

void Axis::move(double dt) {
  if (parameters_.kind == AxisKind::encoder) {
    base_ = set_ = {actual_, actual_velocity_, 0};
    return;
  }
  const bool drive_axis = parameters_.kind == AxisKind::drive;
  if (powered_ && drive_axis && !drive.ready) fault(ErrorId::drive_error);
  if (powered_ && drive.emergency_stop) fault(ErrorId::emergency_stop);
  if (state_ == AxisState::disabled) return stand_on_actual();
  if (state_ == AxisState::errorstop) return brake(dt);
  if (state_ == AxisState::homing) {
    move_zero(home_to_ - actual_.part);
    homed_ = true;
    done_ = true;
    state_ = AxisState::standstill;
    return;
  }
  if (profile_ || overlay_) run_profile(dt);
}

void Axis::move_zero(double shift) {
  home_offset_ += shift;
  actual_ = advanced(actual_, shift, modulo());
  set_.position = advanced(set_.position, shift, modulo());
  base_.position = set_.position;
}

void Axis::run_profile(double dt) {
  // The override slews so slowly that it takes no more than half of a_max by itself.
  const bool held = control.feed_hold || !control.feed_enable;
  const double wanted = held ? 0 : std::clamp(control.override_percent / 100, 0.0, 1.0) * program_override_;
  const double slew =
      parameters_.a_max / 2 * increments_per_acceleration * dt / (parameters_.vb_max * increments_per_speed);
  override_ = std::clamp(wanted, override_ - slew, override_ + slew);
  advance_overlay(dt * override_);
  advance(dt * override_);
}

void Axis::advance(double step) {
  AxisMotion next = base_;
  if (profile_) {
    profile_time_ += step;
    const MotionState state = at(*profile_, profile_time_);
    next = {advanced(profile_origin_, state.position, modulo()), state.velocity * override_,
            state.acceleration * override_ * override_};
  }
  const AxisMotion sum = with_overlay(next);
  if (passes_limit(sum, true)) {
    fault(ErrorId::software_limit);
    return brake(cycle_time_);
  }
  base_ = next;
  set_ = sum;
  if (profile_ && profile_time_ >= profile_->duration) return finish_profile();
  if (!profile_ && !overlay_) state_ = AxisState::standstill;
}

void Axis::finish_profile() {
  if (state_ == AxisState::continuous_motion) {
    done_ = true;
    // Begun anew from here, so that the way does not grow for ever.
    JerkProfile onward;
    onward.start = onward.end = {0, profile_->end.velocity, 0};
    run(onward);
    return;
  }
  // The next movement takes over at the target itself.
  const bool passes_over = profile_->end.velocity != 0;
  if (!passes_over && target_ && parameters_.kind == AxisKind::drive &&
      std::abs(following_error()) > parameters_.window)
    return;
  // The target itself, not the sum that has come there.
  if (target_) base_.position = *target_;
  if (passes_over) {
    leftover_ = profile_time_ - profile_->duration;
    base_.velocity = profile_->end.velocity * override_;
    base_.acceleration = 0;
  }
  set_ = with_overlay(base_);
  profile_.reset();
  done_ = true;
  if (passes_over || overlay_) return;
  if (state_ == AxisState::discrete_motion || !stop_held_) state_ = AxisState::standstill;
}

void Axis::brake(double dt) {
  if (!powered_ || !drive.ready) {
    stand_on_actual();
  } else {
    const double change = parameters_.a_grenz_stufe_1 * increments_per_acceleration * dt;
    const double before = base_.velocity;
    base_.velocity -= std::clamp(before, -change, change);
    base_.acceleration = (base_.velocity - before) / dt;
    base_.position = advanced(base_.position, (before + base_.velocity) / 2 * dt, modulo());
    set_ = base_;
  }
  if (set_.velocity != 0 || !resetting_) return;
  resetting_ = false;
  error_ = ErrorId::none;
  done_ = true;
  override_ = 1;
  base_.acceleration = set_.acceleration = 0;
  state_ = powered_ ? AxisState::standstill : AxisState::disabled;
}

CouplingLimits Axis::coupling_limits() const {
  const AxisParameters& p = parameters_;
  const double half = p.a_max / 2;
  const double steepest = half / (p.tr_min * units::microsecond);
  CouplingLimits limits;
  limits.window = p.v_diff_percent / 1000;
  limits.window_floor = p.vb_max / 1000 * increments_per_speed;
  limits.time_in_window = p.time_in_window * units::microsecond;
  limits.timeout = p.time_out_in_window * units::microsecond;
  limits.timeout_from_start = p.timeout_from_execute;
  double jerk = p.j_vel_sync > 0 ? std::min(p.j_vel_sync, steepest) : half / (p.tr_max * units::microsecond);
  limits.up = p.a_max * increments_per_acceleration;
  limits.down = limits.up;
  if (coupling_->cam() == nullptr) {
    if (gear_dynamics_.jerk > 0) jerk = gear_dynamics_.jerk;
    if (gear_dynamics_.acceleration > 0)
      limits.up = std::min(gear_dynamics_.acceleration, p.a_max) * increments_per_acceleration;
    if (gear_dynamics_.deceleration > 0)
      limits.down = std::min(gear_dynamics_.deceleration, p.a_max) * increments_per_acceleration;
  }
  limits.sync_jerk = jerk * increments_per_acceleration;
  limits.phasing = {std::min(p.v_phasing, p.vb_max / 2) * increments_per_speed,
                    std::min(p.a_phasing, half) * increments_per_acceleration,
                    std::min(p.d_phasing, half) * increments_per_acceleration,
                    std::min(p.j_phasing, steepest) * increments_per_acceleration};
  if (coupling_->cam() == nullptr)
    limits.phasing = {limits.phasing.velocity, limits.up, limits.down, limits.sync_jerk};
  limits.velocity = (p.v_max_slave > 0 ? p.v_max_slave : p.vb_max) * increments_per_speed;
  limits.acceleration = (p.a_max_slave > 0 ? p.a_max_slave : p.a_max) * increments_per_acceleration;
  return limits;
}

void Axis::follow(const AxisMotion& master, double dt) {
  const bool drive_axis = parameters_.kind == AxisKind::drive;
  if (drive_axis && !drive.ready) fault(ErrorId::drive_error);
  if (drive.emergency_stop && !parameters_.keep_coupling_on_lr_error) fault(ErrorId::emergency_stop);
  if (!control.feed_enable && !parameters_.keep_coupling_on_fe_drop) fault(ErrorId::feed_enable_dropped);
  if (state_ != AxisState::synchronized_motion) return brake(dt);
  advance_overlay(dt);
  AxisMotion next = base_;
  const std::int64_t ends_before = coupling_->profile_ends();
  const bool clamped_before = coupling_->clamped();
  const CouplingLimits limits = coupling_limits();
  const CouplingOutcome outcome = coupling_->step(master, next, dt, limits);
  const AxisMotion sum = with_overlay(next);
  // The cam's own range was checked when it was engaged; on the way to it the slave must be able to stop.
  if (outcome == CouplingOutcome::timed_out || passes_limit(sum, !coupling_->engaged())) {
    fault(outcome == CouplingOutcome::timed_out ? ErrorId::window_timeout : ErrorId::software_limit);
    return brake(dt);
  }
  base_ = next;
  set_ = sum;
  profile_ended_ = coupling_->profile_ends() != ends_before;
  profile_ends_ += coupling_->profile_ends() - ends_before;
  if (coupling_->clamped() && !clamped_before) {
    const bool speed = !coupling_->clamped_by_acceleration();
    const char* limit = speed ? "dynamik.vb_max" : "dynamik.a_max";
    if ((speed ? parameters_.v_max_slave : parameters_.a_max_slave) > 0)
      limit = speed ? "cam_gear.v_max_slave" : "cam_gear.a_max_slave";
    remarks_.push_back({"warning", fmt::format("{} asks for more than {} {} allows: the slave lags",
                                               coupling_->cam() != nullptr ? "the cam" : "the gear", limit,
                                               speed ? limits.velocity / increments_per_speed
                                                     : limits.acceleration / increments_per_acceleration)});
  }
  if (coupling_->engaged()) done_ = true;
  if (outcome == CouplingOutcome::pass_complete) {
    coupling_.reset();
    state_ = AxisState::standstill;
  }
}

}  // namespace drycut::devices::plcopen
