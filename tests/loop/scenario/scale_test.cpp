// Large scenarios: what is ten times as long takes ten times as long, and not a hundred or a thousand times.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <ctime>

#include "sim/loop/simulation.hpp"

namespace drycut::sim::scenario {
namespace {

/// Processor time that it takes [s], whatever else the machine does.
template <typename Work>
double seconds_of(Work work) {
  const auto begin = std::clock();
  work();
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

/// Far more than it takes under sanitizers; what grows with the square took minutes and hours.
constexpr double patience = 60;  // [s]

struct LargeScenario : testing::Test {
  void read(const std::string& text) {
    scenario = read_scenario_text(text, "large.yaml", {}, problems);
    if (scenario.buildable) simulation = std::make_unique<loop::Simulation>(scenario, problems);
  }
  Problems problems;
  Scenario scenario;
  std::unique_ptr<loop::Simulation> simulation;
};

TEST_F(LargeScenario, OnOneLine) {
  std::string text = "{scene: {title: \"";
  for (int i = 0; i < 200'000; ++i) text += "é";
  text += "\"}, record: {channels: [";
  for (int i = 0; i < 60'000; ++i) text += fmt::format("c{}, ", i);
  text += "c7]}}";
  EXPECT_LT(seconds_of([&] { scenario = read_scenario_text(text, "large.yaml", {}, problems); }), patience);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].what, "channel c7 is recorded twice");
  EXPECT_EQ(problems[0].column, static_cast<int>(text.size()) - 4 - 200'000) << "in characters";
}

TEST_F(LargeScenario, OfThousandsOfPlantsInTheWrongOrder) {
  constexpr int count = 4000;
  std::string text = "plants:\n";
  for (int i = 0; i < count; ++i) text += fmt::format("  k{}: {{type: rotary_knife, web: w{}}}\n", i, i);
  for (int i = count - 1; i >= 0; --i) text += fmt::format("  w{}: {{type: web}}\n", i);
  text += "record:\n  channels: [k0.angle";
  for (int i = 1; i < count; ++i) text += fmt::format(", k{}.angle", i);
  text += "]\nchecks:\n";
  for (int i = 0; i < count; ++i)
    text += fmt::format("  - {{name: c{0}, each: k{0}.cut, expect: length > 1}}\n", i);
  EXPECT_LT(seconds_of([&] { read(text); }), patience);
  EXPECT_THAT(problems, testing::IsEmpty());
  ASSERT_EQ(scenario.plants.size(), 2U * count);
  EXPECT_EQ(scenario.plants.front().name.text, fmt::format("w{}", count - 1))
      << "the knives wait for their webs";
  EXPECT_EQ(scenario.plants[1].name.text, fmt::format("k{}", count - 1));
  ASSERT_NE(simulation, nullptr);
  EXPECT_EQ(simulation->recording().columns().size(), 1U * count);
}

TEST_F(LargeScenario, WithThousandsOfSlips) {
  constexpr int count = 3000;
  std::string text = "plants:\n";
  for (int i = 0; i < count; ++i) text += fmt::format("  w{}: {{type: web}}\n", i);
  text += "record:\n  channels: [v0.speed";
  for (int i = 1; i < count; ++i) text += fmt::format(", v{}.speed", i);
  text += "]\nchecks:\n";
  for (int i = 0; i < count; ++i) text += fmt::format("  - {{name: c{0}, always: v{0}.sped > 1}}\n", i);
  for (int i = 0; i < count; ++i) text += fmt::format("  - {{name: e{0}, never: v{0}.cut}}\n", i);
  text += "timeline:\n";
  for (int i = 0; i < count; ++i)
    text += fmt::format("  - {{at: 1 s, fault: {{v{0}.wheel: {{slip: 1}}}}}}\n", i);
  EXPECT_LT(seconds_of([&] { read(text); }), patience);
  ASSERT_EQ(problems.size(), 4U * count);
  const auto remedies = std::count_if(problems.begin(), problems.end(),
                                      [](const auto& p) { return p.remedy.starts_with("did you"); });
  EXPECT_GT(remedies, 90) << "the first slips are told what was meant";
}

TEST_F(LargeScenario, WithAKeyGivenAThousandTimes) {
  std::string text = "wiring:\n";
  for (int i = 0; i < 30'000; ++i) text += fmt::format("  2.INP{}: panel.a\n", i / 2);
  EXPECT_LT(seconds_of([&] { read(text); }), patience);
  ASSERT_GE(problems.size(), 15'000U);
  EXPECT_EQ(problems[0].line, 3);
  EXPECT_EQ(problems[0].what, "'2.INP0' is given twice in wiring");
  EXPECT_EQ(problems[0].remedy, "keep one; the first is at line 2");
}

}  // namespace
}  // namespace drycut::sim::scenario
