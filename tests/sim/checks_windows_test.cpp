// Statistics of channels in checks, on a machine with known signals: a counter of 1000 counts/s.
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <numbers>
#include <optional>

#include "sim/loop/simulation.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/studies/tune/metric.hpp"
#include "tests/test_folder.hpp"

namespace drycut::sim::loop {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

const std::string head = R"(scene: {duration: 3 s, step: 1 ms}
plants: {bench: {type: bench}}
timeline:
  - {at: 0 s, ramp: {bench.counter1.rate: 1000 1/s}, over: 1 ms}
  - {at: 0.5 s, every: 0.5 s, set: {bench.input1: 1}}
record: {every: 2 ms, channels: [bench.counter1.count, bench.counter1.rate]}
checks:
  - )";
const std::string sine = "5 * sin(_pi * bench.counter1.count / 500)";

struct Ran {
  record::CheckResult check;
  record::Recording recording;
  double metric = NAN;
};

/// `metric`: a limit of tune's, from 1.2 s on.
Ran run_file(
    const std::filesystem::path& file, const std::vector<scenario::Override>& set,
    const std::function<void(Simulation&)>& on_the_way = [](auto&) {}, studies::Metric* metric = nullptr) {
  constexpr Time from = 1200 * millisecond;
  Problems problems;
  const auto scenario = scenario::read_scenario(file, set, problems);
  Ran ran;
  if (problems.empty()) {
    loop::Simulation simulation(scenario, problems);
    if (problems.empty()) {
      std::optional<studies::MetricSteps> steps;
      if (metric != nullptr) steps.emplace(simulation, std::vector{metric}, from);
      ran.check = simulation.run([&](Time) { on_the_way(simulation); }).checks.front();
      ran.recording = simulation.take_recording();
      if (metric != nullptr) ran.metric = metric->value(ran.recording, from);
    }
  }
  for (const auto& problem : problems) ADD_FAILURE() << to_string(problem);
  return ran;
}

/// `on_the_way` comes every 2000 steps.
Ran run(
    const std::string& check, const std::string& step = "1 ms",
    const std::function<void(Simulation&)>& on_the_way = [](auto&) {}) {
  TestFolder folder;
  return run_file(folder.file("line.yaml", head + check + "\n"), {{"scene.step", step}}, on_the_way);
}

/// Steps of 1 ms, of which every so many is recorded.
Ran run_recorded(const std::string& check, const std::string& every, studies::Metric* metric = nullptr) {
  TestFolder folder;
  return run_file(
      folder.file("line.yaml", head + check + "\n"), {{"record.every", every}}, [](auto&) {}, metric);
}

std::string problem_of(const std::string& check) {
  Problems problems;
  TestFolder folder;
  const auto scenario = scenario::read_scenario(folder.file("line.yaml", head + check + "\n"), {}, problems);
  if (problems.empty()) {
    const loop::Simulation simulation(scenario, problems);
  }
  if (problems.empty()) return "";
  const auto& first = problems.front();
  return std::to_string(first.line) + ":" + std::to_string(first.column) + ": " + first.what + "; " +
         first.remedy;
}

TEST(ChecksOverWindows, RmsOfASineIsItsHeightByRootTwo) {
  const auto check = run("{name: a, always: rms(" + sine + ") <= 4, from: 1 s, until: 2.999 s}").check;
  EXPECT_TRUE(check.passed);
  EXPECT_NEAR(*check.margin, 4 - 5 / std::numbers::sqrt2, 1e-9);
  EXPECT_FALSE(check.at);
  EXPECT_EQ(check.detail, "1.0000 s to 2.9990 s: rms(" + sine + ")=3.53553");
  EXPECT_EQ(check.expectation,
            "always rms(" + sine + ") <= 4, from 1.0 s, until 2.999 s, at each step of 1 ms (1 kHz)");
}

// 20 ms apart the sine's record instants are not a whole number to a period of the window.
TEST(ChecksOverWindows, TheSameWhateverIsRecorded) {
  for (const std::string& text : std::vector<std::string>{
           "{name: a, always: \"rms(" + sine + ") <= 4 && p90(bench.counter1.count) < 1e9\", from: 1.21 s}",
           "{name: a, always: \"mean(" + sine + ") <= 4\", from: 1 s, every: 0.33 s}",
           "{name: a, each: set, expect: \"sd(" + sine + ") <= 4 && bench.counter1.count < 1e9\"}",
           "{name: a, eventually: max(bench.counter1.count) > 2000, every: 0.07 s}"}) {
    const auto often = run_recorded(text, "1 ms");
    const auto seldom = run_recorded(text, "20 ms");
    ASSERT_GT(often.recording.times().size(), 19 * (seldom.recording.times().size() - 1));
    EXPECT_TRUE(often.check.passed) << text << ": " << often.check.detail;
    EXPECT_EQ(often.check.detail, seldom.check.detail) << text;
    EXPECT_EQ(often.check.margin, seldom.check.margin) << text;
    EXPECT_EQ(often.check.at, seldom.check.at) << text;
    EXPECT_THAT(seldom.check.expectation, HasSubstr(", at each step of 1 ms (1 kHz)"));
  }
}

