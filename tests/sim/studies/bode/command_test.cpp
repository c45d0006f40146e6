#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "sim/cli/bode_command.hpp"
#include "tests/sim/command_bench.hpp"
#include "tests/sim/studies/bode/axis.hpp"

namespace drycut::sim::studies {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

struct BodeCommand : CommandTest {
  BodeCommand() {
    options.scenario = folder.path / "axis.yaml";
    options.loop.points = 12;
    options.loop.amplitude = 1;
  }
  int run() {
    return captured([&] { return cli::measure_bode(options); });
  }
  /// Expects bad input told by `message`, and nothing else.
  void refuses(const std::string& message) {
    EXPECT_EQ(run(), cli::bad_input);
    EXPECT_EQ(err, message + "\n");
    EXPECT_THAT(out, IsEmpty());
  }

  bode_axis::Folder folder;
  cli::BodeOptions options;
};

TEST_F(BodeCommand, JudgesTheLoop) {
  options.min_phase_margin = 60;
  options.min_gain_margin = 12;
  EXPECT_EQ(run(), cli::all_passed) << err;
  EXPECT_THAT(
      out,
      StartsWith("axis: axis.reference from 2.AN01, sampled every 4 ms; a sine of 1 V added from 0.5 s"));
  EXPECT_THAT(out, HasSubstr("phase margin            87.1 deg at the crossover of 3.9"));
  EXPECT_THAT(out, HasSubstr("gain margin"));
  EXPECT_THAT(out, HasSubstr("axis.speed"));
  EXPECT_THAT(err, IsEmpty());
}

// Half the speed at 10 V is half the loop's gain: L(z) = gain / (z - 1) crosses over at half the frequency.
TEST_F(BodeCommand, TakesVariables) {
  auto text = bode_axis::Folder::scenario("");
  const std::string speed = "1000 mm/s";
  text.replace(text.find(speed), speed.size(), "\"${speed}\"");
  folder.file("axis.yaml", "variables: {speed: 1 m/s}\n" + text);
  const auto crossover = [&] {
    EXPECT_EQ(run(), cli::all_passed) << err;
    const auto at = out.find("at the crossover of ");
    return at == std::string::npos ? 0 : std::stod(out.substr(at + 20));
  };
  const double full = crossover();
  options.set = {"variables.speed=500 mm/s"};
  EXPECT_NEAR(crossover(), full / 2, 0.01 * full);
  options.set = {"variables.sped=500 mm/s"};
  EXPECT_EQ(run(), cli::bad_input);
  EXPECT_THAT(err,
              HasSubstr("--set variables.sped:1:1: there is no 'sped' in variables; did you mean speed?"));
  options.set = {"variables.speed=500 mm"};
  EXPECT_EQ(run(), cli::bad_input);
  EXPECT_THAT(err, HasSubstr("--set variables.speed:1:1: variables.speed is a speed (1 m/s, "));
}

TEST_F(BodeCommand, FailsBelowALimit) {
  options.min_phase_margin = 89;
  options.min_gain_margin = 30;
  EXPECT_EQ(run(), cli::check_failed);
  EXPECT_THAT(out, HasSubstr("FAIL: the phase margin of 87.09 deg is below 89 deg"));
  EXPECT_THAT(out, HasSubstr("FAIL: the gain margin of 26.04 dB is below 30 dB"));
}

// Who reads PASS should read what it was held against.
TEST_F(BodeCommand, APageSaysTheLimitsThatItWasJudgedBy) {
  options.out = folder.path / "results";
  EXPECT_EQ(run(), cli::all_passed);
  auto html = content(options.out / "report.html");
  EXPECT_THAT(html, HasSubstr("<strong>MEASURED</strong>"));
  EXPECT_THAT(html, testing::Not(HasSubstr("<h2>Checks</h2>")));
  options.min_phase_margin = 80;
  options.min_gain_margin = 20;
  EXPECT_EQ(run(), cli::all_passed);
  EXPECT_THAT(out, HasSubstr("PASS: the phase margin of 87.09 deg is not below 80 deg"));
  html = content(options.out / "report.html");
  EXPECT_THAT(html, HasSubstr("<strong>PASS</strong> <span>phase margin &gt;= 80 deg: 87.09 deg at "));
  EXPECT_THAT(
      html, testing::ContainsRegex("<code>gain margin &gt;= 20 dB</code></td><td>6[.]0[0-9]* dB left</td>"));
}

TEST_F(BodeCommand, FailsOnAMarginThatItCannotKnow) {
  options.loop.to = 20;
  options.min_gain_margin = 6;
  EXPECT_EQ(run(), cli::check_failed);
  EXPECT_THAT(out, HasSubstr("FAIL: the gain margin is not known: it lies outside these frequencies"));
}

TEST_F(BodeCommand, FailsOnAnUnstableLoop) {
  options.set = {"controller.qmove.set.Axis.pgain=2500"};
  EXPECT_EQ(run(), cli::check_failed);
  EXPECT_THAT(out, HasSubstr("the loop is not stable"));
}

TEST_F(BodeCommand, FailsOnAnOpenLoop) {
  options.loop.at = "0.001";
  folder.file("axis.mod", bode_axis::Folder::program("LOOPOFF Axis\n"));
  EXPECT_EQ(run(), cli::check_failed);
  EXPECT_THAT(out,
              HasSubstr("2.AN01 does not answer to 1 V at 0.001 s: either the loop is open there (let the "
                        "program do REGON before, or choose another --at), or the axis sits in play or "
                        "stiction (a larger --amplitude would answer, but it hides the play: see drycut bode "
                        "--limit-cycle)"));
}

TEST_F(BodeCommand, TakesATimeWithItsUnit) {
  options.loop.at = "400 ms";
  EXPECT_EQ(run(), cli::all_passed) << out;
  EXPECT_THAT(out, HasSubstr("added from 0.4 s"));
  options.loop.at = "6 kg";
  refuses("--at:1:1: '6 kg' is no time from 0 to 1e6 s; such as 6 s [option.out-of-range]");
}

TEST_F(BodeCommand, ALoopOfLowGainIsNotUnstable) {
  options.set = {"controller.qmove.set.Axis.pgain=1"};
  options.loop.amplitude = 0.1;
  run();
  EXPECT_THAT(out, testing::Not(HasSubstr("not stable")));
}

TEST_F(BodeCommand, WritesTableAndPicture) {
  options.csv = folder.path / "bode.csv";
  options.png = folder.path / "bode.png";
  EXPECT_EQ(run(), cli::all_passed);
  const auto csv = content(options.csv);
  EXPECT_THAT(csv,
              StartsWith("frequency [Hz],open_loop.gain [dB],open_loop.phase [deg],closed_loop.gain [dB],"
                         "closed_loop.phase [deg],sensitivity.gain [dB],error,axis.speed.gain [mm/s/V],"
                         "axis.speed.phase [deg]\n"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 13);
  EXPECT_THAT(content(options.png), StartsWith("\x89PNG"));
  const auto first = csv;
  EXPECT_EQ(run(), cli::all_passed);
  EXPECT_EQ(content(options.csv), first);
}

TEST_F(BodeCommand, WritesAReport) {
  options.out = folder.path / "results";
  options.min_gain_margin = 30;
  EXPECT_EQ(run(), cli::check_failed);
  EXPECT_THAT(out, HasSubstr("report: " + (options.out / "report.html").string()));
  const auto html = content(options.out / "report.html");
  EXPECT_THAT(html, HasSubstr("the gain margin of 26.04 dB is below 30 dB"));
  EXPECT_THAT(html, HasSubstr("87.1 deg at the crossover of 3.9"));
  EXPECT_THAT(html, HasSubstr("speed_at_10v"));  // the scenario with its defaults
  EXPECT_THAT(content(options.out / "plots/bode.png"), StartsWith("\x89PNG"));
  EXPECT_THAT(content(options.out / "bode.csv"), StartsWith("frequency [Hz],"));
}

TEST_F(BodeCommand, SweepsTheAmplitudeForALimitCycle) {
  options.limit_cycle = true;
  options.out = folder.path / "results";
  options.loop.from = 20;
  options.loop.points = 4;
  EXPECT_EQ(run(), cli::all_passed) << out << err;
  // A linear loop: the margin is that of any amplitude, a factor of 20 on pgain 100.
  EXPECT_THAT(out, HasSubstr("Gain margin over the amplitude of the sine"));
  EXPECT_THAT(out,
              testing::ContainsRegex("Limit cycle from (19|20)[.0-9]* times the gain on [(]below, pushes die "
                                     "out[)].* By sines: at most (19|20)"));
  EXPECT_THAT(content(options.out / "report.html"), HasSubstr("Gain margin over the amplitude"));
  EXPECT_THAT(content(options.out / "plots/limit_cycle.png"), StartsWith("\x89PNG"));
}

TEST_F(BodeCommand, PushesFindTheBoundWhereNoSineDoes) {
  options.limit_cycle = true;
  options.loop.to = 20;
  options.loop.points = 3;
  options.min_gain_margin = 27;
  EXPECT_EQ(run(), cli::check_failed);
  EXPECT_THAT(out, testing::ContainsRegex(
                       "Limit cycle from (19|20).* By sines: no gain margin was found at any amplitude."));
  EXPECT_THAT(out, testing::ContainsRegex("FAIL: the gain margin of 2[56][.0-9]+ dB is below 27 dB"));
}

/// The axis with a ball screw, an encoder on the motor, and play behind it.
struct BodeCommandWithPlay : BodeCommand {
  BodeCommandWithPlay() {
    auto worn = bode_axis::Folder::screw();
    worn.replace(worn.find("{type: linear_axis}"), 19, "{type: linear_axis, gear.backlash: 0.5 deg}");
    folder.file("axis.yaml", worn);
    options.loop.points = 20;
  }
};

TEST_F(BodeCommandWithPlay, SaysFromWhichGainOnItHuntsAndJudgesByThat) {
  options.min_gain_margin = 1;
  EXPECT_EQ(run(), cli::all_passed) << out << err;
  EXPECT_THAT(out, testing::ContainsRegex(
                       "\nhunting +from [0-9.]+ times the gain on [(]below, pushes die out[)].*with "
                       "axis.gear.backlash 0.5 deg the margins above hold for this amplitude only\n"));
}

// No number that is not to be trusted: first the reason.
TEST_F(BodeCommand, AMeasurementThatIsNotTrustedHasNoMargin) {
  folder.file("axis.mod", bode_axis::Folder::restless());
  options.loop.amplitude = 0.004;
  options.min_phase_margin = 10;
  options.out = folder.path / "results";
  EXPECT_EQ(run(), cli::check_failed);
  const auto reason = out.find("the answer is lost in what else moves");
  ASSERT_NE(reason, std::string::npos) << out;
  EXPECT_LT(reason, out.find("frequency")) << "the reason comes first";
  EXPECT_THAT(
      out,
      HasSubstr("a line that never stands: a scenario of its own that extends this one, with timeline: []"));
  EXPECT_THAT(out, HasSubstr("margins                 not known, for the reason above\n"));
  EXPECT_THAT(out, testing::Not(HasSubstr("deg at the crossover")));
  EXPECT_THAT(out, HasSubstr("FAIL: the phase margin is not known: what was measured is not to be trusted"));
  EXPECT_THAT(content(options.out / "report.html"), testing::Not(HasSubstr("deg at the crossover")));
}

TEST_F(BodeCommand, GoesDownToTheCrossover) {
  options.set = {"controller.qmove.set.Axis.pgain=10"};
  EXPECT_EQ(run(), cli::all_passed) << out << err;
  EXPECT_THAT(out, HasSubstr("deg at the crossover of 0.39"));
  options.loop.from = 1;
  options.min_phase_margin = 30;
  EXPECT_EQ(run(), cli::check_failed);
  EXPECT_THAT(out, HasSubstr("FAIL: the phase margin is not known: it lies outside these frequencies"));
}

TEST_F(BodeCommand, LeavesOutWhatIsFinerThanTheResolution) {
  // 5 mV are 0.5 mm/s: less than a count of 0.01 mm from 16 Hz on.
  options.loop.amplitude = 0.005;
  EXPECT_EQ(run(), cli::all_passed) << out;
  EXPECT_THAT(out,
              testing::ContainsRegex("From [0-9.]+ Hz on nothing answers to 0.005 V: it would be finer"));
  EXPECT_THAT(out, testing::Not(HasSubstr("inf")));
}

TEST_F(BodeCommand, RefusesAFolderThatCannotBeMade) {
  options.out = options.scenario / "results";
  EXPECT_EQ(run(), cli::bad_input);
  EXPECT_THAT(err, StartsWith("--out:1:1: the directory " + options.out.string() + " cannot be made"));
}

TEST_F(BodeCommand, PrintsTheTableForAProgram) {
  options.csv = "-";
  EXPECT_EQ(run(), cli::all_passed);
  EXPECT_THAT(out, StartsWith("frequency [Hz],"));
  EXPECT_THAT(err, HasSubstr("phase margin"));
}

TEST_F(BodeCommand, RefusesNumbersOutOfRange) {
  options.loop.amplitude = 11;
  options.loop.settle = -1;
  options.loop.points = 1;
  options.min_phase_margin = 200;
  refuses(
      "--settle:1:1: -1 is out of range; give 0 to 1000 s [option.out-of-range]\n"
      "--amplitude:1:1: 11 is out of range; give 0.001 to 10 V [option.out-of-range]\n"
      "--points:1:1: 1 is out of range; give 2 to 1000 [option.out-of-range]\n"
      "--min-phase-margin:1:1: 200 is out of range; give 0 to 180 deg [option.out-of-range]");
}

TEST_F(BodeCommand, RefusesFrequenciesThatTheControllerCannotSee) {
  options.loop.to = 200;
  refuses(
      "--to:1:1: 200 Hz is above half the sampling frequency of 4 ms; give at most 125 Hz "
      "[option.out-of-range]");
}

TEST_F(BodeCommand, RefusesARangeUpsideDown) {
  options.loop.from = 50;
  options.loop.to = 20;
  refuses("--from:1:1: 50 Hz is not below --to, 20 Hz; give a lower frequency [option.out-of-range]");
}

TEST_F(BodeCommand, RefusesFilesThatAreDirectoriesOrTheSame) {
  options.csv = folder.path;
  options.png = folder.path / "x.png";
  refuses("--csv:1:1: " + options.csv + " is a directory; name a file [file.not-writable]");
  options.csv = options.png;
  refuses("--png:1:1: it is the file of --csv; name another file [option.file-name]");
}

TEST_F(BodeCommand, RefusesAnUnknownWire) {
  options.loop.wire = "axis.servo";
  refuses(
      "--wire:1:1: there is no analogue reference 'axis.servo'; give one of: axis.reference "
      "[option.unknown-choice]");
}

TEST_F(BodeCommand, RefusesAnUnknownSpeed) {
  options.loop.speed = "axis.sped";
  refuses("--speed:1:1: there is no channel 'axis.sped'; did you mean axis.speed? [option.unknown-choice]");
}

TEST_F(BodeCommand, RefusesFilesThatItMustNotWrite) {
  options.csv = options.scenario;
  options.png = folder.path / "none" / "x.jpg";
  refuses("--csv:1:1: " + options.scenario.string() +
          " is the scenario itself; name another file [option.file-name]\n--png:1:1: there is no directory " +
          (folder.path / "none").string() +
          "; make it first or name another [file.not-writable]\n--png:1:1: " + options.png +
          " does not end in .png; name it x.png [option.file-name]");
}

TEST_F(BodeCommand, RefusesAnOverrideThatIsNone) {
  options.set = {"pgain"};
  refuses(
      "--set:1:1: 'pgain' is not an assignment; write path=value, such as "
      "\"plants.web.speed=80 m/min\" [option.set-path]");
}

TEST_F(BodeCommand, RefusesAScenarioWithoutAnalogueOutput) {
  auto text = bode_axis::Folder::scenario("");
  text.replace(text.find(", 2.AN01: axis.reference"), 24, "");
  folder.file("axis.yaml", text);
  refuses(options.scenario.string() +
          ":1:1: no analogue output is wired; a position loop needs one, such as 2.AN01: "
          "knife.servo.reference [bode.no-loop]");
}

TEST_F(BodeCommand, TellsProblemsOfTheScenario) {
  folder.file("axis.yaml", bode_axis::Folder::scenario("cheks: []\n"));
  EXPECT_EQ(run(), cli::bad_input);
  EXPECT_THAT(err, HasSubstr("axis.yaml:11:1: unknown key 'cheks'"));
}

}  // namespace
}  // namespace drycut::sim::studies
