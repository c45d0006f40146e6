#include "sim/loop/disturbances.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "sim/loop/bus.hpp"
#include "sim/loop/timeline.hpp"
#include "tests/loop/fakes.hpp"

namespace drycut::sim {
namespace {

using fakes::text;
constexpr double full_turn = 2 * std::numbers::pi;

/// Of the filter's own noise, at `hertz`: power of its Fourier coefficient, the mean of many pieces.
std::vector<double> powers(loop::BandNoise noise, double step, const std::vector<double>& hertz) {
  constexpr int pieces = 300;
  std::vector<double> power(hertz.size());
  const int length = static_cast<int>(std::lround(1 / step));  // a second: whole periods of whole frequencies
  std::vector<double> piece(static_cast<std::size_t>(length));
  for (int i = 0; i < pieces; ++i) {
    for (auto& value : piece) value = noise.next();
    for (std::size_t f = 0; f < hertz.size(); ++f) {
      std::complex<double> sum = 0;
      for (int n = 0; n < length; ++n)
        sum += piece[static_cast<std::size_t>(n)] * std::polar(1.0, -full_turn * hertz[f] * n * step);
      power[f] += std::norm(sum) / pieces;
    }
  }
  return power;
}

struct BandCase {
  double low;
  double high;
  double step;
};

TEST(BandNoise, HasTheRmsThatIsAskedFor) {
  for (const auto& [low, high, step] : {BandCase{0, 20, 1e-3}, BandCase{5, 20, 1e-3}, BandCase{0, 400, 1e-3},
                                        BandCase{300, 490, 1e-3}, BandCase{0, 50, 1e-4}}) {
    SCOPED_TRACE(testing::Message() << low << ".." << high << " Hz, " << step << " s");
    loop::BandNoise noise(low, high, step, plants::Random(3));
    // So many values that about 10 000 are independent: the rms is right to half a percent, one sigma.
    const auto count = static_cast<int>(5000 / ((high - low) * step));
    double square = 0;
    double sum = 0;
    for (int i = 0; i < count; ++i) {
      const double value = noise.next();
      square += value * value / count;
      sum += value / count;
    }
    EXPECT_NEAR(std::sqrt(square), 1, 0.025);
    EXPECT_NEAR(sum, 0, 0.05);
  }
}

// A band far below the step keeps its rms: no digits are lost.
TEST(BandNoise, MayBeFarBelowTheStep) {
  double square = 0;
  constexpr int runs = 300;
  for (int i = 0; i < runs; ++i) {
    // Of 1e-7 Hz at steps of 10 ms nothing comes through within 1000 steps; of 0.3 Hz all of it.
    loop::BandNoise slow(0, 1e-7, 1e-2, plants::Random(static_cast<std::uint64_t>(i)));
    loop::BandNoise quick(0, 0.3, 1e-2, plants::Random(static_cast<std::uint64_t>(i)));
    double last = 0;
    double still = 0;
    for (int n = 0; n < 1000; ++n) {
      last = quick.next();
      still = slow.next();
    }
    EXPECT_LT(std::abs(still), 1e-3);
    square += last * last / runs;
  }
  EXPECT_NEAR(square, 1, 0.25);
}

TEST(BandNoise, IsThreeDecibelsDownAtItsEndsAndFarDownBeyond) {
  const auto band = powers(loop::BandNoise(10, 40, 1e-3, plants::Random(5)), 1e-3, {10, 20, 40, 1, 400});
  EXPECT_NEAR(band[0] / band[1], 0.5, 0.12);
  EXPECT_NEAR(band[2] / band[1], 0.5, 0.12);
  EXPECT_LT(band[3] / band[1], 0.03);
  EXPECT_LT(band[4] / band[1], 0.02);
  const auto low = powers(loop::BandNoise(0, 40, 1e-3, plants::Random(5)), 1e-3, {2, 40, 160});
  EXPECT_NEAR(low[1] / low[0], 0.5, 0.12);
  EXPECT_LT(low[2] / low[0], 0.01);
}

/// A plant with a setting, a switch, and faults that can and cannot be disturbed.
class DisturbedPlant : public fakes::FakePlant {
 public:
  std::vector<plants::Fault> faults() override {
    return {{"wheel", "slip", "%", [this](double v) { slip = v; }, "", plants::in_percent},
            {"wheel", "stuck", "", [](double) {}, "", {}}};
  }
  std::vector<plants::Setting> settings() override {
    auto all = FakePlant::settings();
    all.push_back({"count", "", [](double) {}, [] { return 0.0; }, "", plants::in_counts});
    return all;
  }
  plants::Parameters live_parameters() override {
    return {plants::live(plants::row("mass", "kg", "", mass, 1, 100, ""))};
  }
  void parameters_changed() override { ++changes; }
  double slip = 0;
  double mass = 20;
  int changes = 0;
};

struct DisturbancesTest : testing::Test {
  DisturbancesTest() {
    scenario.file = "line.yaml";
    scenario.sources = {"line.yaml"};
    scenario.scene.step = 100 * microsecond;
    controller.values["slLength"] = 800;
  }
  static scenario::Quantity quantity(double number, std::string unit = "") {
    return {number, std::move(unit), {7, 9}};
  }
  scenario::Disturbance& add(scenario::Disturbance::Kind kind, const std::string& at,
                             scenario::Quantity amplitude) {
    auto& one = scenario.disturbances.emplace_back();
    one.kind = kind;
    one.at = text(at, 3, 4);
    one.amplitude = std::move(amplitude);
    return one;
  }
  scenario::Disturbance& add(scenario::Disturbance::Kind kind, double amplitude) {
    return add(kind, "web.speed", quantity(amplitude, "m/s"));
  }
  /// The speed in each step of a run.
  std::vector<double> speeds(Time duration) {
    plant.speed = 1;
    loop::Names names({{"web", &plant}}, &controller, panel);
    loop::Disturbances disturbances(scenario, names, problems);
    loop::Timeline timeline(scenario, names, &controller, problems);
    EXPECT_TRUE(problems.empty());
    std::vector<double> all;
    for (Time now = 0; now < duration; now += scenario.scene.step) {
      timeline.run(now, recording);
      disturbances.run(now);
      all.push_back(plant.speed);
    }
    return all;
  }
  std::string only_problem() {
    loop::Names names({{"web", &plant}}, &controller, panel);
    const loop::Disturbances disturbances(scenario, names, problems);
    EXPECT_EQ(problems.size(), 1U);
    return problems.empty() ? "" : to_string(problems.front());
  }

