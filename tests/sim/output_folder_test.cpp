// Whose files lie in a folder of results: what is removed, what is refused, what is locked.
#include "sim/output_folder.hpp"

#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <csignal>
#include <cstdlib>

#include "sim/cli/run_command.hpp"
#include "sim/report/gallery.hpp"
#include "sim/report/report.hpp"
#include "tests/sim/studies/tune/bench.hpp"

namespace drycut::sim {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

struct OutputFolders : testing::Test {
  OutputFolder open(const std::vector<std::string>& names = {"a.csv", "plots/"}) {
    problems.clear();
    return {folder / "out", "test", names, problems};
  }
  /// A command that writes a.csv and two plots.
  void command() {
    auto out = open();
    ASSERT_THAT(told(), IsEmpty());
    out.begin();
    std::ofstream(out.add("a.csv")) << "a";
    out.add("plots", {"x.png", "y.png"});
    for (const auto* name : {"x.png", "y.png"}) std::ofstream(folder / "out/plots" / name) << "png";
  }
  std::string told() const {
    std::string text;
    for (const auto& problem : problems) text += to_string(problem) + "\n";
    auto path = folder.path.string() + "/";
    for (auto at = text.find(path); at != std::string::npos; at = text.find(path))
      text.erase(at, path.size());
    return text;
  }
  void user(const std::string& name) const {
    fs::create_directories((folder / name).parent_path());
    folder.file(name, "the user's");
  }

  TestFolder folder;
  Problems problems;
};

TEST(MadeFolders, GoAgainWhereNothingCameIntoThem) {
  const TestFolder folder;
  const auto wanted = folder.path / "a" / "b";
  Problems problems;
  {
    const OutputFolder refused(wanted, "run", {}, problems);
    EXPECT_TRUE(fs::exists(wanted));
  }
  EXPECT_FALSE(fs::exists(folder / "a"));
  OutputFolder(wanted, "run", {}, problems).begin();
  EXPECT_TRUE(fs::exists(wanted));
  fs::create_symlink("nowhere", folder / "link");
  { const OutputFolder refused(folder / "link", "run", {}, problems); }
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
}

TEST_F(OutputFolders, TheNextCommandRemovesWhatTheEarlierOneWroteAndNothingElse) {
  command();
  user("out/notes.txt");
  open().begin();
  EXPECT_FALSE(fs::exists(folder / "out/a.csv"));
  EXPECT_FALSE(fs::exists(folder / "out/plots"));
  EXPECT_EQ(content(folder / "out/notes.txt"), "the user's");
}

TEST_F(OutputFolders, WhatStandsUnderItsNamesAndIsNotItsOwnIsRefusedAndLeft) {
  user("out/a.csv");
  user("out/plots/deep/b.png");
  open();
  EXPECT_EQ(told(),
            "--out:1:1: in out stands what no earlier test wrote: a.csv, plots/deep/b.png; name another "
            "folder, or move it away [file.not-ours]\n");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / "out"), {}), 2) << "nothing else was made";
}

TEST_F(OutputFolders, AFileAddedToItsPlotsIsTheUsersToo) {
  command();
  user("out/plots/mine.png");
  open();
  EXPECT_THAT(told(), HasSubstr("in out stands what no earlier test wrote: plots/mine.png; "));
}

TEST_F(OutputFolders, AManifestThatLeadsElsewhereIsNotBelieved) {
  user("precious.txt");
  user("elsewhere/x.png");
  command();
  fs::remove_all(folder / "out/plots");
  fs::create_directory_symlink(folder / "elsewhere", folder / "out/plots");
  std::ofstream(folder / "out/.drycut-test", std::ios::app) << "../precious.txt\n"
                                                            << (folder / "precious.txt").string() << "\n";
  open().begin();
  EXPECT_EQ(content(folder / "precious.txt"), "the user's");
  EXPECT_EQ(content(folder / "elsewhere/x.png"), "the user's");
}

TEST_F(OutputFolders, AnotherKindOfCommandDoesNotTakeItsFiles) {
  command();
  const OutputFolder other(folder / "out", "other", {"a.csv"}, problems);
  EXPECT_THAT(told(), HasSubstr("in out stands what no earlier other wrote: a.csv; "));
}

TEST_F(OutputFolders, OneHasItAtATime) {
  const auto first = open();
  EXPECT_THAT(told(), IsEmpty());
  open();
  EXPECT_EQ(told(),
            "--out:1:1: another drycut is writing into out; let it end first, or name another folder "
            "[file.in-use]\n");
}

TEST_F(OutputFolders, WhatAKilledCommandBeganGoesToo) {
  command();
  user("out/a.csv.part");
  open().begin();
  EXPECT_FALSE(fs::exists(folder / "out/a.csv.part"));
}

