// The limit cycle that `drycut bode --limit-cycle` finds, against the simulated axis itself. By pushes: 10 %
// below the gain every disturbance dies out, 10 % above one of them does not. By frequency responses, 20 %.
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
  int maxvel = 40000;  ///< at 10 V [mm/min]
};
void PrintTo(const Machine& machine, std::ostream* out) { *out << machine.name; }

const char* const configuration =
    "BUS\n1 1CPUB 02\n2 1MIXA 00\n\nINTDEVICE\nAxis EPICPOS 2 2.CNT01 X X.X 2.AN01\n\nEND\n";
const char* const program = R"(Axis:cntratio = 40000
Axis:decpt = 2
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
    const auto text =
        "scene: {step: 100 us, duration: 2 s}\nplants:\n  axis: {type: backlash_axis, gap: " +
        std::to_string(GetParam().gap) + " mm" + GetParam().more +
        "}\ncontroller:\n  qmove: {configuration: axis.cnf, tasks: [axis.mod], set: "
        "{Axis.pgain: " +
        std::to_string(std::lround(gain)) + ", Axis.maxvel: " + std::to_string(GetParam().maxvel) +
        "}}\nwiring: {2.CNT01: axis.scale, 2.AN01: axis.servo.reference}\n"
        "timeline: [{at: 300 ms, fault: {axis.scale: {lose_counts: " +
        std::to_string(std::lround(lost)) + "}}}]\nrecord: {every: 1 ms, channels: [axis.position]}\n";
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

  /// The same behind one of the disturbances.
  [[nodiscard]] bool any(double gain) const {
    const double counts = GetParam().gap * 1000;
    return std::any_of(std::begin(disturbances), std::end(disturbances),
                       [&](double share) { return hunts(gain, share * counts + 100); });
  }

  bode_axis::Folder folder;
};
using BodePushes = BodeLimitCycle;

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
  ASSERT_TRUE(cycle && cycle->least && cycle->hunting && cycle->hunting->from);
  EXPECT_FALSE(cycle->at_end);
  const double predicted = gain_in_force * factor_of(*cycle->margins[*cycle->least].gain);
  EXPECT_FALSE(any(predicted * 0.8)) << predicted;
  EXPECT_TRUE(any(predicted * 1.2)) << predicted;
}

TEST_P(BodePushes, FindTheGainFromWhichOnADisturbanceNeverDiesOut) {
  for (const int in_force : {gain_in_force / 2, gain_in_force}) {
    Problems problems;
    const auto axis = scenario(in_force, 0, problems);
    LoopRequest request;
    request.at = "200 ms";
    const auto hunting = push_loop(axis, request, 0, problems);
    ASSERT_TRUE(problems.empty()) << to_string(problems.front());
    ASSERT_TRUE(hunting && hunting->from) << hunting->failure;
    const double found = in_force * *hunting->from;
    EXPECT_FALSE(any(found * 0.9)) << found;
    EXPECT_TRUE(any(found * 1.1)) << found;
  }
}

std::string name_of_machine(const testing::TestParamInfo<Machine>& machine) { return machine.param.name; }

const Machine machines[] = {{"worn_nut", 1, "", 8, 60},
                            {"good_nut", 0.1, "", 12, 80},
                            {"soft_servo_heavy_slide", 0.5,
                             ", mass: 300 kg, servo: {speed_gain: 100 rad/s, integral_time: 50 ms}", 5, 40},
                            {"vertical", 0.3, ", mass: 60 kg, inclination: 90 deg", 15, 80}};
INSTANTIATE_TEST_SUITE_P(Machines, BodeLimitCycle, testing::ValuesIn(machines), name_of_machine);

// A gantry, whose sines say 20 and 60 % too much: below 0.17 V they do not move the load, and it hunts with
// 0.18 V.
const char* const gantry =
    ", mass: 350 kg, encoder: {lines: 5000}, servo: {model: HG-SR352, speed_at_10v: 3000 rpm, "
    "inertia_ratio: 1}";
const char* const heavy_gantry =
    ", mass: 420.8 kg, encoder: {lines: 5000}, servo: {model: HG-SR352, speed_at_10v: "
    "3000 rpm, inertia_ratio: 1}";
