#include "plants/axis_drive.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "plants/motor_load.hpp"
#include "tests/plants/plants_lookup.hpp"

namespace drycut::plants {
namespace {

TEST(HoldingBrake, FollowsItsCommandsAfterItsDelays) {
  HoldingBrakeData data;
  data.torque = 25;
  HoldingBrake brake(data);
  const auto steps_until = [&](bool moves, bool released) {
    int n = 0;
    while (brake.update(moves, h), brake.released() != released) ++n;
    return n;
  };
  EXPECT_EQ(brake.torque(), 25);
  EXPECT_EQ(steps_until(true, true), 600);
  EXPECT_EQ(brake.torque(), 0);
  EXPECT_EQ(steps_until(false, false), 400);
  brake.release.level = false;  // wired and off: the drive alone does not release it
  for (int i = 0; i < 2000; ++i) brake.update(true, h);
  EXPECT_FALSE(brake.released());
  EXPECT_TRUE(brake.commanded_to_hold());

  data.control = "output";
  HoldingBrake by_output(data);
  by_output.release.level = true;
  for (int i = 0; i < 601; ++i) by_output.update(false, h);
  EXPECT_TRUE(by_output.released());
}

TEST(HoldingBrake, Faults) {
  HoldingBrakeData data;
  data.torque = 20;
  HoldingBrake brake(data);
  std::vector<Fault> faults;
  brake.offer_faults(faults);
  fault(faults, "brake", "worn", 0.75);
  EXPECT_EQ(brake.torque(), 5);
  fault(faults, "brake", "worn", 1);
  EXPECT_EQ(brake.torque(), 0);
  fault(faults, "brake", "worn", 0);
  fault(faults, "brake", "stuck_open", 1);
  EXPECT_EQ(brake.torque(), 0);
  fault(faults, "brake", "stuck_open", 0);
  fault(faults, "brake", "stuck_closed", 1);
  for (int i = 0; i < 1000; ++i) brake.update(true, h);
  EXPECT_EQ(brake.torque(), 20);
}

TEST(AxisDrive, EveryKindHasItsPlugsFaultsAndChannels) {
  const auto names = [](auto& list) {
    std::vector<std::string> all;
    for (const auto& entry : list) all.push_back(entry.name);
    return all;
  };
  using ::testing::Contains;
  using ::testing::IsSupersetOf;
  using ::testing::Not;
  for (const char* kind : {"servo", "inverter", "contactors"})
    for (const double torque : {0.0, 20.0}) {
      AxisDriveData data;
      data.kind = kind;
      data.brake.torque = torque;
      World world;
      AxisDrive drive(data, world, "axis");
      std::vector<Port> ports;
      std::vector<Channel> channels;
      std::vector<Fault> faults;
      drive.offer_ports(ports);
      drive.offer_channels(channels);
      drive.offer_faults(faults);
      if (data.kind == "servo") {
        EXPECT_THAT(names(ports), IsSupersetOf({"servo.reference", "servo.enable"}));
        EXPECT_THAT(names(ports), Not(Contains("drive.forward")));
      } else {
        EXPECT_THAT(names(ports), IsSupersetOf({"drive.forward", "drive.backward", "drive.slow"}));
        EXPECT_THAT(names(channels), IsSupersetOf({"drive.state", "drive.frequency", "drive.slip"}));
        EXPECT_THAT(names(faults), IsSupersetOf({"trip", "phase_lost", "stuck_on", "stuck_off"}));
      }
      EXPECT_THAT(names(channels), IsSupersetOf({"motor.torque", "motor.utilisation"}));
      if (torque > 0) {
        EXPECT_THAT(names(ports), Contains("brake.release"));
        EXPECT_THAT(names(faults), Contains("stuck_open"));
      } else {
        EXPECT_THAT(names(ports), Not(Contains("brake.release")));
        EXPECT_THAT(names(faults), Not(Contains("stuck_open")));
      }
      for (const Channel& c : channels) EXPECT_TRUE(std::isfinite(c.read())) << c.name;
    }
}

TEST(AxisDrive, TripsAreToldOnce) {
  AxisDriveData data;
  data.kind = "contactors";
  World world;
  AxisDrive drive(data, world, "axis");
  Shaft& rotor = world.add_shaft({.name = "rotor", .inertia = 1});
  std::vector<Fault> faults;
  drive.offer_faults(faults);
  fault(faults, "drive.forward", "stuck_on", 1);
  fault(faults, "drive.backward", "stuck_on", 1);
  int told = 0;
  for (int i = 0; i < 100; ++i) {
    drive.drive(rotor, h);
    world.step(h);
    for (const MachineEvent& event : drive.take_events(rotor)) told += event.name == "trip" ? 1 : 0;
  }
  EXPECT_EQ(told, 1);
}

TEST(AxisDrive, AServoHasABrakeToo) {
  AxisDriveData data;
  data.brake.torque = 10;
  World world;
  AxisDrive drive(data, world, "axis");
  Shaft& rotor = world.add_shaft({.name = "rotor", .inertia = 0.01});
  std::vector<Port> ports;
  drive.offer_ports(ports);
  auto& enable = *std::get<CommandPort*>(ports[1].plug);
  ASSERT_EQ(ports[1].name, "servo.enable");
  const auto run = [&] {
    for (int i = 0; i < 1000; ++i) drive.drive(rotor, h), world.step(h);
  };
  run();
  EXPECT_EQ(drive.brake_torque(), 0);
  enable.level = false;
  run();
  EXPECT_EQ(drive.brake_torque(), 10);
  EXPECT_TRUE(drive.at_rest());
}

/// A servo axis with a brake of 10 N m on a free rotor of 0.01 kg m2 that turns at 50 rad/s, its amplifier
/// off.
struct BrakedRotor {
  AxisDriveData data;
  World world;
  Shaft& rotor = world.add_shaft({.name = "rotor", .inertia = 0.01});
  std::unique_ptr<AxisDrive> drive;
  std::vector<Port> ports;
  std::vector<Channel> channels;
  std::vector<Fault> faults;
  explicit BrakedRotor(double load) : load_(load) {
    data.brake.torque = 10;
    drive = std::make_unique<AxisDrive>(data, world, "axis");
    drive->offer_ports(ports);
    drive->offer_channels(channels);
    drive->offer_faults(faults);
    fault(faults, "brake", "stuck_open", 1);
    std::get<CommandPort*>(ports[1].plug)->level = false;  // servo.enable
    run(0.1);
    rotor.speed = 50;
  }
  void run(double seconds) {
    for (long i = std::lround(seconds / h); i > 0; --i) {
      drive->drive(rotor, h);
      rotor.add_torque(-load_);
      const double brake = drive->brake_torque();
      rotor.add_torque(friction_effort({}, rotor.speed, rotor.torque, rotor.inertia, h, {brake, brake}));
      world.step(h);
    }
  }
  double read(const std::string& name) {
    for (const Channel& c : channels)
      if (c.name == name) return c.read();
    ADD_FAILURE() << name;
    return 0;
  }

