// What a comparison finds in runs whose numbers are known.
#include <gmock/gmock.h>

#include <cmath>

#include "sim/studies/compare/comparison.hpp"
#include "sim/studies/compare/overlays.hpp"
#include "sim/studies/compare/pieces.hpp"
#include "tests/sim/studies/compare/bench.hpp"

namespace drycut::sim::studies::comparing {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

struct Compare : Bench {
  ComparedRun read(const std::string& label, const RunTexts& texts) {
    Problems problems;
    auto run = read_run(write(label, texts), problems);
    EXPECT_EQ(problems.size(), 0U) << (problems.empty() ? "" : to_string(problems[0]));
    run.label = label;
    return run;
  }
  Comparison compared(const RunTexts& a, const RunTexts& b, std::optional<double> from = {}) {
    std::vector<ComparedRun> runs;
    runs.push_back(read("a", a));
    runs.push_back(read("b", b));
    return compare(std::move(runs), from);
  }
  static Figure figure(const Comparison& comparison, const std::string& name) {
    for (const auto& one : comparison.events)
      if (one.name == name) return one;
    ADD_FAILURE() << "no figure " << name;
    return {"", "", {0, 0}};
  }
};

TEST_F(Compare, ARunIsReadBackAsItWasWritten) {
  const auto run = read("a", {});
  EXPECT_EQ(run.version, "0.1.0");
  EXPECT_THAT(run.recording.times(), ElementsAre(0, 100 * millisecond, 200 * millisecond));
  ASSERT_NE(run.recording.column("AxisX.follerr"), nullptr);
  EXPECT_EQ(run.recording.column("AxisX.follerr")->unit, "bits x4");
  EXPECT_THAT(run.recording.column("AxisX.follerr")->values, ElementsAre(0, 3, -4));
  ASSERT_EQ(run.recording.events().size(), 4U);
  const auto& cut = run.recording.events()[1];
  EXPECT_EQ(cut.time, 100 * millisecond);
  ASSERT_NE(cut.find("mismatch"), nullptr);
  EXPECT_EQ(cut.find("mismatch")->number, 1);
  EXPECT_EQ(cut.find("mismatch")->unit, "mm/s");
  EXPECT_EQ(run.recording.events()[3].text, "panel.start = 1");
  ASSERT_NE(run.parameter("checks[cut length].expect"), nullptr);
  EXPECT_EQ(*run.parameter("checks[cut length].expect"), "abs(length - 800) <= 0.2");
  EXPECT_EQ(*run.parameter("timeline[0].set.panel.start"), "1");
  EXPECT_EQ(*run.parameter("record.channels"), "[knife.speed, AxisX.follerr]");
  EXPECT_EQ(run.parameter("pictures.plots[cuts].from"), nullptr) << "pictures change no result";
}

TEST_F(Compare, WhatBeginsAgainWithEachTurnIsComparedOnItsCircle) {
  RunTexts before;
  RunTexts after;
  before.trace =
      "time [s],Knife.actual_position [deg],knife.speed [m/min]\n0.0,359.9,60\n0.1,0.1,60\n0.2,179,60\n";
  after.trace =
      "time [s],Knife.actual_position [deg],knife.speed [m/min]\n0.0,0.1,60\n0.1,359.8,60\n0.2,179,60\n";
  const auto difference = [&] {
    const auto comparison = compared(before, after);
    EXPECT_EQ(comparison.channels[0].name, "Knife.actual_position");
    return comparison.channels[0].difference;
  };
  EXPECT_NEAR(difference(), 359.8, 1e-9) << "nothing says that it begins again";
  const auto plain = after.scenario;
  const auto turning = [&](const std::string& turn) {
    return plain + "controller:\n  plcopen: {axes: {Knife: {modulo: " + turn + "}}}\n";
  };
  before.scenario = turning("360 deg");
  EXPECT_NEAR(difference(), 359.8, 1e-9) << "one of them counts on";
  after.scenario = turning("720 deg");
  EXPECT_NEAR(difference(), 359.8, 1e-9) << "their turns are not the same";
  after.scenario = turning("360.0 deg");
  EXPECT_NEAR(difference(), 0.3, 1e-9);
}

TEST_F(Compare, CellsInQuotesAreReadBack) {
  RunTexts texts;
  texts.trace = "time [s],\"recipe[2,5] [-]\"\n0.0,1\n";
  texts.events =
      "time [s],source,event,values\n0.1,task,error,\"said \"\"no\"\", twice\nand again\"\n"
      "0.2,task,error,none\n";
  const auto run = read("a", texts);
  ASSERT_NE(run.recording.column("recipe[2,5]"), nullptr);
  EXPECT_EQ(run.recording.column("recipe[2,5]")->unit, "");
  EXPECT_EQ(run.recording.events()[0].text, "said \"no\", twice\nand again");
  EXPECT_EQ(run.recording.events()[1].text, "none");
}

TEST_F(Compare, IdenticalRunsHaveNoDifference) {
  const auto comparison = compared({}, {});
  EXPECT_TRUE(same(comparison));
  EXPECT_EQ(difference_text(comparison), "no difference");
  for (const auto& one : comparison.events) EXPECT_FALSE(differs(one)) << one.name;
}

TEST_F(Compare, AnotherVersionIsNoDifference) {
  RunTexts other;
  other.checks = with(other.checks, "0.1.0", "0.2.0");
  EXPECT_TRUE(same(compared({}, other)));
}

TEST_F(Compare, AChangedParameterIsNamedWithBothValues) {
  RunTexts other;
  other.scenario = with(other.scenario, "speed: 60 m/min", "speed: 80 m/min");
  const auto comparison = compared({}, other);
  EXPECT_FALSE(same(comparison));
  ASSERT_EQ(comparison.parameters.size(), 1U);
  EXPECT_EQ(comparison.parameters[0].path, "plants.web.speed");
  EXPECT_THAT(comparison.parameters[0].values, ElementsAre("60 m/min", "80 m/min"));
  EXPECT_EQ(difference_text(comparison), "different: 1 parameter");
}

TEST_F(Compare, AParameterOfOneRunOnlyIsAbsentInTheOther) {
  RunTexts other;
  other.scenario = with(other.scenario, ", seed: 1", "");
  const auto comparison = compared({}, other);
  ASSERT_EQ(comparison.parameters.size(), 1U);
  EXPECT_EQ(comparison.parameters[0].path, "scene.seed");
  EXPECT_EQ(comparison.parameters[0].values[0], "1");
  EXPECT_EQ(comparison.parameters[0].values[1], std::nullopt);
}

TEST_F(Compare, FiguresOfEventsAreThoseOfTheWindowThatTheLimitsHave) {
  RunTexts other;
  other.events = with(other.events, "length=800.1", "length=800.16");
  const auto comparison = compared({}, other);
  EXPECT_THAT(figure(comparison, "knife.cut length: number").numbers, ElementsAre(2, 2));
  EXPECT_NEAR(figure(comparison, "knife.cut length: mean").numbers[0], 800.0, 1e-9);
  EXPECT_NEAR(figure(comparison, "knife.cut length: mean").numbers[1], 800.03, 1e-9);
  EXPECT_NEAR(figure(comparison, "knife.cut length: standard deviation").numbers[0], std::sqrt(0.02), 1e-9);
  EXPECT_NEAR(figure(comparison, "knife.cut length: slope from one to the next").numbers[1], -0.26, 1e-9);
  EXPECT_EQ(figure(comparison, "knife.cut length: worst").numbers[1], 800.16);
  // Cpk: the room of the mean in the limits over three standard deviations.
  EXPECT_NEAR(figure(comparison, "knife.cut length: Cpk").numbers[0], 0.2 / (3 * std::sqrt(0.02)), 1e-9);
  EXPECT_NEAR(figure(comparison, "knife.cut length: Cpk").numbers[1], 0.17 / (3 * 0.26 / std::sqrt(2.0)),
              1e-9);
  // The mismatch has no limits of its own: that of the start-up does not count either.
  EXPECT_THAT(figure(comparison, "knife.cut mismatch: number").numbers, ElementsAre(2, 2));
  EXPECT_THAT(figure(comparison, "knife.cut mismatch: greatest").numbers, ElementsAre(2, 2));
}

TEST_F(Compare, TheLowerLimitCountsAsTheUpper) {
  RunTexts shorter;
  shorter.events = with(shorter.events, "length=800.1", "length=799.84");
  const auto comparison = compared({}, shorter);
  EXPECT_EQ(figure(comparison, "knife.cut length: worst").numbers[1], 799.84);
  EXPECT_NEAR(figure(comparison, "knife.cut length: Cpk").numbers[1], 0.07 / (3 * 0.06 / std::sqrt(2.0)),
              1e-9);
}

TEST_F(Compare, FromMovesTheWindowOfAllFigures) {
  const auto comparison = compared({}, {}, 0.12);
  EXPECT_THAT(figure(comparison, "knife.cut length: number").numbers, ElementsAre(1, 1));
  EXPECT_THAT(figure(comparison, "knife.cut mismatch: mean").numbers, ElementsAre(2, 2));
  ASSERT_EQ(comparison.channels.size(), 2U);
  EXPECT_THAT(comparison.channels[1].rms, ElementsAre(4, 4));
}

TEST_F(Compare, ChannelsTellTheirLargestDifferenceAndWhere) {
  RunTexts other;
  other.trace = with(other.trace, "0.1,60,3", "0.1,60,5");
  const auto comparison = compared({}, other);
  ASSERT_EQ(comparison.channels.size(), 2U);
  const auto& error = comparison.channels[1];
  EXPECT_EQ(error.name, "AxisX.follerr");
  EXPECT_EQ(error.difference, 2);
  EXPECT_EQ(error.at, 0.1);
  EXPECT_THAT(error.peak, ElementsAre(4, 5));
  EXPECT_NEAR(error.rms[0], std::sqrt(25.0 / 2), 1e-12) << "from 60 ms on, behind the start-up";
  EXPECT_EQ(comparison.channels[0].difference, 0);
  EXPECT_EQ(difference_text(comparison), "different: 1 of 2 shared channels");
}

TEST_F(Compare, OnlyInstantsOfBothAreSubtracted) {
  RunTexts other;
  other.trace = "time [s],knife.speed [m/min],AxisX.follerr [bits x4]\n0.05,60,99\n0.1,60,3\n0.2,60,-4\n";
  const auto comparison = compared({}, other);
  EXPECT_EQ(comparison.channels[1].difference, 0);
  EXPECT_FALSE(same(comparison)) << "the instants differ";
}

TEST_F(Compare, AChannelOfAnotherUnitIsNotShared) {
  RunTexts other;
  other.trace = with(other.trace, "bits x4", "mm");
  const auto comparison = compared({}, other);
  EXPECT_EQ(comparison.channels.size(), 1U);
  EXPECT_THAT(comparison.unmatched, ElementsAre("a: AxisX.follerr [bits x4]", "b: AxisX.follerr [mm]"));
}

TEST_F(Compare, ChecksAreMatchedByNameWithWhatChanged) {
  RunTexts worse;
  worse.checks = RunTexts::checks_json(0.013, true);
  EXPECT_EQ(compared({}, worse).checks[0].change, "margin -0.04 mm");
  worse.checks = with(RunTexts().checks, "0.053000", "0.0529999");
  EXPECT_EQ(compared({}, worse).checks[0].change, "margin -1e-07 mm");
  worse.checks = with(RunTexts().checks, "0.053000", "0.052999999");
  EXPECT_EQ(compared({}, worse).checks[0].change, "") << "rounding";
  worse.checks = RunTexts::checks_json(-1, false);
  EXPECT_EQ(compared({}, worse).checks[0].change, "verdict");
  worse.checks = with(RunTexts().checks, "each cut", "each slice");
  EXPECT_EQ(compared({}, worse).checks[0].change, "expectation");
  worse.checks = with(RunTexts().checks, "cut length", "length of a cut");
  const auto renamed = compared({}, worse);
  ASSERT_EQ(renamed.checks.size(), 2U);
  EXPECT_EQ(renamed.checks[0].change, "only in a");
  EXPECT_EQ(renamed.checks[1].change, "only in b");
}

TEST_F(Compare, EventsThatDifferAreToldOneByOne) {
  RunTexts other;
  other.events = with(other.events, "length=799.9 mm", "length=799.8 mm");
  const auto comparison = compared({}, other);
  EXPECT_EQ(comparison.events_looked_at, 4U);
  ASSERT_EQ(comparison.event_differences.size(), 1U);
  EXPECT_EQ(comparison.event_differences[0].name, "knife.cut 3");
  EXPECT_THAT(comparison.event_differences[0].told,
              ElementsAre("0.150000 s: length=799.9 mm; mismatch=2 mm/s",
                          "0.150000 s: length=799.8 mm; mismatch=2 mm/s"));
}

TEST_F(Compare, OverlaysHoldACurveOfEachRun) {
  RunTexts other;
  other.trace = with(other.trace, "0.1,60,3", "0.1,60,5");
  const auto comparison = compared({}, other);
  const auto plots = overlay(comparison.runs, usual_overlays(comparison));
  ASSERT_EQ(plots.size(), 3U);
  EXPECT_EQ(plots[0].name, "events_knife_cut");
  ASSERT_EQ(plots[0].panels.size(), 2U);
  const auto& length = plots[0].panels[0];
  ASSERT_EQ(length.curves.size(), 2U);
  EXPECT_EQ(length.curves[0].label, "a");
  EXPECT_EQ(length.curves[1].label, "b");
  EXPECT_THAT(length.curves[0].x, ElementsAre(1, 2)) << "the first lies before the judged window";
  EXPECT_EQ(length.bands.size(), 1U);
  EXPECT_TRUE(plots[0].panels[1].bands.empty());
  EXPECT_EQ(plots[2].name, "overlay_AxisX");
  EXPECT_THAT(plots[2].panels[0].curves[0].y, ElementsAre(0, 3, -4));
  EXPECT_THAT(plots[2].panels[0].curves[1].y, ElementsAre(0, 5, -4));
  EXPECT_EQ(plots[2].panels[0].y_label, "AxisX.follerr [bits x4]");
}

// A channel that stands at 0 in one run has its panel still, or the others' curves would come into wrong
// ones.
TEST_F(Compare, AChannelThatIsZeroInOneRunIsStillLaidOverTheOthers) {
  RunTexts still;
  RunTexts moving;
  still.trace = "time [s],AxisX.vel [mm/s],AxisX.follerr [bits x4],AxisX.frb [1]\n0.0,0,1,0\n0.1,0,2,0\n";
  moving.trace = "time [s],AxisX.vel [mm/s],AxisX.follerr [bits x4],AxisX.frb [1]\n0.0,5,3,0\n0.1,6,4,0\n";
  for (const bool still_first : {true, false}) {
    const auto comparison = still_first ? compared(still, moving) : compared(moving, still);
    const auto plot = overlay(comparison.runs, usual_overlays(comparison)).back();
    EXPECT_EQ(plot.title, "Channels of AxisX (0 all the time: AxisX.frb)");
    ASSERT_EQ(plot.panels.size(), 2U);
    const std::size_t one = still_first ? 0 : 1;
    EXPECT_THAT(plot.panels[0].curves.at(one).y, ElementsAre(0, 0));
    EXPECT_THAT(plot.panels[0].curves.at(1 - one).y, ElementsAre(5, 6));
    EXPECT_THAT(plot.panels[1].curves.at(one).y, ElementsAre(1, 2));
  }
}

TEST_F(Compare, AWindowAboutAnEventCountsFromItInEachRun) {
  RunTexts late;
  late.events = with(late.events, "0.100000000,knife", "0.120000000,knife");
  const auto comparison = compared({}, late);
  OverlayRequest request;
  request.plot.name.text = "one_cut";
  request.plot.panels.emplace_back().channels = {{"AxisX.follerr", {}}};
  request.around = scenario::PicturesSection::Around{{"cut", {}}, 2, 30 * millisecond, 100 * millisecond};
  const auto plot = overlay(comparison.runs, {request})[0];
  EXPECT_EQ(plot.x_label, "time from cut 2 [s]");
  ASSERT_EQ(plot.panels[0].curves.size(), 2U);
  ASSERT_EQ(plot.panels[0].curves[0].x.size(), 2U);
  EXPECT_NEAR(plot.panels[0].curves[0].x[0], 0, 1e-12);
  EXPECT_NEAR(plot.panels[0].curves[0].x[1], 0.1, 1e-12);
  EXPECT_NEAR(plot.panels[0].curves[1].x[0], -0.02, 1e-12);
}

// One run has a piece more in its start-up: the pieces behind it are still laid beside each other.
TEST_F(Compare, PiecesAreAlignedByTheirOrderBehindTheStartUp) {
  RunTexts other;
  other.events = with(other.events, "0.100000000,knife",
                      "0.055,knife,cut,length=850 mm; mismatch=5 mm/s\n0.100000000,knife");
  const auto comparison = compared({}, other);
  ASSERT_EQ(comparison.pieces.size(), 1U);
  EXPECT_EQ(comparison.pieces[0].event, "knife.cut");
  EXPECT_THAT(comparison.pieces[0].runs, ElementsAre(ElementsAre(800.1, 799.9), ElementsAre(800.1, 799.9)));
  const auto plots = overlay(comparison.runs, usual_overlays(comparison));
  for (const auto& curve : plots[0].panels[0].curves) EXPECT_THAT(curve.x, ElementsAre(1, 2));
  EXPECT_THAT(comparison_table(comparison, {}).csv(),
              HasSubstr("\npiece,knife.cut length 2,mm,799.9,799.9\n"));
}

// No plot states limits: the first check that looks at the cuts later than from the start says where they
// count.
TEST_F(Compare, AStartUpIsAlsoWhatTheChecksLeaveOut) {
  RunTexts texts;
  texts.scenario = with(texts.scenario, ", limits: [799.8, 800.2]", "");
  EXPECT_THAT(figure(compared(texts, texts), "knife.cut length: number").numbers, ElementsAre(3, 3));
  texts.scenario =
      with(texts.scenario, "{name: cut length, each: cut,", "{name: cut length, each: cut, from: 120 ms,");
  EXPECT_THAT(figure(compared(texts, texts), "knife.cut length: number").numbers, ElementsAre(1, 1));
}

TEST_F(Compare, WhatHappensOnceHasOneRowAndStandsLast) {
  RunTexts texts;
  texts.events += "0.2,knife,saturated,asked=120 %\n";
  const auto events = compared(texts, texts).events;
  EXPECT_EQ(events.back().name, "knife.saturated asked");
  EXPECT_THAT(events.back().numbers, ElementsAre(120, 120));
  EXPECT_EQ(std::count_if(events.begin(), events.end(),
                          [](const auto& one) { return one.name.find("saturated") != std::string::npos; }),
            1);
}

// The length is changed on the way: the mean of all pieces is the length of none.
TEST_F(Compare, PiecesInLotsHaveTheirFiguresALotAtATime) {
  RunTexts texts;
  texts.events =
      "time [s],source,event,values\n"
      "0.07,knife,cut,length=800 mm\n0.08,knife,cut,length=802 mm\n0.09,knife,cut,length=700 mm\n"
      "0.10,knife,cut,length=801 mm\n0.12,knife,cut,length=600 mm\n0.14,knife,cut,length=602 mm\n";
  const auto comparison = compared(texts, texts);
  EXPECT_THAT(figure(comparison, "knife.cut length: number").numbers, ElementsAre(6, 6));
  EXPECT_THAT(figure(comparison, "knife.cut length, lot 1: number").numbers, ElementsAre(4, 4))
      << "one bad piece is no lot";
  EXPECT_THAT(figure(comparison, "knife.cut length, lot 1: mean").numbers, ElementsAre(775.75, 775.75));
  EXPECT_THAT(figure(comparison, "knife.cut length, lot 2: mean").numbers, ElementsAre(601, 601));
  for (const auto& one : comparison.events) EXPECT_NE(one.name, "knife.cut length: mean");
}

TEST(Lots, BeginWhereTwoPiecesInARowAreAnotherLength) {
  const auto counts = [](const std::vector<double>& lengths) {
    std::vector<std::size_t> found;
    for (const auto& lot : lots_of(lengths)) found.push_back(lot.count);
    return found;
  };
  EXPECT_THAT(counts({}), ElementsAre());
  EXPECT_THAT(counts({800}), ElementsAre(1));
  EXPECT_THAT(counts({800, 800, 805, 801}), ElementsAre(4)) << "within a hundredth";
  EXPECT_THAT(counts({800, 800, 600, 600, 600, 800, 800}), ElementsAre(2, 3, 2));
  EXPECT_THAT(counts({800, 800, 600}), ElementsAre(3)) << "the last alone";
  EXPECT_THAT(counts({800, 800, 600, 700, 800}), ElementsAre(5)) << "bad ones, each another";
}

TEST_F(Compare, CsvTellsFiguresChecksAndParametersOfEachRun) {
  RunTexts other;
  other.scenario = with(other.scenario, "speed: 60 m/min", "speed: \"80, m/min\"");
  const auto text = comparison_table(compared({}, other), {{"drift", "mm", {0.5, NAN}}}).csv();
  EXPECT_THAT(text, testing::StartsWith("what,name,unit,a,b\nrun,drycut,,0.1.0,0.1.0\n"));
  EXPECT_THAT(text, HasSubstr("\nfigure,drift,mm,0.5,\n"));
  EXPECT_THAT(text, HasSubstr("\ncheck,cut length,,passed,passed\nmargin,cut length,mm,0.053,0.053\n"));
  EXPECT_THAT(text, HasSubstr("\nevent,knife.cut length: number,,2,2\n"));
  EXPECT_THAT(text, HasSubstr("\nchannel,knife.speed: rms,m/min,60,60\n"));
  EXPECT_THAT(text, HasSubstr("\nparameter,plants.web.speed,,60 m/min,\"80, m/min\"\n"));
}

}  // namespace
}  // namespace drycut::sim::studies::comparing
