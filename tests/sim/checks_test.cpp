#include "sim/loop/checks.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <vector>

#include "sim/loop/statistics.hpp"
#include "sim/report/results.hpp"
#include "tests/loop/fakes.hpp"

namespace drycut::sim::loop {
namespace {

using fakes::text;

struct ChecksTest : testing::Test {
  ChecksTest() {
    scenario.file = "line.yaml";
    scenario.sources = {"line.yaml"};
    controller.values["error"] = 0;
  }
  scenario::CheckRequest& add(scenario::CheckRequest::Kind kind, const std::string& event,
                              const std::string& expression) {
    auto& check = scenario.checks.emplace_back();
    check.name = text("the check");
    check.kind = kind;
    check.event = text(event, 3, 4);
    check.expression = text(expression, 5, 6);
    return check;
  }
  void start() {
    checks = std::make_unique<Checks>(scenario, watch, names, events, problems);
    ASSERT_TRUE(problems.empty()) << to_string(problems.front());
  }
  void sample(Time now, double error) {
    controller.values["error"] = error;
    watch.update();
    checks->sample(now);
  }
  void cut(Time now, double length) {
    watch.update();
    checks->happened({now, 0, "knife", "cut", {{"length", length, "mm"}, {"force", 130, "N"}}, ""});
  }
  record::CheckResult result() { return checks->results(10 * second).front(); }

