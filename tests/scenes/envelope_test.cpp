// The boundary that the torque of an ideal knife's motor sets, with a quintic cam behind the web. The cut's
// synchronous way is Ls = 120 mm; over the rest of the piece, in T = (L - Ls) / v, the blade makes good C - L
// with a peak acceleration of k |C - L| / T^2, k = 10 / sqrt(3). So the boundary is v^2 = a_max (L - Ls)^2 /
// (k |C - L|), a_max = torque / inertia at the motor * radius of the blades.
//
// What the shipped knife needs beyond that, at 500 mm and 86 m/min, where inertia times acceleration is 9.07
// N m and its peak 10.15 N m (of frictions and cuts freed): 7 % are counts of its wheel, 0.0125 mm, which the
// controller's 1 ms turns into steps of 0.9 % of the speed, and the speed loop answers with torque; 1.6 % the
// steps of 1 ms themselves; 2 % the position loop (kv 60/s), which adds to a feed-forward that comes 3 ms
// late. So the ideal one has a fine wheel, a quick controller and a quick drive, no friction, no cut, a stiff
// gear.
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include "sim/cli/sweep_command.hpp"
#include "sim/loop/simulation.hpp"
#include "tests/sim/command_bench.hpp"

namespace drycut::sim::cli {
namespace {

using KnifeEnvelope = CommandTest;

/// [m/min] of pieces of this length [m], where the torque is all that bounds it.
double closed_form(double length) {
  constexpr double ratio = 5;
  constexpr double rotor = 0.00468;  // [kg m2]
  constexpr double drum = 0.41;
  constexpr double circumference = 0.6;                                   // [m]
  const double drum_acceleration = 9.2 / (rotor * ratio + drum / ratio);  // [rad/s2]
  const double a_max = drum_acceleration * circumference / (2 * std::numbers::pi);
  const double k = 10 / std::numbers::sqrt3;
  return 60 * (length - 0.12) * std::sqrt(a_max / (k * std::abs(circumference - length)));
}

TEST_F(KnifeEnvelope, LiesWhereTheClosedFormOfTheTorqueSays) {
  const TestFolder folder;
  folder.file("knife.yaml",
              "extends: " + (source_root / "scenes/envelope/rotary_knife_mc_camin.yaml").string() + R"(
variables: {torque: 9.2 N m}
scene: {duration: 5 s}
plants:
  web: {wheel: {lines: 1000000}}
  knife:
    grip: 0 N
    encoder: {lines: 500000}
    motor_friction: {coulomb: 0 N m, viscous: 0 N m s/rad}
    drum_friction: {coulomb: 0 N m, viscous: 0 N m s/rad}
    gear: {stiffness: 5e5 N m/rad, damping: 50 N m s/rad}
    servo: {adc_bits: 24, speed_gain: 500 rad/s, filter: 0.3 ms, current_lag: 0.2 ms}
controller:
  plcopen:
    cycle: 100 us
    axes:
      Web: {path: [500 mm, 4000000]}
      Knife:
        path: [360 deg, 10000000]
        dynamik: {vb_max: 100000 deg/s, a_max: 1e6 deg/s2}
        kv: 200 1/s
        following_error_max: 90 deg
record: {every: 500 us, channels: [web.speed]}
drives: {judge: off}
checks:
  - {name: torque, always: "abs(knife.motor.torque) <= ${torque}", from: 4.1 s}
  - {name: runs, always: "Knife.coupling_phase == 5 && error_id == 0", from: 4.1 s}
)");
  EnvelopeOptions options;
  options.scenarios = {folder / "knife.yaml"};
  options.out = folder / "out";
  options.over = {"variables.length=500,800 mm"};
  options.find_max = {"variables.speed=80..120 m/min:0.3"};
  options.jobs = 2;
  ASSERT_EQ(captured([&] { return envelope_scenario(options); }), all_passed) << err;

  std::istringstream rows([&] {
    std::ifstream stream(folder / "out/envelope.csv");
    return std::string(std::istreambuf_iterator<char>(stream), {});
  }());
  std::string line;
  std::getline(rows, line);
  int count = 0;
  while (std::getline(rows, line)) {
    double length = 0;
    double speed = 0;
    ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,", &length, &speed), 2) << line;
    length /= 1000;
    const double expected = closed_form(length);
    EXPECT_NEAR(speed, expected, 0.01 * expected) << line;
    EXPECT_THAT(line, testing::HasSubstr(",found,torque,,80,"));
    ++count;
  }
  EXPECT_EQ(count, 2);

  // The other way round, the shortest piece at a speed: the same boundary. Below the circumference a shorter
  // piece takes more torque.
  options.over = {"variables.speed=90 m/min"};
  options.find_max.clear();
  options.find_min = {"variables.length=470..560 mm:0.4"};
  ASSERT_EQ(captured([&] { return envelope_scenario(options); }), all_passed) << err;
  std::ifstream stream(folder / "out/envelope.csv");
  std::getline(stream, line);
  std::getline(stream, line);
  double length = 0;
  ASSERT_EQ(std::sscanf(line.c_str(), "90,%lf,found,torque,,560,", &length), 1) << line;
  EXPECT_NEAR(closed_form(length / 1000), 90, 0.013 * 90) << line;
}

// What drycut envelope is shown with in the README: each is a scene of its own, for any length.
TEST(EnvelopeScenes, PassWithPiecesOfTwoLengths) {
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(source_root / "scenes/envelope")) {
    if (entry.path().extension() != ".yaml") continue;
    for (const auto* length : {"700 mm", "1200 mm"}) {
      Problems problems;
      const auto scenario = scenario::read_scenario(entry.path(), {{"variables.length", length}}, problems);
      ASSERT_TRUE(problems.empty()) << to_string(problems[0]);
      loop::Simulation simulation(scenario, problems);
      ASSERT_TRUE(problems.empty()) << to_string(problems[0]);
      const auto outcome = simulation.run();
      EXPECT_EQ(outcome.failure, "");
      for (const auto& check : outcome.checks)
        EXPECT_TRUE(check.passed) << entry.path().stem() << ", " << length << ": " << check.name << ": "
                                  << check.detail;
    }
    ++scenes;
  }
  EXPECT_EQ(scenes, 5);
}

}  // namespace
}  // namespace drycut::sim::cli
