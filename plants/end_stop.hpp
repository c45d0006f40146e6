#pragma once
#include <algorithm>

#include "base/units.hpp"
#include "plants/plant.hpp"
#include "plants/world.hpp"

namespace drycut::plants {

/// A buffer at the end of a slide's travel: spring and damper that only push.
struct EndStopData {
  double stiffness = 2e6;  ///< [N/m]
  double damping = 2e3;    ///< [N s/m]
};

/// One end stop. It reports a hit when it has stopped the slide: the impulse is what it took until then, for
/// a free slide mass times speed.
class EndStop {
 public:
  /// `side`: +1 at the upper end, -1 at the lower.
  EndStop(const EndStopData& data, double position, double side)
      : data_(data), position_(position), side_(side) {}

  /// Pushes the slide back for the coming step of `h` seconds.
  void drive(Slide& slide, double h) {
    const double depth = this->depth(slide.position);
    const double speed = side_ * slide.speed;
    force_ = depth > 0 ? std::max(0.0, data_.stiffness * depth + data_.damping * speed) : 0;
    slide.add_force(-side_ * force_);
    if (depth <= 0) {
      touched_ = false;
      return;
    }
    if (!touched_) {
      touched_ = true;
      compressing_ = true;
      hit_speed_ = speed;
      impulse_ = peak_ = 0;
    }
    if (!compressing_) return;
    impulse_ += force_ * h;
    h_ = h;
    peak_ = std::max(peak_, force_);
  }
  /// True once a hit: the last step stopped the slide, at the fraction of it that hit() tells.
  bool stopped(const Slide& slide) {
    if (!touched_ || !compressing_ || side_ * slide.speed > standstill) return false;
    compressing_ = false;
    const double change = slide.speed_before - slide.speed;
    fraction_ = change != 0 ? std::clamp(slide.speed_before / change, 0.0, 1.0) : 1;
    impulse_ -= force_ * h_ * (1 - fraction_);  // what the rest of the step gave already throws it back
    return true;
  }

  /// The last hit as an event: side, speed, impulse, force.
  [[nodiscard]] MachineEvent hit(std::string_view name) const {
    return {name,
            fraction_,
            {{"side", side_, ""},
             {"speed", hit_speed_ * units::millimetres, "mm/s"},
             {"impulse", impulse_, "N s"},
             {"force", peak_, "N"}}};
  }

  [[nodiscard]] double force() const { return force_; }          ///< on the slide in the last step, >= 0 [N]
  [[nodiscard]] double hit_speed() const { return hit_speed_; }  ///< towards the stop when it touched [m/s]
  [[nodiscard]] double peak() const { return peak_; }            ///< largest force of the last hit [N]
  [[nodiscard]] double side() const { return side_; }
  /// How deep a slide at `position` is in it, < 0 outside [m].
  [[nodiscard]] double depth(double position) const { return side_ * (position - position_); }

  void visit(StateArchive& archive);

 private:
  // Dry friction that brings a slide to rest leaves a rounding of its speed [m/s].
  static constexpr double standstill = 1e-12;

  const EndStopData data_;
  const double position_;
  const double side_;
  double force_ = 0;
  bool touched_ = false;
  bool compressing_ = false;
  double hit_speed_ = 0;
  double impulse_ = 0;
  double peak_ = 0;
  double fraction_ = 1;
  double h_ = 0;  // of the last step [s]
};

}  // namespace drycut::plants
