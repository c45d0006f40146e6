// Disturbances on whole lines, against closed forms.
#include <gmock/gmock.h>

#include <cmath>
#include <complex>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "sim/loop/simulation.hpp"
#include "tests/findings.hpp"
#include "tests/test_folder.hpp"

namespace drycut::sim {
namespace {

constexpr double full_turn = 2 * std::numbers::pi;

/// A run to the end without pictures.
struct LineRun {
  Problems problems;
  scenario::Scenario scenario;
  std::unique_ptr<loop::Simulation> simulation;
  record::Outcome outcome;

  explicit LineRun(const std::string& scene, const std::vector<scenario::Override>& overrides)
      : scenario(read_scenario(source_root / "scenes" / scene, overrides, problems)) {
    play();
  }
  explicit LineRun(const std::string& text)
      : scenario(scenario::read_scenario_text(text, "line.yaml", {}, problems)) {
    play();
  }
  void play() {
    scenario.pictures.frames = false;
    EXPECT_EQ(lines_of(problems), "");
    if (!problems.empty()) return;
    simulation = std::make_unique<loop::Simulation>(scenario, problems);
    EXPECT_EQ(lines_of(problems), "");
    if (problems.empty()) outcome = simulation->run();
    EXPECT_EQ(outcome.failure, "");
  }

