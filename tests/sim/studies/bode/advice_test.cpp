// Which filter the torque of a servo wants: measured loops against closed forms, advice against a grid.
#include "sim/studies/bode/advice.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "sim/cli/bode_command.hpp"
#include "tests/sim/command_bench.hpp"
#include "tests/sim/studies/bode/axis.hpp"

namespace drycut::sim::studies {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;

constexpr double turn = 2 * std::numbers::pi;

/// The open speed loop of two masses on a spring under a PI controller and a current lag, in continuous time.
SpeedLoop two_masses(double gain) {
  SpeedLoop loop;
  loop.drive = "axis.servo";
  loop.step = 1e-4;
  loop.speed_gain = gain;
  const double motor = 5e-3;
  const double load = 2e-2;
  const double stiffness = 3000;
  const double damping = 1.5;
  for (int i = 0; i < 160; ++i) {
    const double f = 2 * std::pow(1000.0, i / 159.0);
    const std::complex<double> s(0, turn * f);
    const auto spring = stiffness + damping * s;
    // Of the motor's speed for a torque on it.
    const auto plant = (load * s * s + spring) / (s * (motor * load * s * s + (motor + load) * spring));
    const auto pi = (motor + load) * gain * (1.0 + 1.0 / (0.02 * s));
    BodePoint point;
    point.frequency = f;
    point.open_loop = pi * plant / (1.0 + 0.5e-3 * s) * std::exp(-1.5e-4 * s);
    loop.points.push_back(point);
  }
  return loop;
}

/// A loop that no gain upsets.
SpeedLoop integrator() {
  auto loop = two_masses(150);
  for (auto& point : loop.points) point.open_loop = 150.0 / std::complex<double>(0, turn * point.frequency);
  return loop;
}

TEST(FilterAdvice, IsWithinTwoPercentOfTheBestOfAFineGrid) {
  const auto loop = two_masses(150);
  const auto advice = advise(loop);
  ASSERT_EQ(advice.choices.size(), 3U);
  // What may be advised: 10 deg of phase are not too much, no gain margin is lost.
  const auto allowed = [&](const plants::TorqueFilterData& filters) {
    const auto choice = judged_with(loop, filters);
    const auto& present = advice.present.margins;
    return choice.margins.phase->value >= present.phase->value - most_cost &&
                   choice.margins.gain->value >= present.gain->value
               ? choice.factor
               : 0;
  };
  for (const auto& choice : advice.choices) {
    const auto& [low_pass, notches] = choice.filters;
    double best = 0;
    if (low_pass > 0) {
      for (int i = 0; i <= 400; ++i) best = std::max(best, allowed({1e-4 * std::pow(200, i / 400.0), {}}));
    } else if (notches[1].frequency == 0) {
      for (int i = 0; i <= 60; ++i)
        for (int j = 0; j <= 5; ++j)
          for (int k = 0; k <= 5; ++k) {
            const plants::NotchData notch = {10 * std::pow(200, i / 60.0),
                                             0.03 * std::pow(0.7 / 0.03, j / 5.0),
                                             0.2 * std::pow(5, k / 5.0)};
            best = std::max(best, allowed({0, {notch, {}}}));
          }
    } else {
      continue;  // what a second one adds to the first
    }
    EXPECT_GT(choice.factor, 0.98 * best);
  }
  EXPECT_TRUE(advice.worth());
}

// The gain that it names keeps what it says, and a little more does not.
TEST(FilterAdvice, TheLargestGainKeepsTheSensitivityAndNoMoreDoes) {
  const auto advice = advise(two_masses(150));
  const auto& best = advice.choices.front();
  const auto at = [&](double factor) {
    return judged_with(two_masses(150 * best.factor * factor), best.filters);
  };
  EXPECT_NEAR(at(1).factor, 1, 1e-3);
  const auto kept = at(0.999).margins;
  EXPECT_LE(kept.sensitivity->value, kept_sensitivity + 1e-3);
  EXPECT_GE(kept.gain->value, 6);
  EXPECT_GE(kept.phase->value, 28.9);
  EXPECT_LT(at(1.02).factor, 1);
}

// Two integrators, and a lead between two frequencies: stable there only. A filter that is fine with more
// gain but not with the gain in force is none.
TEST(FilterAdvice, ALoopThatGoesRoundIsNotKept) {
  auto loop = two_masses(150);
  for (auto& point : loop.points) {
    const std::complex<double> s(0, turn * point.frequency);
    point.open_loop = 8e3 / (s * s) * (1.0 + s / 40.0) / (1.0 + s / 2000.0);
  }
  const auto present = judged_with(loop, {});
  EXPECT_GT(present.factor, 1);
  // A notch that takes the crossover's gain away leaves two integrators.
  const auto with = judged_with(loop, {0, {{{.frequency = 30, .depth = 0.03, .width = 1}, {}}}});
  EXPECT_LT(with.factor, 1);
  const auto advice = advise(loop);
  for (const auto& choice : advice.choices) {
    const auto& margins = judged_with(loop, choice.filters).margins;
    EXPECT_TRUE(choice.factor < 1 || margins.sensitivity->value <= kept_sensitivity);
  }
}

// A loop that no gain upsets, as far as it is known, wants no filter.
TEST(FilterAdvice, NothingIsWorthALoopWithoutResonance) { EXPECT_FALSE(advise(integrator()).worth()); }

// At one frequency L is so near to 30 deg from -1 that only 6 % of gains are too much: none is stepped over.
TEST(FilterAdvice, ANarrowStretchOfGainsIsNotSteppedOver) {
  const auto with_one_at = [](double size) {
    auto loop = integrator();
    loop.points[80].open_loop = std::polar(size, -150.05 * turn / 360);
    return loop;
  };
  for (const double size : {0.3, 0.38, 0.46, 0.87}) {
    const auto loop = with_one_at(size);
    const double factor = judged_with(loop, {}).factor;
    const auto distance = [&](double times) {
      return std::abs(1.0 + times * factor * loop.points[80].open_loop);
    };
    EXPECT_NEAR(distance(1), 0.5, 1e-6) << size;
    EXPECT_LT(distance(1.03), 0.5) << size;  // it is where they begin
    EXPECT_GT(distance(0.97), 0.5) << size;
  }
  // Those that are too much lie below the gain in force.
  EXPECT_GT(judged_with(with_one_at(1), {}).factor, 29);
}

// Where points were lost nothing is made up, however the others scatter.
TEST(FilterAdvice, NothingIsMadeUpAcrossLostPoints) {
  for (const std::size_t last : {52, 53}) {
    for (const double scatter : {-0.15, 0.15}) {
      auto loop = integrator();
      for (std::size_t i = 0; i < loop.points.size(); ++i)
        loop.points[i].open_loop *= std::polar(1.0, i % 2 == 0 ? scatter : -scatter);
      loop.points.erase(loop.points.begin() + 12, loop.points.begin() + static_cast<std::ptrdiff_t>(last));
      const auto present = advise(loop).present;
      EXPECT_NEAR(present.factor, judged_with(loop, {}).factor, 1e-9);
      EXPECT_FALSE(present.margins.gain || present.margins.gain_down);
    }
  }
}

struct SpeedLoopOfAnAxis : CommandTest {
  SpeedLoopOfAnAxis() {
    folder.file("axis.mod", bode_axis::Folder::program(""));
    folder.file("axis.yaml", bode_axis::Folder::screw());
    options.scenario = folder.path / "axis.yaml";
    options.advise = true;
    for (const auto* rubs : {"motor_friction.coulomb=0 N m", "motor_friction.viscous=0 N m s/rad",
                             "carriage_friction.coulomb=0 N", "carriage_friction.viscous=0 N s/m"})
      options.set.push_back(std::string("plants.axis.") + rubs);
  }
  SpeedLoop measured() {
    Problems problems;
    std::vector<scenario::Override> overrides;
    for (const auto& one : options.set) {
      const auto equals = one.find('=');
      overrides.push_back({one.substr(0, equals), one.substr(equals + 1)});
    }
    const auto scenario = scenario::read_scenario(options.scenario, overrides, problems);
    auto loop = measure_speed_loop(scenario, options.loop, problems);
    EXPECT_TRUE(problems.empty()) << to_string(problems.front());
    return *loop;
  }
  int run() {
    return captured([&] { return cli::measure_bode(options); });
  }
  bode_axis::Folder folder;
  cli::BodeOptions options;
};

// A carriage of a gram: the loop is that of the rotor in steps, to the last digit. Speed of the step before,
// PI, filters, lag, inertia.
TEST_F(SpeedLoopOfAnAxis, IsThatOfTheStepsInClosedForm) {
  for (const auto* set :
       {"mass=0.001 kg", "gear.stiffness=0.1 N m/rad", "gear.damping=0 N m s/rad", "stop.stiffness=1 N/m",
        "stop.damping=0 N s/m", "servo.torque_filter=0.3 ms", "servo.notch1.frequency=400 Hz"})
    options.set.push_back(std::string("plants.axis.") + set);
  const auto loop = measured();
  ASSERT_GT(loop.points.size(), 150U);
  constexpr double h = 1e-4;
  const double inertia = 46.8e-4 + 3e-4;
  const double gain = 1.1 * 46.8e-4 * 250;
  const double share = -std::expm1(-h / 0.5e-3);
  for (const auto& point : loop.points) {
    if (point.frequency < 10) continue;  // the spring of the gram
    const auto back = std::polar(1.0, -turn * point.frequency * h);
    const auto pi = gain * (1.0 + h / 20e-3 * back / (1.0 - back));
    const auto lag = share / (1.0 - (1 - share) * back);
    const auto expected =
        pi * plants::response(loop.filters, point.frequency, h) * lag * h / inertia / (1.0 - back) * back;
    EXPECT_LT(std::abs(point.open_loop / expected - 1.0), 2e-3) << point.frequency;
  }
}

// What it says of a filter is what is measured with the filter: 0.1 dB and 0.5 deg.
TEST_F(SpeedLoopOfAnAxis, WithTheAdvisedFilterIsAsPredicted) {
  for (const auto* set : {"gear.stiffness=150 N m/rad", "gear.damping=0.1 N m s/rad", "mass=40 kg",
                          "servo.inertia_ratio=1.2", "servo.speed_gain=1200 rad/s"})
    options.set.push_back(std::string("plants.axis.") + set);
  const auto advice = advise(measured());
  ASSERT_TRUE(advice.worth());
  const auto& best = advice.choices.front();
  const auto& [low_pass, notches] = best.filters;
  options.set.push_back(fmt::format("plants.axis.servo.torque_filter={} s", low_pass));
  for (std::size_t i = 0; i < 2; ++i) {
    if (notches[i].frequency == 0) continue;
    const auto path = fmt::format("plants.axis.servo.notch{}.", i + 1);
    options.set.push_back(fmt::format("{}frequency={} Hz", path, notches[i].frequency));
    options.set.push_back(fmt::format("{}depth={}", path, notches[i].depth));
    options.set.push_back(fmt::format("{}width={}", path, notches[i].width));
  }
  const auto after = judged_with(measured(), best.filters);
  EXPECT_NEAR(after.factor, best.factor, 0.02 * best.factor);
  ASSERT_EQ(after.margins.gain.has_value(), best.margins.gain.has_value());
  if (best.margins.gain) {
    EXPECT_NEAR(after.margins.gain->value, best.margins.gain->value, 0.1);
  }
  ASSERT_TRUE(after.margins.phase && best.margins.phase);
  EXPECT_NEAR(after.margins.phase->value, best.margins.phase->value, 0.5);
}

TEST_F(SpeedLoopOfAnAxis, IsToldWithItsFilterToPaste) {
  for (const auto* set : {"gear.stiffness=150 N m/rad", "gear.damping=0.1 N m s/rad", "mass=40 kg",
                          "servo.inertia_ratio=1.2", "servo.speed_gain=1200 rad/s"})
    options.set.push_back(std::string("plants.axis.") + set);
  options.out = folder.path / "results";
  EXPECT_EQ(run(), cli::all_passed) << out << err;
  EXPECT_THAT(out, ContainsRegex("no filter \\(present\\)"));
  EXPECT_THAT(out, ContainsRegex("axis.servo: .*: speed_gain up to|axis.servo: .*speed_gain up to [0-9.]+"));
  EXPECT_THAT(content(options.out / "report.html"), HasSubstr("To paste"));
  EXPECT_THAT(content(options.out / "plots/speed_loop.png"), testing::StartsWith("\x89PNG"));
}

TEST_F(SpeedLoopOfAnAxis, WhatDoesNotGoWithItIsTold) {
  options.limit_cycle = true;
  options.min_gain_margin = 6;
  options.loop.speed = "axis.motor.speed";
  options.loop.amplitude = 0.1;  // as without it, and still it is not what --advise adds
  options.loop.settle = 0.5;
  EXPECT_EQ(run(), cli::bad_input);
  for (const auto* option : {"--limit-cycle", "--min-gain-margin", "--speed", "--amplitude", "--settle"})
    EXPECT_THAT(err, ContainsRegex(fmt::format("(^|\n){}:1:1: .*; .* \\[option.together\\]\n", option)));
  EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 5) << err;
}

