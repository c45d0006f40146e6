#pragma once
#include <algorithm>
#include <string>
#include <vector>

#include "plants/plant.hpp"
#include "plants/random.hpp"

namespace drycut::plants {

/// A contact that follows its command late: a contactor, a relay, a filtered input. A command shorter than
/// the delay is swallowed.
class DelayedContact {
 public:
  /// Delays in s and their standard deviation; the contact is open at the start.
  DelayedContact(double close_delay, double open_delay, double scatter = 0)
      : close_delay_(close_delay), open_delay_(open_delay), scatter_(scatter) {}

  /// Follows the command at the start of a step of `h` seconds; true while the contact is closed in that
  /// step. `random`: of a contact whose delays scatter; each change of the command draws its own, never below
  /// 0.
  bool update(bool command, double h, Random* random = nullptr) {
    if (command != command_) {
      command_ = command;
      remaining_ = command ? close_delay_ : open_delay_;
      if (scatter_ > 0 && random != nullptr)
        remaining_ = std::max(0.0, remaining_ + scatter_ * random->gaussian());
    }
    if (command_ != follows_) {
      if (remaining_ < h / 2) follows_ = command_;
      remaining_ -= h;
    }
    return closed();
  }
  [[nodiscard]] bool closed() const { return (follows_ && !stuck_off_) || stuck_on_; }

  /// stuck_on and stuck_off under the component name `component`. 0 clears each.
  void offer_faults(std::vector<Fault>& faults, const std::string& component) {
    faults.push_back(
        fault_state(component, "stuck_on", stuck_on_, "1: the contact is welded, it stays closed"));
    faults.push_back(
        fault_state(component, "stuck_off", stuck_off_, "1: coil or wire broken, the contact stays open"));
  }

  void visit(StateArchive& archive);

 private:
  const double close_delay_;
  const double open_delay_;
  const double scatter_;
  bool command_ = false;
  bool follows_ = false;
  double remaining_ = 0;  // until the contact follows [s]
  bool stuck_on_ = false;
  bool stuck_off_ = false;
};

}  // namespace drycut::plants
