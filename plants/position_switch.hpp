#pragma once
#include <string>
#include <vector>

#include "plants/plant.hpp"

namespace drycut::plants {

/// A proximity or limit switch with a target of some width: on while the position is over the target. All
/// positions in one unit of the plant's choice (turns for a drum, metres for a slide).
struct PositionSwitchData {
  double centre = 0;      ///< of the target
  double width = 0;       ///< of the target
  double hysteresis = 0;  ///< the switch lets go this far behind the edge of the target
  double delay = 0;       ///< of its filter [s]: shorter pulses and gaps are swallowed
};

class PositionSwitch {
 public:
  /// `period`: the position repeats after this much (1 turn), 0 = it does not. `start`: position at the
  /// start.
  PositionSwitch(const PositionSwitchData& data, double period, double start);

  SignalPort port;  ///< edges with their exact fraction of the step, after the delay

  /// Follows the motion over the last step of `h` seconds, over the whole target if it goes so far.
  void sense(double before, double now, double h);
  /// The same for a target that is not at one place: `distance` from its centre now.
  void follow(double distance, double h);

  /// stuck and dead under the component name `component`. 0 clears each.
  void offer_faults(std::vector<Fault>& faults, const std::string& component);

 private:
  [[nodiscard]] double shorter(double way) const;
  [[nodiscard]] double offset(double position) const;              // from the nearest centre
  void move(double distance, double begin, double end, double h);  // in this part of the step, straight
  void filter(double h);
  void let_through(double h);
  void show(bool level, double fraction);

  PositionSwitchData data_;
  double period_;
  double distance_;       // at the end of the last step
  bool raw_;              // over the target, with hysteresis, before the delay
  bool filtered_;         // after the delay, before the faults
  bool pending_ = false;  // raw_ changed less than `delay` ago
  double remaining_ = 0;  // until the filter lets it through [s]
  bool stuck_ = false;
  bool dead_ = false;
};

}  // namespace drycut::plants
