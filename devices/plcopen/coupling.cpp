#include "devices/plcopen/coupling.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/state_archive.hpp"

namespace drycut::devices::plcopen {
namespace {

/// Sums of cycles are compared with times that are whole cycles.
constexpr double time_rounding = 1e-9;

/// Turns count round for ever: with the largest scalings a product may pass the end of the numbers.
std::int64_t times(std::int64_t a, std::int64_t b) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) * static_cast<std::uint64_t>(b));
}
std::int64_t plus(std::int64_t a, std::int64_t b) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) + static_cast<std::uint64_t>(b));
}

AxisMotion displaced(AxisMotion motion, const MotionState& by, double modulo) {
  motion.position = advanced(motion.position, by.position, modulo);
  motion.velocity += by.velocity;
  motion.acceleration += by.acceleration;
  return motion;
}

bool in_window(const AxisMotion& wanted, const AxisMotion& slave, const CouplingLimits& limits) {
  return std::abs(slave.velocity - wanted.velocity) <=
         limits.window * std::max(std::abs(wanted.velocity), limits.window_floor);
}

}  // namespace

void Coupling::take_over(const Coupling& before, const AxisMotion& master, const AxisMotion& slave,
                         double tolerance) {
  const CamFollow* cam = this->cam();
  if (cam == nullptr || before.cam() == nullptr) return;
  shift_sum_ = before.shift_sum_;
  shift_profile_ = before.shift_profile_;
  shift_time_ = before.shift_time_;
  if (!before.engaged() || !cam->periodic) return;
  const Target place = target(master);
  const AxisMotion& wanted = place.motion;
  const double away = shortest(slave.position, wanted.position, slave_modulo_);
  if (std::abs(away) > tolerance || std::abs(slave.velocity - wanted.velocity) > tolerance) return;
  if (slave_modulo_ > 0)
    slave_turns_ +=
        std::llround((difference(slave.position, wanted.position, slave_modulo_) - away) / slave_modulo_);
  phase_ = CouplingPhase::coupled;
  last_cycle_ = place.cycle;
  last_cycle_known_ = true;
}

void Coupling::start_in_place(const AxisMotion& master, const AxisMotion& slave, double tolerance) {
  const AxisMotion wanted = start_of_cam();
  const double away = shortest(slave.position, wanted.position, slave_modulo_);
  if (slave.velocity != 0 || slave.acceleration != 0 || std::abs(away) > tolerance) return;
  if (slave_modulo_ > 0)
    slave_turns_ +=
        std::llround((difference(slave.position, wanted.position, slave_modulo_) - away) / slave_modulo_);
  phase_ = CouplingPhase::wait_zero;
  const Target place = target(master);
  wait_for_zero(place);
  last_cycle_ = place.cycle;
  last_cycle_known_ = true;
}

MotionState Coupling::shift() const {
  MotionState shift = shift_profile_ ? at(*shift_profile_, shift_time_) : MotionState{};
  shift.position += shift_sum_;
  return shift;
}

bool Coupling::shift_phase(double shift_by, const JerkLimits& limits) {
  MotionState now = shift();
  now.position = 0;
  const double sum = shift().position;
  std::optional<JerkProfile> profile = to_position(now, shift_by, limits);
  if (!profile) return false;
  ++shifts_;
  shift_sum_ = sum;
  shift_profile_ = profile;
  shift_time_ = 0;
  return true;
}

Position Coupling::place(const CamFollow& cam, const AxisMotion& master) const {
  const auto scaling = static_cast<double>(cam.master_scaling);
  return normalised({times(cam.master_scaling, master.position.turns),
                     scaling * master.position.part + cam.master_offset + shift().position},
                    cam.curve.master_length);
}