  scenario::Scenario scenario;
  fakes::FakeController controller;
  DisturbedPlant plant;
  loop::OperatorPanel panel;
  Problems problems;
  record::Recording recording;
};

TEST_F(DisturbancesTest, ASineFadesInAndLeavesNothingBehind) {
  auto& sine = add(scenario::Disturbance::Kind::sine, "web.speed", quantity(6, "m/min"));
  sine.frequency = 25;
  sine.ramp = 20 * millisecond;
  sine.from = 10 * millisecond;
  sine.to = 90 * millisecond;
  const auto all = speeds(100 * millisecond);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double since = static_cast<double>(i) * 1e-4 - 0.01;
    const bool on = since > -1e-9 && since < 0.08 - 1e-9;
    const double fade = std::min(1.0, since / 0.02);
    EXPECT_NEAR(all[i], 1 + (on ? fade * 0.1 * std::sin(full_turn * 25 * since) : 0), 1e-9) << i;
  }
}

TEST_F(DisturbancesTest, AddsToWhatTheTimelineSetsAndRamps) {
  add(scenario::Disturbance::Kind::step, -0.25).from = 5 * millisecond;
  auto& ramp = scenario.timeline.emplace_back();
  ramp.at = 0;
  ramp.ramp = {{text("web.speed"), quantity(2, "m/s")}};
  ramp.over = 10 * millisecond;
  auto& set = scenario.timeline.emplace_back();
  set.at = 15 * millisecond;
  set.set = {{text("web.speed"), quantity(3, "m/s")}};
  const auto all = speeds(20 * millisecond);
  EXPECT_NEAR(all[40], 1.4, 1e-9);
  EXPECT_NEAR(all[60], 1.6 - 0.25, 1e-9);
  EXPECT_NEAR(all[120], 2 - 0.25, 1e-9);
  EXPECT_NEAR(all[160], 3 - 0.25, 1e-9);
}

TEST_F(DisturbancesTest, TwoOfOneTargetAddUpAndKeepToItsRange) {
  add(scenario::Disturbance::Kind::step, 1);
  add(scenario::Disturbance::Kind::step, 2).from = 1 * millisecond;
  EXPECT_DOUBLE_EQ(speeds(5 * millisecond).back(), 4);
  add(scenario::Disturbance::Kind::step, 10);  // 300 m/min is the most
  EXPECT_DOUBLE_EQ(speeds(5 * millisecond).back(), 5);
}

TEST_F(DisturbancesTest, RandomStepsLastAndStayWithinTheirHeight) {
  add(scenario::Disturbance::Kind::step, 0.5).every = 2 * millisecond;
  const auto all = speeds(400 * millisecond);
  std::set<double> heights;
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_LE(std::abs(all[i] - 1), 0.5);
    EXPECT_EQ(all[i], all[i / 20 * 20]);
    heights.insert(all[i]);
  }
  EXPECT_EQ(heights.size(), 200U);
}

