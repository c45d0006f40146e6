// A scene that runs several scenarios and compares them: what it writes, its figures, its checks, what it
// refuses.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "sim/cli/check_command.hpp"
#include "sim/cli/run_command.hpp"
#include "sim/cli/tune_command.hpp"
#include "sim/studies/compare/run_folder.hpp"
#include "sim/studies/compare/scene.hpp"
#include "tests/sim/studies/compare/bench.hpp"
#include "tests/sim/studies/tune/bench.hpp"

namespace drycut::sim::studies::comparing {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Two runs of one axis: feed-forward 1000 leaves no following error, 900 some.
const std::string two = R"yaml(scene: {title: Two gains}
compare:
  scenarios:
    - name: good
      scenario: axis.yaml
      set: {controller.qmove.set.AxisX.feedfw: 1000}
      channels:
        error: {of: AxisX.follerr * 0.0025, unit: mm}
    - name: bad
      scenario: axis.yaml
      channels:
        error: {of: AxisX.follerr * 0.0025, unit: mm}
  from: 100 ms
  figures:
    - {name: largest, title: largest error, of: max(abs(error)), unit: mm}
    - {name: rest, of: "mean(AxisX.follerr)",
                  unit : bits x4
}
  plots:
    - {name: errors, title: Following, panels: [{title: error, channels: [error]}]}
checks:
  - {name: the good one follows, expect: good.largest <= bad.largest / 10}
  - {name: both run, expect: good.passed + bad.passed == 2}
)yaml";

struct CompareScene : CommandTest {
  CompareScene() {
    test_folder.file("axis.cnf", tuning::configuration);
    test_folder.file("axis.mod", tuning::program);
    test_folder.file("axis.yaml", tuning::scenario);
    options.pictures = false;
  }
  int run(const std::string& scene, const std::string& to = "out") {
    options.scenarios = {test_folder.file("two.yaml", scene)};
    options.out = folder / to;
    return captured([&] { return cli::run_scenarios(options); });
  }
  int check(const std::string& scene, bool expanded = false) {
    const cli::CheckOptions checked{{test_folder.file("two.yaml", scene)}, expanded};
    return captured([&] { return cli::check_files(checked); });
  }
  /// Both commands refuse the scene with this message, and nothing is written.
  void refuses(const std::string& scene, const std::string& message) {
    const auto told = (folder / "two.yaml").string() + ":" + message;
    EXPECT_EQ(run(scene), cli::bad_input) << out;
    EXPECT_THAT(err, HasSubstr(told));
    EXPECT_EQ(check(scene), cli::bad_input);
    EXPECT_THAT(err, HasSubstr(told));
    EXPECT_FALSE(fs::exists(folder / "out"));
  }
  ComparedRun read(const std::string& member) const {
    Problems problems;
    auto made = read_run(folder / "out/two" / member, problems);
    EXPECT_TRUE(problems.empty());
    return made;
  }

  TestFolder test_folder;
  const fs::path& folder = test_folder.path;
  cli::RunOptions options;
};

TEST_F(CompareScene, MembersRunInFoldersOfTheirOwn) {
  EXPECT_EQ(run(two), cli::all_passed) << err << out;
  EXPECT_THAT(out, HasSubstr("two/good: passed, the one check passed"));
  EXPECT_THAT(out, HasSubstr("two: passed, all 2 checks passed"));
  for (const auto* name : {"good/trace.csv", "bad/scenario.yaml", "comparison.csv"})
    EXPECT_TRUE(fs::exists(folder / "out/two" / name)) << name;
  const auto xml = content(folder / "out/junit.xml");
  EXPECT_THAT(xml, HasSubstr("<testsuite name=\"two/bad\" tests=\"1\""));
  EXPECT_THAT(xml, HasSubstr("<testsuite name=\"two\" tests=\"2\" failures=\"0\" errors=\"0\" "));
  const auto line =
      1 + std::count(two.begin(), two.begin() + static_cast<long>(two.find("{name: both run")), '\n');
  EXPECT_THAT(xml, HasSubstr(fmt::format(
                       "<testcase classname=\"two\" name=\"both run\" time=\"0.500000\" file=\"{}\" "
                       "line=\"{}\"/>",
                       (test_folder / "two.yaml").string(), line)));
  EXPECT_EQ(*read("good").parameter("controller.qmove.set.AxisX.feedfw"), "1000");
  EXPECT_EQ(*read("bad").parameter("controller.qmove.set.AxisX.feedfw"), "900");
}

