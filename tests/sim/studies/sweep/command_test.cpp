// drycut sweep and drycut envelope on a web whose speed a check limits: what holds where is known beforehand.
#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <fstream>

#include "renders/process.hpp"
#include "sim/cli/sweep_command.hpp"
#include "sim/studies/sweep/point.hpp"
#include "sim/studies/sweep/rated_drive.hpp"
#include "tests/sim/command_bench.hpp"

namespace drycut::sim::cli {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string scenario = R"(variables: {limit: 100 m/min, speed: 60 m/min, least: 10 m/min, end: 0.2 s}
scene: {step: 1 ms, duration: "${end}"}
plants: {web: {type: web, speed: "${speed}"}}
record: {every: 10 ms, channels: [web.speed]}
checks:
  - {name: slow enough, always: "web.speed <= ${limit}"}
  - {name: fast enough, always: "web.speed >= ${least}", from: 0.1 s}
)";

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

struct SweepCommand : CommandTest {
  SweepCommand() {
    folder.file("web.yaml", scenario);
    sweep.scenario = folder / "web.yaml";
    envelope.scenarios = {sweep.scenario};
    sweep.out = folder / "sweep";
    envelope.out = folder / "envelope";
  }
  int run_sweep() {
    return captured([&] { return sweep_scenario(sweep); });
  }
  int run_envelope() {
    return captured([&] { return envelope_scenario(envelope); });
  }
  /// The lines of a table, cut off behind its first `columns` cells.
  std::vector<std::string> rows(const fs::path& file, int columns) const {
    std::vector<std::string> lines;
    std::istringstream text(text_of(folder / file.string()));
    for (std::string line; std::getline(text, line);) {
      std::size_t at = 0;
      for (int i = 0; i < columns && at != std::string::npos; ++i) at = line.find(',', at + (i > 0 ? 1 : 0));
      lines.push_back(line.substr(0, at));
    }
    return lines;
  }

  TestFolder folder;
  SweepOptions sweep;
  EnvelopeOptions envelope;
};

TEST_F(SweepCommand, ARowAPointWithWhatGaveWay) {
  sweep.over = {"variables.limit=80,120 m/min", "variables.speed=5..125 m/min:4"};
  sweep.figures = {"peak=max(web.speed)"};
  ASSERT_EQ(run_sweep(), all_passed) << err;
  EXPECT_THAT(rows("sweep/sweep.csv", 4),
              ElementsAre("variables.limit [m/min],variables.speed [m/min],verdict,limit",  //
                          "80,5,failed,fast enough", "80,45,passed,", "80,85,failed,slow enough",
                          "80,125,failed,slow enough", "120,5,failed,fast enough", "120,45,passed,",
                          "120,85,passed,", "120,125,failed,slow enough"));
  const auto text = text_of(folder / "sweep/sweep.csv");
  EXPECT_THAT(text,
              HasSubstr("limit,rating,margin of slow enough [m/min],margin of fast enough [m/min],peak\n"));
  EXPECT_THAT(text, HasSubstr("120,85,passed,,,35,75,85\n"));
  EXPECT_THAT(out, AllOf(HasSubstr("3 failed: slow enough"), HasSubstr("\n8 points, 3 passed, 5 failed: "),
                         HasSubstr("\n8 runs simulated now\n")));
}

// A value that the scenario does not take is no run, and says so wherever points are counted.
TEST_F(SweepCommand, WhatIsRefusedIsNoRun) {
  sweep.over = {"plants.web.speed=50,150,1e6,2e6,3e6 m/min"};
  ASSERT_EQ(run_sweep(), all_passed) << err;
  EXPECT_THAT(out,
              AllOf(HasSubstr("       3 refused, the first: plants.web.speed is 1000000 m/min"),
                    HasSubstr("\n5 points, 1 passed, 1 failed, 3 refused (input wrong, not simulated): "),
                    HasSubstr("\n2 runs simulated now, 3 refused\n")));
  ASSERT_EQ(run_sweep(), all_passed) << err;
  EXPECT_THAT(out, HasSubstr("\n0 runs simulated now\n"));
}

// Which rating of the drive fails is named, with its figures.
TEST_F(SweepCommand, TheRatingThatFailsIsNamed) {
  sweep.scenario = source_root / "scenes/rotary_knife.yaml";
  sweep.set = {"scene.duration=8 s"};
  sweep.over = {"plants.knife.servo.rated_torque=1,9.5 N m"};
  ASSERT_EQ(run_sweep(), all_passed) << err;
  EXPECT_THAT(
      text_of(folder / "sweep/sweep.csv"),
      testing::ContainsRegex("\n1,failed,drive within its ratings,\"?rms [a-z, ]+: [0-9.]+ of [0-9.]+ "
                             "(N m|A)\"?,"));
  EXPECT_THAT(rows("sweep/sweep.csv", 4)[2], "9.5,passed,,");
  EXPECT_THAT(out, HasSubstr("1 failed: drive within its ratings: "));
}

