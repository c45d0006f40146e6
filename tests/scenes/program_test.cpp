// The program as a user calls it: exit status, what it writes, what it leaves alone.
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/test_folder.hpp"

namespace {

namespace fs = std::filesystem;

struct Result {
  int status = -1;
  std::string text;  ///< standard output and error
};

Result call(const std::string& arguments) {
  Result result;
  const auto command = std::string(DRYCUT_PROGRAM) + " " + arguments + " 2>&1";
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return result;
  std::array<char, 4096> buffer{};
  while (const auto count = fread(buffer.data(), 1, buffer.size(), pipe))
    result.text.append(buffer.data(), count);
  result.status = WEXITSTATUS(pclose(pipe));
  return result;
}

std::string contents(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::stringstream text;
  text << stream.rdbuf();
  return text.str();
}

const std::string scenes = std::string(DRYCUT_SOURCE_DIR) + "/scenes/";

struct ProgramTest : testing::Test {
  drycut::TestFolder folder;
  fs::path out = folder / "out";
  std::string to() const { return " --out " + out.string(); }
};

TEST_F(ProgramTest, FramesAreTheSameForAnyNumberOfRasteriserThreads) {
  std::vector<std::string> frames;
  for (const char* threads : {"0", "1", "3"}) {
    ASSERT_EQ(setenv("LP_NUM_THREADS", threads, 1), 0);
    const auto result =
        call("run " + scenes +
             "rotary_knife_short.yaml --set scene.duration='3 s' --set pictures.frames.every='1 s'" + to());
    EXPECT_TRUE(fs::exists(out / "rotary_knife_short/frames/frame_00002.png")) << result.text;
    frames.push_back(contents(out / "rotary_knife_short/frames/frame_00002.png"));
  }
  unsetenv("LP_NUM_THREADS");
  EXPECT_GT(frames[0].size(), 1000U);
  EXPECT_TRUE(frames[0] == frames[1]);
  EXPECT_TRUE(frames[0] == frames[2]);
}

TEST_F(ProgramTest, RunWritesWhatTheContractSays) {
  const auto result = call("run " + scenes + "rotary_knife_short.yaml --set scene.duration='5 s'" + to());
  EXPECT_EQ(result.status, 0) << result.text;
  EXPECT_THAT(result.text, testing::HasSubstr("rotary_knife_short: passed, all 13 checks passed"));
  const auto folder = out / "rotary_knife_short";
  for (const auto* name : {"trace.csv", "events.csv", "checks.json", "report.html", "plots/motion.png",
                           "frames/frame_00000.png"}) {
    EXPECT_TRUE(fs::exists(folder / name)) << name;
  }
  EXPECT_THAT(
      contents(out / "junit.xml"),
      testing::HasSubstr("<testsuite name=\"rotary_knife_short\" tests=\"13\" failures=\"0\" errors=\"0\" "));
  EXPECT_THAT(contents(folder / "trace.csv"), testing::StartsWith("time [s],AxisX.posit [Um],"));
  EXPECT_THAT(contents(folder / "events.csv"), testing::HasSubstr(",knife,cut,length=500"));
}

TEST_F(ProgramTest, WithoutHelpersTheVerdictStandsAndTheReportIsWritten) {
  const auto path = drycut::search_path();
  setenv("PATH", "/nonexistent", 1);
  const auto result = call("run " + scenes +
                           "rotary_knife_short.yaml --set scene.duration='5 s' --set pictures.video=true "
                           "--set pictures.frames.every='2 s'" +
                           to());
  setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(result.status, 0) << result.text;
  EXPECT_THAT(result.text,
              testing::AllOf(testing::HasSubstr("rotary_knife_short: passed, all 13 checks passed"),
                             testing::HasSubstr(
                                 "left out: video: there is no ffmpeg; install ffmpeg [run.left-out]\n")));
  EXPECT_THAT(contents(out / "rotary_knife_short/report.html"),
              testing::HasSubstr("<li>left out: video: there is no ffmpeg; install ffmpeg</li>"));
  EXPECT_FALSE(fs::exists(out / "rotary_knife_short/film.mp4"));
}

// While pictures are made the run is not at its end: who is ended there leaves no verdict.
TEST_F(ProgramTest, TheVerdictIsWrittenLast) {
  fs::create_directories(out / "bin");
  const auto ffmpeg = out / "bin/ffmpeg";
  std::ofstream(ffmpeg) << "#!/bin/sh\ncp '" << (out / "rotary_knife_short/checks.json").string() << "' '"
                        << (out / "seen.json").string() << "'\nexit 1\n";
  fs::permissions(ffmpeg, fs::perms::owner_all);
  const auto path = drycut::search_path();
  setenv("PATH", ((out / "bin").string() + ":" + path).c_str(), 1);
  call("run " + scenes +
       "rotary_knife_short.yaml --set scene.duration='5 s' --set pictures.video=true "
       "--set pictures.frames.every='2 s'" +
       to());
  setenv("PATH", path.c_str(), 1);
  EXPECT_THAT(contents(out / "seen.json"), testing::HasSubstr("the run has not come to its end"));
}

TEST_F(ProgramTest, WhatStandardOutputDoesNotTakeIsNoSuccess) {
  EXPECT_EQ(call("check --expand " + scenes + "rotary_knife_short.yaml >/dev/full").status, 3);
  EXPECT_EQ(call("devices >/dev/full").status, 3);
}

TEST_F(ProgramTest, ArgumentsThatAreNoTextAreRefused) {
  const auto bell = call("check \"$(printf 'a\\033[31m.yaml')\"");
  EXPECT_EQ(bell.status, 2);
  EXPECT_EQ(bell.text, "drycut: in argument 2 byte 0x1b is no text: a\\x1B[31m.yaml [option.value]\n");
  EXPECT_EQ(call("check \"$(printf 'a\\377.yaml')\"").status, 2);
  const auto nowhere = call("run " + scenes + "rotary_knife_short.yaml --out ''");
  EXPECT_EQ(nowhere.status, 2);
  EXPECT_THAT(nowhere.text, testing::HasSubstr("--out: it is empty; name a folder"));
}

TEST_F(ProgramTest, SameBytesTwiceAndAtAnyNumberOfJobs) {
  const std::string both =
      scenes + "rotary_knife_short.yaml " + scenes + "rotary_knife_equal.yaml --no-pictures";
  ASSERT_EQ(call("run " + both + " --out " + (out / "a").string()).status, 0);
  ASSERT_EQ(call("run " + both + " --out " + (out / "b").string() + " --jobs 2").status, 0);
  for (const auto* name :
       {"rotary_knife_short/trace.csv", "rotary_knife_short/events.csv", "rotary_knife_equal/trace.csv",
        "rotary_knife_equal/events.csv", "rotary_knife_equal/checks.json", "junit.xml"}) {
    const auto first = contents(out / "a" / name);
    EXPECT_FALSE(first.empty()) << name;
    EXPECT_EQ(first, contents(out / "b" / name)) << name;
  }
}

TEST_F(ProgramTest, FailedCheckIsStatusOne) {
  const auto result = call("run " + std::string(DRYCUT_SOURCE_DIR) +
                           "/tests/scenes/failing/wrong_feed_forward.yaml --no-pictures" + to());
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.text, testing::AllOf(testing::HasSubstr("wrong_feed_forward: FAILED, "),
                                          testing::HasSubstr("FAIL cut length: ")));
  EXPECT_THAT(contents(out / "junit.xml"), testing::HasSubstr("<failure message="));
}

