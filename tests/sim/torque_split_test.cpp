// What a motor's torque goes into, against closed forms of the machine.
#include "sim/report/torque.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "plants/motor_load.hpp"
#include "sim/loop/simulation.hpp"

namespace drycut::sim::report {
namespace {

/// A scenario with some values of its own, run to its end.
struct SplitRun {
  Problems problems;
  scenario::Scenario scenario;
  std::unique_ptr<loop::Simulation> simulation;
  std::vector<TorqueSplit> splits;

  explicit SplitRun(scenario::Scenario read, Problems told)
      : problems(std::move(told)), scenario(std::move(read)) {
    if (problems.empty()) simulation = std::make_unique<loop::Simulation>(scenario, problems);
    if (!problems.empty()) throw std::runtime_error(to_string(problems.front()));
    simulation->follow_cams();
    follow_torques(scenario, *simulation);
    simulation->run();
    splits = torque_splits(scenario, *simulation, simulation->outcome().drives);
  }
  static SplitRun scene(const std::string& file, const std::map<std::string, std::string>& set) {
    Problems told;
    std::vector<scenario::Override> overrides;
    for (const auto& [path, value] : set) overrides.push_back({path, value});
    auto read =
        scenario::read_scenario(std::filesystem::path(DRYCUT_SOURCE_DIR) / "scenes" / file, overrides, told);
    return SplitRun(std::move(read), std::move(told));
  }
  static SplitRun text(const std::string& text) {
    Problems told;
    auto read = scenario::read_scenario_text(text, "/nowhere/line.yaml", {}, told);
    return SplitRun(std::move(read), std::move(told));
  }
  [[nodiscard]] const plants::TellsMotorLoad& plant(std::size_t number) const {
    return dynamic_cast<const plants::TellsMotorLoad&>(*simulation->plants().at(number).plant);
  }
};

const TorqueSplit::Part* part_of(const TorqueSplit& split, const std::string& name) {
  const auto found = std::find_if(split.parts.begin(), split.parts.end(),
                                  [&](const auto& part) { return part.name == name; });
  return found == split.parts.end() ? nullptr : &*found;
}

/// The knife under MC_CamIn without a cut, pieces of 800 mm at `speed`; without friction unless `motor` and
/// `drum` have some.
SplitRun uncut_knife(const std::string& speed,
                     const std::string& motor = "{coulomb: 0 N m, viscous: 0 N m s/rad}",
                     const std::string& drum = "{coulomb: 0 N m, viscous: 0 N m s/rad}") {
  const auto scenes = std::filesystem::path(DRYCUT_SOURCE_DIR) / "scenes";
  return SplitRun::text("extends: " + (scenes / "rotary_knife_mc_camin.yaml").string() + R"(
scene: {duration: 8 s}
plants:
  web: {shear_strength: 0 MPa}
  knife:
    encoder: {on_drum: true, lines: 10240}
    coupling: 0 N s/m
    grip: 0 N
    motor_friction: )" + motor +
                        "\n    drum_friction: " + drum + R"(
controller: {plcopen: {axes: {Knife: {dynamik: {vb_max: 3000 deg/s, a_max: 80000 deg/s2}}}}}
timeline:
  - {at: 100 ms, set: {panel.start: 1}}
  - {when: panel.in_sync == 1, after: 100 ms, ramp: {web.speed: )" +
                        speed + R"(}, over: 2 s}
)");
}

// A synchronous way Ls and the quintic of the rest, as in the test of sizes: the integral of a^2 over a piece
// is 120/7 (C - L)^2 / T^3.
double rms_of_ideal_cam(double gear) {
  constexpr double length = 0.8;
  constexpr double circumference = 0.6;
  const double time = length - 0.12;  // at 1 m/s
  const double blade =
      std::sqrt(120.0 / 7 * std::pow(circumference - length, 2) / std::pow(time, 3) / length);
  return (46.8e-4 * gear + 0.41 / gear) * blade / (circumference / (2 * std::numbers::pi));
}

TEST(TorqueSplits, OfAnIdealKnifeAreTheCam) {
  const auto run = uncut_knife("60 m/min");
  ASSERT_EQ(run.splits.size(), 1U);
  const auto& split = run.splits.front();
  EXPECT_EQ(split.drive, "knife.servo");
  EXPECT_GE(split.cycles, 3U);
  ASSERT_TRUE(split.has_cam);
  const auto* const cam = part_of(split, "cam");
  ASSERT_NE(cam, nullptr);
  const double expected = rms_of_ideal_cam(5);
  EXPECT_NEAR(cam->rms, expected, 0.01 * expected);
  EXPECT_NEAR(split.torque.rms, expected, 0.02 * expected);
  EXPECT_GT(cam->share, 0.97);
  EXPECT_EQ(part_of(split, "friction"), nullptr);
  EXPECT_EQ(part_of(split, "load"), nullptr);
  EXPECT_EQ(part_of(split, "gravity"), nullptr);
}

TEST(TorqueSplits, SumUpToTheTorqueAtEachInstant) {
  const auto run = SplitRun::scene("rotary_knife.yaml", {{"scene.duration", "9 s"}});
  ASSERT_EQ(run.splits.size(), 1U);
  const auto& split = run.splits.front();
  ASSERT_TRUE(split.has_cam);
  for (const auto* name : {"cam", "friction", "load", "regulator"})
    EXPECT_NE(part_of(split, name), nullptr) << name;
  double share = 0;
  for (const auto& part : split.parts) share += part.share;
  EXPECT_NEAR(share, 1, 0.001);
  double squares = 0;
  for (std::size_t i = 0; i < split.torque.torque.size(); ++i) {
    double sum = 0;
    for (const auto& part : split.parts) sum += part.torque[i];
    ASSERT_NEAR(sum, split.torque.torque[i], 0.01 * split.torque.rms) << i;
    squares += sum * sum;
  }
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(split.torque.torque.size())), split.torque.rms,
              0.01 * split.torque.rms);
  // Friction relieves nobody who turns forwards, and the cut comes and goes.
  EXPECT_GT(part_of(split, "friction")->share, 0);
  EXPECT_GT(part_of(split, "load")->peak, 3 * part_of(split, "load")->rms);
}

