// What services of repositories are told: junit.xml, GitHub's commands, GitLab's code quality, a summary.
#include "sim/cli/annotations.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <set>

#include "base/text.hpp"
#include "sim/cli/check_command.hpp"
#include "sim/cli/run_command.hpp"
#include "sim/cli/summary.hpp"
#include "tests/sim/command_bench.hpp"
#include "tests/sim/studies/tune/bench.hpp"

namespace drycut::sim::cli {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// The current folder for a test.
class In {
 public:
  explicit In(const fs::path& folder) : before_(fs::current_path()) { fs::current_path(folder); }
  ~In() { fs::current_path(before_); }
  In(const In&) = delete;
  In& operator=(const In&) = delete;

 private:
  fs::path before_;
};

struct ToldServices : CommandTest {
  ToldServices() : in(folder.path) {
    folder.file("axis.cnf", studies::tuning::configuration);
    folder.file("axis.mod", studies::tuning::program);
    options.out = "out";
    options.pictures = false;
  }
  /// A line whose check on the last line but one fails.
  fs::path failing(const std::string& name = "line.yaml", const std::string& check = "never, there") const {
    std::ofstream(folder / name) << studies::tuning::scenario
                                 << "checks:\n  - {name: moves, eventually: axis.position > 1}\n"
                                 << "  - {name: '" << check << "', always: axis.position > 1e6}\n\n";
    const auto text = content(folder / name);
    line = static_cast<int>(std::count(text.begin(), text.end(), '\n')) - 1;
    return name;
  }
  int run(const std::vector<fs::path>& scenarios) {
    options.scenarios = scenarios;
    return captured([&] { return run_scenarios(options); });
  }

  TestFolder folder;
  In in;
  RunOptions options;
  mutable int line = 0;
};

TEST(Annotations, EscapeAsTheRunnerOfGitHubReads) {
  const std::vector<Annotation> one = {
      {Annotation::Kind::check, {"a,b:c%.yaml", 3, 5}, "x, 50 %: y", "first\r\nsecond, 3: 50 %", ""}};
  EXPECT_EQ(
      github_text(one),
      "::error file=a%2Cb%3Ac%25.yaml,line=3,col=5,title=x%2C 50 %25%3A y::first%0D%0Asecond, 3: 50 %25\n");
  EXPECT_EQ(github_text({}), "");
}

TEST(Annotations, FingerprintsLastAndAreTheirOwn) {
  const Annotation check{Annotation::Kind::check, {"a.yaml", 3, 5}, "s: c", "7 mm too far", "s: c"};
  auto moved = check;
  moved.place.line = 9;
  moved.message = "8 mm too far";
  auto other = check;
  other.lasting = "s: d";
  const auto of = [](const std::vector<Annotation>& all) { return nlohmann::json::parse(gitlab_text(all)); };
  EXPECT_EQ(of({check})[0]["fingerprint"], of({moved})[0]["fingerprint"]);
  const auto all = of({check, moved, other});
  std::set<std::string> different;
  for (const auto& finding : all) different.insert(finding["fingerprint"].get<std::string>());
  EXPECT_EQ(different.size(), 3U);
  EXPECT_EQ(all[1]["location"], nlohmann::json::parse(R"({"path": "a.yaml", "lines": {"begin": 9}})"));
  EXPECT_EQ(all[1]["description"], "s: c: 8 mm too far");
  EXPECT_EQ(all[1]["severity"], "major");
  EXPECT_EQ(all[1]["check_name"], "drycut-check");
  EXPECT_EQ(of({}), nlohmann::json::array());
}

TEST_F(ToldServices, GitHubHearsOfAFailedCheckAtItsLine) {
  options.annotate = "github";
  EXPECT_EQ(run({failing()}), check_failed);
  EXPECT_THAT(out, HasSubstr(fmt::format(
                       "\n::error file=line.yaml,line={},col=13,title=line%3A never%2C there::", line)));
  // The same for a path that is not written the short way, from the repository on.
  EXPECT_EQ(run({fs::current_path() / "./line.yaml"}), check_failed);
  EXPECT_THAT(out, HasSubstr("\n::error file=line.yaml,line="));
  options.annotate = "";
  EXPECT_EQ(run({"line.yaml"}), check_failed);
  EXPECT_THAT(out, Not(HasSubstr("::error")));
}

TEST_F(ToldServices, GitHubHearsOfBadInput) {
  options.annotate = "github";
  std::ofstream("bad.yaml") << "scene: {title: A, stepp: 1 ms}\n";
  EXPECT_EQ(run({"bad.yaml"}), bad_input);
  EXPECT_THAT(out, HasSubstr("::error file=bad.yaml,line=1,col=19,title=drycut%3A bad input::"));
  EXPECT_THAT(err, HasSubstr("bad.yaml:1:19: "));
  EXPECT_FALSE(fs::exists("out"));
}

TEST_F(ToldServices, ProblemsThatCheckFindsAreToldToo) {
  std::ofstream("bad.st") << "PROGRAM p\nx := 1;\nEND_PROGRAM\n";
  CheckOptions check;
  check.files = {"bad.st"};
  check.annotate = "github";
  EXPECT_EQ(captured([&] { return check_files(check); }), bad_input);
  EXPECT_THAT(out, HasSubstr("::error file=bad.st,line=2,col=1,title=drycut%3A bad input::"));
  check.annotate = "gitlab";
  EXPECT_EQ(captured([&] { return check_files(check); }), bad_input);
  EXPECT_EQ(out, "");
  EXPECT_EQ(nlohmann::json::parse(content(gitlab_file))[0]["location"]["path"], "bad.st");
}

TEST_F(ToldServices, GitLabHasAFileOfBoth) {
  options.annotate = "gitlab";
  EXPECT_EQ(run({failing()}), check_failed);
  const auto findings = nlohmann::json::parse(content(gitlab_file));
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0]["location"]["lines"]["begin"], line);
  EXPECT_EQ(findings[0]["location"]["path"], "line.yaml");
  EXPECT_THAT(findings[0]["description"].get<std::string>(), testing::StartsWith("line: never, there: "));
  std::ofstream("bad.yaml") << "scene: {title: A, stepp: 1 ms}\n";
  EXPECT_EQ(run({"bad.yaml"}), bad_input);
  EXPECT_EQ(nlohmann::json::parse(content(gitlab_file))[0]["check_name"], "drycut-input");
  std::ofstream("good.yaml") << studies::tuning::scenario;
  EXPECT_EQ(run({"good.yaml"}), all_passed) << err;
  EXPECT_EQ(content(gitlab_file), "[]\n") << "what was told before is over";
}