TEST(FailedRating, IsTheWorstOfTheDriveThatNeedsMost) {
  record::DriveVerdict knife;
  knife.drive = "knife.servo";
  knife.figures = {{.name = "rms torque", .value = 9, .rating = 9.5, .unit = "N m", .share = 0.947},
                   {.name = "brake resistor", .value = 110, .rating = 100, .unit = "W", .share = 1.1},
                   {.name = "told only", .value = 9, .rating = 1, .unit = "K", .share = 9, .judged = false}};
  EXPECT_EQ(studies::failed_rating({knife}), "brake resistor: 110 of 100 W");
  auto saw = knife;
  saw.drive = "saw.servo";
  saw.figures[0].share = 1.2;
  saw.figures[0].value = 11.4;
  EXPECT_EQ(studies::failed_rating({knife, saw}), "saw.servo rms torque: 11.4 of 9.5 N m");
  saw.trips = {"overload at 3.200 s"};
  EXPECT_EQ(studies::failed_rating({saw}), "overload at 3.200 s");
  knife.figures.pop_back();
  knife.figures.pop_back();
  EXPECT_EQ(studies::failed_rating({knife}), "");
  // Points of one rating are of one region, whatever their figures.
  const studies::PointRow row{
      studies::PointRow::Verdict::failed, "drive within its ratings", "brake resistor: 110 of 100 W", {}};
  EXPECT_EQ(region_of(row), "drive within its ratings: brake resistor");
  EXPECT_EQ(limit_of(row), "drive within its ratings (brake resistor: 110 of 100 W)");
}

// Without a cut there is no cycle of the machine: its rms torque and energy are unknown, not 0.
TEST_F(SweepCommand, WhatIsUnknownIsEmpty) {
  sweep.scenario = source_root / "scenes/rotary_knife.yaml";
  sweep.set = {"scene.duration=0.5 s"};
  sweep.over = {"variables.length=700,800 mm"};
  ASSERT_EQ(run_sweep(), all_passed) << err;
  const auto lines = rows("sweep/sweep.csv", 11);
  EXPECT_THAT(lines[0],
              HasSubstr("knife.servo rms torque [N m],knife.servo peak torque [N m],knife.servo energy a "
                        "cycle [J]"));
  for (const std::size_t i : {1U, 2U})
    EXPECT_THAT(lines[i], testing::MatchesRegex("[78]00,failed,[^,]*,,0,,,,,[0-9.]+,")) << lines[i];
}

TEST_F(SweepCommand, TheFirstInTimeIsTheLimit) {
  // At 5 m/min with a limit of 1 both fail: "slow enough" at once, "fast enough" from 0.1 s on.
  sweep.set = {"variables.limit=1 m/min", "checks.0.from=0.15 s"};
  sweep.over = {"variables.speed=5,6 m/min"};
  ASSERT_EQ(run_sweep(), all_passed) << err;
  EXPECT_THAT(rows("sweep/sweep.csv", 3)[1], "5,failed,fast enough");
  sweep.set = {"variables.limit=1 m/min"};
  ASSERT_EQ(run_sweep(), all_passed) << err;
  EXPECT_THAT(rows("sweep/sweep.csv", 3)[1], "5,failed,slow enough");
}

TEST_F(SweepCommand, APointThatCannotBeIsRefused) {
  sweep.over = {"plants.web.speed=50,1e6 m/min"};
  ASSERT_EQ(run_sweep(), all_passed) << err;
  const auto lines = rows("sweep/sweep.csv", 99);
  EXPECT_THAT(lines[1], HasSubstr("50,passed,,"));
  EXPECT_THAT(lines[2],
              HasSubstr("1000000,refused,\"plants.web.speed is 1000000 m/min, out of range; 0 m/min to"));
}

TEST_F(SweepCommand, ARefusalNamesItsCheck) {
  // The check would end before it begins.
  sweep.set = {"checks.1.until=0.15 s"};
  sweep.over = {"checks.1.from=0.1,0.16 s"};
  ASSERT_EQ(run_sweep(), all_passed) << err;
  EXPECT_THAT(rows("sweep/sweep.csv", 99)[2], HasSubstr("0.16,refused,checks.fast enough.until"));
  const auto page = text_of(folder / "sweep/report.html");
  EXPECT_THAT(page, HasSubstr("checks[fast enough].from [s]"));
  EXPECT_THAT(page, HasSubstr("checks.1.from=0.1 s"));  // a command takes the number
}

