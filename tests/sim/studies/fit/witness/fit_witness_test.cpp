#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "tests/sim/studies/fit/witness/asking.hpp"

// The tests that are DISABLED_ here run with make test-all: together they take minutes.
namespace drycut::sim::studies {
namespace {

TEST(FitWitness, FindsMassFrictionOffsetAndDelay) {
  const HiddenAxis axis(belt_axis(), both_ways());
  for (const double every : {1e-3, 4e-3}) {
    for (const int late : {0, 1}) {
      SCOPED_TRACE(fmt::format("every {} s, {} samples late", every, late));
      const auto question = asking(rigid);
      const Recorder recorder{.every = every, .late = late};
      const auto found = fit(question, {series_of(axis.recorded(recorder, 1), question)}, 2);
      expect_known(found, "mass", 37, 0.01);
      expect_known(found, "carriage_friction.coulomb", 120, 0.03);
      expect_known(found, "carriage_friction.viscous", 80, 0.02);
      EXPECT_NEAR(found.torque_offset.value.value(), recorder.offset, 0.01);
      EXPECT_NEAR(found.delays.at("axis.motor.torque"), late * every, 0.1 * every);
      EXPECT_TRUE(found.passed);
    }
  }
}

TEST(FitWitness, OneWayGivesFrictionAndOffsetTogetherOnly) {
  const HiddenAxis axis(belt_axis(), one_way());
  const auto question = asking(rigid);
  const auto found = fit(question, {series_of(axis.recorded({}, 1), question)}, 2);
  const auto& coulomb = value_of(found, "carriage_friction.coulomb");
  EXPECT_EQ(coulomb.known, FitKnown::joined);
  EXPECT_FALSE(coulomb.value || coulomb.low || coulomb.high);
  EXPECT_EQ(found.torque_offset.known, FitKnown::joined);
  EXPECT_FALSE(found.torque_offset.value);
  EXPECT_NE(std::ranges::find(found.codes, "fit.joined"), found.codes.end());
  EXPECT_FALSE(found.passed);
  expect_known(found, "mass", 37, 0.01);
  expect_known(found, "carriage_friction.viscous", 80, 0.02);
}

TEST(FitWitness, DISABLED_WithoutAccelerationNoMass) {
  // Very gentle ramps between constant speeds.
  std::vector<Leg> legs;
  double until = 0;
  double now = 0;
  for (const double volts : {3.0, -3.0, 1.0, -1.0}) {
    until += 3;
    legs.push_back({until, now, volts});
    until += 0.5;
    legs.push_back({until, volts, volts});
    now = volts;
  }
  const HiddenAxis axis(belt_axis(), legs);
  const auto question = asking(rigid);
  const auto found = fit(question, {series_of(axis.recorded({.noise = 0.4}, 1), question)}, 2);
  const auto& mass = value_of(found, "mass");
  // Either nothing is said, or limits that are as wide as what is not known.
  if (mass.value) {
    EXPECT_LE(*mass.low, 37);
    EXPECT_GE(*mass.high, 37);
  }
}

TEST(FitWitness, DISABLED_FindsStiffnessDampingAndPlay) {
  auto data = belt_axis();
  data.gear.stiffness = 3000;
  data.gear.damping = 2;
  data.gear.backlash = 0.004;
  auto question = asking(
      {"mass", "carriage_friction.coulomb", "carriage_friction.viscous", "gear.stiffness", "gear.backlash"});
  question.set = {{"scene.step", "100 us"},
                  {"plants.axis.gear.backlash", "0.05 deg"},
                  {"plants.axis.gear.damping", "2 N m s/rad"}};
  for (const bool scale : {true, false}) {
    SCOPED_TRACE(scale ? "with a scale on the carriage" : "from the motor's side alone");
    const HiddenAxis axis(data, scale ? both_ways() : shaken());
    const auto found = fit(question, {series_of(axis.recorded({.scale = scale}, 1), question)}, 2);
    expect_known(found, "mass", 37, 0.01);
    expect_known(found, "gear.stiffness", 3000, scale ? 0.02 : 0.03);
    expect_known(found, "gear.backlash", 0.004 * 180 / std::numbers::pi, 0.03);
    // Where it is less sure, it says so.
    EXPECT_LE(*value_of(found, "gear.stiffness").low, 3000);
    EXPECT_GE(*value_of(found, "gear.stiffness").high, 3000);
  }
}

TEST(FitWitness, DISABLED_FrictionByDirectionWhereItIsAskedFor) {
  auto data = belt_axis();
  data.guide_friction.backward = 1.4;
  const HiddenAxis axis(data, both_ways());
  const auto recording = axis.recorded({.offset = 0}, 1);
  auto paths = rigid;
  auto question = asking(paths);
  const auto plain = fit(question, {series_of(recording, question)}, 2);
  // Symmetric friction and an offset say the same, and it is told that they do.
  expect_known(plain, "carriage_friction.coulomb", 144, 0.03);
  EXPECT_NE(std::ranges::find(plain.codes, "fit.offset-or-direction"), plain.codes.end());
  paths.push_back("carriage_friction.backward");
  question = asking(paths);
  const auto found = fit(question, {series_of(recording, question)}, 2);
  expect_known(found, "carriage_friction.coulomb", 120, 0.03);
  expect_known(found, "carriage_friction.backward", 140, 0.03);
}

TEST(FitWitness, DISABLED_ViscousFrictionByDirectionAndTheLadderThatAsksForIt) {
  auto data = belt_axis();
  data.guide_friction.viscous_backward = 1.5;
  const HiddenAxis axis(data, both_ways());
  const auto recording = axis.recorded({}, 1);
  auto question = asking(rigid);
  const auto plain = fit(question, {series_of(recording, question)}, 2);
  EXPECT_TRUE(std::ranges::any_of(plain.ladder, [](const FitRung& rung) {
    return rung.is_worth_it() && rung.paths.front().ends_with(".viscous_backward");
  }));
  auto paths = rigid;
  paths.emplace_back("carriage_friction.viscous_backward");
  question = asking(paths);
  const auto found = fit(question, {series_of(recording, question)}, 2);
  expect_known(found, "mass", 37, 0.01);
  expect_known(found, "carriage_friction.coulomb", 120, 0.03);
  expect_known(found, "carriage_friction.viscous", 80, 0.02);
  expect_known(found, "carriage_friction.viscous_backward", 150, 0.02);
}

// A recorded force that acted counts; one that is in the torque already, or acted nowhere, does not.
TEST(FitWitness, DISABLED_ARecordedForceCountsByWhatOfItActs) {
  auto legs = both_ways();
  recordings::Series force{"axis.force", "N"};
  for (std::size_t i = 0; i < legs.size(); ++i) legs[i].force = i % 4 == 1 ? -150 : 0;
  double from = 0;
  for (const auto& leg : legs) {
    for (const double at : {from, leg.until - 1e-6}) {
      force.time_s.push_back(at);
      force.value.push_back(leg.force);
    }
    from = leg.until;
  }
  const auto question = asking(rigid);
  for (const bool acts : {true, false}) {
    SCOPED_TRACE(acts ? "it acted" : "it did not");
    auto recording = HiddenAxis(belt_axis(), acts ? legs : both_ways()).recorded({}, 1);
    recording.series.push_back(force);
    const auto found = fit(question, {series_of(recording, question)}, 2);
    expect_known(found, "mass", 37, 0.01);
    expect_known(found, "carriage_friction.coulomb", 120, 0.03);
    expect_known(found, "carriage_friction.viscous", 80, 0.02);
    ASSERT_EQ(found.inputs.size(), 1U);
    EXPECT_NEAR(found.inputs[0].value.value(), acts ? 1 : 0, 0.02);
    EXPECT_EQ(std::ranges::find(found.codes, "fit.disturbance") != found.codes.end(), !acts);
  }
}

TEST(FitWitness, DISABLED_TheLadderSaysWhatStictionWouldExplain) {
  auto data = belt_axis();
  data.guide_friction.breakaway = 100;
  data.guide_friction.stribeck_speed = 0.1;
  const HiddenAxis axis(data, both_ways());
  auto question = asking(rigid);
  const auto plain = fit(question, {series_of(axis.recorded({}, 1), question)}, 2);
  EXPECT_NE(std::ranges::find(plain.codes, "fit.ladder"), plain.codes.end());
  const HiddenAxis alike(belt_axis(), both_ways());
  const auto none = fit(question, {series_of(alike.recorded({}, 1), question)}, 2);
  EXPECT_TRUE(std::ranges::none_of(none.ladder, &FitRung::is_worth_it));
  auto paths = rigid;
  paths.insert(paths.end(), {"carriage_friction.breakaway", "carriage_friction.stribeck_speed"});
  question = asking(paths);
  question.set = {{"plants.axis.carriage_friction.breakaway", "30 N"},
                  {"plants.axis.carriage_friction.stribeck_speed", "50 mm/s"}};
  const auto found = fit(question, {series_of(axis.recorded({}, 1), question)}, 2);
  expect_known(found, "carriage_friction.coulomb", 120, 0.05);
  expect_known(found, "carriage_friction.breakaway", 100, 0.1);
  expect_known(found, "carriage_friction.stribeck_speed", 100, 0.1);
}

TEST(FitWitness, DISABLED_LimitsOfTwoRecordingsHoldBoth) {
  const HiddenAxis cold(belt_axis(), both_ways());
  auto data = belt_axis();
  data.guide_friction.coulomb = 100;
  const HiddenAxis warm(data, both_ways());
  const auto question = asking(rigid);
  const auto found = fit(
      question, {series_of(cold.recorded({}, 1), question), series_of(warm.recorded({}, 2), question)}, 2);
  const auto& coulomb = value_of(found, "carriage_friction.coulomb");
  ASSERT_TRUE(coulomb.value);
  EXPECT_LE(*coulomb.low, 100.5);
  EXPECT_GE(*coulomb.high, 119.5);
  EXPECT_NE(std::ranges::find(found.codes, "fit.differs"), found.codes.end());
}

TEST(FitWitness, ACrossTestTellsAnotherMachine) {
  const HiddenAxis axis(belt_axis(), both_ways());
  auto other = belt_axis();
  other.mass = 60;
  const HiddenAxis loaded(other, both_ways());
  const auto question = asking(rigid);
  auto found = fit(question, {series_of(axis.recorded({}, 1), question)}, 2);
  cross_test(question, {series_of(axis.recorded({}, 2), question)}, 3, 2, found);
  EXPECT_LT(found.cross_error.value(), 0.02);
  EXPECT_TRUE(found.passed);
  cross_test(question, {series_of(loaded.recorded({}, 3), question)}, 3, 2, found);
  EXPECT_GT(found.cross_error.value(), 0.05);
  EXPECT_FALSE(found.passed);
  EXPECT_NE(std::ranges::find(found.codes, "fit.cross-test"), found.codes.end());
}

// What the pages of the manual learn from is this axis, as it is recorded here.
TEST(FitWitness, WhatIsShippedIsTheBeltAxis) {
  for (const auto& [name, text] : shipped_recordings()) {
    std::ifstream file(std::string(DRYCUT_SOURCE_DIR "/scenes/recordings/") + name);
    std::stringstream there;
    there << file.rdbuf();
    EXPECT_EQ(there.str(), text) << name;
  }
}

/// In how many of `seeds` recordings the limits hold the truth, a value each.
std::map<std::string, int> held(int seeds) {
  const HiddenAxis axis(belt_axis(), both_ways());
  const auto question = asking(rigid);
  const std::map<std::string, double> truth = {
      {"mass", 37}, {"carriage_friction.coulomb", 120}, {"carriage_friction.viscous", 80}};
  std::map<std::string, int> count;
  for (int seed = 1; seed <= seeds; ++seed) {
    const auto found = fit(
        question, {series_of(axis.recorded({.noise = 0.3}, static_cast<std::uint64_t>(seed)), question)}, 2);
    for (const auto& [path, value] : truth) {
      const auto& one = value_of(found, path);
      count[path] += one.value && *one.low <= value && value <= *one.high ? 1 : 0;
    }
  }
  return count;
}

TEST(FitWitness, LimitsHoldTheTruth) {
  for (const auto& [path, count] : held(5)) EXPECT_GE(count, 4) << path;
}

// 200 seeds.
TEST(FitWitness, DISABLED_LimitsHoldTheTruthInNineOfTen) {
  for (const auto& [path, count] : held(200)) {
    EXPECT_GE(count, 180) << path;
    EXPECT_LE(count, 198) << path;
  }
}

}  // namespace
}  // namespace drycut::sim::studies
