#include "devices/axis/analogue_axis.hpp"

#include <algorithm>
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

void AnalogueAxis::settle_if_open() {
  if (drive_ == Drive::open_loop && !settings.simulated) settle();
}

void AnalogueAxis::place(std::int32_t target, std::int32_t speed) {
  settle_if_open();
  target_ = target;
  placing_ = true;
  placed_.reset();
  depart(theoretical_way_to(target), speed);
}

void AnalogueAxis::run(bool backward, std::optional<std::int32_t> limit, std::int32_t speed) {
  settle_if_open();
  target_ = limit;
  placing_ = false;
  placed_.reset();
  const double way = limit ? theoretical_way_to(*limit) : backward ? -unlimited : unlimited;
  depart(way, speed);
}

void AnalogueAxis::depart(double way, std::int32_t speed) {
  profile_.move(way, demand(speed));
  const bool turns = way != 0 && profile_.backward() != last_backward_;
  pause_ms_ = turns ? std::max(settings.reversal_pause_ms - rest_ms_, 0) : 0;
}

void AnalogueAxis::stop() {
  // A movement that still waits to begin has no ramp to finish.
  profile_.stop(settings.finish_ramp && pause_ms_ == 0);
  pause_ms_ = 0;
  if (profile_.stopping()) placing_ = false;
}

void AnalogueAxis::brake(double bits_per_second, const Demand& ramp) {
  target_.reset();
  placing_ = false;
  pause_ms_ = 0;
  profile_.brake(bits_per_second, ramp);
}

void AnalogueAxis::abort() {
  profile_.abort();
  pause_ms_ = 0;
  target_.reset();
  placing_ = false;
}

bool AnalogueAxis::change(const Demand& before, const Demand& after) {
  Demand demand = profile_.demand();
  const auto take = [&](auto Demand::*part) {
    if (before.*part != after.*part) demand.*part = after.*part;
  };
  take(&Demand::speed);
  take(&Demand::seconds_per_speed_up);
  take(&Demand::seconds_per_speed_down);
  take(&Demand::keep_gradient);
  return demand == profile_.demand() || profile_.change(demand);
}

bool AnalogueAxis::retarget(std::int32_t target) {
  if (!placing_ || !profile_.retarget(theoretical_way_to(target))) return false;
  target_ = target;
  return true;
}

bool AnalogueAxis::requota() {
  if (!profile_.moving() || profile_.stopping() || !target_) return true;
  if (profile_.retarget(theoretical_way_to(*target_))) return true;
  target_.reset();
  placing_ = false;
  stop();
  return false;
}

bool AnalogueAxis::settle() {
  theoretical_ = {transducer_.total(), 0};
  regulator_.reset();
  return !target_ || profile_.resume(theoretical_way_to(*target_));
}

void AnalogueAxis::rest() { rest_ms_ = std::min(rest_ms_ + settings.period_ms, long_rest_ms); }

std::int64_t AnalogueAxis::settle_by_bits() {
  const std::int64_t bits = whole_bits(std::round(-error()));
  theoretical_.whole = multiply_add(theoretical_.whole, bits, 1);
  regulator_.reset(error());
  return bits;
}

void AnalogueAxis::step_profile() {
  if (!profile_.moving() || pause_ms_ > 0) {
    speed_ = 0;
    pause_ms_ = std::max(pause_ms_ - settings.period_ms, 0);
    rest();
    return;
  }
  const double way = profile_.step(settings.period_ms / 1000.0);
  theoretical_.add(way);
  if (way != 0) {
    rest_ms_ = 0;
    last_backward_ = way < 0;
  } else {
    rest();
  }
  speed_ = profile_.speed();
  if (profile_.moving() || !target_) return;
  // The profile ends on the quota itself: no rounding of its arithmetic is left.
  if (!profile_.stopping()) theoretical_.add(theoretical_way_to(*target_));
  if (placing_) placed_ = target_;
}

void AnalogueAxis::regulate(Drive drive, std::int32_t tenths) {
  const RegulatorScale scale{settings.max_speed, settings.period_ms / 1000.0, settings.term_limit};
  drive_ = drive;
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
  following_error_ = hold_.sample(follerr() > settings.max_following_error, settings.period_ms);
}

}  // namespace drycut::devices::axis
