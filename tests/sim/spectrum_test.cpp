// What comes back in the lengths of pieces: closed forms of an eccentric wheel, folding, and what chance
// makes.
#include "sim/report/spectrum.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plants/random.hpp"

namespace drycut::sim::report {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double pi = std::numbers::pi;

/// Pieces [m], cut where a wheel of that circumference [m] whose axis lies `e` [m] beside has counted
/// `length`.
class Line {
 public:
  Line(double circumference, double e) : circumference_(circumference), e_(e) {}
  void cut(double length, int pieces) {
    for (int i = 0; i < pieces; ++i) {
      const double from = place(counted_);
      counted_ += length;
      lengths.push_back(place(counted_) - from);
      numbers.push_back(lengths.back() * 1e3);
    }
  }
  std::vector<double> lengths;  ///< [m]
  std::vector<double> numbers;  ///< [mm]

 private:
  [[nodiscard]] double place(double counted) const {
    return counted + e_ * std::sin(2 * pi * counted / circumference_);
  }
  double circumference_;
  double e_;
  double counted_ = 0;
};

TEST(Spectrum, AnEccentricWheelHasTheAmplitudeOfItsClosedForm) {
  for (const double length : {0.8, 0.33, 1.7}) {
    Line line(0.5, 0.5e-3);
    line.cut(length, 60);
    const auto sine = fitted(sampled(line.numbers, line.lengths), 1 / 0.5);
    const double amplitude = 2 * 0.5 * std::abs(std::sin(pi * length / 0.5));
    EXPECT_NEAR(sine.amplitude, amplitude, 5e-3 * amplitude) << length;
    EXPECT_GT(sine.explains, 0.999);
  }
}

TEST(Spectrum, PiecesOfOneLengthFoldItAndTheKnownWheelIsNamed) {
  Line line(0.5, 0.5e-3);
  line.cut(0.8, 50);
  const auto found = spectrum_of(sampled(line.numbers, line.lengths), 2.4, {1 / 0.3, 1 / 0.5, 1 / 0.71});
  ASSERT_EQ(found.peaks.size(), 1U);
  const auto& peak = found.peaks[0];
  EXPECT_THAT(peak.known, ElementsAre(1));
  EXPECT_DOUBLE_EQ(peak.sine.frequency, 2) << "of those that fit as well the one that is there";
  EXPECT_NEAR(peak.sine.amplitude, 0.951, 0.005);
  // Every 1.6 turns: n / 0.8 m +- 2 / m.
  std::vector<double> folded = peak.others;
  std::erase_if(folded, [](double f) { return std::abs(f - 2) < 0.02; });
  ASSERT_EQ(folded.size(), 3U);
  EXPECT_NEAR(folded[0], 0.5, 0.01);
  EXPECT_NEAR(folded[1], 0.75, 0.01);
  EXPECT_NEAR(folded[2], 1.75, 0.01);
}

TEST(Spectrum, AnotherLengthTellsThemApart) {
  Line line(0.5, 0.5e-3);
  line.cut(0.8, 30);
  line.cut(0.63, 30);
  const auto values = sampled(line.numbers, line.lengths);
  EXPECT_EQ(values.order_count, 2U);
  const auto found = spectrum_of(values, 2.4, {});
  ASSERT_FALSE(found.peaks.empty());
  EXPECT_NEAR(found.peaks[0].sine.frequency, 2, 0.005) << "nobody told it of a wheel";
  EXPECT_THAT(found.peaks[0].others, IsEmpty());
}

TEST(Spectrum, TwoThatFoldTogetherAreBothNamed) {
  Line line(0.5, 0.5e-3);
  line.cut(0.8, 50);
  const auto found = spectrum_of(sampled(line.numbers, line.lengths), 2.4, {2, 0.75, 1.1});
  ASSERT_EQ(found.peaks.size(), 1U);
  EXPECT_THAT(found.peaks[0].known, ElementsAre(0, 1));
}

TEST(Spectrum, WhatComesWholeTimesAPieceCannotBeSeen) {
  Line line(0.5, 0.5e-3);
  line.cut(1, 40);  // two turns
  const auto values = sampled(line.numbers, line.lengths);
  EXPECT_EQ(fitted(values, 2).explains, 0);
  EXPECT_THAT(spectrum_of(values, 2.4, {2}).peaks, IsEmpty());
}

TEST(Spectrum, ChanceIsNoFinding) {
  plants::Random random(7);
  int found = 0;
  for (int series = 0; series < 40; ++series) {
    std::vector<double> numbers;
    for (int i = 0; i < 80; ++i) numbers.push_back(800 + 0.02 * (random.uniform() - 0.5));
    std::vector<double> lengths(numbers.size(), 0.8);
    found += spectrum_of(sampled(numbers, lengths), 2.4, {2}).peaks.empty() ? 0 : 1;
  }
  EXPECT_LE(found, 1);
}

TEST(Spectrum, TwoSinesInNoiseComeStrongestFirst) {
  plants::Random random(3);
  std::vector<double> numbers;
  std::vector<double> lengths;
  double place = 0;
  for (int i = 0; i < 200; ++i) {
    const double length = 0.7 + 0.01 * random.uniform();  // one order: within a fiftieth
    const double at = place + length / 2;
    numbers.push_back(5 + 0.3 * std::sin(2 * pi * at / 0.31) + 0.1 * std::cos(2 * pi * at / 2.2) +
                      0.1 * (random.uniform() - 0.5));
    lengths.push_back(length);
    place += length;
  }
  const auto found = spectrum_of(sampled(numbers, lengths), 4, {});
  ASSERT_EQ(found.peaks.size(), 2U);
  EXPECT_NEAR(found.peaks[0].sine.amplitude, 0.3, 0.02);
  EXPECT_NEAR(found.peaks[1].sine.amplitude, 0.1, 0.02);
  const auto has = [](const SpectrumPeak& peak, double frequency) {
    if (std::abs(peak.sine.frequency - frequency) < 0.01) return true;
    return std::any_of(peak.others.begin(), peak.others.end(),
                       [&](double other) { return std::abs(other - frequency) < 0.01; });
  };
  EXPECT_TRUE(has(found.peaks[0], 1 / 0.31));
  EXPECT_TRUE(has(found.peaks[1], 1 / 2.2));
}

TEST(Spectrum, WithoutLengthsItGoesByTheEvents) {
  std::vector<double> numbers;
  for (int i = 0; i < 60; ++i) numbers.push_back(10 + std::sin(2 * pi * i / 4.0));
  const auto found = spectrum_of(sampled(numbers, {}), 0.49, {});
  ASSERT_EQ(found.peaks.size(), 1U);
  EXPECT_NEAR(found.peaks[0].sine.frequency, 0.25, 1e-3);
  EXPECT_NEAR(found.peaks[0].sine.amplitude, 1, 1e-3);
}

TEST(Spectrum, TooFewAreLeftAloneAndOfVeryManyTheLastCount) {
  Line few(0.5, 1e-3);
  few.cut(0.8, 9);
  EXPECT_THAT(spectrum_of(sampled(few.numbers, few.lengths), 2.4, {2}).frequencies, IsEmpty());
  EXPECT_EQ(fitted(sampled(few.numbers, few.lengths), 2).amplitude, 0);
  Line many(0.5, 1e-3);
  many.cut(0.8, 700);
  many.cut(0.6, 4);  // too short an order
  many.cut(0.7, 100);
  const auto values = sampled(many.numbers, many.lengths);
  EXPECT_EQ(values.places.size(), 496U);
  EXPECT_EQ(values.order_count, 2U);
}

}  // namespace
}  // namespace drycut::sim::report
