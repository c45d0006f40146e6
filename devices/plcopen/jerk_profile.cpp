#include "devices/plcopen/coupling.hpp"

#include <algorithm>
#include <cmath>

#include "base/state_archive.hpp"

namespace drycut::devices::plcopen {
namespace {

bool usable(double limit) { return std::isfinite(limit) && limit > 0; }
bool usable(const JerkLimits& limits) {
  return usable(limits.velocity) && usable(limits.acceleration) && usable(limits.deceleration) &&
         usable(limits.jerk);
}

/// Phases under construction, with the state that they have come to.
struct PhaseBuilder {
  JerkProfile profile;
  MotionState now;

  explicit PhaseBuilder(const MotionState& state) : now(state) { profile.start = state; }

  void phase(double duration, double jerk) {
    if (!(duration > 0)) return;
    profile.phases[profile.count++] = {duration, jerk};
    profile.duration += duration;
    now = moved(now, jerk, duration);
  }

  /// To a steady velocity: acceleration to a peak, held there if that is the limit, and back to 0.
  void velocity(double target, double up, double down, double jerk) {
    const double released = now.velocity + now.acceleration * std::abs(now.acceleration) / (2 * jerk);
    const double towards = target >= released ? 1 : -1;
    const double limit = towards > 0 ? up : down;
    const double change = towards * (target - now.velocity);
    const double first = towards * now.acceleration;
    const double peak = std::min(limit, std::sqrt(std::max(0.0, jerk * change + first * first / 2)));
    const double onset = std::abs(peak * peak - first * first) / (2 * jerk);
    // From above the limit the onset falls to it, and does part of the change.
    const double done = peak >= first ? (peak * peak - first * first) / (2 * jerk) : onset;
    phase(std::abs(peak - first) / jerk, peak >= first ? towards * jerk : -towards * jerk);
    if (peak == limit) phase((change - done - peak * peak / (2 * jerk)) / limit, 0);
    phase(peak / jerk, -towards * jerk);
    now.velocity = target;
    now.acceleration = 0;
  }