TEST_F(DisturbancesTest, AWalkGoesByItsStepAndNotBeyondItsBound) {
  auto& walk = add(scenario::Disturbance::Kind::walk, 0.03);
  walk.step = quantity(10, "mm/s");
  walk.every = millisecond;
  const auto all = speeds(1 * second);
  int at_bound = 0;
  for (std::size_t i = 10; i < all.size(); i += 10) {
    const double way = all[i] - all[i - 10];
    EXPECT_EQ(all[i - 1], all[i - 10]);
    EXPECT_LE(std::abs(all[i] - 1), 0.03 + 1e-12);
    if (std::abs(way) < 1e-9) {
      EXPECT_NEAR(std::abs(all[i] - 1), 0.03, 1e-12);  // only there it waits
      ++at_bound;
    } else {
      EXPECT_NEAR(std::abs(way), 0.01, 1e-12);
    }
  }
  EXPECT_GT(at_bound, 50);  // of seven places on one line an end is met in a seventh of the steps, half go on
}

TEST_F(DisturbancesTest, EachEntryHasAGeneratorOfItsOwn) {
  const auto noise = [&](std::uint64_t scene, std::optional<std::uint64_t> seed, int before) {
    scenario.scene.seed = scene;
    scenario.disturbances.clear();
    for (int i = 0; i < before; ++i) add(scenario::Disturbance::Kind::step, 0);
    auto& one = add(scenario::Disturbance::Kind::noise, 0.1);
    one.band = {0, 100, {}};
    one.seed = seed;
    return speeds(20 * millisecond);
  };
  const auto plain = noise(1, {}, 0);
  EXPECT_EQ(plain, noise(1, {}, 0));
  EXPECT_NE(plain, noise(2, {}, 0));
  EXPECT_NE(plain, noise(1, {}, 1));
  const auto own = noise(1, 5, 0);
  EXPECT_NE(plain, own);
  EXPECT_EQ(own, noise(2, 5, 1));
  EXPECT_NE(own, noise(2, 6, 1));
}

TEST_F(DisturbancesTest, ReachesFaultsAndLiveParameters) {
  add(scenario::Disturbance::Kind::step, "web.wheel.slip", quantity(2, "%"));
  add(scenario::Disturbance::Kind::step, "web.mass", quantity(5, "kg")).to = millisecond;
  speeds(millisecond);
  EXPECT_DOUBLE_EQ(plant.slip, 0.02);
  EXPECT_DOUBLE_EQ(plant.mass, 25);
  EXPECT_EQ(plant.changes, 10);
  plant.mass = 20;
  speeds(2 * millisecond);
  EXPECT_DOUBLE_EQ(plant.mass, 20);
  EXPECT_EQ(plant.changes, 10 + 11);  // the last one takes it away; then it costs nothing
}

