// drycut new: every line that it makes runs at once, and is its owner's.
#include "sim/cli/new_command.hpp"

#include <algorithm>
#include <span>

#include "base/text.hpp"
#include "sim/cli/check_command.hpp"
#include "sim/cli/run_command.hpp"
#include "tests/sim/command_bench.hpp"

namespace drycut::sim::cli {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

struct NewLine : CommandTest {
  int make(const std::string& name, const std::string& machine, const std::string& controller) {
    return captured([&] { return make_line({folder / name, machine, controller}); });
  }
  /// The line runs with these values; its events.
  std::string run(const std::vector<std::string>& set = {}) {
    RunOptions options;
    options.scenarios = {folder / "line/line.yaml"};
    options.out = folder / "out";
    options.pictures = false;
    options.set = set;
    EXPECT_EQ(captured([&] { return run_scenarios(options); }), all_passed) << out << err;
    return content(folder / "out/line/events.csv");
  }
  /// The farthest that the stop of the last run came [mm].
  double farthest() const {
    const auto trace = content(folder / "out/line/trace.csv");
    const auto lines = split_lines(trace);
    const auto before = lines.front().substr(0, lines.front().find("stop.position"));
    double most = 0;
    for (auto row : std::span(lines).subspan(1)) {
      for (auto columns = std::ranges::count(before, ','); columns > 0; --columns)
        row.remove_prefix(row.find(',') + 1);
      most = std::max(most, std::stod(std::string(row.substr(0, row.find(',')))));
    }
    return most;
  }
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder / "line"))
      if (entry.is_regular_file())
        names.push_back(entry.path().lexically_relative(folder / "line").generic_string());
    std::ranges::sort(names);
    return names;
  }
  TestFolder folder;
};

/// Length of the last piece [mm].
double last_length(const std::string& events) {
  const auto at = events.rfind(",cut,length=");
  return at == std::string::npos ? 0 : std::stod(events.substr(at + 12));
}

bool is_press(const Start& start) { return start.machine.starts_with("vertical_press"); }

std::ptrdiff_t cuts(const std::string& events) {
  const auto lines = split_lines(events);
  return std::ranges::count_if(lines,
                               [](auto line) { return line.find(",cut,length=") != std::string_view::npos; });
}

struct EveryStart : NewLine, testing::WithParamInterface<Start> {
  void SetUp() override {
    ASSERT_EQ(make("line", GetParam().machine, GetParam().controller), all_passed) << err;
  }
};

TEST_P(EveryStart, RunsAndPassesWhereItIs) {
  EXPECT_THAT(out,
              AllOf(HasSubstr(GetParam().about), HasSubstr(" run " + (folder / "line/line.yaml").string())));
  CheckOptions check;
  check.files = {folder / "line/line.yaml"};
  EXPECT_EQ(captured([&] { return check_files(check); }), all_passed) << err;
  check.strict = true;
  EXPECT_EQ(captured([&] { return check_files(check); }), all_passed) << out;
  EXPECT_NE(run(), "");
  EXPECT_THAT(content(folder / "line/README.md"), Not(HasSubstr("@")));
}

/// A line whose machine was changed, and its axes and cam not.
struct ChangedLine : NewLine {
  std::string notes(const std::vector<std::string>& set, bool strict = false) {
    CheckOptions check;
    check.files = {folder / "line/line.yaml"};
    check.set = set;
    check.strict = strict;
    EXPECT_EQ(captured([&] { return check_files(check); }), strict ? check_failed : all_passed) << err;
    return out;
  }
};