INSTANTIATE_TEST_SUITE_P(Machines, BodePushes,
                         testing::Values(machines[0], machines[1], machines[2], machines[3],
                                         Machine{"gantry", 0.4, gantry, 8, 60, 60000},
                                         Machine{"heavy_gantry", 0.5225, heavy_gantry, 8, 60, 60000}),
                         name_of_machine);

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
  const auto told = [&] { return limit_cycle_text(cycle); };
  EXPECT_THAT(told(),
              HasSubstr("Limit cycle. By sines: at most 2 times, 25 Hz at about 0.2 V; a smaller disturbance "
                        "may die out."));
  cycle.at_end = true;
  EXPECT_THAT(told(), HasSubstr("this lies at an end of the amplitudes: beyond it may be less."));
  // Unknown amplitudes are unknown: the bound may lie there.
  cycle.at_end = false;
  cycle.margins[0].gain.reset();
  EXPECT_THAT(told(),
              HasSubstr("at most 2 times, 25 Hz at about 0.2 V; below 0.2 V not measured, the bound may be "
                        "lower."));
  EXPECT_DOUBLE_EQ(*cycle.from(), factor_of(*cycle.margins[1].gain));
  cycle.hunting = HuntingPoint{1.13, 1, 15.6, 0.18, ""};
  EXPECT_THAT(
      told(),
      HasSubstr("Limit cycle from 1.13 times the gain on (below, pushes die out), 15.6 Hz with 0.18 V at "
                "the drive. By sines: at most 2 times"));
  EXPECT_EQ(*cycle.from(), 1.13);
  cycle.hunting->from = 0.94;
  EXPECT_THAT(told(), HasSubstr("Limit cycle from 0.94 times the gain on (it hunts as it stands)"));
  cycle.hunting = HuntingPoint{{}, 80, 0, 0, ""};
  EXPECT_THAT(
      told(),
      HasSubstr(
          "Limit cycle not found: pushes of 0.1 to 1.6 V died out up to 80 times the gain. By sines: "));
  cycle.hunting.reset();
  cycle.least.reset();
  EXPECT_THAT(told(), HasSubstr("Limit cycle. By sines: no gain margin was found at any amplitude."));
  EXPECT_FALSE(cycle.from().has_value());
}

// An axis that moves by itself: what a push does to it cannot be told from that.
TEST(BodePushesOfAMovingAxis, AreNotJudged) {
  bode_axis::Folder folder;
  folder.file("axis.mod", bode_axis::Folder::restless());
  Problems problems;
  const auto axis = scenario::read_scenario(folder.path / "axis.yaml", {}, problems);
  ASSERT_TRUE(problems.empty()) << to_string(problems.front());
  const auto hunting = push_loop(axis, {}, 0, problems);
  ASSERT_TRUE(hunting.has_value());
  EXPECT_THAT(hunting->failure, HasSubstr("the axis moves meanwhile; measure while it stands (--at)"));
  EXPECT_FALSE(hunting->from.has_value());
}

TEST(BodePlay, IsToldOfThePlantAtTheWireAlone) {
  bode_axis::Folder folder;
  const auto play = [&](const std::string& text) {
    Problems problems;
    const auto axis = scenario::read_scenario_text(text, folder.path / "axis.yaml", {}, problems);
    EXPECT_TRUE(problems.empty()) << to_string(problems.front());
    return play_of(axis, "axis.servo.reference");
  };
  EXPECT_EQ(play(bode_axis::Folder::screw()), "");
  auto worn = bode_axis::Folder::screw();
  worn.replace(worn.find("{type: linear_axis}"), 19, "{type: linear_axis, gear.backlash: 0.5 deg}");
  EXPECT_EQ(play(worn), "axis.gear.backlash 0.5 deg");
  auto another = bode_axis::Folder::screw();
  another.replace(another.find("{type: linear_axis}"), 19,
                  "{type: linear_axis}\n  other: {type: backlash_axis, gap: 1 mm}");
  EXPECT_EQ(play(another), "");
}

}  // namespace
}  // namespace drycut::sim::studies