TEST(ChecksOverWindows, RmsOfATorqueSeesEveryStep) {
  TestFolder folder;
  const std::filesystem::path knife = std::filesystem::path(DRYCUT_SOURCE_DIR) / "scenes/rotary_knife.yaml";
  const auto file = folder.file("line.yaml", "extends: " + knife.string() + R"(
scene: {duration: 3 s}
checks:
  - {name: torque, always: rms(knife.motor.torque) <= 100 N m, from: 1 s}
)");
  const auto every_step = run_file(file, {{"record.every", "100 us"}});
  const auto usual = run_file(file, {{"record.every", "2 ms"}});
  double squares = 0;
  double count = 0;
  const auto& torque = every_step.recording.column("knife.motor.torque")->values;
  for (std::size_t row = 0; row < torque.size(); ++row) {
    if (every_step.recording.times()[row] < 1 * second) continue;
    squares += torque[row] * torque[row];
    ++count;
  }
  EXPECT_NEAR(count, 20001, 0.5);
  EXPECT_NEAR(*every_step.check.margin, 100 - std::sqrt(squares / count), 1e-9);
  EXPECT_EQ(usual.check.margin, every_step.check.margin);
  EXPECT_EQ(usual.check.detail, every_step.check.detail);
  EXPECT_THAT(usual.check.expectation, HasSubstr("at each step of 100 us (10 kHz)"));
}

TEST(ChecksOverWindows, PercentileOfARampIsThatShareOfIt) {
  const auto [check, recording, none] =
      run("{name: a, always: \"abs(p99(bench.counter1.count) - min(bench.counter1.count) - 990) <= 1\", "
          "from: 1 s, "
          "until: 2 s}");
  EXPECT_NEAR(*check.margin, 1, 1e-9);
}

// A live line looks all the time.
TEST(ChecksOverWindows, LookingOnTheWayChangesNothing) {
  for (const std::string& check : std::vector<std::string>{
           "{name: a, always: rms(" + sine + ") <= 4, from: 1 s, until: 2.5 s}",
           "{name: a, always: mean(bench.counter1.count) <= 1600}",
           "{name: a, always: max(bench.counter1.count) <= 2600, from: 0.5 s, every: 1 s}",
           "{name: a, eventually: min(bench.counter1.count) > 1000, every: 0.7 s}",
           "{name: a, all: set, expect: count >= 4}"}) {
    const auto unseen = run(check, "50 us").check;
    int looks = 0;
    const auto seen = run(check, "50 us", [&](Simulation& simulation) {
                        ++looks;
                        EXPECT_FALSE(simulation.outcome().checks.front().name.empty());
                      }).check;
    EXPECT_GT(looks, 10);
    EXPECT_TRUE(unseen.passed) << check << ": " << unseen.detail;
    EXPECT_EQ(seen.passed, unseen.passed) << check;
    EXPECT_EQ(seen.detail, unseen.detail) << check;
    EXPECT_EQ(seen.margin, unseen.margin) << check;
  }
}

TEST(ChecksOverWindows, PeriodsAreJudgedOneByOne) {
  const auto [check, recording, none] =
      run("{name: a, always: max(bench.counter1.count) <= 2600, from: 0.5 s, every: 1 s}");
  EXPECT_TRUE(check.passed);  // half a period is left at the end
  EXPECT_EQ(check.unit, "");
  EXPECT_THAT(check.detail,
              StartsWith("2 periods, worst: 1.5000 s to 2.5000 s: max(bench.counter1.count)=249"));
  EXPECT_EQ(*check.at, 2.5);
  EXPECT_EQ(
      check.expectation,
      "always max(bench.counter1.count) <= 2600, from 0.5 s, every 1.0 s, at each step of 1 ms (1 kHz)");
}

TEST(ChecksOverWindows, EventuallyIsTrueAtTheEndOfAPeriod) {
  const auto [check, recording, none] =
      run("{name: a, eventually: min(bench.counter1.count) >= 900, every: 0.5 s, within: 2 s}");
  EXPECT_TRUE(check.passed);
  EXPECT_EQ(check.detail, "first true at 1.5000 s");
  EXPECT_DOUBLE_EQ(*check.margin, 0.5);
}

