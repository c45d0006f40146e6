#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "sim/studies/fit/question.hpp"
#include "sim/studies/fit/report.hpp"
#include "tests/test_folder.hpp"

namespace drycut::sim::studies {
namespace {

const std::string shipped = DRYCUT_SOURCE_DIR "/scenes/recordings/";

std::vector<std::string> codes_of(const FitRequest& request) {
  Problems problems;
  plan_fit(request, problems);
  std::vector<std::string> codes;
  for (const auto& problem : problems) codes.emplace_back(problem.code.text());
  return codes;
}

FitRequest belt_axis(const std::vector<std::string>& vary) {
  FitRequest request;
  request.scenario = shipped + "belt_axis.yaml";
  request.recordings = {shipped + "belt_axis_move.yaml"};
  request.vary = vary;
  return request;
}

using Codes = std::vector<std::string>;

TEST(FitQuestion, WhatIsShippedIsSound) { EXPECT_EQ(codes_of(belt_axis({"plants.axis.mass"})), Codes{}); }

TEST(FitQuestion, TellsWhatCannotBeLookedFor) {
  EXPECT_EQ(codes_of(belt_axis({})), Codes{"fit.unknown-value"});
  EXPECT_EQ(codes_of(belt_axis({"plants.axis.mas", "plants.axis.mass"})), Codes{"fit.unknown-value"});
  EXPECT_EQ(codes_of(belt_axis({"plants.axis.mass", "plants.axis.mass"})), Codes{"fit.unknown-value"});
  EXPECT_EQ(codes_of(belt_axis({"plants.axis.drive", "plants.axis.mass"})), Codes{"fit.unknown-value"});
  EXPECT_EQ(codes_of(belt_axis({"scene.step", "plants.axis.mass"})), Codes{"fit.unknown-value"});
}

TEST(FitQuestion, TellsARecordingThatHasNotWhatIsNeeded) {
  auto request = belt_axis({"plants.axis.mass"});
  request.recordings.clear();
  EXPECT_EQ(codes_of(request), Codes{"fit.no-recording"});
  const TestFolder folder;
  folder.file("move.csv", "t;trq;pos\n0;1;0\n0.001;1;1\n0.002;2;2\n");
  const std::string begin =
      "file: move.csv\nformat: csv\nseparator: semicolon\ntime: {column: t, unit: s}\nchannels:\n";
  request.recordings = {folder.file("a.yaml", begin + "  axis.encoder.count: {column: pos, unit: counts}\n")};
  EXPECT_EQ(codes_of(request), Codes{"fit.no-torque"});
  request.recordings = {folder.file("b.yaml", begin + "  axis.motor.torque: {column: trq, unit: N m}\n")};
  EXPECT_EQ(codes_of(request), Codes{"fit.no-motion"});
  // Both at once.
  request.recordings = {folder.path / "a.yaml", folder.path / "b.yaml", folder.path / "none.yaml"};
  EXPECT_EQ(codes_of(request), (Codes{"fit.no-torque", "fit.no-motion", "file.missing"}));
}

TEST(FitQuestion, TellsAPlantWithoutAServo) {
  auto request = belt_axis({"plants.axis.mass"});
  request.set = {{"plants.axis.drive", "inverter"}};
  EXPECT_EQ(codes_of(request), Codes{"fit.no-servo"});
}

TEST(FitQuestion, ACommandedTorqueIsDoubted) {
  const TestFolder folder;
  folder.file("move.csv", "t;torque demand;pos\n0;1;0\n0.001;1;1\n0.002;2;2\n");
  auto request = belt_axis({"plants.axis.mass"});
  request.recordings = {folder.file("a.yaml",
                                    "file: move.csv\nformat: csv\nseparator: semicolon\n"
                                    "time: {column: t, unit: s}\nchannels:\n"
                                    "  axis.motor.torque: {column: torque demand, unit: N m}\n"
                                    "  axis.encoder.count: {column: pos, unit: counts}\n")};
  Problems problems;
  const auto plan = plan_fit(request, problems);
  EXPECT_TRUE(problems.empty());
  EXPECT_TRUE(
      std::ranges::any_of(plan.findings, [](const Finding& one) { return one.code == "fit.commanded"; }));
}

// The scenario that is written has the values found, and no others.
TEST(FitReport, WhatIsWrittenCanBeRead) {
  const TestFolder folder;
  auto request = belt_axis({"plants.axis.mass", "plants.axis.carriage_friction.coulomb"});
  Problems problems;
  const auto plan = plan_fit(request, problems);
  ASSERT_TRUE(problems.empty());
  FitFound found;
  found.parameters = {{.path = "plants.axis.mass", .value = 37.25, .low = 37, .high = 37.5, .unit = "kg"},
                      {.path = "plants.axis.carriage_friction.coulomb",
                       .unit = "N",
                       .known = FitKnown::joined,
                       .why = "because"}};
  const auto file = folder.file("fitted.yaml", fitted_text(plan, found, folder.path));
  auto read = scenario::read_scenario(file, {}, problems);
  ASSERT_TRUE(problems.empty());
  plants::Parameters rows;
  EXPECT_EQ(*std::get<double*>(quantity_at(read, *fit_path("plants.axis.mass"), rows)->value), 37.25);
  EXPECT_EQ(
      *std::get<double*>(quantity_at(read, *fit_path("plants.axis.carriage_friction.coulomb"), rows)->value),
      50);
}

}  // namespace
}  // namespace drycut::sim::studies