TEST_F(ChangedLine, IsToldWhatNoLongerFits) {
  ASSERT_EQ(make("line", "rotary_knife", "plcopen"), all_passed);
  EXPECT_THAT(
      notes({"plants.knife.gear.ratio=3"}),
      AllOf(HasSubstr("line.yaml: Knife.path says 40960 counts for 360 deg, and knife.encoder gives 24576"),
            HasSubstr("line.yaml: Knife.antr.v_at_10v is 2400 deg/s, and 10 V at knife.servo.reference are "
                      "4000 deg/s")));
  EXPECT_THAT(notes({"plants.knife.circumference=800 mm"}, true),
              HasSubstr("as a drum of 600 mm does, and knife has 800 mm"));
  EXPECT_THAT(notes({"plants.web.wheel.lines=5000"}),
              HasSubstr("Web.path says 40000 counts for 500 mm, and web.wheel gives 20000"));
}

TEST_F(ChangedLine, IsToldAnOutputThatNothingWorks) {
  ASSERT_EQ(make("line", "flying_saw", "lx3vp"), all_passed);
  EXPECT_THAT(notes({"wiring.Y21=panel.lamp"}),
              HasSubstr("line.yaml: Y21 is wired to panel.lamp, and no program works it"));
}

TEST_F(ChangedLine, SaysAWireWithoutAPurposeEverywhere) {
  ASSERT_EQ(make("line", "flying_saw", "lx3vp"), all_passed);
  RunOptions options;
  options.scenarios = {folder / "line/line.yaml"};
  options.out = folder / "out";
  options.summary = (folder / "summary.md").string();
  options.annotate = "github";
  options.pictures = false;
  options.set = {"wiring.Y21=panel.lamp"};
  const std::string warning = "Y21 is wired to panel.lamp, and no program works it";
  EXPECT_EQ(captured([&] { return run_scenarios(options); }), all_passed) << err;
  EXPECT_THAT(
      out, AllOf(HasSubstr("line: passed, all "), HasSubstr(" checks passed, 1 warning ("),
                 HasSubstr("\n  warning " + warning), testing::ContainsRegex("::warning file=.*" + warning)));
  EXPECT_THAT(content(folder / "out/junit.xml"),
              AllOf(HasSubstr("<property name=\"warning\" value=\"" + warning), HasSubstr("failures=\"0\""),
                    HasSubstr("<system-out>warning: " + warning)));
  EXPECT_THAT(content(folder / "out/line/checks.json"), HasSubstr(warning));
  EXPECT_THAT(content(folder / "summary.md"),
              AllOf(HasSubstr("passed, 1 warning"), HasSubstr("- line: Y21 is wired")));
  options.strict = true;
  EXPECT_EQ(captured([&] { return run_scenarios(options); }), check_failed) << err;
  EXPECT_THAT(out, HasSubstr("FAIL no warning: " + warning));
  EXPECT_THAT(content(folder / "out/junit.xml"), HasSubstr("failures=\"1\""));
}

TEST_F(ChangedLine, IsToldWhatNothingIsWiredTo) {
  ASSERT_EQ(make("line", "flying_saw", "lx3vp"), all_passed);
  auto program = content(folder / "line/programs/flying_saw.il");
  program.replace(program.find("M15 Y0 Y4"), 9, "M15 Y1 Y4");
  program.replace(program.find("AND     X14"), 11, "AND     X15");
  folder.file("line/programs/flying_saw.il", program);
  EXPECT_THAT(notes({}, true),
              AllOf(HasSubstr("line.yaml: Y1 gives pulses, and nothing is wired to it"),
                    HasSubstr("line.yaml: X15 is read by the program, and nothing is wired to it")));
}