  scenario::Scenario scenario;
  fakes::FakeController controller;
  OperatorPanel panel;
  Names names{{}, &controller, panel};
  Watch watch{names};
  std::vector<KnownEvent> events = {{"knife", "cut", {{"length", "mm"}, {"force", "N"}}},
                                    {"knife", "tear", {}}};
  Problems problems;
  std::unique_ptr<Checks> checks;
};

TEST_F(ChecksTest, ACheckThatHeldAtNoInstantSaysWhatThereWas) {
  add(scenario::CheckRequest::Kind::always, "", "error > 5");
  start();
  for (int i = 0; i < 100; ++i) sample(i * millisecond, i % 4);
  EXPECT_EQ(result().throughout, "error 0 to 3 Um");
  sample(100 * millisecond, 6);
  EXPECT_EQ(result().throughout, "");
}

TEST_F(ChecksTest, WhatHeldUntilTheRunStoppedIsNoVerdictWhereThereWasMoreToJudge) {
  using Kind = scenario::CheckRequest::Kind;
  add(Kind::always, "", "error < 5").until = second;
  add(Kind::always, "", "error < 5");
  add(Kind::always, "", "error < 5").until = 3 * second;
  add(Kind::eventually, "", "error > 1");
  add(Kind::never, "knife.tear", "");
  add(Kind::always, "", "error < 1");
  start();
  for (int i = 1; i <= 4; ++i) sample(i * second / 2, 2);
  const auto so_far = [&](bool stopped) {
    std::vector<bool> flags;
    for (const auto& check : checks->results(2 * second, stopped)) flags.push_back(check.so_far);
    return flags;
  };
  EXPECT_THAT(so_far(true), testing::ElementsAre(false, true, true, false, true, false));
  EXPECT_THAT(so_far(false), testing::Each(false));
}

TEST_F(ChecksTest, ALimitAThousandTimesOffIsDoubted) {
  add(scenario::CheckRequest::Kind::always, "", "error < 100000");
  start();
  sample(second, 2);
  EXPECT_THAT(result().doubt, testing::HasSubstr("no less than 50000 times what came"));
  sample(2 * second, 200);
  EXPECT_EQ(result().doubt, "");
}

TEST_F(ChecksTest, WhatNeverCameSaysHowNearItCame) {
  add(scenario::CheckRequest::Kind::eventually, "", "error > 5").within = 3 * second;
  start();
  sample(1 * second, 1);
  sample(2 * second, 4);
  sample(3 * second, 2);
  EXPECT_EQ(
      result().detail,
      "not true at any of 3 instants, nearest at 2.0000 s: error=4 Um, the last at 3.0000 s: error=2 Um");
}

// What a check multiplies by a condition is judged only where that holds.
TEST_F(ChecksTest, ACheckWhoseConditionNeverCameJudgedNothing) {
  controller.values["step"] = 1;
  controller.values["flag"] = 0;
  add(scenario::CheckRequest::Kind::always, "", "(step == 2) * abs(error) <= 5");
  add(scenario::CheckRequest::Kind::always, "", "flag * abs(error) <= 5");
  add(scenario::CheckRequest::Kind::always, "", "(step == 1) * error <= 5");
  add(scenario::CheckRequest::Kind::always, "", "error == 0");
  add(scenario::CheckRequest::Kind::always, "", "2 * error <= 5");
  start();
  for (int i = 0; i < 3; ++i) sample(i * second, 0);
  const auto doubts = [&] {
    std::vector<std::string> all;
    for (const auto& result : checks->results(10 * second)) all.push_back(result.doubt);
    return all;
  };
  EXPECT_THAT(doubts(), testing::ElementsAre(
                            "check 'the check' judged nothing: step == 2 was 0 at all 3 instants",
                            "check 'the check' judged nothing: flag was 0 at all 3 instants", "", "", ""));
  const auto of_nothing = checks->results(10 * second).front();
  EXPECT_TRUE(of_nothing.judged_nothing());
  EXPECT_EQ(of_nothing.margin, std::nullopt);
  EXPECT_FALSE(checks->results(10 * second).back().judged_nothing());
  controller.values["step"] = 2;
  controller.values["flag"] = 1;
  sample(3 * second, 0);
  EXPECT_THAT(doubts(), testing::Each(""));
}

TEST_F(ChecksTest, EachTellsTheWorstEventAndItsMargin) {
  add(scenario::CheckRequest::Kind::each, "cut", "abs(length - 800) <= 0.2").from = second;
  start();
  cut(500 * millisecond, 700);  // before the time looked at
  cut(2 * second, 800.05);
  cut(3 * second, 799.85);
  cut(4 * second, 800.1);
  const auto r = result();
  EXPECT_TRUE(r.passed);
  EXPECT_NEAR(*r.margin, 0.05, 1e-9);
  EXPECT_EQ(r.unit, "mm");
  EXPECT_DOUBLE_EQ(*r.at, 3.0);
  EXPECT_EQ(r.expectation, "each cut: abs(length - 800) <= 0.2, from 1.0 s");
  EXPECT_EQ(r.detail, "3 cut events, worst: length=799.85 mm; force=130 N");
  EXPECT_EQ(report::margin_text(r), "0.05 mm left, at 3.0000 s");
  EXPECT_NEAR(*r.used, 0.75, 1e-9) << "of the limit, then";
  ASSERT_EQ(r.tolerances.size(), 1U);
  EXPECT_EQ(r.tolerances[0].event, "cut");
  EXPECT_EQ(r.tolerances[0].value, "length");
  EXPECT_DOUBLE_EQ(r.tolerances[0].low, 799.8);
  EXPECT_DOUBLE_EQ(r.tolerances[0].high, 800.2);
  EXPECT_EQ(r.tolerances[0].from, 1);
  EXPECT_TRUE(std::isinf(r.tolerances[0].until));
}

TEST_F(ChecksTest, EachFailsBeyondTheLimit) {
  add(scenario::CheckRequest::Kind::each, "knife.cut", "abs(length - 800) <= 0.2");
  start();
  cut(2 * second, 800.5);
  cut(3 * second, 800.0);
  const auto r = result();
  EXPECT_FALSE(r.passed);
  EXPECT_NEAR(*r.margin, -0.3, 1e-9);
  EXPECT_EQ(report::margin_text(r), "0.3 mm too far, at 2.0000 s");
  EXPECT_NEAR(*r.used, 2.5, 1e-9);
  EXPECT_EQ(r.detail, "2 knife.cut events, 1 failed, worst: length=800.5 mm; force=130 N");
}

TEST_F(ChecksTest, WhatFailsOftenTellsItsFirstTimeItsLastAndItsLastValue) {
  add(scenario::CheckRequest::Kind::each, "knife.cut", "abs(length - 800) <= 0.2");
  start();
  cut(2 * second, 800.5);
  cut(3 * second, 801);
  cut(4 * second, 800.3);
  cut(5 * second, 800);
  EXPECT_EQ(result().detail,
            "4 knife.cut events, 3 failed, first at 2.0000 s, last at 4.0000 s: length=800.3 mm, worst: "
            "length=801 mm; force=130 N");
}

TEST_F(ChecksTest, SoDoesAnAlwaysWithAMargin) {
  add(scenario::CheckRequest::Kind::always, "", "error < 100");
  start();
  sample(second, 500);
  sample(2 * second, 120);
  sample(3 * second, 20);
  EXPECT_EQ(result().detail, "3 instants, 2 failed, first at 1.0000 s, last at 2.0000 s: error=120 Um");
}

TEST_F(ChecksTest, EachWithoutAnEventFails) {
  add(scenario::CheckRequest::Kind::each, "cut", "length > 0");
  start();
  EXPECT_FALSE(result().passed);
  EXPECT_TRUE(result().tolerances.empty());
  EXPECT_FALSE(result().used);
  EXPECT_EQ(result().detail, "no cut between 0.0 s and 10.0 s, at least 1 expected");
}

TEST_F(ChecksTest, AllLooksAtStatistics) {
  add(scenario::CheckRequest::Kind::all, "cut", "abs(slope_length) * count <= 0.5 && mean_length > 800");
  start();
  for (int i = 0; i < 10; ++i) cut((i + 1) * second, 800 + 0.01 * i);
  const auto r = result();
  EXPECT_TRUE(r.passed);
  EXPECT_NEAR(*r.margin, 0.045, 1e-9);  // the mean is 800.045, the slope leaves 0.4
  EXPECT_THAT(r.detail, testing::StartsWith("10 cut events: mean_length=800.045 mm; slope_length=0.01 mm"));
}

TEST_F(ChecksTest, AlwaysFindsTheWorstInstantInItsWindow) {
  auto& check = add(scenario::CheckRequest::Kind::always, "", "error < 100");
  check.from = second;
  check.until = 3 * second;
  start();
  sample(0, 500);
  sample(second, 10);
  sample(2 * second, 60);
  sample(3 * second, 20);
  sample(4 * second, 500);
  const auto r = result();
  EXPECT_TRUE(r.passed);
  EXPECT_DOUBLE_EQ(*r.margin, 40);
  EXPECT_EQ(r.unit, "Um");
  EXPECT_DOUBLE_EQ(*r.at, 2.0);
}

TEST_F(ChecksTest, AlwaysWithoutMarginTellsTheFirstFailure) {
  add(scenario::CheckRequest::Kind::always, "", "error == 0 || error == 7");
  start();
  sample(second, 7);
  sample(2 * second, 3);
  sample(3 * second, 4);
  const auto r = result();
  EXPECT_FALSE(r.passed);
  EXPECT_FALSE(r.margin);
  EXPECT_DOUBLE_EQ(*r.at, 2.0);
  EXPECT_EQ(r.detail, "3 instants, 2 failed, first at 2.0000 s: error=3 Um, last at 3.0000 s: error=4 Um");
}

TEST_F(ChecksTest, EachWithoutMarginTellsTheFirstFailure) {
  add(scenario::CheckRequest::Kind::each, "cut", "length == 800 || force == 0");
  start();
  cut(2 * second, 800);
  cut(3 * second, 801);
  EXPECT_EQ(result().detail, "2 cut events, 1 failed, first at 3.0000 s: length=801 mm; force=130 N");
}

TEST_F(ChecksTest, AlwaysNeverLookedAtFails) {
  add(scenario::CheckRequest::Kind::always, "", "error < 100").from = 20 * second;
  start();
  sample(second, 0);
  EXPECT_FALSE(result().passed);
  EXPECT_EQ(result().detail, "never looked at: the run ended at 10.0 s");
}

TEST_F(ChecksTest, EventuallyTellsWhenAndTheTimeLeft) {
  add(scenario::CheckRequest::Kind::eventually, "", "error > 5").within = 3 * second;
  start();
  sample(second, 1);
  sample(2 * second, 6);
  sample(3 * second, 1);
  const auto r = result();
  EXPECT_TRUE(r.passed);
  EXPECT_DOUBLE_EQ(*r.at, 2.0);
  EXPECT_DOUBLE_EQ(*r.margin, 1.0);
  EXPECT_EQ(r.unit, "s");
  EXPECT_NEAR(*r.used, 2.0 / 3, 1e-12) << "of the time it had";
}

TEST_F(ChecksTest, EventuallyTooLateFails) {
  add(scenario::CheckRequest::Kind::eventually, "", "error > 5").within = second;
  start();
  sample(second, 1);
  sample(2 * second, 6);
  EXPECT_FALSE(result().passed);
  EXPECT_FALSE(result().used);
}

TEST_F(ChecksTest, EventuallyNeverTrueTellsTheValueAtTheEnd) {
  add(scenario::CheckRequest::Kind::eventually, "", "error == 7").within = 3 * second;
  start();
  sample(second, 1);
  sample(2 * second, 6);
  sample(4 * second, 7);  // too late
  const auto r = result();
  EXPECT_FALSE(r.passed);
  EXPECT_EQ(*r.at, 2.0);
  EXPECT_EQ(r.detail, "not true at any of 2 instants, the last at 2.0000 s: error=6 Um");
}

TEST_F(ChecksTest, RoundingNoiseIsPrintedAsZero) {
  add(scenario::CheckRequest::Kind::each, "cut", "length >= -1");
  start();
  cut(2 * second, -1.8e-12);
  EXPECT_EQ(result().detail, "1 cut event, worst: length=0 mm; force=130 N");
  EXPECT_EQ(record::values_text({0, 0, "a", "b", {{"slant", -1.8e-12, "mm"}, {"gap", 2e-9, "mm"}}, ""}),
            "slant=0 mm; gap=2e-09 mm");
  record::CheckResult noise;
  noise.margin = 1e-13;
  noise.unit = "mm";
  EXPECT_EQ(report::margin_text(noise), "0 mm left");
  noise.margin = -1e-13;
  EXPECT_EQ(report::margin_text(noise), "0 mm too far");
}

TEST_F(ChecksTest, NeverCountsEvents) {
  add(scenario::CheckRequest::Kind::never, "cut", "");
  start();
  EXPECT_TRUE(result().passed);
  cut(2 * second, 800);
  EXPECT_FALSE(result().passed);
  EXPECT_EQ(result().detail, "once, first at 2.0000 s: length=800 mm; force=130 N");
}

TEST_F(ChecksTest, NeverOfATimeThatDidNotComeFails) {
  add(scenario::CheckRequest::Kind::never, "cut", "");
  scenario.checks.back().from = 99 * second;
  start();
  EXPECT_FALSE(result().passed);
  EXPECT_THAT(result().detail, testing::StartsWith("never looked at: the run ended at "));
}

TEST_F(ChecksTest, UnknownNamesAreProblems) {
  add(scenario::CheckRequest::Kind::never, "tearr", "");
  add(scenario::CheckRequest::Kind::each, "cut", "lenght > 3");
  Checks bad(scenario, watch, names, events, problems);
  ASSERT_EQ(problems.size(), 2U);
  EXPECT_EQ(
      to_string(problems[0]),
      "line.yaml:3:4: nothing here reports an event 'tearr'; did you mean tear? [scenario.unknown-event]");
  EXPECT_EQ(problems[1].line, 5);
  EXPECT_EQ(problems[1].column, 6);
  EXPECT_THAT(problems[1].remedy, testing::HasSubstr("length"));
}

TEST(Statistics, AgreesWithClosedForms) {
  std::vector<double> line(101);
  for (size_t i = 0; i < line.size(); ++i) line[i] = 5 + 0.25 * static_cast<double>(i);
  const auto [mean, low, high, sd, slope, slope_error] = loop::statistics(line);
  EXPECT_DOUBLE_EQ(mean, 17.5);
  EXPECT_DOUBLE_EQ(low, 5);
  EXPECT_DOUBLE_EQ(high, 30);
  EXPECT_NEAR(sd, 0.25 * std::sqrt(101.0 * 102 / 12), 1e-12);
  EXPECT_NEAR(slope, 0.25, 1e-14);
  EXPECT_NEAR(slope_error, 0, 1e-7);
  EXPECT_EQ(loop::statistics({})[0], 0);
  EXPECT_EQ(loop::statistics({3})[3], 0);
}

TEST(Statistics, SlopeErrorOfAlternatingNoise) {
  // y = +-1: residual sum n(1 - small), closed form by hand for n = 4: slope -0.4, S = 4 - 0.8, error
  // sqrt(1.6/5).
  const auto s = loop::statistics({1, -1, 1, -1});
  EXPECT_NEAR(s[4], -0.4, 1e-15);
  EXPECT_NEAR(s[5], std::sqrt(3.2 / 2 / 5), 1e-15);
}

}  // namespace
}  // namespace drycut::sim::loop