  void velocity(double target, const JerkLimits& limits) {
    const double smaller = std::min(limits.acceleration, limits.deceleration);
    double limit = std::abs(target) > std::abs(now.velocity) ? limits.acceleration : limits.deceleration;
    if (target * now.velocity < 0) limit = smaller;
    velocity(target, limit, limit, limits.jerk);
  }
};

/// To a cruising velocity, there for `cruise` [s], and to the velocity at the end.
PhaseBuilder way(const MotionState& from, double cruising, double cruise, double end,
                 const JerkLimits& limits) {
  PhaseBuilder builder(from);
  builder.velocity(cruising, limits);
  builder.phase(cruise, 0);
  builder.velocity(end, limits);
  return builder;
}

/// The middle of low..high where `position` passes `target`; `position` at low is below it, at high above.
template <typename Position>
double root(double low, double high, double target, const Position& position) {
  for (int i = 0; i < 200; ++i) {
    const double middle = low + (high - low) / 2;
    if (middle == low || middle == high) break;
    (position(middle) < target ? low : high) = middle;
  }
  return high;
}

JerkLimits with_one_slope(JerkLimits limits) {
  limits.acceleration = limits.deceleration = std::min(limits.acceleration, limits.deceleration);
  return limits;
}

/// The part of `end` that can be had at `target`: straight to it from a velocity of at least 0.
double reachable(const MotionState& from, double released, double target, double end,
                 const JerkLimits& limits) {
  const auto straight = [&](double velocity) {
    PhaseBuilder builder(from);
    builder.velocity(velocity, end < 0 ? with_one_slope(limits) : limits);
    return builder.now.position;
  };
  if (end < 0) {
    // Only a way that has to come back passes its target backwards.
    if (target >= straight(0)) return 0;
    return straight(end) >= target ? end : root(end, 0, target, straight);
  }
  if (straight(end) <= target) return end;
  // The next number below: the root itself may lie beyond the target by a rounding.
  if (end > released && straight(released) <= target)
    return std::nextafter(root(released, end, target, straight), 0);
  return 0;
}

/// `from` reaches a velocity of at least 0 when its acceleration is let go.
PhaseBuilder forward(const MotionState& from, double target, double wanted, const JerkLimits& limits) {
  const double jerk = limits.jerk;
  const double released = from.velocity + from.acceleration * std::abs(from.acceleration) / (2 * jerk);
  const double top = limits.velocity;
  const double end = wanted == 0 ? 0 : reachable(from, released, target, wanted, limits);
  const auto end_of = [&](double cruising) { return way(from, cruising, 0, end, limits).now.position; };
  const auto braked = [&](double release) {
    PhaseBuilder builder(from);
    builder.phase(release, jerk);
    builder.velocity(end, limits);
    return builder;
  };
  const double shortest = braked(0).now.position;
  if (target == shortest) return braked(0);
  if (target < shortest || end < 0) {
    // It cannot stop in time and comes back; one acceleration for all keeps the ways of a kind.
    const JerkLimits both = with_one_slope(limits);
    const auto back = [&](double cruising) { return way(from, cruising, 0, end, both).now.position; };
    const double all_the_way = back(-top);
    if (target <= all_the_way) return way(from, -top, (all_the_way - target) / top, end, both);
    return way(from, root(-top, end > -top ? end : 0, target, back), 0, end, both);
  }
  if (const double at_top = end_of(top); target >= at_top)
    return way(from, top, (target - at_top) / top, end, limits);
  // Between a speed that it has and one that it shall have the way only grows from the higher one on.
  const double least = end < top && (end > released || released > top) ? end : released;
  if (released > top || target >= end_of(least))
    return way(from, root(least, top, target, end_of), 0, end, limits);
  if (end > released) {
    // No room to be even on the way up: a little less at the end.
    const auto up = [&](double less) { return way(from, released, 0, less, limits); };
    return up(root(released, end, target, [&](double less) { return up(less).now.position; }));
  }
  // It brakes already, and harder than it has to: less for a while, then on.
  const double longest = std::abs(from.acceleration) / jerk;
  return braked(root(0, longest, target, [&](double release) { return braked(release).now.position; }));
}

MotionState mirrored(const MotionState& state) {
  return {-state.position, -state.velocity, -state.acceleration};
}

}  // namespace

MotionState moved(const MotionState& state, double jerk, double time) {
  return {state.position + time * (state.velocity + time * (state.acceleration / 2 + time * jerk / 6)),
          state.velocity + time * (state.acceleration + time * jerk / 2), state.acceleration + time * jerk};
}

MotionState at(const JerkProfile& profile, double time) {
  if (time >= profile.duration) return moved(profile.end, 0, time - profile.duration);
  MotionState state = profile.start;
  for (int i = 0; i < profile.count; ++i) {
    const JerkProfile::Phase& phase = profile.phases[i];
    if (time <= phase.duration) return moved(state, phase.jerk, time);
    state = moved(state, phase.jerk, phase.duration);
    time -= phase.duration;
  }
  return moved(profile.end, 0, 0);
}

std::optional<JerkProfile> to_velocity(const MotionState& state, double velocity, double up, double down,
                                       double jerk) {
  if (!usable(up) || !usable(down) || !usable(jerk)) return std::nullopt;
  PhaseBuilder builder(state);
  builder.velocity(velocity, up, down, jerk);
  builder.profile.end = builder.now;
  return builder.profile;
}

std::optional<JerkProfile> to_velocity(const MotionState& state, double velocity, const JerkLimits& limits) {
  if (!usable(limits)) return std::nullopt;
  PhaseBuilder builder(state);
  builder.velocity(velocity, limits);
  builder.profile.end = builder.now;
  return builder.profile;
}

std::optional<JerkProfile> to_position(const MotionState& state, double position, const JerkLimits& limits,
                                       double velocity) {
  if (!usable(limits)) return std::nullopt;
  const double released =
      state.velocity + state.acceleration * std::abs(state.acceleration) / (2 * limits.jerk);
  const bool backward = released < 0 || (released == 0 && position < state.position);
  const auto build = [&](double end) {
    return backward ? forward(mirrored(state), -position, -end, limits)
                    : forward(state, position, end, limits);
  };
  PhaseBuilder built = build(velocity);
  // A turn on the way may leave no room for the speed.
  const double missed = std::abs(built.now.position - (backward ? -position : position));
  if (velocity != 0 && missed > 1e-6 * std::max(1.0, std::abs(position - state.position))) built = build(0);
  JerkProfile profile = built.profile;
  profile.start = state;
  if (backward)
    for (JerkProfile::Phase& phase : profile.phases) phase.jerk = -phase.jerk;
  profile.end = {position, backward ? 0 - built.now.velocity : built.now.velocity, 0};
  return profile;
}

void MotionState::visit(StateArchive& archive) { STATE(archive, position, velocity, acceleration); }
void JerkLimits::visit(StateArchive& archive) { STATE(archive, velocity, acceleration, deceleration, jerk); }
void JerkProfile::Phase::visit(StateArchive& archive) { STATE(archive, duration, jerk); }
void JerkProfile::visit(StateArchive& archive) { STATE(archive, phases, count, duration, start, end); }

}  // namespace drycut::devices::plcopen
