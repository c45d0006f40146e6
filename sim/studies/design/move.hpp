#pragma once
#include <optional>
#include <vector>

namespace drycut::sim::studies {

// The way back from one cut to the next as a function of the master: from the synchronous ratio over `way` of
// the master to that ratio again, with the slave brought `distance` before the place where the ratio alone
// would have it. Everything is with respect to the master [m]: a ratio is m/m, its gradient 1/m.

enum class MoveGoal {
  rms,     ///< the least integral of the gradient squared
  peak,    ///< the least largest gradient
  jerk,    ///< the least largest slope of the gradient, which begins and ends at 0
  energy,  ///< rms with friction
  // For jobs that cannot be done: what they would need.
  violation,  ///< by how much limits must be passed, as a part of each
  ratio,
  gradient,
  excursion,
};

/// What the slave may do on its way.
struct MoveLimits {
  std::optional<double> ratio = {};      ///< its size, either way
  std::optional<double> gradient = {};   ///< its size [1/m]
  std::optional<double> excursion = {};  ///< beyond the place where the way begins [m]
  bool no_reverse = false;
};

/// Friction in proportion to the force that accelerates (MoveGoal::energy).
struct MoveFriction {
  double viscous = 0;  ///< force at ratio 1 by that at a gradient of 1/m [1/m]
  double coulomb = 0;  ///< the same of a force that does not depend on speed [1/m]
};

struct MoveProblem {
  double way = 0;       ///< of the master, above 0 [m]
  double distance = 0;  ///< not 0 [m]
  double ratio = 0;     ///< where it begins and ends
  MoveGoal goal = MoveGoal::rms;
  MoveLimits limits = {};
  MoveFriction friction = {};
  bool smooth = false;            ///< the gradient has no steps, as of MoveGoal::jerk
  int steps = 64;                 ///< of half the way, 2 to 200
  std::optional<int> still = {};  ///< after so many steps the slave stands for a moment
};

/// The gradient on one step: from `begin` to `end` in a straight line [1/m].
struct MoveStep {
  double begin = 0;
  double end = 0;
};
struct Move {
  std::vector<MoveStep> steps;  ///< of equal length, over the whole way
  double value = 0;             ///< of what was asked for: the largest gradient, the excursion, ...
};

/// The best move there is, to 1e-4 of what its goal comes to; it is the same backwards. Nothing if the limits
/// leave none.
std::optional<Move> best_move(const MoveProblem& problem);

}  // namespace drycut::sim::studies
