#include <gtest/gtest.h>

#include <cmath>

#include "plants/measuring_wheel.hpp"
#include "plants/transducers.hpp"
#include "tests/plants/plants_lookup.hpp"

namespace drycut::plants {
namespace {

using ::testing::ElementsAre;

/// A shaft with imposed speed and an encoder on it.
struct Turning {
  World world;
  Shaft& shaft;
  Encoder encoder;
  std::vector<Fault> faults;
  explicit Turning(const EncoderData& data = {}, double start = 0)
      : shaft(world.add_shaft({.name = "shaft", .inertia = 1, .revolutions = start})),
        encoder(data, start, world.random("encoder")) {
    encoder.pulses.offer_faults(faults, "encoder");
  }
  /// Counts at the index pulses of what was run last.
  std::vector<std::int64_t> indexes;
  void run(double turns_per_step, int steps) {
    indexes.clear();
    shaft.speed = turns_per_step * 2 * pi / h;
    for (int i = 0; i < steps; ++i) {
      world.step(h);
      encoder.sense(shaft, h);
      for (const SignalPort::Edge& edge : encoder.index.edges)
        if (edge.rising) indexes.push_back(encoder.pulses.port.count_at(edge.fraction));
    }
  }
  [[nodiscard]] double now() const { return encoder.pulses.port.now; }
  [[nodiscard]] std::int64_t count() const { return encoder.pulses.port.count; }
};

TEST(Encoder, CountsExactlyOverAMillionTurnsBothWays) {
  Turning t({.lines = 2501});
  std::size_t indexes = 0;
  const auto run = [&](double turns_per_step) {
    t.run(turns_per_step, 8333340);
    indexes += t.indexes.size();
    // The index is at a whole turn: its count is a multiple of the counts per turn, exactly.
    for (const std::int64_t count : t.indexes) ASSERT_EQ(count % 10004, 0);
  };
  run(0.12);  // 1 000 000.8 turns: count 10 004 008 003.2
  EXPECT_EQ(t.count(), 10004008003);
  EXPECT_EQ(indexes, 1000000U);
  run(-0.12);
  EXPECT_NEAR(t.now(), 0, 1e-3);
  run(-0.12);
  EXPECT_EQ(t.count(), -10004008003);
  EXPECT_EQ(indexes, 3000001U);  // a million each way and back, and the one at zero
}

TEST(Encoder, CountIsTheNearestToTheExactPosition) {
  Turning t({.lines = 2});
  const double turns[] = {0.05, 0.05, 0.05, 0.05, -0.05, -0.05, -0.05, -0.05, -0.05};
  const std::int64_t counts[] = {0, 1, 1, 2, 1, 1, 0, 0, 0};  // 8 a turn
  for (int i = 0; i < 9; ++i) {
    t.run(turns[i], 1);
    EXPECT_EQ(t.count(), counts[i]) << i;
  }
}

TEST(Encoder, StartsAtZeroWhereTheShaftStandsAndKeepsTheIndexWhereItIs) {
  Turning t({.lines = 2048}, 2.5);
  t.run(0.1, 6);  // reaches 3.0 in the fifth step, or the next by rounding
  EXPECT_NEAR(t.now(), 0.6 * 8192, 1e-6);
  EXPECT_THAT(t.indexes, ElementsAre(4096));
  t.run(0.1, 1);
  EXPECT_THAT(t.indexes, ElementsAre());
}

TEST(Encoder, IndexIsTheSameCountFromBothSides) {
  Turning t({.lines = 1024}, 0.93);
  const auto expected = static_cast<std::int64_t>(std::floor(0.07 * 4096 + 0.5));
  for (const double turns : {0.0171, -0.0171}) {
    t.run(turns, 8);
    EXPECT_THAT(t.indexes, ElementsAre(expected));
  }
}

TEST(Encoder, ReverseMountingCountsDown) {
  Turning t({.lines = 2048, .reverse = true});
  t.run(0.1, 11);
  EXPECT_NEAR(t.now(), -1.1 * 8192, 1e-6);
}

TEST(EncoderFaults, LostCountsStayLostInTheDirectionOfMotion) {
  for (const double direction : {1.0, -1.0}) {
    Turning t;
    t.run(0.1 * direction, 3);
    const double before = t.now();
    fault(t.faults, "encoder", "lose_counts", 200);
    t.run(0.1 * direction, 1);
    EXPECT_NEAR(t.now(), before + direction * (819.2 - 200), 1e-6);
    t.run(0.1 * direction, 10);
    EXPECT_NEAR(t.now(), direction * (1.4 * 8192 - 200), 1e-6);
  }
}

TEST(EncoderFaults, StuckHoldsTheCountAndTheIndex) {
  Turning t;
  t.run(0.1, 5);
  fault(t.faults, "encoder", "stuck", 1);
  const std::int64_t held = t.count();
  for (int i = 0; i < 20; ++i) {
    t.run(0.1, 1);
    EXPECT_EQ(t.count(), held);
    EXPECT_THAT(t.indexes, ElementsAre());
  }
  fault(t.faults, "encoder", "stuck", 0);
  t.run(0.1, 5);
  EXPECT_NEAR(t.now(), 8192, 1e-6);
}

TEST(EncoderFaults, ReverseTurnsTheCountRoundFromItsTime) {
  Turning t;
  t.run(0.1, 5);
  fault(t.faults, "encoder", "reverse", 1);
  t.run(0.1, 2);
  EXPECT_NEAR(t.now(), 0.3 * 8192, 1e-6);
  fault(t.faults, "encoder", "reverse", 0);
  t.run(0.1, 1);
  EXPECT_NEAR(t.now(), 0.4 * 8192, 1e-6);
}

TEST(EncoderFaults, JitterHasItsRmsAndLeavesNoOffset) {
  Turning t;
  fault(t.faults, "encoder", "jitter", 3);
  double square = 0;
  double last = 0;
  const int n = 20000;
  for (int i = 0; i < n; ++i) {
    t.run(0, 1);
    EXPECT_EQ(t.encoder.pulses.port.before, last);  // steps join
    last = t.now();
    square += last * last / n;
  }
  EXPECT_NEAR(std::sqrt(square), 3, 0.1);
  fault(t.faults, "encoder", "jitter", 0);
  t.run(0, 1);
  EXPECT_EQ(t.count(), 0);
}

TEST(MeasuringWheel, CountsTravelByItsTrueCircumference) {
  MeasuringWheelData data;
  MeasuringWheel ideal(data, Random());
  ideal.sense(0, 12.34567, h);
  EXPECT_EQ(ideal.pulses.port.count, 246913);
  data.circumference_error = 0.01;
  MeasuringWheel worn(data, Random());
  worn.sense(0, 1.01, h);
  EXPECT_EQ(worn.pulses.port.count, 20000);
  data = {.slip = 0.25};
  MeasuringWheel slipping(data, Random());
  slipping.sense(0, 1, h);
  EXPECT_EQ(slipping.pulses.port.count, 15000);
}

TEST(MeasuringWheel, IndexComesOnceATurnAtItsCount) {
  MeasuringWheel wheel({}, Random());
  int indexes = 0;
  double x = 0;
  for (int i = 0; i < 10000; ++i) {
    wheel.sense(x, x + 1.3e-3, h);
    x += 1.3e-3;
    if (wheel.index.edges.empty()) continue;
    ++indexes;
    EXPECT_EQ(wheel.pulses.port.count_at(wheel.index.edges[0].fraction), 10000 * indexes);
  }
  EXPECT_EQ(indexes, 26);
}

TEST(MeasuringWheel, EveryIndexOfAStepComesAtItsCount) {
  // A wheel of 10 mm and steps of 25.31 mm, 253.1 turns there and 250.6 back: two or three turns a step.
  MeasuringWheel wheel({.circumference = 0.01}, Random());
  double x = 0;
  std::int64_t turns = 0;  // of the last index
  for (const int way : {1, -1}) {
    if (way < 0) ++turns;
    for (int i = 0; i < (way > 0 ? 100 : 99); ++i) {
      wheel.sense(x, x + way * 0.02531, h);
      x += way * 0.02531;
      double last = 0;
      for (const SignalPort::Edge& edge : wheel.index.edges) {
        EXPECT_GE(edge.fraction, last);
        last = edge.fraction;
        if (!edge.rising) continue;
        turns += way;
        EXPECT_EQ(wheel.pulses.port.count_at(edge.fraction), 10000 * turns);
      }
    }
    EXPECT_EQ(turns, way > 0 ? 253 : 3);
  }
}

// The common case, told without rounding, is none in which an index would come: around 0 too.
TEST(PutIndex, TheQuickAnswerIsTheExactOne) {
  const double steps[] = {-1.2, -1, -0.4, -0.1, -1e-12, 0, 1e-12, 0.1, 0.4, 1, 1.2};
  for (double before = -2; before <= 2; before += 0.1) {
    for (const double from : {before, std::nearbyint(before)}) {
      for (const double step : steps) {
        const double to = from + step;
        SignalPort quick;
        SignalPort exact;
        put_index(quick, from, to, 1000 * from, 1000 * to, 1000);
        put_passed_index(exact, from, to, 1000 * from, 1000 * to, 1000, 1);
        ASSERT_EQ(quick.edges.size(), exact.edges.size()) << from << " to " << to;
        for (std::size_t i = 0; i < quick.edges.size(); ++i)
          EXPECT_EQ(quick.edges[i].fraction, exact.edges[i].fraction) << from << " to " << to;
      }
    }
  }
}

TEST(MeasuringWheelFaults, SlipFromNowOnKeepsWhatWasCounted) {
  MeasuringWheel wheel({}, Random());
  std::vector<Fault> faults;
  wheel.offer_faults(faults, "wheel");
  wheel.sense(0, 1, h);
  fault(faults, "wheel", "slip", 0.5);
  wheel.sense(1, 2, h);
  EXPECT_NEAR(wheel.pulses.port.before, 20000, 1e-6);
  EXPECT_NEAR(wheel.pulses.port.now, 30000, 1e-6);
  fault(faults, "wheel", "slip", 0);
  wheel.sense(2, 3, h);
  EXPECT_NEAR(wheel.pulses.port.now, 50000, 1e-6);
  fault(faults, "wheel", "lose_counts", 7);
  fault(faults, "wheel", "stuck", 1);
  wheel.sense(3, 4, h);
  EXPECT_NEAR(wheel.pulses.port.now, 49993, 1e-6);
}

/// Moves a switch from a to b in steps and gives the positions of its edges, with the delay's travel in them.
std::vector<double> edges(PositionSwitch& s, double from, double to, double step) {
  std::vector<double> found;
  double x = from;
  const double dx = to > from ? step : -step;
  for (int i = 0; i < std::lround((to - from) / dx); ++i) {
    s.sense(x, x + dx, h);
    for (const SignalPort::Edge& edge : s.port.edges) found.push_back(x + dx * edge.fraction);
    x += dx;
  }
  return found;
}

TEST(PositionSwitch, ATargetThatIsPassedWithinAStepGivesBothEdges) {
  using ::testing::DoubleNear;
  PositionSwitch s({.centre = 1, .width = 0.01, .hysteresis = 0.002}, 0, 0);
  EXPECT_THAT(edges(s, 0.1, 2.1, 0.4), ElementsAre(DoubleNear(0.995, 1e-12), DoubleNear(1.007, 1e-12)));
  EXPECT_THAT(edges(s, 2.1, 0.1, 0.4), ElementsAre(DoubleNear(1.005, 1e-12), DoubleNear(0.993, 1e-12)));
  EXPECT_FALSE(s.port.level);
  // A turn of 1 and a step over its end.
  PositionSwitch drum({.centre = 0.99, .width = 0.01}, 1, 0.95);
  drum.sense(0.95, 0.05, h);
  ASSERT_EQ(drum.port.edges.size(), 2U);
  EXPECT_NEAR(drum.port.edges[0].fraction, 0.35, 1e-12);
  EXPECT_NEAR(drum.port.edges[1].fraction, 0.45, 1e-12);
  // The way over the target takes 0.012 / 0.4 of a step: a filter of a hundredth lets it pass, of a tenth
  // not.
  PositionSwitch fast({.centre = 1, .width = 0.01, .hysteresis = 0.002, .delay = h / 100}, 0, 0);
  EXPECT_THAT(edges(fast, 0.1, 2.1, 0.4), ElementsAre(DoubleNear(0.999, 1e-12), DoubleNear(1.011, 1e-12)));
  PositionSwitch slow({.centre = 1, .width = 0.01, .hysteresis = 0.002, .delay = h / 10}, 0, 0);
  EXPECT_THAT(edges(slow, 0.1, 2.1, 0.4), ElementsAre());
}

TEST(PositionSwitch, SwitchesAtTheTargetAndLetsGoBehindTheHysteresis) {
  PositionSwitch s({.centre = 1, .width = 0.2, .hysteresis = 0.05}, 0, 0);
  EXPECT_FALSE(s.port.level);
  const std::vector<double> up = edges(s, 0, 2, 0.013);
  ASSERT_EQ(up.size(), 2U);
  EXPECT_NEAR(up[0], 0.9, 1e-9);
  EXPECT_NEAR(up[1], 1.15, 1e-9);
  const std::vector<double> down = edges(s, 2, 0, 0.013);
  ASSERT_EQ(down.size(), 2U);
  EXPECT_NEAR(down[0], 1.1, 1e-9);
  EXPECT_NEAR(down[1], 0.85, 1e-9);
}

TEST(PositionSwitch, RepeatsWithItsPeriod) {
  PositionSwitch s({.centre = 0.5, .width = 0.1}, 1, 0);
  int rising = 0;
  double part = 0;
  for (int i = 0; i < 3000; ++i) {
    const double next = part + 0.01 >= 1 ? part + 0.01 - 1 : part + 0.01;
    s.sense(part, next, h);
    part = next;
    for (const SignalPort::Edge& edge : s.port.edges) rising += edge.rising ? 1 : 0;
  }
  EXPECT_EQ(rising, 30);
}

TEST(PositionSwitch, DelaysItsEdgesAndSwallowsShortOnes) {
  const double delay = 5.5 * h;
  PositionSwitch s({.centre = 1, .width = 0.2, .delay = delay}, 0, 0);
  const double speed = 0.01;  // per step
  const std::vector<double> slow = edges(s, 0, 2, speed);
  ASSERT_EQ(slow.size(), 2U);
  EXPECT_NEAR(slow[0], 0.9 + 5.5 * speed, 1e-9);
  EXPECT_NEAR(slow[1], 1.1 + 5.5 * speed, 1e-9);
  EXPECT_TRUE(edges(s, 2, 0, 0.1).empty());  // over the target for two steps only
}

TEST(PositionSwitch, FaultsHoldOrKillTheSignal) {
  PositionSwitch s({.centre = 0, .width = 0.2}, 0, 0);
  std::vector<Fault> faults;
  s.offer_faults(faults, "home");
  EXPECT_TRUE(s.port.level);
  fault(faults, "home", "stuck", 1);
  s.sense(0, 1, h);
  EXPECT_TRUE(s.port.level);
  fault(faults, "home", "stuck", 0);
  EXPECT_FALSE(s.port.level);
  fault(faults, "home", "dead", 1);
  s.sense(1, 0, h);
  EXPECT_FALSE(s.port.level);
  fault(faults, "home", "dead", 0);
  EXPECT_TRUE(s.port.level);
}

}  // namespace
}  // namespace drycut::plants
