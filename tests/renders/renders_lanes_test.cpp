// Panels of lanes: states of digital signals and of phases over time.
#include "renders/decimate.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "renders/plot_layout.hpp"
#include "renders/png_image.hpp"
#include "renders/text.hpp"
#include "tests/renders/renders_scratch.hpp"

namespace drycut::renders {
namespace {

using ::testing::HasSubstr;

std::vector<std::array<double, 3>> listed(const std::vector<LaneState>& states) {
  std::vector<std::array<double, 3>> list;
  for (const auto& state : states) list.push_back({state.from, state.until, state.mixed ? -99 : state.value});
  return list;
}
using List = std::vector<std::array<double, 3>>;

TEST(Lanes, AStateLastsUntilTheFirstSampleOfTheNext) {
  EXPECT_EQ(listed(lane_states({"a", {0, 1, 2, 3, 4}, {0, 0, 1, 1, 0}})),
            (List{{0, 2, 0}, {2, 4, 1}, {4, 4, 0}}));
  EXPECT_EQ(listed(lane_states({"a", {}, {}})), List{});
}

TEST(Lanes, AGapStaysAGap) {
  const double gap = std::nan("");
  EXPECT_EQ(listed(lane_states({"a", {0, 1, 2, 3, 4}, {1, 1, gap, 1, 1}})), (List{{0, 2, 1}, {3, 4, 1}}));
}

TEST(Lanes, OnlyZerosAndOnesAreDigital) {
  EXPECT_TRUE(is_digital({"a", {0, 1}, {0, 1}}));
  EXPECT_TRUE(is_digital({"a", {0, 1}, {std::nan(""), 1}}));
  EXPECT_FALSE(is_digital({"a", {0, 1}, {0, 2}}));
  EXPECT_FALSE(is_digital({"a", {0, 1}, {0, -1}}));
}

TEST(Lanes, AShortPulseIsDrawnAPixelWide) {
  const auto states = lane_states({"a", {0, 5, 5.001, 9}, {0, 1, 0, 0}});
  EXPECT_EQ(listed(high_states(states, 0.1)), (List{{5, 5.1, 1}}));
}

TEST(Lanes, PulsesThatCannotBeToldApartJoin) {
  Lane lane{"a", {}, {}};
  for (int i = 0; i <= 100000; ++i) {
    lane.x.push_back(i);
    lane.y.push_back(i % 2);
  }
  EXPECT_EQ(high_states(lane_states(lane), 100).size(), 1U);
  EXPECT_EQ(high_states(lane_states(lane), 0.5).size(), 50000U);
}

TEST(Lanes, StatesNarrowerThanAPixelBecomeOneMixedBand) {
  const auto states = lane_states({"a", {0, 10, 10.1, 10.2, 10.3, 20}, {1, 2, 3, 4, 5, 5}});
  EXPECT_EQ(listed(told_apart(states, 1)), (List{{0, 10, 1}, {10, 10.3, -99}, {10.3, 20, 5}}));
}

Plot with_lanes(std::size_t count) {
  Plot plot{"lanes", "Lanes", "time [s]", {}, 1200, 260};
  Panel lanes{"outputs", "", {}, {}, {}};
  for (std::size_t i = 0; i < count; ++i) {
    Lane lane{"2.OUT0" + std::to_string(i + 1), {}, {}};
    for (int k = 0; k <= 1000; ++k) {
      lane.x.push_back(0.01 * k);
      lane.y.push_back(k / 100 % 2 == static_cast<int>(i % 2) ? 1 : 0);
    }
    lanes.lanes.push_back(lane);
  }
  plot.panels.push_back(lanes);
  plot.panels.push_back({"position", "[mm]", {{"x", {0, 10}, {0, 1}}}, {}, {}});
  return plot;
}

TEST(LanePanel, SharesTheTimeAxisAndIsAsHighAsItsLanesNeed) {
  const auto three = laid_out(with_lanes(3));
  const auto six = laid_out(with_lanes(6));
  const auto height = [](const PanelLayout& panel) { return panel.bottom - panel.top; };
  EXPECT_DOUBLE_EQ(height(six.panels[0]), 2 * height(three.panels[0]));
  EXPECT_DOUBLE_EQ(height(six.panels[1]), height(three.panels[1]));
  EXPECT_EQ(three.x_range, (Range{0, 10}));
  ASSERT_EQ(three.panels[0].y_ticks.size(), 3U);
  EXPECT_EQ(three.panels[0].y_ticks[0].label, "2.OUT01") << "the first lane is the uppermost";
  EXPECT_DOUBLE_EQ(three.panels[0].y_ticks[0].value, 2.5);
  EXPECT_LE(text_width("2.OUT01", PlotType::text), three.left) << "the names fit left of the axis";
}

TEST(LanePanel, ALongNameLeavesRoomForTheLanes) {
  auto plot = with_lanes(1);
  plot.panels[0].lanes[0].label = std::string(300, 'x');
  EXPECT_LT(laid_out(plot).left, 0.35 * plot.width);
}

TEST(LanePanel, HighIsFilledAndLowIsNot) {
  const Scratch scratch;
  const Plot plot = with_lanes(2);
  const auto layout = laid_out(plot);
  const Image image = read_png(draw_plots({plot}, scratch.path).at(0));
  const PanelLayout& place = layout.panels[0];
  const auto filled = [&](double time, int lane) {
    const double x = layout.left + time / 10 * (layout.right - layout.left);
    const double y = place.top + (lane + 0.5) / 2 * (place.bottom - place.top);
    const auto* pixel = image.row(static_cast<int>(y)) + 3 * static_cast<int>(x);
    return pixel[0] < 245 || pixel[1] < 245 || pixel[2] < 245;
  };
  for (int second = 0; second < 10; ++second) {
    EXPECT_EQ(filled(second + 0.6, 0), second % 2 == 0) << second;
    EXPECT_EQ(filled(second + 0.6, 1), second % 2 == 1) << second;
  }
}

TEST(LanePanel, PhasesAreBandsOfTheirOwnColour) {
  const Scratch scratch;
  Plot plot = with_lanes(1);
  Lane& lane = plot.panels[0].lanes[0];
  for (std::size_t k = 0; k < lane.y.size(); ++k) lane.y[k] = std::floor(lane.x[k] / 2.5);
  const auto layout = laid_out(plot);
  const Image image = read_png(draw_plots({plot}, scratch.path).at(0));
  const auto colour = [&](double time) {
    const double x = layout.left + time / 10 * (layout.right - layout.left);
    const auto y = static_cast<int>((layout.panels[0].top + layout.panels[0].bottom) / 2);
    const auto* pixel = image.row(y) + 3 * static_cast<int>(x);
    return std::array<int, 3>{pixel[0], pixel[1], pixel[2]};
  };
  EXPECT_NE(colour(0.5), colour(3.0));
  EXPECT_NE(colour(3.0), colour(5.5));
  EXPECT_EQ(colour(3.0), colour(4.5));
}

TEST(LanePanel, SamePlotSameBytesAndNoDataIsSaid) {
  const Scratch scratch;
  const Plot plot = with_lanes(3);
  EXPECT_EQ(read_file(draw_plots({plot}, scratch / "a").at(0)),
            read_file(draw_plots({plot}, scratch / "b").at(0)));
  Plot empty = with_lanes(1);
  empty.panels[0].lanes[0] = {"nothing", {}, {}};
  EXPECT_EQ(draw_plots({empty}, scratch.path).size(), 1U);
}

TEST(LanePanel, RefusesWhatCannotBeDrawn) {
  const Scratch scratch;
  Plot plot = with_lanes(1);
  plot.panels[0].lanes[0].y.pop_back();
  EXPECT_THAT(message_of<std::invalid_argument>([&] { draw_plots({plot}, scratch.path); }),
              HasSubstr("lane '2.OUT01' has 1001 x and 1000 states"));
  plot = with_lanes(1);
  plot.panels[0].lanes[0].x[5] = 7;
  EXPECT_THAT(message_of<std::invalid_argument>([&] { draw_plots({plot}, scratch.path); }),
              HasSubstr("lane '2.OUT01' does not run from left to right"));
}

}  // namespace
}  // namespace drycut::renders
