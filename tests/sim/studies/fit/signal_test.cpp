#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "plants/random.hpp"
#include "sim/studies/fit/signal.hpp"

namespace drycut::sim::studies {
namespace {

recordings::Series sampled(double every, double until, const std::function<double(double)>& of) {
  recordings::Series series{"axis.motor.torque", "N m"};
  for (int i = 0; i * every <= until; ++i) {
    series.time_s.push_back(i * every);
    series.value.push_back(of(i * every));
  }
  return series;
}

TEST(FitSignal, ResamplingGoesThroughTheSamplesAndKeepsAParabola) {
  const auto parabola = [](double t) { return 3 * t * t - 2 * t + 1; };
  auto series = sampled(0.01, 1, parabola);
  // Uneven times: every third sample is missing.
  for (std::size_t i = 3; i + 1 < series.time_s.size(); i += 2) {
    series.time_s.erase(series.time_s.begin() + static_cast<std::ptrdiff_t>(i));
    series.value.erase(series.value.begin() + static_cast<std::ptrdiff_t>(i));
  }
  const auto fine = resampled(series, 0.05, 1e-3, 900);
  for (std::size_t k = 0; k < fine.size(); ++k)
    EXPECT_NEAR(fine[k], parabola(0.05 + static_cast<double>(k) * 1e-3), 1e-12);
  EXPECT_EQ(resampled(series, -1, 0.1, 1).front(), series.value.front());
  EXPECT_EQ(resampled(series, 2, 0.1, 1).front(), series.value.back());
}

TEST(FitSignal, StraightLinesJumpAndGoNoFurtherThanTheSamples) {
  recordings::Series steps{"axis.force", "N", {0, 0.999, 1, 2}, {0, 0, 100, 100}};
  const auto fine = straight(steps, -0.5, 0.25, 12);
  EXPECT_EQ(fine, (std::vector<double>{0, 0, 0, 0, 0, 0, 100, 100, 100, 100, 100, 100}));
  EXPECT_NEAR(straight(steps, 0.9995, 1, 1).front(), 50, 1e-9);
  const recordings::Series one{"axis.force", "N", {1}, {7}};
  EXPECT_EQ(straight(one, 0, 1, 3), (std::vector<double>{7, 7, 7}));
}

TEST(FitSignal, TheFilterHasHalfThePowerAtItsCutoffAndNoPhase) {
  constexpr double step = 1e-3;
  constexpr double cutoff = 20;
  std::vector<double> wave;
  wave.reserve(2000);
  for (int i = 0; i < 2000; ++i) wave.push_back(std::sin(2 * std::numbers::pi * cutoff * i * step));
  const auto smooth = smoothed(wave, step, cutoff);
  double largest = 0;
  for (std::size_t i = 500; i < 1500; ++i) {
    largest = std::max(largest, std::abs(smooth[i]));
    EXPECT_NEAR(smooth[i], std::sqrt(0.5) * wave[i], 0.01);
  }
  EXPECT_NEAR(largest, std::sqrt(0.5), 0.005);
  const std::vector<double> even(300, 4.0);
  for (const double value : smoothed(even, step, cutoff)) EXPECT_NEAR(value, 4, 1e-12);
}

TEST(FitSignal, BandwidthIsThatOfTheSignalAndNotOfTheNoise) {
  plants::Random random(7, "noise");
  const auto with_noise = [&](double frequency) {
    return sampled(1e-3, 4, [&, frequency](double t) {
      return 10 * std::sin(2 * std::numbers::pi * frequency * t) + 0.1 * random.gaussian();
    });
  };
  const double slow = bandwidth_of(with_noise(2));
  const double fast = bandwidth_of(with_noise(20));
  EXPECT_GT(slow, 2);
  EXPECT_LT(slow, 20);
  EXPECT_GT(fast, 40);
  EXPECT_LE(fast, 150);
  EXPECT_NEAR(sampling_of(with_noise(2)), 1e-3, 1e-12);
}

}  // namespace
}  // namespace drycut::sim::studies