TEST_F(SweepCommand, SameBytesForAnyJobsAndNothingTwice) {
  sweep.over = {"variables.speed=5..125 m/min:30"};
  ASSERT_EQ(run_sweep(), all_passed) << err;
  const auto alone = text_of(folder / "sweep/sweep.csv");
  auto parallel = sweep;
  parallel.jobs = 4;
  parallel.out = folder / "parallel";
  ASSERT_EQ(captured([&] { return sweep_scenario(parallel); }), all_passed) << err;
  EXPECT_EQ(text_of(folder / "parallel/sweep.csv"), alone);
  ASSERT_EQ(run_sweep(), all_passed);
  EXPECT_THAT(out, HasSubstr("\n0 runs simulated"));
  EXPECT_EQ(text_of(folder / "sweep/sweep.csv"), alone);
  // Some of a finer sweep's points are known; what a comment says changes no run.
  folder.file("web.yaml", "# another comment\n" + scenario);
  sweep.over = {"variables.speed=5..125 m/min:59"};
  ASSERT_EQ(run_sweep(), all_passed);
  EXPECT_THAT(out, HasSubstr("\n29 runs simulated"));
  // Another limit is another run.
  sweep.set = {"variables.limit=90 m/min"};
  ASSERT_EQ(run_sweep(), all_passed);
  EXPECT_THAT(out, HasSubstr("\n59 runs simulated"));
}

TEST_F(SweepCommand, GoesOnWhereItWasCutShort) {
  sweep.over = {"variables.speed=5..125 m/min:12"};
  ASSERT_EQ(run_sweep(), all_passed) << err;
  const auto whole = text_of(folder / "sweep/sweep.csv");
  const auto cache = text_of(folder / "sweep/points.cache");
  auto cut = cache.find('\n');
  for (int i = 0; i < 4; ++i) cut = cache.find('\n', cut + 1);
  std::ofstream(folder / "sweep/points.cache", std::ios::binary)
      << cache.substr(0, cut + 12) << "\nnonsense\n0123456789abcdef,sunny,,\n"
      << cache.substr(0, 20);
  ASSERT_EQ(run_sweep(), all_passed) << err;
  EXPECT_THAT(out, HasSubstr("\n7 runs simulated"));
  EXPECT_EQ(text_of(folder / "sweep/sweep.csv"), whole);
}

TEST_F(SweepCommand, AFlippedBitCostsItsPointAndNoOther) {
  sweep.over = {"variables.speed=5..125 m/min:12"};
  ASSERT_EQ(run_sweep(), all_passed) << err;
  const auto whole = text_of(folder / "sweep/sweep.csv");
  const auto cache = text_of(folder / "sweep/points.cache");
  // In a number behind the verdict, in the key, in the verdict, in the checksum.
  for (const auto at : {cache.rfind(','), cache.find('\n') + 4, cache.find("failed"), cache.size() - 3}) {
    for (const int bit : {0, 1, 4}) {
      auto damaged = cache;
      damaged[at - 1] = static_cast<char>(damaged[at - 1] ^ (1 << bit));
      std::ofstream(folder / "sweep/points.cache", std::ios::binary) << damaged;
      ASSERT_EQ(run_sweep(), all_passed) << err;
      EXPECT_THAT(out, HasSubstr("\n1 runs simulated")) << at << " bit " << bit;
      EXPECT_EQ(text_of(folder / "sweep/sweep.csv"), whole) << at << " bit " << bit;
    }
  }
}

TEST_F(SweepCommand, GoesOnAfterKill9) {
  sweep.over = {"variables.speed=5..125 m/min:400"};
  sweep.set = {"variables.end=2 s"};
  const std::string program = DRYCUT_PROGRAM;
  if (!fs::exists(program)) GTEST_SKIP() << "needs the program, which is not built here";
  const auto cache = folder / "sweep/points.cache";
  const std::vector<std::string> words = {"sweep",  sweep.scenario.string(),
                                          "--over", sweep.over[0],
                                          "--set",  sweep.set[0],
                                          "--out",  sweep.out.string(),
                                          "--jobs", "2"};
  const pid_t child = started(program, words);
  ASSERT_GT(child, 0);
  int status = 0;
  const auto lines = [&] {
    const auto text = text_of(cache);
    return std::count(text.begin(), text.end(), '\n');
  };
  bool ended = false;
  while (lines() < 3 && !ended) ended = waitpid(child, &status, WNOHANG) == child;
  if (!ended) {
    kill(child, SIGKILL);
    waitpid(child, &status, 0);
  }
  ASSERT_TRUE(WIFSIGNALED(status)) << "it was to be killed before its end";
  EXPECT_FALSE(fs::exists(folder / "sweep/sweep.csv"));
  const auto kept = lines();
  // The program goes on; another, as these tests are, would begin anew.
  const auto finished = renders::run_process({program, "drycut", words});
  ASSERT_TRUE(finished.good) << finished.words;
  EXPECT_THAT(finished.output, HasSubstr("\n" + std::to_string(400 - kept) + " runs simulated"));
  auto afresh = sweep;
  afresh.out = folder / "afresh";
  ASSERT_EQ(captured([&] { return sweep_scenario(afresh); }), all_passed);
  EXPECT_EQ(text_of(folder / "sweep/sweep.csv"), text_of(folder / "afresh/sweep.csv"));
}

