// A recording of the real machine beside a run.
#include "sim/studies/compare/measured.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "sim/cli/compare_command.hpp"
#include "tests/sim/studies/compare/bench.hpp"

namespace drycut::sim::studies::comparing {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pointwise;

struct CompareMeasured : Bench {
  CompareMeasured() {
    texts.trace =
        "time [s],axis.position [mm],axis.speed [m/min],axis.angle [deg],AxisX.follerr [bits x4]\n"
        "0.0,0,6,350,0\n0.1,10,6,10,2\n0.2,20,-6,30,4\n0.3,10,-6,50,6\n";
    test_folder.file(
        "r.csv",
        "t;p;a;f;c\n100;1;355;1;7\n150;6;5;2;7\n200;13;15;3;7\n300;16;35;3;7\n400;9;55;3;7\n900;0;0;0;0\n");
    yaml(R"(channels:
  axis.position: {column: p, unit: mm}
  axis.angle: {column: a, unit: deg}
  AxisX.follerr: {column: f, unit: counts}
  axis.motor.torque: {column: c, unit: N m}
)");
  }
  void yaml(const std::string& channels) {
    file = test_folder.file("r.yaml",
                            "file: r.csv\nseparator: semicolon\ntime: {column: t, unit: ms}\n" + channels);
  }
  MeasuredRun measured(double from = 0, const std::vector<std::string>& without = {},
                       const std::vector<std::string>& tolerances = {}) {
    problems.clear();
    return measure_run(file, write("run", texts), from, without, tolerances, problems);
  }
  const MeasuredChannel& channel(const MeasuredRun& of, const std::string& name) {
    const auto found = std::ranges::find(of.channels, name, &MeasuredChannel::name);
    EXPECT_NE(found, of.channels.end()) << name;
    return *found;
  }
  int run(const std::vector<fs::path>& runs) {
    options.runs = runs;
    options.out = folder / "out";
    return captured([&] { return cli::compare_runs(options); });
  }
  RunTexts texts;
  fs::path file;
  Problems problems;
  cli::CompareOptions options;
};

// Its first sample, at 100 ms, is the run's zero; what comes behind the run's end is not looked at.
TEST_F(CompareMeasured, IsLaidOverFromItsFirstSampleOn) {
  const auto found = measured();
  ASSERT_TRUE(problems.empty()) << lines_of(problems);
  const auto& position = channel(found, "axis.position");
  EXPECT_THAT(position.times, Pointwise(testing::DoubleNear(1e-9), {0.0, 0.05, 0.1, 0.2, 0.3}));
  EXPECT_THAT(position.residual, Pointwise(testing::DoubleNear(1e-9), {-1.0, -1.0, -3.0, 4.0, 1.0}));
  EXPECT_NEAR(position.mean, 0, 1e-9);
  EXPECT_NEAR(position.rms, std::sqrt(28 / 5.0), 1e-9);
  EXPECT_NEAR(position.worst, 4, 1e-9);
  EXPECT_NEAR(position.worst_at, 0.2, 1e-9);
  EXPECT_NEAR(position.relative, std::sqrt(28 / (1.0 + 36 + 169 + 256 + 81)), 1e-9);
  EXPECT_FALSE(position.allowed);
  EXPECT_THAT(found.only_measured, ElementsAre("axis.motor.torque"));
}

// The run's speed says the way: forwards until 100 ms, backwards from 200 ms on.
TEST_F(CompareMeasured, IsToldByDirection) {
  const auto position = channel(measured(), "axis.position");
  ASSERT_TRUE(position.speed);
  EXPECT_EQ(position.speed->name, "axis.speed");
  EXPECT_THAT(directions_of(*position.speed), ElementsAre(1, 1, 1, -1, -1));
  EXPECT_NEAR(position.mean_forwards.value_or(0), -5 / 3.0, 1e-9);
  EXPECT_NEAR(position.mean_backwards.value_or(0), 2.5, 1e-9);
  ASSERT_TRUE(position.position);
  EXPECT_EQ(position.position->name, "axis.position");
}

TEST_F(CompareMeasured, AnAngleThatBeginsAgainIsNoJump) {
  EXPECT_THAT(channel(measured(), "axis.angle").residual,
              Pointwise(testing::DoubleNear(1e-9), {-5.0, -5.0, -5.0, -5.0, -5.0}));
}

TEST_F(CompareMeasured, PureNumbersAreInTheRunsUnit) {
  const auto follerr = channel(measured(), "AxisX.follerr");
  EXPECT_EQ(follerr.unit, "bits x4");
  EXPECT_THAT(follerr.residual, Pointwise(testing::DoubleNear(1e-9), {-1.0, -1.0, -1.0, 1.0, 3.0}));
}

TEST_F(CompareMeasured, LooksFromATimeOnAndLeavesChannelsOut) {
  const auto found = measured(0.15, {"AxisX.*"});
  ASSERT_EQ(found.channels.size(), 2U);
  EXPECT_EQ(channel(found, "axis.position").times.size(), 2U);
  measured(0, {"axis.positio"});
  EXPECT_THAT(lines_of(problems), HasSubstr("did you mean axis.position? [compare.tolerance]"));
}

TEST_F(CompareMeasured, CommandTellsAndWrites) {
  EXPECT_EQ(run({file, write("run", texts)}), cli::all_passed) << err;
  EXPECT_THAT(out, HasSubstr("axis.angle"));
  EXPECT_THAT(out, HasSubstr("axis.motor.torque was not recorded in the run"));
  EXPECT_THAT(content(folder / "out/comparison.csv"), HasSubstr("\naxis.position,mm,5,"));
  EXPECT_THAT(content(folder / "out/verdict.json"), HasSubstr("\"exit\": 0"));
  EXPECT_THAT(content(folder / "out/report.html"), HasSubstr("MEASURED"));
  for (const auto* plot :
       {"measured_axis_position", "residual_axis_position_over_speed", "residual_axis_angle_over_position"})
    EXPECT_TRUE(fs::exists(folder / "out/plots" / (std::string(plot) + ".png"))) << plot;
  EXPECT_EQ(run({write("run", texts), file}), cli::all_passed) << "in either order: " << err;
}

TEST_F(CompareMeasured, ToleranceIsTheExitStatus) {
  options.pictures = false;
  options.tolerances = {"axis.position=4.1mm"};
  EXPECT_EQ(run({file, write("run", texts)}), cli::all_passed) << err;
  options.tolerances = {"axis.position=3.9mm"};
  EXPECT_EQ(run({file, write("run", texts)}), cli::check_failed) << err;
  EXPECT_THAT(out, HasSubstr("beyond the tolerance: axis.position by 4 mm at 0.2 s at most, 3.9 allowed"));
  options.tolerances = {"axis.position=4.1mm", "1e-3"};  // one for all others
  EXPECT_EQ(run({file, write("run", texts)}), cli::check_failed) << err;
}

TEST_F(CompareMeasured, RefusesWhatDoesNotGoTogether) {
  const auto line = write("run", texts);
  const auto refuses = [&](const std::vector<fs::path>& runs, const std::string& what) {
    EXPECT_EQ(run(runs), cli::bad_input);
    EXPECT_THAT(err, HasSubstr(what));
    EXPECT_FALSE(fs::exists(folder / "out"));
    options = {};
  };
  refuses({file, file}, "[compare.runs]");
  refuses({file, line, line}, "[compare.runs]");
  options.fail_on_difference = true;
  refuses({file, line}, "--fail-on-difference");
  options.align = "cut";
  refuses({file, line}, "--align");
  options.tolerances = {"axis.positio=1mm"};
  refuses({file, line}, "[compare.unknown-name]");
  yaml("channels:\n  axis.position: {column: p, unit: kg}\n");
  refuses({file, line}, "[scenario.wrong-unit]");
  yaml("channels:\n  axis.place: {column: p, unit: mm}\n");
  refuses({file, line}, "[compare.nothing-shared]");
}

}  // namespace
}  // namespace drycut::sim::studies::comparing