Coupling::Target Coupling::cam_target(const CamFollow& cam, const AxisMotion& master) const {
  const MotionState phase_shift = shift();
  const auto scaling = static_cast<double>(cam.master_scaling);
  const Position x = place(cam, master);
  const CamMotion slave = at(cam.curve, x.part);
  const double dx = scaling * master.velocity + phase_shift.velocity;
  const double ddx = scaling * master.acceleration + phase_shift.acceleration;
  const std::int64_t turns = std::llround(cam.slave_scaling * static_cast<double>(cam.curve.turns));
  Target target;
  target.cycle = x.turns;
  target.x = x.part;
  target.motion.position = normalised({plus(times(turns, x.turns - first_cycle_), slave_turns_),
                                       cam.slave_scaling * slave.position + cam.slave_offset},
                                      slave_modulo_);
  target.motion.velocity = cam.slave_scaling * slave.velocity * dx;
  target.motion.acceleration = cam.slave_scaling * (slave.acceleration * dx * dx + slave.velocity * ddx);
  return target;
}

AxisMotion Coupling::gear_target(const GearFollow& gear, const AxisMotion& master) const {
  const MotionState phase_shift = shift();
  const double ratio = static_cast<double>(gear.numerator) / static_cast<double>(gear.denominator);
  const double way = difference(master.position, gear_master_, gear.master_modulo) + phase_shift.position;
  return {
      advanced(gear_slave_, way * static_cast<double>(gear.numerator) / static_cast<double>(gear.denominator),
               slave_modulo_),
      ratio * (master.velocity + phase_shift.velocity),
      ratio * (master.acceleration + phase_shift.acceleration)};
}

Coupling::Target Coupling::target(const AxisMotion& master) const {
  if (const CamFollow* cam = this->cam()) return cam_target(*cam, master);
  return {gear_target(std::get<GearFollow>(law_), master), 0, 0};
}

AxisMotion Coupling::start_of_cam() const {
  const auto& cam = std::get<CamFollow>(law_);
  const double start = cam.slave_scaling * at(cam.curve, 0).position + cam.slave_offset;
  return {normalised({slave_turns_, start}, slave_modulo_), 0, 0};
}

CouplingOutcome Coupling::step(const AxisMotion& master, AxisMotion& slave, double dt,
                               const CouplingLimits& limits) {
  if (shift_profile_) {
    shift_time_ += dt;
    if (shift_time_ >= shift_profile_->duration) {
      shift_sum_ += shift_profile_->end.position;
      shift_profile_.reset();
    }
  }
  rebase_gear(master);
  const CamFollow* cam = this->cam();
  const Target place = target(master);
  CouplingOutcome outcome = CouplingOutcome::follows;
  const bool to_start = cam != nullptr && !cam->periodic && !engaged();
  const AxisMotion wanted = to_start ? start_of_cam() : place.motion;
  if (phase_ == CouplingPhase::slip || phase_ == CouplingPhase::window) {
    outcome = synchronise(wanted, master, slave, dt, limits);
  } else if (phase_ == CouplingPhase::phasing) {
    offset_time_ += dt;
    follow(displaced(wanted, at(offset_profile_, offset_time_), slave_modulo_), slave, dt, limits);
    if (offset_time_ >= offset_profile_.duration) {
      // Of a gear the offset remains: where the slave came to have the speed is where it is coupled.
      if (cam == nullptr)
        gear_slave_ = advanced(gear_slave_, at(offset_profile_, offset_time_).position, slave_modulo_);
      phase_ = to_start ? CouplingPhase::wait_zero : CouplingPhase::coupled;
    }
  } else if (phase_ == CouplingPhase::wait_zero) {
    wait_for_zero(place);
    follow(engaged() ? target(master).motion : wanted, slave, dt, limits);
  } else if (running_pass()) {
    follow(wanted, slave, dt, limits);
    outcome = run_pass(place, slave);
  } else {
    follow(wanted, slave, dt, limits);
    if (last_cycle_known_) profile_ends_ += std::abs(place.cycle - last_cycle_);
  }
  last_cycle_ = place.cycle;
  last_cycle_known_ = true;
  return outcome;
}