TEST_F(SweepCommand, SamplesTheRanges) {
  sweep.over = {"variables.speed=20..90 m/min", "variables.limit=95..100 m/min"};
  sweep.sample = "sobol:16";
  ASSERT_EQ(run_sweep(), all_passed) << err;
  EXPECT_EQ(rows("sweep/sweep.csv", 3).size(), 17U);
  EXPECT_THAT(rows("sweep/sweep.csv", 3)[2], "55,97.5,passed");
}

TEST_F(SweepCommand, BadInputIsToldBeforeAnythingRuns) {
  struct Case {
    std::vector<std::string> over;
    const char* told;
    const char* sample = "";
    const char* figure = "";
  };
  const std::string good = "variables.speed=5..125 m/min:4";
  for (const auto& [over, told, sample, figure] : {
           Case{{"variables.sped=5..125 m/min:4"},
                "--over:1:16: variables.sped: there is no 'sped' in variables; did you mean speed? "
                "[option.set-path]"},
           Case{{"plants.web.sped=5..125 m/min:4"}, "unknown key 'sped' in plants.web; did you mean speed?"},
           Case{{"variables.speed=5..125 mm:4"},
                "--over:1:20: variables.speed is a speed, not a length; its value is 60 m/min "
                "[study.wrong-unit]"},
           Case{{"variables.speed=5..125:4"},
                "--over:1:17: variables.speed is a speed, and no unit is given; such as 5..125 m/min:4 "
                "[study.wrong-unit]"},
           Case{
               {"speed=5..125 m/min:4"},
               "--over:1:1: the scenario has no 'speed'; did you mean variables.speed? [study.unknown-name]"},
           Case{{"web.thickness=1,2 mm"},
                "--over:1:1: the scenario has no 'web.thickness'; did you mean plants.web.thickness? "
                "[study.unknown-name]"},
           Case{{"nothing=1,2 mm"},
                "--over:1:1: the scenario has no 'nothing'; a path begins with variables, "},
           Case{{"plants.web.type=web,wob,web2"}, "--over:1:21: plants.web.type cannot be 'wob': "},
           Case{{"plants.web.type=web,wob,web2"}, "--over:1:25: plants.web.type cannot be 'web2': "},
           Case{{"checks.1.until=1..2 mm:2"}, "checks[fast enough].until"},
           Case{{"plants.web.thickness=1,2"},
                "--over:1:22: plants.web.thickness is a length, and no unit is given; such as 1 mm "
                "[study.wrong-unit]"},
           Case{{"plants.web.thickness=1,abc,3 mm"}, "--over:1:24: 'abc' is no number as the others are"},
           Case{{good}, "--over:1:29: ':4' says how many values a grid has", "sobol:16"},
           Case{{"plants.web.speed=5..125 mm:4"},
                "--over:1:18: plants.web.speed is a speed, not a length (mm)"},
           Case{{good, good}, "--over:1:1: variables.speed is given twice"},
           Case{{"variables.speed=1..2 m/min:100000", "variables.limit=1..2 m/min:10000"},
                "--over:1:1: 100000 x 10000 are 1e+09 points; at most 1000000"},
           Case{{good}, "--sample:1:1: 'sobol:0' is no sample", "sobol:0"},
           Case{{good}, "--sample:1:1: 'random:5' is no sample", "random:5"},
           Case{{good}, "--figure:1:1: 'peak' is no NAME=TERM", "", "peak"},
           Case{{good}, "--figure:1:10: ", "", "peak=max(web.sped)"},
           Case{{good}, "--figure:1:6: ", "", "peak=maxi(web.speed)"},
       }) {
    sweep.over = over;
    sweep.sample = sample;
    sweep.figures.clear();
    if (*figure != '\0') sweep.figures = {figure};
    const int status = run_sweep();
    EXPECT_EQ(status, bad_input) << over[0];
    EXPECT_THAT(err, HasSubstr(told)) << over[0];
    EXPECT_FALSE(fs::exists(sweep.out)) << over[0];
  }
}

