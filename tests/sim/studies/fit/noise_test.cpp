#include "sim/studies/fit/noise.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "plants/random.hpp"
#include "sim/studies/fit/signal.hpp"

namespace drycut::sim::studies {
namespace {

constexpr double every = 1e-3;  // [s]

double place(double t) { return 40 * std::sin(5 * t) + 3 * t; }
double speed(double t) { return 200 * std::cos(5 * t) + 3; }

template <typename Of>
ReplaySeries moved_by(Of of) {
  ReplaySeries series;
  series.sampling = every;
  for (int i = 0; i < 3000; ++i) {
    const double t = i * every;
    series.motion.time_s.push_back(t);
    series.motion.value.push_back(of(t));
    series.torque.time_s.push_back(t);
    series.torque.value.push_back(i % 2 == 0 ? 3 : -3);
  }
  return series;
}

// Rounding to steps of 0.01 is an error of 0.01 over root 12, however fast it goes; the estimate by fourth
// differences takes it for noise of a bell's shape, and is a quarter larger.
TEST(FitNoise, OfCountsIsThatOfTheirRounding) {
  const double rounding = 0.01 / std::sqrt(12.0);
  const auto counts = moved_by([](double t) { return 0.01 * std::floor(place(t) / 0.01); });
  EXPECT_GE(motion_noise(counts), rounding * 0.999);
  EXPECT_LT(motion_noise(counts), rounding * 1.3);
  const auto always_fast = moved_by([](double t) { return 0.01 * std::floor(123.4 * t / 0.01); });
  EXPECT_GE(motion_noise(always_fast), rounding * 0.999);
  EXPECT_LT(motion_noise(always_fast), rounding * 2);
  EXPECT_LT(motion_noise(moved_by(place)), 1e-5);
  EXPECT_LT(motion_noise(moved_by([](double t) { return 123.4 * t; })), 1e-9);
}

TEST(FitNoise, IsThatOfWhiteNoiseOnPlacesAndOnSpeeds) {
  plants::Random random(1, "test");
  const auto noisy = moved_by([&](double t) { return place(t) + 0.05 * random.gaussian(); });
  EXPECT_NEAR(motion_noise(noisy), 0.05, 0.005);
  double sum = 0;
  auto summed = moved_by([&](double t) { return sum += (speed(t) + 2 * random.gaussian()) * every; });
  summed.summed = true;
  EXPECT_NEAR(motion_noise(summed), 2 * every, 0.2 * every);
}

// 2 % of 3 N m, of an inertia of 0.01 kg m2 whose motion is told in radians.
TEST(FitNoise, IsWorthLittleUpToWhereItsTorqueIs) {
  const Plausible about{0.01, 1, 0};
  const auto counts = moved_by([](double t) { return 0.01 * std::floor(place(t) / 0.01); });
  const double noise = motion_noise(counts);
  EXPECT_NEAR(resolved_up_to(counts, about, 0.02), std::sqrt(0.06 / (0.01 * noise)) / (2 * std::numbers::pi),
              1e-9);
  double sum = 0;
  auto summed = moved_by([&](double t) { return sum += std::round(speed(t)) * every; });
  summed.summed = true;
  const double of_speed = motion_noise(summed) / every;
  EXPECT_NEAR(resolved_up_to(summed, about, 0.02), 0.06 / (0.01 * of_speed) / (2 * std::numbers::pi), 1e-9);
  EXPECT_EQ(resolved_up_to(moved_by([](double) { return 1.0; }), about, 0.02),
            std::numeric_limits<double>::infinity());
}

TEST(FitNoise, IsAddedOnceMore) {
  const auto counts = moved_by([](double t) { return 0.01 * std::floor(place(t) / 0.01); });
  auto again = with_noise_again(counts, 1).motion.value;
  for (std::size_t i = 0; i < again.size(); ++i) again[i] -= counts.motion.value[i];
  EXPECT_NEAR(rms_of(again), motion_noise(counts), 0.05 * motion_noise(counts));
  EXPECT_NE(with_noise_again(counts, 2).motion.value, with_noise_again(counts, 1).motion.value);
  EXPECT_EQ(with_noise_again(counts, 1).motion.value, with_noise_again(counts, 1).motion.value);
}

}  // namespace
}  // namespace drycut::sim::studies
