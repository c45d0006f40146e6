// The limit cycle that `drycut bode --limit-cycle` predicts from frequency responses, against the simulated
// axis itself: 20 % below the gain every disturbance dies out, 20 % above one of them does not.
#include "sim/studies/bode/limit_cycle.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "sim/studies/bode/report.hpp"
#include "tests/sim/studies/bode/axis.hpp"

namespace drycut::sim::studies {
namespace {

using testing::HasSubstr;

constexpr int gain_in_force = 40;
constexpr double disturbances[] = {0.5, 1, 2, 4};  // counts lost at once, in gaps

/// A backlash axis under EPICPOS, counted on its load: 1 um a count.
struct Machine {
  const char* name;
  double gap;          ///< [mm]
  const char* more;    ///< further plant parameters
  double least, most;  ///< frequencies to look at [Hz]
};
void PrintTo(const Machine& machine, std::ostream* out) { *out << machine.name; }

const char* const configuration =
    "BUS\n1 1CPUB 02\n2 1MIXA 00\n\nINTDEVICE\nAxis EPICPOS 2 2.CNT01 X X.X 2.AN01\n\nEND\n";
const char* const program = R"(Axis:cntratio = 40000
Axis:decpt = 2
Axis:maxvel = 40000
Axis:maxpos = 100000
Axis:maxfollerr = 100000
Axis:taccdec = 100
Axis:toll = 3
INIT Axis
WAIT Axis:st_init
CNTUNLOCK Axis
CNTDIR Axis
REGON Axis
WAIT NOT Axis:st_regoff
LOOPON Axis
WAIT Axis:st_loopon
END
)";

struct BodeLimitCycle : testing::TestWithParam<Machine> {
  BodeLimitCycle() {
    folder.file("axis.cnf", configuration);
    folder.file("axis.mod", program);
  }
  [[nodiscard]] scenario::Scenario scenario(double gain, double lost, Problems& problems) const {
    const auto text = "scene: {step: 100 us, duration: 2 s}\nplants:\n  axis: {type: backlash_axis, gap: " +
                      std::to_string(GetParam().gap) + " mm" + GetParam().more +
                      "}\ncontroller:\n  qmove: {configuration: axis.cnf, tasks: [axis.mod], set: "
                      "{Axis.pgain: " +
                      std::to_string(std::lround(gain)) +
                      "}}\nwiring: {2.CNT01: axis.scale, 2.AN01: axis.servo.reference}\n"
                      "timeline: [{at: 300 ms, fault: {axis.scale: {lose_counts: " +
                      std::to_string(std::lround(lost)) +
                      "}}}]\nrecord: {every: 1 ms, channels: [axis.position]}\n";
    return scenario::read_scenario_text(text, folder.path / "axis.yaml", {}, problems);
  }
  /// True if the axis still swings at the end of the run.
  [[nodiscard]] bool hunts(double gain, double lost) const {
    Problems problems;
    const auto axis = scenario(gain, lost, problems);
    loop::Simulation simulation(axis, problems);
    EXPECT_TRUE(problems.empty()) << to_string(problems.front());
    EXPECT_EQ(simulation.run().failure, "");
    const auto& position = simulation.recording().column("axis.position")->values;
    const auto [low, high] = std::minmax_element(position.end() - 500, position.end());
    return *high - *low > GetParam().gap / 2;
  }

  bode_axis::Folder folder;
};

TEST_P(BodeLimitCycle, BeginsWhereTheFrequencyResponsePredictsIt) {
  Problems problems;
  const auto axis = scenario(gain_in_force, 0, problems);
  LoopRequest request;
  request.at = "200 ms";
  request.from = GetParam().least;
  request.to = GetParam().most;
  request.points = 14;
  request.settle = 0.3;
  const auto cycle = find_limit_cycle(axis, request, problems);
  ASSERT_TRUE(problems.empty()) << to_string(problems.front());
  ASSERT_TRUE(cycle && cycle->least);
  EXPECT_FALSE(cycle->at_end);
  const double predicted = gain_in_force * factor_of(*cycle->margins[*cycle->least].gain);
  const auto any = [&](double gain) {
    const double counts = GetParam().gap * 1000;
    return std::any_of(std::begin(disturbances), std::end(disturbances),
                       [&](double share) { return hunts(gain, share * counts + 100); });
  };
  EXPECT_FALSE(any(predicted * 0.8)) << predicted;
  EXPECT_TRUE(any(predicted * 1.2)) << predicted;
}

INSTANTIATE_TEST_SUITE_P(
    Machines, BodeLimitCycle,
    testing::Values(Machine{"worn_nut", 1, "", 8, 60}, Machine{"good_nut", 0.1, "", 12, 80},
                    Machine{"soft_servo_heavy_slide", 0.5,
                            ", mass: 300 kg, servo: {speed_gain: 100 rad/s, integral_time: 50 ms}", 5, 40},
                    Machine{"vertical", 0.3, ", mass: 60 kg, inclination: 90 deg", 15, 80}),
    [](const auto& machine) { return std::string(machine.param.name); });

TEST(BodeLimitCycleText, TellsWhereItBegins) {
  LimitCycle cycle;
  for (const auto& [amplitude, margin] :
       {std::pair{0.1, 20.0}, std::pair{0.2, 6.0206}, std::pair{0.4, 12.0412}}) {
    AmplitudeMargin entry;
    entry.loop.plan.amplitude = amplitude;
    entry.gain = {25, margin};
    cycle.margins.push_back(entry);
  }
  cycle.least = 1;
  EXPECT_DOUBLE_EQ(std::round(factor_of(*cycle.margins[1].gain) * 1e4), 20000);
  EXPECT_THAT(limit_cycle_text(cycle),
              HasSubstr("Limit cycle from 2 times the gain on: 25 Hz at about 0.2 V"));
  EXPECT_THAT(limit_cycle_text(cycle), testing::Not(HasSubstr("beyond it may be less")));
  cycle.at_end = true;
  EXPECT_THAT(limit_cycle_text(cycle), HasSubstr("at an end of the amplitudes: beyond it may be less."));
  cycle.least.reset();
  EXPECT_THAT(limit_cycle_text(cycle), HasSubstr("Limit cycle: no gain margin was found at any amplitude."));
}

}  // namespace
}  // namespace drycut::sim::studies
