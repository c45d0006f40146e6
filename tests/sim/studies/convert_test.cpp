// drycut convert, and runs that are recorded as HDF5.
#include <sys/wait.h>

#include <csignal>

#include "sim/cli/compare_command.hpp"
#include "sim/cli/convert_command.hpp"
#include "sim/cli/run_command.hpp"
#include "sim/record/hdf5_file.hpp"
#include "sim/studies/compare/run_folder.hpp"
#include "tests/sim/command_bench.hpp"

namespace drycut::sim::cli {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

constexpr auto* scenario = R"(scene: {step: 1 ms, duration: 10 s}
plants: {web: {type: web, speed: 60 m/min, wheel: {}}}
timeline:
  - {at: 1 s, set: {web.speed: 30 m/min}}
  - {at: 2 s, set: {web.speed: 60 m/min}}
record: {every: 2 ms, channels: [web.speed, web.position]}
checks:
  - {name: slow enough, always: "web.speed <= 100"}
)";

struct ConvertCommand : CommandTest {
  ConvertCommand() { folder.file("web.yaml", scenario); }
  /// The folder of a run.
  fs::path run(const std::string& format, const std::string& more = "scene.seed=1") {
    RunOptions options;
    options.scenarios = {folder / "web.yaml"};
    options.out = folder / format;
    options.set = {"record.format=" + format, more};
    options.pictures = false;
    EXPECT_EQ(captured([&] { return run_scenarios(options); }), all_passed) << err;
    return folder / format / "web";
  }
  int convert(const fs::path& from, const std::string& to, const fs::path& file = {}) {
    return captured([&] { return convert_run({from, to, file}); });
  }
  void refuses(const fs::path& from, const std::string& to, const fs::path& file, const std::string& told) {
    EXPECT_EQ(convert(from, to, file), bad_input) << told;
    EXPECT_THAT(err, HasSubstr(told));
  }
  TestFolder folder;
};

TEST_F(ConvertCommand, BothFormatsHoldTheSame) {
  const auto csv = run("csv");
  const auto hdf5 = run("hdf5");
  EXPECT_FALSE(fs::exists(hdf5 / "trace.csv"));
  EXPECT_FALSE(fs::exists(csv / "trace.h5"));
  ASSERT_EQ(convert(hdf5, "csv", folder / "trace.csv"), all_passed) << err;
  EXPECT_EQ(content(folder / "trace.csv"), content(csv / "trace.csv"));
  EXPECT_EQ(content(folder / "events.csv"), content(csv / "events.csv"));
  EXPECT_THAT(out, HasSubstr("5001 rows of 2 channels, 2 events: "));
  Problems problems;
  const auto record = record::read_hdf5(hdf5 / "trace.h5", problems);
  ASSERT_EQ(lines_of(problems), "");
  ASSERT_FALSE(record.outcome.checks.empty());
  EXPECT_EQ(record.outcome.checks[0].name, "slow enough");
  EXPECT_EQ(record.about[1], (std::pair<std::string, std::string>("step", "1 ms")));
  EXPECT_EQ(record.about[2].second, "record.format=hdf5\nscene.seed=1\n");
  EXPECT_EQ(record.about[3].second, content(hdf5 / "scenario.yaml"));
}

TEST_F(ConvertCommand, ARunIsTheSameBytesTwice) {
  const auto first = content(run("hdf5") / "trace.h5");
  EXPECT_TRUE(first == content(run("hdf5") / "trace.h5"));
}

TEST_F(ConvertCommand, ARunOfTheOtherFormatLeavesNoOldRecord) {
  const auto csv = run("csv");
  folder.file("web.yaml", std::string(scenario) + "variables: {}\n");
  RunOptions options;
  options.scenarios = {folder / "web.yaml"};
  options.out = folder / "csv";
  options.set = {"record.format=hdf5"};
  options.pictures = false;
  ASSERT_EQ(captured([&] { return run_scenarios(options); }), all_passed) << err;
  EXPECT_FALSE(fs::exists(csv / "trace.csv"));
  EXPECT_FALSE(fs::exists(csv / "events.csv"));
  EXPECT_TRUE(fs::exists(csv / "trace.h5"));
}