CouplingOutcome Coupling::synchronise(const AxisMotion& wanted, const AxisMotion& master, AxisMotion& slave,
                                      double dt, const CouplingLimits& limits) {
  // Relative to a cam that goes on accelerating as it does now, the jerk of the slave is its own: the limit
  // holds whatever the cam does. Its acceleration is met only as far as the slave can have it.
  const double speed = std::clamp(wanted.velocity, -limits.velocity, limits.velocity);
  const double up = wanted.velocity < 0 ? limits.down : limits.up;
  const double down = wanted.velocity < 0 ? limits.up : limits.down;
  const double reach = 0.9;
  const double a = speed == wanted.velocity ? std::clamp(wanted.acceleration, -reach * down, reach * up) : 0;
  const std::optional<JerkProfile> profile = to_velocity(
      {0, slave.velocity - (speed - a * dt), slave.acceleration - a}, 0, up - a, down + a, limits.sync_jerk);
  if (!profile) return CouplingOutcome::timed_out;
  const MotionState relative = at(*profile, dt);
  slave.position = advanced(slave.position, relative.position + speed * dt - a * dt * dt / 2, slave_modulo_);
  slave.velocity = speed + relative.velocity;
  slave.acceleration = a + relative.acceleration;

  if (phase_ == CouplingPhase::window || limits.timeout_from_start) time_ += dt;
  const bool inside = in_window(wanted, slave, limits);
  if (phase_ == CouplingPhase::slip && inside) {
    phase_ = CouplingPhase::window;
    if (!limits.timeout_from_start) time_ = 0;
    time_in_window_ = 0;
    if (limits.time_in_window <= 0) begin_phasing(wanted, master, slave, limits);
    return CouplingOutcome::follows;
  }
  if (phase_ == CouplingPhase::window) {
    time_in_window_ = inside ? time_in_window_ + dt : 0;
    if (time_in_window_ >= limits.time_in_window - time_rounding) {
      begin_phasing(wanted, master, slave, limits);
      return CouplingOutcome::follows;
    }
  }
  return time_ > limits.timeout - time_rounding && time_ > 0 ? CouplingOutcome::timed_out
                                                             : CouplingOutcome::follows;
}

void Coupling::begin_phasing(const AxisMotion& wanted, const AxisMotion& master, const AxisMotion& slave,
                             const CouplingLimits& limits) {
  phase_ = CouplingPhase::phasing;
  offset_time_ = 0;
  MotionState offset{0, slave.velocity - wanted.velocity, slave.acceleration - wanted.acceleration};
  if (cam() == nullptr) {
    gear_master_ = master.position;
    gear_slave_ = slave.position;
    offset_profile_ = *to_velocity(offset, 0, limits.phasing);
  } else {
    offset.position = difference(slave.position, wanted.position, slave_modulo_);
    if (slave_modulo_ > 0) {
      const std::int64_t turns = std::llround(offset.position / slave_modulo_);
      slave_turns_ += turns;
      offset.position -= static_cast<double>(turns) * slave_modulo_;
    }
    offset_profile_ = *to_position(offset, 0, limits.phasing);
  }
}

void Coupling::follow(const AxisMotion& wanted, AxisMotion& slave, double dt, const CouplingLimits& limits) {
  const double way = difference(wanted.position, slave.position, slave_modulo_);
  const double most = limits.velocity * dt * (1 + 1e-9);
  clamped_ = by_acceleration_ = false;
  if (cam() != nullptr) {
    if (std::abs(way) <= most) {
      slave = wanted;
      return;
    }
    clamped_ = true;
    slave.velocity = std::copysign(limits.velocity, way);
    slave.acceleration = 0;
    slave.position = advanced(slave.position, slave.velocity * dt, slave_modulo_);
    return;
  }
  const double change = limits.acceleration * dt * (1 + 1e-9);
  if (std::abs(way) <= most && std::abs(way / dt - slave.velocity) <= change &&
      std::abs(wanted.velocity - slave.velocity) <= change &&
      std::abs(wanted.acceleration) <= limits.acceleration * (1 + 1e-9)) {
    slave = wanted;
    return;
  }
  clamped_ = true;
  by_acceleration_ = std::abs(way) <= most;
  // Beyond its acceleration the slave lags and catches up no faster than it can brake again.
  const double lag = way - wanted.velocity * dt;
  const double catching_up =
      std::copysign(std::min(std::abs(lag) / dt, std::sqrt(2 * limits.acceleration * std::abs(lag))), lag);
  double speed = std::clamp(wanted.velocity + catching_up, slave.velocity - change, slave.velocity + change);
  speed = std::clamp(speed, -limits.velocity, limits.velocity);
  slave.acceleration = (speed - slave.velocity) / dt;
  slave.velocity = speed;
  slave.position = advanced(slave.position, speed * dt, slave_modulo_);
}

