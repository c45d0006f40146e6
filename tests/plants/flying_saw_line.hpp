#pragma once
#include "plants/flying_saw.hpp"
#include "tests/plants/plants_lookup.hpp"

namespace drycut::plants {

/// The default saw without friction.
inline FlyingSawDefinition frictionless_saw() {
  FlyingSawDefinition definition;
  definition.data.motor_friction = {};
  definition.data.guide_friction = {};
  return definition;
}

/// A strip that hardly anything drives, at `speed` [m/s].
inline WebDefinition free_web(double speed) {
  WebDefinition definition;
  definition.data.drive.speed = speed;
  definition.data.drive.stiffness = 1;
  definition.data.drive.damping = 0;
  definition.data.drive.max_force = 1e-12;
  definition.data.outfeed.start = 2;
  return definition;
}

/// A tube of 40 x 2 mm, hardly driven, at `speed` [m/s].
inline WebDefinition tube(double speed) {
  WebDefinition definition = free_web(speed);
  definition.data.section = "tube";
  definition.data.width = 0.04;
  definition.data.thickness = 2e-3;
  return definition;
}

/// The same without what would move the carriage: the motor holds nothing.
inline FlyingSawDefinition free_saw() {
  FlyingSawDefinition definition = frictionless_saw();
  definition.data.gear.stiffness = 1e-12;
  definition.data.gear.damping = 0;
  return definition;
}

/// Web and saw.
struct SawLine : Machine {
  explicit SawLine(FlyingSawDefinition saw, WebDefinition web = tube(0)) : Machine(saw, &web) {}
  [[nodiscard]] FlyingSaw& saw() const { return static_cast<FlyingSaw&>(*plant); }
  Slide& carriage() { return saw().carriage(); }
  Shaft& rotor() { return saw().rotor(); }
  Slide& material() { return static_cast<Web&>(*supply).material(); }
  double depth() { return saw().head().body().position; }    // [m]
  double head_speed() { return saw().head().body().speed; }  // [m/s]
};

}  // namespace drycut::plants
