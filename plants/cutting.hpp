#pragma once
#include <cmath>
#include <utility>

#include "plants/motor_load.hpp"
#include "plants/world.hpp"

namespace drycut::plants {

// The cut of a rotary knife. The blade tips run on a circle of radius R that touches the anvil at bottom dead
// centre; the web, thickness s, lies on the anvil. theta is the angle of a blade from bottom dead centre,
// positive behind it in web direction: tip height R (1 - cos theta), tip speed along the web omega R cos
// theta. Against the blade of a counter drum, as large and geared to it, the tips close in on each other
// twice as fast: in heights and depths R is 2 R then.
//
// A helical blade has an angle beta to the drum's axis, and the drum stands at that angle to the web, so that
// the blade lies square across the web where it cuts. Along the web it runs at R cos beta. On its way from
// one edge of the web, width W, to the other the drum turns by the lag W tan beta / (R cos beta), and the
// cutting point gets W tan beta down the line: a web that went as far in that time is cut square.

/// Angle at which the blade tip touches the web [rad]: acos(1 - s/R).
[[nodiscard]] double engagement_angle(double radius, double thickness);
/// How deep the tip is in the web at theta [m], 0..s.
[[nodiscard]] double penetration(double radius, double thickness, double theta);
/// Vertical force on the blade against penetration [N]: a parabola that rises from nothing to `peak` at half
/// the thickness and falls to nothing when the crack has run through.
[[nodiscard]] double shear_force(double peak, double thickness, double depth);
/// Work of that force from the surface to `depth` [J]; 2/3 peak * s for a whole cut.
[[nodiscard]] double shear_work(double peak, double thickness, double depth);

/// How far the drum turns while a helical blade cuts its way through a web of `width` [rad]; helix in rad.
[[nodiscard]] double helix_lag(double radius, double helix, double width);
/// The helix of that lag [rad].
[[nodiscard]] double helix_of_lag(double radius, double lag, double width);

/// What a helical blade meets whose leading end is at `lead` from bottom dead centre and whose trailing end
/// is `lag` > 0 behind it [rad]. Each point of it cuts as a straight blade does, with its share of the force.
struct HelicalCut {
  double torque = 0;  ///< against the drum [N m]
  double force = 0;   ///< vertical [N]
};
[[nodiscard]] HelicalCut helical_cut(double peak, double radius, double thickness, double lead, double lag);

struct CutterData {
  double radius = 0;            ///< of the blade tips [m]
  int blades = 1;               ///< evenly on the circumference
  double eccentricity = 0;      ///< of their circle from the axis, at right angles to blade 1 [m]
  double helix = 0;             ///< of the blades [rad], 0 = straight
  bool counter_blades = false;  ///< of a counter drum as large, else they cut against an anvil
  double width = 0;             ///< of the web [m]
  double thickness = 0;         ///< of the web [m]
  double peak_force = 0;        ///< of the cut [N]
  double coupling = 0;          ///< horizontal force between blade and web for their speed mismatch [N s/m]
  double grip = 0;              ///< largest horizontal force: beyond it the web gives way [N]
  double mismatch_limit = 0;    ///< speed mismatch at which the web tears or buckles [m/s]
};

/// Follows the blades through the web: forces before the step, separation and faults of the cut after it.
/// One engagement lasts from the blade's touching the web until it has left it; it separates the web once,
/// when the blade reaches bottom dead centre from either side. A blade that swings back before has cut
/// nothing, and material that it has already sheared resists no more. The angle of a helical blade is that of
/// its middle; it separates the web when its last point reaches bottom dead centre.
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
  [[nodiscard]] Load load(const Shaft& drum, const Slide& web) {
    force_ = 0;
    return engaged_ ? meet(drum, web) : Load();
  }

  /// Another coupling from now on [N s/m].
  void couple(double coupling) { coupling_ = coupling; }

