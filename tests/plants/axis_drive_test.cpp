#include "plants/axis_drive.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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
      AxisDrive drive(data, Random());
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
  AxisDrive drive(data, Random());
  World world;
  Shaft& rotor = world.add_shaft({.name = "rotor", .inertia = 1});
  std::vector<Fault> faults;
  drive.offer_faults(faults);
  fault(faults, "drive.forward", "stuck_on", 1);
  fault(faults, "drive.backward", "stuck_on", 1);
  int told = 0;
  for (int i = 0; i < 100; ++i) {
    drive.drive(rotor, h);
    world.step(h);
    for (const Event& event : drive.take_events(rotor)) told += event.name == "trip" ? 1 : 0;
  }
  EXPECT_EQ(told, 1);
}

TEST(AxisDrive, AServoHasABrakeToo) {
  AxisDriveData data;
  data.brake.torque = 10;
  AxisDrive drive(data, Random());
  World world;
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
