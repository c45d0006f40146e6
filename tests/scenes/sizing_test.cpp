// drycut size beside closed forms: an ideal knife, no friction, no cut, under a quintic cam in closed loop.
// With a synchronous way Ls and T = (L - Ls) / v the blade makes good C - L with the integral of a^2 = 120/7
// (C - L)^2 / T^3, once a piece. The motor turns its rotor Jm and, behind the gear i, the drum J: rms torque
// = (Jm i + J / i) times the drum's rms acceleration, least where i^2 = J / Jm.
#include <cmath>
#include <fstream>
#include <numbers>

#include "sim/cli/size_command.hpp"
#include "sim/studies/recorded_csv.hpp"
#include "tests/sim/command_bench.hpp"

namespace drycut::sim::cli {
namespace {

struct KnifeSizing : CommandTest {
  TestFolder folder;
};

TEST_F(KnifeSizing, TheLeastTorqueIsWhereTheInertiasMatch) {
  folder.file("knife.yaml", "extends: " + (source_root / "scenes/rotary_knife_mc_camin.yaml").string() + R"(
scene: {duration: 10 s}
plants:
  web: {shear_strength: 0 MPa}
  knife:
    encoder: {on_drum: true, lines: 10240}
    coupling: 0 N s/m
    grip: 0 N
    motor_friction: {coulomb: 0 N m, viscous: 0 N m s/rad}
    drum_friction: {coulomb: 0 N m, viscous: 0 N m s/rad}
timeline: # at 60 m/min the wheel gives whole counts a cycle: no counting noise beside the closed form
  - {at: 100 ms, set: {panel.start: 1}}
  - {when: panel.in_sync == 1, after: 100 ms, ramp: {web.speed: 60 m/min}, over: 2 s}
checks:
  - {name: no error, always: panel.fault == 0 && error_id == 0}
)");
  SizeOptions options;
  options.scenario = folder / "knife.yaml";
  options.out = folder / "out";
  options.motors = "HG-SR202";
  const double step = 0.25;
  options.gears = "8..11:13";
  options.jobs = 2;
  ASSERT_EQ(captured([&] { return size_drive(options); }), all_passed) << err;

  constexpr double drum = 0.41;
  constexpr double rotor = 46.8e-4;
  constexpr double rated = 9.5;
  const double length = 0.8;
  const double speed = 1;
  const double time = (length - 0.12) / speed;
  const double blade = std::sqrt(120.0 / 7 * std::pow(0.6 - length, 2) / std::pow(time, 3) * speed / length);
  const double turning = blade / (0.6 / (2 * std::numbers::pi));

  std::ifstream stream(options.out / "size.csv", std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  Problems problems;
  cams::TableProblems broken("size.csv", problems);
  studies::CsvRows rows(text, broken);
  studies::CsvRow heading;
  studies::CsvRow row;
  ASSERT_TRUE(rows.next(heading));
  const auto column = [&](const std::string& name) {
    for (std::size_t i = 0; i < heading.cells.size(); ++i)
      if (heading.cells[i].text == name) return i;
    ADD_FAILURE() << name;
    return std::size_t{0};
  };
  const auto number = [&](const std::string& name) {
    return studies::number_of(row.cells.at(column(name)).text).value_or(NAN);
  };
  double least = INFINITY;
  double best = 0;
  int count = 0;
  while (rows.next(row)) {
    EXPECT_EQ(row.cells.at(column("verdict")).text, "fits") << row.cells.at(column("reason")).text;
    const double gear = number("gear ratio");
    const double torque = number("rms torque [% of its rating]") / 100 * rated;
    const double expected = (rotor * gear + drum / gear) * turning;
    EXPECT_NEAR(torque, expected, 0.005 * expected) << gear;
    EXPECT_NEAR(number("inertia ratio"), drum / (gear * gear) / rotor, 1e-5) << gear;
    if (torque < least) {
      least = torque;
      best = gear;
    }
    ++count;
  }
  EXPECT_EQ(count, 13);
  EXPECT_NEAR(best, std::sqrt(drum / rotor), step);  // 9.36
  EXPECT_NEAR(least, 2 * std::sqrt(drum * rotor) * turning, 0.005 * least);
}

}  // namespace
}  // namespace drycut::sim::cli