TEST_F(ChangedLine, SaysWhyItFailsEverywhere) {
  ASSERT_EQ(make("line", "rotary_knife", "plcopen"), all_passed);
  RunOptions options;
  options.scenarios = {folder / "line/line.yaml"};
  options.out = folder / "out";
  options.summary = (folder / "summary.md").string();
  options.annotate = "github";
  options.pictures = false;
  options.set = {"timeline.0.set.panel.start=0", "scene.duration=8 s"};
  EXPECT_EQ(captured([&] { return run_scenarios(options); }), check_failed) << err;
  const std::string why = "because nothing pressed start (panel.start was never on)";
  EXPECT_THAT(out, AllOf(HasSubstr("checks failed, " + why), HasSubstr("no cut between 7.0 s and 8.0 s"),
                         testing::ContainsRegex("::error.*" + std::string("because nothing pressed start"))));
  EXPECT_THAT(content(folder / "out/junit.xml"), HasSubstr("failed " + why));
  EXPECT_THAT(content(folder / "out/line/checks.json"), HasSubstr("\"cause\": \"" + why));
  EXPECT_THAT(content(folder / "summary.md"), HasSubstr("It failed because nothing pressed start"));
}

TEST_P(EveryStart, NeedsNothingOutside) {
  const auto scenario = content(folder / "line/line.yaml");
  EXPECT_THAT(scenario, AllOf(Not(HasSubstr("../")), Not(HasSubstr("extends"))));
  const auto all = files();
  EXPECT_THAT(all, testing::IsSupersetOf({".github/workflows/drycut.yml", ".gitignore", ".gitlab-ci.yml",
                                          "README.md", "line.yaml"}));
  // No file lies there that the scenario does not name.
  for (const auto& name : all)
    if (name.starts_with("programs/") || name.starts_with("cams/")) {
      EXPECT_THAT(scenario, HasSubstr(name));
      EXPECT_THAT(content(folder / "line/README.md"), HasSubstr("| `" + name + "` |"));
    }
}

TEST_P(EveryStart, ReadmesExampleIsOfAVariable) {
  const auto readme = content(folder / "line/README.md");
  const auto example = std::string(is_press(GetParam())                  ? "variables.tours=2"
                                   : GetParam().machine == "flying_saw"  ? "variables.length=1.2 m"
                                   : GetParam().machine == "length_stop" ? "variables.length=450 mm"
                                                                         : "variables.length=1 m");
  EXPECT_THAT(readme, HasSubstr("--set \"" + example + "\" "));
  EXPECT_THAT(readme, testing::StartsWith("# line\n\n" + GetParam().about));
}

TEST_P(EveryStart, LengthAndSpeedMakeOtherPieces) {
  if (is_press(GetParam())) {
    EXPECT_NE(run(), run({"variables.load=100 kg"}));
    return;
  }
  if (GetParam().machine == "length_stop") {  // its check of the place takes the length
    run({"variables.length=450 mm", "variables.step=40 mm"});
    EXPECT_NEAR(farthest(), 450 + 3 * 40, 0.3);
    return;
  }
  const bool saw = GetParam().machine == "flying_saw";
  const auto plain = run();
  EXPECT_NEAR(last_length(plain), saw ? 1000 : 800, 0.2);
  const auto longer = run({"variables.length=1.2 m"});
  EXPECT_NEAR(last_length(longer), 1200, 0.2);
  EXPECT_LE(cuts(longer), cuts(plain));
  CheckOptions check;  // a run whose length follows the pieces' ends at a whole step
  check.files = {folder / "line/line.yaml"};
  check.set = {"variables.length=1.6 m"};
  EXPECT_EQ(captured([&] { return check_files(check); }), all_passed) << err;
  EXPECT_LT(cuts(run({"variables.speed=25 m/min"})), cuts(plain));
}

INSTANTIATE_TEST_SUITE_P(New, EveryStart, testing::ValuesIn(starts()), [](const auto& instance) {
  return instance.param.machine + "_" + instance.param.controller;
});

TEST_F(NewLine, ListsWhatThereIs) {
  EXPECT_EQ(captured([&] { return make_line({"", "", "", true}); }), all_passed);
  EXPECT_THAT(out,
              HasSubstr("rotary_knife     plcopen    A rotary knife cuts a running web into pieces, under a "
                        "PLCopen controller: MC_CamIn plays cams/knife.tab.\n"));
  EXPECT_EQ(split_lines(out).size(), starts().size());
  EXPECT_GE(starts().size(), 10U);
}

