#pragma once
#include <cmath>
#include <limits>

namespace drycut::plants {

/// Finds out that an induction motor has lost its load: with all the torque that it has it comes no nearer to
/// the speed that it is to have, for it stands, or the load drives it away. A run-up is none: it comes
/// nearer.
class PulloutWatch {
 public:
  /// A step of `h` seconds; speeds in rad/s. `beyond`: pull-out or the torque limit is passed. True once each
  /// time.
  bool update(bool beyond, double wanted, double speed, double h) {
    if (!beyond || wanted != wanted_) {
      wanted_ = wanted;
      least_ = std::numeric_limits<double>::infinity();
      told_ = told_ && beyond;
    }
    if (!beyond) return false;
    const double distance = std::abs(wanted - speed);
    if (distance < least_) {
      least_ = distance;
      no_nearer_ = 0;
      return false;
    }
    no_nearer_ += h;
    if (told_ || no_nearer_ < (distance > least_ + away ? soon : late)) return false;
    return told_ = true;
  }

 private:
  static constexpr double away = 5;      // [rad/s]
  static constexpr double soon = 50e-3;  // [s] that the load drives it away
  static constexpr double late = 0.5;    // [s] that it stands

  double wanted_ = 0;
  double least_ = 0;      // distance from there
  double no_nearer_ = 0;  // [s]
  bool told_ = false;
};

}  // namespace drycut::plants