TEST_F(SweepCommand, AnEnvelopeIsWhereTheLimitIs) {
  envelope.over = {"variables.limit=40..290 m/min:3"};
  envelope.find_max = {"variables.speed=5..300 m/min:0.25"};
  ASSERT_EQ(run_envelope(), all_passed) << err;
  const auto lines = rows("envelope/envelope.csv", 8);
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_EQ(lines[0],
            "variables.limit [m/min],variables.speed [m/min],verdict,limit,rating,holds from [m/min],"
            "fails at [m/min],holds again at [m/min]");
  const std::vector<double> limits = {40, 165, 290};
  for (std::size_t i = 0; i < limits.size(); ++i) {
    const auto& line = lines[i + 1];
    double limit = 0;
    double speed = 0;
    ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,", &limit, &speed), 2) << line;
    EXPECT_EQ(limit, limits[i]);
    EXPECT_LE(speed, limit);
    EXPECT_GT(speed, limit - 0.25);
    EXPECT_THAT(line, HasSubstr(i == 0 ? ",found,slow enough,,23.4375,," : ",found,slow enough,,41.875,,"));
  }
  const auto text = text_of(folder / "envelope/envelope.csv");
  envelope.jobs = 3;
  envelope.out = folder / "parallel";
  ASSERT_EQ(run_envelope(), all_passed);
  EXPECT_EQ(text_of(folder / "parallel/envelope.csv"), text);
}

TEST_F(SweepCommand, AnEnvelopeMayHaveNoEnd) {
  envelope.over = {"variables.limit=5,300 m/min"};
  envelope.find_max = {"variables.speed=20..200 m/min:1"};
  ASSERT_EQ(run_envelope(), all_passed) << err;
  EXPECT_THAT(rows("envelope/envelope.csv", 6)[1], "5,,nowhere,slow enough,,");
  EXPECT_THAT(rows("envelope/envelope.csv", 6)[2], "300,200,throughout,,,20");
}

// What a user asked for stands on the console, a line a point: on the side that holds.
TEST_F(SweepCommand, AnEnvelopeAnswersOnTheConsole) {
  envelope.over = {"variables.limit=5,105.87,300 m/min"};
  envelope.find_max = {"variables.speed=20..200 m/min:0.9"};
  ASSERT_EQ(run_envelope(), all_passed) << err;
  double speed = 0;
  ASSERT_EQ(
      std::sscanf(out.c_str(),
                  "  5 m/min: fails everywhere: slow enough\n  105.87 m/min: %lf m/min, then slow enough\n",
                  &speed),
      1)
      << out;
  EXPECT_LE(speed, 105.87);
  EXPECT_GT(speed, 105.87 - 1);
  EXPECT_NEAR(10 * speed, std::rint(10 * speed), 1e-9) << "in digits that the tolerance warrants";
  EXPECT_THAT(
      out,
      AllOf(HasSubstr("\n  300 m/min: holds throughout to 200 m/min\n"),
            HasSubstr(fmt::format("\nLargest variables.speed: {} to 200 m/min over 3 points (± 0.9 m/min, "
                                  "rounded down); above it fails: slow enough (1 of 3 points); holds "
                                  "throughout to 200 m/min (1 of 3 points); fails everywhere (1 of 3 "
                                  "points)\n",
                                  speed))));
  // The row has what was found, to the last digit: what is told is not above it.
  EXPECT_LE(speed, std::stod(rows("envelope/envelope.csv", 2)[2].substr(7)));
}

TEST_F(SweepCommand, AnEnvelopeOfOnePointIsOneSentence) {
  envelope.set = {"variables.limit=105.87 m/min"};
  envelope.find_max = {"variables.speed=5..200 m/min:0.9"};
  ASSERT_EQ(run_envelope(), all_passed) << err;
  EXPECT_THAT(
      out, testing::ContainsRegex(
               "^Largest variables.speed: 105[.][0-9] m/min \\(± 0.9 m/min, rounded down\\); above it fails: "
               "slow enough; holds from [0-9.]+ m/min, not below\n1 point, [0-9]+ values tried, [0-9]+ "
               "passed, [0-9]+ failed: "));
}

TEST_F(SweepCommand, AnEnvelopeTellsWhatIsRefusedFromWhatFails) {
  envelope.set = {"variables.limit=1e9 m/min"};
  envelope.find_max = {"plants.web.speed=600..2400 m/min:100"};
  ASSERT_EQ(run_envelope(), all_passed) << err;
  EXPECT_THAT(out, AllOf(HasSubstr("it fails: refused: plants.web.speed is "), HasSubstr("out of range"),
                         HasSubstr(" refused (input wrong, not simulated): "), HasSubstr(" refused\n")));
}

