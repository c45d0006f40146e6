// What is not ideal about transducers and drum: eccentricity, teeth, slip, interference; closed forms.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "plants/measuring_wheel.hpp"
#include "plants/rotary_knife.hpp"
#include "plants/transducers.hpp"
#include "plants/web.hpp"
#include "tests/plants/plants_lookup.hpp"
#include "tests/plants/web_line.hpp"

namespace drycut::plants {
namespace {

constexpr double one_degree = pi / 180;

// With the axis e beside the middle r angle + e sin(angle) of the web passes: the wheel that was turned by
// `angle` stands on just that.
TEST(EccentricWheel, TurnsByTheAngleThatHasRolledOff) {
  const MeasuringWheelData data = {.eccentricity = 2e-3};
  MeasuringWheel wheel(data, Random());
  const double r = data.radius();
  EXPECT_NEAR(r, 0.5 / turn, 1e-15);
  double before = 0;
  for (int i = 0; i < 314; ++i) {
    const double angle = 0.1 * i;
    const double now = r * angle + data.eccentricity * std::sin(angle);
    wheel.sense(before, now, h);
    EXPECT_NEAR(wheel.pulses.port.now, angle / turn * 10000, 1e-7) << angle;
    before = now;
  }
}

TEST(EccentricWheel, IsRightAgainAfterEachTurnForwardsAndBackwards) {
  MeasuringWheel wheel({.eccentricity = 5e-3}, Random());
  for (const double turns : {1.0, 2.0, 1e6, -1.0, -3.0, 0.0}) {
    wheel.sense(0, 0.5 * turns, h);
    EXPECT_NEAR(wheel.pulses.port.now, 10000 * turns, 1e-5) << turns;
    EXPECT_NEAR(wheel.revolutions(), turns, 1e-9);
  }
}

TEST(EccentricWheel, IndexStaysWhereItIs) {
  MeasuringWheel wheel({.eccentricity = 5e-3, .tooth_error = 1e-4, .teeth = 20}, Random());
  int indexes = 0;
  for (int i = 0; i < 2000; ++i) {
    wheel.sense(i * 1.3e-3, (i + 1) * 1.3e-3, h);
    for (const SignalPort::Edge& edge : wheel.index.edges) {
      if (!edge.rising) continue;
      ++indexes;
      EXPECT_EQ(wheel.pulses.port.count_at(edge.fraction), 10000 * indexes);
    }
  }
  EXPECT_EQ(indexes, 5);
}

TEST(MeasuringWheel, ToothErrorIsASineOfTheTeeth) {
  const MeasuringWheelData data = {.tooth_error = 1e-4, .teeth = 20};
  MeasuringWheel wheel(data, Random());
  for (int i = 0; i < 333; ++i) {
    const double x = 0.003 * i;
    wheel.sense(x, x, h);
    const double angle = x / data.radius();
    EXPECT_NEAR(wheel.pulses.port.now, (x + 1e-4 * std::sin(20 * angle)) * 20000, 1e-6) << x;
  }
}

// k a v dt summed up over any way from v0 to v1 is k (v1^2 - v0^2) / 2: lost while the web gets faster, given
// back when it gets slower.
TEST(MeasuringWheel, AccelerationSlipLosesTheDifferenceOfTheSquaresOfSpeed) {
  WebData data;
  data.wheel.acceleration_slip = 0.004;
  WebLine line(data);
  const auto lost = [&] {
    return line.web.material().position - line.plug<EncoderPort>("wheel").now / 20000;
  };
  line.run(0.5);
  EXPECT_NEAR(lost(), 0, 1e-12);
  line.set("speed", 2);
  line.run(2);
  EXPECT_NEAR(line.web.material().speed, 2, 1e-6);
  EXPECT_NEAR(lost(), 0.004 * (4 - 1) / 2, 1e-8);
  line.set("speed", -1);  // it loses on the other way, too
  line.run(4);
  EXPECT_NEAR(lost(), 0.004 * (-1 - 1) / 2, 1e-8);
  line.set("speed", 1);
  line.run(3);
  EXPECT_NEAR(lost(), 0, 1e-8);
}

TEST(UnevenEncoder, ShowsTheSinesOfItsDiscAndItsTeeth) {
  const EncoderData data = {
      .lines = 2500, .eccentricity = 0.1 * one_degree, .tooth_error = 0.02 * one_degree, .teeth = 30};
  World world;
  Shaft& shaft = world.add_shaft({.name = "shaft", .inertia = 1, .revolutions = 0.3});
  Encoder encoder(data, 0.3, Random());
  const auto shown = [&](double angle) {
    return angle + data.eccentricity * std::sin(angle) + data.tooth_error * std::sin(30 * angle);
  };
  shaft.speed = 20 * pi;
  double largest = 0;
  for (int i = 0; i < 2000; ++i) {
    world.step(h);
    encoder.sense(shaft, h);
    const double counts = (shown(shaft.angle()) - shown(0.3 * turn)) / turn * 10000;
    EXPECT_NEAR(encoder.pulses.port.now, counts, 1e-6);
    largest = std::max(largest, std::abs(counts - (shaft.revolutions() - 0.3) * 10000));
    for (const SignalPort::Edge& edge : encoder.index.edges) {
      const double wanted = (turn * std::round(shaft.revolutions()) - shown(0.3 * turn)) / turn * 10000;
      EXPECT_EQ(encoder.pulses.port.count_at(edge.fraction), std::lround(wanted));
    }
  }
  EXPECT_GT(largest, 0.1 / 360 * 10000);
}

// Half way between two lines' edges it shows as much too far as it does too little half a period on.
TEST(UnevenEncoder, ErrsWithinEachSignalPeriod) {
  for (const int periods : {0, 100}) {  // as many as lines; of a disc whose signals are interpolated
    const EncoderData data = {.lines = 2500, .interpolation_error = 0.03, .signal_periods = periods};
    const int disc = periods > 0 ? periods : data.lines;
    World world;
    Shaft& shaft = world.add_shaft({.name = "shaft", .inertia = 1});
    Encoder encoder(data, 0, Random());
    const double step = 0.1 / disc;  // a tenth of a period
    shaft.speed = step * turn / h;
    double largest = 0;
    int indexes = 0;
    for (int i = 1; i <= 40 * disc; ++i) {
      world.step(h);
      encoder.sense(shaft, h);
      const double exact = shaft.revolutions();
      const double shown = exact + 0.03 / disc * std::sin(turn * disc * exact);
      EXPECT_NEAR(encoder.pulses.port.now, 10000 * shown, 1e-5);
      largest = std::max(largest, std::abs(encoder.pulses.port.now - 10000 * exact));
      for (const SignalPort::Edge& edge : encoder.index.edges) {
        indexes += edge.rising ? 1 : 0;
        EXPECT_EQ(encoder.pulses.port.count_at(edge.fraction) % 10000, 0);
      }
    }
    EXPECT_NEAR(largest, 10000 * 0.03 / disc * std::sin(0.3 * turn), 1e-4 * 10000 / disc);
    EXPECT_GE(indexes, 3);
  }
}

TEST(UnevenEncoder, TellsHowLongItsIndexPulseLasts) {
  World world;
  Shaft& shaft = world.add_shaft({.name = "shaft", .inertia = 1, .revolutions = 0.5});
  Encoder encoder({.lines = 2500, .index_width = 2}, 0.5, Random());
  shaft.speed = 20 * pi;  // 10 turns a second: 10 counts a step
  int indexes = 0;
  for (int i = 0; i < 1000; ++i) {
    world.step(h);
    encoder.sense(shaft, h);
    for (const SignalPort::Edge& edge : encoder.index.edges) {
      if (!edge.rising) continue;
      ++indexes;
      EXPECT_NEAR(edge.width * h, 2 / 100e3, 1e-12);
    }
  }
  EXPECT_EQ(indexes, 1);
}

struct Interference : testing::Test {
  Interference() { line.offer_faults(faults, "encoder"); }
  void run(int steps) {
    for (int i = 0; i < steps; ++i) {
      const double before = line.port.now;
      line.carry(0, 0, h);
      EXPECT_EQ(line.port.before, before);  // steps join
      busy += line.port.now != before ? 1 : 0;
    }
  }
  PulseLine line{Random(7)};
  std::vector<Fault> faults;
  int busy = 0;
};

TEST_F(Interference, AddsItsCountsOverItsTime) {
  for (const double counts : {300.0, -300.0}) {
    const double start = line.port.now;
    fault(faults, "encoder", "burst_time", 0.02);
    fault(faults, "encoder", "add_counts", counts);
    run(100);
    EXPECT_NEAR(line.port.now - start, counts / 2, 40);  // spread evenly, by chance
    run(100);
    EXPECT_EQ(line.port.now - start, counts);
    busy = 0;
    run(100);
    EXPECT_EQ(busy, 0);
  }
}

TEST_F(Interference, OfEitherSignIsAWalkOfSoManySteps) {
  double square = 0;
  constexpr int bursts = 400;
  for (int i = 0; i < bursts; ++i) {
    const double start = line.port.now;
    fault(faults, "encoder", "burst", 100);
    run(101);
    const double sum = line.port.now - start;
    EXPECT_EQ(std::fmod(sum, 2), 0);  // 100 steps up or down
    square += sum * sum / bursts;
  }
  EXPECT_NEAR(square, 100, 25);
}

TEST_F(Interference, IsTheSameWithTheSameSeed) {
  PulseLine twin(Random(7));
  std::vector<Fault> own;
  twin.offer_faults(own, "encoder");
  fault(faults, "encoder", "burst", 50);
  fault(own, "encoder", "burst", 50);
  for (int i = 0; i < 100; ++i) {
    line.carry(0, 0, h);
    twin.carry(0, 0, h);
    EXPECT_EQ(line.port.now, twin.port.now);
  }
}

// Of two blades one comes e before its place and one e behind it: lengths differ by 2 e from the mean.
TEST(EccentricDrum, CutsOfTwoBladesAreLongAndShort) {
  RotaryKnifeDefinition knife;
  knife.data.blade_count = 2;
  knife.data.coupling = 0;
  knife.data.drum_eccentricity = 0.3e-3;
  WebDefinition web;
  web.data.shear_strength = 0;
  Machine line(knife, &web);
  line.reference(2.5);
  line.run(5);
  ASSERT_GE(line.events.size(), 10U);
  const double first = value(line.events[6], "length") > 300 ? 1 : -1;
  for (std::size_t i = 6; i < line.events.size(); ++i)
    EXPECT_NEAR(value(line.events[i], "length"), 300 + (i % 2 == 0 ? first : -first) * 0.6, 2e-3) << i;
}

TEST(PeriodicErrors, ThatNoMachineHasAreRefused) {
  expect_refusals<WebDefinition>(
      {{[](WebData& data) { data.wheel.eccentricity = 0.04; }, {"wheel.eccentricity: 40 mm on a radius of"}},
       {[](WebData& data) { data.wheel.tooth_error = 2e-3; }, {"wheel.tooth_error: with 64 teeth"}}});
  const auto objections_to = [](auto change) {
    WebDefinition web;
    RotaryKnifeDefinition knife;
    change(knife.data);
    return objections_of(knife, h, &web);
  };
  EXPECT_THAT(objections_to([](RotaryKnifeData& data) { data.drum_eccentricity = 5e-3; }),
              testing::ElementsAre(testing::StartsWith("drum_eccentricity: 5 mm is more than")));
  EXPECT_THAT(objections_to([](RotaryKnifeData& data) { data.sensors.encoder.tooth_error = one_degree; }),
              testing::ElementsAre(testing::StartsWith("encoder.tooth_error: with 64 teeth")));
}

}  // namespace
}  // namespace drycut::plants
