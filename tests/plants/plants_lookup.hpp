#pragma once
#include <gmock/gmock.h>
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

inline void fault(const std::vector<Fault>& faults, const std::string& component, const std::string& name,
                  double value) {
  for (const Fault& f : faults)
    if (f.component == component && f.name == name) return f.act(value);
  ADD_FAILURE() << "no fault " << component << " " << name;
}

inline double value(const MachineEvent& event, const std::string& name) {
  for (const MachineEvent::Value& v : event.values)
    if (v.name == name) return v.number;
  ADD_FAILURE() << "no value " << name;
  return 0;
}

inline double mean_of(const std::vector<int>& all) {
  double sum = 0;
  for (const int one : all) sum += one;
  return sum / static_cast<double>(all.size());
}
/// Standard deviation.
inline double deviation_of(const std::vector<int>& all) {
  double squares = 0;
  for (const int one : all) squares += (one - mean_of(all)) * (one - mean_of(all));
  return std::sqrt(squares / static_cast<double>(all.size()));
}

/// The pose of the part of that name, now.
inline PartPose pose_of(Plant& plant, const std::string& name) {
  for (const Part& part : plant.parts())
    if (part.name == name) return part.now();
  ADD_FAILURE() << "no part " << name;
  throw std::out_of_range(name);
}

/// A machine without a controller, stepped by hand: alone in its world, or on the web that `supplied`
/// defines.
struct Machine {
  World world;
  std::unique_ptr<Plant> supply;  ///< the web, null without one
  std::unique_ptr<Plant> plant;
  std::vector<MachineEvent> events;  ///< of the machine
  std::vector<double> times;         ///< of the events [s]
  int unclamped = 0;                 ///< events `unclamped`, which are not among them
  int steps = 0;
  explicit Machine(PlantDefinition& definition, PlantDefinition* supplied = nullptr, std::uint64_t seed = 1)
      : world(seed), supply(supplied != nullptr ? supplied->build(world, nullptr) : nullptr) {
    plant = definition.build(world, [this](std::string_view) { return supply.get(); });
  }
  explicit Machine(PlantDefinition&& definition) : Machine(definition) {}

  double read(const std::string& name) { return channel(*plant, name); }
  template <class Plug>
  Plug& plug(const std::string& name) {
    return plants::plug<Plug>(*plant, name);
  }
  void set(const std::string& name, double value) { plants::set(*plant, name, value); }
  void command(const std::string& name, bool level) { plug<CommandPort>(name).level = level; }
  void reference(double volts) { plug<ReferencePort>("servo.reference").volts = volts; }
  void fault(const std::string& component, const std::string& name, double value) {
    plants::fault(plant->faults(), component, name, value);
  }
  /// An inverter's or a contactor drive's commands: direction 1 up, -1 down, 0 neither.
  void command(int direction, bool slow) {
    command("drive.forward", direction > 0);
    command("drive.backward", direction < 0);
    command("drive.slow", slow);
  }

  /// The one event that there was, of that name.
  const MachineEvent& only(const std::string& name) {
    EXPECT_EQ(events.size(), 1U);
    EXPECT_EQ(events.at(0).name, name);
    return events.at(0);
  }

  void step(double dt = h) {
    if (supply) supply->drive(dt);
    plant->drive(dt);
    world.step(dt);
    if (supply) supply->sense(dt);
    plant->sense(dt);
    for (MachineEvent& event : plant->take_events()) {
      if (event.name == "unclamped") {  // as most cuts are here
        ++unclamped;
        continue;
      }
      if (event.name == "saturated") continue;  // the drives' own tests look at it
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

/// What a plant objects to in steps of `h` seconds, "parameter: what is wrong"; each objection has a remedy.
inline std::vector<std::string> objections_of(PlantDefinition& definition, double dt = h,
                                              PlantDefinition* supplied = nullptr) {
  auto all = definition.objections(dt);
  for (auto& more : definition.objections_with([&](std::string_view) { return supplied; }, dt))
    all.push_back(std::move(more));
  std::vector<std::string> told;
  for (const auto& objection : all) {
    EXPECT_FALSE(objection.what.empty());
    EXPECT_FALSE(objection.remedy.empty());
    told.push_back(objection.parameter + ": " + objection.what);
  }
  return told;
}

/// A change of a plant's data, and how each objection to it begins.
template <class Data>
struct Refusal {
  void (*change)(Data&);
  std::vector<std::string> objections;
};
/// Each change is made to the defaults, which nothing is wrong with.
template <class Definition>
void expect_refusals(const std::vector<Refusal<decltype(Definition::data)>>& refusals) {
  Definition sound;
  EXPECT_THAT(objections_of(sound), testing::IsEmpty());
  for (std::size_t i = 0; i < refusals.size(); ++i) {
    SCOPED_TRACE(i);
    Definition changed;
    refusals[i].change(changed.data);
    std::vector<testing::Matcher<std::string>> wanted;
    for (const auto& begin : refusals[i].objections) wanted.push_back(testing::StartsWith(begin));
    EXPECT_THAT(objections_of(changed), testing::ElementsAreArray(wanted));
  }
}

}  // namespace drycut::plants
