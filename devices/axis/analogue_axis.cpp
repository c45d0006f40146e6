#include "devices/axis/analogue_axis.hpp"

#include <cmath>

namespace drycut::devices::axis {
namespace {

// Further than any quota can be: the way of a run without limit [bits x4].
constexpr double unlimited = 1e15;

}  // namespace

void AnalogueAxis::follow(std::int64_t raw, bool locked, bool reversed) {
  counted_ = transducer_.follow(raw, locked, reversed);
  quota.count(counted_, settings.resolution);
  frequency_new_ = frequency_.sample(counted_, settings.period_ms, settings.frequency_window_ms);
}

Demand AnalogueAxis::demand(std::int32_t speed) const {
  Demand demand = settings.ramps;
  demand.speed = speed * settings.bits_per_speed;
  return demand;
}

double AnalogueAxis::theoretical_way_to(std::int32_t target) const {
  return quota.bits_to(target, settings.resolution) - error();
}

void AnalogueAxis::place(std::int32_t target, std::int32_t speed) {
  target_ = target;
  placing_ = true;
  placed_.reset();
  profile_.move(theoretical_way_to(target), demand(speed));
}

void AnalogueAxis::run(bool backward, std::optional<std::int32_t> limit, std::int32_t speed) {
  target_ = limit;
  placing_ = false;
  placed_.reset();
  const double way = limit ? theoretical_way_to(*limit) : backward ? -unlimited : unlimited;
  profile_.move(way, demand(speed));
}

void AnalogueAxis::stop() { profile_.stop(settings.finish_ramp, settings.ramps); }

void AnalogueAxis::brake(double bits_per_second) {
  target_.reset();
  placing_ = false;
  placed_.reset();
  profile_.brake(bits_per_second, settings.ramps);
}

void AnalogueAxis::abort() {
  profile_.abort();
  target_.reset();
  placed_.reset();
  placing_ = false;
}

bool AnalogueAxis::change(std::int32_t speed) { return profile_.change(demand(speed)); }

bool AnalogueAxis::retarget(std::int32_t target) {
  if (!placing_ || !profile_.retarget(theoretical_way_to(target))) return false;
  target_ = target;
  return true;
}

void AnalogueAxis::requota() {
  if (!profile_.moving() || profile_.stopping() || !target_) return;
  if (!profile_.retarget(theoretical_way_to(*target_))) {
    target_.reset();
    placing_ = false;
    stop();
  }
}

void AnalogueAxis::settle() {
  theoretical_ = {transducer_.total(), 0};
  regulator_.reset();
  if (target_) requota();
}

bool AnalogueAxis::step_profile() {
  if (!profile_.moving()) {
    speed_ = 0;
    return false;
  }
  const double period_s = settings.period_ms / 1000.0;
  theoretical_.add(profile_.step(period_s));
  speed_ = profile_.speed();
  if (profile_.moving()) return false;
  if (target_ && !profile_.stopping()) {
    // The profile ends on the quota itself: no rounding of its arithmetic is left.
    theoretical_.add(theoretical_way_to(*target_));
    if (placing_) placed_ = target_;
  }
  return true;
}

void AnalogueAxis::regulate(Drive drive, std::int32_t tenths) {
  const RegulatorScale scale{settings.max_speed, settings.period_ms / 1000.0, settings.term_limit};
  actions_ = {};
  switch (drive) {
    case Drive::reaction:
      actions_ = regulator_.react(settings.gains, scale, speed_, error());
      output_ = to_dac(actions_.sum() + settings.offset);
      break;
    case Drive::open_loop:
      actions_ = Regulator::steer(settings.gains, scale, speed_);
      output_ = to_dac(actions_.sum() + settings.offset);
      break;
    case Drive::calibration:
      theoretical_ = {transducer_.total(), 0};
      output_ = to_dac(dac_bits_of_tenths(tenths) + settings.offset);
      break;
    case Drive::emergency:
      settle();
      output_ = {};
      break;
    case Drive::frozen:
      theoretical_ = {transducer_.total(), 0};
      output_.saturated = 0;
      break;
  }
  following_error_ = hold_.sample(std::abs(error()) > settings.max_following_error, settings.period_ms);
}

}  // namespace drycut::devices::axis