TEST_F(ProgramTest, BadInputIsStatusTwoAndWritesNothing) {
  const auto result =
      call("run " + scenes + "rotary_knife_short.yaml --set plants.web.sped='1 m/min'" + to());
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.text, testing::HasSubstr("sped"));
  EXPECT_FALSE(fs::exists(out));
  EXPECT_EQ(call("run " + scenes + "none.yaml" + to()).status, 2);
  EXPECT_EQ(call("run").status, 2);
  EXPECT_EQ(call("jump").status, 2);
  EXPECT_EQ(call("run " + scenes + "rotary_knife.yaml --jobs 0").status, 2);
}

TEST_F(ProgramTest, AnUnknownCommandIsNamedWithTheNearest) {
  const auto close = call("tuen");
  EXPECT_EQ(close.status, 2);
  EXPECT_THAT(close.text, testing::HasSubstr("drycut: there is no command 'tuen'; did you mean tune?"));
  const auto far = call("blah scenes");
  EXPECT_EQ(far.status, 2);
  EXPECT_THAT(far.text, testing::HasSubstr("drycut: there is no command 'blah'; known: run, "));
  EXPECT_THAT(far.text, testing::Not(testing::HasSubstr("reference")));  // for those who build it
}

TEST_F(ProgramTest, AnUnknownOptionIsNamedWithTheNearest) {
  const auto close = call("run " + scenes + "rotary_knife.yaml --no-picture" + to());
  EXPECT_EQ(close.status, 2);
  EXPECT_THAT(close.text,
              testing::HasSubstr("drycut run: there is no option --no-picture; did you mean --no-pictures?"));
  const auto far = call("devices CAMMING4 --xyz=3");
  EXPECT_EQ(far.status, 2);
  EXPECT_THAT(far.text, testing::HasSubstr("drycut devices: there is no option --xyz; known: "));
  EXPECT_FALSE(fs::exists(out));
}

