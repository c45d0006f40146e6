#include <gtest/gtest.h>

#include "renders/plot_layout.hpp"
#include "renders/text.hpp"

namespace drycut::renders {
namespace {

Plot plot_with(std::vector<Mark> marks) {
  Plot plot{"cam", "Cam", "master [Um]", {}, 1200, 240};
  plot.panels.push_back({"position", "[Um]", {{"", {0, 1000}, {0, 1}}}, {}, {}});
  plot.panels.push_back({"velocity", "[Um/Um]", {{"", {0, 1000}, {0, 1}}}, {}, {}});
  plot.marks = std::move(marks);
  return plot;
}

TEST(PlotMarks, LabelsThatFitStandUprightBesideTheirMarks) {
  const auto layout = laid_out(plot_with({{0, "1 AZM"}, {500, "2 RSC"}}));
  ASSERT_EQ(layout.marks.size(), 2U);
  EXPECT_FALSE(layout.marks_across);
  EXPECT_DOUBLE_EQ(layout.marks[0].line, layout.left);
  EXPECT_DOUBLE_EQ(layout.marks[1].line, (layout.left + layout.right) / 2);
  EXPECT_GT(layout.marks[1].text, layout.marks[1].line);
  EXPECT_LE(layout.marks_bottom, layout.panels[0].top);
}

TEST(PlotMarks, CrowdedLabelsStandAcrossAndNeverTouch) {
  std::vector<Mark> marks;
  for (int i = 0; i < 40; ++i) marks.push_back({990 + 0.25 * i, std::to_string(i + 1) + " RCCE"});
  const auto layout = laid_out(plot_with(marks));
  EXPECT_TRUE(layout.marks_across);
  for (std::size_t i = 0; i < layout.marks.size(); ++i) {
    EXPECT_FALSE(layout.marks[i].label.empty());
    EXPECT_LE(layout.marks[i].text, layout.right + 1e-9);
    EXPECT_GE(layout.marks[i].text, layout.left);
    if (i > 0) {
      EXPECT_GE(layout.marks[i].text - layout.marks[i - 1].text, PlotType::mark);
    }
  }
  // The strip lies between title and panel.
  const double strip = layout.panels[0].top - layout.panels[0].title_y;
  EXPECT_GT(strip, text_width("40 RCCE", PlotType::mark) + kMarkLeader);
}

TEST(PlotMarks, WithoutRoomTheNarrowestSectorsLoseTheirLabels) {
  std::vector<Mark> marks;
  for (int i = 0; i < 500; ++i) marks.push_back({i < 10 ? 50.0 * i : 500 + i, "x"});
  const auto layout = laid_out(plot_with(marks));
  ASSERT_EQ(layout.marks.size(), 500U);
  std::size_t labelled = 0;
  double last = 0;
  for (const auto& mark : layout.marks) {
    if (mark.label.empty()) continue;
    ++labelled;
    EXPECT_GE(mark.text - last, PlotType::mark);
    last = mark.text;
  }
  EXPECT_GT(labelled, 50U);
  EXPECT_LT(labelled, 100U);
  for (std::size_t i = 0; i < 10; ++i) EXPECT_FALSE(layout.marks[i].label.empty());
}

TEST(PlotMarks, MarksOutsideTheAxesAreLeftOut) {
  const auto layout = laid_out(plot_with({{-1, "a"}, {1001, "b"}, {300, "c"}}));
  ASSERT_EQ(layout.marks.size(), 1U);
  EXPECT_EQ(layout.marks[0].label, "c");
}

TEST(PlotMarks, APlotWithoutMarksIsLaidOutAsBefore) {
  const auto bare = laid_out(plot_with({}));
  const auto marked = laid_out(plot_with({{0, ""}}));
  EXPECT_DOUBLE_EQ(bare.panels[0].top, marked.panels[0].top);
  EXPECT_EQ(bare.height, marked.height);
}

}  // namespace
}  // namespace drycut::renders