// The shortest piece at a speed is such a question: the least speed that is fast enough.
TEST_F(SweepCommand, TheSmallestValueIsFoundAsTheLargestIs) {
  envelope.over = {"variables.least=40,105.87,165,290,400 m/min"};
  envelope.set = {"variables.limit=300 m/min"};
  envelope.find_min = {"variables.speed=5..310 m/min:0.25"};
  ASSERT_EQ(run_envelope(), all_passed) << err;
  const auto lines = rows("envelope/envelope.csv", 6);
  ASSERT_EQ(lines.size(), 6U);
  EXPECT_EQ(lines[0],
            "variables.least [m/min],variables.speed [m/min],verdict,limit,rating,holds to [m/min]");
  const std::vector<double> least = {40, 105.87, 165, 290};
  for (std::size_t i = 0; i < least.size(); ++i) {
    double limit = 0;
    double speed = 0;
    double upper = 0;
    ASSERT_EQ(std::sscanf(lines[i + 1].c_str(), "%lf,%lf,found,fast enough,,%lf", &limit, &speed, &upper), 3)
        << lines[i + 1];
    EXPECT_GE(speed, least[i]);
    EXPECT_LT(speed, least[i] + 0.25);
    EXPECT_LE(upper, 300);
  }
  EXPECT_EQ(lines[5], "400,,nowhere,slow enough,,");
  double told = 0;
  const auto at = out.find("  105.87 m/min: ");
  ASSERT_NE(at, std::string::npos) << out;
  ASSERT_EQ(std::sscanf(out.c_str() + at, "  105.87 m/min: %lf m/min, then fast enough; holds up to ", &told),
            1)
      << out;
  EXPECT_GE(told, 105.87) << "rounded up";
  EXPECT_LT(told, 105.87 + 0.35);
  EXPECT_THAT(out, AllOf(HasSubstr("\nSmallest variables.speed: "),
                         HasSubstr("(± 0.25 m/min, rounded up); below it fails: fast enough")));
  const auto text = text_of(folder / "envelope/envelope.csv");
  envelope.jobs = 3;
  ASSERT_EQ(run_envelope(), all_passed);
  EXPECT_EQ(text_of(folder / "envelope/envelope.csv"), text);
}

// A controller's length in whole tenths takes no half of a range: the value is asked for in the digits that
// the tolerance warrants, and what is refused for its digits bounds nothing.
TEST_F(SweepCommand, ValuesThatMustBeWholeAreTriedWhole) {
  envelope.scenarios = {source_root / "scenes/envelope/rotary_knife_camming4.yaml"};
  envelope.find_min = {"variables.length=700..901 mm:20"};
  ASSERT_EQ(run_envelope(), all_passed) << err;
  const auto line = rows("envelope/envelope.csv", 2)[1];
  double length = 0;
  ASSERT_EQ(std::sscanf(line.c_str(), "%lf,", &length), 1) << line;
  EXPECT_THAT(out, testing::Not(HasSubstr("refused (input wrong"))) << "no value of those that count";
}

TEST_F(SweepCommand, TheSmallestValueMayBeTheEndOfTheRange) {
  envelope.find_min = {"variables.speed=50..90 m/min:1"};
  ASSERT_EQ(run_envelope(), all_passed) << err;
  EXPECT_EQ(rows("envelope/envelope.csv", 5)[1], "50,throughout,,,90");
  EXPECT_THAT(out, HasSubstr("Smallest variables.speed: 50 m/min; holds throughout to 50 m/min\n"));
}

struct Resonance {
  double middle;
  double half;  ///< it fails within so much of the middle
};

// The nine values of the scan are 20, 55, 90, 125, 160 ... m/min, and the limit is 131: a scan alone finds
// it.
struct EnvelopeSearch : SweepCommand {
  /// The bound, and where it fails and holds again, with a web that shakes.
  struct Found {
    double bound = 0;
    double fails_from = 0;
    double fails_to = 0;
    double again = 0;
    std::string limit;
  };
  Found search(const Resonance& resonance) {
    folder.file("web.yaml", fmt::format("{}  - {{name: no resonance, always: abs(web.speed - {}) >= {}}}\n",
                                        scenario, resonance.middle, resonance.half));
    envelope.set = {"variables.limit=131 m/min"};
    envelope.find_max = {"variables.speed=20..300 m/min:0.5"};
    EXPECT_EQ(run_envelope(), all_passed) << err;
    const auto line = rows("envelope/envelope.csv", 7)[1];
    Found found;
    std::array<char, 64> limit{};
    const int read = std::sscanf(line.c_str(), "%lf,found,%63[^,],,20,%lf..%lf,%lf", &found.bound,
                                 limit.data(), &found.fails_from, &found.fails_to, &found.again);
    EXPECT_GE(read, 2) << line;
    found.limit = limit.data();
    return found;
  }
};

