#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/devices/plcopen/bench.hpp"

namespace drycut::devices::plcopen {
namespace {

/// A slave geared to an encoder, or to a virtual master.
struct Geared : Bench {
  McGearIn gear;
  explicit Geared(const AxisParameters& parameters = virtual_axis()) : Bench(parameters) {
    gear.Master = master;
    gear.Slave = slave;
  }
  void go() {
    gear.Execute = false;
    gear.call(kernel);
    gear.Execute = true;
    for (int i = 0; i < 5'000 && !gear.InGear && !gear.Error; ++i) turn_over();
    EXPECT_TRUE(gear.InGear) << gear.ErrorID;
  }
  Peaks until_in_gear() {
    Peaks peaks;
    for (; !gear.InGear; peaks.take(s().set())) turn_over();
    return peaks;
  }
  void turn_over(int times = 1) {
    for (int i = 0; i < times; ++i) {
      run.call(kernel);
      gear.call(kernel);
      kernel.cycle();
    }
    gear.call(kernel);
  }
};

TEST(PlcopenGear, AGearKeepsItsRatioExactlyOverAnyNumberOfTurns) {
  Geared b;
  b.start_master();
  b.gear.RatioNumerator = -7;
  b.gear.RatioDenominator = 3;
  b.go();
  const Position slave = b.s().set().position;
  const Position master = b.m().set().position;
  b.turn_over(20'000);
  const double way = difference(b.m().set().position, master, turn);
  EXPECT_NEAR(difference(b.s().set().position, slave, turn), way * -7 / 3, 1e-5);
  EXPECT_GT(way, 39 * turn);
  auto out = b.make<McGearOut>();
  out.Execute = true;
  out.call(b.kernel);
  EXPECT_TRUE(out.Done);
  b.turn_over(2);
  EXPECT_TRUE(b.gear.CommandAborted);
  EXPECT_NEAR(b.s().set().velocity, -7.0 / 3 * b.m().set().velocity, 1e-3);
  covers("MC_GearIn", {"Master", "RatioNumerator", "RatioDenominator", "InGear"});
  covers({"MC_GearOut.Done", "MC_GearOut.Slave"});
}

TEST(PlcopenGear, AGearEngagesWithItsOwnDynamics) {
  Geared b;
  b.start_master();
  b.gear.Acceleration = 1'500;
  b.gear.Deceleration = 600;
  b.gear.Jerk = 30'000;
  b.gear.Execute = true;
  const Peaks up = b.until_in_gear();
  EXPECT_NEAR(up.a, 1.5e7, 1);
  EXPECT_NEAR(up.j, 3e8, 1e3);
  b.gear.RatioDenominator = 4;
  b.gear.Execute = false;
  b.gear.call(b.kernel);
  b.gear.Execute = true;
  b.turn_over();
  const Peaks down = b.until_in_gear();
  EXPECT_NEAR(down.d, 6e6, 1);
  covers("MC_GearIn", {"Acceleration", "Deceleration", "Jerk"});
}

TEST(PlcopenGear, AGearsRefusalsHaveTheirNumbers) {
  Geared b;
  const auto error = [&] {
    execute(b.gear, b.kernel);
    return static_cast<ErrorId>(b.gear.ErrorID);
  };
  b.gear.Mode = 0x100;
  EXPECT_EQ(error(), ErrorId::gear_mode);
  b.gear.Mode = 0;
  b.gear.RatioNumerator = 0;
  EXPECT_EQ(error(), ErrorId::gear_ratio);
  b.gear.RatioNumerator = 1;
  b.gear.RatioDenominator = 0;
  EXPECT_EQ(error(), ErrorId::gear_ratio);
  b.gear.RatioDenominator = 1;
  b.gear.Jerk = -1;
  EXPECT_EQ(error(), ErrorId::jerk_range);
  b.gear.Jerk = 0;
  b.s().control.feed_enable = false;
  EXPECT_EQ(error(), ErrorId::feed_enable_missing);
  b.s().control.feed_enable = true;
  EXPECT_EQ(error(), ErrorId::none);
  // Phasing before it is engaged, and with a master that is not the slave's.
  auto phasing = b.make<McPhasing>(100);
  phasing.Execute = true;
  phasing.call(b.kernel);
  EXPECT_EQ(phasing.ErrorID, id(ErrorId::phasing_slave_not_reached));
  McPhasing other;
  other.Master = other.Slave = b.slave;
  other.Velocity = 100;
  other.Execute = true;
  other.call(b.kernel);
  EXPECT_EQ(other.ErrorID, id(ErrorId::phasing_not_synchronous));
  covers({"44062", "65009", "60173", "60175", "MC_GearIn.Mode"});
}

TEST(PlcopenGear, AGearedSlavesAccelerationIsLimitedAndTheWayCaughtUp) {
  Geared b;
  b.set("cam_gear.a_max_slave", 500);
  b.go();
  b.run.Execute = true;
  Peaks peaks;
  for (int i = 0; i < 4'000; ++i) {
    b.turn_over();
    peaks.take(b.s().set());
  }
  EXPECT_NEAR(peaks.a, 5e6, 1);
  EXPECT_NEAR(difference(b.s().set().position, b.m().set().position, turn), 0, 1e-5);
  const auto remarks = b.s().take_remarks();
  ASSERT_EQ(remarks.size(), 1U);
  EXPECT_EQ(remarks[0].text, "the gear asks for more than cam_gear.a_max_slave 500 allows: the slave lags");
  covers({"cam_gear.a_max_slave"});
}

TEST(PlcopenGear, AnEncoderLeadsWithItsActualValues) {
  AxisParameters wheel = axis_of(AxisKind::encoder);
  wheel.is_master = true;
  wheel.average_filter = true;
  wheel.filter_cycles = 25;
  MotionKernel kernel;
  const AxisRef master = kernel.add_axis("Wheel", wheel);
  const AxisRef slave = kernel.add_axis("Slave", Bench::virtual_axis());
  EXPECT_EQ(kernel.find_axis("Slave"), slave);
  EXPECT_EQ(kernel.find_axis("Nobody"), AxisRef{});
  McPower power;
  power.Axis = slave;
  power.Enable = true;
  power.call(kernel);
  McGearIn gear;
  gear.Master = master;
  gear.Slave = slave;
  gear.Mode = 0x80;
  gear.Execute = true;
  double counts = 0;
  double low = HUGE_VAL;
  double high = 0;
  for (int i = 0; i < 3'000; ++i) {
    counts += 10.4;
    kernel.axis(master)->drive.counts = std::llround(counts);
    gear.call(kernel);
    kernel.cycle();
    if (i < 100) continue;
    low = std::min(low, kernel.axis(master)->actual_velocity());
    high = std::max(high, kernel.axis(master)->actual_velocity());
  }
  EXPECT_TRUE(gear.InGear);
  // The mean over 25 cycles is within one count of 25 cycles: 360/0.05.
  EXPECT_NEAR(low, 10.4 * 360 / cycle_s, 360 / 0.05);
  EXPECT_NEAR(high, 10.4 * 360 / cycle_s, 360 / 0.05);
  // A dead time carries the master on.
  const auto ahead = [&] {
    return difference(kernel.axis(slave)->set().position, kernel.axis(master)->actual(), turn);
  };
  const double before = ahead();
  EXPECT_TRUE(kernel.axis(slave)->set_parameter(*find_axis_parameter("cam_gear.delay_time"), 10'000));
  for (int i = 0; i < 50; ++i) {
    counts += 10.4;
    kernel.axis(master)->drive.counts = std::llround(counts);
    kernel.cycle();
  }
  EXPECT_NEAR(ahead() - before, 0.01 * 10.4 * 360 / cycle_s, 500);
  covers(
      {"MC_GearIn.Mode", "cam_gear.average_filter", "cam_gear.filter_cycles", "cam_gear.delay_time", "kind"});
}

}  // namespace
}  // namespace drycut::devices::plcopen
