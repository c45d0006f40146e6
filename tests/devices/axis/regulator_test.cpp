#include "devices/axis/regulator.hpp"

#include <gtest/gtest.h>

namespace drycut::devices::axis {
namespace {

// Full speed 50000 bits/s, TCamp 2 ms: the unit of error is 100 bits.
constexpr RegulatorScale scale{50000, 0.002};

TEST(AxisRegulator, UnitGainGivesFullScaleAtTheWayOfOnePeriod) {
  Regulator regulator;
  EXPECT_DOUBLE_EQ(regulator.react({1000, 0, 0, 0}, scale, 0, 100).sum(), 32767);
  EXPECT_DOUBLE_EQ(regulator.react({1000, 0, 0, 0}, scale, 0, -50).sum(), -16383.5);
  EXPECT_DOUBLE_EQ(regulator.react({250, 0, 0, 0}, scale, 0, 100).proportional, 32767 / 4.0);
}

TEST(AxisRegulator, FullFeedForwardGivesFullScaleAtFullSpeed) {
  EXPECT_DOUBLE_EQ(Regulator::steer({0, 1000, 0, 0}, scale, 50000).sum(), 32767);
  EXPECT_DOUBLE_EQ(Regulator::steer({0, 980, 0, 0}, scale, -5000).sum(), -3276.7 * 0.98);
}

TEST(AxisRegulator, IntegralGrowsWithTimeAndIsLimited) {
  Regulator regulator;
  const Gains gains{0, 0, 20, 0};  // 2 ms of 20 ms: a tenth of the unit action each period
  for (int i = 1; i <= 9; ++i)
    EXPECT_NEAR(regulator.react(gains, scale, 0, 50).integral, i * 0.05 * 32767, 1e-9);
  for (int i = 0; i < 100; ++i) regulator.react(gains, scale, 0, 50);
  EXPECT_DOUBLE_EQ(regulator.react(gains, scale, 0, 0).integral, 32767);
  regulator.reset();
  EXPECT_DOUBLE_EQ(regulator.react(gains, scale, 0, 0).integral, 0);
  const RegulatorScale narrow{50000, 0.002, 1024};
  for (int i = 0; i < 100; ++i) regulator.react(gains, narrow, 0, -50);
  EXPECT_DOUBLE_EQ(regulator.react(gains, narrow, 0, 0).integral, -1024);
}

TEST(AxisRegulator, DerivativeActsOnTheChangeOnly) {
  Regulator regulator;
  const Gains gains{0, 0, 0, 4};  // two periods
  EXPECT_NEAR(regulator.react(gains, scale, 0, 10).derivative, 2 * 0.1 * 32767, 1e-9);
  EXPECT_DOUBLE_EQ(regulator.react(gains, scale, 0, 10).derivative, 0);
  regulator.reset(25);
  EXPECT_NEAR(regulator.react(gains, scale, 0, 24).derivative, -2 * 0.01 * 32767, 1e-9);
}

TEST(AxisRegulator, WithoutAFullSpeedThereIsNoAction) {
  Regulator regulator;
  EXPECT_EQ(regulator.react({1000, 1000, 10, 10}, {0, 0.002}, 100, 100).sum(), 0);
}

TEST(AxisDac, RoundsAndSaturates) {
  EXPECT_EQ(to_dac(3276.7).word, 3277);
  EXPECT_EQ(to_dac(-0.6).word, -1);
  EXPECT_EQ(to_dac(32767.4).word, 32767);
  EXPECT_EQ(to_dac(32767.4).saturated, 0);
  EXPECT_EQ(to_dac(32768).saturated, 1);
  EXPECT_EQ(to_dac(1e30).word, 32767);
  EXPECT_EQ(to_dac(-40000).word, -32767);
  EXPECT_EQ(to_dac(-40000).saturated, -1);
  EXPECT_EQ(to_dac(dac_bits_of_tenths(-100)).word, -32767);
  EXPECT_EQ(to_dac(dac_bits_of_tenths(10)).word, 3277);
}

TEST(AxisFollowingError, IsHeldForHalfASecond) {
  FollowingErrorHold hold;
  EXPECT_FALSE(hold.sample(false, 2));
  EXPECT_TRUE(hold.sample(true, 2));
  for (int ms = 2; ms < 500; ms += 2) EXPECT_TRUE(hold.sample(false, 2)) << ms;
  EXPECT_FALSE(hold.sample(false, 2));
}

}  // namespace
}  // namespace drycut::devices::axis
