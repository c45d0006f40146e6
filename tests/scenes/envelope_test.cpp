// The boundary that the acceleration of a knife sets (its torque, over the inertia of an ideal one), with a
// quintic cam behind the web. The cut's synchronous way is Ls = 120 mm; over the rest of the piece, in T = (L
// - Ls) / v, the blade makes good C - L with a peak acceleration of k |C - L| / T^2, k = 10 / sqrt(3). So the
// boundary is v^2 = a_max (L - Ls)^2 / (k |C - L|).
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include "sim/cli/sweep_command.hpp"
#include "tests/sim/command_bench.hpp"

namespace drycut::sim::cli {
namespace {

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const auto at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  if (at != std::string::npos) text.replace(at, what.size(), by);
  return text;
}

struct KnifeEnvelope : CommandTest {
  static std::string shipped(const std::string& name) {
    std::ifstream stream(source_root / "scenes" / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  TestFolder folder;
};

TEST_F(KnifeEnvelope, LiesWhereTheClosedFormSays) {
  // The program begins in the middle of the cam's turn; the table's master is a piece.
  folder.file("knife.st",
              replaced(shipped("programs/rotary_knife.st"), "VAR CONSTANT\n  SLOW", "VAR\n  SLOW"));
  folder.file("mc_rotary_knife.tab", replaced(shipped("cams/mc_rotary_knife.tab"), "master_modulo: 8000000",
                                              "master_modulo: ${length} / 0.0001 mm"));
  folder.file("knife.yaml", "extends: " + (source_root / "scenes/rotary_knife_mc_camin.yaml").string() + R"(
variables: {length: 800 mm, speed: 60 m/min, limit: 5000}
scene: {duration: 8 s}
controller:
  plcopen:
    program: knife.st
    axes:
      Web: {modulo: "${length}"}
      Knife: {dynamik: {vb_max: 100000 deg/s, a_max: 1e6 deg/s2}, following_error_max: 90 deg}
    tables: [mc_rotary_knife.tab]
    set: {WEB_AT_TOP: "(${length} / 2 + 60 mm) / 0.0001 mm"}
timeline:
  - {at: 100 ms, set: {panel.start: 1}}
  - {when: panel.in_sync == 1, after: 100 ms, ramp: {web.speed: "${speed}"}, over: 2 s}
drives: {judge: off}
checks:
  - {name: acceleration, always: "abs(Knife.set_acceleration) <= ${limit}", from: 5 s}
  - {name: runs, always: "Knife.coupling_phase == 5 && error_id == 0", from: 5 s}
)");
  EnvelopeOptions options;
  options.scenario = folder / "knife.yaml";
  options.out = folder / "out";
  options.over = {"variables.length=500,800 mm"};
  options.find_max = "variables.speed=60..160 m/min:0.5";
  options.jobs = 2;
  ASSERT_EQ(captured([&] { return envelope_scenario(options); }), all_passed) << err;

  const double a_max = 5000 / 360.0 * 0.6;  // of the blade [m/s2], by the limit in deg/s2 of the drum
  const double k = 10 / std::numbers::sqrt3;
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
    const double expected = 60 * (length - 0.12) * std::sqrt(a_max / (k * std::abs(0.6 - length)));
    EXPECT_NEAR(speed, expected, 0.01 * expected) << line;
    EXPECT_THAT(line, testing::HasSubstr(",found,acceleration,"));
    ++count;
  }
  EXPECT_EQ(count, 2);
}

}  // namespace
}  // namespace drycut::sim::cli