TEST_F(CompareScene, MembersDifferInVariables) {
  test_folder.file("axis.yaml", "variables: {lead: 900}\n" +
                                    with(tuning::scenario, "AxisX.feedfw: 900", "AxisX.feedfw: \"${lead}\""));
  const auto scene = with(two, "controller.qmove.set.AxisX.feedfw: 1000", "variables.lead: 1000");
  refuses(with(scene, "variables.lead", "variables.laed"),
          "6:29: there is no 'laed' in variables; did you mean lead?");
  EXPECT_EQ(run(scene), cli::all_passed) << err << out;
  EXPECT_EQ(*read("good").parameter("variables.lead"), "1000");
  EXPECT_EQ(*read("bad").parameter("variables.lead"), "900");
  EXPECT_EQ(*read("good").parameter("controller.qmove.set.AxisX.feedfw"), "1000");
  EXPECT_EQ(*read("bad").parameter("controller.qmove.set.AxisX.feedfw"), "900");
}

TEST_F(CompareScene, FiguresAreThoseOfTheTraces) {
  ASSERT_EQ(run(two), cli::all_passed) << err;
  const auto bad = read("bad");
  const auto& errors = bad.recording.column("AxisX.follerr")->values;
  double largest = 0;
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    if (bad.recording.times()[i] < 100 * millisecond) continue;
    largest = std::max(largest, std::abs(errors[i]) * 0.0025);
    sum += errors[i];
    ++count;
  }
  ASSERT_GT(largest, 0.1);
  const auto csv = content(folder / "out/two/comparison.csv");
  const auto begin = csv.find("figure,largest error,mm,");
  ASSERT_NE(begin, std::string::npos) << csv;
  double good = -1;
  double told = -1;
  double mean = -1;
  ASSERT_EQ(sscanf(csv.c_str() + begin, "figure,largest error,mm,%lf,%lf", &good, &told), 2);
  EXPECT_NEAR(told, largest, 1e-8);
  EXPECT_LT(good, largest / 10);
  ASSERT_EQ(sscanf(csv.c_str() + csv.find("figure,rest,"), "figure,rest,bits x4,%*f,%lf", &mean), 1);
  EXPECT_NEAR(mean, sum / count, 1e-6 * std::abs(mean));
}

TEST_F(CompareScene, AFailedCheckOfItsOwnIsStatusOneWithItsNumbers) {
  options.pictures = true;
  EXPECT_EQ(run(with(two, "bad.largest / 10", "bad.largest / 1e9 - 0.5")), cli::check_failed);
  EXPECT_THAT(out, HasSubstr("two: FAILED, 1 of 2 checks failed"));
  EXPECT_THAT(
      out, testing::ContainsRegex("FAIL the good one follows: good.largest=.* mm; bad.largest=.* mm; .* mm "
                                  "too far"));
  EXPECT_THAT(
      content(folder / "out/two/report.html"),
      HasSubstr(
          "<strong>FAIL</strong> <span>every run passed, 1 of the comparison&#39;s own 2 checks failed"));
}

TEST_F(CompareScene, AFigureWithoutAValueSaysSo) {
  EXPECT_EQ(run(with(two, "from: 100 ms", "from: 1000 s")), cli::check_failed);
  EXPECT_THAT(out, HasSubstr("FAIL the good one follows: good.largest has no value in the time looked at; "
                             "bad.largest has no value in the time looked at"));
  EXPECT_THAT(out, Not(HasSubstr("nan")));
}

