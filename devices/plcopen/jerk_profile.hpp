#pragma once
#include <array>
#include <optional>

namespace drycut::devices::plcopen {

// Jerk-limited motion as plain values, in any unit of length (the kernel's is 0.1 um or 0.0001 deg): every
// profile is a few phases of constant jerk, so that acceleration is continuous and nothing is integrated
// numerically.

/// Where a point is and how it moves [inc, inc/s, inc/s2].
struct MotionState {
  double position = 0;
  double velocity = 0;
  double acceleration = 0;
};

/// Bounds of a motion, each above 0 [inc/s, inc/s2, inc/s2, inc/s3].
struct JerkLimits {
  double velocity = 0;
  double acceleration = 0;  ///< while the speed grows
  double deceleration = 0;  ///< while it falls
  double jerk = 0;
};

/// Phases of constant jerk from `start`; after them the motion goes on as `end` moves, without acceleration.
struct JerkProfile {
  struct Phase {
    double duration = 0;  ///< [s]
    double jerk = 0;
  };
  std::array<Phase, 7> phases{};
  int count = 0;
  double duration = 0;  ///< of all phases [s]
  MotionState start;
  MotionState end;  ///< exact, not the rounded sum of the phases
};

/// `state` after `time` [s] of constant jerk.
MotionState moved(const MotionState& state, double jerk, double time);
/// The motion `time` [s] after the profile's start, 0 or more.
MotionState at(const JerkProfile& profile, double time);

/// The fastest way from any state to a steady `velocity`. Acceleration stays in -down..up, where the state's
/// own lies outside it is brought in first. Nullopt if a limit is not above 0.
std::optional<JerkProfile> to_velocity(const MotionState& state, double velocity, double up, double down,
                                       double jerk);
/// The same with a deceleration of its own for a speed that falls; a reversal takes the smaller of the two.
std::optional<JerkProfile> to_velocity(const MotionState& state, double velocity, const JerkLimits& limits);

/// The way from any state to rest at `position`: the fastest one, except where the state is above the
/// velocity limit or a reversal has to do with two different accelerations; such a way keeps the limits
/// as soon as it can. Nullopt if a limit is not above 0.
///
/// With `velocity` it passes `position` at that speed, in the direction in which it comes there, and may be
/// above the velocity limit; where the way is too short, at the speed nearest to it that can be had.
std::optional<JerkProfile> to_position(const MotionState& state, double position, const JerkLimits& limits,
                                       double velocity = 0);

}  // namespace drycut::devices::plcopen