// Its range is that of the steps, its points are as many as a resonance needs.
TEST_F(SpeedLoopOfAnAxis, ARangeThatCannotBeMeasuredIsTold) {
  options.loop.from = 6000;
  options.loop.to = 5001;
  options.loop.points = 359;
  EXPECT_EQ(run(), cli::bad_input);
  for (const auto* option : {"--from", "--to", "--points"})
    EXPECT_THAT(err, ContainsRegex(fmt::format("(^|\n){}:1:1: .*; .* \\[option.out-of-range\\]\n", option)));
  EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 3) << err;
}

TEST_F(SpeedLoopOfAnAxis, IsMeasuredAtAsManyPointsAsAreAskedFor) {
  options.loop.from = 200;
  options.loop.to = 1000;
  const auto usual = measured().points;
  EXPECT_EQ(usual.size(), 360);
  options.loop.points = 400;
  const auto more = measured().points;
  EXPECT_EQ(more.size(), 400);
  EXPECT_NEAR(more.front().frequency, 200, 0.1);
  EXPECT_NEAR(more.back().frequency, 1000, 0.1);
}

TEST_F(SpeedLoopOfAnAxis, AMachineWithoutAServoHasNone) {
  folder.file("axis.yaml", bode_axis::Folder::scenario(""));
  options.set.clear();
  EXPECT_EQ(run(), cli::bad_input);
  EXPECT_THAT(err, HasSubstr("[bode.no-loop]"));
}

}  // namespace
}  // namespace drycut::sim::studies