TEST_F(OutputFolders, WhatComesToLieInTheWayLaterIsNotOverwritten) {
  auto out = open();
  out.begin();
  user("out/b.csv");
  EXPECT_THROW(out.add("b.csv"), std::runtime_error);
  EXPECT_EQ(content(folder / "out/b.csv"), "the user's");
}

TEST_F(OutputFolders, ItDoesNotMatterHowTheFolderIsWritten) {
  command();
  for (const auto& same : {folder.path / "out/", folder.path / "out/../out", folder.path / "./out/."}) {
    problems.clear();
    OutputFolder out(same, "test", {"a.csv", "plots/"}, problems);
    EXPECT_EQ(told(), "") << same;
    out.begin();
    EXPECT_FALSE(fs::exists(folder / "out/a.csv")) << same;
    std::ofstream(out.add("a.csv")) << "a";
  }
}

TEST_F(OutputFolders, WhatIsKeptIsStillItsOwn) {
  command();
  open().begin({"a.csv"});
  EXPECT_EQ(content(folder / "out/a.csv"), "a");
  open().begin();
  EXPECT_FALSE(fs::exists(folder / "out/a.csv"));
}

TEST_F(OutputFolders, WhatIsMadeAtTheEndLeavesTheEarlierResultsUntilThen) {
  command();
  {
    auto out = open();
    out.begin_aside({});
    std::ofstream(out.add("a.csv")) << "new";
    EXPECT_EQ(content(folder / "out/a.csv"), "a");
  }  // a full disk
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / "out"), {}), 3) << "what waited makes room again";
  EXPECT_EQ(content(folder / "out/a.csv"), "a");
  EXPECT_EQ(content(folder / "out/plots/y.png"), "png");
  {
    auto out = open({"a.csv", "plots/", "kept"});
    ASSERT_EQ(told(), "");
    out.begin_aside({"kept"});
    std::ofstream(out.add("kept")) << "at once";
    EXPECT_EQ(content(folder / "out/kept"), "at once");
    std::ofstream(out.add("a.csv")) << "new";
    std::ofstream(out.add("plots", {"x.png"}) / "x.png") << "new";
    out.finish();
  }
  EXPECT_EQ(content(folder / "out/a.csv"), "new");
  EXPECT_EQ(content(folder / "out/plots/x.png"), "new");
  EXPECT_FALSE(fs::exists(folder / "out/plots/y.png")) << "the new results have none";
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / "out"), {}), 4) << "nothing waits beside them";
  open({"a.csv", "plots/", "kept"}).begin();
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / "out"), {}), 1) << "the manifest lists all";
}

// ---- drycut run ----

struct RunsIntoFolders : CommandTest {
  RunsIntoFolders() {
    options.out = folder / "out";
    options.pictures = false;
    folder.file("axis.cnf", studies::tuning::configuration);
    folder.file("axis.mod", studies::tuning::program);
  }
  fs::path scenario(const std::string& name) const {
    return folder.file(name, std::string(studies::tuning::scenario) +
                                 "checks: [{name: moves, eventually: axis.position > 1}]\n");
  }
  int run(const std::vector<fs::path>& scenarios) {
    options.scenarios = scenarios;
    return captured([&] { return cli::run_scenarios(options); });
  }

  TestFolder folder;
  cli::RunOptions options;
};

TEST_F(RunsIntoFolders, ARunDoesNotOverwriteItsOwnInput) {
  fs::create_directories(folder / "scenario");
  for (const auto* name : {"axis.cnf", "axis.mod"}) fs::copy(folder / name, folder / "scenario" / name);
  const auto file = scenario("scenario/scenario.yaml");
  const auto text = content(file);
  options.out = folder / "scenario" / "..";
  EXPECT_EQ(run({file}), cli::bad_input) << out;
  EXPECT_THAT(err, HasSubstr("stands what no earlier run wrote: scenario.yaml; "));
  EXPECT_EQ(content(file), text);
}

TEST_F(RunsIntoFolders, OldVerdictsGoBeforeAnythingRuns) {
  const auto first = scenario("first.yaml");
  ASSERT_EQ(run({first}), cli::all_passed) << err << out;
  ASSERT_THAT(content(folder / "out/first/checks.json"), HasSubstr("\"passed\": true"));
  // The second's folder holds something of the user's: nothing is run, and the first's results stay.
  fs::create_directories(folder / "out/second");
  folder.file("out/second/trace.csv", "the user's");
  EXPECT_EQ(run({first, scenario("second.yaml")}), cli::bad_input);
  EXPECT_THAT(content(folder / "out/first/checks.json"), HasSubstr("\"passed\": true"));
  EXPECT_FALSE(fs::exists(folder / "out/junit.xml")) << "it is not this call's verdict";
}

