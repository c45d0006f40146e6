#include "plants/elastic_strip.hpp"

#include <algorithm>
#include <numbers>

#include "base/state_archive.hpp"

namespace drycut::plants {

namespace {

/// How far `to` has run ahead of `from` [m].
double ahead(const Slide& from, const Slide& to) {
  return (to.position - from.position) + (to.remainder - from.remainder);
}

}  // namespace

StripSprings::StripSprings(const ElasticStripData& data, const Section& section, double density)
    : mass_per_metre(section_area(section) * density),
      puller_stiffness(data.elasticity * section_area(section) /
                       (data.puller_distance - data.wheel_distance)),
      cut_stiffness(data.elasticity * section_area(section) / data.wheel_distance),
      puller_damping(puller_stiffness * data.retardation),
      cut_damping(cut_stiffness * data.retardation),
      wheel_mass(data.wheel_mass + mass_per_metre * data.puller_distance / 2),
      cut_mass(mass_per_metre * data.wheel_distance / 2),
      buckling_force(std::numbers::pi * std::numbers::pi * data.elasticity * section_bending(section) /
                     (data.guide_distance * data.guide_distance)) {}

StiffPair StripSprings::at_puller(double puller_mass) const {
  return {puller_stiffness, puller_damping, reduced(puller_mass, wheel_mass)};
}
StiffPair StripSprings::at_cut() const { return {cut_stiffness, cut_damping, reduced(wheel_mass, cut_mass)}; }

ElasticStrip::ElasticStrip(const ElasticStripData& data, const StripSprings& springs, double puller_mass,
                           double speed, Slide& cut, World& world)
    : data_(data),
      springs_(springs),
      world_(world),
      puller_(world.add_slide({.name = "web at the puller", .mass = puller_mass, .speed = speed})),
      wheel_(world.add_slide({.name = "web at the wheel", .mass = springs.wheel_mass, .speed = speed})),
      cut_(cut) {}

// As in transmission_torque: near the load at which a loop begins the damper is no stronger than the spring,
// so that tension has no jump where a loop is pulled straight.
double ElasticStrip::pull(const Slide& from, const Slide& to, double stiffness, double damping) {
  const double stretch = ahead(from, to);
  const double over = stiffness * stretch + springs_.buckling_force;
  if (over < 0) {
    loop_ -= over / stiffness;
    return -springs_.buckling_force;
  }
  const double damper = damping * (to.speed - from.speed);
  return std::max(0.0, over + std::min(over, damper)) - springs_.buckling_force;
}

void ElasticStrip::drive() {
  loop_ = 0;
  puller_tension_ = pull(puller_, wheel_, springs_.puller_stiffness, springs_.puller_damping);
  tension_ = pull(wheel_, cut_, springs_.cut_stiffness, springs_.cut_damping);
  puller_.add_force(puller_tension_);
  wheel_.add_force(tension_ - puller_tension_);
  cut_.add_force(-tension_);
}

void ElasticStrip::weigh(double overhang) {
  world_.set_mass(cut_, springs_.cut_mass + springs_.mass_per_metre * overhang);
}

double ElasticStrip::travel_at(double distance) const {
  const bool behind = distance <= data_.wheel_distance;  // the wheel
  const Slide& from = behind ? wheel_ : puller_;
  const Slide& to = behind ? cut_ : wheel_;
  const double low = behind ? 0 : data_.wheel_distance;
  const double high = behind ? data_.wheel_distance : data_.puller_distance;
  const double share = std::clamp((high - distance) / (high - low), 0.0, 1.0);
  return from.position + (to.position - from.position) * share;
}

void ElasticStrip::visit(StateArchive& archive) { STATE(archive, tension_, puller_tension_, loop_); }

}  // namespace drycut::plants
