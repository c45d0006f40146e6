#pragma once
#include <cmath>
#include <memory>
#include <vector>

#include "plants/flying_saw.hpp"
#include "tests/plants/plants_lookup.hpp"

namespace drycut::plants {

/// The default saw without friction.
inline FlyingSawDefinition frictionless_saw() {
  FlyingSawDefinition definition;
  definition.data.motor_friction = {};
  definition.data.carriage_friction = {};
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

/// Web and saw.
struct SawLine {
  World world;
  std::unique_ptr<Plant> web;
  std::unique_ptr<Plant> saw;
  std::vector<Event> events;
  int steps = 0;
  explicit SawLine(FlyingSawDefinition saw_definition, WebDefinition web_definition = tube(0))
      : web(web_definition.build(world, nullptr)) {
    saw = saw_definition.build(world, [this](std::string_view) { return web.get(); });
  }
  Slide& carriage() { return static_cast<FlyingSaw&>(*saw).carriage(); }
  Shaft& rotor() { return static_cast<FlyingSaw&>(*saw).rotor(); }
  Slide& material() { return static_cast<Web&>(*web).material(); }
  double depth() { return static_cast<FlyingSaw&>(*saw).head().body().position; }    // [m]
  double head_speed() { return static_cast<FlyingSaw&>(*saw).head().body().speed; }  // [m/s]
  void step() {
    web->drive(h);
    saw->drive(h);
    world.step(h);
    web->sense(h);
    saw->sense(h);
    for (Event& event : saw->take_events()) events.push_back(std::move(event));
    ++steps;
  }
  void run(double seconds) {
    const auto count = std::lround(seconds / h);
    for (long i = 0; i < count; ++i) step();
    ASSERT_EQ(world.failure(), "");
  }
};

}  // namespace drycut::plants