TEST_F(CompareScene, AFailedMemberFailsTheScene) {
  test_folder.file("axis.yaml", std::string(tuning::scenario) +
                                    "checks: [{name: still, always: abs(AxisX.follerr) < 100}]\n");
  EXPECT_EQ(run(with(two, "  - {name: both run, expect: good.passed + bad.passed == 2}\n", "")),
            cli::check_failed);
  EXPECT_THAT(out, HasSubstr("two/bad: FAILED"));
  EXPECT_THAT(out, HasSubstr("two: passed")) << "its own check holds";
}

TEST_F(CompareScene, TheReportShowsFiguresChecksAndTheOverlay) {
  options.pictures = true;
  ASSERT_EQ(run(two), cli::all_passed) << err;
  const auto page = content(folder / "out/two/report.html");
  EXPECT_THAT(page, HasSubstr("<strong>PASS</strong> <span>every run passed, and so did the comparison"));
  EXPECT_THAT(page, HasSubstr("<h1>Two gains</h1>"));
  EXPECT_THAT(page, HasSubstr("<td>largest error</td>"));
  EXPECT_THAT(page, HasSubstr("good.largest &lt;= bad.largest / 10"));
  EXPECT_TRUE(fs::exists(folder / "out/two/plots/errors.png"));
  EXPECT_TRUE(fs::exists(folder / "out/two/good/report.html"));
}

TEST_F(CompareScene, SameBytesAtAnyNumberOfJobs) {
  options.pictures = true;
  ASSERT_EQ(run(two, "one"), cli::all_passed);
  options.jobs = 2;
  ASSERT_EQ(run(two, "other"), cli::all_passed);
  for (const auto* name : {"two/report.html", "two/comparison.csv", "two/bad/trace.csv", "junit.xml"}) {
    const auto first = content(folder / "one" / name);
    EXPECT_FALSE(first.empty()) << name;
    auto second = content(folder / "other" / name);
    // junit.xml says where the reports are.
    for (auto at = second.find("/other/two/"); at != std::string::npos; at = second.find("/other/two/", at))
      second.replace(at, 7, "/one/");
    EXPECT_TRUE(first == second) << name;
  }
}

TEST_F(CompareScene, SettingsOfTheCommandLineReachEveryMember) {
  options.set = {"scene.duration=500 ms"};
  ASSERT_EQ(run(two), cli::all_passed) << err;
  EXPECT_EQ(read("good").outcome.end, 500 * millisecond);
  EXPECT_EQ(read("bad").outcome.end, 500 * millisecond);
  options.set = {"scene.durations=500 ms"};
  EXPECT_EQ(run(two), cli::bad_input);
  EXPECT_THAT(err, HasSubstr("--set scene.durations:1:1: unknown key 'durations'"));
}

TEST_F(CompareScene, ExpandReadsBackAsItself) {
  const auto more =
      with(two, "checks:\n",
           "    - {name: step, around: \"state[2]\", before: 5 ms, panels: [{channels: [error]}]}\n"
           "checks:\n");
  Problems problems;
  const auto first = read_comparison(test_folder.file("first.yaml", more), problems);
  ASSERT_TRUE(first && problems.empty());
  const auto text = expand(*first);
  EXPECT_THAT(text, HasSubstr("around: \"state[2]\"\n      before: 5 ms\n      after: 100 ms\n"));
  const auto second = read_comparison(test_folder.file("second.yaml", text), problems);
  ASSERT_TRUE(second && problems.empty()) << text << (problems.empty() ? "" : to_string(problems[0]));
  EXPECT_EQ(expand(*second), text);
  ASSERT_EQ(check(two, true), cli::all_passed) << err;
  EXPECT_THAT(out, HasSubstr("controller.qmove.set.AxisX.feedfw: 1000"));
}

