#pragma once
#include "plants/friction.hpp"
#include "plants/world.hpp"

namespace drycut::plants {

// The cut of a rotary knife. The blade tips run on a circle of radius R that touches the anvil at bottom dead
// centre; the web, thickness s, lies on the anvil. theta is the angle of a blade from bottom dead centre,
// positive behind it in web direction: tip height R (1 - cos theta), tip speed along the web omega R cos
// theta.

/// Angle at which the blade tip touches the web [rad]: acos(1 - s/R).
[[nodiscard]] double engagement_angle(double radius, double thickness);
/// How deep the tip is in the web at theta [m], 0..s.
[[nodiscard]] double penetration(double radius, double thickness, double theta);
/// Vertical force on the blade against penetration [N]: a parabola that rises from nothing to `peak` at half
/// the thickness and falls to nothing when the crack has run through.
[[nodiscard]] double shear_force(double peak, double thickness, double depth);
/// Work of that force from the surface to `depth` [J]; 2/3 peak * s for a whole cut.
[[nodiscard]] double shear_work(double peak, double thickness, double depth);

struct CutterData {
  double radius = 0;          ///< of the blade tips [m]
  int blades = 1;             ///< evenly on the circumference
  double eccentricity = 0;    ///< of their circle from the axis, at right angles to blade 1 [m]
  double thickness = 0;       ///< of the web [m]
  double peak_force = 0;      ///< of the cut [N]
  double coupling = 0;        ///< horizontal force between blade and web for their speed mismatch [N s/m]
  double grip = 0;            ///< largest horizontal force: beyond it the web gives way [N]
  double mismatch_limit = 0;  ///< speed mismatch at which the web tears or buckles [m/s]
};

/// Follows the blades through the web: forces before the step, separation and faults of the cut after it.
/// One engagement lasts from the blade's touching the web until it has left it; it separates the web once,
/// when the blade reaches bottom dead centre from either side. A blade that swings back before has cut
/// nothing, and material that it has already sheared resists no more.
class Cutter {
 public:
  /// `drum` at its start: whole turns have blade 1 at bottom dead centre.
  Cutter(const CutterData& data, const Shaft& drum);

  /// What the blade meets in the coming step. `dry` is a torque on the drum that resists motion.
  struct Load {
    DryResistance dry;     ///< [N m]
    double torque = 0;     ///< on the drum, from the speed mismatch [N m]
    double web_force = 0;  ///< on the web, from the speed mismatch [N]
  };
  [[nodiscard]] Load load(const Shaft& drum, const Slide& web);

  /// What happened in the last step.
  struct Outcome {
    bool separated = false;  ///< at `fraction` of the step
    bool tore = false;     ///< the blade became faster than the web by more than the limit, not yet separated
    bool buckled = false;  ///< the blade became slower than the web by more than the limit
    double fraction = 1;   ///< of the separation
    double mismatch = 0;   ///< of a separation: largest |blade - web| since the blade touched the web [m/s]
    double force = 0;      ///< of a separation: largest vertical force since then [N]
    double excess = 0;     ///< of tear and buckle: |blade - web| now [m/s]
  };
  [[nodiscard]] Outcome sense(const Shaft& drum, const Slide& web, double h);

  [[nodiscard]] bool engaged() const { return engaged_; }
  /// Angle of the nearest blade from bottom dead centre [rad].
  [[nodiscard]] double theta() const { return theta_; }
  /// Blade tip speed along the web minus web speed while engaged, else 0 [m/s].
  [[nodiscard]] double mismatch() const { return mismatch_; }
  /// Vertical force of the last step [N].
  [[nodiscard]] double force() const { return force_; }

 private:
  [[nodiscard]] double nearest_blade(const Shaft& drum) const;
  void enter(const Shaft& drum, const Slide& web, double before);

  CutterData data_;
  double engagement_;  // angle [rad]
  double theta_;
  bool engaged_;
  bool separated_ = false;
  bool failed_ = false;  // tear or buckle reported
  double deepest_ = 0;   // [m]
  double largest_mismatch_ = 0;
  double largest_force_ = 0;
  double mismatch_ = 0;
  double force_ = 0;
};

}  // namespace drycut::plants
