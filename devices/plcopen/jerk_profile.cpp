#include "devices/plcopen/jerk_profile.hpp"

#include <algorithm>
#include <cmath>

namespace drycut::devices::plcopen {
namespace {

bool usable(double limit) { return std::isfinite(limit) && limit > 0; }
bool usable(const JerkLimits& limits) {
  return usable(limits.velocity) && usable(limits.acceleration) && usable(limits.deceleration) &&
         usable(limits.jerk);
}

/// Phases under construction, with the state that they have come to.
struct Builder {
  JerkProfile profile;
  MotionState now;

  explicit Builder(const MotionState& state) : now(state) { profile.start = state; }

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

/// To a cruising velocity, there for `cruise` [s], and to rest.
Builder way(const MotionState& from, double cruising, double cruise, const JerkLimits& limits) {
  Builder builder(from);
  builder.velocity(cruising, limits);
  builder.phase(cruise, 0);
  builder.velocity(0, limits);
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

/// `from` reaches a velocity of at least 0 when its acceleration is let go.
JerkProfile forward(const MotionState& from, double target, const JerkLimits& limits) {
  const double jerk = limits.jerk;
  const double released = from.velocity + from.acceleration * std::abs(from.acceleration) / (2 * jerk);
  const double top = limits.velocity;
  const auto end_of = [&](double cruising) { return way(from, cruising, 0, limits).now.position; };
  const auto braked = [&](double release) {
    Builder builder(from);
    builder.phase(release, jerk);
    builder.velocity(0, limits);
    return builder;
  };
  const double shortest = braked(0).now.position;
  if (target == shortest) return braked(0).profile;
  if (target < shortest) {
    // It cannot stop in time and comes back; one acceleration for all keeps the ways of a kind.
    JerkLimits both = limits;
    both.acceleration = both.deceleration = std::min(limits.acceleration, limits.deceleration);
    const double all_the_way = way(from, -top, 0, both).now.position;
    if (target <= all_the_way) return way(from, -top, (all_the_way - target) / top, both).profile;
    return way(from,
               root(-top, 0, target,
                    [&](double cruising) { return way(from, cruising, 0, both).now.position; }),
               0, both)
        .profile;
  }
  if (const double at_top = end_of(top); target >= at_top)
    return way(from, top, (target - at_top) / top, limits).profile;
  if (released > top) return way(from, root(0, top, target, end_of), 0, limits).profile;
  if (target >= end_of(released)) return way(from, root(released, top, target, end_of), 0, limits).profile;
  // It brakes already, and harder than it has to: less for a while, then on.
  const double longest = std::abs(from.acceleration) / jerk;
  return braked(root(0, longest, target, [&](double release) { return braked(release).now.position; }))
      .profile;
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
  Builder builder(state);
  builder.velocity(velocity, up, down, jerk);
  builder.profile.end = builder.now;
  return builder.profile;
}

std::optional<JerkProfile> to_velocity(const MotionState& state, double velocity, const JerkLimits& limits) {
  if (!usable(limits)) return std::nullopt;
  Builder builder(state);
  builder.velocity(velocity, limits);
  builder.profile.end = builder.now;
  return builder.profile;
}

std::optional<JerkProfile> to_position(const MotionState& state, double position, const JerkLimits& limits) {
  if (!usable(limits)) return std::nullopt;
  const double released =
      state.velocity + state.acceleration * std::abs(state.acceleration) / (2 * limits.jerk);
  const bool backward = released < 0 || (released == 0 && position < state.position);
  JerkProfile profile =
      backward ? forward(mirrored(state), -position, limits) : forward(state, position, limits);
  if (backward) {
    profile.start = state;
    for (JerkProfile::Phase& phase : profile.phases) phase.jerk = -phase.jerk;
  }
  profile.end = {position, 0, 0};
  return profile;
}

}  // namespace drycut::devices::plcopen