 private:
  double load_;
};

TEST(HoldingBrake, ItsSlipWorkIsTheEnergyThatItTakes) {
  // What a load helps or hinders over the way of braking comes on top: T_b w^2 J / 2 (T_b + T_l).
  for (const double load : {0.0, 4.0, -4.0}) {
    BrakedRotor braked(load);
    fault(braked.faults, "brake", "stuck_open", 0);
    braked.run(1);
    EXPECT_NEAR(braked.rotor.speed, 0, 1e-12);
    const double energy = 0.01 * 50 * 50 / 2 * 10 / (10 + load);
    EXPECT_NEAR(braked.read("brake.energy") / energy, 1, 1e-4) << load;
    EXPECT_EQ(braked.read("brake.last_energy"), braked.read("brake.energy"));
    EXPECT_EQ(braked.read("brake.engagements"), 1);
  }
}

TEST(HoldingBrake, CountsWhatItEngagesAtSpeed) {
  BrakedRotor braked(0);
  EXPECT_EQ(braked.read("brake.energy"), 0);
  EXPECT_EQ(braked.read("brake.engagements"), 0);
  const auto engage = [&](double speed) {
    fault(braked.faults, "brake", "stuck_open", 1);
    braked.run(0.01);
    braked.rotor.speed = speed;
    fault(braked.faults, "brake", "stuck_open", 0);
    braked.run(0.2);
  };
  engage(20);
  engage(-40);
  EXPECT_EQ(braked.read("brake.engagements"), 2);
  EXPECT_NEAR(braked.read("brake.last_energy"), 0.01 * 40 * 40 / 2, 0.001);
  EXPECT_NEAR(braked.read("brake.energy"), 0.01 * (20 * 20 + 40 * 40) / 2, 0.002);
  engage(0);  // a holding brake that holds wears nothing
  EXPECT_EQ(braked.read("brake.engagements"), 2);
  EXPECT_EQ(braked.read("brake.last_energy"), 0);
}

TEST(HoldingBrake, ItsDelaysScatterFromTimeToTime) {
  HoldingBrakeData data;
  data.torque = 25;
  data.scatter = 2e-3;
  HoldingBrake brake(data, Random(7));
  std::vector<int> engaged;
  for (int i = 0; i < 200; ++i) {
    int steps = 0;
    while (brake.update(true, h), !brake.released()) ++steps;
    steps = 0;
    while (brake.update(false, h), brake.released()) ++steps;
    engaged.push_back(steps);
  }
  EXPECT_NEAR(mean_of(engaged), 400, 6);  // 40 ms; three standard errors
  EXPECT_NEAR(deviation_of(engaged), 20, 3);
}

TEST(AxisDrive, WhatCannotBeIsRefused) {
  struct Case {
    const char* kind;
    void (*change)(AxisDriveData&);
    const char* objection;  // how it begins; "" = none
  };
  const std::vector<Case> cases = {
      {"servo", [](auto&) {}, ""},
      {"inverter", [](auto&) {}, ""},
      {"contactors", [](auto&) {}, ""},
      {"inverter", [](auto& d) { d.motor.winding.rated_speed = 158; },
       "induction_motor.rated_speed: it is not below synchronous_speed"},
      {"contactors", [](auto& d) { d.motor.winding.pullout_torque = 15; },
       "induction_motor.pullout_torque: it is not above rated_torque"},
      {"contactors", [](auto& d) { d.contactors.slow.pullout_torque = 10; },
       "contactors.slow.pullout_torque"},
      {"inverter", [](auto& d) { d.motor.winding.rated_speed = 156.95; }, "induction_motor.rated_speed: "},
      {"inverter", [](auto& d) { d.inverter.fast = 60; },
       "inverter.fast: 60 Hz is above the rated frequency"},
      {"inverter", [](auto& d) { d.inverter.slow = 60; }, "inverter.slow"},
      {"inverter", [](auto& d) { d.inverter.torque_limit = 50; }, "inverter.torque_limit: it is above"},
      {"contactors", [](auto& d) { d.inverter.fast = 60; }, ""},  // what is not chosen is not judged
  };
  for (std::size_t i = 0; i < cases.size(); ++i) {
    SCOPED_TRACE(i);
    AxisDriveData data;
    data.kind = cases[i].kind;
    cases[i].change(data);
    std::string told;
    for (const auto& o : axis_drive_objections(data, 5e-3, h)) {
      EXPECT_FALSE(o.remedy.empty());
      told += o.parameter + ": " + o.what + "\n";
    }
    if (*cases[i].objection == 0)
      EXPECT_EQ(told, "");
    else
      EXPECT_THAT(told, ::testing::StartsWith(cases[i].objection));
    EXPECT_LE(std::count(told.begin(), told.end(), '\n'), 1);
  }
}

}  // namespace
}  // namespace drycut::plants
