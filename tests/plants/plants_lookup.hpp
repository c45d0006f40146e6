#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include "base/units.hpp"
#include "plants/plant.hpp"
#include "plants/world.hpp"

namespace drycut::plants {

inline constexpr double h = 1e-4;  ///< the step of the tests [s]
inline constexpr double pi = std::numbers::pi;
using units::gravity;
using units::rpm;
using units::turn;

// What a plant offers, by name; a name that is not offered fails the test.

template <class Plug>
Plug& plug(Plant& plant, const std::string& name) {
  for (const Port& port : plant.ports())
    if (port.name == name) return *std::get<Plug*>(port.plug);
  ADD_FAILURE() << "no port " << name;
  throw std::out_of_range(name);
}

inline double channel(Plant& plant, const std::string& name) {
  for (const Channel& c : plant.channels())
    if (c.name == name) return c.read();
  ADD_FAILURE() << "no channel " << name;
  throw std::out_of_range(name);
}

inline void set(Plant& plant, const std::string& name, double value) {
  for (const Setting& s : plant.settings())
    if (s.name == name) return s.write(value);
  ADD_FAILURE() << "no setting " << name;
}

inline void fault(std::vector<Fault> faults, const std::string& component, const std::string& name,
                  double value) {
  for (const Fault& f : faults)
    if (f.component == component && f.name == name) return f.act(value);
  ADD_FAILURE() << "no fault " << component << " " << name;
}

inline double value(const Event& event, const std::string& name) {
  for (const Event::Value& v : event.values)
    if (v.name == name) return v.number;
  ADD_FAILURE() << "no value " << name;
  return 0;
}

/// A machine alone in its world, without a controller, stepped by hand.
struct Machine {
  World world;
  std::unique_ptr<Plant> plant;
  std::vector<Event> events;
  std::vector<double> times;  ///< of the events [s]
  int steps = 0;
  explicit Machine(PlantDefinition&& definition) : plant(definition.build(world, nullptr)) {}
  explicit Machine(PlantDefinition& definition) : plant(definition.build(world, nullptr)) {}
  /// An inverter's or a contactor drive's commands: direction 1 up, -1 down, 0 neither.
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

}  // namespace drycut::plants