  /// A value of every event of that name.
  [[nodiscard]] std::vector<double> values(const std::string& event, const std::string& value) const {
    std::vector<double> all;
    const auto& events = simulation->recording().events();
    for (std::size_t i = 0; i < events.size(); ++i) {
      const auto one = events[i];
      if (one.event != event) continue;
      for (const auto& v : one.values)
        if (v.name == value) all.push_back(v.number);
    }
    return all;
  }
  [[nodiscard]] std::vector<double> column(const std::string& name) const {
    std::vector<double> all;
    const auto* column = simulation->recording().column(name);
    if (column == nullptr) return all;
    for (std::size_t i = 0; i < column->values.size(); ++i) all.push_back(column->values[i]);
    return all;
  }
  [[nodiscard]] bool noted(const std::string& words) const {
    for (const auto& note : sentences(simulation->notes()))
      if (note.find(words) != std::string::npos) return true;
    return false;
  }
};

// A slip of 1 % about which a sine of 2 % breathes: after half a period 2 a v / w counts more are lost, after
// a whole one none.
TEST(SlipThatBreathes, GoesBothWaysAboutTheParameter) {
  const auto counts = [](const std::string& disturbances) {
    const LineRun run(
        "scene: {duration: 2 s}\n"
        "plants: {web: {type: web, speed: 60 m/min, wheel: {lines: 10000, slip: 1 %}}}\n"
        "record: {every: 500 ms, channels: [web.wheel.count]}\n" +
        disturbances);
    return run.column("web.wheel.count");
  };
  const auto plain = counts("");
  const auto breathing =
      counts("disturbances: [{at: web.wheel.slip, kind: sine, amplitude: 2 %, frequency: 1 Hz}]\n");
  ASSERT_GE(plain.size(), 4U);
  ASSERT_EQ(plain.size(), breathing.size());
  const double most = 2 * 0.02 * 80'000 / full_turn;  // 80 000 counts a second
  for (std::size_t i = 0; i < plain.size(); ++i)
    EXPECT_NEAR(plain[i] - breathing[i], i % 2 == 1 ? most : 0, 2) << i;
}

// The wheel's axis lies e beside its middle: while the wheel turns from a to b, r (b - a) + e (sin b - sin a)
// of the web passes it. The controller cuts when its 800 mm have been counted, so a piece is e (sin b - sin
// a) too long: a sine of one turn of the wheel, of amplitude 2 e sin(800 mm / 2 r).
TEST(EccentricWheelOnTheDefaultLine, MakesPiecesLongAndShortByItsLaw) {
  constexpr double e = 0.5;  // [mm]
  const double r = 500 / full_turn;
  const LineRun run("rotary_knife.yaml",
                    {{"plants.web.wheel.eccentricity", "0.5 mm"}, {"scene.duration", "24 s"}});
  const auto lengths = run.values("cut", "length");
  ASSERT_GT(lengths.size(), 12U);
  const auto angle_at = [&](double x) {
    double angle = x / r;
    for (int i = 0; i < 50; ++i) angle = (x - e * std::sin(angle)) / r;
    return angle;
  };
  double x = 0;
  int pieces = 0;
  std::complex<double> sum = 0;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    const double from = angle_at(x);
    x += lengths[i];
    const double to = angle_at(x);
    if (i < 4) continue;  // the line starts
    EXPECT_NEAR(lengths[i], 800 + e * (std::sin(to) - std::sin(from)), 0.12) << i;
    if (pieces == 5 * ((static_cast<int>(lengths.size()) - 4) / 5)) continue;  // whole rounds of 8 turns
    sum += (lengths[i] - 800) * std::polar(1.0, -(from + to) / 2);
    ++pieces;
  }
  ASSERT_GE(pieces, 5);
  const double amplitude = 2 * e * std::abs(std::sin(800 / r / 2));
  EXPECT_NEAR(2 * std::abs(sum) / pieces, amplitude, 0.05 * amplitude);
  EXPECT_GT(amplitude, 0.9);
}

// The line drive pulls the web through a spring and a damper: what of a sine of the set speed the web does is
// H = (k + i w c) / (k - m w^2 + i w c). Pieces cut every T seconds are sines of 2 A |H| / w sin(w T / 2).
TEST(SineOnLineSpeed, MakesPiecesOfATimeLongAndShort) {
  const LineRun run(R"(
scene: {step: 100 us, duration: 12 s}
plants: {web: {type: web, speed: 60 m/min, drive: {acceleration: 20 m/s2}}}
disturbances: [{at: web.speed, kind: sine, amplitude: 3 m/min, frequency: 5 Hz}]
record: {every: 10 ms, channels: [web.position]}
)");
  const auto positions = run.column("web.position");
  ASSERT_EQ(positions.size(), 1201U);
  constexpr std::size_t period = 31;  // rows: 310 ms
  const double w = full_turn * 5;
  std::complex<double> sum = 0;
  int rows = 0;
  for (std::size_t i = 200; i < 200 + 900; ++i, ++rows) {  // 45 whole periods
    const double length = positions[i + period] - positions[i];
    sum += (length - 310) * std::polar(1.0, -w * static_cast<double>(i) * 0.01);
  }
  const std::complex<double> spring(2e5, w * 2800);
  const double gain = std::abs(spring / (spring - 20 * w * w));
  const double amplitude = 2 * 50 * gain / w * std::abs(std::sin(w * 0.31 / 2));
  EXPECT_NEAR(2 * std::abs(sum) / rows, amplitude, 0.005 * amplitude);
}

TEST(NoiseOnLineSpeed, MovesTheSetSpeedByItsRms) {
  const LineRun run(R"(
scene: {step: 1 ms, duration: 400 s, seed: 4}
plants: {web: {type: web, speed: 60 m/min, drive: {acceleration: 1000 m/s2, stiffness: 1 N/m, damping: 2000 N s/m}}}
disturbances: [{at: web.speed, kind: noise, amplitude: 2 m/min, band: 1..10 Hz, ramp: 1 s}]
record: {every: 10 ms, channels: [web.set_speed]}
)");
  const auto speeds = run.column("web.set_speed");
  double square = 0;
  for (const double speed : speeds)
    square += (speed - 60) * (speed - 60) / static_cast<double>(speeds.size());
  EXPECT_NEAR(std::sqrt(square), 2, 0.08);
}

TEST(LiveParameterOnALine, IsSetAndRampedByTheTimeline) {
  const LineRun run(R"(
scene: {step: 100 us, duration: 1 s}
plants: {axis: {type: vertical_press}}
timeline:
  - {at: 0.2 s, set: {axis.mass: 700 kg}}
  - {at: 0.4 s, ramp: {axis.mass: 800 kg}, over: 0.2 s}
record: {every: 100 ms, channels: [axis.mass]}
)");
  EXPECT_THAT(run.column("axis.mass"),
              testing::Pointwise(testing::DoubleNear(1e-6), {600.0, 600.0, 600.0, 700.0, 700.0, 749.95,
                                                             799.95, 800.0, 800.0, 800.0, 800.0}));
}

// The measuring wheel of 2500 lines and 500 mm gives 5 kHz of one phase at 60 m/min.
TEST(CardOfTheDefaultLine, ThatIsTooSlowLosesCountsAndSaysSo) {
  const LineRun run("rotary_knife.yaml",
                    {{"scene.duration", "3 s"}, {"filters", "{2.CNT02: {frequency: 4 kHz}}"}});
  EXPECT_TRUE(run.noted("2.CNT02 lost "));
  EXPECT_TRUE(run.noted("counts_lost"));
}

// A saw that runs faster than its wheel by e stretches the pipe behind the wheel by e x while it is clamped
// for the wheel's travel x, and pulls with EA / W as much, W from wheel to saw, whatever the wheel is pulled
// along.
TEST(PulledEncoder, TheSawPullsWithTheSpringBehindTheWheel) {
  struct Line {
    std::vector<scenario::Override> overrides;
    double wall;   // [m]
    double wheel;  // before the saw [m]
    double faster;
  };
  const double worn = 1 / 0.995 - 1;
  for (const Line& line :
       {Line{{}, 2e-3, 3, worn}, Line{{{"plants.pipe.thickness", "1 mm"}}, 1e-3, 3, worn},
        Line{{{"plants.pipe.wheel.distance", "1 m"}}, 2e-3, 1, worn},
        Line{{{"plants.pipe.wheel.circumference_error", "0 %"}, {"controller.lx3vp.set.DD100", "13200"}},
             2e-3,
             3,
             0}}) {
    const LineRun run("web_pulled_encoder.yaml", line.overrides);
    const auto clamped = run.column("saw.clamp.closed");
    const auto position = run.column("pipe.position");
    const auto stretch = run.column("pipe.wheel.stretch");
    const auto tension = run.column("pipe.tension");
    ASSERT_EQ(clamped.size(), tension.size());
    const double area = std::numbers::pi * line.wall * (0.03 - line.wall);
    const double spring = 3e9 * area / line.wheel / 1000;  // [N/mm]
    double began = 0;
    int passes = 0;
    for (std::size_t i = 1; i < clamped.size(); ++i) {
      const double wheel = position[i - 1] - stretch[i - 1];
      if (clamped[i] > clamped[i - 1]) began = wheel;
      if (clamped[i] >= clamped[i - 1] || ++passes < 7) continue;  // the line runs evenly then
      const double pull = spring * line.faster * (wheel - began);
      EXPECT_NEAR(tension[i - 1], pull, 0.08 * pull + 8) << line.wall << " " << line.wheel << " " << passes;
    }
    EXPECT_GE(passes, 10);
  }
}

TEST(TrimLine, ItsSecondStationHalvesTheSheetsFromAnotherPlace) {
  const LineRun run("trim_line.yaml", {{"plants.trimmer.place", "3600 mm"}});
  const auto rests = run.values("cut", "rest");
  ASSERT_GE(rests.size(), 8U);
  for (std::size_t i = 1; i < rests.size(); ++i) EXPECT_NEAR(rests[i], 400, 0.5) << i;
  EXPECT_EQ(run.values("scrap", "length").size(), 1U);  // the head of the web
}

// 002 §1.2.5.1: in mode 0 the input's hardware filter delays the acquisition, "and so influence the precision
// of the loading": a card that filters for 5 ms does what a switch that is 5 ms late does in the scene.
TEST(CardOfThePresetSearch, DelaysTheEnableInputByItsFilter) {
  const scenario::Override ideal_switch = {"plants.axis.home.delay", "0 ms"};
  EXPECT_FALSE(LineRun("preset_search.yaml", {ideal_switch}).outcome.passed());
  EXPECT_TRUE(LineRun("preset_search.yaml", {ideal_switch, {"filters", "{2.INP01: {delay: 5 ms}}"}})
                  .outcome.passed());
}

// "We must ensure that the time of zero impulse duration is sufficient to be acquired from the card": at 20
// mm/s the motor turns once a second, and of its 10 000 counts one lasts 100 us.
TEST(CardOfThePresetSearch, MissesAZeroPulseThatIsTooShort) {
  const auto with_least = [](const std::string& pulse, const std::string& width = "1") {
    return LineRun("preset_search.yaml", {{"filters", "{INT1: {pulse: " + pulse + "}}"},
                                          {"plants.axis.encoder.index_width", width}});
  };
  EXPECT_TRUE(with_least("60 us").outcome.passed());
  const auto missed = with_least("150 us");
  EXPECT_FALSE(missed.outcome.passed());
  EXPECT_TRUE(missed.noted("INT1 lost "));
  EXPECT_TRUE(with_least("150 us", "2").outcome.passed());
}

// What is learnt is right; what is left of a placement's miss are the delays of contactors and brake.
TEST(PressThatScatters, MissesByMoreTheMoreItsDelaysScatter) {
  const auto spread = [](const std::string& scatter) {
    const LineRun run("press_learning.yaml", {{"plants.press.contactors.scatter", scatter},
                                              {"plants.press.brake.scatter", scatter},
                                              {"controller.qmove.set.slPause", "500"}});
    const auto judge = run.column("gfJudge");
    const auto tour = run.column("gbTour");
    const auto miss = run.column("glMiss");
    std::vector<double> misses;
    for (std::size_t i = 1; i < judge.size(); ++i)
      if (judge[i] > judge[i - 1] && tour[i] > 1) misses.push_back(miss[i]);
    EXPECT_GE(misses.size(), 18U);
    double squares = 0;
    for (const double one : misses) squares += one * one;
    return std::sqrt(squares / static_cast<double>(misses.size())) / 100;  // [mm]
  };
  EXPECT_LT(spread("0 ms"), 0.1);
  const double some = spread("1 ms");
  EXPECT_GT(some, 0.13);
  EXPECT_GT(spread("2 ms"), 1.5 * some);
}

}  // namespace
}  // namespace drycut::sim