TEST_F(NewLine, SaysWhichPairsThereAre) {
  struct Case {
    std::string machine;
    std::string controller;
    std::string told;
  };
  const std::string all =
      "there are: flying_saw under lx3vp, plcopen, qmove; length_stop under lx3vp, qmove; rotary_knife under "
      "lx3vp, plcopen, qmove; vertical_press under qmove; vertical_press_inverter under qmove";
  for (const auto& [machine, controller, told] : std::vector<Case>{
           {"", "", "--from:1:1: no machine is named; " + all + " [option.missing]\n"},
           {"rotary_knive", "qmove",
            "--from:1:1: there is no line of 'rotary_knive' to start from; did you mean "
            "rotary_knife? [option.unknown-choice]\n"},
           {"lathe", "qmove",
            "--from:1:1: there is no line of 'lathe' to start from; " + all + " [option.unknown-choice]\n"},
           {"rotary_knife", "",
            "--controller:1:1: no controller is named; rotary_knife is there under lx3vp, "
            "plcopen, qmove [option.missing]\n"},
           {"rotary_knife", "plcopn",
            "--controller:1:1: there is no rotary_knife under 'plcopn'; did you mean plcopen? "
            "[option.unknown-choice]\n"},
           {"vertical_press", "lx3vp",
            "--controller:1:1: there is no vertical_press under 'lx3vp'; " + all +
                " [option.unknown-choice]\n"}}) {
    EXPECT_EQ(make("line", machine, controller), bad_input) << machine;
    EXPECT_EQ(err, told);
    EXPECT_FALSE(fs::exists(folder / "line"));
  }
}

TEST_F(NewLine, TheOnlyControllerNeedNotBeNamed) {
  EXPECT_EQ(make("line", "vertical_press", ""), all_passed) << err;
  EXPECT_TRUE(fs::exists(folder / "line/programs/press_watch.mod"));
}

TEST_F(NewLine, WhatIsThereStays) {
  fs::create_directories(folder / "line");
  EXPECT_EQ(make("line/", "rotary_knife", "qmove"), all_passed) << "an empty folder is taken; " << err;
  folder.file("line/line.yaml", "mine");
  EXPECT_EQ(make("line", "rotary_knife", "qmove"), bad_input);
  EXPECT_EQ(err,
            (folder / "line").string() +
                ":1:1: the folder is not empty; name one that is empty or not there yet [file.not-ours]\n");
  EXPECT_EQ(content(folder / "line/line.yaml"), "mine");
  folder.file("file", "mine");
  EXPECT_EQ(make("file", "rotary_knife", "qmove"), bad_input);
  EXPECT_THAT(err, HasSubstr("there is a file of that name; name a folder that is not there yet"));
  EXPECT_EQ(captured([&] { return make_line({"", "rotary_knife", "qmove"}); }), bad_input);
  EXPECT_THAT(err, HasSubstr("no folder is named; "));
}

TEST_F(NewLine, NothingIsHalfWritten) {
  folder.file("file", "mine");
  EXPECT_EQ(make("file/line", "rotary_knife", "qmove"), bad_input);
  EXPECT_THAT(err, HasSubstr("file/line:1:1: nothing can be written into"));
  fs::create_directories(folder / "other.part");
  EXPECT_EQ(make("other", "rotary_knife", "qmove"), simulation_failed);
  EXPECT_THAT(err, HasSubstr("other.part is in the way"));
  EXPECT_FALSE(fs::exists(folder / "other"));
  EXPECT_EQ(make("a/b/line", "rotary_knife", "qmove"), all_passed) << err;
  EXPECT_TRUE(fs::exists(folder / "a/b/line/line.yaml"));
  EXPECT_FALSE(fs::exists(folder / "a/b/line.part"));
}

}  // namespace
}  // namespace drycut::sim::cli
