// The page over many runs: what it finds, what it says of each, that it can be sorted and moved.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "sim/cli/index_command.hpp"
#include "sim/cli/run_command.hpp"
#include "sim/record/json.hpp"
#include "sim/report/index.hpp"
#include "tests/sim/command_bench.hpp"

namespace drycut::sim::report {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

struct Index : CommandTest {
  void write(const std::string& name, const std::string& text) const {
    fs::create_directories((folder / name).parent_path());
    folder.file(name, text);
  }
  void verdict(const std::string& name, const record::Verdict& verdict) const {
    write(name + "/verdict.json", json_text(record::json_of(verdict)));
  }
  /// The folder of a run as drycut run leaves it, whose checks ended so.
  void run(const std::string& name, const std::vector<bool>& checks, bool pictures = true) const {
    record::Outcome outcome;
    outcome.end = 12'500 * millisecond;
    for (const bool passed : checks) {
      auto& check = outcome.checks.emplace_back();
      check.name = fmt::format("check {}", outcome.checks.size());
      check.passed = passed;
    }
    auto came = record::verdict_of(outcome);
    came.kind = "run";
    came.title = "The <line> & more";
    write(name + "/.drycut-run", "checks.json\n");
    verdict(name, came);
    write(name + "/trace.csv", "time [s]\n");
    if (!pictures) return;
    write(name + "/report.html", "<title>FAIL: no page is read</title>");
    for (const auto* frame : {"0001", "0002", "0003"}) write(name + "/frames/" + frame + ".png", "x");
    write(name + "/plots/motion.png", "x");
  }
  void study(const std::string& name, const record::Verdict& came) const {
    write(name + "/.drycut-" + came.kind, "report.html\n");
    verdict(name, came);
    write(name + "/report.html", "<title>PASS: no page is read</title>");
    write(name + "/plots/map.png", "x");
  }
  int index() {
    return captured([&] { return cli::index_folder(folder.path); });
  }
  std::string page() const { return content(folder / "index.html"); }
  TestFolder folder;
};

TEST_F(Index, FindsWhatDrycutWroteAndNothingElse) {
  run("b", {true});
  run("a", {true, false});
  run("three/LX3VP", {true});  // a member
  record::Verdict compared;
  compared.kind = "compare";
  compared.judge(false);
  study("three", compared);
  record::Verdict swept;
  swept.kind = "sweep";
  swept.word = "36";
  swept.title = "Sweep of <it>";
  swept.sentence = "all < 1";
  study("sweep", swept);
  run("night/one", {true});
  write("night/.drycut-runs", "junit.xml\n");
  run("mine/one", {true});  // nobody wrote into mine
  write("frames/.keep", "");
  fs::create_directory_symlink(folder / "a", folder / "z");
  const auto entries = index_entries(folder.path);
  std::vector<std::string> found;
  for (const auto& entry : entries) found.push_back(entry.kind + " " + entry.name);
  EXPECT_THAT(found, ElementsAre("run a", "run b", "run night/one", "sweep sweep", "compare three",
                                 "run three/LX3VP"));
  EXPECT_EQ(entries[0].word, "FAIL");
  EXPECT_EQ(entries[0].verdict, "1 of 2 checks failed: check 2");
  EXPECT_EQ(entries[0].title, "The <line> & more");
  EXPECT_EQ(entries[0].simulated, 12.5);
  EXPECT_EQ(entries[0].page, "a/report.html");
  EXPECT_EQ(entries[0].picture, "a/frames/0002.png") << "from the middle of the film";
  EXPECT_EQ(entries[1].verdict, "1 check passed");
  EXPECT_EQ(entries[3].word, "36");
  EXPECT_EQ(entries[3].title, "Sweep of <it>");
  EXPECT_EQ(entries[3].verdict, "all < 1");
  EXPECT_THAT(
      index_page(entries),
      HasSubstr("<span>1 of 4 runs failed; 1 of 1 comparison or study failed; 1 judges nothing</span>"));
  EXPECT_EQ(entries[3].picture, "sweep/plots/map.png");
  EXPECT_EQ(entries[4].word, "FAIL");
}

TEST_F(Index, ARunWithoutPicturesLeadsToItsTrace) {
  run("a", {true}, false);
  const auto entries = index_entries(folder.path);
  ASSERT_EQ(entries.size(), 1U);
  EXPECT_EQ(entries[0].page, "a/trace.csv");
  EXPECT_EQ(entries[0].picture, "");
  EXPECT_THAT(index_page(entries), Not(HasSubstr("<img")));
}

TEST_F(Index, AStudyWithoutAPageLeadsToItsTable) {
  write("compare/.drycut-compare", "comparison.csv\n");
  write("compare/comparison.csv", "what\n");
  write("cam/.drycut-design", "design.png\n");
  write("cam/design.png", "x");
  const auto entries = index_entries(folder.path);
  ASSERT_EQ(entries.size(), 2U);
  EXPECT_EQ(entries[0].picture, "cam/design.png");
  EXPECT_EQ(entries[1].page, "compare/comparison.csv");
}

TEST_F(Index, ThePageLinksRelativelyAndEscapes) {
  run("a b#1", {false});
  ASSERT_EQ(index(), cli::all_passed) << err;
  EXPECT_THAT(out, HasSubstr("1 folder of results, 1 of 1 run failed: "));
  EXPECT_THAT(page(),
              HasSubstr("<p class=\"verdict fail\"><strong>FAIL</strong> <span>1 of 1 run failed</span>"));
  EXPECT_THAT(page(), HasSubstr("<a href=\"a%20b%231/report.html\">a b#1</a>"));
  EXPECT_THAT(page(), HasSubstr("The &lt;line&gt; &amp; more"));
  EXPECT_THAT(page(), HasSubstr("alt=\"The machine of a b#1\" src=\"a%20b%231/frames/0002.png\""));
  EXPECT_THAT(page(), HasSubstr("<span class=\"badge fail\">FAIL</span> 1 of 1 checks failed: check 1"));
  EXPECT_THAT(page(), Not(HasSubstr("http"))) << "no network";
  EXPECT_THAT(page(), Not(HasSubstr(folder.path.string()))) << "it can be moved with its folders";
}

TEST_F(Index, ThreeOfManyFailedChecksAreNamed) {
  run("a", {false, false, true, false, false});
  EXPECT_EQ(index_entries(folder.path)[0].verdict,
            "4 of 5 checks failed: check 1, check 2, check 4 and 1 more");
}

TEST_F(Index, WhatCannotBeReadIsNotJudged) {
  for (const auto* broken : {"{", "[]", R"({"verdict": true})", R"({"kind": "run", "exit": "0"})"}) {
    run("a", {true});
    write("a/verdict.json", broken);
    const auto entries = index_entries(folder.path);
    EXPECT_FALSE(entries[0].came) << broken;
    EXPECT_THAT(index_page(entries), HasSubstr("<strong>RUNS</strong> <span>nothing is judged</span>"));
  }
}

TEST_F(Index, WordsJudgeNothing) {
  record::Verdict verdict;
  verdict.kind = "sweep";
  verdict.word = "FAIL";
  verdict.sentence = "FAIL: 3 of 5 checks failed";
  study("a", verdict);
  EXPECT_EQ(index_verdict(index_entries(folder.path)), "nothing is judged");
  verdict.judge(true);
  study("a", verdict);
  EXPECT_EQ(index_verdict(index_entries(folder.path)), "the one comparison or study passed");
}

TEST_F(Index, ARunOfAnEarlierReleaseHasItsChecks) {
  run("a", {true});
  fs::remove(folder / "a/verdict.json");
  write("a/checks.json", R"({"drycut": "0.0.9", "passed": false, "end": 12.5, "failure": "",
    "checks": [{"name": "one", "passed": true}, {"name": "two", "passed": false}]})");
  const auto entry = index_entries(folder.path)[0];
  EXPECT_EQ(entry.verdict, "1 of 2 checks failed: two");
  EXPECT_EQ(entry.word, "FAIL");
  EXPECT_EQ(entry.version, "0.0.9");
  EXPECT_EQ(entry.simulated, 12.5);
  for (const auto* broken : {"{", "[]", R"({"passed": "yes"})"}) {
    write("a/checks.json", broken);
    EXPECT_FALSE(index_entries(folder.path)[0].came) << broken;
  }
}

