// What a recording does not tell is not told: machines integrated by CVODE.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/sim/studies/fit/witness/asking.hpp"

namespace drycut::sim::studies {
namespace {

bool is_told(const FitFound& found, const std::string& code) {
  return std::ranges::find(found.codes, code) != found.codes.end();
}

FitFound fitted(const recordings::Recording& recording) {
  const auto question = asking(rigid);
  return fit(question, {series_of(recording, question)}, 2);
}

/// A recording from `begin` to `end` [s].
recordings::Recording part_of(recordings::Recording recording, double begin, double end) {
  for (auto& series : recording.series) {
    recordings::Series part = series;
    part.time_s.clear();
    part.value.clear();
    for (std::size_t i = 0; i < series.time_s.size(); ++i) {
      if (series.time_s[i] < begin || series.time_s[i] > end) continue;
      part.time_s.push_back(series.time_s[i]);
      part.value.push_back(series.value[i]);
    }
    series = part;
  }
  return recording;
}

// At one constant speed the noise of the counts is all that accelerates.
TEST(FitWitness, AConstantSpeedTellsNoMass) {
  const HiddenAxis axis(belt_axis(), {{0.2, 0, 3}, {5, 3, 3}});
  const auto found = fitted(part_of(axis.recorded({}, 1), 1, 5));
  EXPECT_EQ(value_of(found, "mass").known, FitKnown::no);
  EXPECT_FALSE(value_of(found, "mass").value);
  EXPECT_TRUE(is_told(found, "fit.not-known"));
  EXPECT_FALSE(found.passed);
}

// An axis that stops swings back a little: that is no motion the other way.
TEST(FitWitness, SwingingBackIsNoOtherDirection) {
  std::vector<Leg> legs;
  double until = 0;
  for (const double volts : {2.0, 5.0, 3.0, 4.0, 1.0})
    for (const auto& part : {Leg{0.15, 0, volts}, Leg{0.6, volts, volts}, Leg{0.05, volts, -0.15},
                             Leg{0.05, -0.15, 0}, Leg{0.2, 0, 0}}) {
      until += part.until;
      legs.push_back({until, part.from, part.to});
    }
  const auto recording = HiddenAxis(belt_axis(), legs).recorded({}, 1);
  const auto& counts = recording.series[1].value;
  ASSERT_LT(counts.back(), std::ranges::max(counts) - 10);
  const auto found = fitted(recording);
  EXPECT_EQ(value_of(found, "carriage_friction.coulomb").known, FitKnown::joined);
  EXPECT_EQ(found.torque_offset.known, FitKnown::joined);
  expect_known(found, "mass", 37, 0.01);
}

// Its friction varies in no fit: what the scenario lacks goes into the offset, and that is told.
TEST(FitWitness, AnOffsetOfOneDirectionMayBeFriction) {
  const auto question = asking({"mass", "carriage_friction.viscous"});
  const auto recording = HiddenAxis(belt_axis(), one_way()).recorded({}, 1);
  const auto found = fit(question, {series_of(recording, question)}, 2);
  ASSERT_TRUE(found.torque_offset.value);
  EXPECT_GT(*found.torque_offset.value, 0.5);  // 70 N of a lead of 100 mm are 1.1 N m
  EXPECT_TRUE(is_told(found, "fit.offset-or-direction"));
}

TEST(FitWitness, DISABLED_ASignThatIsAnotherIsTold) {
  auto recording = HiddenAxis(belt_axis(), both_ways()).recorded({}, 1);
  EXPECT_FALSE(is_told(fitted(recording), "fit.sign"));
  for (double& torque : recording.series[0].value) torque = -torque;
  const auto found = fitted(recording);
  EXPECT_EQ(found.codes.front(), "fit.sign");
  EXPECT_FALSE(found.passed);
}

TEST(FitWitness, CountsAndSpeedThatContradictEachOtherAreTold) {
  auto recording = HiddenAxis(belt_axis(), both_ways()).recorded({}, 1);
  recordings::Series speed{"axis.motor.speed", "rpm", recording.series[1].time_s, {}};
  const auto& counts = recording.series[1].value;
  for (std::size_t i = 0; i < counts.size(); ++i)
    speed.value.push_back((counts[i] - counts[i == 0 ? 0 : i - 1]) / 10000 / 1e-3 * 60);
  recording.series.push_back(speed);
  EXPECT_FALSE(is_told(fitted(recording), "fit.contradiction"));
  for (double& value : recording.series.back().value) value *= 2;
  EXPECT_TRUE(is_told(fitted(recording), "fit.contradiction"));
}

// Sanitizers run this one alone: a fit of little.
TEST(FitShort, GoesFromRecordingToValues) {
  const auto question = asking(rigid);
  const auto recording = part_of(HiddenAxis(belt_axis(), both_ways()).recorded({}, 1), 0, 2.5);
  const auto found = fit(question, {series_of(recording, question)}, 2);
  expect_known(found, "mass", 37, 0.05);
}

// A machine of the scenario's inertia and 17 kg more at a radius of 100 mm / turn, told as drives tell it.
TEST(FitWitness, TheInertiaAtTheMotorIsThatOfAllParts) {
  const auto data = belt_axis();
  const auto found = fitted(HiddenAxis(data, both_ways()).recorded({}, 1));
  const double radius = data.lead / (2 * std::numbers::pi);
  const double whole = data.drive.servo.rotor_inertia + data.screw_inertia + data.mass * radius * radius;
  EXPECT_NEAR(found.inertia_at_motor.value(), whole, 0.01 * whole);
}

}  // namespace
}  // namespace drycut::sim::studies
