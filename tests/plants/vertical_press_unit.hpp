#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "plants/vertical_press.hpp"
#include "tests/plants/plants_lookup.hpp"

namespace drycut::plants {

constexpr double h = 1e-4;
constexpr double turn = 2 * std::numbers::pi;
constexpr double g = 9.80665;

/// A press without a controller.
struct Press {
  World world;
  std::unique_ptr<Plant> plant;
  std::vector<Event> events;
  std::vector<double> times;
  int steps = 0;
  explicit Press(const VerticalPressDefinition& definition = {}) {
    VerticalPressDefinition mine = definition;
    plant = mine.build(world, nullptr);
  }
  Slide& ram() { return static_cast<VerticalPress&>(*plant).ram(); }
  Shaft& rotor() { return static_cast<VerticalPress&>(*plant).rotor(); }
  /// direction 1 up, -1 down, 0 neither.
  void command(int direction, bool slow) {
    plug<CommandPort>(*plant, "drive.forward").level = direction > 0;
    plug<CommandPort>(*plant, "drive.backward").level = direction < 0;
    plug<CommandPort>(*plant, "drive.slow").level = slow;
  }
  void step(double dt = h) {
    plant->drive(dt);
    world.step(dt);
    plant->sense(dt);
    for (Event& event : plant->take_events()) {
      times.push_back((steps + event.fraction) * dt);
      events.push_back(std::move(event));
    }
    ++steps;
  }
  void run(double seconds, double dt = h) {
    for (long i = std::lround(seconds / dt); i > 0; --i) step(dt);
    ASSERT_EQ(world.failure(), "");
  }
};

inline VerticalPressDefinition frictionless_press() {
  VerticalPressDefinition definition;
  definition.data.motor_friction = {};
  definition.data.ram_friction = {};
  return definition;
}

}  // namespace drycut::plants
