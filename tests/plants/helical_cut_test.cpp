// Helical blades: each point of them cuts as a straight blade does, one after the other across the web.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string_view>
#include <vector>

#include "plants/cutting.hpp"
#include "plants/pose_math.hpp"
#include "plants/rotary_knife.hpp"
#include "tests/plants/plants_lookup.hpp"

namespace drycut::plants {
namespace {

constexpr double drum_radius = 0.64 / (2 * pi);
constexpr double web_thickness = 4e-3;
constexpr double width = 2.5;
constexpr double peak = 10e3;
constexpr double work = 2.0 / 3 * peak * web_thickness;

/// Sum of `value` over the middles of `n` parts of an interval, times their length.
template <class Value>
double integral(double from, double to, int n, Value value) {
  const double part = (to - from) / n;
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += value(from + (i + 0.5) * part);
  return sum * part;
}

double straight_force(double theta) {
  return theta > 0 ? 0 : shear_force(peak, web_thickness, penetration(drum_radius, web_thickness, theta));
}

TEST(HelicalCut, IsTheSumOfItsPoints) {
  const double touch = engagement_angle(drum_radius, web_thickness);
  for (const double lag : {1e-4, 0.3 * touch, touch, 1.7 * touch, 1.0})
    for (double share = 0.05; share < 1; share += 0.1) {
      const double lead = -touch + share * (touch + lag);
      SCOPED_TRACE(testing::Message() << lag << " " << lead);
      const auto cut = helical_cut(peak, drum_radius, web_thickness, lead, lag);
      constexpr int points = 100000;
      const double force = integral(lead - lag, lead, points, straight_force) / lag;
      const double torque =
          integral(lead - lag, lead, points,
                   [](double theta) { return straight_force(theta) * drum_radius * std::sin(-theta); }) /
          lag;
      EXPECT_NEAR(cut.force, force, 1e-6 * peak);
      EXPECT_NEAR(cut.torque, torque, 1e-6 * peak * drum_radius);
    }
}

TEST(HelicalCut, DoesTheWorkOfAStraightOneWithLessTorque) {
  const double touch = engagement_angle(drum_radius, web_thickness);
  double straight = 0;
  for (double theta = -touch; theta < 0; theta += touch / 1e4)
    straight = std::max(straight, straight_force(theta) * drum_radius * std::sin(-theta));
  double before = straight;
  for (const double lag : {0.1, 0.2, 0.4, 0.8, 1.6}) {
    double largest = 0;
    const double done = integral(-touch, lag, 100000, [&](double lead) {
      const double torque = helical_cut(peak, drum_radius, web_thickness, lead, lag).torque;
      largest = std::max(largest, torque);
      return torque;
    });
    EXPECT_NEAR(done, work, 1e-6 * work);
    EXPECT_LT(largest, before);
    before = largest;
    // From where the first point is through until the last one touches the web it is the work over the lag.
    if (lag >= touch) {
      EXPECT_NEAR(largest, work / lag, 1e-9 * largest);
    }
  }
}

TEST(Helix, AngleAndLagAreInverse) {
  for (const double degrees : {0.1, 1.0, 5.0, 30.0}) {
    const double helix = degrees / 180 * pi;
    const double lag = helix_lag(drum_radius, helix, width);
    EXPECT_NEAR(helix_of_lag(drum_radius, lag, width), helix, 1e-12);
    // The blade on the developed drum, over the length of axis that covers the web.
    EXPECT_NEAR(lag * drum_radius, width / std::cos(helix) * std::tan(helix), 1e-12);
  }
  EXPECT_EQ(helix_lag(drum_radius, 0, width), 0);
  EXPECT_EQ(helix_of_lag(drum_radius, 0, width), 0);
}

/// A cutter on a bare drum.
struct Helical {
  CutterData data{.radius = drum_radius,
                  .blades = 1,
                  .helix = 1.0 / 180 * pi,
                  .thickness = web_thickness,
                  .peak_force = peak,
                  .coupling = 5000,
                  .grip = 2000,
                  .mismatch_limit = 0.25};
  World world;
  Shaft& drum;
  Slide& web;
  Cutter cutter;
  int cuts = 0;
  int faults = 0;
  double time = 0;
  double cut_time = 0;
  Cutter::Outcome cut;
  std::vector<double> places;
  Helical(double start, double drum_speed, double web_speed, double helix = 1.0 / 180 * pi,
          bool counter_blades = false)
      : drum(world.add_shaft(
            {.name = "drum", .inertia = 1, .revolutions = start / (2 * pi), .speed = drum_speed})),
        web(world.add_slide({.name = "web", .mass = 100, .speed = web_speed})),
        cutter((data.width = width, data.helix = helix, data.counter_blades = counter_blades, data), drum) {}
  double along() const { return drum_radius * std::cos(data.helix); }
  double lag() const { return helix_lag(drum_radius, data.helix, width); }
  /// `acts`: the cut acts on the drum.
  void run(double seconds, double dt = h, bool acts = false) {
    for (long i = std::lround(seconds / dt); i > 0; --i) {
      const auto load = cutter.load(drum, web);
      if (acts) drum.add_torque(friction_effort({}, drum.speed, 0, drum.inertia, dt, load.dry));
      world.step(dt);
      const auto outcome = cutter.sense(drum, web, dt);
      faults += outcome.tore || outcome.buckled ? 1 : 0;
      if (cutter.place() != 0) places.push_back(cutter.place());
      if (outcome.separated) {
        ++cuts;
        cut = outcome;
        cut_time = time + outcome.fraction * dt;
      }
      time += dt;
    }
  }
};

TEST(HelicalCutter, SeparatesWithItsLastPointAndMeasuresInTheMiddle) {
  const double omega = 31.3;
  const double v = 3.1;
  Helical c(-2, omega, v);
  c.run(3.5 / omega);
  ASSERT_EQ(c.cuts, 1);
  EXPECT_NEAR(c.cut_time, (2 + c.lag() / 2) / omega, 1e-11);
  EXPECT_NEAR(c.cut.mark, v * 2 / omega, 1e-11);
  EXPECT_GT(c.lag(), 0.4);
}

TEST(HelicalCutter, IsSquareAtWebSpeedAndElseOutByTheMismatch) {
  const double v = 10.0 / 3;
  for (const double ratio : {0.97, 0.99, 1.0, 1.02})
    for (const double helix : {0.5, 1.0, 3.0})
      for (const int direction : {1, -1}) {
        SCOPED_TRACE(testing::Message() << ratio << " " << helix << " " << direction);
        Helical c(-direction * 1.5, 1, direction * v, helix / 180 * pi);
        c.drum.speed = direction * ratio * v / c.along();
        c.run(4.5 / std::abs(c.drum.speed));
        ASSERT_EQ(c.cuts, 1);
        EXPECT_EQ(c.faults, 0);
        EXPECT_NEAR(c.cut.skew, width * std::tan(helix / 180 * pi) * (1 - 1 / ratio), 1e-10);
      }
}

TEST(HelicalCutter, ItsPlaceGoesFromEdgeToEdge) {
  Helical c(-1, 30, 3);
  c.run(0.1);
  ASSERT_EQ(c.cuts, 1);
  const auto edge = [&](double place) {
    return std::count_if(c.places.begin(), c.places.end(),
                         [&](double p) { return std::abs(p - place) < 1e-12; });
  };
  EXPECT_GT(edge(-width / 2), 10);  // comes in
  EXPECT_GT(edge(width / 2), 10);   // leaves
  EXPECT_TRUE(std::is_sorted(c.places.begin(), c.places.end()));
  const double step = 30 * h / c.lag() * width;
  for (std::size_t i = 1; i < c.places.size(); ++i)
    EXPECT_LE(c.places[i] - c.places[i - 1], step * (1 + 1e-9));
}

TEST(HelicalCutter, TakesTheWorkOfAStraightOneFromTheDrum) {
  for (const double helix : {0.0, 0.3, 1.0, 4.0})
    for (const bool counter_blades : {false, true}) {
      SCOPED_TRACE(testing::Message() << helix << counter_blades);
      Helical c(-1.5, 33, 3, helix / 180 * pi, counter_blades);
      const double before = 0.5 * c.drum.inertia * c.drum.speed * c.drum.speed;
      c.run(0.11, 5e-7, true);
      ASSERT_EQ(c.cuts, 1);
      EXPECT_NEAR(before - 0.5 * c.drum.inertia * c.drum.speed * c.drum.speed, work, 1e-6 * work);
    }
}

TEST(HelicalCutter, CounterBladesCloseInTwiceAsFast) {
  Helical c(-1, 30, 3, 0, true);
  const double touch = std::acos(1 - web_thickness / (2 * drum_radius));
  c.run((1 - 1.02 * touch) / 30, 1e-5);
  EXPECT_FALSE(c.cutter.engaged());
  c.run(0.04 * touch / 30, 1e-5);
  EXPECT_TRUE(c.cutter.engaged());
  // Work on both drums: force times the way that their tips close in.
  const auto load = c.cutter.load(c.drum, c.web);
  const double theta = c.cutter.theta();
  EXPECT_NEAR(load.dry.forward,
              shear_force(peak, web_thickness, web_thickness - 2 * drum_radius * (1 - std::cos(theta))) * 2 *
                  drum_radius * std::sin(-theta),
              1e-9);
}

TEST(HelicalCutter, PushesTheWebWithTheShareThatIsInIt) {
  // Long enough that the whole width of its touch is in the web: half of it cuts, half is through.
  Helical c(-1, 0, 3, 3.0 / 180 * pi);
  const double touch = engagement_angle(drum_radius, web_thickness);
  ASSERT_GT(c.lag(), 2 * touch);
  c.drum.speed = 1.05 * 3 / c.along();
  c.run(1 / c.drum.speed);  // the middle is at the bottom
  const double share = touch / c.lag();
  const double arm = c.along() * std::sin(touch) / touch;
  auto load = c.cutter.load(c.drum, c.web);
  const double push = 5000 * share * (c.drum.speed * arm - 3);
  ASSERT_GT(push, 10);
  EXPECT_NEAR(load.web_force, push, 1e-9);
  EXPECT_NEAR(load.torque, -load.web_force * arm, 1e-9);
  // A blade slower than the web holds up what is cut as well, and the web gives way at the grip of that
  // share.
  c.drum.speed = 0.99 * 3 / c.along();
  load = c.cutter.load(c.drum, c.web);
  EXPECT_NEAR(load.web_force, 2 * 5000 * share * (c.drum.speed * arm - 3), 1e-9);
  c.drum.speed = 0;
  load = c.cutter.load(c.drum, c.web);
  EXPECT_NEAR(load.web_force, -2 * share * 2000, 1e-9);
}

TEST(HelicalCutter, SwingingBackShearsNothingTwice) {
  Helical c(-0.5, 5, 0.5);
  c.run(0.5 / 5);  // half through
  ASSERT_EQ(c.cuts, 0);
  EXPECT_GT(c.cutter.load(c.drum, c.web).dry.forward, 0);
  EXPECT_EQ(c.cutter.load(c.drum, c.web).dry.backward, 0);
  c.drum.speed = -5;
  c.run(0.01);
  EXPECT_EQ(c.cutter.load(c.drum, c.web).dry.forward, 0);
  EXPECT_EQ(c.cutter.load(c.drum, c.web).dry.backward, 0);
  c.drum.speed = 5;
  c.run(0.011);
  EXPECT_GT(c.cutter.load(c.drum, c.web).dry.forward, 0);
  c.run(0.2);
  EXPECT_EQ(c.cuts, 1);
  EXPECT_NEAR(c.cut.mark, 0.5 * 0.1, 1e-9) << "where the middle came first";
}

TEST(HelicalCutter, LeavesBeforeItsLastPointAndHasCutNothing) {
  Helical c(-0.5, 5, 0.5);
  c.run(0.5 / 5);
  c.drum.speed = -5;
  c.run(0.2);
  EXPECT_FALSE(c.cutter.engaged());
  EXPECT_EQ(c.cuts, 0);
}

TEST(HelicalCutter, TooFastItTearsAndTooSlowItBuckles) {
  for (const double ratio : {1.1, 0.9}) {
    Helical c(-1, 1, 10.0 / 3);
    c.drum.speed = ratio * c.web.speed / c.along();
    c.run(2 / c.drum.speed);
    EXPECT_EQ(c.cuts, 1);
    EXPECT_EQ(c.faults, 1);
    EXPECT_NEAR(c.cut.mismatch,
                std::abs(ratio - 1) * 10 / 3 + (ratio < 1 ? 0.9 * 10 / 3 * web_thickness / drum_radius : 0),
                2e-3);
  }
}

// The whole machine.

RotaryKnifeDefinition helical_knife(double degrees) {
  RotaryKnifeDefinition knife;
  knife.data.helix = degrees / 180 * pi;
  knife.data.coupling = 0;
  return knife;
}

TEST(HelicalKnife, ReportsSkewAndLengthInTheMiddle) {
  WebDefinition web;
  web.data.shear_strength = 0;
  auto knife = helical_knife(2);
  Machine line(knife, &web);
  const double along = 0.6 / (2 * pi) * std::cos(knife.data.helix);
  line.reference(2.5 * 1.01 / std::cos(knife.data.helix));
  line.run(4);
  ASSERT_GE(line.events.size(), 5U);
  const auto& cut = line.events.back();
  ASSERT_EQ(cut.name, "cut");
  const double drum_speed = line.read("speed") / 60 * 2 * pi;
  EXPECT_NEAR(value(cut, "length"), 2 * pi / drum_speed * 1000, 1e-2);
  EXPECT_NEAR(value(cut, "skew"), 300 * std::tan(knife.data.helix) * (1 - 1 / (drum_speed * along)), 1e-3);
  EXPECT_NEAR(value(cut, "skew"), 0.1, 0.01);
  EXPECT_EQ(line.read("cut.skew"), value(cut, "skew"));
  EXPECT_NEAR(line.read("blade.speed"), 60 * 1.01, 0.02);
  EXPECT_NEAR(line.read("blade.ratio"), 1.01, 3e-4);
  const auto types = line.plant->event_types();
  EXPECT_EQ(types[0].values.size(), cut.values.size());
  knife.data.helix = 0;
  const Machine straight(knife, &web);
  EXPECT_EQ(straight.plant->event_types()[0].values.size(), 4U) << "no skew of a straight blade";
}

TEST(HelicalKnife, PointsOutItsForceWhereItCuts) {
  WebDefinition web;
  auto knife = helical_knife(3);
  knife.data.initial_angle = -0.5;
  Machine line(knife, &web);
  line.reference(1);
  std::vector<double> across;
  for (int i = 0; i < 6000; ++i) {
    line.step();
    std::vector<Callout> callouts;
    line.plant->callouts(callouts);
    for (const auto& callout : callouts) {
      across.push_back(callout.at[2]);
      EXPECT_NEAR(callout.at[2] * 1000, line.read("cut.place"), 1e-9);
      EXPECT_NEAR(callout.at[0], callout.at[2] * std::tan(knife.data.helix), 1e-12);
    }
  }
  ASSERT_GT(across.size(), 10U);
  EXPECT_NEAR(across.front(), -0.15, 1e-9);
  EXPECT_GT(across.back(), 0.1);
}

TEST(HelicalKnife, ItsBladeLiesSquareOnTheWebWhereItCuts) {
  WebDefinition web;
  auto knife = helical_knife(2);
  knife.data.initial_angle = 0;
  knife.data.blade_width = 0.4;
  Machine line(knife, &web);
  int pieces = 0;
  for (const Part& part : line.plant->parts()) {
    if (!part.name.starts_with("blade 1, piece")) continue;
    ++pieces;
    const auto edge = (part.now().pose * at(0, -part.size[1] / 2, 0)).position;
    const auto end = (part.now().pose * at(0, -part.size[1] / 2, 1)).position;
    if (std::abs(edge[2]) > 0.02) continue;
    EXPECT_NEAR(edge[0], 0, 1e-3) << part.name;
    EXPECT_NEAR(edge[1], 0, 1e-4) << part.name;
    EXPECT_NEAR(end[0] - edge[0], 0, 1e-2) << part.name << ": along z, square to the web";
  }
  EXPECT_GE(pieces, 2);
  int trails = 0;
  for (const Part& part : line.plant->parts()) trails += part.tip ? 1 : 0;
  EXPECT_EQ(trails, 1) << "of one end of the blade";
}

TEST(HelicalKnife, RefusesAHelixThatNeverLeavesTheWeb) {
  const auto told = [](double degrees, int blades) {
    RotaryKnifeDefinition knife;
    knife.data.helix = degrees / 180 * pi;
    knife.data.blade_count = blades;
    WebDefinition web;
    web.data.width = 2.5;
    return objections_of(knife, h, &web);
  };
  using testing::ElementsAre;
  using testing::HasSubstr;
  EXPECT_THAT(told(10, 1), testing::IsEmpty());
  EXPECT_THAT(told(14, 1),
              ElementsAre(HasSubstr("helix: a blade of 14 deg takes 385.4 deg of the drum from edge to "
                                    "edge of the web of 2500 mm: it never leaves it")));
  EXPECT_THAT(told(4, 4), ElementsAre(HasSubstr("two are in it at once")));
  // The remedy is just allowed.
  RotaryKnifeDefinition knife;
  WebDefinition web;
  web.data.width = 2.5;
  knife.data.helix = 40.0 / 180 * pi;
  const auto found = knife.objections_with([&](std::string_view) { return &web; }, h);
  ASSERT_EQ(found.size(), 1U);
  double most = 0;
  ASSERT_EQ(std::sscanf(found[0].remedy.c_str(), "less than %lf deg", &most), 1) << found[0].remedy;
  EXPECT_THAT(told(most - 0.1, 1), testing::IsEmpty());
  EXPECT_EQ(told(most + 0.1, 1).size(), 1U);
}

}  // namespace
}  // namespace drycut::plants
