// From what was recorded to what is plotted: lanes and marks; and what a scenario's pictures may ask of its
// machine.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/loop/watch.hpp"
#include "sim/report/drives.hpp"
#include "sim/report/gallery.hpp"
#include "tests/findings.hpp"
#include "tests/loop/fakes.hpp"
#include "tests/loop/scenario/fake_plants.hpp"

namespace drycut::sim::report {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// Ten records of a lamp that blinks, with faults and cuts in between.
struct GalleryPlots : ::testing::Test {
  GalleryPlots() {
    panel.lamps["busy"];
    watch.record("panel.busy", recording);
    watch.record("web.speed", recording);
    for (int i = 0; i < 10; ++i) {
      panel.lamps["busy"].level = i % 4 >= 2;
      watch.update();
      recording.sample(i * millisecond);
    }
    recording.happened({millisecond, 0, "timeline", "set", {}, "panel.start = 1"});
    recording.happened({2 * millisecond, 0.0005, "knife", "cut", {{"length", 800, "mm"}}, ""});
    recording.happened({3 * millisecond, 0, "timeline", "power", {}, "off"});
    recording.happened({4 * millisecond, 0.00025, "knife", "cut", {{"length", 801, "mm"}}, ""});
    recording.happened({5 * millisecond, 0, "AxisX", "warning", {}, "st_warning: warning 12"});
    recording.happened({6 * millisecond, 0, "timeline", "fault", {}, "knife.encoder.lose_counts = 200"});
  }
  renders::Plot plot(const std::string& text) {
    std::vector<std::string> problems;
    const auto scenario = fakes::read("pictures: {plots: [{name: a, " + text + "}]}\n", problems);
    EXPECT_THAT(problems, IsEmpty());
    return plots_of(scenario, recording).at(0);
  }
  static std::vector<std::string> listed(const renders::Plot& plot) {
    std::vector<std::string> list;
    for (const auto& mark : plot.marks)
      list.push_back(std::to_string(std::lround(mark.x * 1e6)) + " us " + mark.label +
                     (mark.strong ? "!" : ""));
    return list;
  }