TEST(ChecksOverWindows, ACycleGoesFromEventToEvent) {
  const auto [check, recording, none] =
      run("{name: a, each: set, from: 0.4 s, expect: max(bench.counter1.count) - min(bench.counter1.count) "
          "<= 500}");
  EXPECT_TRUE(check.passed);
  EXPECT_NEAR(*check.margin, 1, 1e-9);  // 500 steps, a count apart
  EXPECT_THAT(check.detail, StartsWith("4 cycles from set to set, worst: 0.5000 s to 1.0000 s: max("));
  EXPECT_EQ(*check.at, 1);
}

TEST(ChecksOverWindows, TooFewCyclesFail) {
  const auto [check, recording, none] =
      run("{name: a, each: set, from: 2.4 s, expect: rms(bench.counter1.rate) <= 1e9}");
  EXPECT_FALSE(check.passed);
  EXPECT_EQ(check.detail, "no cycle from set to set between 2.4 s and 3.0 s, at least 1 expected");
}

TEST(ChecksOverWindows, AWindowThatDidNotComeFails) {
  const std::string late = "{name: a, always: rms(bench.counter1.rate) < 3, from: 9 s}";
  EXPECT_THAT(problem_of(late), HasSubstr("the check 'a' begins at 9 s, and the run ends at 3 s"));
  Problems problems;
  TestFolder folder;
  const auto scenario = scenario::read_scenario(
      folder.file("line.yaml", head + "{name: a, always: rms(bench.counter1.rate) < 3, from: 2 s}\n"),
      {{"scene.duration", "1 s"}}, problems);
  loop::Simulation simulation(scenario, problems);
  ASSERT_THAT(problems, testing::IsEmpty()) << "who shortens a run knows";
  const auto check = simulation.run().checks.front();
  EXPECT_FALSE(check.passed);
  EXPECT_EQ(check.detail, "never looked at: the run ended at 1.0 s");
}

TEST(ChecksOverWindows, NumbersCarryUnits) {
  const auto [check, recording, none] =
      run("{name: a, always: rms(bench.counter1.rate) <= 90000 1/min, from: 1 s}");
  EXPECT_TRUE(check.passed);
  EXPECT_NEAR(*check.margin, 500, 1e-9);
  EXPECT_EQ(check.unit, "1/s");
  EXPECT_EQ(problem_of("{name: a, always: rms(bench.counter1.rate) <= 9 mm}"),
            "8:51: '9 mm' is a length, but 'rms(bench.counter1.rate)' is a frequency; write it in 1/s");
}

// The same terms everywhere: in a check, in `tune`, and by hand from what trace.csv holds.
TEST(ChecksOverWindows, EqualTheTermsOfTuneAndTheTrace) {
  for (const std::string term : {"rms(x)", "mean(x)", "sd(x)", "max(abs(x))", "p90(x)", "settling(x, 4.9)"}) {
    SCOPED_TRACE(term);
    auto own = term;
    own.replace(own.find('x', own.find('(') + (term.starts_with("max") ? 5 : 1)), 1, sine);
    const auto limit = own + " <= 7";
    const auto checked = "{name: a, always: \"" + limit + "\", from: 1.2 s}";
    std::vector<scenario::ExpressionFault> faults;
    auto metric = studies::Metric::compile(limit, studies::Metric::Kind::limit, {}, faults);
    ASSERT_TRUE(metric);
    const auto seldom = run_recorded(checked, "20 ms", &*metric);
    EXPECT_EQ(*seldom.check.margin, seldom.metric);
    auto of_recording = studies::Metric::compile(limit, studies::Metric::Kind::limit, {}, faults);
    const auto [check, recording, none] = run_recorded(checked, "1 ms");
    EXPECT_EQ(*check.margin, of_recording->value(recording, 1200 * millisecond));
    EXPECT_EQ(*check.margin, seldom.metric);
  }
  const auto [check, recording, none] =
      run_recorded("{name: a, always: \"rms(" + sine + ") <= 7\", from: 1.2 s}", "1 ms");
  double squares = 0;
  double count = 0;
  for (std::size_t row = 0; row < recording.times().size(); ++row) {
    if (recording.times()[row] < 1200 * millisecond) continue;
    const double x =
        5 * std::sin(std::numbers::pi * recording.column("bench.counter1.count")->values[row] / 500);
    squares += x * x;
    ++count;
  }
  EXPECT_NEAR(*check.margin, 7 - std::sqrt(squares / count), 1e-12);
}

}  // namespace
}  // namespace drycut::sim::loop