TEST_F(RunsIntoFolders, AVerdictOverAllIsNotTakenForThatOfACallThatRanNothing) {
  const auto file = scenario("line.yaml");
  ASSERT_EQ(run({file}), cli::all_passed) << err << out;
  const auto checks = content(folder / "out/line/checks.json");
  folder.file("line.yaml", "scene: {step: 1 mn}\n");
  EXPECT_EQ(run({file}), cli::bad_input);
  EXPECT_THAT(err, HasSubstr("junit.xml of an earlier run is removed: nothing has run"));
  EXPECT_FALSE(fs::exists(folder / "out/junit.xml"));
  EXPECT_EQ(content(folder / "out/line/checks.json"), checks) << "what a run left by itself stays";
  // One that drycut has not written is nobody's to remove.
  folder.file("out/junit.xml", "<mine/>");
  EXPECT_EQ(run({file}), cli::bad_input);
  EXPECT_EQ(content(folder / "out/junit.xml"), "<mine/>");
}

/// A file-size limit ends the child in the midst of writing its trace, as a kill would.
TEST_F(RunsIntoFolders, AKilledRunLeavesNoVerdictOfAnEarlierOne) {
  const auto file = scenario("line.yaml");
  ASSERT_EQ(run({file}), cli::all_passed) << err << out;
  const auto child = fork();
  if (child == 0) {
    const rlimit few{2048, 2048};
    const rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    setrlimit(RLIMIT_FSIZE, &few);
    cli::run_scenarios(options);
    _exit(0);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGXFSZ) << status;
  const auto checks = content(folder / "out/line/checks.json");
  EXPECT_THAT(checks, HasSubstr("\"passed\": false"));
  EXPECT_THAT(checks, HasSubstr("the run has not come to its end"));
  EXPECT_FALSE(fs::exists(folder / "out/junit.xml"));
  EXPECT_EQ(run({file}), cli::all_passed) << "the next one takes over; " << err;
  EXPECT_THAT(content(folder / "out/line/checks.json"), HasSubstr("\"passed\": true"));
}

TEST_F(RunsIntoFolders, PlotsNeedNoHelper) {
  const auto path = search_path();
  setenv("PATH", (folder / "nothing").c_str(), 1);
  options.pictures = true;
  const int status = run({scenario("line.yaml")});
  setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(status, cli::all_passed);
  EXPECT_THAT(out, HasSubstr("line: passed, all 2 checks passed"));
  EXPECT_EQ(err, "");
  EXPECT_THAT(content(folder / "out/line/report.html"), HasSubstr("data-plot=\"0\""));
  EXPECT_THAT(content(folder / "out/junit.xml"), HasSubstr("failures=\"0\" errors=\"0\""));
}

TEST_F(RunsIntoFolders, NamesThatCannotNameAFolderOfResultsAreRefused) {
  EXPECT_EQ(run({scenario("...yaml")}), cli::bad_input);
  EXPECT_THAT(
      err, HasSubstr("...yaml:1:1: its results cannot be called '..'; give the scenario another file name"));
  EXPECT_EQ(run({scenario("..yaml")}), cli::bad_input);
  EXPECT_THAT(err, HasSubstr("..yaml:1:1: its results cannot be called '.'; "));
  EXPECT_EQ(run({scenario("junit.xml.yaml")}), cli::bad_input);
  EXPECT_THAT(err, HasSubstr("its results cannot be called 'junit.xml'; "));
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST_F(RunsIntoFolders, PlotsOfOneNameHaveAFileEach) {
  Problems problems;
  OutputFolder results(folder / "out", "run", report::picture_files, problems);
  results.begin();
  renders::Plot plot;
  plot.name = "cam_AxisX";
  plot.panels.push_back({});
  plot.panels[0].curves.push_back({"a", {0, 1}, {0, 1}});
  renders::Report report;
  report::add_plots({plot, plot}, results, report);
  ASSERT_EQ(report.plots.size(), 2U);
  EXPECT_EQ(report.plots[0].png, folder / "out/plots/cam_AxisX.png");
  EXPECT_EQ(report.plots[1].png, folder / "out/plots/cam_AxisX_.png");
  EXPECT_TRUE(fs::exists(report.plots[1].png));
}

TEST_F(RunsIntoFolders, TheSecondOfTwoProcessesIsRefused) {
  Problems problems;
  const OutputFolder other(folder / "out", "runs", {"junit.xml"}, problems);
  EXPECT_EQ(run({scenario("line.yaml")}), cli::bad_input);
  EXPECT_THAT(err, HasSubstr("another drycut is writing into "));
  EXPECT_FALSE(fs::exists(folder / "out/junit.xml"));
}

}  // namespace
}  // namespace drycut::sim