TEST_F(ConvertCommand, GoesRoundToTheSameBytes) {
  const auto csv = run("csv");
  ASSERT_EQ(convert(csv, "hdf5", folder / "a.h5"), all_passed) << err;
  ASSERT_EQ(convert(folder / "a.h5", "csv"), all_passed) << err;
  EXPECT_EQ(content(folder / "a.csv"), content(csv / "trace.csv"));
  EXPECT_EQ(content(folder / "a.events.csv"), content(csv / "events.csv"));
  ASSERT_EQ(convert(folder / "a.csv", "hdf5", folder / "b.h5"), all_passed) << err;
  Problems problems;
  const auto a = record::read_hdf5(folder / "a.h5", problems);
  EXPECT_FALSE(a.outcome.checks.empty());
  EXPECT_EQ(a.about.size(), 3U) << "version, step, scenario";
  EXPECT_TRUE(record::read_hdf5(folder / "b.h5", problems).about.empty()) << "a file alone knows them not";
  ASSERT_EQ(convert(folder / "a.h5", "hdf5", folder / "c.h5"), all_passed) << err;
  EXPECT_TRUE(content(folder / "a.h5") == content(folder / "c.h5"));
}

TEST_F(ConvertCommand, ComparesRunsOfBothFormats) {
  CompareOptions compare{{run("csv"), run("hdf5")}, folder / "compare"};
  compare.pictures = false;
  EXPECT_EQ(captured([&] { return compare_runs(compare); }), all_passed) << err;
  Problems problems;
  const auto a = studies::read_run(compare.runs[0], problems);
  const auto b = studies::read_run(compare.runs[1], problems);
  ASSERT_EQ(lines_of(problems), "");
  EXPECT_TRUE(a.recording.times() == b.recording.times());
  ASSERT_EQ(b.recording.columns().size(), 2U);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_TRUE(a.recording.columns()[i].values == b.recording.columns()[i].values) << i;
  EXPECT_EQ(b.recording.events().size(), 2U);
}

TEST_F(ConvertCommand, NamesTheFileByTheRun) {
  const auto csv = run("csv");
  ASSERT_EQ(convert(csv / "", "mcap"), all_passed) << err;
  const auto mcap = content(folder / "csv/web.mcap");
  EXPECT_TRUE(mcap.starts_with("\x89MCAP0\r\n"));
  EXPECT_TRUE(mcap.ends_with("\x89MCAP0\r\n"));
  refuses(csv, "mcap", {}, "web.mcap:1:1: there is such a file already; name the file with --out");
  ASSERT_EQ(convert(csv, "mcap", folder / "csv/web.mcap"), all_passed) << err;
  EXPECT_TRUE(mcap == content(folder / "csv/web.mcap")) << "the same bytes twice";
}

