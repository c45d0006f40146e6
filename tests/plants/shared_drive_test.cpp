// One drive and several motors, switched by contactors (001 1.4.1, 002 1.3.1).
#include <gmock/gmock.h>

#include <cmath>
#include <map>

#include "plants/linear_axis.hpp"
#include "tests/plants/plants_lookup.hpp"

namespace drycut::plants {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// Axis a has the drive; b, and c where there are three, are switched to it.
struct SharedLine {
  std::map<std::string, LinearAxisDefinition> definitions;
  World world{1};
  std::map<std::string, std::unique_ptr<Plant>> plants;
  std::map<std::string, std::vector<MachineEvent>> events;
  double now = 0;

  explicit SharedLine(const std::string& kind = "servo", int axes = 2) {
    for (int i = 0; i < axes; ++i) {
      auto& data = definitions[std::string(1, static_cast<char>('a' + i))].data;
      data.start = 0.5;
      data.drive.kind = i == 0 ? kind : "shared";
      if (i > 0) data.drive.shared.drive = "a";
    }
  }
  LinearAxisData& data(const std::string& axis) { return definitions.at(axis).data; }
  SharedLine& built() {
    for (auto& [name, definition] : definitions) {
      EXPECT_THAT(objections(name), IsEmpty());
      plants[name] = definition.build(world, [this](std::string_view other) {
        const auto found = plants.find(std::string(other));
        return found == plants.end() ? nullptr : found->second.get();
      });
    }
    return *this;
  }
  std::vector<std::string> objections(const std::string& name) {
    auto& definition = definitions.at(name);
    auto all = definition.objections(h);
    for (auto& more : definition.objections_with(
             [this](std::string_view other) -> PlantDefinition* {
               const auto found = definitions.find(std::string(other));
               return found == definitions.end() ? nullptr : &found->second;
             },
             h))
      all.push_back(std::move(more));
    std::vector<std::string> told;
    for (const auto& objection : all) told.push_back(objection.parameter + ": " + objection.what);
    return told;
  }

