// What a servo drive and its motor have beside loops and limits: filters of the torque, torque given ahead,
// cogging and ripple, currents of a sheet. Against closed forms.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "plants/servo_drive.hpp"
#include "tests/plants/plants_lookup.hpp"

namespace drycut::plants {
namespace {

using testing::HasSubstr;

constexpr TorqueFilterData one_notch = {.notches = {{{.frequency = 300, .depth = 0.1, .width = 0.5}}}};

// In steps the notch is the analogue one at warped frequencies: tan(pi f h) over tan(pi f0 h) is its s.
TEST(TorqueFilters, HaveTheNotchOfTheFormula) {
  for (const double f : {1.0, 100.0, 250.0, 300.0, 340.0, 700.0, 2000.0}) {
    const double x = std::tan(pi * f * h) / std::tan(pi * 300 * h);
    const std::complex<double> s(0, x);
    const auto expected = (s * s + 0.05 * s + 1.0) / (s * s + 0.5 * s + 1.0);
    EXPECT_LT(std::abs(response(one_notch, f, h) - expected), 1e-9) << f;
  }
  EXPECT_NEAR(std::abs(response(one_notch, 300, h)), 0.1, 1e-12);
}

TEST(TorqueFilters, LowPassHasHalfThePowerAtItsCorner) {
  const TorqueFilterData slow = {.low_pass = 5e-3, .notches = {}};
  EXPECT_NEAR(std::abs(response(slow, 1 / (turn * 5e-3), h)), std::sqrt(0.5), 1e-3);
  EXPECT_NEAR(std::abs(response(slow, 0, h)), 1, 1e-12);
}

// What passes is what the response says.
TEST(TorqueFilters, PassASineAsTheirResponseSays) {
  TorqueFilterData data = one_notch;
  data.low_pass = 0.4e-3;
  data.notches[1] = {.frequency = 900, .depth = 0, .width = 1};
  for (const double f : {50.0, 280.0, 900.0, 1500.0}) {
    TorqueFilters filters(data);
    std::complex<double> sum = 0;
    const int settle = 20'000;
    const int count = 10'000;  // whole periods
    for (int i = 0; i < settle + count; ++i) {
      const double out = filters.pass(std::cos(turn * f * h * i), h);
      if (i >= settle) sum += 2.0 / count * out * std::polar(1.0, -turn * f * h * i);
    }
    EXPECT_LT(std::abs(sum - response(data, f, h)), 1e-9) << f;
  }
}

TEST(TorqueFilters, ANotchThatStepsCannotMakeIsRefused) {
  ServoData data;
  data.filters.notches[1].frequency = 2600;
  const auto found = servo_objections(data, data.rotor_inertia, h);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].parameter, "servo.notch2.frequency");
  EXPECT_THAT(found[0].remedy, HasSubstr("at most 2500 Hz"));
  data.filters.notches[1].frequency = 2500;
  EXPECT_TRUE(servo_objections(data, data.rotor_inertia, h).empty());
}

/// A servo on a load that is rigidly its rotor, without noise of its converter.
struct FreeAxis {
  ServoData data;
  World world;
  Shaft& rotor;
  ServoDrive servo;
  explicit FreeAxis(ServoData d)
      : data(d),
        rotor(world.add_shaft({.name = "rotor", .inertia = d.rotor_inertia * (1 + d.inertia_ratio)})),
        servo(d, world.random("servo")) {}
  void step(double volts) {
    servo.reference.volts = volts;
    servo.drive(rotor, h);
    world.step(h);
  }
};

ServoData fine() {
  ServoData data;
  data.adc_bits = 24;
  return data;
}

// A ramp of the reference: all of its torque is given ahead, and the speed lags by the filter's time alone.
TEST(ServoDrive, TorqueGivenAheadLeavesNothingToTheLoop) {
  for (const double ahead : {0.0, 1.0}) {
    ServoData data = fine();
    data.torque_forward = ahead;
    FreeAxis axis(data);
    const double slope = 10;  // [V/s]
    for (int i = 0; i < 4000; ++i) axis.step(slope * i * h);
    const double acceleration = slope / 10 * data.speed_at_10v;
    EXPECT_NEAR(axis.servo.torque(), acceleration * axis.rotor.inertia, 1e-3 * axis.servo.torque());
    const double behind = axis.servo.speed_reference() - axis.rotor.speed;
    // An integral that must make a torque T grows by Kp / Ti of the error: at its end the error is 0 in both
    // cases, on the way it is not. 60 ms into the ramp:
    EXPECT_NEAR(behind, -acceleration * h, 1e-3 * acceleration * h);  // it is that of the step before
    FreeAxis young(data);
    double most = 0;
    for (int i = 0; i < 600; ++i) {
      young.step(slope * i * h);
      most = std::max(most, young.servo.speed_reference() - young.rotor.speed);
    }
    const double alone = acceleration / data.speed_gain;  // of a proportional loop
    if (ahead > 0)
      EXPECT_LT(most, 0.6 * alone);
    else
      EXPECT_GT(most, 0.6 * alone);
  }
}

