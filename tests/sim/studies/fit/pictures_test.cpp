// The pictures of a fit: gaps where stretches were left out, and two curves that lie on each other both seen.
#include "sim/studies/fit/pictures.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "renders/palette.hpp"

namespace drycut::sim::studies::fitting {
namespace {

/// Two stretches, of which the model explains all but a tenth.
Replayed with_a_stretch_left_out() {
  Replayed one;
  one.step = 0.01;
  for (const double t : {0.0, 0.01, 0.02, 0.5, 0.51}) {
    one.times.push_back(t);
    one.torque.push_back(2 + t);
    one.torque_left.push_back(0.1);
    one.speed.push_back(100 * t);
    one.position.push_back(t);
  }
  one.position_unit = "mm";
  return one;
}

TEST(FitPictures, BreakTheirLinesWhereAStretchWasLeftOut) {
  const auto plot = replay_over_time("fit_1", "x", with_a_stretch_left_out());
  ASSERT_EQ(plot.panels.size(), 3u);
  for (const auto* curve :
       {&plot.panels[0].curves[0], &plot.panels[0].curves[1], &plot.panels[2].curves[0]}) {
    ASSERT_EQ(curve->x.size(), 6u) << curve->label;
    ASSERT_EQ(curve->y.size(), 6u);
    EXPECT_TRUE(std::isnan(curve->y[3]));
    EXPECT_EQ(curve->x[4], 0.5);
    EXPECT_FALSE(std::isnan(curve->y[4]));
  }
  EXPECT_NEAR(plot.panels[0].curves[1].y[4], 2.6, 1e-12) << "the model's";
}

TEST(FitPictures, ShowTheRecordedTorqueOnBothSidesOfTheModels) {
  const auto plot = replay_over_time("fit_1", "x", with_a_stretch_left_out());
  const auto& curves = plot.panels[0].curves;
  const auto recorded = renders::look_of(curves.at(0), 0);
  const auto model = renders::look_of(curves.at(1), 1);
  EXPECT_GE(recorded.size, 2 * model.size);
  EXPECT_NE(recorded.tone.light, model.tone.light);
  EXPECT_NE(plot.panels[1].curves.at(0).y, curves[1].y) << "what is left has a panel of its own";
}

}  // namespace
}  // namespace drycut::sim::studies::fitting