void Coupling::wait_for_zero(const Target& place) {
  std::int64_t origin = place.cycle;
  if (last_cycle_known_ && place.cycle < last_cycle_)
    origin = last_cycle_;
  else if (place.x != 0 && !(last_cycle_known_ && place.cycle > last_cycle_))
    return;
  pass_origin_ = origin;
  first_cycle_ = origin;
  phase_ = CouplingPhase::coupled;
}

CouplingOutcome Coupling::run_pass(const Target& place, AxisMotion& slave) {
  const bool forward = place.cycle > pass_origin_;
  const bool backward = place.cycle < pass_origin_ - 1 || (place.cycle == pass_origin_ - 1 && place.x == 0);
  if (!forward && !backward) return CouplingOutcome::follows;
  ++profile_ends_;
  if (extra_pass_) {
    extra_pass_ = false;
    pass_origin_ += forward ? 1 : -1;
    return CouplingOutcome::follows;
  }
  // The cam is run exactly once: the slave stops at its end, however far the master has gone beyond.
  const auto& cam = std::get<CamFollow>(law_);
  const std::int64_t turns = std::llround(cam.slave_scaling * static_cast<double>(cam.curve.turns));
  const double start = at(cam.curve, 0).position;
  const double end = cam.curve.even ? cam.curve.pieces.back().end().position
                                    : start + static_cast<double>(cam.curve.turns) * slave_modulo_;
  const std::int64_t cycles = (forward ? pass_origin_ : pass_origin_ - 1) - first_cycle_;
  slave.position = normalised({plus(slave_turns_, times(turns, cycles)),
                               cam.slave_scaling * (forward ? end : start) + cam.slave_offset},
                              slave_modulo_);
  slave.velocity = 0;
  slave.acceleration = 0;
  return CouplingOutcome::pass_complete;
}

void Coupling::rebase_gear(const AxisMotion& master) {
  const auto* gear = std::get_if<GearFollow>(&law_);
  if (gear == nullptr || gear->master_modulo <= 0) return;
  // After `denominator` turns of the master the slave has come a whole number of increments: taken out, the
  // rest stays small and exact however long the gear runs.
  const std::int64_t times = (master.position.turns - gear_master_.turns) / gear->denominator;
  if (times == 0) return;
  gear_master_.turns += times * gear->denominator;
  __extension__ using Wide = __int128;
  const Wide way =
      static_cast<Wide>(times) * gear->numerator * static_cast<std::int64_t>(gear->master_modulo);
  if (slave_modulo_ <= 0) {
    gear_slave_.part += static_cast<double>(way);
    return;
  }
  const auto turn = static_cast<std::int64_t>(slave_modulo_);
  gear_slave_.turns = plus(gear_slave_.turns, static_cast<std::int64_t>(way / turn));
  gear_slave_ = advanced(gear_slave_, static_cast<double>(way % turn), slave_modulo_);
}

void Position::visit(StateArchive& archive) { STATE(archive, turns, part); }
void AxisMotion::visit(StateArchive& archive) { STATE(archive, position, velocity, acceleration); }
void CamFollow::visit(StateArchive& archive) {
  STATE(archive, curve, master_scaling, slave_scaling, master_offset, slave_offset, periodic);
}
void GearFollow::visit(StateArchive& archive) { STATE(archive, numerator, denominator, master_modulo); }

void Coupling::visit(StateArchive& archive) {
  STATE(archive, law_, slave_modulo_, phase_, clamped_, by_acceleration_, time_, time_in_window_);
  STATE(archive, offset_profile_, offset_time_, shifts_, shift_sum_, shift_profile_, shift_time_);
  STATE(archive, first_cycle_, slave_turns_, last_cycle_, last_cycle_known_, pass_origin_, extra_pass_);
  STATE(archive, profile_ends_, gear_master_, gear_slave_);
}

}  // namespace drycut::devices::plcopen
