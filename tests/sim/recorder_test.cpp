#include "sim/record/recording.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "sim/file.hpp"
#include "sim/loop/watch.hpp"
#include "sim/record/trace_files.hpp"
#include "sim/report/results.hpp"
#include "tests/loop/fakes.hpp"
#include "tests/test_folder.hpp"

namespace drycut::sim::loop {
namespace {

namespace fs = std::filesystem;

struct RecorderTest : testing::Test {
  RecorderTest() {
    fs::remove_all(folder);
    fs::create_directories(folder);
    controller.values["error"] = 0;
  }
  ~RecorderTest() override { fs::remove_all(folder); }
  static std::string contents(const fs::path& file) {
    std::ifstream stream(file);
    std::stringstream text;
    text << stream.rdbuf();
    return text.str();
  }

  fs::path folder =
      fs::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name();
  fakes::FakeController controller;
  fakes::FakePlant plant;
  OperatorPanel panel;
  Names names{{{"web", &plant}}, &controller, panel};
  Watch watch{names};
  record::Recording recording;
};

TEST_F(RecorderTest, TraceHasTimeThenChannelsWithUnits) {
  panel.switches["start"];
  ASSERT_TRUE(watch.record("web.speed", recording));
  ASSERT_TRUE(watch.record("error", recording));
  ASSERT_TRUE(watch.record("panel.start", recording));
  ASSERT_TRUE(watch.record("web.speed", recording)) << "twice is once";
  EXPECT_FALSE(watch.record("web.sped", recording));
  record::TraceFiles files(recording, folder / "trace.csv", folder / "events.csv");
  watch.update();
  files.sample(0);
  plant.speed = 1.0 / 3;
  watch.update();
  files.sample(2'100'000);
  files.finish();
  EXPECT_EQ(contents(folder / "trace.csv"),
            "time [s],web.speed [m/min],error [Um],panel.start [-]\n"
            "0.0,60,0,0\n"
            "0.0021,20,0,0\n");
}

// Whole numbers take a way of their own to the same text.
TEST_F(RecorderTest, NumbersAreWrittenAsFmtWritesThem) {
  double number = 0;
  recording.add("number", "").slot = &number;
  record::TraceFiles files(recording, folder / "trace.csv", folder / "events.csv");
  std::string expected = "time [s],number [-]\n";
  for (const double size : {0.0, 1.0, 17.0, 0.1, 2.5, 1e-7, 123456789.0, 999999999999999.0, 1e15, 1e15 + 2,
                            9007199254740993.0, 1e16, 1e300, 4.9e-324, 1.7976931348623157e308})
    for (const double value : {size, -size}) {
      number = value;
      files.sample(0);
      expected += fmt::format("0.0,{}\n", value);
    }
  files.finish();
  EXPECT_EQ(contents(folder / "trace.csv"), expected);
}

TEST_F(RecorderTest, EventsCarryTheirTimeInsideTheStep) {
  recording.happened({100'000, 0.00005, "knife", "cut", {{"length", 800.0125, "mm"}, {"number", 3, ""}}, ""});
  recording.happened({200'000, 0, "AxisX", "refused", {}, "START: st_still is 0, must be 1"});
  recording.happened({300'000, 0, "task", "error", {}, "say \"no\", twice"});
  record::TraceFiles files(recording, folder / "trace.csv", folder / "events.csv");
  for (const auto& event : recording.events()) files.happened(event);
  files.finish();
  EXPECT_EQ(contents(folder / "events.csv"),
            "time [s],source,event,values\n"
            "0.000150000,knife,cut,length=800.0125 mm; number=3\n"
            "0.000200000,AxisX,refused,\"START: st_still is 0, must be 1\"\n"
            "0.000300000,task,error,\"say \"\"no\"\", twice\"\n");
}

TEST_F(RecorderTest, FilesGrowByWholeLinesASecondAtATime) {
  ASSERT_TRUE(watch.record("web.speed", recording));
  record::TraceFiles files(recording, folder / "trace.csv", folder / "events.csv");
  std::size_t lines = 0;
  for (Time now = 0; now <= 20 * second; now += 2 * millisecond) {
    files.sample(now);
    if (now % second == 0) files.happened({now, 0, "task", "note", {}, "second"});
    if (now % (90 * millisecond) != 0 && now != 20 * second) continue;
    const auto text = contents(folder / "trace.csv");
    ASSERT_TRUE(text.ends_with('\n')) << now;
    lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
    ASSERT_GE(static_cast<Time>(lines), 1 + (now - second) / (2 * millisecond)) << "a second behind at most";
  }
  EXPECT_EQ(lines, 10002U);
  const auto events = contents(folder / "events.csv");
  EXPECT_EQ(std::count(events.begin(), events.end(), '\n'), 21)
      << "the last came after its second was written";
}

TEST_F(RecorderTest, AFullDiskIsTold) {
  ASSERT_TRUE(watch.record("web.speed", recording));
  record::TraceFiles files(recording, folder / "trace.csv", "/dev/full");
  try {
    files.happened({0, 0, "task", "note", {}, "first"});
    files.finish();
    ADD_FAILURE();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "cannot write /dev/full: No space left on device");
  }
}

TEST(Series, ReadsBackWhatWentToTheFile) {
  const TestFolder folder;
  const auto spool = std::make_shared<record::Spool>();
  spool->lies_in(folder.path);
  record::Series<double> half(spool);
  record::Series<Time> whole(spool);
  constexpr std::size_t count = 3 * record::Series<double>::block + 7;
  for (std::size_t i = 0; i < count; ++i) {
    half.push_back(0.5 * static_cast<double>(i));
    whole.push_back(static_cast<Time>(i) << 40U);
  }
  ASSERT_EQ(half.size(), count);
  for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(half[i], 0.5 * static_cast<double>(i)) << i;
  for (const std::size_t i : {count - 1, std::size_t{3}, count / 2})
    EXPECT_EQ(whole[i], static_cast<Time>(i) << 40U);
  EXPECT_EQ(std::lower_bound(half.begin(), half.end(), 40000.0) - half.begin(), 80000);
  EXPECT_TRUE(half == record::Series<double>(half));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path)) << "the file has no name";
}

TEST(EventLog, GivesBackWhatItTook) {
  record::EventLog log;
  for (int i = 0; i < 1000; ++i)
    log.push_back(
        {i * second, 0.25, "knife", "cut", {{"length", 800.0 + i, "mm"}, {"number", 1.0 * i, ""}}, ""});
  log.push_back({7, 0, "task", "note", {}, "what"});
  ASSERT_EQ(log.size(), 1001U);
  const auto cut = log[999];
  EXPECT_EQ(cut.at_seconds(), 999.25);
  ASSERT_NE(cut.find("length"), nullptr);
  EXPECT_EQ(cut.find("length")->number, 1799);
  EXPECT_EQ(cut.find("length")->unit, "mm");
  EXPECT_EQ(cut.find("number")->number, 999);
  EXPECT_EQ(log.back().text, "what");
  EXPECT_TRUE(log.back().values.empty());
  EXPECT_EQ(std::distance(log.begin(), log.end()), 1001);
}

TEST(SecondsText, IsExact) {
  EXPECT_EQ(record::seconds_text(0), "0.0");
  EXPECT_EQ(record::seconds_text(12 * second + 400'000), "12.0004");
  EXPECT_EQ(record::seconds_text(1), "0.000000001");
}

TEST_F(RecorderTest, AFileThatIsNotFinishedIsNeverThere) {
  {
    OutputFile out(folder / "half.csv");
    out.write("first line\n");
  }
  EXPECT_TRUE(fs::is_empty(folder));
  EXPECT_THROW(OutputFile(folder / "nowhere" / "x.csv"), std::runtime_error);
}

TEST_F(RecorderTest, ReadFileSaysWhatIsWrong) {
  Problems problems;
  EXPECT_FALSE(read_file(folder / "none.cnf", problems, {"line.yaml", 4, 7}));
  EXPECT_FALSE(read_file(folder, problems));
  ASSERT_EQ(problems.size(), 2U);
  EXPECT_EQ(problems[0].file, "line.yaml");
  EXPECT_EQ(problems[0].line, 4);
  EXPECT_EQ(problems[0].column, 7);
  EXPECT_EQ(problems[0].what, "there is no file " + (folder / "none.cnf").string());
  EXPECT_EQ(problems[1].what, folder.string() + " is not a regular file");
}

TEST_F(RecorderTest, JunitAndChecksJsonTellTheSame) {
  record::Outcome outcome;
  outcome.end = 10 * second;
  outcome.checks = {{"good", "always x < 1", true, 0.25, "mm", 3.5, "9 instants"},
                    {"bad & worse", "always y < 1", false, -2, "N", 4.5, "9 instants, 1 failed"}};
  report::write_checks(outcome, folder / "checks.json");
  EXPECT_THAT(contents(folder / "checks.json"),
              testing::AllOf(testing::HasSubstr("\"passed\": false"), testing::HasSubstr("\"margin\": 0.25"),
                             testing::HasSubstr("\"bad & worse\"")));
  record::Outcome stopped = outcome;
  stopped.failure = "it <diverged>";
  report::write_junit(
      {{"line", "line.yaml", folder, outcome, false}, {"other", "other.yaml", folder, stopped, false}},
      folder / "junit.xml");
  const auto xml = contents(folder / "junit.xml");
  EXPECT_THAT(xml,
              testing::HasSubstr(
                  "<testsuite name=\"line\" tests=\"2\" failures=\"1\" errors=\"0\" time=\"10.000000\" "));
  EXPECT_THAT(xml, testing::HasSubstr("<testsuite name=\"other\" tests=\"3\" failures=\"1\" errors=\"1\" "));
  EXPECT_THAT(xml, testing::HasSubstr("name=\"bad &amp; worse\""));
  EXPECT_THAT(xml, testing::HasSubstr("message=\"it &lt;diverged&gt;\""));
}

TEST(Verdict, SaysHowItEnded) {
  record::Outcome outcome;
  EXPECT_EQ(report::verdict_text(outcome), "the scenario states no checks");
  outcome.checks = {{"a", "", true, {}, "", {}, ""}, {"b", "", false, {}, "", {}, ""}};
  EXPECT_EQ(report::verdict_text(outcome), "1 of 2 checks failed");
  outcome.checks[1].passed = true;
  EXPECT_EQ(report::verdict_text(outcome), "all 2 checks passed");
  outcome.failure = "diverged";
  EXPECT_EQ(report::verdict_text(outcome), "the simulation stopped: diverged");
  EXPECT_FALSE(outcome.passed());
}

}  // namespace
}  // namespace drycut::sim::loop