// While it slides the model's friction at that speed, each instant; what moves is inertia, and nothing else.
TEST(TorqueSplits, HaveTheFrictionOfTheModel) {
  const auto run = uncut_knife("60 m/min", "{coulomb: 0.2 N m, viscous: 0.002 N m s/rad}",
                               "{coulomb: 3 N m, viscous: 0.4 N m s/rad}");
  ASSERT_EQ(run.splits.size(), 1U);
  const auto* const kept = run.plant(1).motor_loads();
  ASSERT_NE(kept, nullptr);
  constexpr double gear = 5;
  std::size_t seen = 0;
  for (std::size_t i = kept->samples.size() / 2; i < kept->samples.size(); ++i) {
    const auto& sample = kept->samples[i];
    ASSERT_GT(sample.speed, 1) << i;
    // The gear twists a little: rotor and drum are not at the very same speed.
    const double expected = 0.2 + 0.002 * sample.speed + (3 + 0.4 * sample.speed / gear) / gear;
    ASSERT_NEAR(sample.friction, expected, 0.01 * expected) << i;
    ASSERT_NEAR(sample.load, 0, 1e-4 * expected) << i;
    ++seen;
  }
  EXPECT_GT(seen, 10'000U);
}

// A slide that a motor holds: its weight over the lead, nothing accelerates.
TEST(TorqueSplits, HaveTheWeightOfAnInclinedAxis) {
  const auto run = SplitRun::text(
      "scene: {duration: 1 s}\nplants:\n  a: {type: linear_axis, inclination: 30 deg, mass: 20 kg, lead: 20 "
      "mm}\n");
  ASSERT_EQ(run.splits.size(), 1U);
  const auto& split = run.splits.front();
  EXPECT_FALSE(split.has_cam);
  EXPECT_EQ(split.cycles, 0U);
  const auto* const gravity = part_of(split, "gravity");
  ASSERT_NE(gravity, nullptr);
  EXPECT_NEAR(gravity->rms, 20 * 9.80665 * 0.5 * 0.02 / (2 * std::numbers::pi), 1e-4);
}

// A cycle that is longer than what is kept by default: it is split whole.
TEST(TorqueSplits, HoldAWholeCycleHoweverLong) {
  const auto run = SplitRun::scene("press_learning.yaml", {});
  ASSERT_EQ(run.splits.size(), 1U);
  const auto& split = run.splits.front();
  ASSERT_GE(split.cycles, 1U);
  // Those of the verdict: from the start of a tour to that of the next, or 22 s.
  const auto drives = run.simulation->outcome().drives;
  const auto& cycles = drives.at(0).last_cycles;
  ASSERT_GE(cycles.size(), split.cycles);
  EXPECT_NEAR(split.end, cycles.back().second, 1e-3);
  EXPECT_NEAR(split.begin, cycles[cycles.size() - split.cycles].first, 1e-3);
  EXPECT_NEAR((split.end - split.begin) / static_cast<double>(split.cycles), 22, 0.3);
}

// Guides that hold a ram as it turns round are friction, and no load.
TEST(TorqueSplits, HaveNoLoadWhereNothingIsTouched) {
  const auto run = SplitRun::scene("press_learning.yaml", {{"scene.duration", "14 s"}});
  ASSERT_EQ(run.splits.size(), 1U);
  EXPECT_EQ(part_of(run.splits.front(), "load"), nullptr);
  EXPECT_NE(part_of(run.splits.front(), "friction"), nullptr);
}

// A fast knife's loops add to the cam, the more the shorter a piece takes.
TEST(TorqueSplits, TellWhatTheRegulatorAdds) {
  const auto added = [](const std::string& speed) {
    const auto run = uncut_knife(speed);
    const auto& split = run.splits.at(0);
    EXPECT_NE(part_of(split, "cam"), nullptr);
    return split.torque.rms / part_of(split, "cam")->rms - 1;
  };
  const double slow = added("48 m/min");
  const double fast = added("130 m/min");
  // As 1 / time^2, to a quarter: 0.3 and 2.0 %.
  EXPECT_NEAR(slow, 0.003, 0.002);
  EXPECT_NEAR(fast, slow * std::pow(130.0 / 48, 2), 0.4 * fast);
}

// Nobody asked, nothing is kept.
TEST(TorqueSplits, AreNotThereUnlessAskedFor) {
  Problems problems;
  const auto scenario = scenario::read_scenario_text(
      "scene: {duration: 0.1 s}\nplants:\n  a: {type: linear_axis}\n", "/nowhere/line.yaml", {}, problems);
  loop::Simulation simulation(scenario, problems);
  ASSERT_TRUE(problems.empty());
  simulation.run();
  EXPECT_EQ(dynamic_cast<const plants::TellsMotorLoad&>(*simulation.plants().front().plant).motor_loads(),
            nullptr);
  EXPECT_TRUE(torque_splits(scenario, simulation, simulation.outcome().drives).empty());
}

}  // namespace
}  // namespace drycut::sim::report
