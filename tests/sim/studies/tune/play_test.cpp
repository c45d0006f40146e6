// Tuning where there is play: a gantry whose loop rests at gains at which it hunts for ever once something
// has moved it. By runs with lost counts it does so from a pgain of 130 to 135 on, with more play and mass
// from 110 to 118 on.
#include <gmock/gmock.h>

#include "sim/cli/tune_command.hpp"
#include "tests/sim/command_bench.hpp"

namespace drycut::sim::studies::tuning {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;

const char* const gantry = R"(scene: {step: 100 us, duration: 1200 ms}
plants:
  axis: {type: backlash_axis, gap: 0.4 mm, mass: 350 kg, encoder: {lines: 5000}, servo: {model: HG-SR352, speed_at_10v: 3000 rpm, inertia_ratio: 1}}
controller:
  qmove: {configuration: axis.cnf, tasks: [axis.mod], set: {Axis.pgain: 60}}
wiring: {2.CNT01: axis.scale, 2.AN01: axis.servo.reference}
record: {every: 1 ms, channels: [axis.position]}
)";

struct TunePlay : CommandTest {
  TunePlay() {
    folder.file("axis.cnf",
                "BUS\n1 1CPUB 02\n2 1MIXA 00\n\nINTDEVICE\nAxis EPICPOS 2 2.CNT01 X X.X 2.AN01\n\nEND\n");
    folder.file("axis.mod", R"(Axis:cntratio = 40000
Axis:decpt = 2
Axis:maxvel = 60000
Axis:maxpos = 100000
Axis:maxfollerr = 100000
Axis:taccdec = 100
Axis:toll = 3
Axis:setvel = 6000
INIT Axis
WAIT Axis:st_init
CNTUNLOCK Axis
CNTDIR Axis
REGON Axis
WAIT NOT Axis:st_regoff
LOOPON Axis
WAIT Axis:st_loopon
Axis:setpos = 2000
START Axis
END
)");
    options.scenarios = {folder.file("axis.yaml", gantry)};
    options.vary = {"controller.qmove.set.Axis.pgain=60..200"};
    options.minimise = "rms(Axis.follerr)";
    options.from = "20 ms";
    options.budget = 60;
    options.pictures = false;
    options.out = folder.path / "out";
    options.loop.amplitude = 1;
    options.loop.points = 8;
    options.loop.from = 8;
    options.loop.to = 60;
    options.loop.settle = 0.2;
  }
  int run() {
    return captured([&] { return cli::tune_scenarios(options); });
  }
  [[nodiscard]] double tuned() const {
    const auto patch = content(options.out / "patch.txt");
    return std::stod(patch.substr(patch.find("pgain = ") + 8));
  }

  TestFolder folder;
  cli::TuneOptions options;
};

TEST_F(TunePlay, AGainThatHuntsAfterAPushIsNoAnswer) {
  ASSERT_EQ(run(), cli::all_passed) << out << err;
  EXPECT_GT(tuned(), 110);
  EXPECT_LT(tuned(), 135);
  EXPECT_THAT(out, ContainsRegex(
                       "axis.gap 0.4 mm, .*: pushed at rest by 0.1 to 1.6 V it comes to rest again; it hunts "
                       "from 1[.0-9]* times the gain on\n"));
  EXPECT_THAT(content(options.out / "evaluations.csv"), HasSubstr("it hunts after a push: 1"));
}

TEST_F(TunePlay, TheGainMarginIsTheLeastOverAllAmplitudes) {
  options.constraints = {"gain_margin >= 6"};
  options.vary = {"controller.qmove.set.Axis.pgain=20..200"};
  options.budget = 80;
  ASSERT_EQ(run(), cli::all_passed) << out << err;
  // Half of 130 to 135; by the sine of 1 V alone it would be 100.
  EXPECT_GT(tuned(), 58);
  EXPECT_LT(tuned(), 68.5);
}

TEST_F(TunePlay, MachinesOfTheSpreadThatHuntAreTold) {
  options.set = {"controller.qmove.set.Axis.pgain=122"};
  options.vary = {"controller.qmove.set.Axis.pgain=121..123"};
  options.spread = {"plants.axis.gap=0.5..0.55 mm", "plants.axis.mass=410..430 kg"};
  options.spread_runs = 2;
  ASSERT_EQ(run(), cli::all_passed) << out << err;
  EXPECT_THAT(
      out,
      HasSubstr("Spread of the machine: 2 samples, 2 beyond a limit; worst of the limits: it hunts after a "
                "push: 1"));
  EXPECT_THAT(out, ContainsRegex("; over the spread 2 machines go on hunting, the worst from "
                                 "(1|0[.][89][0-9]*) times the gain on\n"));
}

// A sine that stays in the play answers at no gain: it is told at once, and how it can be had.
TEST_F(TunePlay, EndsAtTheFirstLoopThatCannotBeMeasured) {
  options.constraints = {"phase_margin >= 30"};
  options.loop.amplitude = 0.02;
  EXPECT_EQ(run(), cli::check_failed) << out << err;
  EXPECT_THAT(out, testing::StartsWith("Margins could not be measured, so nothing was searched: at "));
  EXPECT_THAT(
      out,
      HasSubstr("the motion stays in play or stiction; a larger --amplitude would answer, but it hides the "
                "play, for which the pushes count"));
  EXPECT_THAT(out, HasSubstr("\n1 sets of values tried, "));
  EXPECT_THAT(out, HasSubstr("simulated runs: 5 of at most 60: present values 5, search 0"));
  EXPECT_THAT(content(options.out / "patch.txt"), testing::Not(HasSubstr("pgain = ")));
}

}  // namespace
}  // namespace drycut::sim::studies::tuning
