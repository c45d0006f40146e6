// drycut compare: exit status, what it prints and writes, what it refuses.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>

#include "sim/cli/compare_command.hpp"
#include "tests/sim/studies/compare/bench.hpp"

namespace drycut::sim::studies::comparing {
namespace {

using testing::HasSubstr;
using testing::Not;

struct CompareCommand : Bench {
  int run(const std::vector<fs::path>& runs) {
    options.runs = runs;
    options.out = folder / "out";
    return captured([&] { return cli::compare_runs(options); });
  }
  /// Refuses b when `texts` stand in it, with this message, and writes nothing.
  void refuses(const RunTexts& texts, const std::string& file, const std::string& message) {
    EXPECT_EQ(run({write("a", {}), write("b", texts)}), cli::bad_input);
    EXPECT_THAT(err, HasSubstr((folder / "b" / file).string() + ":" + message + " [record."));
    EXPECT_FALSE(fs::exists(folder / "out"));
  }
  cli::CompareOptions options;
};

TEST_F(CompareCommand, IdenticalRunsAreTheSame) {
  EXPECT_EQ(run({write("a", {}), write("b", {})}), cli::all_passed) << err;
  EXPECT_THAT(out, HasSubstr("a against b: no difference\n"));
  const auto page = content(folder / "out/report.html");
  EXPECT_THAT(page, HasSubstr("<strong>SAME</strong> <span>no difference</span>"));
  EXPECT_THAT(page, Not(HasSubstr("<h2>Parameters in force that differ")));
  EXPECT_TRUE(fs::exists(folder / "out/comparison.csv"));
  EXPECT_TRUE(fs::exists(folder / "out/plots/overlay_AxisX.png"));
}

TEST_F(CompareCommand, WhatIsJudgedIsGreenWhereItIsKept) {
  options.fail_on_difference = true;
  EXPECT_EQ(run({write("a", {}), write("b", {})}), cli::all_passed) << err;
  EXPECT_THAT(out, HasSubstr("\n  PASS: kept\n"));
  const auto page = content(folder / "out/report.html");
  EXPECT_THAT(page, HasSubstr("<p class=\"verdict pass\"><strong>PASS</strong>"));
  for (const auto* what : {"verdicts", "events", "channels", "end", "parameters"})
    EXPECT_THAT(page, HasSubstr(std::string("<span class=\"badge pass\">PASS</span></td><td>") + what));
}

/// Two placements, the second of which comes a record instant later or earlier.
RunTexts placed(const std::string& trace, const std::string& press_at) {
  RunTexts texts;
  texts.trace = "time [s],gbPlace [],ram.position [mm],lamp []\n" + trace;
  texts.events = "time [s],source,event,values\n" + press_at + ",ram,pressed,force=900 N\n";
  return texts;
}
const std::string trace_of_a = "0.0,1,0,0\n0.1,1,5,0\n0.2,2,7,1\n0.3,2,9,1\n0.4,2,9,1\n";
const std::string trace_of_b = "0.0,1,0,0\n0.1,1,5,0\n0.2,1,5,1\n0.3,2,7,1\n0.4,2,9,1\n";

TEST_F(CompareCommand, ASwitchedLineIsKeptStretchByStretch) {
  const std::vector<fs::path> runs = {write("a", placed(trace_of_a, "0.25")),
                                      write("b", placed(trace_of_b, "0.35"))};
  options.tolerances = {"1e-6"};
  EXPECT_EQ(run(runs), cli::check_failed);
  EXPECT_THAT(out, HasSubstr("gbPlace by 1 at 0.2000 s in b"));
  options.align = "gbPlace";
  EXPECT_EQ(run(runs), cli::all_passed) << out << err;
  // What a placement comes to still counts.
  EXPECT_EQ(run({runs[0], write("c", placed(with(trace_of_b, "0.4,2,9,1", "0.4,2,9.5,1"), "0.35"))}),
            cli::check_failed);
  EXPECT_THAT(out, HasSubstr("ram.position by 0.5 mm at 0.3000 s in c"));
  EXPECT_EQ(run({runs[0], write("d", placed(trace_of_b, "0.36"))}), cli::check_failed);
  options.align = "gbTour";
  EXPECT_EQ(run(runs), cli::bad_input);
  EXPECT_THAT(err, HasSubstr("--align:1:1: 'gbTour' is no event of a, and no channel that changes there; "));
}

TEST_F(CompareCommand, AChannelIsLeftOut) {
  const std::vector<fs::path> runs = {write("a", placed(trace_of_a, "0.25")),
                                      write("b", placed(with(trace_of_a, "0.2,2,7,1", "0.2,2,7,0"), "0.25"))};
  options.tolerances = {"1e-6"};
  EXPECT_EQ(run(runs), cli::check_failed);
  options.without = {"lamp"};
  EXPECT_EQ(run(runs), cli::all_passed) << out << err;
  EXPECT_THAT(content(folder / "out/comparison.csv"),
              testing::AllOf(HasSubstr("gbPlace"), Not(HasSubstr("lamp"))));
  options.without = {"la*", "ram.*"};
  EXPECT_EQ(run(runs), cli::all_passed) << out << err;
  options.without = {"lampe"};
  EXPECT_EQ(run(runs), cli::bad_input);
  EXPECT_THAT(err, HasSubstr("--without:1:1: no run has a channel 'lampe'; did you mean lamp?"));
}

/// Noise in the last digits of what two machines compute.
RunTexts noisy() {
  RunTexts texts;
  texts.trace = with(texts.trace, "0.2,60,-4", "0.2,60.0000001,-4");
  texts.events = with(texts.events, "length=800.1 mm", "length=800.100008 mm");
  return texts;
}

TEST_F(CompareCommand, AGoldenSurvivesRoundingAndNoMore) {
  const std::vector<fs::path> runs = {write("a", {}), write("b", noisy())};
  EXPECT_EQ(run(runs), cli::all_passed);
  EXPECT_THAT(out, HasSubstr("no difference\n")) << "1e-7 of the largest value is none";
  options.tolerances = {"0"};
  EXPECT_EQ(run(runs), cli::check_failed);
  EXPECT_THAT(out, HasSubstr("different: 1 of 4 events, 1 of 2 shared channels\n"));
  EXPECT_THAT(out, HasSubstr("  knife.speed by 1e-07 m/min at 0.2000 s in b, 0 m/min allowed\n"));
  EXPECT_THAT(out, HasSubstr("  knife.cut 2: a 0.100000 s: length=800.1 mm; mismatch=1 mm/s; b 0.100000 s: "
                             "length=800.100008 mm;"));
  EXPECT_THAT(out, HasSubstr("\n  FAIL: beyond the tolerance\n"));
  const auto page = content(folder / "out/report.html");
  EXPECT_THAT(page, HasSubstr("<p class=\"verdict fail\"><strong>FAIL</strong>"));
  EXPECT_THAT(page, HasSubstr("<span class=\"badge fail\">FAIL</span></td><td>channels"));
  EXPECT_THAT(page, HasSubstr("<span class=\"badge pass\">PASS</span></td><td>verdicts"));
  EXPECT_THAT(page, HasSubstr("<dt>--tolerance</dt><dd>0</dd>"));
}

TEST_F(CompareCommand, TolerancesAreByNameAndUnit) {
  RunTexts other;
  other.trace = with(other.trace, "0.1,60,3", "0.1,60.3,5");
  other.events =
      with(other.events, "0.150000000,knife,cut,length=799.9 mm", "0.151,knife,cut,length=799.95 mm");
  const std::vector<fs::path> runs = {write("a", {}), write("b", other)};
  struct Case {
    std::vector<std::string> tolerances;
    int status;
    const char* told;
  };
  const std::vector<std::string> all = {"length=0.06mm", "time=1 ms", "knife.speed=0.5%",
                                        "AxisX.follerr=2 bits x4"};
  const auto but = [&](std::size_t i, const std::string& text) {
    auto changed = all;
    changed[i] = text;
    return changed;
  };
  for (const auto& [tolerances, status, told] :
       std::vector<Case>{{all, cli::all_passed, "no difference\n"},
                         {but(0, "length=0.04mm"), cli::check_failed, "1 of 4 events\n"},
                         {but(0, "length=60 um"), cli::all_passed, ""},
                         {but(0, "cut.length=0.06mm"), cli::all_passed, ""},
                         {but(0, "knife.cut.length=0.06mm"), cli::all_passed, ""},
                         {but(0, "mismatch=1 m/s"), cli::check_failed, "1 of 4 events\n"},
                         {but(1, "time=0.9 ms"), cli::check_failed, "1 of 4 events\n"},
                         {but(2, "knife.speed=0.4%"), cli::check_failed, "1 of 2 shared channels\n"},
                         {but(2, "knife.speed=0.005"), cli::all_passed, ""},
                         {but(2, "knife.speed=0.3001 m/min"), cli::all_passed, ""},
                         {but(3, "AxisX.follerr=1.9 bits x4"), cli::check_failed, "1 of 2 shared channels\n"},
                         {{"50%"}, cli::all_passed, ""},
                         {{"50%", "length=0"}, cli::check_failed, "1 of 4 events\n"}}) {
    options.tolerances = tolerances;
    EXPECT_EQ(run(runs), status) << fmt::format("{}\n{}{}", fmt::join(tolerances, " "), out, err);
    EXPECT_THAT(out, HasSubstr(told)) << tolerances[0];
  }
}

TEST_F(CompareCommand, AToleranceOfAFigureJudgesIt) {
  RunTexts other;
  other.events = with(other.events, "length=799.9 mm", "length=799.94 mm");
  const std::vector<fs::path> runs = {write("a", {}), write("b", other)};
  options.tolerances = {"length=1mm", "knife.cut length: mean=0.03mm"};
  EXPECT_EQ(run(runs), cli::all_passed) << out << err;
  options.tolerances = {"length=1mm", "knife.cut length: mean=0.01mm"};
  EXPECT_EQ(run(runs), cli::check_failed);
  EXPECT_THAT(out, HasSubstr("different: 1 figure\n  knife.cut length: mean by 0.02 mm, 0.01 allowed\n"));
}

// A margin hangs on what its check speaks of: who allows that allows its margin to move along.
TEST_F(CompareCommand, AMarginHasTheToleranceOfItsCheckOrOfWhatItSpeaksOf) {
  RunTexts other;
  const std::string of_length = R"("names": ["length"], "detail")";
  other.checks = with(RunTexts::checks_json(0.05, true), "\"detail\"", of_length);
  RunTexts first;
  first.checks = with(first.checks, "\"detail\"", of_length);
  const std::vector<fs::path> runs = {write("a", first), write("b", other)};
  for (const auto& [tolerance, status] :
       std::vector<std::pair<const char*, int>>{{"1e-6", cli::check_failed},
                                                {"length=0.01mm", cli::all_passed},
                                                {"length=0.001mm", cli::check_failed},
                                                {"length=0.001%", cli::all_passed},  // of 900 mm
                                                {"cut length=0.003 mm", cli::all_passed},
                                                {"cut length=10%", cli::all_passed},
                                                {"cut length=1%", cli::check_failed},
                                                {"knife.speed=1 m/s", cli::check_failed}}) {
    options.tolerances = {tolerance};
    EXPECT_EQ(run(runs), status) << tolerance << err << out;
  }
  // A verdict is kept or not, whatever is allowed.
  other.checks = with(first.checks, "\"passed\": true, \"margin\"", "\"passed\": false, \"margin\"");
  options.tolerances = {"cut length=1 m"};
  EXPECT_EQ(run({runs[0], write("b", other)}), cli::check_failed);
  EXPECT_THAT(out, HasSubstr("cut length: verdict; "));
}

TEST_F(CompareCommand, ParametersCountOnlyForTheSame) {
  RunTexts other;
  other.scenario = with(other.scenario, "speed: 60 m/min", "speed: 80 m/min");
  const std::vector<fs::path> runs = {write("a", {}), write("b", other)};
  options.tolerances = {"1e-7"};
  EXPECT_EQ(run(runs), cli::all_passed);
  EXPECT_THAT(out, HasSubstr("  plants.web.speed: a 60 m/min; b 80 m/min\n")) << "told all the same";
  options.fail_on_difference = true;
  EXPECT_EQ(run(runs), cli::check_failed);
}

TEST_F(CompareCommand, WrongTolerancesAreRefused) {
  struct Case {
    const char* text;
    const char* told;
  };
  for (const auto& [text, told] :
       std::vector<Case>{{"length=", "--tolerance:1:8: '' is no tolerance; 0 or more: "},
                         {"length=-1 mm", "--tolerance:1:8: '-1 mm' is no tolerance"},
                         {"length=1 mm%", "--tolerance:1:8: '1 mm%' is no tolerance"},
                         {"=1", "--tolerance:1:1: '=1' names nothing"},
                         {"0.01mm", "--tolerance:1:1: '0.01mm' is for nothing that has a name"},
                         {"lenght=1 mm",
                          "--tolerance:1:1: there is no 'lenght' in these runs; did you mean length? "
                          "[compare.unknown-name]"},
                         {"follerr=1%", "there is no 'follerr' in these runs; did you mean AxisX.follerr?"},
                         {"length=1 s", "--tolerance:1:8: length is in mm, not in s; "},
                         {"AxisX.follerr=1", ""},
                         {"AxisX.follerr=1 -", "AxisX.follerr is in bits x4, not in -"}}) {
    options.tolerances = {text};
    const int status = run({write("a", {}), write("b", {})});
    EXPECT_EQ(status, *told == 0 ? cli::all_passed : cli::bad_input) << text;
    EXPECT_THAT(err, HasSubstr(told));
    EXPECT_EQ(fs::exists(folder / "out"), *told == 0) << text;
    fs::remove_all(folder / "out");
  }
  options.tolerances = {"length=1mm", "length=2mm", "1%", "2%"};
  EXPECT_EQ(run({write("a", {}), write("b", {})}), cli::bad_input);
  EXPECT_THAT(err, HasSubstr("there are two tolerances of length; keep one"));
  EXPECT_THAT(err, HasSubstr("there are two tolerances without a name; keep one"));
}

TEST_F(CompareCommand, DifferencesAreToldAndFailOnlyIfAsked) {
  RunTexts other;
  other.scenario = with(other.scenario, "speed: 60 m/min", "speed: 80 m/min");
  other.checks = RunTexts::checks_json(-0.4, false);
  const std::vector<fs::path> runs = {write("a", {}), write("b", other)};
  EXPECT_EQ(run(runs), cli::all_passed);
  EXPECT_THAT(out, HasSubstr("different: 1 of 1 check, 1 parameter\n"));
  EXPECT_THAT(out,
              HasSubstr("  cut length: verdict; a passed, 0.053 mm left, at 0.1000 s; b FAILED, 0.4 mm too "
                        "far, at 0.1000 s\n"));
  EXPECT_THAT(out, HasSubstr("  plants.web.speed: a 60 m/min; b 80 m/min\n"));
  const auto page = content(folder / "out/report.html");
  EXPECT_THAT(page, HasSubstr("<strong>DIFFERENT</strong>"));
  EXPECT_THAT(
      page,
      HasSubstr(
          "<td>plants.web.speed</td><td class=\"number\">60 m/min</td><td class=\"number\">80 m/min</td>"));
  EXPECT_THAT(page, HasSubstr("<span class=\"badge fail\">FAIL</span> 0.4 mm too far"));
  options.fail_on_difference = true;
  EXPECT_EQ(run(runs), cli::check_failed);
}

TEST_F(CompareCommand, TheSameRunsGiveTheSameBytes) {
  RunTexts other;
  other.trace = with(other.trace, "0.1,60,3", "0.1,60,5");
  const std::vector<fs::path> runs = {write("a", {}), write("b", other)};
  ASSERT_EQ(run(runs), cli::all_passed);
  const auto page = content(folder / "out/report.html");
  ASSERT_EQ(run(runs), cli::all_passed);
  EXPECT_TRUE(page == content(folder / "out/report.html"));
}

TEST_F(CompareCommand, RunsAreCalledByWhatTellsTheirFoldersApart) {
  options.pictures = false;
  EXPECT_EQ(run({write("one/line", {}), write("two/line", {})}), cli::all_passed) << err;
  EXPECT_THAT(out, testing::StartsWith("one against two: "));
  EXPECT_FALSE(fs::exists(folder / "out/report.html"));
  EXPECT_EQ(run({write("one/line", {}), write("one/press", {}), write("two/line", {})}), cli::all_passed)
      << err;
  EXPECT_THAT(out, testing::StartsWith("one/line against one/press against two/line: "));
}

TEST_F(CompareCommand, WhatIsNoRunIsRefused) {
  const auto a = write("a", {});
  EXPECT_EQ(run({a}), cli::bad_input);
  EXPECT_THAT(err, HasSubstr(a.string() + ":1:1: one run alone is nothing to compare; "));
  EXPECT_EQ(run({a, a / ""}), cli::bad_input);
  EXPECT_THAT(err, HasSubstr("the folder is given twice; give each run once"));
  EXPECT_EQ(run({a, folder / "none"}), cli::bad_input);
  EXPECT_THAT(err, HasSubstr((folder / "none").string() +
                             ":1:1: there is no such folder; check the path [record.no-run]"));
  EXPECT_EQ(run({a, a / "trace.csv"}), cli::bad_input);
  EXPECT_THAT(err, HasSubstr("it is not a folder; name a folder that drycut run made of a scenario"));
  EXPECT_EQ(run({a, folder}), cli::bad_input);
  EXPECT_THAT(err, HasSubstr("it is not the folder of a run: there is no trace.csv, events.csv, checks.json, "
                             "scenario.yaml; the runs in it are " +
                             a.string()));
  fs::remove(write("old", {}) / "scenario.yaml");
  EXPECT_EQ(run({a, folder / "old"}), cli::bad_input);
  EXPECT_THAT(err, HasSubstr("there is no scenario.yaml; run the scenario again"));
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST_F(CompareCommand, TheResultsMustNotReplaceARun) {
  const auto out_run = write("out", {});
  EXPECT_EQ(run({write("a", {}), out_run}), cli::bad_input);
  EXPECT_THAT(err, HasSubstr("--out:1:1: " + out_run.string() + " is one of the runs; "));
}

TEST_F(CompareCommand, AWrongTimeIsRefused) {
  options.from = "4 m";
  EXPECT_EQ(run({write("a", {}), write("b", {})}), cli::bad_input);
  EXPECT_THAT(err, HasSubstr("--from:1:"));
}

TEST_F(CompareCommand, TheEventsOfALongRunMayBeLargerThanAProgram) {
  RunTexts texts;
  constexpr std::size_t larger_than_any_program = 17U << 20U;
  const std::string line = "0.200000000,timeline,set,panel.start = 1" + std::string(4000, ' ') + '\n';
  while (texts.events.size() < larger_than_any_program) texts.events += line;
  EXPECT_EQ(run({write("a", {}), write("b", texts)}), cli::all_passed) << err;
}

TEST_F(CompareCommand, BrokenTracesAreToldWithTheirPlace) {
  const auto again = std::string("; run the scenario again: drycut run writes the file");
  RunTexts texts;
  texts.trace = with(texts.trace, "0.1,60,3", "0.1,60,x3");
  refuses(texts, "trace.csv", "3:8: 'x3' is not a number" + again);
  texts.trace = with(RunTexts().trace, "0.1,60,3", "0.1,60");
  refuses(texts, "trace.csv", "3:1: 2 cells, the header has 3" + again);
  texts.trace = with(RunTexts().trace, "0.2,60", "0.1,60");
  refuses(texts, "trace.csv", "4:1: the time does not rise" + again);
  texts.trace = with(RunTexts().trace, "0.2,60", "-1,60");
  refuses(texts, "trace.csv", "4:1: '-1' is no time of a run" + again);
  texts.trace = with(RunTexts().trace, "knife.speed [m/min]", "knife.speed");
  refuses(texts, "trace.csv",
          "1:10: 'knife.speed' is no channel with its unit; the header has channel [unit], as drycut run "
          "writes it");
  texts.trace = with(RunTexts().trace, "knife.speed [m/min]", "AxisX.follerr [mm]");
  refuses(texts, "trace.csv", "1:29: channel 'AxisX.follerr' stands twice" + again);
  texts.trace = with(RunTexts().trace, "time [s]", "t");
  refuses(texts, "trace.csv",
          "1:1: the header does not begin with time [s]; the first line is time [s],channel [unit],...");
  texts.trace = "";
  refuses(texts, "trace.csv", "1:1: the file cannot be read, or is empty" + again);
}

TEST_F(CompareCommand, BrokenEventsAreToldWithTheirPlace) {
  const auto again = std::string("; run the scenario again: drycut run writes the file");
  RunTexts texts;
  texts.events = with(texts.events, "0.100000000", "soon");
  refuses(texts, "events.csv", "3:1: 'soon' is not a number" + again);
  texts.events = RunTexts().events + "0.3,knife,cut,\"length=1 mm\n";
  refuses(texts, "events.csv", "6:15: the quote is never closed" + again);
  texts.events = RunTexts().events + "0.3,knife,cut,\"length\"=1\n";
  refuses(texts, "events.csv", "6:15: text behind the closing quote" + again);
  texts.events = RunTexts().events + "0.3,knife,cut\n";
  refuses(texts, "events.csv", "6:1: 3 cells, the header has 4" + again);
}

TEST_F(CompareCommand, BrokenChecksAndScenariosAreToldWithTheirPlace) {
  const auto again = std::string("; run the scenario again: drycut run writes the file");
  RunTexts texts;
  texts.checks = "{\n  \"passed\": tru }";
  refuses(texts, "checks.json", "2:16: this is no JSON" + again);
  texts.checks = with(RunTexts().checks, "\"end\": 0.2", "\"end\": \"late\"");
  refuses(texts, "checks.json",
          "1:1: a check's result is missing or of another kind: type must be number, but is string" + again);
  texts = {};
  texts.scenario = "[1, 2]\n";
  EXPECT_EQ(run({write("a", {}), write("b", texts)}), cli::bad_input);
  EXPECT_THAT(err, HasSubstr("scenario.yaml:1:1: a scenario must be a map, not a list"));
  texts.scenario = "scene: [\n";
  EXPECT_EQ(run({write("a", {}), write("b", texts)}), cli::bad_input);
  EXPECT_THAT(err, HasSubstr("b/scenario.yaml:"));
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST_F(CompareCommand, AllProblemsAreToldInOneRun) {
  RunTexts texts;
  texts.trace = with(texts.trace, "0.1,60,3", "0.1,sixty,x3");
  texts.events = with(texts.events, "0.100000000", "soon");
  EXPECT_EQ(run({write("a", {}), write("b", texts)}), cli::bad_input);
  for (const auto* what : {"'sixty'", "'x3'", "'soon'"}) EXPECT_THAT(err, HasSubstr(what));
}

}  // namespace
}  // namespace drycut::sim::studies::comparing
