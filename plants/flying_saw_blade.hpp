#pragma once
#include <string>

#include "plants/plant.hpp"
#include "plants/section.hpp"
#include "plants/world.hpp"

namespace drycut::plants {

/// The saw blade in the material. Seen from the cut it is a straight edge that goes down.
struct SawBladeData {
  double resistance = 1e5;   ///< against the plunge, per width of the cut and speed of the plunge [N s/m2]
  double stiffness = 2e5;    ///< sideways: force on blade and material for their relative displacement [N/m]
  double damping = 100;      ///< sideways [N s/m]
  double yield = 3000;       ///< largest sideways force: beyond it blade or material give way for good [N]
  double pinch_limit = 150;  ///< sideways force that is reported as a pinch [N]
};

/// Rows of the group `blade.`.
Parameters saw_blade_parameters(SawBladeData& data);

/// Time from the first touch until the blade is through when force balances resistance and throttle at every
/// moment: (throttle * height + resistance * area) / force [s].
[[nodiscard]] double cutting_time(const SawBladeData& blade, const Section& section, double force,
                                  double throttle);

/// Follows the blade through the material. One engagement lasts from the touch until the blade is over the
/// material again; it separates the material once, where the blade stood on it at the touch.
class SawCut {
 public:
  SawCut(const SawBladeData& blade, const Section& section, double clearance);

  /// What the blade meets in the coming step.
  struct Load {
    double resistance = 0;  ///< force against downward motion of the head for its speed [N s/m]
    double sideways = 0;    ///< on the carriage along the line; the material has the opposite [N]
  };
  /// `met`: there is material.
  [[nodiscard]] Load load(const Slide& head, const Slide& carriage, const Slide& material, bool met = true);
  /// The material is another body from now on: a piece that was the web's end.
  void handed(const Slide& from, const Slide& to) { mark_ += to.position - from.position; }

  /// What happened in the last step.
  struct Outcome {
    bool separated = false;  ///< at `fraction` of the step
    bool pinched = false;    ///< the sideways force exceeded its limit, first time in this engagement
    double fraction = 1;
    double mark = 0;   ///< of a separation: travel of the material less place of the blade at the touch [m]
    double slant = 0;  ///< of a separation: way of the blade on the material since the touch [m]
    double pinch = 0;  ///< of a separation: largest sideways force in it [N]
    double force = 0;  ///< of a separation: largest cutting force in it [N]
    double time = 0;   ///< of a separation: since the touch [s]
  };
  [[nodiscard]] Outcome sense(const Slide& head, const Slide& carriage, const Slide& material, double h);

  [[nodiscard]] bool engaged() const { return engaged_; }
  /// Cutting force against the plunge in the last step [N].
  [[nodiscard]] double force() const { return force_; }
  /// Sideways force on the carriage in the last step [N].
  [[nodiscard]] double sideways() const { return sideways_; }
  /// Way of the blade on the material since the touch, 0 outside [m].
  [[nodiscard]] double displacement() const { return engaged_ ? displacement_ : 0; }

  void visit(StateArchive& archive);

 private:
  void enter(double fraction, const Slide& carriage, const Slide& material, double h);

  const SawBladeData blade_;
  const Section section_;
  const double clearance_;
  const double height_;
  bool engaged_ = false;
  bool separated_ = false;
  bool pinched_ = false;
  double mark_ = 0;
  double displacement_ = 0;
  double given_ = 0;       // part of it for which blade or material have given way [m]
  double deepest_ = 0;     // in the material [m]
  double time_ = 0;        // since the touch [s]
  double resistance_ = 0;  // of the last step [N s/m]
  double force_ = 0;
  double sideways_ = 0;
  double largest_pinch_ = 0;
  double largest_force_ = 0;
};

}  // namespace drycut::plants
