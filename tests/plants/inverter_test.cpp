#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/plants/drive_stand.hpp"

namespace drycut::plants {
namespace {

TEST(Inverter, TheReferenceIsARampFromStandstillToItsPresetSpeeds) {
  InverterData data;
  data.acceleration = 1;
  data.deceleration = 0.5;
  InverterStand stand(data, 5e-3);  // a light rotor: no torque limit
  stand.drive.forward.level = true;
  for (int i = 0; i < 12000; ++i) {
    stand.step();
    const double ramp = (i - 49) * h;  // 50 steps of input filter, the 51st has moved the frequency
    EXPECT_NEAR(stand.drive.frequency(), std::clamp(50 * ramp, 0.0, 50.0), 1e-9) << i;
  }
  stand.drive.slow.level = true;
  for (int i = 0; i < 6000; ++i) {
    stand.step();
    EXPECT_NEAR(stand.drive.frequency(), std::clamp(50 - 100 * (i - 49) * h, 5.0, 50.0), 1e-9) << i;
  }
  stand.drive.forward.level = false;
  stand.drive.backward.level = true;
  stand.drive.slow.level = false;
  for (int i = 0; i < 12000; ++i) {
    stand.step();
    const double t = (i - 49) * h;  // 50 ms down to 0, then the slower ramp backwards
    const double expected = t < 0.05 ? 5 - 100 * std::max(0.0, t) : -50 * (t - 0.05);
    EXPECT_NEAR(stand.drive.frequency(), std::max(-50.0, expected), 1e-9) << i;
  }
}

TEST(Inverter, SlipGrowsWithTheLoadAsOnTheDataSheet) {
  const WindingData winding;
  double before = 1e9;
  for (const double load : {-14.8, -5.0, 0.0, 5.0, 14.8, 20.0}) {
    InverterStand stand;
    stand.drive.forward.level = true;
    stand.run(1);
    stand.load = load;
    stand.run(2);
    const double slip = sync - stand.rotor.speed;
    if (load != 0)
      EXPECT_NEAR(kloss(winding, slip), load, 1e-6);
    else
      EXPECT_NEAR(slip, 0, 1e-6);
    EXPECT_NEAR(stand.drive.slip() * rpm, slip * rpm, 0.01);
    EXPECT_LT(stand.rotor.speed, before);
    before = stand.rotor.speed;
    if (load == 14.8) {
      EXPECT_NEAR(stand.rotor.speed * rpm, 1420, 1e-6);
    }
  }
}

TEST(Inverter, AtTheTorqueLimitTheFrequencyFollowsTheRotor) {
  InverterStand stand({}, 1);  // 1500 rpm in 0.5 s would take 314 N m
  stand.drive.forward.level = true;
  stand.run(0.505);
  const double speed = stand.rotor.speed;
  stand.run(1);
  EXPECT_NEAR(stand.rotor.speed - speed, 22, 1e-6);
  EXPECT_TRUE(stand.drive.limited());
  EXPECT_NEAR(stand.drive.torque(), 22, 1e-9);
  EXPECT_NEAR(stand.drive.frequency(), (stand.rotor.speed + stand.drive.slip()) / sync * 50, 0.01);
  stand.run(12);
  EXPECT_FALSE(stand.drive.limited());
  EXPECT_NEAR(stand.rotor.speed, sync, 1e-3);
  const auto is_pulled_out = [&] {
    const auto events = stand.drive.power().take_events();
    return std::count_if(events.begin(), events.end(),
                         [](const MachineEvent& event) { return event.name == "pulled_out"; });
  };
  EXPECT_EQ(is_pulled_out(), 0) << "its ramp has waited";
  fault(stand.faults(), "drive", "torque_limit", 10);
  stand.load = 12;
  stand.run(3);
  EXPECT_EQ(is_pulled_out(), 1) << "the load drives it away from its speed";
  const double fast = stand.rotor.speed;
  stand.run(1);
  EXPECT_NEAR(stand.rotor.speed - fast, 10 - 12, 1e-6);
  fault(stand.faults(), "drive", "torque_limit", 0);
  stand.run(10);
  EXPECT_NEAR(kloss(WindingData{}, sync - stand.rotor.speed), 12, 1e-3);
}

TEST(Inverter, ARampStopHoldsAtZeroAndLetsGo) {
  InverterStand stand;
  stand.drive.forward.level = true;
  stand.run(1.5);
  stand.drive.forward.level = false;
  stand.run(5e-3);
  EXPECT_EQ(stand.drive.state(), Inverter::State::running);
  stand.run(0.499);
  EXPECT_EQ(stand.drive.state(), Inverter::State::stopping);
  EXPECT_TRUE(stand.drive.moving());
  stand.run(2e-3);
  EXPECT_EQ(stand.drive.state(), Inverter::State::holding);
  EXPECT_FALSE(stand.drive.moving());  // the brake may engage
  EXPECT_EQ(stand.drive.frequency(), 0);
  stand.run(0.097);
  EXPECT_EQ(stand.drive.state(), Inverter::State::holding);
  stand.run(3e-3);
  EXPECT_EQ(stand.drive.state(), Inverter::State::off);
  stand.load = 3;
  const double speed = stand.rotor.speed;
  stand.run(0.01);
  EXPECT_NEAR(stand.rotor.speed - speed, -3 * 0.01 / 0.05, 1e-9);  // nothing holds
}

TEST(Inverter, CoastingTakesTheTorqueAway) {
  InverterData data;
  data.stop = "coast";
  InverterStand stand(data);
  stand.drive.backward.level = true;
  stand.run(2);
  EXPECT_NEAR(stand.rotor.speed, -sync, 1e-6);
  stand.drive.backward.level = false;
  stand.run(5.1e-3);
  EXPECT_EQ(stand.drive.state(), Inverter::State::off);
  const double speed = stand.rotor.speed;
  stand.run(1);
  EXPECT_EQ(stand.rotor.speed, speed);
  EXPECT_EQ(stand.drive.torque(), 0);
}

TEST(Inverter, TheDcBrakeSlowsAsItsCurveSays) {
  InverterData data;
  data.stop = "dc_brake";
  InverterStand stand(data);
  stand.drive.forward.level = true;
  stand.run(2);
  stand.drive.forward.level = false;
  stand.run(5.1e-3);
  ASSERT_EQ(stand.drive.state(), Inverter::State::dc_braking);
  // J dw/dt = -2 T x/(1 + x^2) with x = w/w0: J w0/(2 T) (ln x + x^2/2) falls with time.
  const double w0 = pullout_slip(WindingData{});
  const auto clock = [&](double w) {
    const double x = w / w0;
    return 0.05 * w0 / (2 * 15) * (std::log(x) + x * x / 2);
  };
  const double at = clock(stand.rotor.speed);
  stand.run(0.4);
  EXPECT_NEAR(at - clock(stand.rotor.speed), 0.4, 4e-4);
  stand.run(0.1);
  EXPECT_EQ(stand.drive.state(), Inverter::State::off);
}

TEST(Inverter, BothDirectionsAreNone) {
  InverterStand stand;
  stand.drive.forward.level = stand.drive.backward.level = true;
  stand.run(1);
  EXPECT_EQ(stand.rotor.speed, 0);
  EXPECT_EQ(stand.drive.state(), Inverter::State::off);
  stand.drive.backward.level = false;
  stand.run(1);
  EXPECT_GT(stand.rotor.speed, 100);
  stand.drive.backward.level = true;
  stand.run(1);
  EXPECT_EQ(stand.drive.state(), Inverter::State::off);
}

TEST(Inverter, StuckInputsAndTrips) {
  InverterStand stand;
  auto faults = stand.faults();
  fault(faults, "drive.forward", "stuck_on", 1);
  stand.run(1);
  EXPECT_NEAR(stand.rotor.speed, sync, 1e-3);
  fault(faults, "drive.slow", "stuck_on", 1);
  stand.run(1);
  EXPECT_NEAR(stand.rotor.speed, sync / 10, 1e-3);
  fault(faults, "drive.slow", "stuck_on", 0);
  fault(faults, "drive", "trip", 1);
  const double speed = stand.rotor.speed;
  stand.run(1);
  EXPECT_EQ(stand.drive.state(), Inverter::State::tripped);
  EXPECT_EQ(stand.rotor.speed, speed);
  fault(faults, "drive", "trip", 0);
  stand.run(1);
  EXPECT_NEAR(stand.rotor.speed, sync, 1e-3);
  fault(faults, "drive", "phase_lost", 1);
  stand.run(0.01);
  EXPECT_EQ(stand.drive.state(), Inverter::State::tripped);
  fault(faults, "drive", "phase_lost", 0);
  stand.run(0.01);
  EXPECT_EQ(stand.drive.state(), Inverter::State::tripped);  // until it is reset
  fault(faults, "drive", "trip", 0);
  stand.run(0.01);
  EXPECT_EQ(stand.drive.state(), Inverter::State::running);
  fault(faults, "drive.forward", "stuck_on", 0);
  stand.run(1);
  fault(faults, "drive", "phase_lost", 1);
  stand.run(0.01);
  EXPECT_EQ(stand.drive.state(), Inverter::State::off);  // nothing to see while it stands
}

}  // namespace
}  // namespace drycut::plants