TEST_F(EnvelopeSearch, AnEnvelopeTellsThatItHoldsAgain) {
  const auto found = search({116, 4});
  EXPECT_EQ(found.limit, "no resonance");
  EXPECT_LE(found.bound, 112);
  EXPECT_GT(found.bound, 111.5);
  EXPECT_GT(found.fails_from, 112);
  EXPECT_LE(found.fails_from, 112.5);
  EXPECT_LT(found.fails_to, 120);
  EXPECT_GE(found.again, 120);
  EXPECT_LE(found.again, 125);
  EXPECT_THAT(out, testing::ContainsRegex("above it fails: no resonance; holds again at 12[0-9.]+ m/min"));
}

// The same from above: what fails over the smallest value is found, and where it holds again below.
TEST_F(EnvelopeSearch, ASmallestValueTellsThatItHoldsAgain) {
  folder.file("web.yaml", scenario + "  - {name: no resonance, always: abs(web.speed - 60) >= 4}\n");
  envelope.find_min = {"variables.speed=5..95 m/min:0.5"};
  ASSERT_EQ(run_envelope(), all_passed) << err;
  double bound = 0;
  double from = 0;
  double to = 0;
  double again = 0;
  const auto line = rows("envelope/envelope.csv", 7)[1];
  ASSERT_EQ(std::sscanf(line.c_str(), "%lf,found,no resonance,,95,%lf..%lf,%lf", &bound, &from, &to, &again),
            4)
      << line;
  EXPECT_GE(bound, 64);
  EXPECT_LT(bound, 64.5);
  EXPECT_GT(from, 56);
  EXPECT_LE(from, to);
  EXPECT_LT(to, 64);
  EXPECT_LE(again, 56);
  EXPECT_GT(again, 40);
}

// What is said of the search: no stretch stays unlooked at that is wider than a sixteenth of the range (17.5
// m/min) or a quarter of the way from its lower end to the bound.
TEST_F(EnvelopeSearch, WhatFailsBelowTheBoundIsFound) {
  for (const double middle : {30.0, 45.0, 72.0, 103.0, 110.0, 122.0, 127.5, 130.0}) {
    const double width = 1.05 * std::max(0.5, std::min(17.5, (131 - middle) / 4 / (1 - 1 / 8.0)));
    const auto found = search({middle, width / 2});
    EXPECT_LE(found.bound, middle - width / 2) << middle;
    EXPECT_GT(found.bound, middle - width / 2 - 0.5) << middle;
    EXPECT_EQ(found.limit, "no resonance") << middle;
  }
}

TEST_F(EnvelopeSearch, OnlyWhatHoldsAgainIsExplained) {
  search({116, 4});
  EXPECT_THAT(out, HasSubstr("drycut help maximum_speed"));
  search({500, 1});
  EXPECT_THAT(out, testing::Not(HasSubstr("maximum_speed")));
}

TEST_F(EnvelopeSearch, WithoutASuchItIsTheLimit) {
  const auto found = search({500, 1});
  EXPECT_LE(found.bound, 131);
  EXPECT_GT(found.bound, 130.5);
  EXPECT_EQ(found.limit, "slow enough");
  EXPECT_EQ(found.again, 0);
}

TEST_F(SweepCommand, SeveralScenesComeIntoOneTable) {
  folder.file("saw.yaml", "extends: web.yaml\nchecks: {slow enough: {always: web.speed <= 50}}\n");
  envelope.scenarios.push_back(folder / "saw.yaml");
  envelope.over = {"variables.limit=40,60 m/min", "saw:plants.web.thickness=1,2,3 mm"};
  envelope.find_max = {"web:variables.speed=5..300 m/min:0.25", "variables.speed=15..100 m/min:0.5"};
  ASSERT_EQ(run_envelope(), all_passed) << err;
  const auto lines = rows("envelope/envelope.csv", 6);
  ASSERT_EQ(lines.size(), 6U);
  EXPECT_EQ(text_of(folder / "envelope/envelope.csv").find("scene,variables.limit [m/min],variables.speed"),
            0U);
  EXPECT_THAT(text_of(folder / "envelope/envelope.csv"), HasSubstr(",plants.web.thickness [mm]\n"));
  for (std::size_t i = 1; i < lines.size(); ++i) {
    double speed = 0;
    const bool saw = i > 2;
    const std::vector<std::string> begins = {"web,40,", "web,60,", "saw,,", "saw,,", "saw,,"};
    ASSERT_TRUE(lines[i].starts_with(begins[i - 1])) << lines[i];
    ASSERT_EQ(std::sscanf(lines[i].c_str() + begins[i - 1].size(), "%lf,", &speed), 1) << lines[i];
    const double bound = saw ? 50 : i == 1 ? 40 : 60;
    EXPECT_LE(speed, bound);
    EXPECT_GT(speed, bound - (saw ? 0.5 : 0.25));
  }
  const auto text = text_of(folder / "envelope/envelope.csv");
  envelope.jobs = 3;
  ASSERT_EQ(run_envelope(), all_passed);
  EXPECT_THAT(out, HasSubstr("\n0 runs simulated"));
  EXPECT_EQ(text_of(folder / "envelope/envelope.csv"), text);
}

