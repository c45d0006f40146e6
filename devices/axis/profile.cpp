#include "devices/axis/profile.hpp"

#include <algorithm>
#include <cmath>

namespace drycut::devices::axis {
namespace {

constexpr double for_ever = 1e18;  // [s]
constexpr double instant = 1e-9;   // [s] below which two times are the same
constexpr double rounding = 1e-6;  // [bits x4] of distance that a replan may lose

}  // namespace

double Plan::space() const { return ramp_space(first) + first.to * constant + ramp_space(last); }

double Plan::space_at(double t) const {
  if (t < first.duration) return ramp_space(shape, first, t);
  const double after_first = t - first.duration;
  if (after_first < constant) return ramp_space(first) + first.to * after_first;
  const double in_last = std::min(after_first - constant, last.duration);
  return ramp_space(first) + first.to * constant + ramp_space(shape, last, in_last);
}

double Plan::speed_at(double t) const {
  if (t < first.duration) return ramp_speed(shape, first, t);
  const double after_first = t - first.duration;
  if (after_first < constant) return first.to;
  return after_first - constant < last.duration ? ramp_speed(shape, last, after_first - constant) : last.to;
}

std::optional<Plan> plan_move(double speed, double distance, const Demand& demand) {
  const double up = demand.seconds_per_speed_up;
  const double down = demand.seconds_per_speed_down;
  const double stopping = speed * speed * down / 2;
  if (distance < stopping) {
    if (distance < stopping - rounding) return std::nullopt;
    distance = stopping;
  }

  if (distance <= 0 && speed <= 0) return Plan{demand.shape, {}, 0, {}};
  const double target = std::max(demand.speed, 0.0);
  const double change_time = (target > speed ? up : down) * std::abs(target - speed);
  Plan plan{demand.shape, {speed, target, change_time}, 0, {target, 0, target * down}};
  const double ramps = ramp_space(plan.first) + ramp_space(plan.last);
  if (ramps <= distance || target <= speed) {
    plan.constant = target > 0 ? std::max(distance - ramps, 0.0) / target : for_ever;
    return plan;
  }

  // Profile reduction: the ramps meet at a lower peak.
  const bool keep_times = demand.shape == RampShape::epicycloidal && !demand.keep_gradient && speed == 0;
  if (keep_times) {
    const double peak = 2 * distance / (plan.first.duration + plan.last.duration);
    plan.first.to = plan.last.from = peak;
  } else {
    const double peak = std::max(speed, std::sqrt((2 * distance + speed * speed * up) / (up + down)));
    plan.first = {speed, peak, (peak - speed) * up};
    plan.last = {peak, 0, peak * down};
  }
  return plan;
}

Plan plan_stop(double speed, const Demand& demand) {
  return {demand.shape, {speed, speed, 0}, 0, {speed, 0, speed * demand.seconds_per_speed_down}};
}

void Profile::adopt(const Plan& plan) {
  plan_ = plan;
  distance_ = plan.space();
  covered_ = 0;
  time_ = 0;
  periods_ = 0;
  change_waits_ = false;
}

void Profile::move(double distance, const Demand& demand) {
  direction_ = distance < 0 ? -1 : 1;
  demand_ = demand;
  moving_ = true;
  stopping_ = false;
  adopt(*plan_move(0, std::abs(distance), demand));
  distance_ = std::abs(distance);
}

void Profile::brake(double speed, const Demand& demand) {
  direction_ = speed < 0 ? -1 : 1;
  demand_ = demand;
  moving_ = true;
  stopping_ = true;
  adopt(plan_stop(std::abs(speed), demand));
}

bool Profile::change(const Demand& demand) {
  if (!moving_ || stopping_ || in_last_ramp()) return false;
  if (plan_.shape == RampShape::epicycloidal && in_first_ramp()) {
    demand_ = demand;
    change_waits_ = true;
    return true;
  }
  const double distance = remaining();
  const auto plan = plan_move(plan_.speed_at(time_), distance, demand);
  if (!plan) return false;
  demand_ = demand;
  adopt(*plan);
  distance_ = distance;
  return true;
}

bool Profile::retarget(double remaining) {
  if (!moving_ || stopping_ || in_last_ramp()) return false;
  const double distance = remaining * direction_;
  if (plan_.shape == RampShape::epicycloidal && in_first_ramp()) {
    // The running ramp stays; what follows it takes up the difference.
    const double after_first = distance + covered_ - ramp_space(plan_.first);
    const double spare = after_first - ramp_space(plan_.last);
    if (spare < -rounding) return false;
    if (plan_.first.to > 0) plan_.constant = std::max(spare, 0.0) / plan_.first.to;
    distance_ = distance + covered_;
    return true;
  }
  const auto plan = distance < 0 ? std::nullopt : plan_move(plan_.speed_at(time_), distance, demand_);
  if (!plan) return false;
  adopt(*plan);
  distance_ = distance;
  return true;
}

void Profile::stop(bool finish_ramp, const Demand& demand) {
  if (!moving_ || stopping_ || in_last_ramp()) return;
  stopping_ = true;
  change_waits_ = false;
  if (finish_ramp && plan_.shape == RampShape::epicycloidal && in_first_ramp()) {
    plan_.constant = 0;
    plan_.last = {plan_.first.to, 0, plan_.first.to * demand.seconds_per_speed_down};
    distance_ = plan_.space();
    return;
  }
  Plan plan = plan_stop(plan_.speed_at(time_), demand);
  plan.shape = plan_.shape;
  adopt(plan);
}

double Profile::step(double period_s) {
  if (!moving_) return 0;
  ++periods_;
  time_ = static_cast<double>(periods_) * period_s;
  const double before = covered_;
  if (time_ >= plan_.duration() - instant) {
    moving_ = false;
    covered_ = stopping_ ? plan_.space() : distance_;
  } else {
    covered_ = plan_.space_at(time_);
    if (change_waits_ && !in_first_ramp()) {
      change_waits_ = false;
      const double way = covered_ - before;
      change(demand_);
      return direction_ * way;
    }
  }
  return direction_ * (covered_ - before);
}

Phase Profile::phase() const {
  if (!moving_) return Phase::still;
  if (in_first_ramp()) return plan_.first.to >= plan_.first.from ? Phase::accelerating : Phase::decelerating;
  return in_last_ramp() ? Phase::decelerating : Phase::constant;
}

bool Profile::in_last_ramp() const {
  return moving_ && time_ >= plan_.first.duration + plan_.constant && plan_.last.duration > 0;
}

}  // namespace drycut::devices::axis