  double read(const std::string& axis, const std::string& name) { return channel(*plants.at(axis), name); }
  void command(const std::string& axis, const std::string& name, bool level) {
    plug<CommandPort>(*plants.at(axis), name).level = level;
  }
  void reference(double volts) { plug<ReferencePort>(*plants.at("a"), "servo.reference").volts = volts; }
  void fault(const std::string& axis, const std::string& component, const std::string& name, double value) {
    plants::fault(plants.at(axis)->faults(), component, name, value);
  }
  void step() {
    for (auto& [name, plant] : plants) plant->drive(h);
    world.step(h);
    for (auto& [name, plant] : plants) {
      plant->sense(h);
      for (MachineEvent& event : plant->take_events()) events[name].push_back(std::move(event));
    }
    now += h;
  }
  void run(double seconds) {
    for (long i = std::lround(seconds / h); i > 0; --i) step();
    ASSERT_EQ(world.failure(), "");
  }
  /// Steps until the channel changes; how long that took [ms].
  double until_changed(const std::string& axis, const std::string& name) {
    const double before = read(axis, name);
    const double from = now;
    while (read(axis, name) == before && now < from + 1) step();
    return (now - from) * 1e3;
  }
  bool closed(const std::string& axis) { return read(axis, "shared.closed") == 1; }
  std::vector<MachineEvent> switched_live() {
    std::vector<MachineEvent> found;
    for (const auto& event : events["a"])
      if (event.name == "switched_live") found.push_back(event);
    return found;
  }
};

TEST(SharedDrive, OneContactorOpensBeforeTheOtherCloses) {
  SharedLine line;
  line.data("a").drive.shared.open_delay = 12e-3;
  line.data("a").drive.shared.close_delay = 25e-3;
  line.data("b").drive.shared.open_delay = 9e-3;
  line.data("b").drive.shared.close_delay = 31e-3;
  line.built();
  constexpr double contact = 0.11;  // a step, in which the contact is seen, and rounding [ms]
  EXPECT_FALSE(line.closed("a"));
  EXPECT_NEAR(line.until_changed("a", "shared.closed"), 25, contact);
  line.command("b", "shared.select", true);
  EXPECT_NEAR(line.until_changed("a", "shared.closed"), 12, contact);
  EXPECT_FALSE(line.closed("b"));
  EXPECT_NEAR(line.until_changed("b", "shared.closed"), 31, contact);
  line.run(0.1);
  EXPECT_FALSE(line.closed("a"));
  line.command("b", "shared.select", false);
  EXPECT_NEAR(line.until_changed("b", "shared.closed"), 9, contact);
  EXPECT_FALSE(line.closed("a"));
  EXPECT_NEAR(line.until_changed("a", "shared.closed"), 25, contact);
}

TEST(SharedDrive, OnlyTheAxisThatIsConnectedIsDriven) {
  SharedLine line;
  line.built();
  line.reference(2);
  line.run(0.5);
  const double speed = 2.0 / 10 * 2000 / 60 * 20;  // of 2000 rpm at 10 V, 20 mm a turn
  EXPECT_NEAR(line.read("a", "speed"), speed, 0.5);
  EXPECT_EQ(line.read("b", "speed"), 0);
  EXPECT_EQ(line.read("b", "motor.torque"), 0);
  line.command("b", "shared.select", true);
  line.until_changed("a", "shared.closed");
  EXPECT_EQ(line.read("a", "motor.torque"), 0);  // the current ends with the circuit
  line.run(2);
  EXPECT_NEAR(line.read("b", "speed"), speed, 0.5);
  EXPECT_NEAR(line.read("a", "speed"), 0, 1e-9);  // friction has stopped it
  EXPECT_EQ(line.read("a", "motor.torque"), 0);
  const double friction = 0.1 + 0.0005 * speed / 20 * turn + (30 + 50 * speed / 1000) * 0.02 / turn;
  EXPECT_NEAR(line.read("b", "motor.torque"), friction, 1e-2);
}

TEST(SharedDrive, TheEncodersStayWithTheirAxes) {
  SharedLine line;
  line.built();
  line.reference(1);
  line.run(0.3);
  line.command("b", "shared.select", true);
  line.run(0.4);
  for (const char* axis : {"a", "b"}) {
    const auto counts = plug<EncoderPort>(*line.plants.at(axis), "encoder").count;
    const double moved = line.read(axis, "motor.position") - 500;
    EXPECT_GT(moved, 10);
    EXPECT_NEAR(static_cast<double>(counts) / 10000 * 20, moved, 0.003) << axis;
  }
}

TEST(SharedDrive, WhatIsNotDrivenIsHeldByItsBrake) {
  for (const double brake : {0.0, 5.0}) {
    SharedLine line;
    for (const char* axis : {"a", "b"}) {
      line.data(axis).inclination = pi / 2;
      line.data(axis).drive.brake.torque = brake;
      line.data(axis).drive.brake.engage_delay = 0;
      line.data(axis).guide_friction.coulomb = 30;
      line.data(axis).motor_friction.coulomb = 0.01;
    }
    line.built();
    line.run(0.5);
    // A weight of 196 N against 30 N of friction.
    const double b = line.read("b", "position");
    if (brake == 0) {
      EXPECT_LT(b, 470);
      continue;
    }
    EXPECT_NEAR(b, 500, 0.1);
    EXPECT_EQ(line.read("a", "brake.engaged"), 0);  // under the drive's own control
    EXPECT_EQ(line.read("b", "brake.engaged"), 1);
    const double before = line.read("a", "position");
    line.command("b", "shared.select", true);
    line.run(0.5);
    EXPECT_EQ(line.read("a", "brake.engaged"), 1);
    EXPECT_EQ(line.read("b", "brake.engaged"), 0);
    EXPECT_NEAR(line.read("a", "position"), before, 2);
    EXPECT_NEAR(line.read("b", "position"), b, 2);
  }
}

TEST(SharedDrive, SwitchingUnderCurrentIsToldWithIt) {
  SharedLine line;
  line.built();
  line.command("a", "servo.enable", false);
  line.run(0.1);
  line.command("b", "shared.select", true);
  line.run(0.1);
  line.command("b", "shared.select", false);
  line.run(0.1);
  EXPECT_THAT(line.switched_live(), IsEmpty());  // with the drive blocked it is in order
  line.command("a", "servo.enable", true);
  line.reference(10);
  line.run(0.01);
  const double torque = line.read("a", "motor.torque");
  ASSERT_GT(torque, 20);
  line.command("b", "shared.select", true);
  double last = 0;
  while (line.closed("a")) {
    last = line.read("a", "motor.torque");
    line.step();
  }
  ASSERT_EQ(line.switched_live().size(), 1U);
  const auto opened = line.switched_live().back();
  EXPECT_EQ(value(opened, "closed"), 0);
  EXPECT_NEAR(value(opened, "torque"), last, 1e-9);
  line.run(0.1);
  ASSERT_EQ(line.switched_live().size(), 2U);
  EXPECT_EQ(value(line.switched_live().back(), "closed"), 1);
  EXPECT_EQ(value(line.switched_live().back(), "torque"), 0);
}

TEST(SharedDrive, AuxiliaryContactsLetOneCloseAtATime) {
  SharedLine welded;
  welded.built();
  welded.run(0.1);
  welded.fault("a", "shared", "stuck_on", 1);
  welded.command("b", "shared.select", true);
  welded.run(0.2);
  EXPECT_TRUE(welded.closed("a"));
  EXPECT_FALSE(welded.closed("b"));
  welded.fault("a", "shared", "stuck_on", 0);
  welded.run(0.1);
  EXPECT_TRUE(welded.closed("b"));
  welded.fault("b", "shared", "stuck_off", 1);
  welded.run(0.1);
  EXPECT_FALSE(welded.closed("b"));
  EXPECT_FALSE(welded.closed("a"));  // its coil has no voltage while the other is selected
  welded.reference(5);
  welded.run(0.2);
  EXPECT_NEAR(welded.read("a", "speed"), 0, 1e-9);
  EXPECT_NEAR(welded.read("b", "speed"), 0, 1e-9);
}

TEST(SharedDrive, OfThreeAxesTheFirstThatIsSelectedStays) {
  SharedLine line("servo", 3);
  line.built();
  line.command("c", "shared.select", true);
  line.run(0.1);
  ASSERT_TRUE(line.closed("c"));
  line.command("b", "shared.select", true);
  line.run(0.1);
  EXPECT_TRUE(line.closed("c"));
  EXPECT_FALSE(line.closed("b"));
  line.command("c", "shared.select", false);
  line.run(0.1);
  EXPECT_TRUE(line.closed("b"));
  EXPECT_FALSE(line.closed("a"));
}

/// Runs there and back on one axis after the other.
void shuttle(SharedLine& line, const std::string& kind) {
  const auto go = [&](int direction) {
    if (kind == "servo") {
      line.reference(8.0 * direction);
    } else {
      line.command("a", "drive.forward", direction > 0);
      line.command("a", "drive.backward", direction < 0);
    }
    line.run(0.25);
  };
  for (int tour = 0; tour < 4; ++tour) {
    go(1);
    go(-1);
    go(0);
    line.command("b", "shared.select", tour % 2 == 0);
    line.run(0.1);
  }
}

TEST(SharedDrive, EnergyClosesOverBothMotors) {
  for (const std::string kind : {"servo", "inverter"}) {
    SharedLine line(kind);
    line.data("a").drive.inverter.acceleration = line.data("a").drive.inverter.deceleration = 0.2;
    line.built();
    const auto& a = *line.plants.at("a")->drives().at(0).stage;
    const auto& b = *line.plants.at("b")->drives().at(0).stage;
    const double stored = a.link()->stored();
    shuttle(line, kind);
    const double from_mains = a.totals().from_mains;
    const double used = a.totals().work + a.totals().copper + b.totals().work + b.totals().copper +
                        a.totals().in_resistor + a.link()->stored() - stored;
    EXPECT_GT(a.totals().copper, 1) << kind;
    EXPECT_GT(b.totals().copper, 1) << kind;
    EXPECT_NEAR(from_mains / used, 1, 1e-6) << kind;
    EXPECT_NEAR(a.totals().fed_squared, a.totals().current_squared + b.totals().current_squared,
                1e-9 * a.totals().fed_squared);
  }
}

TEST(SharedDrive, AMotorWarmsByItsOwnCurrentAlone) {
  SharedLine line;
  line.built();
  line.run(0.1);
  line.command("b", "shared.select", true);
  line.run(0.1);
  const double a = line.read("a", "motor.temperature");
  const double i2t = line.read("a", "drive.i2t");
  line.reference(10);
  line.run(0.3);
  line.reference(-10);
  line.run(0.3);
  EXPECT_LE(line.read("a", "motor.temperature"), a);
  EXPECT_GT(line.read("b", "motor.temperature"), a + 0.1);
  EXPECT_GT(line.read("a", "drive.i2t"), i2t + 1);  // the amplifier is that of both
}

TEST(SharedDrive, TheSensorOfTheOtherMotorTripsTheDrive) {
  SharedLine line;
  line.data("a").drive.servo.heat.temperature_limit = 273.15 + 40.05;
  line.built();
  line.command("b", "shared.select", true);
  line.run(0.1);
  for (int i = 0; i < 6 && line.events["b"].empty(); ++i) {
    line.reference(i % 2 == 0 ? 10 : -10);
    line.run(0.2);
  }
  ASSERT_FALSE(line.events["b"].empty());
  EXPECT_EQ(line.events["b"].front().name, "overload");
  EXPECT_FALSE(plug<SignalPort>(*line.plants.at("a"), "servo.ready").level);
  line.run(0.5);
  EXPECT_NEAR(line.read("b", "motor.torque"), 0, 1e-12);
  line.command("a", "servo.enable", false);
  line.step();
  line.command("a", "servo.enable", true);
  line.run(1e-3);
  EXPECT_GT(std::abs(line.read("b", "motor.torque")), 1);
}

TEST(SharedDrive, AnInverterIsSharedToo) {
  SharedLine line("inverter");
  line.built();
  line.run(0.1);
  line.command("b", "shared.select", true);
  line.run(0.1);
  EXPECT_THAT(line.switched_live(), IsEmpty());
  line.command("a", "drive.forward", true);
  line.command("a", "drive.slow", true);
  line.run(0.4);
  const double expected = (line.read("a", "drive.field_speed") - line.read("a", "drive.slip")) / 60 * 20;
  EXPECT_NEAR(expected, 150.0 / 60 * 20, 3);
  EXPECT_NEAR(line.read("b", "speed"), expected, 0.05);
  EXPECT_EQ(line.read("a", "speed"), 0);
  // Without a motor the frequency goes on, and what closes onto it starts at full slip.
  line.command("b", "shared.select", false);
  line.until_changed("b", "shared.closed");
  EXPECT_NEAR(line.read("a", "drive.field_speed"), 150, 1e-6);
  EXPECT_EQ(line.read("a", "drive.slip"), 0);
  line.run(2);
  EXPECT_EQ(line.switched_live().size(), 2U);
  EXPECT_NEAR(line.read("a", "speed"), expected, 0.5);
  EXPECT_NEAR(line.read("b", "speed"), 0, 1e-9);
}

TEST(SharedDrive, TheMotorIsOfTheTypeOfTheDrivesOwn) {
  SharedLine line;
  line.data("a").drive.servo.rotor_inertia = 0.01;
  line.data("b").drive.servo.rotor_inertia = 0.5;  // not asked for: it has no servo
  line.built();
  for (const char* axis : {"a", "b"})
    EXPECT_EQ(static_cast<LinearAxis&>(*line.plants.at(axis)).rotor().inertia, 0.01 + 3e-4) << axis;
}

TEST(SharedDrive, IsRefusedWhereThereIsNoDriveToShare) {
  SharedLine line("servo", 3);
  line.data("c").drive.shared.drive = "b";
  EXPECT_THAT(line.objections("c"), ElementsAre("shared.drive: b has no drive of its own"));
  line.data("b").drive.shared.drive = "none";
  EXPECT_THAT(line.objections("b"), ElementsAre("shared.drive: no axis is named whose drive it shares"));
  line.data("a").drive.shared.drive = "b";
  EXPECT_THAT(line.objections("a"), ElementsAre("shared.drive: its own drive is named too"));
  SharedLine contactors("contactors");
  EXPECT_THAT(contactors.objections("b"), ElementsAre("shared.drive: the drive of a is contactors"));
  // The guest's mechanics are judged with the motor that it gets.
  SharedLine light;
  light.data("b").gear.stiffness = 1e9;
  EXPECT_EQ(light.objections("b").size(), 1U);
}

TEST(SharedDrive, AnAxisThatSharesNothingOffersNothingOfIt) {
  LinearAxisDefinition definition;
  Machine machine(definition);
  for (const auto& one : machine.plant->channels()) EXPECT_NE(one.name, "shared.closed");
  for (const auto& one : machine.plant->faults()) EXPECT_NE(one.component, "shared");
  for (const auto& one : machine.plant->ports()) EXPECT_NE(one.name, "shared.select");
}

}  // namespace
}  // namespace drycut::plants