TEST_F(SweepCommand, BadScenesAreTold) {
  folder.file("saw.yaml", "extends: web.yaml\n");
  fs::create_directory(folder / "other");
  folder.file("other/web.yaml", scenario);
  const std::string speed = "variables.speed=20..180 m/min";
  struct Case {
    std::vector<std::string> over;
    std::vector<std::string> find_max;
    const char* second;
    const char* told;
  };
  for (const auto& [over, find_max, second, told] : {
           Case{{"lathe:variables.limit=1,2 m/min"},
                {speed},
                "saw.yaml",
                "--over:1:1: no scenario's name begins with 'lathe'; the scenarios are web, saw "
                "[study.unknown-name]"},
           Case{{}, {"web:" + speed}, "saw.yaml", "--find-max:1:1: nothing says what to find of saw"},
           Case{{}, {speed, speed}, "saw.yaml", "--find-max:1:1: there are 2 of them for web"},
           Case{{}, {speed}, "other/web.yaml", "there are two scenarios named web"},
           Case{{"saw:variables.limit=1,,2 m/min"}, {speed}, "saw.yaml", "--over:1:23: an empty value"},
           Case{{"saw:variables.limit=1,2"},
                {speed},
                "saw.yaml",
                "--over:1:21: saw: variables.limit is a speed, and no unit is given"},
           Case{{},
                {"saw:variables.speed=20..18 m/min", "web:" + speed},
                "saw.yaml",
                "--find-max:1:21: the range 20..18 m/min is empty"},
       }) {
    envelope.scenarios = {folder / "web.yaml", folder / second};
    envelope.over = over;
    envelope.find_max = find_max;
    EXPECT_EQ(run_envelope(), bad_input) << told;
    EXPECT_THAT(err, HasSubstr(told));
    EXPECT_FALSE(fs::exists(envelope.out));
  }
  // The largest and the smallest are not sought at once, and each is told by its option.
  envelope.scenarios = {folder / "web.yaml"};
  envelope.over.clear();
  envelope.find_max = envelope.find_min = {speed};
  EXPECT_EQ(run_envelope(), bad_input);
  EXPECT_THAT(err, HasSubstr("--find-max:1:1: --find-max and --find-min for web; one for all"));
  envelope.find_max.clear();
  envelope.find_min = {"variables.speed=20..18 m/min"};
  EXPECT_EQ(run_envelope(), bad_input);
  EXPECT_THAT(err, HasSubstr("--find-min:1:17: the range 20..18 m/min is empty"));
  envelope.find_min.clear();
  // What is wrong for all of them is told once.
  envelope.scenarios = {folder / "web.yaml", folder / "saw.yaml"};
  envelope.over = {"variables.limit=1,,2 m/min"};
  envelope.find_max = {speed};
  EXPECT_EQ(run_envelope(), bad_input);
  EXPECT_EQ(err.find("an empty value"), err.rfind("an empty value")) << err;
}

TEST_F(SweepCommand, BadBoundsAreTold) {
  for (const auto& [find_max, told] : std::vector<std::pair<std::string, std::string>>{
           {"variables.speed=20 m/min", "--find-max:1:17: '20 m/min' is no range"},
           {"variables.speed=20..180 m/min:0", "--find-max:1:31: '0' is no tolerance"},
           {"variables.speed=20..180 m/min:200", "'200' is no tolerance"},
           {"variables.speed=20..180 m/min:1 mm", "'1 mm' is no tolerance"},
           {"variables.speed=180..20 m/min", "is empty"},
           {"variables.sped=20..180 m/min", "did you mean speed?"},
           {"variables.speed=20..180", "--find-max:1:17: variables.speed is a speed, and no unit is given"},
           {"variables.speed=20..180 mm", "variables.speed is a speed, not a length"},
           {"variables.limit=20..180 m/min", "variables.limit is given twice"}}) {
    envelope.over = {"variables.limit=40..290 m/min:3"};
    envelope.find_max = {find_max};
    EXPECT_EQ(run_envelope(), bad_input) << find_max;
    EXPECT_THAT(err, HasSubstr(told)) << find_max;
    EXPECT_FALSE(fs::exists(envelope.out));
  }
}

}  // namespace
}  // namespace drycut::sim::cli