TEST_F(Index, IsWrittenAgainTheSameAndOverTheOldOne) {
  run("a", {true});
  ASSERT_EQ(index(), cli::all_passed) << err;
  const auto first = page();
  ASSERT_EQ(index(), cli::all_passed) << err;
  EXPECT_TRUE(page() == first);
  run("b", {true});
  ASSERT_EQ(index(), cli::all_passed) << err;
  EXPECT_THAT(page(), HasSubstr("<span>all 2 runs passed</span>"));
}

// Whoever runs one scenario after the other into a folder finds them all.
TEST_F(Index, DrycutRunWritesItOverAllThatIsThere) {
  cli::RunOptions options;
  options.out = folder / "out";
  options.pictures = false;
  const auto ran = [&](const std::string& name) {
    options.scenarios = {folder.file(name + ".yaml", R"(scene: {step: 1 ms, duration: 0.1 s}
plants: {web: {type: web, speed: 60 m/min}}
record: {every: 10 ms, channels: [web.speed]}
checks: [{name: runs, always: "web.speed > 50"}]
)")};
    return captured([&] { return cli::run_scenarios(options); });
  };
  ASSERT_EQ(ran("first"), cli::all_passed) << err;
  ASSERT_EQ(ran("second"), cli::all_passed) << err;
  const auto written = content(folder / "out/index.html");
  EXPECT_THAT(written, HasSubstr("<a href=\"first/trace.csv\">first</a>"));
  EXPECT_THAT(written, HasSubstr("<a href=\"second/trace.csv\">second</a>"));
  EXPECT_THAT(written, HasSubstr("1 check passed"));
  // drycut index writes the same over it, and leaves what the run wrote beside it.
  ASSERT_EQ(captured([&] { return cli::index_folder(folder / "out"); }), cli::all_passed) << err;
  EXPECT_TRUE(content(folder / "out/index.html") == written);
  EXPECT_TRUE(fs::exists(folder / "out/junit.xml"));
  ASSERT_EQ(ran("first"), cli::all_passed) << err;
  EXPECT_EQ(ran("index.html"), cli::bad_input);
  EXPECT_THAT(err, HasSubstr("its results cannot be called 'index.html'"));
}

TEST_F(Index, RefusesWhatIsNoFolderOfResults) {
  EXPECT_EQ(index(), cli::bad_input);
  EXPECT_THAT(err, HasSubstr(":1:1: there are no results in it; "));
  EXPECT_FALSE(fs::exists(folder / "index.html"));
  EXPECT_EQ(captured([&] { return cli::index_folder(folder / "none"); }), cli::bad_input);
  EXPECT_THAT(err, HasSubstr("none:1:1: there is no such folder; "));
  EXPECT_FALSE(fs::exists(folder / "none"));
  run("a", {true});
  write("index.html", "mine");
  EXPECT_EQ(index(), cli::bad_input);
  EXPECT_THAT(err, HasSubstr("index.html"));
  EXPECT_EQ(page(), "mine");
}

}  // namespace
}  // namespace drycut::sim::report