TEST_F(DisturbancesTest, OfAFaultAddsToWhatTheTimelineGives) {
  add(scenario::Disturbance::Kind::step, "web.wheel.slip", quantity(2, "%"));
  auto& set = scenario.timeline.emplace_back();
  set.at = millisecond;
  set.faults = {{text("web.wheel"), text("slip"), quantity(10, "%")}};
  speeds(2 * millisecond);
  EXPECT_DOUBLE_EQ(plant.slip, 0.12);
}

struct WrongDisturbance {
  const char* name;
  void (*make)(DisturbancesTest&);
  const char* told;
};

class WrongDisturbances : public DisturbancesTest, public testing::WithParamInterface<WrongDisturbance> {};

TEST_P(WrongDisturbances, AreToldWithTheirPlace) {
  GetParam().make(*this);
  EXPECT_EQ(only_problem(), GetParam().told);
}

INSTANTIATE_TEST_SUITE_P(
    All, WrongDisturbances,
    testing::Values(
        WrongDisturbance{"unknown_name",
                         [](DisturbancesTest& t) {
                           t.add(scenario::Disturbance::Kind::step, "web.sped", t.quantity(1, "m/s"));
                         },
                         "line.yaml:3:4: nothing called 'web.sped' can be disturbed; did you mean web.speed? "
                         "[timeline.nothing-to-set]"},
        WrongDisturbance{"unknown_fault",
                         [](DisturbancesTest& t) {
                           t.add(scenario::Disturbance::Kind::step, "web.wheel.slipp", t.quantity(1, "%"));
                         },
                         "line.yaml:3:4: nothing called 'web.wheel.slipp' can be disturbed; did you mean "
                         "web.wheel.slip? [timeline.nothing-to-set]"},
        WrongDisturbance{
            "of_the_controller",
            [](DisturbancesTest& t) { t.add(scenario::Disturbance::Kind::step, "slLength", t.quantity(1)); },
            "line.yaml:3:4: nothing called 'slLength' can be disturbed; name a plant's setting, live "
            "parameter "
            "or component.fault: drycut plants lists them [timeline.nothing-to-set]"},
        WrongDisturbance{
            "whole_setting",
            [](DisturbancesTest& t) { t.add(scenario::Disturbance::Kind::step, "web.count", t.quantity(1)); },
            "line.yaml:3:4: web.count takes whole numbers: nothing can be added little by little; set it "
            "in the "
            "timeline [scenario.not-a-number]"},
        WrongDisturbance{
            "switch_of_a_fault",
            [](DisturbancesTest& t) {
              t.add(scenario::Disturbance::Kind::step, "web.wheel.stuck", t.quantity(1));
            },
            "line.yaml:3:4: web.wheel.stuck takes whole numbers: nothing can be added little by little; "
            "set it "
            "in the timeline [scenario.not-a-number]"},
        WrongDisturbance{
            "wrong_unit",
            [](DisturbancesTest& t) {
              t.add(scenario::Disturbance::Kind::step, "web.speed", t.quantity(1, "kg"));
            },
            "line.yaml:7:9: web.speed is a speed, 'kg' is not; give it in m/min [scenario.wrong-unit]"},
        WrongDisturbance{
            "no_unit",
            [](DisturbancesTest& t) { t.add(scenario::Disturbance::Kind::step, "web.speed", t.quantity(1)); },
            "line.yaml:7:9: web.speed needs a unit; write for example 1 m/min [scenario.wrong-unit]"},
        WrongDisturbance{
            "band_above_nyquist",
            [](DisturbancesTest& t) {
              t.add(scenario::Disturbance::Kind::noise, 0.1).band = {5, 5000, {4, 5}};
            },
            "line.yaml:4:5: noise up to 5000 Hz has less than two steps a period; less than 5000 Hz, or a "
            "shorter scene.step [scenario.time-grid]"},
        WrongDisturbance{
            "sine_above_nyquist",
            [](DisturbancesTest& t) { t.add(scenario::Disturbance::Kind::sine, 0.1).frequency = 6000; },
            "line.yaml:3:4: a sine of 6000 Hz has less than two steps a period; less than 5000 Hz, or a "
            "shorter scene.step [scenario.time-grid]"}),
    [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace drycut::sim
