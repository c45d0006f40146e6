// What is kept of the cams of a run, how far it is from the ideal, and the report's page of it.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "devices/lx3vp/ecamtbx.hpp"
#include "sim/cams/judged.hpp"
#include "sim/cams/overlay.hpp"
#include "sim/cams/page.hpp"
#include "sim/cams/study.hpp"
#include "sim/loop/played_cams.hpp"
#include "tests/sim/cams/bench.hpp"

namespace drycut::sim::cams {
namespace {

using loop::CamRecorder;
using loop::PlayedCam;
using testing::Contains;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// A cycle of 400 of the master and 300 of the slave: to the master's speed, with it, back to rest. 1 Um is 2
/// bits.
const std::string cam = "# pulse: 2\n# maxvel: 20000\n# unitvel: 1\n" + cams::header +
                        "1,132,100,50\n2,133,200,200\n3,135,100,50\n4,137,1\n";
double slave_of(double master) {
  const double cycle = std::floor(master / 400);
  const double m = master - 400 * cycle;
  const double way = m < 100 ? m * m / 200 : m < 300 ? m - 50 : 300 - (400 - m) * (400 - m) / 200;
  return 300 * cycle + way;
}

std::shared_ptr<const devices::CamTable> held(const std::string& text) {
  return cams::held("camming4", text);
}

/// An axis that plays what a test tells it.
struct FakeAxis {
  std::uint64_t start = 0;
  devices::CamMoment moment;
  std::shared_ptr<const devices::CamTable> table = held(cam);

  devices::CamAxis axis(const std::string& name = "AxisX") {
    devices::CamAxis made;
    made.name = name;
    made.start = [this] { return start; };
    made.moment = [this] { return moment; };
    made.table = [this] { return table; };
    return made;
  }
  void at(double master, double error = 0, double behind = 0.5) {
    moment = {true, master, slave_of(master) + error, 0, behind};
  }
};

struct PlayedCams : testing::Test {
  CamRecorder recorder_of() { return {{fake.axis()}, no_drive}; }
  /// From `from` to `to` in steps of 5, one each 2 ms, `error` Um beside the cam.
  void run(CamRecorder& recorder, double from, double to, double error = 0) {
    for (double master = from; master <= to; master += 5) {
      fake.at(master, error);
      recorder.step();
      recorder.sample(time += 2 * millisecond);
    }
  }
  static IdealCam ideal(const PlayedCam& played, double last) { return ideal_cam(*played.table, {0, last}); }