// A member of a check that people are to be told needs no word in the program but its key.
TEST_F(ToldServices, MembersOfACheckAreToldAsTheyStand) {
  auto check = record::json_of(record::CheckResult());
  for (const auto key : record::CheckResult::told()) EXPECT_TRUE(check.contains(key)) << key;
  check.update(
      {{"cuts", 15}, {"late_by", 0.25}, {"forced", true}, {"unsure", false}, {"of", nullptr}, {"by", "x"}});
  const auto told = report::told_of(check, {"cuts", "late_by", "forced", "unsure", "of", "by"});
  EXPECT_EQ(told, "cuts 15; late by 0.25; forced; by x");
}

TEST_F(ToldServices, JunitHasPlacesTimesPropertiesAndTheReport) {
  options.seed = 7;
  options.pictures = true;
  EXPECT_EQ(run({failing("line.yaml", "a < b")}), check_failed);
  const auto xml = content("out/junit.xml");
  EXPECT_THAT(xml,
              AllOf(HasSubstr("  <testsuite name=\"line\" tests=\"3\" failures=\"1\" errors=\"0\" time=\""),
                    HasSubstr("<property name=\"seed\" value=\"7\"/>"),
                    HasSubstr("<property name=\"drycut\" value=\"0."),
                    HasSubstr("<property name=\"scenario\" value=\"line.yaml\"/>"),
                    HasSubstr("<property name=\"duration\" value=\"")));
  EXPECT_THAT(xml, HasSubstr(fmt::format("name=\"a &lt; b\" time=\"")));
  EXPECT_THAT(xml, HasSubstr(fmt::format("file=\"line.yaml\" line=\"{}\">\n      <failure ", line)));
  const std::string attached = "<system-out>[[ATTACHMENT|out/line/report.html]]</system-out>\n";
  EXPECT_THAT(xml, HasSubstr("</failure>\n      " + attached + "    </testcase>"));
  EXPECT_THAT(xml, HasSubstr("    " + attached + "  </testsuite>"));
  // Times of the cases add up to that of the suite.
  double sum = 0;
  double suite = 0;
  for (auto at = xml.find(" time=\""); at != std::string::npos; at = xml.find(" time=\"", at + 1))
    (suite == 0 ? suite : sum) += std::stod(xml.substr(at + 7));
  EXPECT_GT(suite, 0);
  EXPECT_NEAR(sum, suite, 1e-5);
}