  /// What happened in the last step.
  struct Outcome {
    bool separated = false;  ///< at `fraction` of the step
    bool tore = false;     ///< the blade became faster than the web by more than the limit, not yet separated
    bool buckled = false;  ///< the blade became slower than the web by more than the limit
    double fraction = 1;   ///< of the separation
    double mismatch = 0;   ///< of a separation: largest |blade - web| since the blade touched the web [m/s]
    double force = 0;      ///< of a separation: largest vertical force since then [N]
    double mark = 0;       ///< of a separation: position of the web when the blade's middle cut it [m]
    double skew = 0;       ///< of a separation: how far the cut is out of square over the width of the web,
                           ///< positive where a helical blade was faster than the web [m]
    double excess = 0;     ///< of tear and buckle: |blade - web| now [m/s]
  };
  [[nodiscard]] Outcome sense(const Shaft& drum, const Slide& web, double h) {
    const double before = std::exchange(theta_, nearest_blade(drum));
    // Nearly always no blade is in the web, and none has come to the other side of bottom dead centre.
    if (!engaged_ && std::abs(theta_) >= engagement_ && before * theta_ > 0) return {};
    return sense_blade(drum, web, before, h);
  }

  [[nodiscard]] bool engaged() const { return engaged_; }
  /// Angle of the nearest blade from bottom dead centre [rad].
  [[nodiscard]] double theta() const { return theta_; }
  /// Blade tip speed along the web minus web speed while engaged, else 0 [m/s].
  [[nodiscard]] double mismatch() const { return mismatch_; }
  /// Vertical force of the last step [N].
  [[nodiscard]] double force() const { return force_; }
  /// Where across the web the blade cuts now, from its middle; 0 while it does not, or all along [m]. A
  /// helical blade that goes with the web begins at the negative end.
  [[nodiscard]] double place() const;

  void visit(StateArchive& archive);

 private:
  [[nodiscard]] double nearest_blade(const Shaft& drum) const {
    const double pitches = drum.part * data_.blades;
    const auto blade = static_cast<double>(static_cast<int>(pitches + 0.5));
    const double theta = (pitches - blade) * pitch_;
    return data_.eccentricity == 0 ? theta : theta + ahead(blade);
  }
  [[nodiscard]] double ahead(double blade) const;
  [[nodiscard]] Outcome sense_blade(const Shaft& drum, const Slide& web, double before, double h);
  // Of the leading end of a helical blade, whichever it is, counted up while it cuts [rad].
  [[nodiscard]] double lead() const { return direction_ * theta_ + lag_ / 2; }
  [[nodiscard]] double nearest_point() const;
  [[nodiscard]] double along_web(const Shaft& drum, double theta) const;
  [[nodiscard]] Load meet(const Shaft& drum, const Slide& web);
  void shear(const Shaft& drum, DryResistance& dry);
  void shear_by_helix(const Shaft& drum, DryResistance& dry);
  void push_by_helix(const Shaft& drum, const Slide& web, Load& load) const;
  void enter(const Shaft& drum, const Slide& web, double before);
  void follow(const Shaft& drum, const Slide& web, double before, double h, Outcome& outcome);

  const CutterData data_;
  const double closing_;     // radius in heights and depths [m]
  const double along_;       // radius in speeds along the web [m]
  const double lag_;         // of a helical blade [rad]
  const double touch_;       // angle at which a point of it touches the web [rad]
  const double engagement_;  // angle at which the whole blade has left it [rad]
  const double pitch_;       // from blade to blade [rad]
  double coupling_;          // [N s/m]
  double theta_;
  bool engaged_;
  bool separated_ = false;
  bool failed_ = false;     // tear or buckle reported
  double direction_;        // of the drum as the blade came into the web: 1, -1
  double deepest_ = 0;      // [m]
  double farthest_ = 0;     // lead() so far [rad]
  double first_mark_ = 0;   // position of the web when the blade's first point cut it [m]
  double middle_mark_ = 0;  // its middle [m]
  double largest_mismatch_ = 0;
  double largest_force_ = 0;
  double mismatch_ = 0;
  double force_ = 0;
};

}  // namespace drycut::plants
