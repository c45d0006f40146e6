// Cams that `drycut design` makes, in the shipped scenes of the knife and the saw under each controller: the
// scenes' own checks hold.
#include <fmt/format.h>

#include <gmock/gmock.h>

#include <cmath>

#include "sim/cli/design_command.hpp"
#include "sim/cli/new_command.hpp"
#include "sim/loop/simulation.hpp"
#include "tests/test_folder.hpp"

namespace drycut::sim {
namespace {

namespace fs = std::filesystem;

const fs::path scenes = fs::path(DRYCUT_SOURCE_DIR) / "scenes";

cli::DesignOptions knife_job(const std::string& goal = "rms") {
  cli::DesignOptions options;
  options.kind = "rotary_knife";
  options.length = "800 mm";
  options.circumference = "600 mm";
  options.sync = "120 mm";
  options.speed = "60 m/min";
  options.minimise = goal;
  return options;
}
cli::DesignOptions saw_job(const std::string& goal = "rms") {
  cli::DesignOptions options;
  options.kind = "flying_saw";
  options.length = "660 mm";
  options.sync = "190 mm";
  options.speed = "40 m/min";
  options.minimise = goal;
  return options;
}

/// A scenario, to its end.
struct Ran {
  Problems problems;
  scenario::Scenario scenario;
  std::unique_ptr<loop::Simulation> simulation;
  record::Outcome outcome;
  explicit Ran(const fs::path& file, const std::vector<scenario::Override>& overrides = {})
      : scenario(scenario::read_scenario(file, overrides, problems)) {
    scenario.pictures.frames = false;
    simulation = std::make_unique<loop::Simulation>(scenario, problems);
    EXPECT_EQ(lines_of(problems), "");
    outcome = simulation->run();
  }
  std::vector<std::string> failed() const {
    std::vector<std::string> names;
    for (const auto& check : outcome.checks)
      if (!check.passed) names.push_back(check.name + ": " + check.detail);
    return names;
  }
};

void expect_passed(const Ran& run, std::size_t checks) {
  EXPECT_GE(run.outcome.checks.size(), checks);
  EXPECT_THAT(run.failed(), testing::IsEmpty());
}

struct DesignedCams : testing::Test {
  /// drycut design --device ... --table ... --scene ...: the scenario that plays the table.
  fs::path design(cli::DesignOptions options, const std::string& device, const fs::path& scene) {
    options.device = device;
    if (options.table.empty()) options.table = folder / "cam.csv";
    options.scene = scene;
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    EXPECT_EQ(cli::design_cam(options), cli::all_passed);
    testing::internal::GetCapturedStdout();
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    return fs::path(options.table).replace_extension(".yaml");
  }
  /// What is told of a job that the scene cannot take; nothing is written.
  std::string refused(cli::DesignOptions options, const std::string& device, const fs::path& scene) {
    options.device = device;
    options.table = folder / "refused.csv";
    options.scene = scene;
    testing::internal::CaptureStderr();
    EXPECT_EQ(cli::design_cam(options), cli::bad_input);
    EXPECT_FALSE(fs::exists(options.table));
    return testing::internal::GetCapturedStderr();
  }
  /// The shipped knife has 0.05 mm a pulse of the wheel and 20000 a turn, the saw 0.02 mm.
  static cli::DesignOptions in_pulses(cli::DesignOptions options) {
    options.master_pulse = "0.05 mm";
    options.slave_pulse = options.kind == "rotary_knife" ? "600 mm/20000" : "0.02 mm";
    return options;
  }

