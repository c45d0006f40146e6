#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "devices/plcopen/axis.hpp"

// Movements of one axis: to a target or at a speed, one on top of the other, one after the other.
namespace drycut::devices::plcopen {
namespace {

/// Commands that have ended and whose blocks may not have been called since.
constexpr std::size_t most_ended = 16;

/// The largest of 0..`most` from which a movement with these limits comes to rest within `way`.
double speed_that_stops_within(double way, double most, const JerkLimits& limits) {
  const auto stops = [&](double speed) { return to_velocity({0, speed, 0}, 0, limits)->end.position <= way; };
  if (stops(most)) return most;
  double low = 0;
  double high = most;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (stops(middle) ? low : high) = middle;
  }
  return low;
}

}  // namespace

AxisMotion Axis::start_of(std::uint64_t ticket) const {
  if (ticket == 0) return set_;
  return {advanced(base_.position, overlay_sum_, modulo()), base_.velocity, base_.acceleration};
}

MotionState Axis::plan_from(const AxisMotion& from) const {
  // The profile runs slower by the override: in its own time the axis is faster than it seems.
  constexpr double standing = 1e-3;
  if (override_ < standing) return {};
  return {0, from.velocity / override_, from.acceleration / (override_ * override_)};
}

ErrorId Axis::check(const MoveRequest& request, JerkLimits& limits) const {
  if (!(request.dynamics.velocity >= 1)) return ErrorId::velocity_range;
  if (const ErrorId error = limits_of(request.dynamics, limits); error != ErrorId::none) return error;
  const bool endless = request.command == Command::move_velocity;
  if (!endless && !(std::abs(request.way) <= pin_max)) return ErrorId::position_range;
  const bool known = request.direction >= Direction::positive && request.direction <= Direction::current;
  return known && !(endless && request.direction == Direction::shortest_way) ? ErrorId::none
                                                                             : ErrorId::direction_range;
}

/// From where it starts to the target; of MC_MoveVelocity the sign alone counts.
double Axis::way_of(const MoveRequest& request, const AxisMotion& from, const JerkLimits& limits) const {
  double sign = 0;
  if (request.direction == Direction::positive) sign = 1;
  if (request.direction == Direction::negative) sign = -1;
  if (request.direction == Direction::current && from.velocity != 0) sign = from.velocity > 0 ? 1 : -1;
  if (request.command == Command::move_velocity) return sign != 0 ? sign : 1;
  if (request.command == Command::move_relative) return request.way;
  if (request.command == Command::move_additive) {
    const bool on_the_way = state_ == AxisState::discrete_motion && target_;
    return request.way + (on_the_way ? difference(*target_, base_.position, modulo()) : 0);
  }
  if (modulo() <= 0) return request.way - from.position.part;
  double way = shortest({0, request.way}, from.position, modulo());
  if (sign == 0) return way;
  // In a direction of its own the axis stops in front of the target, or goes once more round to it.
  const double least = std::max(0.0, sign * to_velocity(plan_from(from), 0, limits)->end.position);
  return way + sign * modulo() * std::ceil((least - sign * way) / modulo());
}

Order Axis::move(const MoveRequest& request, std::uint64_t ticket) {
  const CommandVerdict verdict = judge(state_, request.command);
  if (verdict.error != ErrorId::none) return {verdict.error};
  JerkLimits limits;
  if (const ErrorId error = check(request, limits); error != ErrorId::none) return {error};
  const AxisMotion from = start_of(ticket);
  const double way = way_of(request, from, limits);
  const bool endless = request.command == Command::move_velocity;
  Position target = advanced(from.position, way, modulo());
  // The target itself, not the sum that comes near it.
  if (request.command == Command::move_absolute)
    target = advanced(target, shortest({0, request.way}, target, modulo()), modulo());
  if (!endless && limited() && (target.part < parameters_.swe_neg || target.part > parameters_.swe_pos))
    return {ErrorId::position_range};
  const MotionState now = plan_from(from);
  const Order order = begin(verdict.to, ticket);
  limits_ = limits;
  run(endless ? *to_velocity(now, way * limits.velocity, limits) : *to_position(now, way, limits));
  if (!endless) target_ = target;
  speed_cut_ = request.dynamics.velocity > parameters_.vb_max;
  if (speed_cut_)
    remarks_.push_back({"warning", fmt::format("Velocity {} is above dynamik.vb_max: it goes at {}",
                                               request.dynamics.velocity, parameters_.vb_max)});
  return order;
}

Position Axis::target() const {
  if (!target_) return set_.position;
  return advanced(*target_, overlay_ ? overlay_->profile.end.position : 0, modulo());
}

CommandState Axis::state_of(std::uint64_t ticket) const {
  if (ticket == ticket_) {
    if (state_ == AxisState::errorstop && error_ != ErrorId::none) return {Progress::failed, error_};
    return {done_ ? Progress::done : Progress::active};
  }
  if (overlay_ && overlay_->ticket == ticket) return {Progress::active};
  for (const WaitingCommand& waiting : waiting_)
    if (waiting.ticket == ticket) return {Progress::waiting};
  for (const Ended& ended : ended_)
    if (ended.ticket == ticket) return ended.state;
  return {Progress::aborted};
}

