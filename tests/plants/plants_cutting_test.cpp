#include <gtest/gtest.h>

#include <cmath>

#include "plants/cutting.hpp"
#include "tests/plants/plants_lookup.hpp"

namespace drycut::plants {
namespace {

constexpr double radius = 0.6 / (2 * pi);
constexpr double thickness = 1e-3;

/// A cutter on a drum and a web with imposed speeds.
struct Cutting {
  CutterData data{.radius = radius,
                  .blades = 1,
                  .thickness = thickness,
                  .peak_force = 1500,
                  .coupling = 2000,
                  .grip = 500,
                  .mismatch_limit = 0.1};
  World world;
  Shaft& drum;
  Slide& web;
  Cutter cutter;
  int cuts = 0;
  int tears = 0;
  int buckles = 0;
  double excess = 0;
  double last_time = 0;
  double time = 0;
  Cutter::Outcome cut;
  Cutting(double start_turns, double drum_speed, double web_speed, int blades = 1)
      : drum(world.add_shaft(
            {.name = "drum", .inertia = 0.4, .revolutions = start_turns, .speed = drum_speed})),
        web(world.add_slide({.name = "web", .mass = 20, .speed = web_speed})),
        cutter((data.blades = blades, data), drum) {}
  void run(double seconds) {
    for (int i = 0; i < std::lround(seconds / h); ++i) {
      static_cast<void>(cutter.load(drum, web));
      world.step(h);
      const Cutter::Outcome o = cutter.sense(drum, web, h);
      tears += o.tore ? 1 : 0;
      buckles += o.buckled ? 1 : 0;
      if (o.tore || o.buckled) excess = o.excess;
      if (o.separated) {
        ++cuts;
        cut = o;
        last_time = time + o.fraction * h;
      }
      time += h;
    }
  }
};

TEST(CuttingLaw, GeometryOfTheEngagement) {
  const double edge = engagement_angle(radius, thickness);
  EXPECT_NEAR(radius * (1 - std::cos(edge)), thickness, 1e-15);
  EXPECT_NEAR(penetration(radius, thickness, edge), 0, 1e-15);
  EXPECT_EQ(penetration(radius, thickness, 0), thickness);
  EXPECT_EQ(penetration(radius, thickness, 1), 0);
  EXPECT_EQ(penetration(radius, thickness, -edge / 2), penetration(radius, thickness, edge / 2));
}

TEST(CuttingLaw, WorkIsTheIntegralOfTheForce) {
  EXPECT_EQ(shear_force(1500, thickness, 0), 0);
  EXPECT_EQ(shear_force(1500, thickness, thickness), 0);
  EXPECT_EQ(shear_force(1500, thickness, thickness / 2), 1500);
  double work = 0;
  const int n = 1000;
  for (int i = 0; i < n; ++i) {
    work += shear_force(1500, thickness, (i + 0.5) / n * thickness) * thickness / n;
    if (i == n / 3) {
      EXPECT_NEAR(shear_work(1500, thickness, (i + 1.0) / n * thickness), work, 1e-6);
    }
  }
  EXPECT_NEAR(shear_work(1500, thickness, thickness), work, 1e-6);
  EXPECT_NEAR(shear_work(1500, thickness, thickness), 2.0 / 3 * 1500 * thickness, 1e-12);
}

TEST(Cutter, SeparatesAtBottomDeadCentreExactly) {
  // From 180 deg at constant speed: time of the first cut is pi / omega, then every turn.
  const double omega = 10.3;
  Cutting c(0.5, omega, 1);
  c.run(pi / omega + 0.01);
  EXPECT_EQ(c.cuts, 1);
  EXPECT_NEAR(c.last_time, pi / omega, 1e-11);
  c.run(20 * pi / omega);
  EXPECT_EQ(c.cuts, 11);
  EXPECT_NEAR(c.last_time, 21 * pi / omega, 1e-10);
}

TEST(Cutter, EveryBladeOfADrumCuts) {
  const double omega = 9.7;
  Cutting c(0.95, omega, 1, 4);
  c.run((10 + 0.05) * 2 * pi / omega + 0.005);
  EXPECT_EQ(c.cuts, 41);
  EXPECT_EQ(c.tears + c.buckles, 0);
}

TEST(Cutter, MismatchOfASynchronousBladeIsTheCosine) {
  // Blade at web speed on its circle: slower along the web by v (1 - cos) where it touches, v s / R.
  const double v = 1;
  Cutting c(0.5, v / radius, v);
  c.run(0.5);
  ASSERT_EQ(c.cuts, 1);
  EXPECT_NEAR(c.cut.mismatch, v * thickness / radius, 1e-9);
  // 5 % faster on its circle: largest at bottom dead centre.
  Cutting fast(0.5, 1.05 * v / radius, v);
  fast.run(0.5);
  ASSERT_EQ(fast.cuts, 1);
  EXPECT_NEAR(fast.cut.mismatch, 0.05 * v, 1e-4);
  EXPECT_EQ(c.tears + c.buckles + fast.tears + fast.buckles, 0);
}

TEST(Cutter, ForceOfTheCutIsThePeak) {
  Cutting c(0.5, 1 / radius, 1);
  c.run(0.5);
  EXPECT_NEAR(c.cut.force, 1500, 2);
}

TEST(Cutter, FastBladeTearsOncePerEngagement) {
  Cutting c(0.5, 1.3 / radius, 1);
  c.run(1.4);  // three turns begun: cuts at 0.5, 1.5, 2.5 turns
  EXPECT_EQ(c.cuts, 3);
  EXPECT_EQ(c.tears, 3);
  EXPECT_EQ(c.buckles, 0);
  EXPECT_NEAR(c.excess, 1.3 * std::cos(engagement_angle(radius, thickness)) - 1, 1e-3);
}

TEST(Cutter, SlowBladeBucklesOncePerEngagement) {
  Cutting c(0.5, 0.7 / radius, 1);
  c.run(1.3);
  EXPECT_EQ(c.cuts, 2);
  EXPECT_EQ(c.buckles, 2);
  EXPECT_EQ(c.tears, 0);
}

TEST(Cutter, BladeStandingInTheWebBucklesAndDoesNotCut) {
  Cutting c(-0.01, 0, 1);
  ASSERT_TRUE(c.cutter.engaged());
  c.run(0.5);
  EXPECT_EQ(c.buckles, 1);
  EXPECT_EQ(c.cuts, 0);
}

TEST(Cutter, SwingingBackBeforeTheBottomCutsNothing) {
  Cutting c(-0.05, 2, 0.1);
  c.run(0.15);  // to -0.0023 turns
  EXPECT_TRUE(c.cutter.engaged());
  c.drum.speed = -2;
  c.run(0.3);
  EXPECT_FALSE(c.cutter.engaged());
  EXPECT_EQ(c.cuts, 0);
}

TEST(Cutter, CrossingAgainInOneEngagementIsNoSecondCut) {
  Cutting c(-0.01, 1, 0.1);
  c.run(0.1);
  EXPECT_EQ(c.cuts, 1);
  for (int swing = 0; swing < 4; ++swing) {
    c.drum.speed = -c.drum.speed;
    c.run(0.08);
  }
  EXPECT_EQ(c.cuts, 1);
  EXPECT_TRUE(c.cutter.engaged());
}

TEST(Cutter, PassingTheTopIsNoCut) {
  Cutting c(0.45, 5, 1);
  c.run(0.1);
  c.drum.speed = -5;
  c.run(0.1);
  EXPECT_EQ(c.cuts, 0);
}

TEST(Cutter, ShearedMaterialResistsNoMore) {
  Cutting c(-0.02, 1, 0.09);
  c.run(0.06);  // half way in
  const double depth = penetration(radius, thickness, c.cutter.theta());
  ASSERT_GT(depth, 0.2 * thickness);
  EXPECT_GT(c.cutter.load(c.drum, c.web).dry.forward, 0);
  EXPECT_EQ(c.cutter.load(c.drum, c.web).dry.backward, 0);
  c.drum.speed = -1;
  c.run(0.01);
  c.drum.speed = 1;
  c.run(0.005);
  EXPECT_EQ(c.cutter.load(c.drum, c.web).dry.forward, 0);  // not yet as deep as before
  c.run(0.01);
  EXPECT_GT(c.cutter.load(c.drum, c.web).dry.forward, 0);
}

TEST(Cutter, BladeAndWebFeelOppositeForcesUpToTheGrip) {
  Cutting c(-0.005, 1.02 / radius, 1);
  const double cosine = std::cos(0.005 * 2 * pi);
  Cutter::Load load = c.cutter.load(c.drum, c.web);
  EXPECT_NEAR(load.web_force, 2000 * (1.02 * cosine - 1), 1e-9);
  EXPECT_NEAR(load.torque, -load.web_force * radius * cosine, 1e-9);
  c.drum.speed = 3 / radius;
  load = c.cutter.load(c.drum, c.web);
  EXPECT_EQ(load.web_force, 500);
  c.drum.speed = 0;
  load = c.cutter.load(c.drum, c.web);
  EXPECT_EQ(load.web_force, -500);
}

TEST(Cutter, AfterTheCutTheBladeNoLongerPullsTheWeb) {
  Cutting c(-0.005, 1.05 / radius, 1);
  c.run(0.006);
  ASSERT_EQ(c.cuts, 1);
  ASSERT_TRUE(c.cutter.engaged());
  EXPECT_EQ(c.cutter.load(c.drum, c.web).web_force, 0);
  c.drum.speed = 0.9 / radius;
  EXPECT_LT(c.cutter.load(c.drum, c.web).web_force, 0);
}

TEST(Cutter, SeparationTimeIsExactForAConstantAcceleration) {
  // theta(t) sampled on the parabola at the ends of one step that holds the crossing.
  const double alpha = 300;
  const double w0 = 10;
  const double start = -4e-4;
  Shaft drum{.inertia = 1, .speed = w0, .speed_before = w0};
  drum.turns = -1;
  drum.part = 1 + start / (2 * pi);
  Slide web;
  Cutter cutter({.radius = radius, .thickness = thickness, .mismatch_limit = 100}, drum);
  drum.speed_before = w0;
  drum.speed = w0 + alpha * h;
  const double end = start + w0 * h + 0.5 * alpha * h * h;
  ASSERT_GT(end, 0);
  drum.turns = 0;
  drum.part = end / (2 * pi);
  const Cutter::Outcome o = cutter.sense(drum, web, h);
  ASSERT_TRUE(o.separated);
  const double exact = (-w0 + std::sqrt(w0 * w0 - 2 * alpha * start)) / alpha;
  EXPECT_NEAR(o.fraction * h, exact, 1e-13);
}

}  // namespace
}  // namespace drycut::plants
