// drycut size beside closed forms: an ideal knife, no friction, no cut, under a quintic cam in closed loop.
// With a synchronous way Ls and T = (L - Ls) / v the blade makes good C - L with the integral of a^2 = 120/7
// (C - L)^2 / T^3, once a piece. The motor turns its rotor Jm and, behind the gear i, the drum J: rms torque
// = (Jm i + J / i) times the drum's rms acceleration, least where i^2 = J / Jm.
#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "sim/cli/size_command.hpp"
#include "sim/studies/recorded_csv.hpp"
#include "tests/sim/command_bench.hpp"

namespace drycut::sim::cli {
namespace {

constexpr double drum = 0.41;
constexpr double rotor = 46.8e-4;
constexpr double rated = 9.5;

struct KnifeSizing : CommandTest {
  TestFolder folder;
  SizeOptions options;
  studies::CsvRow heading;
  std::vector<studies::CsvRow> rows;

  KnifeSizing() {
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
    options.scenario = folder / "knife.yaml";
    options.out = folder / "out";
    options.motors = "HG-SR202";
    options.jobs = 2;
  }

  /// Rms of the drum's acceleration [rad/s2].
  static double turning() {
    const double length = 0.8;
    const double speed = 1;
    const double time = (length - 0.12) / speed;
    return std::sqrt(120.0 / 7 * std::pow(0.6 - length, 2) / std::pow(time, 3) * speed / length) /
           (0.6 / (2 * std::numbers::pi));
  }

  void size(const std::string& gears) {
    options.gears = gears;
    ASSERT_EQ(captured([&] { return size_drive(options); }), all_passed) << err;
    std::ifstream stream(options.out / "size.csv", std::ios::binary);
    const std::string text(std::istreambuf_iterator<char>(stream), {});
    Problems problems;
    cams::TableProblems broken("size.csv", problems);
    studies::CsvRows lines(text, broken);
    ASSERT_TRUE(lines.next(heading));
    for (studies::CsvRow row; lines.next(row);) {
      EXPECT_EQ(cell(row, "verdict"), "fits") << cell(row, "reason");
      rows.push_back(row);
    }
  }
  std::string cell(const studies::CsvRow& row, const std::string& name) const {
    for (std::size_t i = 0; i < heading.cells.size(); ++i)
      if (heading.cells[i].text == name) return std::string(row.cells.at(i).text);
    ADD_FAILURE() << name;
    return "";
  }
  double number(const studies::CsvRow& row, const std::string& name) const {
    return studies::number_of(cell(row, name)).value_or(NAN);
  }
  double torque(const studies::CsvRow& row) const {
    return number(row, "rms torque [% of its rating]") / 100 * rated;
  }
};

TEST_F(KnifeSizing, TheLeastTorqueIsWhereTheInertiasMatch) {
  const double step = 0.25;
  size("8..11:13");
  double least = INFINITY;
  double best = 0;
  for (const auto& row : rows) {
    const double gear = number(row, "gear ratio");
    const double expected = (rotor * gear + drum / gear) * turning();
    EXPECT_NEAR(torque(row), expected, 0.005 * expected) << gear;
    EXPECT_NEAR(number(row, "inertia ratio"), drum / (gear * gear) / rotor, 1e-5) << gear;
    if (torque(row) >= least) continue;
    least = torque(row);
    best = gear;
  }
  EXPECT_EQ(rows.size(), 13U);
  EXPECT_NEAR(best, std::sqrt(drum / rotor), step);  // 9.36
  EXPECT_NEAR(least, 2 * std::sqrt(drum * rotor) * turning(), 0.005 * least);
}

// The drum's part of the torque is over the efficiency while the motor speeds it up and times 2 -
// 1/efficiency while it brakes, as long each, for the cam is the same forwards and backwards.
TEST_F(KnifeSizing, TheKindOfAGearTakesItsEfficiencyAlong) {
  size("7 coupling, 8 planetary, 9 worm, 10 planetary_2");
  ASSERT_EQ(rows.size(), 4U);
  const std::map<std::string, double> efficiencies = {
      {"coupling", 1}, {"planetary", 0.97}, {"worm", 0.75}, {"planetary_2", 0.94}};
  const std::map<std::string, double> ratios = {
      {"coupling", 7}, {"planetary", 8}, {"worm", 9}, {"planetary_2", 10}};
  for (const auto& row : rows) {
    const double gear = number(row, "gear ratio");
    const auto values = cell(row, "other values of the gear");
    const auto kind = values.substr(0, values.find(';'));
    ASSERT_TRUE(efficiencies.contains(kind)) << values;
    const double efficiency = efficiencies.at(kind);
    const double speeding = rotor * gear + drum / gear / efficiency;
    const double braking = rotor * gear + drum / gear * (2 - 1 / efficiency);
    const double expected = std::sqrt((speeding * speeding + braking * braking) / 2) * turning();
    EXPECT_NEAR(torque(row), expected, 0.01 * expected) << kind;
    EXPECT_EQ(gear, ratios.at(kind));
  }
}

}  // namespace
}  // namespace drycut::sim::cli
