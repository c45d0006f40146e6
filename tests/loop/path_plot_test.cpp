// pictures.plots: panels that show a path in a plane: x, y, split, labels, points.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/loop/scenario/fake_plants.hpp"

namespace drycut::sim::scenario {
namespace {

using fakes::problems_of;
using fakes::read;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::string panels(const std::string& text) {
  return "pictures: {plots: [{name: a, panels: [" + text + "]}]}\n";
}

TEST(PathPlot, IsReadAndWritten) {
  std::vector<std::string> problems;
  const auto text = panels(
      "{title: t, x: web.speed, y: knife.speed, split: gbArc, labels: [I, II], points: {A: [0, 0.5], B: [15, "
      "-33]}}");
  const auto scenario = read(text, problems);
  EXPECT_THAT(problems, IsEmpty());
  const auto check = [](const Scenario& s) {
    const auto& panel = s.pictures.plots.at(0).panels.at(0);
    EXPECT_EQ(panel.kind(), PlotRequest::Panel::Kind::path);
    EXPECT_EQ(panel.title, "t");
    EXPECT_EQ(panel.x.text, "web.speed");
    EXPECT_EQ(panel.y.text, "knife.speed");
    EXPECT_EQ(panel.split.text, "gbArc");
    ASSERT_EQ(panel.labels.size(), 2U);
    EXPECT_EQ(panel.labels[1].text, "II");
    ASSERT_EQ(panel.points.size(), 2U);
    EXPECT_EQ(panel.points[1].label.text, "B");
    EXPECT_EQ(panel.points[0].y, 0.5);
    EXPECT_EQ(panel.points[1].x, 15);
    EXPECT_EQ(panel.points[1].y, -33);
  };
  check(scenario);
  const auto again = read(expand(scenario), problems);
  EXPECT_THAT(problems, IsEmpty());
  check(again);
}

TEST(PathPlot, WhatIsWrong) {
  const auto first = [](const std::string& text) { return problems_of(panels(text)); };
  EXPECT_THAT(first("{x: a}"), ElementsAre("1:40: pictures.plots.a.panels.0: x and y go together; write x: "
                                           "AxisX.posit, y: AxisY.posit [scenario.needs-another]"));
  EXPECT_THAT(first("{x: a, y: b, channels: [c]}"),
              ElementsAre("1:52: pictures.plots.a.panels.0 has both a path and channels; make two plots of "
                          "it [scenario.does-not-go-together]"));
  EXPECT_THAT(
      first("{x: a, y: b, labels: [c]}"),
      ElementsAre("1:52: pictures.plots.a.panels.0: labels are for the parts of a split path; add split: "
                  "with the channel that numbers them, or leave labels out [scenario.does-not-go-together]"));
  EXPECT_THAT(first("{channels: [a], split: b}"),
              ElementsAre("1:55: pictures.plots.a.panels.0: split goes with a path in a plane; write x: "
                          "AxisX.posit, y: AxisY.posit, or leave it out [scenario.needs-another]"));
  EXPECT_THAT(first("{x: a, y: b, points: {A: [1]}}"),
              ElementsAre("1:61: pictures.plots.a.panels.0.points.A must be a place in the plane; for "
                          "example [15, -33] [scenario.wrong-kind]"));
  EXPECT_THAT(first("{x: a, y: b}, {channels: [c]}"),
              ElementsAre("1:30: pictures.plots.a: a path stands alone in its plot; make a plot of each "
                          "[scenario.does-not-go-together]"));
}

}  // namespace
}  // namespace drycut::sim::scenario