TEST_F(ConvertCommand, RefusesWhatItCannotConvert) {
  const auto csv = run("csv");
  refuses(csv, "hdf", folder / "x",
          "--to:1:1: there is no format 'hdf'; did you mean hdf5? [option.unknown-choice]");
  refuses(folder / "nothing", "csv", folder / "x", "nothing:1:1: there is no such run; name a folder");
  refuses(folder / "csv", "csv", folder / "x",
          "csv:1:1: it is not the folder of a run: there is no trace.csv, no trace.h5; the runs in it are " +
              csv.string() + " [record.no-run]\n");
  refuses(folder / "web.yaml", "csv", folder / "x.csv",
          "web.yaml:1:1: the header does not begin with time [s]");
  refuses(csv / "trace.csv", "csv", csv / "trace.csv", "trace.csv is the record itself; name another file");
  refuses(csv, "hdf5", folder / "none/x.h5", "there is no directory");
  fs::create_directories(folder / "half");
  folder.file("half/trace.h5", "\x89HDF\r\n\x1a\n and no more");
  refuses(folder / "half", "csv", folder / "x.csv",
          "trace.h5:1:1: HDF5 cannot open it: it is cut short or damaged");
  folder.file("slash.csv", "time [s],a/b [mm]\n0.0,1\n");
  folder.file("slash.events.csv", "time [s],source,event,values\n");
  refuses(folder / "slash.csv", "hdf5", folder / "x.h5",
          "slash.csv:1:1: HDF5 can have no channel 'a/b'; rename it");
  EXPECT_EQ(convert(folder / "slash.csv", "mcap", folder / "x.mcap"), all_passed) << err;
  folder.file("alone.csv", "time [s],a [mm]\n0.0,1\n");
  refuses(folder / "alone.csv", "hdf5", folder / "x.h5", "alone.events.csv");
  for (const auto* file : {"x", "x.csv", "x.h5", "x.h5.part"})
    EXPECT_FALSE(fs::exists(folder / file)) << file;
}

TEST_F(ConvertCommand, AScenarioKnowsItsFormats) {
  RunOptions options;
  options.scenarios = {folder / "web.yaml"};
  options.out = folder / "out";
  options.set = {"record.format=hdf"};
  EXPECT_EQ(captured([&] { return run_scenarios(options); }), bad_input);
  EXPECT_THAT(err, AllOf(HasSubstr("record.format"), HasSubstr("did you mean hdf5?")));
}

TEST_F(ConvertCommand, WhatWasKilledIsAPrefix) {
  const std::string program = DRYCUT_PROGRAM;
  if (!fs::exists(program)) GTEST_SKIP() << "needs the program, which is not built here";
  const std::vector<std::string> words = {"run",
                                          (folder / "web.yaml").string(),
                                          "--no-pictures",
                                          "--out",
                                          (folder / "killed").string(),
                                          "--set",
                                          "record.format=hdf5",
                                          "--set",
                                          "scene.duration=100000 s"};
  // It is read here while it is written there: a lock of HDF5 would stop whoever comes second.
  setenv("HDF5_USE_FILE_LOCKING", "FALSE", 1);
  const pid_t child = started(program, words);
  unsetenv("HDF5_USE_FILE_LOCKING");
  ASSERT_GT(child, 0);
  const auto file = folder / "killed/web/trace.h5";
  const auto rows = [&] {
    Problems ignored;
    return record::is_hdf5(file) ? record::read_hdf5(file, ignored).recording.times().size() : 0;
  };
  int status = 0;
  bool ended = false;
  while (rows() < 5000 && !ended) ended = waitpid(child, &status, WNOHANG) == child;
  if (!ended) {
    kill(child, SIGKILL);
    waitpid(child, &status, 0);
  }
  ASSERT_TRUE(WIFSIGNALED(status)) << "it was to be killed before its end";
  Problems problems;
  const auto killed = record::read_hdf5(file, problems);
  ASSERT_EQ(lines_of(problems), "");
  EXPECT_EQ(killed.recording.times().size() % 4096, 0U);
  EXPECT_TRUE(killed.outcome.checks.empty()) << "they are not known yet";
  EXPECT_EQ(killed.recording.events().size(), 2U);
  ASSERT_EQ(convert(folder / "killed/web", "csv", folder / "killed.csv"), all_passed) << err;
  EXPECT_THAT(out, HasSubstr("note: the run did not come to its end: the run has not come to its end; "));
  const auto text = content(folder / "killed.csv");
  const auto whole = content(run("csv") / "trace.csv");  // its first 10 s
  EXPECT_EQ(text.substr(0, whole.size()), whole);
}

}  // namespace
}  // namespace drycut::sim::cli
