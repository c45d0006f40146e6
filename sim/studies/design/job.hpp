#pragma once
#include <optional>
#include <string>

#include "base/problem.hpp"
#include "sim/studies/design/move.hpp"

namespace drycut::sim::studies {

enum class DesignKind { rotary_knife, flying_saw, feed };

/// A cam's job. All in SI; ways of the master along the material, of the slave at the blade.
struct DesignJob {
  DesignKind kind = DesignKind::rotary_knife;
  MoveGoal goal = MoveGoal::rms;  ///< rms, peak, jerk, energy
  double length = 0;              ///< the master's way for a piece [m]
  double slave = 0;  ///< the slave's way for a piece: from blade to blade, 0 of a flying saw, the feed [m]
  int blades = 1;    ///< pieces for a turn of a rotary knife
  double sync = 0;   ///< of the master's way: with its speed around the cut; of a feed: at rest [m]
  /// Of the material under a rotary knife: along it the blade has the web's speed while it swings through. 0:
  /// the blade's own speed is the web's [m].
  double thickness = 0;
  std::optional<double> speed = {};             ///< of the master [m/s]
  std::optional<double> max_velocity = {};      ///< of the slave [m/s]
  std::optional<double> max_acceleration = {};  ///< of the slave [m/s2]
  std::optional<double> max_travel = {};        ///< of a flying saw, from end to end [m]
  bool no_reverse = false;
  // For MoveGoal::energy, as felt at the blade.
  double inertia = 0;  ///< [kg]
  double viscous = 0;  ///< [N s/m]
  double coulomb = 0;  ///< [N]

  /// Slave to master at both ends of the synchronous way.
  [[nodiscard]] double ratio() const;
  /// The slave's way on it [m].
  [[nodiscard]] double sync_slave() const;
  /// The master's way on which a blade is in the material, 0 without `thickness` [m].
  [[nodiscard]] double contact() const;
  /// Of the circle of the blade tips [m].
  [[nodiscard]] double radius() const;
  /// The master's way from the end of a synchronous way to the next.
  [[nodiscard]] double way() const { return length - sync; }
  /// What the slave goes beyond the synchronous ratio on that way; negative: less.
  [[nodiscard]] double distance() const { return slave - sync_slave() - ratio() * way(); }
  /// The slave runs with the master all the time: pieces as long as the way from blade to blade.
  [[nodiscard]] bool is_steady() const;
  /// Friction as the move counts it; `speed` and `inertia` are known.
  [[nodiscard]] MoveFriction friction() const;
};

/// The move that the job is.
MoveProblem move_of(const DesignJob& job);

/// What makes the job impossible, with what would be possible, by the options that give it.
Problems hindrances(const DesignJob& job);

/// "800 mm", "12.5 m/s2".
std::string length_text(double metres);
std::string velocity_text(double metres_a_second);
std::string acceleration_text(double metres_a_second_squared);

}  // namespace drycut::sim::studies
