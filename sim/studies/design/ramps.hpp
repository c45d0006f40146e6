#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "sim/studies/design/cam.hpp"

namespace drycut::sim::studies {

// Ways of whole units, cut into sectors in each of which the speed changes along one ramp. The speeds between
// them are whole multiples of 2/q, with q the length of the sectors: then each has a whole way of the slave
// too, and nothing is left to add up, in the device's own arithmetic neither.

/// A sector of the slave's way: over `master` units by `slave` units.
struct RampSector {
  enum class Law { one_ramp, there_and_back };  ///< to another speed; to one in its middle and back
  int master = 0;
  int slave = 0;
  Law law = Law::one_ramp;
};

/// What ramps are to come near to, and what they must not pass.
struct RampAims {
  MoveGoal goal = MoveGoal::rms;
  bool cycloidal = false;
  double most_ratio = 0;     ///< 0 = not limited
  double most_gradient = 0;  ///< a unit of the master; 0 = not limited
  MoveFriction friction;     ///< a unit of the master
  int shortest = 1;          ///< sector [units]
  int most_sectors = 0;
  bool no_reverse = false;
  int most_down = 0;    ///< way of the slave from the master's speed to rest; 0 = not limited
  int least_ramps = 1;  ///< on each side of the middle, where there are any
  int most_ramps = 48;
};

/// What ramps cost.
struct RampCost {
  double sum = 0;  ///< integral of the force squared; of the gradient squared where there is no friction
  double peak = 0;
  double jerk = 0;
  bool allowed = true;
  [[nodiscard]] double of(MoveGoal goal) const;
  RampCost& operator+=(const RampCost& other);
};

struct Ramps {
  std::vector<RampSector> sectors;
  RampCost cost;
};

/// The wanted speed at a part 0..1 of the way.
using WantedSpeed = std::function<double(double part)>;

/// From speed `rest` (0 or 1) to the wanted speeds and back to it, over `master` and `slave` units: the
/// fewest sectors that come within a thousandth of the best.
std::optional<Ramps> out_and_back(int master, int slave, int rest, const WantedSpeed& wanted,
                                  const RampAims& aims);

/// From the master's speed to rest (`down`), out the other way or not at all, and from rest to its speed
/// again.
struct TurnRound {
  std::vector<RampSector> down;  ///< backwards they lead up
  std::vector<RampSector> out;
  RampCost cost;
};
/// `still`: the part of `master` after which the slave stands first; `wanted` over the whole of it.
std::optional<TurnRound> turn_round(int master, int slave, double still, const WantedSpeed& wanted,
                                    const RampAims& aims);

}  // namespace drycut::sim::studies
