#include <gtest/gtest.h>

#include <string>

#include "sim/studies/fit/question.hpp"
#include "sim/studies/fit/study.hpp"

namespace drycut::sim::studies {
namespace {

const std::string recorded = DRYCUT_SOURCE_DIR "/scenes/recordings/";

FitRequest closed_loop() {
  FitRequest request;
  request.scenario = recorded + "belt_axis_loop.yaml";
  request.recordings = {recorded + "belt_axis_move_loop.yaml"};
  request.tests = {recorded + "belt_axis_other_move_loop.yaml"};
  request.vary = {"plants.axis.mass", "plants.axis.carriage_friction.coulomb",
                  "plants.axis.carriage_friction.viscous"};
  request.closed = true;
  return request;
}

// The recordings are CVODE's (WhatIsShippedIsTheBeltAxis): 37 kg, 120 N, 80 N s/m, torque 1 ms late.
TEST(FitWitness, AClosedLoopIsFittedAsItRuns) {
  Problems problems;
  const auto plan = plan_fit(closed_loop(), problems);
  ASSERT_TRUE(problems.empty()) << problems.front().what;
  auto found = fit(plan.question, plan.recordings, 2);
  const double truth[] = {37, 120, 80};
  const double share[] = {0.01, 0.03, 0.02};
  for (std::size_t i = 0; i < found.parameters.size(); ++i) {
    const auto& one = found.parameters[i];
    ASSERT_TRUE(one.value) << one.path << ": " << one.why;
    EXPECT_NEAR(*one.value, truth[i], share[i] * truth[i]) << one.path;
  }
  EXPECT_NEAR(found.delays.at("axis.motor.torque") - found.delays.at("axis.motor.speed"), 1e-3, 1e-4);
  // The other recording is replayed with its own reference.
  cross_test(plan.question, plan.tests, 5, 2, found);
  EXPECT_LT(found.cross_error.value(), 0.05);
  EXPECT_TRUE(found.passed);
}

TEST(FitQuestion, AClosedLoopNeedsWhatItsInputsTakeInEachRecording) {
  auto request = closed_loop();
  request.tests = {recorded + "belt_axis_other_move.yaml"};
  Problems problems;
  plan_fit(request, problems);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems.front().code, "fit.no-channel"_code);
}

}  // namespace
}  // namespace drycut::sim::studies
