// The limits of a fit as ranges of a study: what tune --spread, sweep and envelope --over take of fit.json.
#include "sim/studies/tune/parameter.hpp"

#include <gmock/gmock.h>

#include "tests/sim/studies/tune/bench.hpp"

namespace drycut::sim::studies::tuning {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string known =
    R"({"path": "plants.axis.speed_at_10v", "value": 1000, "low": 990.5, "high": 1010, "unit": "mm/s", "known": "yes"})";
const std::string not_known =
    R"({"path": "plants.axis.resolution", "value": null, "low": null, "high": null, "unit": "mm", "known": "joined"})";

std::string fit_of(const std::string& values) { return R"({"format": 1, "parameters": [)" + values + "]}"; }

struct FitLimits : Bench {
  TunedParameters limits(const std::string& json, const std::vector<std::string>& given = {}) {
    problems.clear();
    return limits_of_fit(test_folder.file("fit.json", json).string(), "--spread", given, problems);
  }
  Problems problems;
};

TEST_F(FitLimits, AreRangesInTheUnitsOfTheirRows) {
  const auto found = limits(fit_of(known));
  ASSERT_EQ(lines_of(problems), "");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].path, "plants.axis.speed_at_10v");
  EXPECT_EQ(found[0].low, 990.5);
  EXPECT_EQ(found[0].high, 1010);
  EXPECT_EQ(found[0].unit, "mm/s");
  EXPECT_EQ(found[0].option, "--spread");
}

TEST_F(FitLimits, AValueThatIsNotKnownNeedsARangeBesideTheFile) {
  EXPECT_EQ(limits(fit_of(known + "," + not_known)).size(), 1U);
  EXPECT_THAT(lines_of(problems),
              AllOf(HasSubstr("--spread:1:1: "), HasSubstr("fit.json does not know plants.axis.resolution; "),
                    HasSubstr("plants.axis.resolution=LO..HI mm [fit.not-known]\n")));
  EXPECT_EQ(limits(fit_of(known + "," + not_known), {"plants.axis.resolution"}).size(), 1U);
  EXPECT_EQ(lines_of(problems), "");
  EXPECT_EQ(limits(fit_of(known), {"plants.axis.speed_at_10v"}).size(), 0U) << "the range beside it counts";
}

TEST_F(FitLimits, AFileThatIsNoFitIsRefused) {
  for (const std::string json :
       {"", "[]", "{}", R"({"format": 2, "parameters": []})", R"({"format": 1, "parameters": [3]})",
        R"({"format": 1, "parameters": [{"path": "a", "value": 1, "low": 2, "high": 1}]})",
        R"({"format": 1, "parameters": [{"path": "a", "value": 1}]})"}) {
    EXPECT_TRUE(limits(json).empty()) << json;
    EXPECT_THAT(lines_of(problems), HasSubstr("--spread:1:1: ")) << json;
    EXPECT_THAT(lines_of(problems), HasSubstr("[study.argument]\n")) << json;
  }
  problems.clear();
  EXPECT_TRUE(limits_of_fit("none.json", "--over", {}, problems).empty());
  EXPECT_THAT(lines_of(problems), HasSubstr("--over:1:1: "));
}

TEST_F(FitLimits, PathsThatAreGivenBesideAreKnownByTheirEquals) {
  EXPECT_TRUE(names_fit(" out/fit/fit.json"));
  EXPECT_FALSE(names_fit("plants.a.file=x.json"));
  EXPECT_FALSE(names_fit("plants.a.mass"));
  EXPECT_THAT(given_paths({"a.b =1..2", "out/fit.json"}), ElementsAre("a.b"));
}

TEST_F(FitLimits, ATuningIsTriedOnMachinesBetweenThem) {
  options.spread = {test_folder.file("fit.json", fit_of(known)).string()};
  options.spread_runs = 5;
  ASSERT_EQ(run(), cli::all_passed) << out << err;
  const auto table = content(folder / "out/spread.csv");
  EXPECT_THAT(table, HasSubstr("plants.axis.speed_at_10v [mm/s]"));
  EXPECT_EQ(std::ranges::count(table, '\n'), 2 + 5) << table;
}

// A fit of another machine.
TEST_F(FitLimits, WhatTheScenarioDoesNotTakeIsToldAtTheOption) {
  options.spread = {
      test_folder
          .file("fit.json",
                fit_of(R"({"path": "plants.axis.mass", "value": 2, "low": 1, "high": 3, "unit": "kg"})"))
          .string()};
  EXPECT_EQ(run(), cli::bad_input);
  EXPECT_THAT(err, AllOf(HasSubstr("--spread:1:1: "), HasSubstr("plants.axis.mass")));
}

}  // namespace
}  // namespace drycut::sim::studies::tuning
