// fitted: values that were learnt from recordings, and when they are fitted no more.
#include <gmock/gmock.h>

#include <algorithm>

#include "sim/scenario/scenario.hpp"
#include "tests/test_folder.hpp"

namespace drycut::sim::scenario {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string unfitted = R"(scene: {step: 100 us, duration: 1 s}
plants: {axis: {type: linear_axis, mass: 20 kg}}
)";
const std::string learnt = R"(extends: unfitted.yaml
plants: {axis: {mass: 37.0154 kg}}
fitted:
  plants.axis.mass: {low: 36.997 kg, high: 37034 g, from: "move.csv, other.csv"}
)";

struct FittedValues : testing::Test {
  FittedValues() { folder.file("unfitted.yaml", unfitted); }
  Scenario read(const std::string& text, const std::vector<Override>& set = {}) {
    problems.clear();
    return read_scenario_text(text, folder / "line.yaml", set, problems);
  }
  /// What a page says of the mass; "" if it says nothing of a fit.
  std::string mass(const Scenario& scenario) const {
    EXPECT_EQ(lines_of(problems), "");
    const auto& fitted = scenario.plants.at(0).fitted;
    EXPECT_EQ(fitted.size(), scenario.fitted.size());
    return fitted.empty() ? "" : fitted[0].parameter + ": " + fitted[0].from;
  }
  TestFolder folder;
  Problems problems;
};

const std::string told = "mass: fitted, 36.997 .. 37.034 kg (95 %), move.csv, other.csv";

TEST_F(FittedValues, SayFromWhichRecordingAndWithinWhichLimits) { EXPECT_EQ(mass(read(learnt)), told); }

TEST_F(FittedValues, StayFittedWhereTheScenarioIsWrittenOut) {
  const auto text = expand(read(learnt));
  EXPECT_THAT(text, HasSubstr("fitted:\n  plants.axis.mass: {low: 36.997 kg, high: 37034 g, from: "));
  EXPECT_EQ(mass(read(text)), told);
  EXPECT_EQ(expand(read(text)), text);
}

TEST_F(FittedValues, StayFittedInWhatExtendsThem) {
  folder.file("fitted.yaml", learnt);
  EXPECT_EQ(mass(read("extends: fitted.yaml\nscene: {duration: 2 s}\n")), told);
}

TEST_F(FittedValues, AreFittedNoMoreOnceSomebodyGivesAnotherValue) {
  folder.file("fitted.yaml", learnt);
  EXPECT_EQ(mass(read(learnt, {{"plants.axis.mass", "37.01 kg"}})), "") << "also one between the limits";
  EXPECT_EQ(mass(read("extends: fitted.yaml\nplants: {axis: {mass: 37.01 kg}}\n")), "");
  EXPECT_EQ(mass(read("extends: fitted.yaml\nplants: {axis: {mass: ~}}\n")), "");
  auto edited = learnt;
  edited.replace(edited.find("37.0154"), 7, "50");
  EXPECT_EQ(mass(read(edited)), "");
  EXPECT_THAT(expand(read(edited)), Not(HasSubstr("fitted")));
}

TEST_F(FittedValues, WhatIsNoValueOrNoLimitIsTold) {
  const auto lines = [&](const std::string& entry) {
    read("extends: unfitted.yaml\nfitted:\n  " + entry + "\n");
    return lines_of(problems);
  };
  EXPECT_THAT(lines("plants.axis.mas: {low: 1 kg, high: 2 kg, from: a.csv}"),
              HasSubstr("line.yaml:3:3: fitted: 'plants.axis.mas' is no quantity of a plant; "
                        "did you mean plants.axis.mass? [scenario.unknown-name]\n"));
  EXPECT_THAT(lines("plants.axis.mass: {low: 1 mm, high: 2 kg, from: a.csv}"),
              HasSubstr("line.yaml:3:29: fitted.plants.axis.mass.low is"));
  EXPECT_THAT(
      lines("plants.axis.mass: {low: 3 kg, high: 2 kg, from: a.csv}"),
      HasSubstr(":39: fitted.plants.axis.mass.high is below low; the lower limit is low [scenario.order]"));
  EXPECT_THAT(lines("plants.axis.mass: {low: 3 kg}"),
              testing::AllOf(HasSubstr("fitted.plants.axis.mass.high is missing"),
                             HasSubstr("fitted.plants.axis.mass.from is missing")));
}

}  // namespace
}  // namespace drycut::sim::scenario
