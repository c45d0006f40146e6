#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "sim/studies/fit/study.hpp"
#include "tests/sim/studies/fit/witness/belt_axis.hpp"

// What is asked of the belt axis, of a scenario whose values are others.
namespace drycut::sim::studies {

inline constexpr auto* scenario_text = R"(
scene: {title: a belt axis, step: 200 us, duration: 1 s}
plants:
  axis:
    {type: linear_axis, mass: 20 kg, lead: 100 mm, start: 0 mm, travel_max: 2000 mm, limit_max: 1990 mm,
     gear: {stiffness: 5000 N m/rad, damping: 1 N m s/rad},
     carriage_friction: {coulomb: 50 N, viscous: 30 N s/m}}
)";

inline FitQuestion asking(const std::vector<std::string>& paths) {
  FitQuestion question;
  question.file = "axis.yaml";
  question.text = scenario_text;
  question.plant = "axis";
  for (const auto& path : paths) question.vary.push_back(*fit_path("plants.axis." + path));
  return question;
}

inline ReplaySeries series_of(const recordings::Recording& recording, const FitQuestion& question) {
  Problems problems;
  auto machine = scenario::read_scenario_text(question.text, question.file, question.set, problems);
  strip(machine);
  EXPECT_TRUE(make_source_of_torque(machine, question.plant));
  const auto series = replay_series(recording, "hidden.yaml", question, machine, problems);
  EXPECT_TRUE(problems.empty());
  return *series;
}

inline const FittedValue& value_of(const FitFound& found, const std::string& path) {
  return *std::ranges::find(found.parameters, "plants.axis." + path, &FittedValue::path);
}

inline void expect_known(const FitFound& found, const std::string& path, double truth, double share) {
  const auto& value = value_of(found, path);
  ASSERT_TRUE(value.value) << path << ": " << value.why;
  EXPECT_NEAR(*value.value, truth, share * truth) << path;
  EXPECT_LE(*value.low, *value.value) << path;
  EXPECT_GE(*value.high, *value.value) << path;
}

inline const std::vector<std::string> rigid = {"mass", "carriage_friction.coulomb",
                                               "carriage_friction.viscous"};

}  // namespace drycut::sim::studies
