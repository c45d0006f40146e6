#pragma once
#include <cmath>

#include "plants/world.hpp"

namespace drycut::plants {

/// The puller that moves the web: a speed-controlled roll whose grip on the web is a spring and a damper,
/// with a largest force. Its own speed follows the set speed with a limited acceleration.
struct LineDriveData {
  double speed = 1;         ///< at the start, when the web already runs at it [m/s]
  double acceleration = 2;  ///< [m/s2]
  double stiffness = 2e5;   ///< [N/m]
  double damping = 2800;    ///< [N s/m]
  double max_force = 1500;  ///< [N]
};

class LineDrive {
 public:
  explicit LineDrive(const LineDriveData& data);
  /// Other data from now on, the speed apart.
  void take(const LineDriveData& data) { data_ = data; }

  void set_speed(double speed) { set_speed_ = speed; }             ///< [m/s], either sign
  [[nodiscard]] double set_speed() const { return set_speed_; }    ///< as set [m/s]
  [[nodiscard]] double roll_speed() const { return roll_speed_; }  ///< after the acceleration limit [m/s]
  [[nodiscard]] double force() const { return force_; }            ///< on the web in the last step [N]
  [[nodiscard]] bool at_limit() const { return std::abs(force_) >= data_.max_force; }  ///< it slips

  /// Acts on the web for the coming step of `h` seconds.
  void drive(Slide& web, double h);

  /// But the data, which whoever gives them keeps.
  void visit(StateArchive& archive);

 private:
  LineDriveData data_;
  double set_speed_;
  double roll_speed_;
  double draw_ = 0;  // the roll's surface ahead of the web [m]
  double force_ = 0;
};

}  // namespace drycut::plants
