#pragma once
#include <string>
#include <vector>

#include "plants/plant.hpp"

namespace drycut::plants {

/// A contact that follows its command late: a contactor, a relay, a filtered input. A command shorter than
/// the delay is swallowed.
class DelayedContact {
 public:
  /// Delays in s; the contact is open at the start.
  DelayedContact(double close_delay, double open_delay)
      : close_delay_(close_delay), open_delay_(open_delay) {}

  /// Follows the command at the start of a step of `h` seconds; true while the contact is closed in that
  /// step.
  bool update(bool command, double h) {
    if (command != command_) {
      command_ = command;
      remaining_ = command ? close_delay_ : open_delay_;
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

 private:
  double close_delay_;
  double open_delay_;
  bool command_ = false;
  bool follows_ = false;
  double remaining_ = 0;  // until the contact follows [s]
  bool stuck_on_ = false;
  bool stuck_off_ = false;
};

}  // namespace drycut::plants
