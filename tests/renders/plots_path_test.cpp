// Plots of a path in a plane: equal scale, named points, thinning.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "renders/decimate.hpp"
#include "renders/plot_layout.hpp"
#include "renders/png_image.hpp"
#include "tests/renders/renders_scratch.hpp"

namespace drycut::renders {
namespace {

Curve circle(double x, double y, double radius, int points) {
  Curve curve;
  for (int i = 0; i <= points; ++i) {
    const double angle = 2 * std::numbers::pi * i / points;
    curve.x.push_back(x + radius * std::cos(angle));
    curve.y.push_back(y + radius * std::sin(angle));
  }
  return curve;
}

Plot path(std::vector<Curve> curves) {
  Plot plot{"path", "Path", "x [mm]", {}, 960, 700};
  plot.panels.push_back({"", "y [mm]", std::move(curves), {}, {}});
  plot.panels[0].equal_scale = true;
  return plot;
}

double scale_x(const PlotLayout& l) { return (l.right - l.left) / (l.x_range.second - l.x_range.first); }
double scale_y(const PanelLayout& l) { return (l.bottom - l.top) / (l.y_range.second - l.y_range.first); }

TEST(PathPlot, AUnitIsAsLongInXAsInY) {
  for (const auto& [width, height] : {std::pair{100.0, 1.0}, {1.0, 100.0}, {30.0, 30.0}}) {
    const auto layout = laid_out(path({{"", {0, width}, {0, height}}}));
    EXPECT_NEAR(scale_x(layout) / scale_y(layout.panels[0]), 1, 1e-9);
    EXPECT_LT(layout.x_range.first, 0);
    EXPECT_GT(layout.x_range.second, width);
    EXPECT_LT(layout.panels[0].y_range.first, 0);
    EXPECT_GT(layout.panels[0].y_range.second, height);
    // It fills the axes one way: a twentieth of border at most on either side.
    const double used_x = width / (layout.x_range.second - layout.x_range.first);
    const double used_y = height / (layout.panels[0].y_range.second - layout.panels[0].y_range.first);
    EXPECT_GT(std::max(used_x, used_y), 0.88);
  }
}

TEST(PathPlot, NamedPointsAreInsideTheAxes) {
  auto plot = path({circle(0, 0, 10, 100)});
  plot.panels[0].points = {{"far", 80, -70}};
  const auto layout = laid_out(plot);
  EXPECT_GT(layout.x_range.second, 80);
  EXPECT_LT(layout.panels[0].y_range.first, -70);
}

TEST(PathPlot, ThinningKeepsTheShapeAllRound) {
  const auto curve = circle(0, 0, 10, 200000);
  const PixelGrid grid = {-10, 10, -10, 10, 800, 800};
  const auto points = thinned_path(curve, grid);
  EXPECT_LT(points.x.size(), 6000U);
  for (std::size_t i = 1; i < points.x.size(); ++i) {
    // A step is half a pixel and a bit, so the chord never leaves the circle visibly.
    EXPECT_LT(std::hypot(points.x[i] - points.x[i - 1], points.y[i] - points.y[i - 1]), 0.6 * 20 / 800);
  }
  EXPECT_EQ(points.x.front(), curve.x.front());
  EXPECT_EQ(points.x.back(), curve.x.back());
}

TEST(PathPlot, GapsStayGaps) {
  constexpr double gap = std::numeric_limits<double>::quiet_NaN();
  const Curve curve = {"", {gap, 0, 1, gap, gap, 1, 0, gap}, {gap, 0, 1, gap, gap, 0, 1, gap}};
  const auto points = thinned_path(curve, {0, 1, 0, 1, 100, 100});
  ASSERT_EQ(points.x.size(), 6U);
  EXPECT_TRUE(std::isnan(points.x[2]));
  EXPECT_TRUE(std::isnan(points.y[5]));
  EXPECT_EQ(points.x[3], 1);
}

TEST(PathPlot, IsDrawnAndRefusesPointsNowhere) {
  const Scratch scratch;
  auto plot = path({circle(0, 0, 10, 100)});
  plot.panels[0].points = {{"A", 0, 10}};
  const auto files = draw_plots({plot}, scratch.path);
  ASSERT_EQ(files.size(), 1U);
  EXPECT_GT(std::filesystem::file_size(files[0]), 5000U);
  plot.panels[0].points = {{"A", std::numeric_limits<double>::infinity(), 10}};
  EXPECT_EQ(message_of<std::invalid_argument>([&] { draw_plots({plot}, scratch.path); }),
            "plot 'path': point 'A' is not at a finite place");
}

}  // namespace
}  // namespace drycut::renders
