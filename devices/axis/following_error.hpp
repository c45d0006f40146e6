#pragma once

namespace drycut::devices::axis {

/// Keeps the report of a following error for 500 ms after it was last too large (st_foller, 000 1.9.6).
class FollowingErrorHold {
 public:
  static constexpr int hold_ms = 500;
  /// One sample; true while the report stands.
  bool sample(bool too_large, int period_ms) {
    if (too_large) {
      remaining_ms_ = hold_ms;
      return true;
    }
    remaining_ms_ = remaining_ms_ > period_ms ? remaining_ms_ - period_ms : 0;
    return remaining_ms_ > 0;
  }

 private:
  int remaining_ms_ = 0;
};

}  // namespace drycut::devices::axis
