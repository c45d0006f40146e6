// The web with longitudinal stiffness: against the line of two springs, Euler's load and the balance of
// energy.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "plants/materials.hpp"
#include "tests/plants/web_line.hpp"

namespace drycut::plants {
namespace {

/// Solid board, 1 mm of 300 mm, whose line drive stands.
WebData elastic(double speed = 0) {
  WebData data;
  data.strip.on = true;
  data.drive.speed = speed;
  return data;
}

// What the springs are, from the cross-section alone.
constexpr double area = 0.3 * 1e-3;                     // [m2]
constexpr double to_wheel = 3e9 * area / (1.25 - 0.7);  // [N/m]
constexpr double to_cut = 3e9 * area / 0.7;
constexpr double grip = 2e5;
constexpr double metre = 700 * area;                   // [kg]
constexpr double wheel_mass = 0.3 + metre * 1.25 / 2;  // [kg]

struct Strip : WebLine {
  using WebLine::WebLine;
  /// Steps under a force on the material at the cut [N].
  void pull(double newton, double seconds, double dt = h) {
    for (long i = std::lround(seconds / dt); i > 0; --i) {
      web.material().add_force(newton);
      step(dt);
    }
    ASSERT_EQ(world.failure(), "");
  }
};

TEST(ElasticWeb, AShearThatPullsStretchesTheStripAndTheWheelSeesAPartOfIt) {
  for (const double newton : {300.0, 40.0}) {
    Strip line(elastic(0));
    line.pull(newton, 3);
    EXPECT_NEAR(line.read("tension"), newton, 1e-6);
    EXPECT_NEAR(line.read("puller.tension"), newton, 1e-6);
    EXPECT_NEAR(line.read("drive.force"), -newton, 1e-6);
    const double seen = newton / grip + newton / to_wheel;
    EXPECT_NEAR(line.read("wheel.stretch"), 1000 * newton / to_cut, 1e-6);
    EXPECT_NEAR(line.plug<EncoderPort>("wheel").now, seen * 20000, 1e-4);
    EXPECT_NEAR(line.read("position"), 1000 * (seen + newton / to_cut), 1e-6);
  }
}

TEST(ElasticWeb, RunsAsARigidOneWhereNothingPulls) {
  Strip line(elastic(1));
  line.run(2);
  EXPECT_NEAR(line.read("position"), 2000, 1e-8);
  EXPECT_EQ(line.read("tension"), 0);
  EXPECT_EQ(line.read("wheel.stretch"), 0);
  EXPECT_EQ(line.read("wheel.speed"), 60);
  EXPECT_EQ(line.read("wheel.count"), 40000);
}

TEST(ElasticWeb, ARigidOneHasNoStretch) {
  Strip line;
  line.pull(300, 1);
  EXPECT_EQ(line.read("tension"), 0);
  EXPECT_EQ(line.read("puller.tension"), 0);
  EXPECT_EQ(line.read("loop"), 0);
  EXPECT_EQ(line.read("wheel.stretch"), 0);
  EXPECT_EQ(line.read("wheel.speed"), line.read("speed"));
}

// Against a puller that nothing moves the wheel's place and the cut are the masses of a line of two springs:
// (k1 + k2 - m1 w2) (k2 - m2 w2) = k2^2.
TEST(ElasticWeb, FirstResonanceIsThatOfTheLineOfTwoSprings) {
  WebData data = elastic();
  data.mass = 1e5;
  data.lead = 2;
  data.strip.retardation = 0;
  const double m1 = wheel_mass;
  const double m2 = metre * (0.35 + 2);
  const double p = (to_wheel + to_cut) / m1 + to_cut / m2;
  const double square = (p - std::sqrt(p * p - 4 * to_wheel * to_cut / (m1 * m2))) / 2;
  const double wheel_share = to_cut / (to_wheel + to_cut - m1 * square);

  constexpr double dt = 1e-6;
  Strip line(data);
  // At rest everywhere, in the shape of the first mode by its speed.
  constexpr double most = 0.004;  // [m/s]: pushed less than Euler's load
  line.web.material().speed = most;
  const_cast<Slide&>(line.web.at_wheel()).speed = most * wheel_share;
  double before = 0;
  std::vector<double> crossings;
  double most_off_shape = 0;
  for (int i = 0; i < 60000; ++i) {
    line.step(dt);
    const double now = line.web.material().position;
    most_off_shape = std::max(most_off_shape, std::abs(line.web.at_wheel().position - wheel_share * now));
    if (before < 0 && now >= 0) crossings.push_back((i + before / (before - now)) * dt);
    before = now;
  }
  ASSERT_GE(crossings.size(), 5U);
  const double period = (crossings.back() - crossings.front()) / static_cast<double>(crossings.size() - 1);
  EXPECT_NEAR(period * std::sqrt(square) / turn, 1, 2e-5);
  EXPECT_LT(most_off_shape, 1e-3 * most / std::sqrt(square));
}

TEST(ElasticWeb, KeepsItsEnergyWithoutDampingAndLosesItWith) {
  for (const bool damped : {false, true}) {
    WebData data = elastic();
    data.mass = 1e5;
    data.drive.damping = 0;
    if (!damped) data.strip.retardation = 0;
    Strip line(data);
    line.web.material().speed = 0.01;
    const auto energy = [&] {
      const Slide& cut = line.web.material();
      const Slide& wheel = line.web.at_wheel();
      const double t1 = line.read("puller.tension");
      const double t2 = line.read("tension");
      return (cut.mass * cut.speed * cut.speed + wheel.mass * wheel.speed * wheel.speed + t1 * t1 / to_wheel +
              t2 * t2 / to_cut) /
             2;
    };
    constexpr double dt = 1e-6;
    line.step(dt);
    const double first = energy();
    line.run(0.3, dt);
    if (damped) {
      EXPECT_LT(energy(), 1e-3 * first);
    } else {
      EXPECT_NEAR(energy() / first, 1, 0.02);  // tension is that of the step before
    }
  }
}

TEST(ElasticWeb, TheMassAtTheCutIsHalfTheSpanAndWhatIsBeyond) {
  WebData data = elastic(1);
  data.lead = 0.5;
  Strip line(data);
  EXPECT_NEAR(line.web.material().mass, metre * (0.35 + 0.5), 1e-12);
  line.run(0.25);
  EXPECT_NEAR(line.web.material().mass, metre * (0.35 + 0.75), 1e-9);
  line.web.separate(1);
  line.step();
  EXPECT_NEAR(line.web.material().mass, metre * (0.35 + h), 1e-9);
  EXPECT_NEAR(data.mass_at_cut(), metre * 0.35, 1e-15);
  data.strip.on = false;
  EXPECT_EQ(data.mass_at_cut(), 20);
}

TEST(ElasticWeb, AThinWebThatIsPushedMakesALoopUnderEulersLoad) {
  WebData data = elastic(1);
  data.thickness = 0.2e-3;
  const double euler = pi * pi * 3e9 * (0.3 * std::pow(0.2e-3, 3) / 12) / (0.2 * 0.2);
  EXPECT_NEAR(data.springs().buckling_force, euler, 1e-9);
  ASSERT_LT(euler, 1);
  Strip line(data);
  line.run(0.1);
  ASSERT_THAT(line.events, testing::IsEmpty());
  for (int round = 1; round <= 2; ++round) {
    for (int i = 0; i < 5000 && line.events.size() < static_cast<std::size_t>(round); ++i) line.pull(-2, h);
    ASSERT_EQ(line.events.size(), static_cast<std::size_t>(round));
    EXPECT_EQ(line.events.back().name, "slack");
    EXPECT_NEAR(value(line.events.back(), "loop"), 1.1, 0.1);
    EXPECT_EQ(line.read("loop"), value(line.events.back(), "loop"));
    EXPECT_NEAR(std::min(line.read("tension"), line.read("puller.tension")), -euler, 1e-9);
    for (int i = 0; i < 5000 && line.read("tension") <= 0; ++i) line.pull(10, h);
    for (int i = 0; i < 5000 && line.read("loop") > 0; ++i) line.pull(10, h);
    EXPECT_EQ(line.read("loop"), 0);
    EXPECT_GT(line.read("tension"), 0);
  }
}

TEST(ElasticWeb, ATubePushes) {
  WebData data = elastic();
  data.section = "tube";
  data.width = 0.03;
  data.thickness = 2e-3;
  data.density = 7850;
  data.strip.elasticity = 210e9;
  data.strip.guide_distance = 0.7;
  const double bending = pi / 64 * (std::pow(0.03, 4) - std::pow(0.026, 4));
  EXPECT_NEAR(data.springs().buckling_force, pi * pi * 210e9 * bending / 0.49, 1e-3);
  Strip line(data);
  line.pull(-1000, 2, 2e-5);
  EXPECT_NEAR(line.read("tension"), -1000, 1e-3);
  EXPECT_EQ(line.read("loop"), 0);
  EXPECT_THAT(line.events, testing::IsEmpty());
}

TEST(ElasticWeb, ThePhotocellSeesTheWebWhereItStands) {
  // Marks each 300 mm; 900 mm before the cut, between puller and wheel, the strip has stretched by a part.
  WebData data = elastic(1);
  data.marks.pitch = 0.3;
  data.marks.delay = 0;
  Strip pulled(data);
  Strip free(data);
  const auto edge = [](Strip& line, double newton) {
    const auto& port = line.plug<SignalPort>("photocell");
    double last = 0;
    for (int i = 0; i < 20000; ++i) {
      line.web.material().add_force(newton);
      line.step();
      for (const SignalPort::Edge& e : port.edges)
        if (e.rising) last = (i + e.fraction) * h;
    }
    return last;
  };
  const double earlier = edge(free, 0) - edge(pulled, 400);
  EXPECT_NEAR(earlier, 400 / grip + 400 / to_wheel * (1.25 - 0.9) / (1.25 - 0.7), 2e-7);
}

TEST(ElasticWeb, OtherMassMovesWithThePuller) {
  Strip line(elastic());
  const double at_cut = line.web.material().mass;
  for (Parameter& row : line.web.live_parameters())
    if (row.name == "mass") *std::get<double*>(row.value) = 50;
  line.web.parameters_changed();
  EXPECT_EQ(line.web.material().mass, at_cut);
  // 50 kg and the strip on the grip, held by nothing else: 2 pi sqrt(m / k).
  line.pull(100, 0.001);
  EXPECT_GT(line.web.at_wheel().speed, 0);
}

TEST(ElasticWeb, WhatCannotBeIsRefused) {
  expect_refusals<WebDefinition>({
      {[](WebData& d) { d.strip.wheel_distance = 1.25; },
       {"wheel.distance: the wheel, 1250 mm before the cut, is not behind the line drive, 1250 mm before "
        "it"}},
      {[](WebData& d) {
         d.strip.on = true;
         d.density = 7850;
         d.strip.elasticity = 210e9;
         d.strip.retardation = 2e-6;
       },
       {"elasticity: web between line drive and wheel oscillate at",
        "elasticity: web between wheel and cut oscillate at"}},
      {[](WebData& d) {
         d.strip.on = true;
         d.strip.retardation = 1e-3;
       },
       {"retardation: web between line drive and wheel settle in", "retardation: web between wheel and cut"}},
      {[](WebData& d) { d.strip.elasticity = 1e12; }, {}},  // of no account: rigid
  });
}

TEST(Materials, TheFirstIsTheDefaultAndEachHasFourValuesWithASource) {
  WebData data;
  const auto table = web_parameters(data);
  ASSERT_EQ(materials().front().name, data.material);
  for (const Preset& material : materials()) {
    SCOPED_TRACE(material.name);
    EXPECT_EQ(material.values.size(), 4U);
    for (const auto& value : material.values) {
      EXPECT_FALSE(value.source.empty());
      const auto row = std::find_if(table.begin(), table.end(),
                                    [&](const Parameter& r) { return r.name == value.parameter; });
      ASSERT_NE(row, table.end()) << value.parameter;
      const double si = *std::get<double*>(row->value);
      const bool first = &material == &materials().front();
      EXPECT_TRUE(first ? si == value.value : value.parameter != "density" || si != value.value);
    }
  }
}

}  // namespace
}  // namespace drycut::plants