  TestFolder folder;
};

TEST_F(DesignedCams, KnifeUnderCamming4) {
  expect_passed(Ran(design(knife_job(), "camming4", scenes / "rotary_knife.yaml")), 9);
}
TEST_F(DesignedCams, KnifeUnderLx3vp) {
  expect_passed(Ran(design(in_pulses(knife_job()), "lx3vp", scenes / "rotary_knife_lx3vp.yaml")), 10);
}
TEST_F(DesignedCams, KnifeUnderMcCamIn) {
  for (const auto* goal : {"rms", "jerk"}) {
    SCOPED_TRACE(goal);
    expect_passed(Ran(design(knife_job(goal), "mc_camin", scenes / "rotary_knife_mc_camin.yaml")), 10);
  }
}
TEST_F(DesignedCams, SawUnderCamming4) {
  expect_passed(Ran(design(saw_job(), "camming4", scenes / "flying_saw.yaml")), 9);
}
TEST_F(DesignedCams, SawUnderLx3vp) {
  expect_passed(Ran(design(in_pulses(saw_job()), "lx3vp", scenes / "flying_saw_lx3vp.yaml")), 11);
}
// The scene wants the carriage within 1 mm and where it was a cycle ago: that takes a cam without steps.
TEST_F(DesignedCams, SawUnderMcCamIn) {
  expect_passed(Ran(design(saw_job("jerk"), "mc_camin", scenes / "flying_saw_mc_camin.yaml")), 9);
}

// Another length: the scene's variable goes with the table.
TEST_F(DesignedCams, TheLengthGoesWithTheTable) {
  auto job = knife_job();
  job.length = "700 mm";
  const Ran run(design(job, "camming4", scenes / "rotary_knife.yaml"));
  expect_passed(run, 9);
  EXPECT_EQ(run.scenario.variables.at(0).value.text, "700 mm");
}

// And so does the speed; where the scene sets that itself, the scenario says so.
TEST_F(DesignedCams, TheSpeedGoesWithTheTable) {
  auto job = knife_job();
  job.speed = "75 m/min";
  const Ran run(design(job, "camming4", scenes / "rotary_knife.yaml"));
  expect_passed(run, 9);
  EXPECT_THAT(scenario::expand(run.scenario), testing::HasSubstr("speed: 75 m/min"));
  std::ifstream made(design(job, "camming4", scenes / "rotary_knife_ramp.yaml"));
  EXPECT_THAT((std::string{std::istreambuf_iterator<char>(made), {}}),
              testing::HasSubstr("# The scene sets the speed of its web itself"));
}

// A table for another machine is none for the scene.
TEST_F(DesignedCams, AnotherMachineIsRefused) {
  auto job = knife_job();
  job.circumference = "500 mm";
  EXPECT_THAT(refused(job, "lx3vp", scenes / "rotary_knife_lx3vp.yaml"),
              testing::HasSubstr("has a drum of 600 mm, the job one of 500 mm"));
  EXPECT_THAT(refused(saw_job(), "lx3vp", scenes / "rotary_knife_lx3vp.yaml"),
              testing::HasSubstr("--scene:1:1: "));
  job = knife_job();
  job.master_pulse = "0.01 mm";
  EXPECT_THAT(refused(job, "lx3vp", scenes / "rotary_knife_lx3vp.yaml"),
              testing::AllOf(testing::HasSubstr("--master-pulse:1:1: 0.01 mm a pulse; "),
                             testing::HasSubstr(" has 0.05 mm at C251; leave it out")));
  job = knife_job();
  job.thickness = "2 mm";
  EXPECT_THAT(refused(job, "lx3vp", scenes / "rotary_knife_lx3vp.yaml"),
              testing::HasSubstr("--thickness \"0.5 mm\", or another scene"));
}

// What a pulse is stands in the scene: its wheel, gear and drive.
TEST_F(DesignedCams, PulsesAreThoseOfTheScene) {
  for (const auto& [job, scene] :
       {std::pair{knife_job(), "rotary_knife_lx3vp.yaml"}, {saw_job(), "flying_saw_lx3vp.yaml"}}) {
    const auto bytes = [&, line = scenes / scene](const cli::DesignOptions& options) {
      design(options, "lx3vp", line);
      std::ifstream file(folder / "cam.csv");
      return std::string{std::istreambuf_iterator<char>(file), {}};
    };
    const auto given = bytes(in_pulses(job));
    EXPECT_EQ(bytes(job), given);
    EXPECT_THAT(given, testing::HasSubstr(job.kind == "rotary_knife" ? "\n16000,20000\n" : "\n13200,0\n"));
  }
}

// Every line that drycut new makes takes a cam that is designed for it, whether of its own length or another;
// one without a cam says so.
TEST_F(DesignedCams, EveryNewLineTakesOne) {
  for (const auto& start : cli::starts()) {
    SCOPED_TRACE(start.machine + " " + start.controller);
    const auto line = folder / (start.machine + start.controller);
    testing::internal::CaptureStdout();
    EXPECT_EQ(cli::make_line({.folder = line, .machine = start.machine, .controller = start.controller}),
              cli::all_passed);
    testing::internal::GetCapturedStdout();
    const auto* device = start.controller == "qmove"   ? "camming4"
                         : start.controller == "lx3vp" ? "lx3vp"
                                                       : "mc_camin";
    const bool knife = start.machine == "rotary_knife";
    if (!knife && start.machine != "flying_saw") {
      EXPECT_THAT(refused(saw_job(), device, line / "line.yaml"), testing::HasSubstr("plays no cam"));
      continue;
    }
    for (const bool same : {true, false}) {
      SCOPED_TRACE(same);
      auto job = knife ? knife_job() : saw_job();
      job.length = knife ? (same ? "800 mm" : "700 mm") : (same ? "1 m" : "1.2 m");
      job.sync = knife ? (same ? "120 mm" : "80 mm") : "270 mm";
      if (!knife) job.speed = "34 m/min";
      if (same && start.controller == "plcopen") {
        job.table = folder / "cam.tab";
        const auto tab = design(job, device, line / "line.yaml");
        expect_passed(Ran(tab), 8);
        continue;
      }
      expect_passed(Ran(design(job, device, line / "line.yaml")), 8);
    }
  }
}

// Through thick material the blade keeps the web's speed along it: without that it comes in with 1 - 3 / 95.5
// of it.
TEST_F(DesignedCams, TheBladeSwingsThroughTheMaterialAtTheWebsSpeed) {
  const auto scene =
      folder.file("thick.yaml", "extends: " + (scenes / "new/rotary_knife_plcopen.yaml").string() +
                                    "\nvariables: {speed: 20 m/min}\n"
                                    "plants: {web: {thickness: 3 mm, shear_strength: 0.3 MPa}}\n"
                                    "checks:\n  even: {each: cut, from: 7 s, expect: abs(mismatch) <= 4}\n");
  auto job = knife_job();
  job.speed = "20 m/min";
  job.sync = "80 mm";
  EXPECT_THAT(Ran(design(job, "mc_camin", scene)).failed(),
              testing::ElementsAre(testing::StartsWith("even")));
  job.thickness = "3 mm";
  expect_passed(Ran(design(job, "mc_camin", scene)), 10);
}

/// A feed of 120 mm in 300 mm of the master, of which it rests for 100 mm.
cli::DesignOptions feed_job() {
  cli::DesignOptions options;
  options.kind = "feed";
  options.length = "300 mm";
  options.feed = "120 mm";
  options.sync = "100 mm";
  options.speed = "30 m/min";
  return options;
}

// On a bench: the master is the PLC's own pulses, so all is exact. 0.01 mm of the master and 0.02 mm of the
// slave a pulse.
TEST_F(DesignedCams, FeedUnderLx3vp) {
  folder.file("feed.il",
              "LD M8002\nDMOV K200000 D1006\nMOV K1 D1023\nMOV K1 D1024\nMOV K1 D1029\nMOV K1 D1030\n"
              "LD M8000\nOUT C235 K2147483647\nLD M0\nDPLSV K30000 Y1 Y5\n"
              "LD M0\nDECAM C235 D1000 M15 Y0 Y4\nLDP M0\nMOV K1 D1005\nEND\n");
  const auto scene = folder.file(
      "bench.yaml",
      "scene: {duration: 4 s}\nplants: {bench: {type: bench}}\n"
      "controller: {lx3vp: {program: feed.il}}\nwiring: {C235: Y1}\n"
      "timeline: [{at: 100 ms, set: {M0: 1}}]\nrecord: {every: 1 ms, channels: [DD1025, DD1019, DD8140]}\n"
      "checks:\n  - {name: at rest, always: \"DD1025 > 10000 || DD1019 == 0\"}\n"
      "  - {name: goes on, eventually: DD1019 > 5990}\n"
      "  - {name: three pieces, eventually: DD8140 == 18000}\n"
      "  - {name: no more, always: DD8140 <= 24000}\n  - {name: no error, always: M8067 == 0}\n");
  auto job = feed_job();
  job.master_pulse = "0.01 mm";
  job.slave_pulse = "0.02 mm";
  expect_passed(Ran(design(job, "lx3vp", scene)), 6);
}

TEST_F(DesignedCams, FeedUnderCamming4) {
  folder.file("feed.cnf",
              "SYSTEM\nslZone L\nBUS\n1 1CPUB 02\n2 1MIXA 00\nINTDEVICE\n"
              "AxisX CAMMING4 2 2.CNT01 2.CNT02 X.X X X.X X X.X X.X X 2.AN01 X.X\nEND\n");
  folder.file("feed.mod",
              "AxisX:decpt = 1\nAxisX:measure = 1\nAxisX:pulse = 10\nAxisX:measurem = 5000\n"
              "AxisX:pulsem = 10000\nAxisX:maxvel = 60000\nAxisX:minpos = - 999999\nAxisX:maxpos = 999999\n"
              "AxisX:maxfollerr = 1000\nAxisX:feedfw = 1000\nAxisX:pgain = 100\nINIT AxisX\n"
              "WAIT AxisX:st_init\nLOOPON AxisX\nWAIT AxisX:st_loopon\nCNTUNLOCK AxisX\nCNTDIR AxisX\n"
              "CNTUNLOCKM AxisX\nCNTDIRM AxisX\nREGON AxisX\nWAIT NOT AxisX:st_regoff\nAxisX:posit = 0\n"
              "AxisX:positm = 0\nSTARTCAM AxisX\nMAIN:\nWAIT 1\nJUMP MAIN\nEND\n");
  const auto scene =
      folder.file("line.yaml",
                  "scene: {duration: 4 s}\nplants:\n  web: {type: web, speed: 30 m/min}\n"
                  "  axis: {type: ideal_axis, speed_at_10v: 60 m/min, resolution: 0.01 mm}\n"
                  "controller: {qmove: {configuration: feed.cnf, tasks: [feed.mod]}}\n"
                  "wiring: {2.CNT01: axis.encoder, 2.CNT02: web.wheel, 2.AN01: axis.reference}\n"
                  "record: {every: 2 ms, channels: [AxisX.positm, AxisX.rowex, axis.position]}\nchecks:\n"
                  "  - {name: at rest after whole feeds, from: 100 ms, always: \"AxisX.rowex != 1 || "
                  "AxisX.positm < 300 || "
                  "abs(axis.position - 120 * rint(axis.position / 120)) <= 0.1\"}\n"
                  "  - {name: six feeds, eventually: abs(axis.position - 720) <= 0.1}\n"
                  "  - {name: no more, always: axis.position <= 840}\n  - {name: no error, always: "
                  "AxisX.st_error == 0}\n");
  expect_passed(Ran(design(feed_job(), "camming4", scene)), 5);
}

TEST_F(DesignedCams, FeedUnderMcCamIn) {
  folder.file("feed.st",
              "PROGRAM feed\nVAR_EXTERNAL Web, Feed : AXIS_REF; END_VAR\nVAR\n"
              "power : MC_Power; select : MC_CamTableSelect; cam : MC_CamIn;\n"
              "table : MC_CAM_REF := (ID := 7);\nEND_VAR\npower(Axis := Feed, Enable := TRUE);\n"
              "select(Master := Web, Slave := Feed, CamTable := table, Execute := power.Status);\n"
              "cam(Master := Web, Slave := Feed, CamTableID := select.CamTableID, Execute := select.Done,\n"
              "    StartMode := HLI_CI_F_PERIODIC OR HLI_CI_ENDLESS_POSITIVE);\nEND_PROGRAM\n");
  folder.file("old.csv", "master,slave\n0,0\n300,120\n");
  const auto scene = folder.file(
      "line.yaml",
      "scene: {duration: 4 s}\nplants:\n  web: {type: web, speed: 0 m/min, wheel: {lines: 10000}}\n"
      "  axis: {type: ideal_axis, speed_at_10v: 60 m/min, resolution: 0.01 mm}\n"
      "controller:\n  plcopen:\n    program: feed.st\n    axes:\n"
      "      Web: {kind: encoder, modulo: 300 mm, path: [500 mm, 40000], cam_gear.is_master: on}\n"
      "      Feed: {modulo: 120 mm, path: [1 mm, 100], homed_at_start: on, antr.v_at_10v: 1 m/s,\n"
      "             dynamik: {vb_max: 1 m/s, a_max: 20 m/s2}, cam_gear: {v_phasing: 100 mm/s,\n"
      "             a_phasing: 1 m/s2, d_phasing: 1 m/s2, j_phasing: 20 m/s3}}\n"
      "    tables: [{file: old.csv, id: 7}]\n    set: {Feed.kv: 6000}\n"
      "wiring: {Web.encoder: web.wheel, Feed.encoder: axis.encoder, Feed.reference: axis.reference}\n"
      "timeline: [{at: 500 ms, ramp: {web.speed: 30 m/min}, over: 500 ms}]\n"
      "record: {every: 2 ms, channels: [Web.actual_position, Feed.set_position, axis.position]}\nchecks:\n"
      "  - {name: at rest, always: \"Web.actual_position > 100 || abs(Feed.set_position - 60) >= 59.999\"}\n"
      "  - {name: five feeds, eventually: abs(axis.position - 600) <= 0.02}\n"
      "  - {name: no more, always: axis.position <= 720}\n  - {name: nothing refused, never: block_error}\n");
  expect_passed(Ran(design(feed_job(), "mc_camin", scene)), 5);
}

/// A scene that cannot take the table.
struct NoScene {
  const char* name;
  const char* device;
  std::string scene;
  const char* told;
};
TEST_F(DesignedCams, ScenesThatTakeNoTableAreRefused) {
  const auto qcl = [&](const std::string& name, const std::string& devices) {
    folder.file(name + ".cnf", "SYSTEM\nslLength L\nBUS\n1 1CPUB 02\nINTDEVICE\n" + devices + "END\n");
    folder.file("a.mod", "MAIN:\nWAIT 1\nJUMP MAIN\nEND\n");
    return folder.file(name + ".yaml",
                       "controller: {qmove: {configuration: " + name + ".cnf, tasks: [a.mod]}}\n");
  };
  const std::string axis = " CAMMING4 2 X.X X.X X.X X X.X X X.X X.X X X.X X.X\n";
  folder.file("none.il", "LD M8000\nOUT M0\nEND\n");
  folder.file("high.il", "LD M8000\nDECAM C235 D7900 M15 Y0 Y4\nEND\n");
  const auto il = [&](const std::string& program) {
    return folder.file(program + ".yaml", "controller: {lx3vp: {program: " + program + "}}\n");
  };
  for (const auto& [name, device, scene, told] : {
           NoScene{"another controller", "lx3vp", scenes / "rotary_knife.yaml", "--scene:1:1: "},
           NoScene{"no file", "camming4", folder / "nowhere.yaml", "nowhere.yaml"},
           NoScene{"no axis", "camming4", qcl("no", ""), "plays no cam: it has no axis of CAMMING4"},
           NoScene{"two axes", "camming4", qcl("two", fmt::format("A{0}B{0}", axis)), "2 axes with CAMMING4"},
           NoScene{"no slZone", "camming4", qcl("one", "A" + axis), "there is no slZone"},
           NoScene{"no DECAM", "lx3vp", il("none.il"), "plays no cam: it has no axis of CAMMING4, no DECAM"},
           NoScene{"no room", "lx3vp", il("high.il"), "rows behind D7900 reach into the special registers"},
           NoScene{"by name", "mc_camin", scenes / "mc_camin_first.yaml",
                   "its program asks for its table by the name of the file; let it ask by ID"},
           NoScene{"two tables", "mc_camin", scenes / "mc_camin_table_switch.yaml",
                   "cam tables; name a scene with one"},
       }) {
    auto options = device == std::string("lx3vp") ? in_pulses(knife_job()) : knife_job();
    options.device = device;
    options.table = folder / "cam.csv";
    options.scene = scene;
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    EXPECT_EQ(cli::design_cam(options), cli::bad_input) << name;
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "") << name;
    EXPECT_THAT(testing::internal::GetCapturedStderr(), testing::HasSubstr(told)) << name;
    EXPECT_FALSE(fs::exists(folder / "cam.csv")) << name;
    EXPECT_FALSE(fs::exists(folder / "cam.yaml")) << name;
  }
}

// The program makes its own cam where it is not told that there is one: the scenario's own check says so.
TEST_F(DesignedCams, ATableThatIsNotPlayedFailsACheck) {
  const auto failed = testing::Contains(testing::HasSubstr("plays the designed cam"));
  const auto file = design(knife_job(), "camming4", scenes / "rotary_knife.yaml");
  EXPECT_THAT(Ran(file, {{"controller.qmove.set.slZone", "0"}}).failed(), failed);
  const auto registers = design(in_pulses(knife_job()), "lx3vp", scenes / "rotary_knife_lx3vp.yaml");
  EXPECT_THAT(Ran(registers, {{"controller.lx3vp.set.DD540", "0"}}).failed(), failed);
}

/// What the drive gave over eight pieces at full speed.
struct Effort {
  double loss = 0;  ///< in the copper, on an average [W]
  double step = 0;  ///< largest change of the torque in 2 ms [N m]
};
Effort effort_of(const Ran& run) {
  const auto& recording = run.simulation->recording();
  const auto* loss = recording.column("knife.motor.copper_loss");
  const auto* torque = recording.column("knife.motor.torque");
  EXPECT_TRUE(loss != nullptr && torque != nullptr);
  Effort effort;
  int count = 0;
  const auto& times = recording.times();
  for (std::size_t i = 1; i < times.size(); ++i) {
    const double second = seconds(times[i]);
    if (second <= 5.2 || second > 11.6) continue;
    ++count;
    effort.loss += loss->values[i];
    effort.step = std::max(effort.step, std::abs(torque->values[i] - torque->values[i - 1]));
  }
  effort.loss /= count;
  return effort;
}

// The integral of the acceleration squared is 12 of the designed cam and 120/7 of the quintic that the scene
// has: 30 % less copper loss, for steps of the torque where the quintic has none. In the scene's loop the
// steps ring, which costs 4 of the 30 %; the stiffer the gear, the quicker the drive and the softer the
// position loop, the less.
TEST_F(DesignedCams, LeastRmsLosesLessThanTheQuintic) {
  std::vector<scenario::Override> overrides = {
      {"record.channels", "[knife.motor.copper_loss, knife.motor.torque]"},
      {"timeline.1.ramp.web.speed", "60 m/min"},  // whole counts a cycle: no counting noise in either
      {"plants.knife.coupling", "0 N s/m"},
      {"plants.web.wheel.lines", "100000"},
      {"controller.plcopen.axes.Web.path", "[500 mm, 400000]"}};
  for (const auto* friction : {"motor_friction.coulomb", "drum_friction.coulomb"})
    overrides.push_back({"plants.knife." + std::string(friction), "0 N m"});
  for (const auto* friction : {"motor_friction.viscous", "drum_friction.viscous"})
    overrides.push_back({"plants.knife." + std::string(friction), "0 N m s/rad"});
  const auto scene = scenes / "rotary_knife_mc_camin.yaml";
  const auto file = design(knife_job(), "mc_camin", scene);
  const auto loss_ratio = [&] {
    const auto quintic = effort_of(Ran(scene, overrides));
    const auto designed = effort_of(Ran(file, overrides));
    EXPECT_GT(designed.step, 2 * quintic.step) << quintic.step << " N m";
    return designed.loss / quintic.loss;
  };
  EXPECT_NEAR(loss_ratio(), 0.7355, 0.005);
  const std::vector<scenario::Override> quiet = {{"plants.knife.gear.stiffness", "1e6 N m/rad"},
                                                 {"plants.knife.servo.filter", "0 ms"},
                                                 {"plants.knife.servo.current_lag", "0 ms"},
                                                 {"plants.knife.servo.speed_gain", "600 rad/s"},
                                                 {"controller.plcopen.set.Knife.kv", "2000"}};
  overrides.insert(overrides.end(), quiet.begin(), quiet.end());
  EXPECT_NEAR(loss_ratio(), 12 / (120.0 / 7), 0.01);
}

}  // namespace
}  // namespace drycut::sim
