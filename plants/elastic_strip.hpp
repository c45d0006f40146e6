#pragma once
#include "plants/section.hpp"
#include "plants/stiff_pair.hpp"
#include "plants/world.hpp"

namespace drycut::plants {

/// The material between puller and cut as springs with dampers: one from the puller to the measuring wheel,
/// one from there to the cut. Nothing of it where `on` is false: puller, wheel and cut move as one.
struct ElasticStripData {
  bool on = false;
  double elasticity = 3e9;        ///< modulus of the material along the line [Pa]
  double retardation = 50e-6;     ///< damping over stiffness: how long a strain lags behind its stress [s]
  double guide_distance = 0.2;    ///< free length between two guides, over which it buckles [m]
  double loop_limit = 1e-3;       ///< material in loops that is reported as slack [m]
  double puller_distance = 1.25;  ///< from the pull rolls to the cut [m]
  double wheel_distance = 0.7;    ///< from the measuring wheel to the cut, less than puller_distance [m]
  double wheel_mass = 0.3;        ///< inertia of the wheel over the square of its radius [kg]
};

/// What the strip is, from its data, cross-section and density.
struct StripSprings {
  StripSprings(const ElasticStripData& data, const Section& section, double density);
  double mass_per_metre;    ///< [kg/m]
  double puller_stiffness;  ///< from puller to wheel, EA over their distance [N/m]
  double cut_stiffness;     ///< from wheel to cut [N/m]
  double puller_damping;    ///< [N s/m]
  double cut_damping;       ///< [N s/m]
  double wheel_mass;        ///< half of both spans and the wheel's own [kg]
  double cut_mass;          ///< half of the span from wheel to cut: all that is there before a lead [kg]
  /// Euler's load of the strip between two guides, pi^2 EI / distance^2: under more it is no strut, it makes
  /// a loop and goes on pushing with as much [N].
  double buckling_force;

  /// The two pairs that the step has to follow; `puller_mass` moves with the pull rolls [kg].
  [[nodiscard]] StiffPair at_puller(double puller_mass) const;
  [[nodiscard]] StiffPair at_cut() const;
};

/// The strip in motion: three bodies, whose positions are the travel of the material past puller, wheel and
/// cut since the start, without tension there. It is lumped at them: half a span at each of its ends, at the
/// cut also what is beyond it. What flows in and out takes its strain along only at the rate line speed over
/// distance, which is left out.
class ElasticStrip {
 public:
  /// `cut` is the body at the cut, of this world; the pull rolls move `puller_mass` [kg].
  ElasticStrip(const ElasticStripData& data, const StripSprings& springs, double puller_mass, double speed,
               Slide& cut, World& world);

  /// Tension on the three bodies, for the coming step.
  void drive();
  /// Takes the mass at the cut for the web beyond it [m].
  void weigh(double overhang);

  [[nodiscard]] Slide& puller() { return puller_; }
  [[nodiscard]] const Slide& wheel() const { return wheel_; }
  /// Travel past a place `distance` before the cut [m]; between the bodies strain is even.
  [[nodiscard]] double travel_at(double distance) const;
  /// Between wheel and cut, and between puller and wheel, in the last step; below 0 the strip pushes [N].
  [[nodiscard]] double tension() const { return tension_; }
  [[nodiscard]] double puller_tension() const { return puller_tension_; }
  /// Material in the loops of both spans [m].
  [[nodiscard]] double loop() const { return loop_; }

  void visit(StateArchive& archive);

 private:
  [[nodiscard]] double pull(const Slide& from, const Slide& to, double stiffness, double damping);

  const ElasticStripData data_;
  const StripSprings springs_;
  World& world_;
  Slide& puller_;
  Slide& wheel_;
  Slide& cut_;
  double tension_ = 0;
  double puller_tension_ = 0;
  double loop_ = 0;
};

}  // namespace drycut::plants