  fakes::FakePlant web;
  loop::OperatorPanel panel;
  loop::Names names{{{"web", &web}}, nullptr, panel};
  loop::Watch watch{names};
  record::Recording recording;
};

TEST_F(GalleryPlots, APanelThatIsZeroAllTheTimeIsLeftOutAndNamed) {
  record::Recording still;
  watch.record("panel.busy", still);
  watch.record("web.speed", still);
  still.append(0, {0, 0});
  still.append(second, {1, 0});
  const auto made = [&](const std::string& panels) {
    std::vector<std::string> problems;
    const auto scenario = fakes::read("pictures: {plots: [{name: a, panels: [" + panels + "]}]}\n", problems);
    EXPECT_THAT(problems, IsEmpty());
    return plots_of(scenario, still).at(0);
  };
  const auto plot = made("{channels: [web.speed]}, {channels: [panel.busy, web.speed]}");
  ASSERT_EQ(plot.panels.size(), 1U);
  EXPECT_EQ(plot.panels[0].curves.size(), 2U) << "beside one that moves it stays";
  EXPECT_EQ(plot.title, "a (0 all the time: web.speed)");
  EXPECT_EQ(made("{channels: [web.speed]}").panels.size(), 1U) << "all there is";
  EXPECT_EQ(made("{lanes: [web.speed]}, {channels: [panel.busy]}").panels.size(), 2U);
  EXPECT_EQ(made("{channels: [web.speed], limits: [-1, 1]}, {channels: [panel.busy]}").panels.size(), 2U)
      << "0 within its limits says something";
}

TEST_F(GalleryPlots, OfALongRunThePeaksAndTheChangesAreShownAndTheAxisSaysSo) {
  for (int i = 10; i < 200'000; ++i) {
    panel.lamps["busy"].level = i >= 150'001;
    web.speed = i == 77'777 ? 2.5 : 1;
    watch.update();
    recording.sample(i * millisecond);
  }
  const auto made = plot("panels: [{lanes: [panel.busy]}, {channels: [web.speed]}]");
  const auto& curve = made.panels.at(1).curves.at(0);
  EXPECT_LE(curve.x.size(), 20'000U);
  const auto peak = std::max_element(curve.y.begin(), curve.y.end()) - curve.y.begin();
  EXPECT_EQ(curve.y[static_cast<std::size_t>(peak)], 150);
  EXPECT_DOUBLE_EQ(curve.x[static_cast<std::size_t>(peak)], 77.777);
  EXPECT_EQ(made.x_label, "time [s], thinned: the lowest and the highest of 20 samples, 0.02 s");
  const auto& lane = made.panels.at(0).lanes.at(0);
  EXPECT_THAT(lane.x, ElementsAre(0, 0.002, 0.004, 0.006, 0.008, 150.001, 199.999));
  EXPECT_THAT(lane.y, ElementsAre(0, 1, 0, 1, 0, 1, 1)) << "changes, and the end";

  const auto window = plot("from: 77 s, until: 78 s, panels: [{channels: [web.speed]}]");
  EXPECT_EQ(window.x_label, "time [s]") << "a window is shown whole";
  EXPECT_EQ(window.panels.at(0).curves.at(0).x.size(), 1001U);
}

TEST_F(GalleryPlots, LanesShowTheRecordedStatesInTheOrderAskedFor) {
  const auto made = plot(
      "from: 2 ms, until: 5 ms, panels: [{title: outputs, lanes: [panel.busy]}, {channels: [web.speed]}]");
  ASSERT_EQ(made.panels.size(), 2U);
  ASSERT_EQ(made.panels[0].lanes.size(), 1U);
  EXPECT_EQ(made.panels[0].title, "outputs");
  EXPECT_EQ(made.panels[0].lanes[0].label, "panel.busy");
  EXPECT_THAT(made.panels[0].lanes[0].x, ElementsAre(0.002, 0.003, 0.004, 0.005));
  EXPECT_THAT(made.panels[0].lanes[0].y, ElementsAre(1, 1, 0, 0));
  EXPECT_TRUE(made.panels[0].curves.empty());
  EXPECT_TRUE(made.panels[1].lanes.empty());
}

TEST_F(GalleryPlots, FaultsAndPowerAreMarkedUnlessOtherEventsAreAskedFor) {
  EXPECT_THAT(listed(plot("panels: [{channels: [web.speed]}]")),
              ElementsAre("3000 us power off!", "6000 us lose_counts = 200!"));
  EXPECT_THAT(listed(plot("marks: [], panels: [{channels: [web.speed]}]")), IsEmpty());
  EXPECT_THAT(listed(plot("marks: [warning, cut], panels: [{channels: [web.speed]}]")),
              ElementsAre("2500 us cut 1", "4250 us cut 2", "5000 us warning"));
  EXPECT_THAT(listed(plot("marks: [set], panels: [{channels: [web.speed]}]")),
              ElementsAre("1000 us start = 1!"));
}

TEST_F(GalleryPlots, MarksOutsideTheWindowAreLeftOutButCounted) {
  EXPECT_THAT(
      listed(plot("from: 3 ms, until: 5 ms, marks: [knife.cut, fault], panels: [{channels: [web.speed]}]")),
      ElementsAre("4250 us cut 2"));
}

TEST_F(GalleryPlots, OnlyPlotsOverTimeHaveMarks) {
  EXPECT_THAT(listed(plot("against: number, panels: [{event: cut, values: [length]}]")), IsEmpty());
  EXPECT_THAT(listed(plot("panels: [{x: web.speed, y: web.speed}]")), IsEmpty());
}

TEST_F(GalleryPlots, TheOverviewHasTheUsualMarksToo) {
  std::vector<std::string> problems;
  const auto plots = plots_of(fakes::read("scene: {}\n", problems), recording);
  ASSERT_EQ(plots.size(), 1U);
  EXPECT_THAT(listed(plots[0]), ElementsAre("3000 us power off!", "6000 us lose_counts = 200!"));
}

// ---- plots whose x is not time ----

struct Histogram : GalleryPlots {
  /// Cuts of these lengths [mm], one a second from 10 s on.
  renders::Plot of(const std::vector<double>& lengths, const std::string& more) {
    Time at = 10 * second;
    for (const double length : lengths) {
      recording.happened({at, 0, "saw", "drop", {{"length", length, "mm"}}, ""});
      at += second;
    }
    return plot("from: 10 s, panels: [{event: drop, values: [length], histogram: on" + more + "}]");
  }
  /// Bars as (middle, count), those of no count left out.
  static std::vector<std::pair<double, double>> bars(const renders::Plot& plot) {
    std::vector<std::pair<double, double>> list;
    const auto& curve = plot.panels.at(0).curves.at(0);
    for (std::size_t i = 1; i + 1 < curve.x.size(); i += 4) {
      if (curve.y[i] > 0) list.emplace_back((curve.x[i] + curve.x[i + 1]) / 2, curve.y[i]);
    }
    return list;
  }
};

TEST_F(Histogram, CountsEveryValueOnceAndTellsTheCapability) {
  // Mean 500.05, standard deviation sqrt(1/30); limits 499 and 501: Cp = 2 / (6 sd), Cpk = 0.95 / (3 sd).
  const auto made = of({499.8, 500.0, 500.2, 500.2}, ", limits: [499, 501]");
  EXPECT_THAT(bars(made), testing::ElementsAre(testing::Pair(testing::DoubleNear(499.8, 1e-9), 1),
                                               testing::Pair(testing::DoubleNear(500.0, 1e-9), 1),
                                               testing::Pair(testing::DoubleNear(500.2, 1e-9), 2)));
  EXPECT_EQ(made.x_label, "length [mm]");
  const double sd = std::sqrt(((0.25 * 0.25) + (0.05 * 0.05) + 2 * (0.15 * 0.15)) / 3);
  char expected[64];
  std::snprintf(expected, sizeof expected, "Cp %.2f, Cpk %.2f", 2 / (6 * sd), 0.95 / (3 * sd));
  EXPECT_THAT(made.panels[0].title, HasSubstr(expected));
  EXPECT_THAT(made.panels[0].title, HasSubstr("4 values, mean 500.05 mm, from 499.8 to 500.2"));
  EXPECT_THAT(listed(made), ElementsAre("499000000 us 499!", "500050000 us mean", "501000000 us 501!"));
}

TEST_F(Histogram, TheWindowCountsAndNoLimitsAreNoCpk) {
  auto made = of({1, 2, 3}, "");
  EXPECT_THAT(made.panels[0].title, Not(HasSubstr("Cp")));
  EXPECT_EQ(bars(made).size(), 3U);
  made = plot("from: 11 s, until: 11500 ms, panels: [{event: drop, values: [length], histogram: on}]");
  EXPECT_THAT(made.panels[0].title, HasSubstr("1 values, mean 2 mm"));
}

TEST_F(Histogram, WithoutSpreadOrValuesThereIsNoCpk) {
  EXPECT_THAT(of({500, 500, 500}, ", limits: [499, 501]").panels[0].title, HasSubstr("no spread"));
  EXPECT_THAT(
      plot("from: 10 s, until: 10500 ms, panels: [{event: drop, values: [length], histogram: on, limits: "
           "[499, 501]}]")
          .panels[0]
          .title,
      HasSubstr("too few for a Cpk"));
  EXPECT_TRUE(
      plot("from: 90 s, panels: [{event: drop, values: [length], histogram: on}]").panels[0].curves.empty());
}

TEST_F(Histogram, ABeyondTheLimitIsANegativeCpk) {
  EXPECT_THAT(of({502, 502.5, 503}, ", limits: [499, 501]").panels[0].title, HasSubstr("Cpk -1.00"));
}

TEST(SpectrumPlot, NamesWhatTurnsAsOftenAndWhatPiecesOfOneLengthShowAlike) {
  record::Recording recording;
  const double pi = std::numbers::pi;
  for (int i = 1; i <= 40; ++i) {
    const double length = 800 + 0.5 * (std::sin(2 * pi * 1.6 * i) - std::sin(2 * pi * 1.6 * (i - 1)));
    recording.happened({i * 800 * millisecond, 0, "k", "cut", {{"length", length, "mm"}}, ""});
  }
  std::vector<std::string> problems;
  const auto scenario = fakes::read(
      "pictures: {plots: [{name: s, panels: [{title: wheel, event: cut, values: [length], spectrum: "
      "on}]}]}\n",
      problems);
  const MachineFacts machine{{}, {{"web.wheel", 0.5, 0}, {"k.drum", 0, 1}, {"k.motor", 0, 0.4}}};
  const auto plot = plots_of(scenario, recording, machine).at(0);
  EXPECT_EQ(plot.panels.at(0).title, "wheel: 0.951 mm at 500 mm: once a turn of web.wheel");
  EXPECT_EQ(plot.panels[0].y_label, "amplitude of length [mm]");
  EXPECT_EQ(plot.x_label, "how often it comes, in a metre of web [1/m]");
  std::vector<std::string> marks;
  for (const auto& mark : plot.marks) marks.push_back(mark.label);
  EXPECT_THAT(marks, ElementsAre("2000 mm alike", "1333 mm alike", "571.4 mm alike", "500 mm web.wheel"));
  EXPECT_THAT(
      findings_of(scenario, recording, machine),
      ElementsAre("length of cut: 0.951 mm at 500 mm: once a turn of web.wheel, as an error of its place by "
                  "0.5 mm makes it; pieces of this length show 2000 mm, 1333 mm, 571.4 mm alike, others "
                  "would tell"));
  const auto none = findings_of(scenario, record::Recording(), machine);
  EXPECT_THAT(none, ElementsAre("length of cut: 0 values are too few"));
}

TEST(SpectrumPlot, AValueWithoutALengthGoesByTheEvents) {
  record::Recording recording;
  for (int i = 0; i < 60; ++i)
    recording.happened({(i + 1) * 800 * millisecond,
                        0,
                        "k",
                        "cut",
                        {{"force", 100 + 3 * std::sin(2 * std::numbers::pi * i / 4.0 + 1), "N"}},
                        ""});
  std::vector<std::string> problems;
  const auto scenario = fakes::read(
      "pictures: {plots: [{name: s, panels: [{event: cut, values: [force], spectrum: on}]}]}\n", problems);
  const MachineFacts machine{{}, {{"web.wheel", 0.5, 0}, {"k.drum", 0, 4}}};
  const auto plot = plots_of(scenario, recording, machine).at(0);
  EXPECT_EQ(plot.panels.at(0).title, "3 N at 4 cuts: once a turn of k.drum");
}

TEST(MotorPlot, ShowsTheOperatingPointsInTheMotorsLimits) {
  Problems problems;
  const auto scenario = scenario::read_scenario_text(
      "scene: {duration: 500 ms}\nplants: {w: {type: web}, k: {type: rotary_knife, web: w, servo: "
      "{rated_speed: 1500 "
      "rpm}}}\n"
      "pictures: {plots: [{name: m, panels: [{title: drum, motor: k}]}]}\n",
      "line.yaml", {}, problems);
  loop::Simulation simulation(scenario, problems);
  ASSERT_TRUE(problems.empty()) << to_string(problems.front());
  const auto outcome = simulation.run();
  const auto plots = plots_of(scenario, simulation.recording(), {outcome.drives, {}});
  ASSERT_EQ(plots.size(), 1U);
  const auto& panel = plots[0].panels.at(0);
  ASSERT_EQ(panel.curves.size(), 3U);
  const auto& recording = simulation.recording();
  for (std::size_t i = 0; i < panel.curves[0].x.size(); ++i) {
    EXPECT_NEAR(panel.curves[0].x[i], recording.column("k.motor.speed")->values[i], 1e-9);
    EXPECT_NEAR(panel.curves[0].y[i], recording.column("k.motor.torque")->values[i], 1e-9);
  }
  EXPECT_EQ(panel.curves[0].x.size(), recording.times().size());
  EXPECT_THAT(drive_plots(outcome.drives, scenario.pictures.plots), testing::IsEmpty())
      << "the scenario has the picture already";
  EXPECT_EQ(drive_plots(outcome.drives, {}).size(), 1U);
  // HG-SR202: 28.6 N m up to rated speed, 19 N m at 3000 rpm; it only stood or turned forwards.
  const auto& peak = panel.curves[1];
  const std::vector<double> speeds = {0, 1500, 3000, 3000, 1500, 0};
  const std::vector<double> torques = {28.6, 28.6, 19, -28.6, -28.6, -28.6};
  ASSERT_EQ(peak.x.size(), speeds.size());
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    EXPECT_NEAR(peak.x[i], speeds[i], 1e-9) << i;
    EXPECT_NEAR(peak.y[i], torques[i], 1e-9) << i;
  }
  EXPECT_NEAR(panel.curves[2].x[1], 1500, 1e-9);
  EXPECT_NEAR(panel.curves[2].y[1], 9.5, 1e-9);
  EXPECT_THAT(panel.title, HasSubstr("drum: rms "));
  EXPECT_EQ(plots[0].x_label, "motor speed [rpm]");
}

std::vector<std::string> binding_problems(const std::string& pictures) {
  Problems problems;
  const auto scenario = scenario::read_scenario_text(
      "scene: {duration: 1 s}\nplants: {w: {type: web}}\n" + pictures, "line.yaml", {}, problems);
  const loop::Simulation simulation(scenario, problems);
  std::vector<std::string> list;
  for (const auto& problem : problems) list.push_back(to_string(problem));
  return list;
}

TEST(PicturesBinding, WhatTheMachineDoesNotHave) {
  const auto plot = [](const std::string& text) {
    return binding_problems("pictures: {plots: [{name: a, " + text + "}]}\n");
  };
  EXPECT_THAT(plot("panels: [{lanes: [w.speed, w.pieces]}]"),
              ElementsAre("line.yaml:3:48: w.speed is a quantity in m/min, not a state; show it in a panel "
                          "of channels [scenario.wrong-kind]"));
  EXPECT_THAT(plot("panels: [{lanes: [w.sped]}]"),
              ElementsAre(HasSubstr("3:48: there is no channel 'w.sped'; did you mean w.speed?")));
  EXPECT_THAT(plot("marks: [fault, timeline.power, error, faul], panels: [{channels: [w.speed]}]"),
              ElementsAre("line.yaml:3:68: nothing here reports an event 'faul'; did you mean fault? "
                          "[scenario.unknown-event]"));
  EXPECT_THAT(
      plot("panels: [{motor: w}]"),
      ElementsAre(
          "line.yaml:3:47: 'w' is no plant with a drive that has ratings; name a plant with parameters "
          "servo.rated_torque, servo.peak_torque, ... [scenario.unknown-name]"));
  EXPECT_THAT(plot("panels: [{motor: x}]"), ElementsAre(HasSubstr("'x' is no plant with a drive")));
  EXPECT_THAT(plot("panels: [{event: ct, values: [length]}]"),
              ElementsAre(HasSubstr("nothing here reports an event 'ct'")));
  EXPECT_THAT(binding_problems("pictures: {frames: {around: \"ct[2]\"}}\n"),
              ElementsAre(HasSubstr("3:30: nothing here reports an event 'ct'")));
  EXPECT_THAT(
      binding_problems("pictures: {frames: {every: 2 ms, slow: 30}}\n"),
      ElementsAre(
          "line.yaml:3:40: pictures.frames: a frame every 2000000 ns / 30 is not a whole multiple "
          "of the step of 100000 ns; choose every = slow x a multiple of the step [scenario.time-grid]"));
  EXPECT_THAT(binding_problems("pictures: {frames: {every: 2 ms, slow: 20, around: fault}}\n"), IsEmpty());
}

TEST(PicturesBinding, FramesAboutAnEventThatNeverComesAreNoted) {
  Problems problems;
  const auto scenario = scenario::read_scenario_text(
      "scene: {duration: 100 ms}\nplants: {w: {type: web}}\ntimeline: [{at: 10 ms, fault: {w.wheel: "
      "{lose_counts: 3}}}]\npictures: {frames: {around: \"fault[2]\"}}\n",
      "line.yaml", {}, problems);
  loop::Simulation simulation(scenario, problems);
  ASSERT_TRUE(problems.empty()) << to_string(problems.front());
  simulation.run();
  EXPECT_TRUE(simulation.snapshots().empty());
  EXPECT_THAT(codes(simulation.notes()), ElementsAre("pictures.event-missing"));
}

}  // namespace
}  // namespace drycut::sim::report