// Each names its command, what is wrong and what would be right.
TEST_F(ProgramTest, CommandLinesThatCannotBeRead) {
  struct Case {
    const char* line;
    std::vector<const char*> told;
  };
  const std::vector<Case> cases = {
      {"", {"drycut: no command is given; known: run, live, replay, check, test, cam, "}},
      {"run",
       {"drycut run:1:1: no scenario is named; drycut run SCENARIO.yaml, or drycut run --resume DIR "
        "[option.missing]\n"}},
      {"run x.yaml --out",
       {"drycut run: --out has no value; give one: Directory for the results [option.missing]\n"}},
      {"run x.yaml --jobs 0",
       {"drycut run: --jobs: '0' is no number in its range; give 1 to 256 [option.value]\n"}},
      {"run x.yaml --jobs many",
       {"drycut run: --jobs: 'many' is no number in its range; give 1 to 256 [option.value]\n"}},
      {"run x.yaml --seed x", {"drycut run: --seed: 'x' is no number; give one [option.value]\n"}},
      {"run x.yaml --sed 3 --job 4",
       {"drycut run: there is no option --sed; did you mean --se",
        "drycut run: there is no option --job; did"}},
      {"tune --vray x=1..2",
       {"drycut tune: there is no option --vray; did you mean --vary? [option.unknown]\n",
        "drycut tune: --vary is missing; give it: PATH=LO..HI[:integer], such as ",
        "drycut tune: --minimise is missing; give it: Metric, such as rms(AxisX.follerr)"}},
      {"bode a.yaml b.yaml",
       {"drycut bode: nothing takes 'b.yaml'; drycut bode --help says what it takes [option.unknown]\n"}},
      {"bode a.yaml -x", {"drycut bode: there is no option -x; known: "}},
      {"cam x.csv --device lx3pv",
       {"drycut cam: --device: there is no 'lx3pv'; did you mean lx3vp? [option.unknown-choice]\n"}},
      {"cam x.csv --max-velocity fast",
       {"drycut cam: --max-velocity: 'fast' is no number; give one [option.value]\n"}},
      {"check", {"drycut check: files are missing; give it: Scenarios and recordings (.yaml), "}},
      {"check --schema x",
       {"drycut check: files and --schema do not go together; leave one of them out [option.together]\n"}},
      {"design",
       {"drycut design: job is missing; give it: rotary_knife, flying_saw or feed [option.missing]\n"}},
      {"design feed --blades 200",
       {"drycut design: --blades: '200' is no number in its range; give 1 to 100 [option.value]\n"}},
      {"sweep", {"drycut sweep: scenario is missing; ", "drycut sweep: --over is missing; "}},
      {"envelope x.yaml", {"drycut envelope: --find-max is missing; "}},
      {"compare", {"drycut compare: runs are missing; "}},
      {"devices a b", {"drycut devices: nothing takes 'b'; "}},
      {"plants a b", {"drycut plants: nothing takes 'b'; "}},
  };
  for (const auto& [line, all] : cases) {
    const auto result = call(line);
    EXPECT_EQ(result.status, 2) << line;
    for (const auto* told : all) EXPECT_THAT(result.text, testing::HasSubstr(told)) << line;
    EXPECT_EQ(std::count(result.text.begin(), result.text.end(), '\n'), all.size()) << line << result.text;
  }
  EXPECT_EQ(call("--help").status, 0);
  EXPECT_EQ(call("tune --help").status, 0);
}