TEST_F(ToldServices, TheSummarySaysWhatFailedAndShowsPictures) {
  options.pictures = true;
  options.summary = "out/summary.md";
  std::ofstream("good.yaml") << studies::tuning::scenario
                             << "checks: [{name: moves, eventually: axis.position > 1}]\n";
  EXPECT_EQ(run({"good.yaml", failing("line.yaml", "a|b <c>")}), check_failed) << err;
  const auto text = content("out/summary.md");
  EXPECT_THAT(text, testing::StartsWith(
                        "## Drycut: 1 of 2 scenes failed\n\n| scene | verdict | checks | simulated |\n"));
  EXPECT_THAT(
      text, AllOf(HasSubstr("| [good](good/report.html) | passed | 2 of 2 | "),
                  HasSubstr("| [line](line/report.html) | **FAILED** | 2 of 3 | "), HasSubstr("\n### line\n"),
                  HasSubstr("| a\\|b \\<c\\> | always "), HasSubstr(fmt::format(" | line.yaml:{} |\n", line)),
                  HasSubstr("(line/plots/"), HasSubstr("<details><summary>line: pictures</summary>\n")));
  EXPECT_EQ(run({"good.yaml"}), all_passed) << err;
  EXPECT_THAT(content("out/summary.md"), testing::StartsWith("## Drycut: the one scene passed\n"));
}

TEST_F(ToldServices, ASummaryThatLiesElsewhereHasNoLinksUnlessToldWhere) {
  fs::create_directories("else/where");
  std::ofstream("good.yaml") << studies::tuning::scenario;
  options.pictures = true;
  options.summary = "else/where/step.md";
  EXPECT_EQ(run({"good.yaml"}), all_passed) << err;
  EXPECT_THAT(content(options.summary), AllOf(HasSubstr("| good | passed |"), Not(HasSubstr("]("))));
  options.links = "https://host/page";
  EXPECT_EQ(run({"good.yaml"}), all_passed) << err;
  EXPECT_THAT(content(options.summary), HasSubstr("[good](https://host/page/good/report.html)"));
}

TEST_F(ToldServices, AFailedRunTellsWhatItsAxisWarnedOf) {
  folder.file("axis.mod", std::string("START AxisX\nWAIT 1\n") + studies::tuning::program);
  options.annotate = "github";
  EXPECT_EQ(run({failing()}), check_failed) << err;
  EXPECT_THAT(out,
              HasSubstr("\n::warning file=line.yaml,line=1,col=1,title=line%3A alarm of AxisX::AxisX at "));
  EXPECT_THAT(content("out/junit.xml"),
              AllOf(HasSubstr("    <system-err>AxisX at "), HasSubstr("START: st_init is 0")));
  options.annotate = "gitlab";
  EXPECT_EQ(run({failing()}), check_failed) << err;
  const auto findings = nlohmann::json::parse(content(gitlab_file));
  EXPECT_EQ(findings.back()["severity"], "minor");
  EXPECT_EQ(findings.back()["check_name"], "drycut-warning");
}

TEST(SummaryLinks, GoFromTheFileToTheResults) {
  EXPECT_EQ(links_from("out/summary.md", "out", ""), "");
  EXPECT_EQ(links_from("summary.md", "out/", ""), "out/");
  EXPECT_EQ(links_from("summary.md", "./a b/out", ""), "a%20b/out/");
  EXPECT_EQ(links_from("docs/summary.md", "out", ""), std::nullopt);
  EXPECT_EQ(links_from("/tmp/summary.md", "out", "https://x/"), "https://x/");
}

TEST_F(ToldServices, TheSummarySaysWhyNothingWasRun) {
  options.summary = "step.md";
  std::ofstream("line.yaml") << "scene: {title: a|b, step: 1 ms}\nplants: {web: {type: weh}}\n";
  EXPECT_EQ(run({"line.yaml"}), bad_input);
  EXPECT_THAT(content("step.md"),
              AllOf(testing::StartsWith("## Drycut: nothing was run, a thing is wrong\n\n- line"),
                    HasSubstr("unknown plant type 'weh'")));
}

TEST_F(ToldServices, ASummaryThatCannotBeWrittenIsToldBeforeTheRun) {
  options.summary = "nowhere/summary.md";
  EXPECT_EQ(run({failing()}), bad_input);
  EXPECT_THAT(err, HasSubstr("--summary:1:1: there is no directory nowhere; "));
  options.summary = "line.yaml";
  EXPECT_EQ(run({"line.yaml"}), bad_input);
  EXPECT_THAT(err, HasSubstr("--summary:1:1: line.yaml is the scenario itself; "));
  EXPECT_FALSE(fs::exists("out/line"));
}

}  // namespace
}  // namespace drycut::sim::cli
