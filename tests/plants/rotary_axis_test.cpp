#include "plants/rotary_axis.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/plants/plants_lookup.hpp"

namespace drycut::plants {
namespace {

struct Table : Machine {
  explicit Table(RotaryAxisDefinition definition, bool enabled = false) : Machine(definition) {
    command("servo.enable", enabled);
  }
  Shaft& table() { return static_cast<RotaryAxis&>(*plant).table(); }
  Shaft& rotor() { return static_cast<RotaryAxis&>(*plant).rotor(); }
};

RotaryAxisDefinition frictionless() {
  RotaryAxisDefinition definition;
  definition.data.motor_friction = definition.data.friction = {};
  return definition;
}

/// All that turns, seen at the table [kg m2].
double total(const RotaryAxisData& data) {
  return data.inertia + data.drive.rotor_inertia() * data.gear.ratio * data.gear.ratio;
}

/// Angular frequency at which a shaft passes an angle upwards [rad/s].
template <class Read>
double swing(Table& table, int steps, double dt, Read read) {
  std::vector<double> crossings;
  double before = read();
  for (int i = 0; i < steps; ++i) {
    table.step(dt);
    const double now = read();
    if (before < 0 && now >= 0) crossings.push_back((i + before / (before - now)) * dt);
    before = now;
  }
  EXPECT_GT(crossings.size(), 5U);
  return turn * static_cast<double>(crossings.size() - 1) / (crossings.back() - crossings.front());
}

TEST(RotaryAxis, ATorqueOfTheProcessTurnsMotorAndTable) {
  const auto definition = frictionless();
  Table table(definition);
  table.set("torque", 20);
  table.run(1);
  EXPECT_NEAR(table.table().speed, 20 / total(definition.data), 1e-3 * table.table().speed);
  EXPECT_NEAR(table.read("motor.speed"), table.table().speed * 10 * rpm, 0.1);
}

// Without end: no digit is lost in a thousand turns.
TEST(RotaryAxis, CountsEveryTurn) {
  auto definition = frictionless();
  definition.data.sensors.encoder_on_load = true;
  Table table(definition);
  table.table().speed = 10;
  table.rotor().speed = 100;
  table.run(700);
  EXPECT_GT(table.table().turns, 1000);
  EXPECT_NEAR(table.read("encoder.count"), table.table().revolutions() * 10000, 1);
  EXPECT_NEAR(table.read("angle.total"), 7000 * units::degrees, 1e-3);
}

// A small swing about where it hangs down: sqrt(T / J).
TEST(RotaryAxis, AnUnbalanceIsAPendulum) {
  auto definition = frictionless();
  auto& data = definition.data;
  data.unbalance = 50;
  data.unbalance_angle = 1;
  data.start = 1.02;
  data.gear.stiffness = 1e6;
  data.gear.damping = 0;
  Table table(definition);
  const double found = swing(table, 100'000, h, [&] { return table.table().angle() - 1; });
  EXPECT_NEAR(found / std::sqrt(50 / total(data)), 1, 1e-3);
}

TEST(RotaryAxis, TheServoHoldsItsUnbalance) {
  auto definition = frictionless();
  definition.data.unbalance = 50;
  definition.data.start = pi / 2;
  Table table(definition, true);
  table.run(1);
  EXPECT_NEAR(table.read("motor.torque"), 5, 0.02);
}

TEST(RotaryAxis, SwingsAtTheTwoMassResonance) {
  auto definition = frictionless();
  definition.data.gear.damping = 0;
  Table table(definition);
  table.table().speed = 0.1;
  const double found = swing(table, 20'000, 1e-5, [&] { return table.read("gear.twist"); });
  EXPECT_NEAR(found / resonance(definition.data.gear, definition.data.drive.rotor_inertia(), 0.9), 1, 1e-3);
}

// What the motor gives goes into its parts.
TEST(RotaryAxis, ItsTorqueIsTheSumOfItsCauses) {
  RotaryAxisDefinition definition;
  definition.data.unbalance = 20;
  definition.data.gear.efficiency = {0.9, 0.88};
  Table table(definition, true);
  table.reference(3);
  for (int i = 0; i < 5'000; ++i) {
    table.step(h);
    const MotorLoad load = dynamic_cast<TellsMotorLoad&>(*table.plant).motor_load(h);
    ASSERT_NEAR(load.acceleration + load.friction + load.load + load.gravity, load.torque, 1e-9);
    ASSERT_NEAR(load.load, 0, 1e-6);
  }
}

// An indexer on contactors, with its brake.
TEST(RotaryAxis, TakesAnyDriveOfAnAxis) {
  for (const char* kind : {"servo", "inverter", "contactors"}) {
    RotaryAxisDefinition definition;
    definition.data.drive.kind = kind;
    definition.data.drive.brake.torque = 20;
    EXPECT_TRUE(definition.objections(h).empty()) << kind;
    Machine table(definition);
    EXPECT_EQ(table.plant->drives().size(), 1U);
    table.run(0.1);
    EXPECT_EQ(table.world.failure(), "");
  }
}

}  // namespace
}  // namespace drycut::plants
