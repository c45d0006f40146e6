#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "plants/servo_drive.hpp"
#include "tests/plants/plants_lookup.hpp"

namespace drycut::plants {
namespace {

constexpr double half_lsb = 10.0 / 16384;  // of the default converter [V]

/// A servo on a load that is rigidly its rotor.
struct Axis {
  ServoData data;
  World world;
  Shaft& rotor;
  ServoDrive servo;
  std::vector<Fault> faults;
  double load_torque = 0;
  explicit Axis(const ServoData& d = {}, std::uint64_t seed = 1)
      : data(d),
        world(seed),
        rotor(world.add_shaft({.name = "rotor", .inertia = d.rotor_inertia * (1 + d.inertia_ratio)})),
        servo(d, world.random("servo")) {
    servo.offer_faults(faults, "servo");
  }
  void step() {
    servo.drive(rotor, h);
    rotor.add_torque(load_torque);
    world.step(h);
  }
  void run(double seconds) {
    for (int i = 0; i < std::lround(seconds / h); ++i) step();
  }
  void fault(const std::string& name, double value) {
    const auto f = std::find_if(faults.begin(), faults.end(), [&](const Fault& x) { return x.name == name; });
    ASSERT_NE(f, faults.end()) << name;
    f->act(value);
  }
};

TEST(ServoDrive, ReachesTheReferenceSpeedUnderLoad) {
  Axis axis;
  axis.servo.reference.volts = 5;
  axis.load_torque = -6;
  axis.run(1);
  EXPECT_NEAR(axis.rotor.speed, axis.data.speed_at_10v / 2, 1e-6);
  EXPECT_NEAR(axis.servo.torque(), 6, 1e-4);
  EXPECT_NEAR(axis.servo.utilisation(), 6 / 9.5, 1e-4);
  axis.servo.reference.volts = -5;
  axis.run(1);
  EXPECT_NEAR(axis.rotor.speed, -axis.data.speed_at_10v / 2, 1e-6);
}

TEST(ServoDrive, AcceleratesAtPeakTorqueWithoutWindup) {
  Axis axis;
  axis.servo.reference.volts = 8;
  const double target = 0.8 * axis.data.speed_at_10v;
  double largest = 0;
  double peak = 0;
  bool saturated = false;
  for (int i = 0; i < 5000; ++i) {
    axis.step();
    largest = std::max(largest, axis.rotor.speed);
    peak = std::max(peak, axis.servo.torque());
    saturated |= axis.servo.saturated();
    if (i == 500) {
      // 50 ms: peak torque all the time but for the lags of filter and current loop.
      const double alpha = axis.data.peak_torque / axis.rotor.inertia;
      EXPECT_NEAR(axis.rotor.speed, alpha * 0.05, alpha * 1.5e-3);
    }
  }
  EXPECT_TRUE(saturated);
  EXPECT_NEAR(peak, axis.data.peak_torque, 1e-3);
  EXPECT_LE(peak, axis.data.peak_torque);
  EXPECT_LT(largest, target * 1.1);
  EXPECT_NEAR(axis.rotor.speed, target, half_lsb * axis.data.speed_at_10v / 10);
}

TEST(ServoDrive, TorqueFollowsTheTorqueSpeedCurve) {
  const ServoData data;
  EXPECT_EQ(ratings(data).peak(0), data.peak_torque);
  EXPECT_EQ(ratings(data).peak(-data.rated_speed), data.peak_torque);
  EXPECT_NEAR(ratings(data).peak((data.rated_speed + data.max_speed) / 2),
              (data.peak_torque + data.torque_at_max_speed) / 2, 1e-9);
  EXPECT_NEAR(ratings(data).peak(-data.max_speed), data.torque_at_max_speed, 1e-9);
  EXPECT_EQ(ratings(data).peak(data.max_speed * 1.06), 0);

  // Pulled beyond its speed the drive brakes with peak torque, and drives with less.
  ServoData fast;
  fast.speed_at_10v = 2 * fast.max_speed;
  Axis axis(fast);
  axis.servo.reference.volts = 10;
  axis.run(3);
  EXPECT_GT(axis.rotor.speed, fast.max_speed);
  EXPECT_LT(axis.rotor.speed, fast.max_speed * 1.06);
  axis.servo.reference.volts = -10;
  axis.run(0.01);
  EXPECT_NEAR(axis.servo.torque(), -fast.peak_torque, 0.05);
}

TEST(ServoDrive, ReferenceIsQuantisedByItsConverter) {
  ServoData data;
  data.adc_bits = 10;
  Axis axis(data);
  const double lsb = 20.0 / 1024;
  for (const double volts : {0.3 * lsb, 0.7 * lsb, -3.4 * lsb, 1.2345}) {
    axis.servo.reference.volts = volts;
    axis.step();
    EXPECT_DOUBLE_EQ(axis.servo.volts(), lsb * std::round(volts / lsb));
  }
  axis.servo.reference.volts = 14;
  axis.step();
  EXPECT_DOUBLE_EQ(axis.servo.volts(), 10 - lsb);
  axis.servo.reference.volts = -14;
  axis.step();
  EXPECT_DOUBLE_EQ(axis.servo.volts(), -10);
}

TEST(ServoDrive, FilterIsALagOfItsTimeConstant) {
  ServoData data;
  data.filter = 5e-3;
  Axis axis(data);
  axis.servo.reference.volts = 5;
  axis.run(5e-3);
  EXPECT_NEAR(axis.servo.speed_reference(), data.speed_at_10v / 2 * (1 - std::exp(-1)), 1e-9);
}

TEST(ServoDrive, CoastsWithoutEnableAndComesBackSmoothly) {
  Axis axis;
  axis.servo.reference.volts = 4;
  axis.run(0.5);
  const double speed = axis.rotor.speed;
  axis.servo.enable.level = false;
  axis.run(0.5);
  EXPECT_NEAR(axis.rotor.speed, speed, 0.01);
  EXPECT_NEAR(axis.servo.torque(), 0, 1e-12);
  axis.servo.enable.level = true;
  axis.run(0.5);
  EXPECT_NEAR(axis.rotor.speed, axis.data.speed_at_10v * 0.4, half_lsb * axis.data.speed_at_10v / 10);
}

TEST(ServoFaults, OffsetAndDriftShiftTheSpeedAndGoAway) {
  Axis axis;
  const double per_volt = axis.data.speed_at_10v / 10;
  const double lsb = 20.0 / 16384;
  axis.fault("offset", 0.1);
  axis.run(1);
  EXPECT_NEAR(axis.rotor.speed, 0.1 * per_volt, lsb * per_volt);
  axis.fault("offset", 0);
  axis.fault("drift", 0.05);
  axis.run(2);
  EXPECT_NEAR(axis.servo.volts(), 0.1, lsb);
  axis.fault("drift", 0);
  axis.run(1);
  EXPECT_NEAR(axis.rotor.speed, 0, 1e-6);
}

TEST(ServoFaults, StuckReferenceHoldsTheValueOfItsTime) {
  Axis axis;
  axis.servo.reference.volts = 3;
  axis.run(0.5);
  axis.fault("stuck", 1);
  axis.servo.reference.volts = 0;
  axis.run(0.5);
  EXPECT_NEAR(axis.rotor.speed, 0.3 * axis.data.speed_at_10v, 0.02);
  axis.fault("stuck", 0);
  axis.run(0.5);
  EXPECT_NEAR(axis.rotor.speed, 0, 1e-4);
}

TEST(ServoFaults, DisabledCoastsAndTorqueLimitLimits) {
  Axis axis;
  axis.fault("disabled", 1);
  axis.servo.reference.volts = 5;
  axis.run(0.1);
  EXPECT_EQ(axis.rotor.speed, 0);
  axis.fault("disabled", 0);
  axis.fault("torque_limit", 2);
  axis.run(0.05);
  EXPECT_NEAR(axis.servo.torque(), 2, 1e-9);
  axis.fault("torque_limit", 0);
  axis.run(0.02);
  EXPECT_GT(axis.servo.torque(), 20);
}

TEST(ServoFaults, NoiseFollowsTheSeed) {
  const auto run = [](std::uint64_t seed, double rms) {
    Axis axis({}, seed);
    axis.fault("noise", rms);
    axis.run(0.2);
    return axis.rotor.speed;
  };
  EXPECT_EQ(run(1, 0.2), run(1, 0.2));
  EXPECT_NE(run(1, 0.2), run(2, 0.2));
  EXPECT_EQ(run(1, 0), 0);
}

}  // namespace
}  // namespace drycut::plants
