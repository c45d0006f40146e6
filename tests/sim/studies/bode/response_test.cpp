#include "sim/studies/bode/response.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "sim/studies/bode/sweep.hpp"

namespace drycut::sim::studies {
namespace {

using std::numbers::pi;
using Complex = std::complex<double>;

/// Points of `open_loop`, a function of the angular frequency [rad/s], 200 a decade.
template <class Function>
std::vector<BodePoint> points_of(double from, double to, const Function& open_loop) {
  std::vector<BodePoint> points;
  const int count = static_cast<int>(std::ceil(200 * std::log10(to / from)));
  for (int i = 0; i <= count; ++i) {
    BodePoint point;
    point.frequency = from * std::pow(to / from, static_cast<double>(i) / count);
    point.open_loop = open_loop(2 * pi * point.frequency);
    points.push_back(point);
  }
  return points;
}

TEST(BodeCorrelator, FindsAmplitudeAndPhase) {
  Correlator correlator(7, 300);
  for (int k = 0; k < 300; ++k) correlator.add(5 + 0.25 * std::cos(2 * pi * 7 * k / 300 - 0.6));
  EXPECT_NEAR(std::abs(correlator.tone()), 0.25, 1e-12);
  EXPECT_NEAR(std::arg(correlator.tone()), -0.6, 1e-12);
  EXPECT_NEAR(correlator.error(), 0, 1e-6);
}

TEST(BodeCorrelator, IsBlindToWholeMultiples) {
  Correlator correlator(7, 300);
  for (int k = 0; k < 300; ++k)
    correlator.add(std::cos(2 * pi * 7 * k / 300) + 3 * std::sin(2 * pi * 21 * k / 300));
  EXPECT_NEAR(std::abs(correlator.tone() - 1.0), 0, 1e-12);
  // The rest has nine times the tone's power: sqrt(9 / 300).
  EXPECT_NEAR(correlator.error(), std::sqrt(9.0 / 300), 1e-9);
}

TEST(BodeCorrelator, TakesHalfTheSamplingFrequencyForReal) {
  Correlator correlator(50, 100);
  for (int k = 0; k < 100; ++k) correlator.add(k % 2 == 0 ? 2 : -2);
  EXPECT_NEAR(std::abs(correlator.tone() - 2.0), 0, 1e-12);
  EXPECT_NEAR(correlator.error(), 0, 1e-7);
}

TEST(BodeCorrelator, WithoutToneKnowsNothing) {
  Correlator correlator(3, 100);
  for (int k = 0; k < 100; ++k) correlator.add(0);
  EXPECT_TRUE(std::isinf(correlator.error()));
}

// y += share (u - y): a sampled first-order lag, share / (1 - (1 - share) / z) in closed form.
TEST(BodeCorrelator, MeasuresAFirstOrderLag) {
  constexpr double share = 0.05;
  constexpr int samples = 1000;
  for (const int cycles : {1, 13, 100, 400}) {
    Correlator in(cycles, samples);
    Correlator out(cycles, samples);
    double y = 0;
    for (int k = 0; k < 3 * samples; ++k) {
      const double u = cosine_at(cycles, samples, k);
      y += share * (u - y);
      if (k < 2 * samples) continue;
      in.add(u);
      out.add(y);
    }
    const Complex z = std::polar(1.0, 2 * pi * cycles / samples);
    const Complex exact = share / (1.0 - (1 - share) / z);
    EXPECT_NEAR(std::abs(out.tone() / in.tone() / exact - 1.0), 0, 1e-9) << cycles;
  }
}

TEST(BodeMargins, OfAnIntegratorWithDelay) {
  constexpr double gain = 40;
  constexpr double delay = 5e-3;
  const auto margins = margins_of(
      points_of(0.5, 100, [&](double w) { return gain / Complex(0, w) * std::polar(1.0, -w * delay); }));
  ASSERT_TRUE(margins.phase && margins.gain);
  EXPECT_NEAR(margins.phase->frequency, gain / (2 * pi), 1e-6);
  EXPECT_NEAR(margins.phase->value, 90 - gain * delay * 180 / pi, 0.01);
  EXPECT_NEAR(margins.gain->frequency, 1 / (4 * delay), 0.01);
  EXPECT_NEAR(margins.gain->value, 20 * std::log10(pi / 2 / delay / gain), 0.001);
  EXPECT_FALSE(margins.gain_down);
}

TEST(BodeMargins, OfAnIntegratorAloneAreOnlyItsPhase) {
  const auto margins = margins_of(points_of(0.1, 100, [](double w) { return 10.0 / Complex(0, w); }));
  ASSERT_TRUE(margins.phase && margins.closed_bandwidth);
  EXPECT_NEAR(margins.phase->value, 90, 1e-9);
  EXPECT_NEAR(*margins.closed_bandwidth, 10 / (2 * pi), 1e-3);
  EXPECT_FALSE(margins.gain);
  EXPECT_NEAR(margins.sensitivity->value, 1, 0.001);
}

// K (1 + s)^2 / s^3 passes -180 deg at 1 rad/s and is stable only from K = 1/2 on.
TEST(BodeMargins, KnowAGainThatMustNotFall) {
  const auto margins = margins_of(points_of(0.01, 10, [](double w) {
    const Complex s(0, w);
    return 2.0 * (1.0 + s) * (1.0 + s) / (s * s * s);
  }));
  ASSERT_TRUE(margins.gain_down);
  EXPECT_NEAR(margins.gain_down->frequency, 1 / (2 * pi), 1e-4);
  EXPECT_NEAR(margins.gain_down->value, -20 * std::log10(4.0), 0.01);
  EXPECT_FALSE(margins.gain);
}

TEST(BodeMargins, SpeedBandwidthOfAFirstOrderLag) {
  auto points = points_of(0.05, 1000, [](double w) { return 1.0 / Complex(0, w); });
  for (auto& point : points) point.speed = 200.0 / Complex(1, point.frequency / 30);
  const auto margins = margins_of(points);
  ASSERT_TRUE(margins.speed_bandwidth);
  EXPECT_NEAR(*margins.speed_bandwidth, 30, 0.01);
}

TEST(BodeMargins, NotMetAreAbsent) {
  const auto margins = margins_of(points_of(10, 20, [](double) { return Complex(0, -0.01); }));
  EXPECT_FALSE(margins.phase || margins.gain || margins.gain_down || margins.closed_bandwidth ||
               margins.speed_bandwidth);
}

TEST(BodePhases, AreContinuousAndBeginNearAnIntegrator) {
  std::vector<Complex> turning;
  for (int i = 0; i < 100; ++i) turning.push_back(std::polar(1.0, -pi - 0.1 * i));
  const auto angles = phases(turning);
  for (int i = 0; i < 100; ++i) EXPECT_NEAR(angles[i], -180 - 0.1 * i * 180 / pi, 1e-9);
}

TEST(BodeTones, AreWholePeriodsWithoutCommonFactor) {
  const Time sampling = 2 * millisecond;
  const auto tones = plan_tones(0.2, 250, 60, sampling, 2);
  ASSERT_GT(tones.size(), 50U);
  double last = 0;
  for (const auto& tone : tones) {
    EXPECT_GE(tone.cycles, 4);
    EXPECT_GE(tone.samples, 2 * tone.cycles);
    if (tone.samples > 2 * tone.cycles) {
      EXPECT_EQ(std::gcd(tone.cycles, tone.samples), 1);
    }
    EXPECT_GT(tone.frequency(sampling), last);
    last = tone.frequency(sampling);
  }
  EXPECT_NEAR(tones.front().frequency(sampling), 0.2, 0.002);
  EXPECT_DOUBLE_EQ(last, 250);
}

}  // namespace
}  // namespace drycut::sim::studies
