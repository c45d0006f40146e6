#include <gmock/gmock.h>

#include <drycut/simulation.hpp>
#include <filesystem>
#include <limits>
#include <string>
#include <tuple>

#include "base/text.hpp"
#include "sim/loop/simulation.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::SizeIs;
using testing::ThrowsMessage;

const auto scenes = std::filesystem::path(DRYCUT_SOURCE_DIR) / "scenes";

TEST(Library, ALineGoesAsTheProgramRunsIt) {
  Simulation line(scenes / "rotary_knife.yaml");
  EXPECT_EQ(line.time(), 0);
  EXPECT_EQ(line.step_length(), 1e-4);
  EXPECT_EQ(line.duration(), 12);
  line.advance(6);
  const auto half = line.take_events();
  line.advance(line.duration() - line.time());
  EXPECT_NEAR(line.time(), 12, 1e-9);
  auto events = half;
  for (auto& event : line.take_events()) events.push_back(event);
  EXPECT_THAT(line.take_events(), SizeIs(0));

  Problems problems;
  const auto scenario = sim::scenario::read_scenario(scenes / "rotary_knife.yaml", {}, problems);
  sim::loop::Simulation same(scenario, problems);
  const auto outcome = same.run();
  EXPECT_EQ(outcome.failure, "");
  ASSERT_EQ(events.size(), same.recording().events().size());
  for (std::size_t i = 0; i < events.size(); ++i) {
    const auto recorded = same.recording().events()[i];
    EXPECT_EQ(events[i].time, recorded.at_seconds());
    EXPECT_EQ(events[i].name, recorded.event);
    for (const auto& value : recorded.values) EXPECT_EQ(events[i].values.at(value.name), value.number);
  }
  const auto checks = line.checks();
  ASSERT_EQ(checks.size(), outcome.checks.size());
  for (std::size_t i = 0; i < checks.size(); ++i) {
    EXPECT_EQ(checks[i].name, outcome.checks[i].name);
    EXPECT_TRUE(checks[i].passed) << checks[i].name;
    EXPECT_EQ(checks[i].margin, outcome.checks[i].margin) << checks[i].name;
  }
}

TEST(Library, ChecksMayBeAskedForAtAnyTime) {
  Simulation line(scenes / "rotary_knife.yaml");
  const auto passed = [&line](const std::string& name) {
    for (const auto& check : line.checks())
      if (check.name == name) return check.passed;
    ADD_FAILURE() << name;
    return false;
  };
  line.advance(1);
  EXPECT_FALSE(passed("cut length"));
  EXPECT_FALSE(passed("cut length"));
  line.advance(9);
  EXPECT_TRUE(passed("cut length"));
}

TEST(Library, NumbersAreReadAndWrittenInTheUnitsThatAreShown) {
  Simulation line(scenes / "rotary_knife.yaml", {{"plants.web.speed", "50 m/min"}});
  line.step();
  EXPECT_NEAR(line.read("web.speed"), 50, 1e-9);
  EXPECT_EQ(line.unit("web.speed"), "m/min");
  line.write("web.speed", 30);
  line.advance(2);
  EXPECT_NEAR(line.read("web.speed"), 30, 1e-6);
  line.write("AxisX.pgain", 40);
  line.advance(0.01);
  EXPECT_EQ(line.read("AxisX.pgain"), 40);
  line.write("panel.start", 1);
  EXPECT_EQ(line.read("panel.start"), 1);
  EXPECT_EQ(line.unit("panel.start"), "");
  EXPECT_THAT(line.names(), Contains("knife.motor.torque"));
}

TEST(Library, WhatDoesNotFitIsThrown) {
  EXPECT_THAT(
      [] {
        Simulation(scenes / "rotary_knife.yaml", {{"plants.web.sped", "1"}});
      },
      ThrowsMessage<BadInput>(HasSubstr("did you mean speed?")));
  EXPECT_THAT([] { Simulation("missing.yaml"); }, ThrowsMessage<BadInput>(HasSubstr("missing.yaml:1:1: ")));
  Simulation line(scenes / "rotary_knife.yaml");
  EXPECT_THAT([&] { std::ignore = line.read("web.sped"); }, ThrowsMessage<BadInput>(HasSubstr("web.speed")));
  EXPECT_THAT([&] { std::ignore = line.unit("web.sped"); }, ThrowsMessage<BadInput>(HasSubstr("'web.sped'")));
  EXPECT_THAT([&] { line.write("knife.angle", 1); }, ThrowsMessage<BadInput>(HasSubstr("only be read")));
  EXPECT_THAT([&] { line.write("AxisX.pgain", 1e9); }, ThrowsMessage<BadInput>(HasSubstr("AxisX.pgain")));
  EXPECT_THAT([&] { line.write("panel.start", 0.5); }, ThrowsMessage<BadInput>(HasSubstr("panel.start")));
  EXPECT_THAT([&] { line.write("web.drive.stiffness", 1e9); },
              ThrowsMessage<BadInput>(HasSubstr("oscillate at 1125 Hz")));
  for (const double seconds : {-1.0, 1e10, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(line.advance(seconds), BadInput) << seconds;
}

}  // namespace
}  // namespace drycut