/// Half of what the speed of a motor that coasts swings by in a turn of 0.1 s.
double swing(const ServoData& data) {
  FreeAxis axis(data);
  axis.servo.enable.level = false;
  axis.rotor.speed = turn / 0.1;
  double low = axis.rotor.speed;
  double high = low;
  for (int i = 0; i < 1'000; ++i) {
    axis.step(0);
    low = std::min(low, axis.rotor.speed);
    high = std::max(high, axis.rotor.speed);
  }
  return (high - low) / 2;
}

// T / (J N w), without current too.
TEST(ServoDrive, CoggingMakesTheSpeedSwing) {
  ServoData data = fine();
  data.cogging = 0.05;
  data.cogging_periods = 20;
  const double expected = 0.05 / (data.rotor_inertia * (1 + data.inertia_ratio) * 20 * turn / 0.1);
  EXPECT_NEAR(swing(data), expected, 0.01 * expected);
}

TEST(ServoDrive, RippleGoesWithTheTorque) {
  ServoData data = fine();
  data.torque_ripple = 0.02;
  data.torque_ripple_periods = 24;
  EXPECT_LT(swing(data), 1e-12);
  // Held still, and turned by hand.
  FreeAxis held(data);
  double low = 1e9;
  double high = -1e9;
  for (int i = 0; i < 20'000; ++i) {
    held.servo.reference.volts = 10;
    held.rotor.speed = 0;
    held.servo.drive(held.rotor, h);
    const double over = held.rotor.torque / held.servo.torque();
    if (held.servo.torque() > 1) {
      low = std::min(low, over);
      high = std::max(high, over);
    }
    held.rotor.torque = 0;
    held.rotor.part = std::fmod(i * 1e-3, 1.0);
  }
  EXPECT_NEAR(low, 0.98, 1e-3);
  EXPECT_NEAR(high, 1.02, 1e-3);
}

// A sheet's currents: 5 A at 10 N m, 7 A at 12 N m, 24 A at 30 N m.
ServoData with_currents() {
  ServoData data;
  data.rated_torque = 10;
  data.stall_torque = 12;
  data.peak_torque = 30;
  data.rated_current = 5;
  data.stall_current = 7;
  data.peak_current = 24;
  data.winding_resistance = 2;
  return data;
}

TEST(MotorCurrent, GoesThroughThePointsOfTheSheet) {
  const auto current = motor_current(with_currents());
  for (const auto& [torque, amperes] :
       {std::pair(5.0, 2.5), {10.0, 5.0}, {11.0, 6.0}, {12.0, 7.0}, {21.0, 15.5}, {30.0, 24.0}}) {
    EXPECT_NEAR(current.amperes(-torque), amperes, 1e-12);
    EXPECT_NEAR(current.torque_of(amperes), torque, 1e-12);
  }
}

// Copper loss at peak by 1.5 R I^2 of the sheet's peak current, and not by the torque constant.
TEST(MotorCurrent, HeatsBySheetCurrentsAtPeakTorque) {
  const ServoData data = with_currents();
  const ServoData known = electrical(data);
  PowerStage stage(motor_current(data), data.heat, ratings(data), known.amplifier, data.supply);
  Shaft rotor;
  for (int i = 0; i < 100; ++i) stage.account({30, 0, 0, true}, rotor, h);
  const double hot = stage.heat().resistance();
  EXPECT_NEAR(stage.loss() / (1.5 * 2 * 24 * 24 * hot), 1, 0.01);
  EXPECT_NEAR(stage.totals().current_squared / stage.totals().time, 24 * 24, 1e-6);
  EXPECT_NEAR(stage.peaks().torque, 30, 0);
  // For ever at standstill it is as warm as its sheet says.
  EXPECT_NEAR(stage.steady_temperature(7 * 7, 0), MotorHeat::ambient + data.heat.temperature_rise, 1e-6);
}

TEST(MotorCurrent, MissingOnesAreOnTheSafeSide) {
  ServoData data = with_currents();
  data.stall_current = data.peak_current = 0;
  const auto known = electrical(data);
  EXPECT_NEAR(known.stall_current, 6, 1e-12);
  EXPECT_NEAR(known.peak_current, 1.25 * 15, 1e-12);
  EXPECT_NEAR(known.amplifier.peak_current, known.peak_current, 1e-12);
  // Without any of them the torque constant is all there is, as it was.
  const ServoData plain;
  EXPECT_FALSE(motor_current(plain).bends());
  EXPECT_NEAR(electrical(plain).peak_current, plain.peak_torque / plain.torque_constant, 1e-12);
}

TEST(MotorCurrent, ThoseThatContradictAreTold) {
  ServoData data = with_currents();
  data.stall_current = 4;
  auto found = servo_objections(data, data.rotor_inertia * 5, h);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].parameter, "servo.stall_current");
  data = with_currents();
  data.peak_current = 14;
  found = servo_objections(data, data.rotor_inertia * 5, h);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].parameter, "servo.peak_current");
}

}  // namespace
}  // namespace drycut::plants
