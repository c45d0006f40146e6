#include "devices/oopos2/movement.hpp"

#include <algorithm>
#include <cassert>

#include "base/state_archive.hpp"

namespace drycut::devices::oopos2 {

void Movement::tick(int ms) {
  timer_ms_ = std::max(timer_ms_ - ms, 0);
  if (!running()) off_ms_ = std::min(off_ms_ + ms, long_ago_ms);
}

void Movement::run(const Leg& leg) {
  placing_ = false;
  last_.reset();
  begin(leg);
}

void Movement::place(const std::optional<Leg>& overshoot, const Leg& last) {
  assert(phase_ == MovementPhase::still);
  placing_ = true;
  last_.reset();
  if (overshoot) last_ = last;
  begin(overshoot ? *overshoot : last);
}

void Movement::begin(const Leg& leg) {
  const bool goes_on = running() && leg.backward == last_backward_;
  leg_ = leg;
  driven_ = goes_on;
  if (phase_ == MovementPhase::still) {
    enter(MovementPhase::release, times.brake);
  } else if (goes_on) {
    enter(leg.slow ? MovementPhase::slow : MovementPhase::fast);
  } else if (phase_ != MovementPhase::release) {  // else tbrake runs on
    switch_off();
    invert();
  }
}

void Movement::stop() {
  placing_ = false;
  last_.reset();
  if (phase_ == MovementPhase::still || phase_ == MovementPhase::tolerance) return;
  switch_off();
  enter(MovementPhase::tolerance, times.tolerance);
}

void Movement::abort() {
  const Times kept = times;
  *this = {};
  times = kept;
}

bool Movement::step(Parts position, Parts slow_range) {
  const bool moving = phase_ != MovementPhase::still;
  while (advance(position, slow_range)) {
  }
  return moving && phase_ == MovementPhase::still;
}

bool Movement::advance(Parts position, Parts slow_range) {
  switch (phase_) {
    case MovementPhase::still:
      return false;
    case MovementPhase::release:
      if (timer_ms_ > 0) return false;
      invert();
      return true;
    case MovementPhase::inversion:
      if (timer_ms_ > 0) return false;
      if (reached(position, leg_.inertia)) return arrive();
      last_backward_ = leg_.backward;
      driven_ = true;
      enter(leg_.slow || (leg_.slows && reached(position, slow_range)) ? MovementPhase::slow
                                                                       : MovementPhase::fast);
      return false;
    case MovementPhase::fast:
      if (reached(position, leg_.inertia)) return arrive();
      if (!leg_.slows || !reached(position, slow_range)) return false;
      slowdown_ms_ = times.slowdown;
      if (slowdown_ms_ > 0) switch_off();
      enter(MovementPhase::slowdown, slowdown_ms_);
      return true;
    case MovementPhase::slowdown:
    case MovementPhase::slow:
      if (reached(position, leg_.inertia)) return arrive();
      if (phase_ == MovementPhase::slow || timer_ms_ > 0) return false;
      enter(MovementPhase::slow);
      return false;
    case MovementPhase::tolerance:
      if (timer_ms_ > 0) return false;
      enter(MovementPhase::still);
      return false;
  }
  return false;
}

void Movement::enter(MovementPhase phase, int ms) {
  phase_ = phase;
  timer_ms_ = ms;
}

void Movement::switch_off() {
  if (running()) off_ms_ = 0;
}

void Movement::invert() {
  const bool turns = leg_.backward != last_backward_;
  enter(MovementPhase::inversion, turns ? std::max(times.inversion - off_ms_, 0) : 0);
}

/// The leg is over; what follows is entered in the same sample.
bool Movement::arrive() {
  switch_off();
  if (!last_) {
    enter(MovementPhase::tolerance, times.tolerance);
    return true;
  }
  leg_ = *last_;
  last_.reset();
  driven_ = false;
  invert();
  return true;
}

bool Movement::retarget(Parts position, const std::optional<Leg>& overshoot, const Leg& last) {
  const bool over = last_ && overshoot;
  const Leg& next = over ? *overshoot : last;
  if (!changeable() || !ahead(next, position) || next.backward != leg_.backward) return false;
  leg_ = next;
  if (over) last_ = last;
  return true;
}

bool Movement::changeable() const {
  return placing_ && (phase_ == MovementPhase::release || phase_ == MovementPhase::inversion ||
                      phase_ == MovementPhase::fast);
}

bool Movement::reached(Parts position, Parts before) const {
  if (!leg_.goal) return false;
  return leg_.backward ? position <= *leg_.goal + before : position >= *leg_.goal - before;
}

bool Movement::ahead(const Leg& leg, Parts position) {
  return leg.backward ? position > *leg.goal : position < *leg.goal;
}

void Leg::visit(StateArchive& archive) { STATE(archive, backward, slow, slows, goal, inertia); }
void Times::visit(StateArchive& archive) { STATE(archive, brake, inversion, slowdown, tolerance); }
void Movement::visit(StateArchive& archive) {
  STATE(archive, times, phase_, leg_, last_, placing_, driven_, last_backward_, off_ms_, timer_ms_,
        slowdown_ms_);
}

Outputs Movement::outputs() const {
  const bool backward = running() && leg_.backward;
  const bool slow =
      phase_ == MovementPhase::slow || (phase_ == MovementPhase::slowdown && 2 * timer_ms_ <= slowdown_ms_);
  return {running() && !backward, backward, slow, phase_ == MovementPhase::still};
}

}  // namespace drycut::devices::oopos2