void Axis::remember(std::uint64_t ticket, CommandState state) {
  // A speed or a coupling goes on when it is reached: who takes over aborts it.
  const bool goes_on = state_ == AxisState::continuous_motion || state_ == AxisState::synchronized_motion;
  const bool open = state.progress == Progress::active || (ticket == ticket_ && goes_on);
  if (open && state.progress != Progress::failed) state = {Progress::aborted};
  ended_.push_back({ticket, state});
  if (ended_.size() > most_ended) ended_.pop_front();
}

void Axis::abort_waiting(CommandState state) {
  for (const WaitingCommand& waiting : waiting_) ended_.push_back({waiting.ticket, state});
  while (ended_.size() > most_ended) ended_.pop_front();
  waiting_.clear();
}

bool Axis::takes_next() const {
  switch (state_) {
    case AxisState::discrete_motion:
    case AxisState::continuous_motion:
      return done_;
    case AxisState::synchronized_motion:
      return coupling_->cam() != nullptr ? profile_ended_ : done_;
    case AxisState::homing:
    case AxisState::stopping:
      return false;
    default:
      return true;
  }
}

Order Axis::wait(const Request& request, BufferMode mode) {
  if (waiting_.size() >= most_waiting) return {ErrorId::too_many_waiting};
  waiting_.push_back({++last_ticket_, mode, request});
  if (waiting_.size() == 1) blend();
  return {ErrorId::none, last_ticket_};
}

WaitingCommand Axis::take_next() {
  WaitingCommand next = waiting_.front();
  waiting_.pop_front();
  return next;
}

void Axis::drop(std::uint64_t ticket, ErrorId error) {
  ended_.push_back({ticket, {Progress::failed, error}});
  abort_waiting({Progress::aborted});
  if (state_ != AxisState::discrete_motion || profile_ || base_.velocity == 0) return;
  target_.reset();
  run(*to_velocity(plan_from(base_), 0, limits_));
}

double Axis::changeover_speed(const WaitingCommand& next) const {
  const auto* request = std::get_if<MoveRequest>(&next.request);
  JerkLimits limits;
  if (request == nullptr || check(*request, limits) != ErrorId::none) return 0;
  if (next.mode < BufferMode::blending_low) return 0;
  const std::array speeds{std::min(limits_.velocity, limits.velocity), limits_.velocity, limits.velocity,
                          std::max(limits_.velocity, limits.velocity)};
  double speed =
      speeds.at(static_cast<std::size_t>(next.mode) - static_cast<std::size_t>(BufferMode::blending_low));
  // Where the next one turns back or has not the room to stop, no more speed than it can do with.
  const double sign = difference(*target_, base_.position, modulo()) < 0 ? -1 : 1;
  AxisMotion there{*target_, sign * speed, 0};
  const bool additive = request->command == Command::move_additive;
  const double way = additive ? request->way : way_of(*request, there, limits);
  if (sign * way <= 0) return 0;
  if (request->command != Command::move_velocity)
    speed = speed_that_stops_within(std::abs(way), speed, limits);
  return sign * speed;
}

void Axis::blend() {
  if (waiting_.empty() || state_ != AxisState::discrete_motion || !profile_ || !target_) return;
  const double speed = changeover_speed(waiting_.front());
  if (speed == 0) return;
  const double way = difference(*target_, base_.position, modulo());
  run(*to_position(plan_from(base_), way, limits_, speed));
}

void Axis::run_on() {
  const double rest = std::exchange(leftover_, 0);
  if (rest > 0 && profile_) advance(rest);
}

Order Axis::superimpose(double distance, const Dynamics& dynamics) {
  const CommandVerdict verdict = judge(state_, Command::move_superimposed);
  if (verdict.error != ErrorId::none) return {verdict.error};
  const MoveRequest alone{Command::move_relative, distance, dynamics};
  if (state_ == AxisState::standstill) return move(alone);
  JerkLimits limits;
  if (const ErrorId error = check(alone, limits); error != ErrorId::none) return {error};
  MotionState now;
  if (overlay_) {
    // The one before ends where it has come to; this one goes on from its speed.
    now = at(overlay_->profile, overlay_->time);
    shift(now.position);
    now.position = 0;
    remember(overlay_->ticket, {Progress::aborted});
  }
  overlay_ = Overlay{*to_position(now, distance, limits), 0, ++last_ticket_};
  return {ErrorId::none, last_ticket_};
}

void Axis::shift(double way) {
  if (coupling_) {
    overlay_sum_ += way;
    return;
  }
  base_.position = advanced(base_.position, way, modulo());
  profile_origin_ = advanced(profile_origin_, way, modulo());
  if (target_) target_ = advanced(*target_, way, modulo());
}

void Axis::end_overlay(CommandState state) {
  if (overlay_) remember(overlay_->ticket, state);
  overlay_.reset();
  overlay_sum_ = 0;
  base_ = set_;
}

void Axis::advance_overlay(double step) {
  if (!overlay_) return;
  overlay_->time += step;
  if (overlay_->time < overlay_->profile.duration) return;
  shift(overlay_->profile.end.position);
  remember(overlay_->ticket, {Progress::done});
  overlay_.reset();
}

AxisMotion Axis::with_overlay(const AxisMotion& base) const {
  if (!overlay_ && overlay_sum_ == 0) return base;
  const MotionState more = overlay_ ? at(overlay_->profile, overlay_->time) : MotionState{};
  return {advanced(base.position, overlay_sum_ + more.position, modulo()),
          base.velocity + more.velocity * override_,
          base.acceleration + more.acceleration * override_ * override_};
}

}  // namespace drycut::devices::plcopen