TEST_F(CompareScene, OtherCommandsSayThatItIsNoScenario) {
  cli::TuneOptions tune;
  tune.scenarios = {test_folder.file("two.yaml", two)};
  tune.vary = {"controller.qmove.set.AxisX.pgain=1..2"};
  tune.minimise = "rms(AxisX.follerr)";
  tune.out = folder / "tune";
  EXPECT_EQ(captured([&] { return cli::tune_scenarios(tune); }), cli::bad_input);
  EXPECT_THAT(err, HasSubstr("two.yaml:2:1: this scene compares scenarios and is none itself; "));
}

TEST_F(CompareScene, WhatItsMembersCannotGiveIsRefused) {
  refuses(with(two, "of: max(abs(error))", "of: max(abs(errors))"),
          "15:57: good does not record errors; record it in axis.yaml");
  refuses(with(two, "of: max(abs(error))", "of: max(abs(error) - 1 s)"),
          "15:66: '1 s' is a time, but 'abs(error)' is a length; write it in mm");
  refuses(with(two, "mean(AxisX.follerr)", "mean(mean(AxisX.follerr))"), "16:30: mean inside mean; ");
  refuses(with(two, "channels: [error]", "channels: [axis.speed]"),
          "20:75: good does not record axis.speed; ");
  refuses(with(two, "of: AxisX.follerr * 0.0025", "of: AxisX.foller * 0.0025"),
          "8:21: good: unknown name 'AxisX.foller'; did you mean AxisX.follerr?");
  refuses(with(two, "        error: {", "        axis.position: {"),
          "8:9: compare.scenarios.good.channels: 'axis.position' is no name");
  refuses(with(two, "bad.largest / 10", "bad.larges / 10"),
          "22:58: unknown name 'bad.larges'; did you mean bad.largest?");
  refuses(with(two, "channels: [error]", "event: cut, values: [length]"),
          "20:85: good has no event cut with a value length; ");
  refuses(with(two, "scenario: axis.yaml\n      set", "scenario: axes.yaml\n      set"),
          "5:17: there is no file ");
  refuses(with(two, "feedfw: 1000", "feedfww: 1000"),
          "6:49: the controller has nothing called 'AxisX.feedfww'");
}

TEST_F(CompareScene, WhatIsWrongInItselfIsRefused) {
  refuses(with(two, "name: bad", "name: good"), "9:13: there are two runs named 'good'; ");
  refuses(with(two, "name: good", "name: too-good"),
          "4:13: compare.scenarios.0: 'too-good' is no name for an expression; ");
  refuses(
      with(two, "name: good", "name: plots"),
      "4:13: compare.scenarios.0: 'plots' is the folder of the comparison's own plots; give the run another "
      "name");
  refuses(with(two, "name: rest", "name: largest"), "16:14: there are two figures named 'largest'; ");
  refuses(with(two, "{name: both run", "{name: the good one follows"), "23:12: there are two checks named");
  refuses(with(two, "compare:", "plants: {}\ncompare:"), "2:1: unknown key 'plants'; ");
  refuses(with(two, "  from: 100 ms", "  form: 100 ms"),
          "13:3: unknown key 'form' in compare; did you mean from?");
  refuses(with(two, "of: max(abs(error)), ", ""), "15:7: compare.figures.largest.of is missing; ");
  refuses("compare: {scenarios: [axis.yaml]}\n", "1:11: compare.scenarios needs two scenarios at least; ");
  refuses(with(two, "channels: [error]", "x: error, y: error"),
          "20:7: compare.plots.errors: a path, a histogram or a motor is not overlaid; ");
  refuses(with(two, "title: Following,", "around: step, from: 1 s,"),
          "20:42: compare.plots.errors.from does not go with around; ");
}

TEST_F(CompareScene, AMemberMustBeAScenario) {
  test_folder.file("other.yaml", two);
  EXPECT_EQ(run("compare: {scenarios: [axis.yaml, other.yaml]}\n"), cli::bad_input);
  EXPECT_THAT(err, HasSubstr("other.yaml:2:1: this scene compares scenarios and is none itself; "));
  EXPECT_THAT(err, Not(HasSubstr("axis.yaml:")));
}

}  // namespace
}  // namespace drycut::sim::studies::comparing