TEST_F(ProgramTest, CheckTakesOverrides) {
  const auto file = scenes + "backlash_motor_encoder.yaml";
  const auto sound = call("check --expand " + file + " --set controller.qmove.set.Axis.pgain=12");
  EXPECT_EQ(sound.status, 0) << sound.text;
  EXPECT_THAT(sound.text, testing::HasSubstr("set: {Axis.pgain: 12}"));
  const auto wrong = call("check " + file + " --set controller.qmove.set.Axis.pgian=12 --set gap");
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.text, testing::HasSubstr("the controller has nothing called 'Axis.pgian'"));
  EXPECT_THAT(wrong.text, testing::HasSubstr("--set:1:1: 'gap' is not an assignment; write path=value"));
}

TEST_F(ProgramTest, DivergedSimulationIsStatusThreeAndKeepsWhatItHas) {
  // A motor fifty times as fast as the loop is tuned for, and strong enough to get there.
  const auto result = call("run " + scenes +
                           "rotary_knife_short.yaml --no-pictures"
                           " --set plants.knife.servo.peak_torque='100000 N m'"
                           " --set plants.knife.servo.speed_at_10v='100000 rpm'"
                           " --set plants.knife.servo.max_speed='100000 rpm'"
                           " --set plants.knife.servo.rated_torque='10000 N m'"
                           " --set plants.knife.servo.supply.overvoltage='400 %'"
                           " --set plants.knife.servo.supply.capacitance='1000000 uF'" +
                           to());
  EXPECT_EQ(result.status, 3) << result.text;
  EXPECT_THAT(result.text, testing::HasSubstr("STOPPED, the simulation stopped: knife"));
  EXPECT_FALSE(contents(out / "rotary_knife_short/trace.csv").empty());
  EXPECT_THAT(contents(out / "junit.xml"), testing::HasSubstr("<error message="));
}

TEST_F(ProgramTest, UnwritableDirectoryIsToldBeforeAnythingRuns) {
  fs::create_directories(out);
  std::ofstream(out / "rotary_knife_short") << "a file where a directory must be";
  const auto result = call("run " + scenes + "rotary_knife_short.yaml --no-pictures" + to());
  EXPECT_EQ(result.status, 2) << result.text;
  EXPECT_THAT(result.text, testing::HasSubstr("--out:1:1: the directory " +
                                              (out / "rotary_knife_short").string() + " cannot be made"));
}

TEST_F(ProgramTest, AProgramThatDiesFailsTheRunAndSaysWhere) {
  fs::create_directories(out);
  std::ofstream(out / "dies.cnf") << "GLOBAL\nglN L\nEND\n";
  std::ofstream(out / "dies.mod") << "WAIT 1\nglN = 5 / glN\nEND\n";
  std::ofstream(out / "dies.yaml") << "scene: {duration: 100 ms}\nplants: {}\n"
                                      "controller: {qmove: {configuration: dies.cnf, tasks: [dies.mod]}}\n"
                                      "record: {every: 2 ms, channels: [glN]}\n";
  const auto result =
      call("run " + (out / "dies.yaml").string() + " --no-pictures --out " + (out / "results").string());
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.text,
              testing::AllOf(testing::HasSubstr("FAIL the program runs: "), testing::HasSubstr("dies.mod:2"),
                             testing::HasSubstr("division by zero")));
}

TEST_F(ProgramTest, ScenariosWithOneNameAreRefused) {
  const auto file = scenes + "rotary_knife_short.yaml";
  const auto result = call("run " + file + " " + file + to());
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.text, testing::HasSubstr("its results would overwrite those of"));
}