  const CamRecorder::Deviation no_drive = [](const devices::Address& /*pulses*/) {
    return std::function<double()>();
  };
  FakeAxis fake;
  Time time = 0;
};

TEST_F(PlayedCams, TheTableIsTheOneAtTheStart) {
  auto recorder = recorder_of();
  recorder.step();
  recorder.sample(0);
  EXPECT_THAT(recorder.played(), ElementsAre(Field(&PlayedCam::samples, IsEmpty())));
  fake.start = 1;
  fake.at(0);
  recorder.step();
  fake.table = held(cam + "9,136\n");
  recorder.step();
  recorder.sample(1);
  const auto played = recorder.played();
  ASSERT_EQ(played.size(), 1U);
  EXPECT_EQ(*played[0].table, *held(cam));
  EXPECT_EQ(played[0].samples.size(), 1U);
}

TEST_F(PlayedCams, OnlyWhatIsOnTheCamIsKeptAndEveryEntryIsMarked) {
  auto recorder = recorder_of();
  fake.start = 1;
  run(recorder, 0, 10);
  fake.moment = {};
  recorder.sample(time += millisecond);
  run(recorder, 20, 25);
  fake.start = 2;
  run(recorder, 0, 0);
  const auto samples = recorder.played().at(0).samples;
  std::vector<bool> begins;
  for (const auto& sample : samples) begins.push_back(sample.begins);
  EXPECT_THAT(begins, ElementsAre(true, false, false, true, false, true));
}

TEST_F(PlayedCams, StartsWithOneTableAreOneCamAndOthersAreOthersUpToEight) {
  auto recorder = recorder_of();
  for (int i = 0; i < 20; ++i) {
    fake.start = static_cast<std::uint64_t>(i) + 1;
    fake.table = held(cam + fmt::format("9,133,{},0\n", i % 10));
    run(recorder, 0, 5);
  }
  const auto played = recorder.played();
  ASSERT_EQ(played.size(), 8U);
  for (const auto& one : played) EXPECT_EQ(one.samples.size(), 4U);
  EXPECT_EQ(recorder.untold(), 4U);
}

TEST_F(PlayedCams, AnAxisWithoutATableIsNone) {
  fake.table = nullptr;
  auto recorder = recorder_of();
  fake.start = 1;
  run(recorder, 0, 50);
  EXPECT_THAT(recorder.played(), IsEmpty());
}

TEST_F(PlayedCams, WhereTheDeviceDoesNotMeasureTheDriveIsAsked) {
  auto axis = fake.axis();
  axis.pulses = devices::Address{devices::Kind::output, 0, 0};
  fake.start = 1;
  fake.at(10);
  fake.moment.behind.reset();
  for (const bool tells : {true, false}) {
    CamRecorder recorder({axis}, [&](const devices::Address& pulses) {
      EXPECT_EQ(pulses.number, 0);
      return tells ? std::function<double()>([] { return 7.0; }) : std::function<double()>();
    });
    recorder.step();
    recorder.sample(0);
    const double behind = recorder.played().at(0).samples.at(0).behind;
    if (tells)
      EXPECT_EQ(behind, 7);
    else
      EXPECT_TRUE(std::isnan(behind));
  }
}

TEST_F(PlayedCams, ACamThatIsPlayedAsItIsHasNoError) {
  auto recorder = recorder_of();
  fake.start = 1;
  run(recorder, 0, 1590);
  const auto played = recorder.played().at(0);
  const auto errors = errors_of(played, ideal(played, 1590));
  EXPECT_LT(figures_of(errors.set).largest, 1e-9);
  EXPECT_EQ(figures_of(errors.set).count, played.samples.size());
  EXPECT_DOUBLE_EQ(figures_of(errors.behind).largest, 1.0);  // 0.5 Um
}

TEST_F(PlayedCams, AWrongCamShowsInBits) {
  auto recorder = recorder_of();
  fake.start = 1;
  run(recorder, 0, 395);
  run(recorder, 400, 800, -3);
  const auto played = recorder.played().at(0);
  const auto figures = figures_of(errors_of(played, ideal(played, 800)).set);
  EXPECT_NEAR(figures.largest, 6, 1e-9);
  EXPECT_NEAR(figures.rms, 6 / std::sqrt(2.0), 0.05);
}

TEST_F(PlayedCams, WholeTurnsOfTheSlaveAreNoError) {
  PlayedCam played{"Knife", held(cam)};
  played.samples.push_back({0, true, 150, slave_of(150) - 360, 0, 360});
  played.samples.push_back({0, false, 150, slave_of(150) + 719, 0, 360});
  EXPECT_THAT(errors_of(played, ideal(played, 400)).set,
              ElementsAre(testing::DoubleNear(0, 1e-9), testing::DoubleNear(-2, 1e-9)));
}

TEST_F(PlayedCams, CyclesAreWholeFromEndToEndOfOneEntry) {
  auto recorder = recorder_of();
  fake.start = 1;
  run(recorder, 0, 1000);
  fake.start = 2;
  run(recorder, 0, 200);
  const auto played = recorder.played().at(0);
  const auto cycles = cycles_of(played, ideal(played, 1000));
  std::vector<std::string> listed;
  for (const auto& cycle : cycles)
    listed.push_back(
        fmt::format("{}: {} {}{}", cycle.cycle, cycle.first, cycle.last, cycle.whole ? " whole" : ""));
  EXPECT_THAT(listed, ElementsAre("0: 0 79 whole", "1: 80 159 whole", "2: 160 200", "0: 201 241"));
  EXPECT_EQ(shown_cycle(cycles), &cycles[1]);
  const std::vector<PlayedCycle> parts = {cycles[2], cycles[3], {0, 0, 10, false}};
  EXPECT_EQ(shown_cycle(parts), parts.data());
  EXPECT_EQ(shown_cycle({}), nullptr);
}

TEST_F(PlayedCams, TwoEntriesDoNotMakeOneWholeCycle) {
  auto recorder = recorder_of();
  fake.start = 1;
  run(recorder, 0, 200);
  fake.start = 2;
  run(recorder, 205, 395);
  const auto played = recorder.played().at(0);
  const auto cycles = cycles_of(played, ideal(played, 400));
  ASSERT_EQ(cycles.size(), 2U);
  EXPECT_FALSE(cycles[0].whole);
  EXPECT_FALSE(cycles[1].whole);
}

TEST_F(PlayedCams, TheOverlayLaysTheErrorsBelowThePositions) {
  auto recorder = recorder_of();
  fake.start = 1;
  run(recorder, 0, 395, 2);
  run(recorder, 400, 1200);
  const auto played = recorder.played().at(0);
  const auto exact = ideal(played, 1200);
  const auto errors = errors_of(played, exact);
  const auto cycles = cycles_of(played, exact);
  const auto plot = overlay_plot(played, exact, errors, cycles, *shown_cycle(cycles), "o");
  ASSERT_EQ(plot.panels.size(), 3U);
  const auto& position = plot.panels[0].curves;
  ASSERT_EQ(position.size(), 3U);
  EXPECT_EQ(position[0].label, "ideal");
  EXPECT_NEAR(position[1].y.at(40), slave_of(200), 1e-9);
  EXPECT_NEAR(position[2].y.at(40), slave_of(200) - 0.5, 1e-9);
  EXPECT_EQ(plot.panels[1].title, "set minus ideal position: 0 bits x4 at most in this cycle");
  const auto& set = plot.panels[1].curves;
  ASSERT_EQ(set.size(), 2U);
  EXPECT_EQ(set[0].label, "2 other cycles");
  EXPECT_TRUE(set[0].faint);
  EXPECT_TRUE(std::is_sorted(set[0].x.begin(), set[0].x.end()));
  EXPECT_EQ(*std::max_element(set[0].y.begin(), set[0].y.end()), 4);
  EXPECT_EQ(plot.panels[2].title,
            "following error, set minus measured position: 1 bits x4 at most in this cycle");
  EXPECT_EQ(plot.x_label, "master in the cycle [Um]");
  ASSERT_EQ(plot.zones.size(), 3U);
  EXPECT_TRUE(plot.zones[1].strong);
  EXPECT_EQ(plot.zones[1].from, 100);
  EXPECT_EQ(plot.marks[1].label, "2 RSC synchronism");
}

TEST_F(PlayedCams, AnErrorFarBelowACountIsNotDrawnAsOne) {
  auto recorder = recorder_of();
  fake.start = 1;
  run(recorder, 0, 400, 1e-7);
  const auto played = recorder.played().at(0);
  const auto exact = ideal(played, 400);
  const auto cycles = cycles_of(played, exact);
  const auto plot = overlay_plot(played, exact, errors_of(played, exact), cycles, *shown_cycle(cycles), "o");
  ASSERT_EQ(plot.panels.size(), 2U) << "a flat line tells nothing";
  EXPECT_EQ(plot.panels[0].title, "slave position; set minus ideal position below 0.5 bits x4");
  EXPECT_THAT(plot.panels[1].title, testing::StartsWith("following error"));
  EXPECT_EQ(error_text(0.0005, 1), "below 0.001");
  EXPECT_EQ(error_text(5e-8, 1e-4), "below 0.0000001");
  EXPECT_EQ(error_text(0.06055, 1e-4), "0.06055");
  EXPECT_EQ(error_text(0, 1), "0");
}

TEST_F(PlayedCams, TheFastestMasterIsTakenOver20Milliseconds) {
  auto recorder = recorder_of();
  fake.start = 1;
  run(recorder, 0, 300);  // 5 Um in 2 ms
  EXPECT_NEAR(recorder.played().at(0).fastest, 2500, 1e-9);
  // One jump of the counter is no speed, nor is the way from the end of one start to the next one.
  fake.at(310);
  recorder.sample(time += 2 * millisecond);
  EXPECT_LT(recorder.played().at(0).fastest, 2800);
  fake.start = 2;
  run(recorder, 50'000, 50'005);
  EXPECT_LT(recorder.played().at(0).fastest, 2800);
}

struct CamPages : PlayedCams {
  static std::string cells(const renders::ReportTable& table) {
    std::string text;
    for (const auto& row : table.rows) {
      for (const auto& cell : row.cells) text += cell + " | ";
      text += '\n';
    }
    return text;
  }
  static const renders::ReportTable& table(const CamPage& page, const std::string& title) {
    for (const auto& one : page.tables)
      if (one.title == title) return one;
    ADD_FAILURE() << "no table " << title;
    return page.tables.at(0);
  }
};

TEST_F(CamPages, ShowTheCamItsFeasibilityAndTheRun) {
  auto recorder = recorder_of();
  fake.start = 1;
  run(recorder, 0, 1200);
  const auto pages = cam_pages(recorder.played());
  ASSERT_EQ(pages.size(), 1U);
  const auto& page = pages[0];
  EXPECT_EQ(page.title, "Cam of AxisX");
  EXPECT_EQ(page.name, "AxisX");
  EXPECT_EQ(*held(page.table), *held(cam));
  ASSERT_EQ(page.plots.size(), 2U);
  EXPECT_EQ(page.plots[0].name, "cam_AxisX");
  EXPECT_EQ(page.plots[0].panels.size(), 4U);
  ASSERT_TRUE(page.plots[0].second_x.has_value());
  EXPECT_DOUBLE_EQ(page.plots[0].second_x->factor, 1 / 2500.0);
  EXPECT_EQ(page.plots[1].name, "cam_AxisX_played");
  const auto feasible = cells(table(page, "Feasibility"));
  EXPECT_THAT(feasible,
              HasSubstr("velocity | 2500 Um/s at master 100 Um | maxvel 20000 Um/s | PASS 87.5 % left"));
  EXPECT_THAT(feasible, HasSubstr("verdict | the cam is sound |  | PASS"));
  EXPECT_THAT(
      cells(table(page, "Cam tracking error")),
      HasSubstr(
          "set minus measured position (following error) | 1 bits x4 | 1 bits x4 | 241 samples, 3 whole"));
  EXPECT_EQ(table(page, "Sectors in the order of running").headings.at(2), "master [Um]");
}

TEST_F(CamPages, FailWhatTheFastestMasterMakesTooFast) {
  fake.table = held("# pulse: 2\n# maxvel: 2000\n# unitvel: 1\n" + cam.substr(cam.find("sector")));
  auto recorder = recorder_of();
  fake.start = 1;
  run(recorder, 0, 400);
  const auto feasible = cells(table(cam_pages(recorder.played()).at(0), "Feasibility"));
  EXPECT_THAT(feasible, HasSubstr("maxvel 2000 Um/s | FAIL 25.0 % too much"));
  EXPECT_THAT(feasible, HasSubstr("FAIL limit"));
  EXPECT_THAT(feasible, HasSubstr("verdict | the cam is not sound |  | FAIL"));
}

TEST_F(CamPages, SayThatACamWasNeverEntered) {
  const auto recorder = recorder_of();
  const auto pages = cam_pages(recorder.played());
  ASSERT_EQ(pages.size(), 1U);
  EXPECT_THAT(pages[0].notes, Contains("No slave was on this cam in the run: only the cam is shown."));
  EXPECT_EQ(pages[0].plots.size(), 1U);
  EXPECT_FALSE(pages[0].plots[0].second_x.has_value());
}

TEST_F(CamPages, SayWhyATableCannotBeShown) {
  CammingTable table;
  table.sectors[0] = {{.codeG = 999}, 1};
  fake.table = std::make_shared<const devices::CamTable>(table);
  auto recorder = recorder_of();
  fake.start = 1;
  run(recorder, 0, 10);
  const auto pages = cam_pages(recorder.played());
  EXPECT_THAT(
      pages.at(0).notes,
      Contains(HasSubstr("drycut cam does not take this table: AxisX.csv:9:3: there is no codeG 999")));
  EXPECT_THAT(pages.at(0).plots, IsEmpty());
}

TEST_F(CamPages, NumberTheTablesOfAnAxis) {
  auto recorder = recorder_of();
  for (int i = 1; i <= 2; ++i) {
    fake.start = static_cast<std::uint64_t>(i);
    fake.table = held(cam + fmt::format("9,133,{},0\n", i));
    run(recorder, 0, 400);
  }
  auto played = recorder.played();
  played.push_back({"Y0 (DECAM D1000)", cams::held("lx3vp", "master,slave\n0,0\n100,50\n")});
  const auto pages = cam_pages(played);
  ASSERT_EQ(pages.size(), 3U);
  EXPECT_EQ(pages[1].title, "Cam of AxisX, table 2 of 2");
  EXPECT_EQ(pages[1].name, "AxisX_2");
  EXPECT_EQ(pages[2].name, "Y0_DECAM_D1000");
}

}  // namespace
}  // namespace drycut::sim::cams
