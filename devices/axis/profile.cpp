#include "devices/axis/profile.hpp"

#include <algorithm>
#include <cmath>

namespace drycut::devices::axis {
namespace {

constexpr double for_ever = 1e18;  // [s]
constexpr double instant = 1e-9;   // [s] below which two times are the same
constexpr double rounding = 1e-6;  // [bits x4] of distance that a replan may lose

}  // namespace

double Plan::space() const {
  return ramp_space(lead) + ramp_space(first) + first.to * constant + ramp_space(last);
}

double Plan::space_at(double t) const {
  double space = 0;
  for (const Ramp* ramp : {&lead, &first}) {
    if (t < ramp->duration) return space + ramp_space(shape, *ramp, t);
    space += ramp_space(*ramp);
    t -= ramp->duration;
  }
  if (t < constant) return space + first.to * t;
  return space + first.to * constant + ramp_space(shape, last, std::min(t - constant, last.duration));
}

double Plan::speed_at(double t) const {
  for (const Ramp* ramp : {&lead, &first}) {
    if (t < ramp->duration) return ramp_speed(shape, *ramp, t);
    t -= ramp->duration;
  }
  if (t < constant) return first.to;
  return t - constant < last.duration ? ramp_speed(shape, last, t - constant) : last.to;
}

std::optional<Plan> plan_move(double speed, double distance, const Demand& demand) {
  const double up = demand.seconds_per_speed_up;
  const double down = demand.seconds_per_speed_down;
  const double stopping = speed * speed * down / 2;
  if (distance < stopping) {
    if (distance < stopping - rounding) return std::nullopt;
    distance = stopping;
  }

  if (distance <= 0 && speed <= 0) return Plan{demand.shape, {}, {}, 0, {}};
  const double target = std::max(demand.speed, 0.0);
  const double change_time = (target > speed ? up : down) * std::abs(target - speed);
  Plan plan{demand.shape, {}, {speed, target, change_time}, 0, {target, 0, target * down}};
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

Plan plan_stop(double speed, double distance, const Demand& demand) {
  Ramp last{speed, 0, speed * demand.seconds_per_speed_down};
  if (distance > 0 && ramp_space(last) > distance) last.duration = 2 * distance / speed;
  return {demand.shape, {}, {speed, speed, 0}, 0, last};
}

void Profile::adopt(const Plan& plan, double distance, const Progress& lead) {
  plan_ = plan;
  plan_.lead = lead.ramp;
  distance_ = distance;
  covered_ = lead.covered;
  time_ = begun_ = lead.time;
  periods_ = 0;
}

void Profile::move(double distance, const Demand& demand) {
  direction_ = distance < 0 ? -1 : 1;
  demand_ = demand;
  moving_ = true;
  stopping_ = false;
  adopt(*plan_move(0, std::abs(distance), demand), std::abs(distance));
}

void Profile::brake(double speed, const Demand& demand) {
  direction_ = speed < 0 ? -1 : 1;
  demand_ = demand;
  moving_ = true;
  stopping_ = true;
  const Plan plan = plan_stop(std::abs(speed), 0, demand);
  adopt(plan, plan.space());
}

bool Profile::replan(const Progress& kept, double distance, const Demand& demand) {
  const auto plan = plan_move(kept.ramp.to, distance - kept.left(), demand);
  if (!plan) return false;
  demand_ = demand;
  adopt(*plan, distance + kept.covered, kept);
  return true;
}

bool Profile::change(const Demand& demand) {
  return moving_ && !stopping_ && !in_last_ramp() && replan(unbent(), remaining(), demand);
}

bool Profile::retarget(double remaining) {
  return moving_ && !stopping_ && !in_last_ramp() && replan(unbent(), remaining * direction_, demand_);
}

bool Profile::resume(double remaining) {
  const double distance = remaining * direction_;
  if (!moving_ || stopping_) return true;
  if (replan(unbent(), distance, demand_) || replan(here(), distance, demand_)) return true;
  stopping_ = distance <= 0;
  const Plan plan = plan_stop(plan_.speed_at(time_), distance, demand_);
  adopt(plan, stopping_ ? plan.space() : distance);
  return !stopping_;
}

void Profile::stop(bool finish_ramp) {
  if (!moving_ || stopping_ || in_last_ramp()) return;
  stopping_ = true;
  const Progress kept = finish_ramp ? unbent() : here();
  const Plan plan = plan_stop(kept.ramp.to, remaining() - kept.left(), demand_);
  adopt(plan, ramp_space(kept.ramp) + plan.space(), kept);
}

double Profile::step(double period_s) {
  if (!moving_) return 0;
  ++periods_;
  time_ = begun_ + static_cast<double>(periods_) * period_s;
  const double before = covered_;
  moving_ = time_ < plan_.duration() - instant;
  covered_ = moving_ ? plan_.space_at(time_) : distance_;
  return direction_ * (covered_ - before);
}

Profile::Progress Profile::here() const {
  const double speed = plan_.speed_at(time_);
  return {{speed, speed, 0}, 0, 0};
}

Profile::Progress Profile::under_way() const {
  if (time_ < plan_.lead.duration) return {plan_.lead, time_, covered_};
  const double time = time_ - plan_.lead.duration;
  if (time < plan_.first.duration) return {plan_.first, time, covered_ - ramp_space(plan_.lead)};
  return here();
}

Phase Profile::phase() const {
  if (!moving_) return Phase::still;
  if (in_last_ramp()) return Phase::decelerating;
  const Ramp ramp = under_way().ramp;
  if (ramp.duration <= 0) return Phase::constant;
  return ramp.to >= ramp.from ? Phase::accelerating : Phase::decelerating;
}

bool Profile::in_last_ramp() const {
  const double begin = plan_.lead.duration + plan_.first.duration + plan_.constant;
  return moving_ && time_ >= begin && plan_.last.duration > 0;
}

}  // namespace drycut::devices::axis