TEST_F(ProgramTest, ExpandReadsBackAsItself) {
  const auto first = call("check --expand " + scenes + "rotary_knife.yaml");
  ASSERT_EQ(first.status, 0) << first.text;
  fs::create_directories(out);
  // Program paths are relative to the scenario, so the copy needs the programs beside it.
  fs::copy(scenes + "programs", out / "programs");
  std::ofstream(out / "copy.yaml") << first.text;
  const auto second = call("check --expand " + (out / "copy.yaml").string());
  EXPECT_EQ(second.status, 0) << second.text;
  EXPECT_EQ(first.text, second.text);
}

TEST_F(ProgramTest, RetentiveValuesAreKeptInTheFileThatTheScenarioNames) {
  fs::create_directories(out);
  std::ofstream(out / "count.cnf") << "SYSTEM\nslRuns L\nGLOBAL\nglRuns L\nEND\n";
  std::ofstream(out / "count.mod") << "slRuns = slRuns + 1\nglRuns = glRuns + 1\nEND\n";
  std::ofstream(out / "count.yaml")
      << "scene: {duration: 100 ms}\nplants: {}\n"
         "controller: {qmove: {configuration: count.cnf, tasks: [count.mod], retentive: kept.txt}}\n"
         "timeline: [{at: 20 ms, power: off}, {at: 40 ms, power: on}]\n"
         "record: {every: 2 ms, channels: [slRuns, glRuns]}\n";
  const auto run =
      "run " + (out / "count.yaml").string() + " --no-pictures --out " + (out / "results").string();
  EXPECT_EQ(call(run).status, 0);
  EXPECT_THAT(contents(out / "kept.txt"), testing::HasSubstr("slRuns = 2\n")) << "a power cycle counts";
  EXPECT_EQ(call(run).status, 0);
  EXPECT_THAT(contents(out / "kept.txt"), testing::HasSubstr("slRuns = 4\n"))
      << "and goes on in the next run";
  EXPECT_THAT(contents(out / "results/count/trace.csv"), testing::EndsWith("\n0.1,4,1\n"));
  std::ofstream(out / "kept.txt") << "slRuns = many\n";
  const auto broken = call(run);
  EXPECT_EQ(broken.status, 2);
  EXPECT_THAT(broken.text, testing::HasSubstr("kept.txt:1:"));
}

TEST_F(ProgramTest, CheckTakesAModuleAgainstTheConfigurationBeforeIt) {
  EXPECT_EQ(
      call("check " + scenes + "programs/rotary_knife.cnf " + scenes + "programs/rotary_knife.mod").status,
      0);
  const auto alone = call("check " + scenes + "programs/rotary_knife.mod");
  EXPECT_EQ(alone.status, 2);
  EXPECT_THAT(alone.text, testing::HasSubstr("rotary_knife.mod:1:1: a QCL module needs a configuration to be "
                                             "checked against; name its .cnf file before it"));
  EXPECT_EQ(call("check README.doc").status, 2);
}

TEST_F(ProgramTest, TablesAreComplete) {
  const auto device = call("devices camming4 --json");
  EXPECT_EQ(device.status, 0);
  for (const auto* name :
       {"\"codeG\"", "\"syncrange\"", "\"STARTCAM\"", "\"st_sync\"", "\"retention\"", "\"condition\""}) {
    EXPECT_THAT(device.text, testing::HasSubstr(name));
  }
  const auto plant = call("plants rotary_knife");
  EXPECT_EQ(plant.status, 0);
  for (const auto* name : {"circumference", "servo.reference", "blade.speed", "lose_counts", "buckle"}) {
    EXPECT_THAT(plant.text, testing::HasSubstr(name));
  }
  EXPECT_EQ(call("plants --json").status, 0);
  const auto axis = call("plants backlash_axis");
  EXPECT_THAT(axis.text, testing::ContainsRegex("drive\\.forward .*\\(drive: inverter, contactors\\)\n"));
  EXPECT_THAT(axis.text, testing::ContainsRegex("servo\\.reference .*\\(drive: servo\\)\n"));
  EXPECT_THAT(call("plants backlash_axis --json").text,
              testing::ContainsRegex("\"drives\": \\[[ \n]*\"inverter\",[ \n]*\"contactors\"[ \n]*\\]"));
  const auto wrong = call("devices CAMING4");
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.text, testing::HasSubstr("did you mean CAMMING4?"));
}

}  // namespace
