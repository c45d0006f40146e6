#include "devices/axis/position.hpp"

#include <gtest/gtest.h>

namespace drycut::devices::axis {
namespace {

TEST(AxisQuota, TruncatesTowardZero) {
  // The two worked conversions of spec 1.2.
  Quota quota;
  quota.set_bits(62296, {220, 4096});
  EXPECT_EQ(quota.um({220, 4096}), 3345);
  quota.set_bits(-6939, {336, 4096});
  EXPECT_EQ(quota.um({336, 4096}), -569);
}

TEST(AxisQuota, KeepsTheRemainderOnDelCntAndDropsItOnAWrite) {
  const Resolution third{1, 3};
  Quota quota;
  quota.count(7, third);  // 2.33 Um
  quota.add_um(2, third);
  EXPECT_EQ(quota.um(third), 4);
  quota.count(2, third);  // 4.33 + 0.67
  EXPECT_EQ(quota.um(third), 5);
  quota.count(2, third);
  quota.set_um(4, third);
  quota.count(2, third);
  EXPECT_EQ(quota.um(third), 4);
  quota.count(1, third);
  EXPECT_EQ(quota.um(third), 5);
}

TEST(AxisQuota, EachCountMovesTheBitsByOne) {
  const Resolution resolution{7, 9};
  Quota quota;
  quota.set_um(-3, resolution);
  std::int64_t last = quota.bits(resolution);
  EXPECT_EQ(last, -4);  // -3.857
  for (int i = 0; i < 20; ++i) {
    quota.count(1, resolution);
    EXPECT_EQ(quota.bits(resolution), ++last);
  }
}

TEST(AxisQuota, ANewResolutionKeepsTheQuota) {
  Quota quota;
  quota.count(10, {1, 4});  // 2.5 Um
  Resolution resolution{1, 4};
  quota.rescale(resolution, {10, 3});
  EXPECT_EQ(quota.um(resolution), 2);
  EXPECT_EQ(quota.numerator(), 6);
}

TEST(AxisQuota, AwkwardRatiosDoNotDrift) {
  // 10^7 cycles of 1000 bits at 999983/999979 Um a bit.
  const Resolution resolution{999983, 999979};
  Quota quota;
  std::int64_t taken_off = 0;
  for (int i = 0; i < 10'000'000; ++i) {
    quota.count(1000, resolution);
    quota.add_um(-1000, resolution);
    taken_off += 1000;
  }
  // 10^10 bits are 10^10 * (1 + 4/999979) Um.
  const std::int64_t excess = 10'000'000'000LL * 4 / 999979;
  EXPECT_EQ(quota.um(resolution), 10'000'000'000LL - taken_off + excess);
}

TEST(AxisTransducer, LocksAndReverses) {
  Transducer transducer;
  transducer.rebase(1000);
  EXPECT_EQ(transducer.follow(1010, false, false), 10);
  EXPECT_EQ(transducer.follow(1015, false, true), -5);
  EXPECT_EQ(transducer.follow(1100, true, false), 0);
  EXPECT_EQ(transducer.follow(1103, false, false), 3);  // what passed while locked is lost
  EXPECT_EQ(transducer.total(), 8);
}

TEST(AxisTransducer, PlacesALatchedCount) {
  Transducer transducer;
  transducer.follow(100, false, true);
  EXPECT_EQ(transducer.total(), -100);
  EXPECT_EQ(transducer.total_at(90, false, true), -90);
  EXPECT_EQ(transducer.total_at(110, false, true), -110);
  EXPECT_EQ(transducer.total_at(90, true, true), -100);
}

TEST(AxisTheoretical, StaysExactFarFromZero) {
  Theoretical theoretical{4'000'000'000'000LL, 0};
  for (int i = 0; i < 1000; ++i) theoretical.add(0.1);
  EXPECT_NEAR(theoretical.minus(4'000'000'000'000LL), 100, 1e-9);
  for (int i = 0; i < 1000; ++i) theoretical.add(-0.1);
  EXPECT_NEAR(theoretical.minus(4'000'000'000'000LL), 0, 1e-9);
}

TEST(AxisSpeed, IsInWholeUnitsPerTimeUnit) {
  EXPECT_DOUBLE_EQ(um_per_second(1, 1) * 10, 100);  // 002 1.2.1.3: setvel 10, decpt 1 = 100 Um/s
  EXPECT_DOUBLE_EQ(um_per_second(0, 0) * 60, 1);
  EXPECT_DOUBLE_EQ(um_per_second(3, 0), 1000.0 / 60);
  EXPECT_DOUBLE_EQ(um_per_second(9, 1), 1000);
  EXPECT_DOUBLE_EQ(bits_per_um({3600, 4096}), 4096.0 / 3600);
}

TEST(AxisFrequencyMeter, MeasuresOverItsWindow) {
  FrequencyMeter meter;
  for (int ms = 2; ms < 240; ms += 2) EXPECT_FALSE(meter.sample(-8, 2, frequency_window_ms(0)));
  EXPECT_EQ(meter.bits_per_second(), 0);
  EXPECT_TRUE(meter.sample(-8, 2, frequency_window_ms(0)));
  EXPECT_DOUBLE_EQ(meter.bits_per_second(), 4000);  // 1000 Hz of one phase
  EXPECT_FALSE(meter.sample(0, 2, frequency_window_ms(2)));
}

TEST(AxisFrequencyMeter, TakesItsRateOverTheSamplesThatItReallyHad) {
  FrequencyMeter meter;  // 24 ms of 5 ms samples are 25 ms, each time
  for (int i = 1; i <= 50; ++i) {
    EXPECT_EQ(meter.sample(20, 5, 24), i % 5 == 0) << i;
    EXPECT_DOUBLE_EQ(meter.bits_per_second(), i < 5 ? 0 : 4000) << i;
  }
}

TEST(AxisFrequencyMeter, KnowsFourWindows) {
  EXPECT_EQ(frequency_window_ms(1), 480);
  EXPECT_EQ(frequency_window_ms(2), 24);
  EXPECT_EQ(frequency_window_ms(3), 120);
  EXPECT_EQ(frequency_window_ms(4), 240);
  EXPECT_EQ(frequency_window_ms(-1), 240);
}

}  // namespace
}  // namespace drycut::devices::axis
